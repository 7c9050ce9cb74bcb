/* study_merge.h - the shards of a study, made one. */
#ifndef DAL_CLI_STUDY_MERGE_H
#define DAL_CLI_STUDY_MERGE_H

#include <stdbool.h>

/* Merges the studies in count directories into one, which may be one of them; force writes over
 * what another directory holds.  Returns the exit status. */
int study_merge(const char *const *sources, int count, const char *output, int threads, bool force);

#endif
