/* constrained.h - steps that enforce the constraints themselves instead of following F.
 *
 *     q' = v,   v' = a + B lambda,   D(q, v, t) = 0;     a = W^-1 b,   B = W^-1 A^T
 *
 * A method that enforces D at one velocity solves for the increment w of v, and multipliers, with
 *
 *     w = free(w) + N(w) mu,     D(q(w), v + w, t) = 0.
 *
 * Each iteration eliminates the multipliers: they are those for which the constraints hold to first
 * order, so that w alone is iterated (solve.h), and its limit solves both:
 *
 *     (A N) mu = A (w - free) - D,     image = free + N mu
 *
 * Few constraints are a matrix A N of all of them; many are solved by the factors of F.
 *
 * D may be nonlinear, W may depend on q, v, t.  The iteration contracts like h.  Where that is too
 * slow, Newton's matrix is 1 - z P F_v - z^2 P F_q with P = 1 - B G^-1 A at the beginning of the
 * step: the large part of the derivative of an iteration, since P B = 0 and the motion along the
 * constraints is F's.  (For servo constraints B = W^-1 times their own directions.) */
#ifndef DAL_KERNEL_CONSTRAINED_H
#define DAL_KERNEL_CONSTRAINED_H

#include "blocks.h"
#include "solve.h"

/* Lanes that have multipliers of the last step; saves multipliers for the next one. */
DAL_INLINE dal_mask dal_known_multipliers(const dal_step *s)
{
    return dal_less(dal_num(0.5), *s->has_multiplier);
}
DAL_INLINE void dal_save_multipliers(dal_step *s, const num *h)
{
    DAL_EACH(i, DAL_PERSISTENT_MULTIPLIERS(s))
        s->multiplier[i] = dal_select(s->alive, h[i], s->multiplier[i]);
    *s->has_multiplier = dal_select(s->alive, dal_num(1.0), *s->has_multiplier);
}

/* F at the state, in[n], and its multipliers, l of out = y[n], l[m]: A F = -c, so that A y = A F
 * leads to them.  in[n + m + 1]. */
DAL_INLINE void dal_motion_multipliers(dal_step *s, num *in, num *out)
{
    const int n = DAL_N(s), m = DAL_M(s);
    dal_force(s, s->t, s->y, s->y + n, in);
    DAL_EACH(i, m) in[n + i] = dal_num(0.0);
    in[n + m] = dal_num(1.0);
    dal_eval_enforcement(s, s->t, s->y, s->y + n, in, out);
}

/* ---- one velocity ---- */

/* Context of an equation for one velocity, as its first member. */
typedef struct dal_elimination {
    dal_stage_matrix newton; /* Newton's matrix from P F_q and P F_v */
    num *free;               /* [n] free above; the map sets it */
    num *in, *out;   /* of DAL_EVAL_ENFORCEMENT, at in + n first D; at out + n the multipliers */
    num *directions; /* [n*m] N above; the map sets it, of few constraints */
    num *g;          /* 2[m*m], likewise */
} dal_elimination;

/* Whether DAL_EVAL_ENFORCEMENT solves for the multipliers; with fewer constraints it takes longer
 * than a matrix. */
#define DAL_MANY_CONSTRAINTS(s) (DAL_M(s) >= (int)DAL__SPARSE)
/* count where they are few, else 0. */
#define DAL_OF_FEW(s, count) (DAL_MANY_CONSTRAINTS(s) ? 0 : (count))

