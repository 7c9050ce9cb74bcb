/* steered.h - a steering problem of a system, and what came out. */
#ifndef STEERED_H
#define STEERED_H

#include "dalembert_steer.h"

/* A steering problem, and what came out. */
typedef struct steered {
    dal_model *model;
    dal_run_spec spec;
    dal_steer_settings settings;
    const dal_steer_observer *observer; /* NULL: none */
    dal_steering *steering;
    const dal_extremal *best;
    dal_error record;
} steered;

/* A sleigh, and x'' = x - x' + u from x = 1. */
extern const char steered_sleigh[], steered_unstable[];

/* From the start of the system, rest to rest. */
void steered_open(steered *s, const char *text, dal_effort effort, const char *method, double step);
void steered_close(steered *s);
dal_status steered_try(steered *s, double T, const dal_setting *target, int targets);
/* Steers and expects a motion that ends at the target. */
void steered_find(steered *s, double T, const dal_setting *target, int targets);
/* A row of the best motion. */
double *steered_row(const steered *s, long long row);

#endif
