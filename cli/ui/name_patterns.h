/* name_patterns.h - names of methods by patterns: "any +project", "spark*", "all but euler". */
#ifndef DAL_CLI_NAME_PATTERNS_H
#define DAL_CLI_NAME_PATTERNS_H

#include <stdbool.h>

/* Whether names differ in numbers alone: gauss4 and gauss6, symplectic-euler-00 and -01. */
bool name_is_of_family(const char *a, const char *b);
/* The names that are in a set, by patterns where all of a family or of a modifier are, not longer
 * than columns; allocated.  "none" where the set is empty. */
char *name_patterns(const char *const *names, const bool *is_in, int count, int columns);

#endif
