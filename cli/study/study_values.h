/* study_values.h - the values a key of a study may take: one, several, or drawn at random. */
#ifndef DAL_CLI_STUDY_VALUES_H
#define DAL_CLI_STUDY_VALUES_H

#include "io/document.h"

#include <stdint.h>

/*     0.1                                one value
 *     [0.1, 0.05]                        a list
 *     {from: 0, to: 1, count: 11}        equally distant, both ends among them
 *     {from: 0, to: 1, by: 0.1}          from, from + by, ... up to to
 *     {between: [0, 1]}                  drawn, one for each seed; where that makes sense */
typedef struct study_values {
    double *value; /* [count] */
    int count;
    int is_drawn;
    double low, high; /* drawn from there */
} study_values;

enum { STUDY_VALUES_MAX = 10000 };

/* Returns CLI_DONE or prints and returns an exit status; study_values_free it in any case. */
int study_values_read(study_values *values, const document *doc, yaml_node_t *node,
                      const char *what);
void study_values_free(study_values *values);

/* The draw of a name ("set:mass") for a seed, uniform in [low, high): a function of these alone,
 * the same on every machine.  See study_values.c. */
double study_draw(const char *name, uint64_t seed, double low, double high);

#endif
