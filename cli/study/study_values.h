/* study_values.h - the values that a key of a study may have, and the cases that these make. */
#ifndef DAL_CLI_STUDY_VALUES_H
#define DAL_CLI_STUDY_VALUES_H

#include "study_data.h"

/*     0.1                                one value
 *     [0.1, 0.05]                        a list
 *     {from: 0, to: 1, count: 11}        equally distant, both ends among them
 *     {from: 0, to: 1, by: 0.1}          from, from + by, ... up to to
 *     {between: [0, 1]}                  drawn, one for each seed; where that makes sense */
typedef struct study_values {
    double *value; /* [count] */
    int count;
    bool is_drawn;
    double low, high; /* drawn from there */
} study_values;

enum { STUDY_VALUES_MAX = 10000 };

/* Returns CLI_DONE or prints and returns an exit status; study_values_free it in any case. */
int study_values_read(study_values *values, const document *doc, yaml_node_t *node,
                      const char *what);
void study_values_free(study_values *values);

/* A case, the nodes that need its system, and what only the whole study has. */
typedef struct parsed_study {
    study_case item;
    yaml_node_t *integrators, *mechanics, *set, *start, *displace, *seeds;
    yaml_node_t *systems, *expect, *representatives;
    const char *title;
} parsed_study;

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
