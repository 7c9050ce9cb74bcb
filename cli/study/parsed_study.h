/* parsed_study.h - the keys of a study as they stand in its file, before anything is made of them.
 */
#ifndef DAL_CLI_PARSED_STUDY_H
#define DAL_CLI_PARSED_STUDY_H

#include "io/document.h"
#include "study.h"

/* A case, the nodes that wait for its system, and what only the whole study has. */
typedef struct parsed_study {
    study_case of_case;
    yaml_node_t *integrators, *set, *start, *displace, *seeds;
    yaml_node_t *systems, *expect;
    const char *title;
} parsed_study;

/* Takes the keys of a study, or those of one of its systems, into a parsed that holds what they
 * leave unsaid.  Return CLI_DONE or print and return an exit status. */
int parsed_study_read_study(parsed_study *parsed, const document *doc, yaml_node_t *node);
int parsed_study_read_system(parsed_study *parsed, const document *doc, yaml_node_t *node);

/* ---- study_variants.c ---- */

/* The settings of a system with several values or drawn ones, and all their combinations. */
typedef struct study_variants study_variants;

/* Reads set, start and seeds of a parsed; *count is the number of combinations, the last setting
 * changing fastest and the seeds faster still.  study_variants_free it in any case. */
int study_variants_read(study_variants **variants, const document *doc, const parsed_study *parsed,
                        int *count);
/* Combination i: set, start and what is put behind the label. */
void study_variants_apply(const study_variants *variants, int i, study_case *item);
/* Where velocities or coordinates were drawn: brings the velocities of the start onto D = 0, along
 * W^-1 A^T.  To be called when the case has its system. */
int study_variants_project_start(const study_variants *variants, study_case *item);
void study_variants_free(study_variants *variants);

#endif
