/* ensemble_merge.h - the shards of an ensemble, from wherever they were run, made one. */
#ifndef DAL_CLI_ENSEMBLE_MERGE_H
#define DAL_CLI_ENSEMBLE_MERGE_H

#include <stdbool.h>

/* Copies the members of all directories to one, which may be one of them, and finishes it.  Returns
 * an exit status, after a message where it is not CLI_DONE. */
int ensemble_merge(const char *const *sources, int count, const char *output, int threads,
                   bool force);

#endif
