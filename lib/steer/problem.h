/* problem.h - a boundary value problem: its ends, units and integrals. */
#ifndef DAL_STEER_PROBLEM_H
#define DAL_STEER_PROBLEM_H

#include "dalembert_evaluator.h"
#include "dalembert_steer.h"
#include "dynamics/tangent_map.h"

/* Points are states of a run: q, v, e, p, pi, pi_e; q and v with aim; q, v, g of vakonomic motion.
 * Numbers of a point that are unknown are numbered without e and pi_e: q, v, p, pi. */
typedef struct dal__problem {
    dal_model *model;
    const dal_system *system;
    dal_run_spec spec; /* on the space of the points */
    const dal_steer_settings *settings;
    const dal_steer_observer *observer;
    dal_error *error;
    dal_setting *setting; /* of a start at rest, and */
    char *names;          /* their names; or NULL */
    dal_run *run;
    dal_evaluator *evaluator;
    int n, dimension; /* of a point */
    int unknowns;     /* of a point: 4n, 2n, or 2n + multipliers */
    int multipliers;  /* of vakonomic motion, or 0 */
    bool is_lifted;
    double e, from, T, h;
    long long steps;
    double *start, *target;     /* [2n] */
    bool *is_free[2];           /* [2n] of the start, of the end */
    double *unit;               /* [unknowns] how large they are */
    int integrals;              /* functions of (q, v) that are integrals of the lift, whatever its
                                   momenta: D, then g - (t - from) D; 0 of other efforts */
    int constraints, holonomic; /* m, and how many g */
    int inputs;                 /* numbers of u */
    bool knows_leaf;            /* the target is on the leaf of the start, which D alone makes */
    int *gradient;              /* [(m + holonomic)*2n] nodes: gradients of D and g by q, v */
    int *momentum;              /* [n + n*unknowns] nodes: momenta of vakonomic motion, and their
                                   gradients by q, v, g; else NULL */
    double *value;              /* [symbols] of the nodes */
    int guess;                  /* that is tried, from 0; -1: the end of a motion is moved */
    int iterations;             /* of it */
    int limit;                  /* max iterations of what is being solved */
    double residual;            /* the last one */
    dal_status stopped; /* by the observer, which ended the search; DAL_STATUS_OK: not yet */
} dal__problem;

/* The place of an unknown in a point. */
static inline int dal__place_of(const dal__problem *p, int unknown)
{
    return dal__varied_place(p->spec.options.space, p->n, unknown);
}

/* Opens a problem; what it points to must outlive it.  [alloc]  Errors: see dal_steer_create. */
dal_status dal__problem_open(dal__problem *p, dal_model *model, const dal_run_spec *spec, double T,
                             const dal_steer_settings *settings, const dal_steer_observer *observer,
                             dal_error *error);
void dal__problem_close(dal__problem *p);

/* D and g at a point: out[m + holonomic].  Errors: errors of the callbacks. */
dal_status dal__problem_constraints(dal__problem *p, double t, const double *x, double *out);
/* Values of nodes of t, q, v at a point, with what other symbols have in p->value: out[count].
 * Errors: DAL_STATUS_MEMORY. */
dal_status dal__problem_evaluate(dal__problem *p, const int *node, int count, double t,
                                 const double *x, double *out);
/* Gradients of D and g at a point by q, v, in units: out[(m + holonomic)*2n].  Errors:
 * DAL_STATUS_MEMORY. */
dal_status dal__problem_gradients(dal__problem *p, double t, const double *x, double *out);
/* K at a point, in units of v: out[n*n].  Errors: errors of the callback. */
dal_status dal__problem_effort(dal__problem *p, double t, const double *x, double *out);
/* The inputs at z, a state of the lift: N^T pi/e of the effort controls, else K pi/e: out[inputs].
 * Errors: errors of the callback. */
dal_status dal__problem_inputs(dal__problem *p, double t, const double *z, double *out);
/* Learns from the observer whether the search goes on, unless it has ended it.  Errors: what it
 * returned. */
dal_status dal__problem_poll(dal__problem *p);
/* Likewise, and counts an iteration.  Errors: what the observer returned; DAL_STATUS_NOT_CONVERGED
 * where there are too many. */
dal_status dal__problem_iterate(dal__problem *p);

#endif
