/* dalembert_invariants.h - invariants and invariant measures of a motion, found from its formulas.
 *
 * The conventions of dalembert.h hold here. */
#ifndef DALEMBERT_INVARIANTS_H
#define DALEMBERT_INVARIANTS_H

#include "dalembert_model.h"
#include "dalembert_run.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- invariants ---------------------------------------------------------------------------- */

/* An invariant I, dI/dt = 0 on D = 0. */
typedef struct dal_invariant {
    const char *formula;    /* "m*x'^2 + k*x^2", with the names of the system */
    int terms;              /* how many products it adds up */
    bool independent;       /* functionally, of those before it */
    bool is_new;            /* likewise of E and of the invariants of the system, too */
    bool exact;             /* dI/dt of the formula is 0 in quad precision; else in doubles */
    bool at_any_parameters; /* it is so with other values of the parameters, too */
    int constraint;         /* with of_coordinates: dI/dt is a multiple of this constraint of
                               velocities alone, from 0; -1: of none */
    double value;           /* at the start */
} dal_invariant;

/* An invariant measure rho dq dv delta(D): rho' + rho tr F_v = 0 on D = 0. */
typedef struct dal_invariant_measure {
    const char *formula;           /* of rho^power, "1 + y^2", positive near the start */
    double power;                  /* 1, -1, 2, -2, 1/2 or 4 */
    bool exact, at_any_parameters; /* as of an invariant */
} dal_invariant_measure;

/* How invariants are sought: dal_invariants_settings_default has the values of most of them. */
typedef struct dal_invariants_settings {
    int degree;              /* of the products, 1 to 8; 2 */
    const char *const *with; /* [with_count] further atoms, formulas as of invariants */
    int with_count;          /* 0 */
    bool measures;           /* whether measures are sought, too; false */
    bool of_coordinates;     /* whether only functions of coordinates and t are sought: what
                                integrable constraints conserve whatever the forces; false */
} dal_invariants_settings;

/* Invariants among the sums of products of atoms: the coordinates that the equations of motion
 * contain, cosines and sines of the angles that they contain, and velocities. */
typedef struct dal_invariants {
    int degree;               /* of the products */
    int atoms;                /* factors */
    const char *const *atom;  /* [atoms] their formulas */
    int products;             /* up to that degree, */
    int functions;            /* and how many independent functions they are on D = 0, without
                                 constants */
    int count;                /* a basis of the invariants */
    int independent;          /* how many of them are functionally independent */
    dal_invariant *invariant; /* [count] simple ones, of low degree first */
    double least_change; /* the smallest singular value of the rates of those functions that is not
                            counted as 0, relative to the largest; NaN: none remains */
    double largest_zero; /* the largest one that is; NaN: there is none */
    int measures;        /* found; 0 or 1 */
    dal_invariant_measure *measure; /* [measures] */
} dal_invariants;

/* The default settings. */
dal_invariants_settings dal_invariants_settings_default(void);

/* Finds the invariants that are sums of products of atoms, at random points of D = 0 near the start
 * of spec, whose system is the one of model, and with its parameters: the null space of the rates
 * of all products, by singular values, each basis vector in echelon form with coefficients that are
 * rational, times powers of parameters, and then confirmed with the formula itself.  settings may
 * be NULL.  [alloc]  Errors: errors of the parameters and of the start; DAL_STATUS_ARGUMENT (the
 * degree); DAL_STATUS_SYNTAX and DAL_STATUS_NAME (an atom of settings; the line is its number);
 * DAL_STATUS_TOO_LARGE (more than 800 products), DAL_STATUS_NOT_FINITE (no points of D = 0 with a
 * finite F near the start), DAL_STATUS_UNSUPPORTED (a measure of vakonomic motion). */
dal_status dal_find_invariants(dal_invariants **found, dal_model *model, const dal_run_spec *spec,
                               const dal_invariants_settings *settings, dal_error *error);
/* Frees them; NULL is allowed. */
void dal_invariants_free(dal_invariants *found);

#ifdef __cplusplus
}
#endif
#endif
