/* chain.h - the constraints of Dirac's procedure, stage by stage. */
#ifndef DAL_LIFT_CHAIN_H
#define DAL_LIFT_CHAIN_H

#include "lift/reduction.h"

/* phi = 0. */
typedef struct dal__chain_constraint {
    dal__node phi, *gradient; /* [2*pairs] by X, P */
    int stage, source;
    bool is_known;          /* its conservation was required before */
    dal_dirac_outcome last; /* and then this was the outcome */
} dal__chain_constraint;

/* The constraints so far, and what is recorded of the stages. */
typedef struct dal__chain {
    const dal__theory *theory;
    dal__pool *pool;
    dal__surface surface;
    dal__node *H_gradient;             /* [2*pairs] of H_0 */
    dal__chain_constraint *constraint; /* [count] */
    int count, capacity, stage;
    dal_dirac_step *step; /* [steps] without their formulas, */
    dal__node *condition; /* [steps] which are these */
    int steps, step_capacity;
    bool is_complete, has_ended;
    dal__reduction conservation; /* of the last stage: for the multipliers */
} dal__chain;

/* {f, g} of two gradients. */
dal__node dal__bracket(const dal__theory *theory, const dal__node *f, const dal__node *g);
/* {f, z}, z a variable of X (below pairs) or P. */
dal__node dal__bracket_with(const dal__theory *theory, const dal__node *f, int variable);
/* The gradient of a node. */
void dal__phase_gradient(const dal__theory *theory, dal__node f, dal__node *gradient);
/* Runs all stages.  Errors: as of dal__surface_clean. */
dal_status dal__chain_run(dal__chain *chain, const dal__theory *theory, dal__pool *pool);

#endif
