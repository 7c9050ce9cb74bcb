/* zoo.h - a built-in system with a run of it, for the tests of the zoo. */
#ifndef ZOO_H
#define ZOO_H

#include "body.h"

typedef struct zoo {
    body b;
    dal_run *run;
    double step;
    int n;
    const double *x; /* q, v, ... of the run */
} zoo;

typedef struct zoo_settings {
    int count;
    dal_setting item[12];
} zoo_settings;

/* A run by gauss8; the test ends when it cannot be made. */
zoo zoo_open(const char *name, dal_space space, double step, zoo_settings parameters,
             zoo_settings start);
/* The same on (q,v) with the parameters and the start of the file. */
zoo zoo_default(const char *name, double step);
/* To the time given, a multiple of the step. */
void zoo_go(zoo *z, double time);
void zoo_close(zoo *z);

/* The field, an invariant by its number, and E, where the run is. */
void zoo_field(const zoo *z, double *F);
double zoo_invariant(const zoo *z, int i);
double zoo_energy(const zoo *z);

#endif
