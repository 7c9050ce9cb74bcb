/* ensemble_growth.h - an ensemble of a directory that gets more members, or a later end.
 *
 * What is drawn for a member depends on seed, name and member alone, so that more members only add
 * rows.  A later end runs all members again.  Until the manifest has the new numbers, the ensemble
 * before is whole; afterwards the larger one is resumed. */
#ifndef DAL_CLI_ENSEMBLE_GROWTH_H
#define DAL_CLI_ENSEMBLE_GROWTH_H

#include "run/extension.h"

typedef struct ensemble_growth {
    long long members;   /* 0: as many as before */
    run_extension later; /* the end */
} ensemble_growth;

/* Grows the ensemble; ensemble_resume then runs what is new.  Returns CLI_DONE, or prints and
 * returns an exit status. */
int ensemble_grow(const char *path, const ensemble_growth *growth);

#endif
