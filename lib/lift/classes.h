/* classes.h - first and second class, Dirac brackets, gauge generators. */
#ifndef DAL_LIFT_CLASSES_H
#define DAL_LIFT_CLASSES_H

#include "lift/chain.h"

/* A gauge generator: G = sum_k node[k] alpha^(derivatives - k). */
typedef struct dal__generator {
    int multiplier, derivatives;
    dal__node G, *change; /* change[2*pairs] */
} dal__generator;

/* What the brackets of the constraints of a complete chain say. */
typedef struct dal__classes {
    int second, *second_class; /* [second] constraints whose brackets are regular */
    bool *is_first;            /* [count] */
    dal__node *form;           /* [count] */
    dal__node *value;          /* [primaries] multipliers; free ones are symbols */
    dal__node on_surface;      /* H there */
    int observables;           /* rows and columns of bracket: as in dal_dirac */
    dal__node *bracket;        /* [observables * 2*observables] with X, then P */
    int free_multipliers, generators, directions;
    dal__generator *generator;
} dal__classes;

/* Finds classes and brackets.  Errors: as of dal__surface_clean. */
dal_status dal__classes_find(dal__classes *classes, dal__chain *chain);

#endif
