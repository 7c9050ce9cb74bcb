/* motion.h - a built-in system and a run of it. */
#ifndef MOTION_H
#define MOTION_H

#include "reference.h"

typedef struct motion {
    reference b;
    dal_run *run;
    double step;
    int n;
    const double *x; /* q, v, ... of the run */
} motion;

typedef struct motion_settings {
    int count;
    dal_setting item[12];
} motion_settings;

/* A run by gauss8; the test ends when it cannot be made. */
motion motion_open(const char *name, dal_space space, double step, motion_settings parameters,
                   motion_settings start);
/* The same on (q,v) with the parameters and the start of the file. */
motion motion_default(const char *name, double step);
/* To the time given, a multiple of the step. */
void motion_advance(motion *z, double time);
void motion_close(motion *z);

/* The field, an invariant by its number, and E, where the run is. */
void motion_field(const motion *z, double *F);
double motion_invariant(const motion *z, int i);
double motion_energy(const motion *z);

#endif
