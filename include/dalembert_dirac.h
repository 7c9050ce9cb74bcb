/* dalembert_dirac.h - Dirac's procedure: constraints, brackets and gauge of a first-order action.
 *
 * A part of dalembert_analysis.h; the conventions of dalembert.h hold here. */
#ifndef DALEMBERT_DIRAC_H
#define DALEMBERT_DIRAC_H

#include "dalembert_model.h"
#include "dalembert_run.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A formula with the names of the system, in the language of system files and in LaTeX. */
typedef struct dal_formula {
    const char *text;  /* as in a system file */
    const char *latex; /* for display mathematics */
} dal_formula;

/* What the conservation of a constraint requires: OUTCOME(code, word). */
#define DAL_DIRAC_OUTCOME_LIST(OUTCOME)                                                            \
    OUTCOME(HOLDS, "holds")             /* nothing */                                              \
    OUTCOME(FIXES, "fixes")             /* a multiplier */                                         \
    OUTCOME(ADDS, "adds")               /* a further constraint */                                 \
    OUTCOME(IRREGULAR, "irregular")     /* constraints whose squares add up to the condition */    \
    OUTCOME(CONTRADICTS, "contradicts") /* what holds nowhere: there is no motion */               \
    OUTCOME(STOPS, "stops")             /* an irregular one of another form, or without a point */
/* What the conservation of a constraint requires. */
typedef enum dal_dirac_outcome {
#define DIRAC_OUTCOME_CODE(code, word) DAL_DIRAC_##code,
    DAL_DIRAC_OUTCOME_LIST(DIRAC_OUTCOME_CODE)
#undef DIRAC_OUTCOME_CODE
        DAL_DIRAC_OUTCOME_COUNT
} dal_dirac_outcome;
/* The word of an outcome; "?" of a number that is none. */
const char *dal_dirac_outcome_name(dal_dirac_outcome outcome);

/* A constraint phi = 0. */
typedef struct dal_dirac_constraint {
    dal_formula phi;  /* its left side */
    int stage;        /* that found it; 0: primary */
    int source;       /* the constraint whose conservation requires it; -1: primary */
    bool first_class; /* else it is one of the second-class ones that Dirac brackets are made of */
    dal_formula form; /* phi, where first class less what has brackets with the second class */
} dal_dirac_constraint;

/* The conservation of one constraint, in one stage. */
typedef struct dal_dirac_step {
    int stage;                 /* from 1 */
    int constraint;            /* that must be conserved, from 0 */
    dal_dirac_outcome outcome; /* what that requires */
    dal_formula condition;     /* 0 where the constraint is conserved; the value of a multiplier */
    int multiplier;            /* fixed; -1: none */
    int first, count;          /* of the constraints that it adds */
} dal_dirac_step;

/* The multiplier of a primary constraint. */
typedef struct dal_dirac_multiplier {
    dal_formula name;  /* as in the formulas */
    dal_formula value; /* of one that is not free, on the surface */
    bool is_free;      /* whether nothing fixes it */
} dal_dirac_multiplier;

/* A Dirac bracket {left, right} that is not 0, on the surface. */
typedef struct dal_dirac_bracket {
    dal_formula left;  /* a coordinate or velocity */
    dal_formula right; /* a coordinate, velocity or momentum */
    dal_formula value; /* of the bracket */
} dal_dirac_bracket;

/* The gauge transformation of a free multiplier: {z, generator} is the change of z.  A multiplier
 * has none here where the series of its primary constraint does not end by itself. */
typedef struct dal_dirac_generator {
    int multiplier;            /* from 0 */
    int derivatives;           /* the highest of alpha(t) in it */
    dal_formula generator;     /* with alpha, alpha' and so on */
    int changes;               /* variables that it changes */
    dal_formula *changed;      /* [changes] these variables */
    dal_formula *change;       /* [changes] by what, on the surface */
    dal_formula of_multiplier; /* the change of the multiplier */
} dal_dirac_generator;

/* Dirac's procedure from beginning to end.  The phase space has 2*pairs dimensions:
 *
 *     lifted      X = (q, v, lambda, e), P = (p, pi, pi_lambda, pi_e), from (nh11),
 *                 H_0 = pi.K pi/(2e) + pi.F + lambda.v
 *     vakonomic   X = (q, v, lambda, g), P = (p, pi, pi_lambda, pi_g), from
 *                 L_1 = L(q,v,t) - g.D(q,v,t) + lambda.(q' - v),   H_0 = lambda.v - L + g.D
 *
 * The momenta whose velocities do not occur in L_1 are the primary constraints phi_b, and
 * H = H_0 + sum_b mu_b phi_b.  Stage by stage every constraint must be conserved on the surface of
 * those found so far,
 *
 *     {phi_a, H_0} + d phi_a/dt + sum_b mu_b {phi_a, phi_b} = 0,
 *
 * which is reduced by elimination: rows with a pivot fix multipliers, the others are conditions.
 * Brackets are expressions with exact derivatives; points about the start decide what vanishes on
 * the surface.  A condition sum_i c_i s_i^2, or a semidefinite quadratic form in momenta, has no
 * gradient where it is 0: it is replaced by the s_i, or by the kernel of the form (nh15). */
typedef struct dal_dirac {
    int pairs;               /* half of the dimension of the phase space */
    int primaries;           /* primary constraints, and multipliers */
    int stages;              /* until nothing is added */
    int constraints;         /* all; a complete chain of the lift has 4n + 1 for a regular K */
    int second_class;        /* rank of their brackets; 2n for the lift */
    int first_class;         /* the rest */
    int free_multipliers;    /* 1 for the lift: mu_e, the gauge */
    int dimension;           /* of the surface less the gauge directions: 2n; -1: not known */
    bool is_complete;        /* else the last step contradicts or stops, and there is no more */
    dal_formula hamiltonian; /* H_0 */
    dal_formula on_surface;  /* H on the surface */
    dal_dirac_constraint *constraint; /* [constraints] */
    int steps;                        /* conservations */
    dal_dirac_step *step;             /* [steps] */
    dal_dirac_multiplier *multiplier; /* [primaries] */
    int brackets;                     /* listed */
    int generators;                   /* listed */
    dal_dirac_bracket *bracket;       /* [brackets] of (q, v) with (q, v, p, pi) */
    dal_dirac_generator *generator;   /* [generators] */
} dal_dirac;

/* Carries out Dirac's procedure for a model whose system is the one of spec, with its effort; the
 * parameters and the start of spec say where points are.  [alloc]  Errors: errors of the start;
 * DAL_STATUS_UNSUPPORTED (vakonomic motion with forces), DAL_STATUS_TOO_LARGE,
 * DAL_STATUS_NOT_FINITE. */
dal_status dal_dirac_create(dal_dirac **dirac, dal_model *model, const dal_run_spec *spec,
                            dal_error *error);
/* Frees it; NULL is allowed. */
void dal_dirac_free(dal_dirac *dirac);

#ifdef __cplusplus
}
#endif
#endif
