/* blocks.h - the blocks of the equations of constrained motion, W v' = b + A^T h, A v' = c:
 * D, A, B = W^-1 A^T, a = W^-1 b and c, by their places in the output of a callback. */
#ifndef DAL_KERNEL_BLOCKS_H
#define DAL_KERNEL_BLOCKS_H

#include "step.h"

/* The output of DAL_EVAL_BLOCKS: D, A, B as from DAL_EVAL_CONSTRAINT, then a and c. */
#define DAL_BLOCKS_SIZE(s) (2 * DAL_M(s) + DAL_N(s) + 2 * DAL_M(s) * DAL_N(s))
DAL_INLINE int dal_blocks_A(const dal_step *s) { return DAL_M(s); }
DAL_INLINE int dal_blocks_B(const dal_step *s) { return DAL_M(s) + DAL_M(s) * DAL_N(s); }
DAL_INLINE int dal_blocks_a(const dal_step *s) { return DAL_CONSTRAINT_SIZE(s); }
DAL_INLINE int dal_blocks_c(const dal_step *s) { return DAL_CONSTRAINT_SIZE(s) + DAL_N(s); }

/* The blocks at a point, out[DAL_BLOCKS_SIZE(s)]; counts as an evaluation of F. */
DAL_INLINE void dal_eval_blocks(dal_step *s, double t, const num *q, const num *v, num *out)
{
    s->evaluations++;
    dal_eval(s, DAL_EVAL_BLOCKS, t, q, v, NULL, out);
}

#if DAL_WITH(CONSTRAINT)
/* Without constraints there is no such callback. */
DAL_INLINE void dal_constraint(dal_step *s, double t, const num *q, const num *v, num *out)
{
    if (DAL_M(s) > 0) dal_eval(s, DAL_EVAL_CONSTRAINT, t, q, v, NULL, out);
}
#endif

/* Component i of q or v of the present state, moved by d: y + (r + d). */
DAL_INLINE num dal_moved_q(const dal_step *s, int i, num d) { return s->y[i] + (s->r[i] + d); }
DAL_INLINE num dal_moved_v(const dal_step *s, int i, num d)
{
    return s->y[DAL_N(s) + i] + (s->r[DAL_N(s) + i] + d);
}

#endif
