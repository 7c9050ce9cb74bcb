/* study_draft.h - the keys of a study as they stand in its file, before anything is made of them.
 */
#ifndef DAL_CLI_STUDY_DRAFT_H
#define DAL_CLI_STUDY_DRAFT_H

#include "io/study_yaml.h"
#include "study.h"

/* An entry, the nodes that wait for its system, and what only the whole study has. */
typedef struct study_draft {
    study_entry entry;
    yaml_node_t *integrators, *set, *start, *displace, *seeds;
    yaml_node_t *systems, *expect;
    const char *title;
} study_draft;

/* Takes the keys of a study, or those of one of its systems, into a draft that holds what they
 * leave unsaid.  Return CLI_DONE or print and return an exit status. */
int study_draft_study(study_draft *draft, const study_text *text, yaml_node_t *node);
int study_draft_system(study_draft *draft, const study_text *text, yaml_node_t *node);

/* ---- study_variants.c ---- */

/* The settings of a system with several values or drawn ones, and all their combinations. */
typedef struct study_variants study_variants;

/* Reads set, start and seeds of a draft; *count is the number of combinations, the last setting
 * changing fastest and the seeds faster still.  study_variants_free it in any case. */
int study_variants_read(study_variants **variants, const study_text *text, const study_draft *draft,
                        int *count);
/* Combination i: set, start and what is put behind the label. */
void study_variants_take(const study_variants *variants, int i, study_entry *entry);
/* Where velocities or coordinates were drawn: brings the velocities of the start onto D = 0, along
 * W^-1 A^T.  To be called when the entry has its system. */
int study_variants_onto(const study_variants *variants, study_entry *entry);
void study_variants_free(study_variants *variants);

#endif
