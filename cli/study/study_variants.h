/* study_variants.h - from settings with several values to cases with one each. */
#ifndef DAL_CLI_STUDY_VARIANTS_H
#define DAL_CLI_STUDY_VARIANTS_H

#include "parsed_study.h"

/* The settings of a system with several values or drawn ones, and all their combinations. */
typedef struct study_variants study_variants;

/* Reads set, start and seeds; *count is the number of combinations, the last setting changing
 * fastest and the seeds faster still.  Call study_variants_free in any case.  Returns CLI_DONE, or
 * prints and returns CLI_USAGE, as study_variants_project_start. */
int study_variants_read(study_variants **variants, const document *doc, const parsed_study *parsed,
                        int *count);
void study_variants_free(study_variants *variants);
/* Gives a case the settings of combination i and its label. */
void study_variants_apply(const study_variants *variants, int i, study_case *item);
/* Where velocities or coordinates were drawn, projects the velocities of the start to D = 0 along
 * W^-1 A^T.  The case must have its system. */
int study_variants_project_start(const study_variants *variants, study_case *item);

#endif
