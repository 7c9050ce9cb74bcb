/* equations.h - the equations of one model, as nodes of its graph. */
#ifndef DAL_MODEL_EQUATIONS_H
#define DAL_MODEL_EQUATIONS_H

#include "dalembert_program.h"
#include "expr/derivative.h"

/* What divides by a pivot: W^-1, F. */
enum { DAL__DIVIDES_MASS = 1, DAL__DIVIDES_MOTION = 2 };

/* A pivot of the elimination.  It must not be small compared with the terms it was subtracted
 * from. */
typedef struct dal__pivot {
    dal__node pivot, size;
    int constraint;   /* whose, from 1; 0: of the mass matrix */
    bool checked;     /* by the programs that divide by it; the others only by the diagnosis */
    unsigned divides; /* DAL__DIVIDES_MASS, DAL__DIVIDES_MOTION */
} dal__pivot;

/* The equations of one model.  Every array lies in the model's memory; a missing node is 0 only in
 * exact (no solution given), otherwise the number 0. */
typedef struct dal__equations {
    dal__graph *graph;
    int observed; /* of the invariants, the last: formulas that come after all equations */
    int parameters, n, m, multipliers, invariants, lets, functions, guards, pivots;
    int holonomic; /* of the m constraints, the last */
    bool vakonomic, servo, pictured;
    bool accelerations; /* there is no lagrangian */
    bool implicit;      /* nor accelerations: these follow from the section equations */
    bool mass_positive; /* W is positive definite at the default start */
    unsigned properties;
    /* First symbols of the inputs.  Twice the numbers of q, v, pi and g: the tangent system has 2n,
     * and what enforces D reads more than pi from there (motion.h). */
    int t, q, v, pi, g, e, symbols;
    int reaction; /* first symbol of h, R_x in invariants and events: they stand for formulas */
    /* Formulas as given. */
    int sizes;
    const char **size_name; /* [sizes] */
    int *size;
    dal__node *let;                 /* [lets] */
    struct dal__function *function; /* [functions] */
    dal__node lagrangian;
    dal__node *force;      /* [n]: Q, or the accelerations */
    dal__node *equation;   /* [n] implicit: S, where q'' has the places of pi */
    dal__node *constraint; /* [m]: D */
    dal__node *position;   /* [holonomic]: g, of which the last D are the time derivatives */
    dal__node *start;      /* [2n + multipliers + 1] */
    int solved_coordinates, solved_velocities; /* that the start solves from g = 0 and D = 0 */
    dal_solved *solved;                        /* [solved_coordinates + solved_velocities] */
    dal__node *invariant;                      /* [invariants] */
    dal__node *exact;                          /* [2n] or all 0 */
    dal__node mu;                              /* mu_e, or 0 */
    int controls;                              /* columns of effort controls, and these: */
    dal__node *control;                        /* [controls*n] */
    dal__node *control_cost;                   /* [controls]: N^T pi of effort controls, or NULL */
    dal__node *picture;                        /* [DAL_PICTURE_COUNT], or NULL */
    dal_body body;
    int events;
    dal_event *event;        /* [events] */
    dal__node *event_value;  /* [events] */
    dal__node *event_rate;   /* [events] */
    dal__node *event_state;  /* [2n*events] */
    dal__node *event_normal; /* [(1 + 2n)*events]: restitution, when_q, W^-1 when_q */
    /* Derived. */
    dal__node *W;        /* [n*n] */
    dal__node *b;        /* [n] */
    dal__node *momentum; /* [n]: L_v */
    dal__node *A;        /* [m*n] */
    dal__node *B;      /* [m*n]: directions of the constraint forces; A itself by Chetaev's rule */
    dal__node *c;      /* [m] */
    dal__node *U;      /* [n*m]: W^-1 A^T; 0s where no formulas are made of it */
    dal__node *R;      /* [n*m]: W^-1 B^T; U itself by Chetaev's rule */
    dal__node *h;      /* [m]: multipliers of the constraints, not of vakonomic motion */
    dal__node *a;      /* [n]: W^-1 b, or 0s */
    dal__node *F;      /* [n + multipliers] */
    dal__node energy;  /* or 0 */
    dal__node *normal; /* [1 + 3n]: E, E_q, E_v, W^-1 E_q; or NULL */
    dal__node *potential;               /* [3n], see potential.c; or NULL */
    dal__node *extended;                /* [n]: F continued off D = 0 with E exact; or NULL */
    dal__node *guard;                   /* [guards] */
    int mass_guard;                     /* which of them is det W, from 1; 0: none */
    dal__pivot *pivot;                  /* [pivots], of at most 2 (n + m) */
    struct dal__factors *mass;          /* of W */
    struct dal__bordered *bordered;     /* solves for F and h; NULL for vakonomic motion */
    struct dal__restricted *restricted; /* solves instead where W may be singular; or NULL */
    const char *gauge;                  /* the formula of mu_e; NULL: none */
    dal__node *mu_gradient;             /* [2n + 1] by q, v, e; NULL: mu_e is of t alone */
    double *value;                      /* [symbols]: default parameters, default start */
    int *symbol;     /* [symbols]: 0, 1, 2, ...; symbol + q are the symbols of q */
    dal__node *flow; /* [1 + n]: d/dt of (t, q), that is 1 and v */
    /* Names. */
    const char **parameter, **coordinate, **let_name, **invariant_name, **guard_name, **tag;
    const char **table_name;
    int tags;
} dal__equations;

/* d/dt along v without accelerations: f_q v + f_t. */
static inline dal__node dal__time_derivative(const dal__equations *e, dal__node f)
{
    return dal__tangent(e->graph, f, e->symbol + e->t, 1 + e->n, e->flow);
}

#endif
