/* name_groups.h - names of methods in groups: "any +project", "spark*", "all but euler". */
#ifndef DAL_CLI_NAME_GROUPS_H
#define DAL_CLI_NAME_GROUPS_H

#include <stdbool.h>

/* Whether names differ in numbers alone: gauss4 and gauss6, symplectic-euler-00 and -01. */
bool name_is_of_family(const char *a, const char *b);
/* Whether two names have the same modifiers, or, without any, are of one family. */
bool name_is_of_group(const char *a, const char *b);
/* The names that are in a set, in groups where all of a family or of a modifier are, not longer
 * than columns; allocated.  "none" where the set is empty. */
char *name_groups(const char *const *names, const bool *is_in, int count, int columns);

#endif