/* Declares an elimination with its memory; z, a2 as in dal_stage_matrix. */
#define DAL_ELIMINATION(step, name, z, a2)                                                         \
    static const double name##_one = 1.0, name##_a2 = (a2);                                        \
    DAL_VECTOR(step, name##_free, DAL_N(step));                                                    \
    DAL_VECTOR(step, name##_in, DAL_N(step) + DAL_M(step) + 1);                                    \
    DAL_VECTOR(step, name##_out, DAL_N(step) + DAL_M(step));                                       \
    DAL_VECTOR(step, name##_directions, DAL_OF_FEW(step, DAL_N(step) * DAL_M(step)));              \
    DAL_VECTOR(step, name##_g, DAL_OF_FEW(step, 2 * DAL_SQUARE_M(step)));                          \
    dal_elimination name = {{1, (z), &name##_one, &name##_a2, false, NULL},                        \
                            name##_free,                                                           \
                            name##_in,                                                             \
                            name##_out,                                                            \
                            name##_directions,                                                     \
                            name##_g}

#define dal_eliminate_multipliers DAL_WIDE(dal_eliminate_multipliers)
DAL_SHARED void dal_eliminate_multipliers(const dal_step *s, dal_equation *eq,
                                          const num *constraint);
#define dal_eliminate_by_factors DAL_WIDE(dal_eliminate_by_factors)
DAL_SHARED void dal_eliminate_by_factors(dal_step *s, dal_equation *eq, double share, double t,
                                         const num *q, const num *v);
#define dal_constrained_matrix DAL_WIDE(dal_constrained_matrix)
DAL_SHARED void dal_constrained_matrix(dal_step *s, dal_equation *eq);

#ifndef DAL_LINKED
/* x = g^-1 rhs; g[m*m], which is destroyed, has m*m numbers of scratch after it. */
DAL_INLINE void dal__solve_few(const dal_step *s, num *g, int m, const num *rhs, num *x)
{
    num *const inverse = g + m * m;
    if (m == 1)
        inverse[0] = 1.0 / g[0];
    else
        dal_invert_in_units(g, inverse, m, DAL_LEVELS(s), m);
    dal_multiply(inverse, m, m, rhs, x);
}

/* image = free + N mu with the mu for which D + A (image - w) = 0; D and A begin `constraint`. */
DAL_SHARED void dal_eliminate_multipliers(const dal_step *s, dal_equation *eq,
                                          const num *constraint)
{
    const dal_elimination *k = (const dal_elimination *)eq->context;
    const int n = DAL_N(s), m = DAL_M(s);
    const num *A = constraint + dal_blocks_A(s), *w = eq->block[0].u;
    num *const image = eq->block[0].image, *const rhs = k->in + n, *const mu = k->out + n;
    DAL_EACH(i, n) image[i] = k->free[i];
    if (m == 0) return;
    DAL_EACH(i, m) {
        num sum = -constraint[i];
        DAL_EACH(j, n) sum += A[i * n + j] * (w[j] - k->free[j]);
        rhs[i] = sum;
    }
    dal_gram(A, k->directions, m, n, k->g);
    dal__solve_few(s, k->g, m, rhs, mu);
    DAL_EACH(i, n)
        DAL_EACH(j, m) image[i] += k->directions[i * m + j] * mu[j];
}

/* image = free + share y, W y = beta b + B^T l, A y = (A (w - free) - D)/share, all of (q, v, t)
 * but D, which is at in + n; beta is after it, and l stays at out + n. */
DAL_SHARED void dal_eliminate_by_factors(dal_step *s, dal_equation *eq, double share, double t,
                                         const num *q, const num *v)
{
    const dal_elimination *k = (const dal_elimination *)eq->context;
    const int n = DAL_N(s);
    const num per_share = dal_num(1.0 / share), *w = eq->block[0].u;
    DAL_EACH(i, n) k->in[i] = per_share * (w[i] - k->free[i]);
    DAL_EACH(i, DAL_M(s)) k->in[n + i] = -(per_share * k->in[n + i]);
    dal_eval_enforcement(s, t, q, v, k->in, k->out);
    DAL_EACH(i, n) eq->block[0].image[i] = dal_fma(dal_num(share), k->out[i], k->free[i]);
}

/* J <- P J for the n*columns matrix J. */
DAL_INLINE void dal__project_matrix(dal_step *s, const num *blocks, int columns, num *J)
{
    const int n = DAL_N(s), m = DAL_M(s);
    const num *A = blocks + dal_blocks_A(s), *B = blocks + dal_blocks_B(s);
    DAL_VECTOR(s, g, DAL_SQUARE_M(s));
    DAL_VECTOR(s, inverse, DAL_SQUARE_M(s));
    DAL_VECTOR(s, across, DAL_M(s));
    DAL_VECTOR(s, x, DAL_M(s));
    dal_gram(A, B, m, n, g);
    if (m > 0) dal_invert_in_units(g, inverse, m, DAL_LEVELS(s), m);
    for (int c = 0; c < columns; c++) {
        for (int i = 0; i < m; i++) {
            across[i] = dal_num(0.0);
            for (int j = 0; j < n; j++) across[i] += A[i * n + j] * J[j * columns + c];
        }
        dal_multiply(inverse, m, m, across, x);
        for (int j = 0; j < n; j++)
            for (int i = 0; i < m; i++) J[j * columns + c] -= B[j * m + i] * x[i];
    }
}

/* Newton's matrix; the context begins with a dal_stage_matrix. */
DAL_SHARED void dal_constrained_matrix(dal_step *s, dal_equation *eq)
{
    const dal_stage_matrix *k = (const dal_stage_matrix *)eq->context;
    const int n = DAL_N(s);
    DAL_VECTOR(s, blocks, DAL_BLOCKS_SIZE(s));
    DAL_VECTOR(s, jacobian, 2 * DAL_N(s) * DAL_N(s));
    DAL_VECTOR(s, matrix, DAL_STAGES(k) * DAL_N(s) * DAL_STAGES(k) * DAL_N(s));
    dal_eval_blocks(s, s->t, s->y, s->y + n, blocks);
    dal_jacobian(s, 0, s->t, s->y, s->y + n, jacobian);
    dal__project_matrix(s, blocks, n, jacobian);
    dal__project_matrix(s, blocks, n, jacobian + n * n);
    dal_stage_inverse(s, k, jacobian, matrix, &eq->block[0], 0);
}
#endif

/* Eliminates multipliers with D and A of (q, v, t) and N = share B; blocks: of few constraints,
 * those there. */
DAL_INLINE void dal_eliminate_at(dal_step *s, dal_equation *eq, double share, double t,
                                 const num *q, const num *v, const num *blocks)
{
    const dal_elimination *k = (const dal_elimination *)eq->context;
    const int n = DAL_N(s), m = DAL_M(s);
    if (DAL_MANY_CONSTRAINTS(s)) {
        dal_constraint_value(s, t, q, v, k->in + n);
        dal_eliminate_by_factors(s, eq, share, t, q, v);
        return;
    }
    DAL_EACH(i, n * m) k->directions[i] = share * blocks[dal_blocks_B(s) + i];
    dal_eliminate_multipliers(s, eq, blocks);
}

/* Solves an equation for a velocity w, as dal_velocity_equation makes it. */
DAL_INLINE_EARLY dal_status dal_enforce(dal_step *s, dal_equation *eq, dal_iteration_map *map)
{
    return dal_solve(s, eq, map, dal_constrained_matrix);
}
/* The same where the map depends on w through D only, and linearly: one iteration solves. */
DAL_INLINE_EARLY dal_status dal_enforce_once(dal_step *s, dal_equation *eq, dal_iteration_map *map)
{
    eq->active = s->alive;
    map(s, eq);
    DAL_EACH(i, DAL_N(s)) eq->block[0].u[i] = eq->block[0].image[i];
    return DAL_STATUS_OK;
}

/* Whether a and B do not depend on v, and D is linear in v. */
DAL_INLINE bool dal_positional(const dal_step *s)
{
    return (DAL_PROPERTIES(s) & DAL_BLOCKS_POSITIONAL) != 0;
}

/* An equation for the increment w of v, started from w = 0. */
DAL_INLINE dal_equation dal_velocity_equation(const dal_step *s, dal_block block, void *context)
{
    DAL_EQUATION(s, eq, 1, context, block);
    eq.cost = dal_cost_of_newton(s, 1, DAL_N(s), NULL);
    dal_set_speeds(s, &eq.block[0], DAL_N(s));
    eq.block[0].progress->scale = dal_velocity_scale(s, s->h, 0);
    DAL_EACH(i, block.size) eq.block[0].u[i] = dal_num(0.0);
    return eq;
}

#endif
