/* solve.h - implicit equations u = map(u), solved to stagnation at rounding level.
 *
 * Fixed point:          u <- u + d,           d = map(u) - u
 * Simplified Newton:    u <- u + M^-1 d,      M = 1 - map'(u) at the beginning of the step
 *
 * An iteration ends when every block has d = 0, or a d at rounding level that no longer decreases
 * (Hairer, McLachlan, Razakarivony, BIT 48 (2008) 231), or one that twice in a row does not
 * decrease and is small: not at a tolerance.  "Small" only tells stagnation from divergence.  Each
 * lane ends by itself and is then left alone, so its bits do not depend on its neighbours.
 *
 * With the solver "auto" a lane whose fixed point contracts more slowly than DAL__SLOW, or not at
 * all, goes over to Newton and stays there (step->stiff, which is carried along). */
#ifndef DAL_KERNEL_SOLVE_H
#define DAL_KERNEL_SOLVE_H

/* Newton pays from this rate on: a fixed point needs 36/log2(1/rate) sweeps. */
#define DAL__SLOW 0.3
/* Increments against the size of the state: rounding, stagnation, and where no rate is measured. */
#define DAL__ROUNDING 1.4e-14
#define DAL__SMALL    1e-12
#define DAL__NOISE    1e-12

/* One block of unknowns, [size]. */
typedef struct dal_block {
    int size;
    num *u, *image;  /* the unknowns; what map made of them */
    num *start;      /* [size] a copy of the first guess, for a second attempt */
    num *inverse;    /* [size*size] M^-1, Newton only */
    double weight;   /* a change of u by d moves the state by weight*d */
    num scale;       /* size of the state it moves */
    num now, before; /* norms of the last two increments */
    num stalls;      /* how often in a row the norm did not decrease */
} dal_block;

typedef struct dal_equation dal_equation;
struct dal_equation {
    dal_block block[2];
    int blocks;
    void (*map)(dal_step *step, dal_equation *equation); /* u -> image, all blocks */
    dal_status (*matrix)(dal_step *step,
                         dal_equation *equation); /* fills inverse; NULL: no Newton */
    void *context;
};

DAL_INLINE num dal_max_norm(const num *x, int count)
{
    num norm = dal_num(0.0);
    for (int i = 0; i < count; i++) norm = dal_max(norm, dal_abs(x[i]));
    return norm;
}

/* Sizes of the state for blocks that move v or pi: what rounding in q or p can do to them within a
 * step that contracts. */
DAL_INLINE num dal_velocity_scale(const dal_step *s, double h)
{
    return dal_max_norm(s->y + s->n, s->nw) + dal_max_norm(s->y, s->n) / dal_num(fabs(h));
}
DAL_INLINE num dal_momentum_scale(const dal_step *s, double h)
{
    return dal_max_norm(s->y + dal_at_pi(s), s->n) +
           fabs(h) * dal_max_norm(s->y + dal_at_p(s), s->n);
}

/* Gives a block its memory. */
DAL_INLINE dal_status dal_block_init(dal_step *s, dal_block *b, int size, double weight, num scale)
{
    DAL_VECTOR(s, u, size);
    DAL_VECTOR(s, image, size);
    DAL_VECTOR(s, start, size);
    *b = (dal_block){.size = size, .u = u, .image = image, .start = start, .weight = weight};
    b->scale = scale;
    return DAL_OK;
}

/* u += d (or M^-1 d) in the active lanes; b->now: the norm of the increment, NaN if not finite. */
DAL_INLINE void dal__advance(dal_block *b, dal_mask active, int newton)
{
    num norm = dal_num(0.0), poison = dal_num(0.0);
    for (int i = 0; i < b->size; i++) b->image[i] -= b->u[i];
    for (int i = 0; i < b->size; i++) {
        num d = b->image[i];
        if (newton) dal_multiply(b->inverse + i * b->size, 1, b->size, b->image, &d);
        norm = dal_max(norm, dal_abs(d));
        poison += d - d;
        b->u[i] = dal_select(active, b->u[i] + d, b->u[i]);
    }
    b->before = b->now;
    b->now = b->weight * norm + poison;
}

/* Lanes where a block's increment is zero or stagnates. */
DAL_INLINE dal_mask dal__quiet(dal_block *b)
{
    const num size = b->scale + b->weight * dal_max_norm(b->u, b->size);
    b->stalls = dal_select(dal_less_equal(b->before, b->now), b->stalls + 1.0, dal_num(0.0));
    const dal_mask once = dal_less(dal_num(0.5), b->stalls),
                   twice = dal_less(dal_num(1.5), b->stalls);
    return dal_equal(b->now, dal_num(0.0)) | (once & dal_less_equal(b->now, DAL__ROUNDING * size)) |
           (twice & dal_less_equal(b->now, DAL__SMALL * size));
}

DAL_INLINE dal_mask dal__slow(const dal_block *b)
{
    return dal_less(DAL__SLOW * b->before, b->now) &
           dal_less(DAL__NOISE * (b->scale + b->weight * dal_max_norm(b->u, b->size)), b->now);
}

/* Iterates in the given lanes; returns those that stagnated.  *slow (unless NULL) receives lanes
 * that were given up after the third sweep because they contract slowly. */
DAL_INLINE dal_mask dal__iterate(dal_step *s, dal_equation *eq, dal_mask lanes, int newton,
                                 dal_mask *slow)
{
    dal_mask active = lanes;
    for (int b = 0; b < eq->blocks; b++) {
        eq->block[b].now = dal_num(INFINITY);
        eq->block[b].stalls = dal_num(0.0);
    }
    for (int k = 0; k < s->iterations && dal_any(active); k++) {
        eq->map(s, eq);
        dal_mask quiet = dal_all(), finite = dal_all();
        for (int b = 0; b < eq->blocks; b++) {
            dal__advance(&eq->block[b], active, newton);
            quiet &= dal__quiet(&eq->block[b]);
            finite &= dal_finite(eq->block[b].now);
        }
        if (slow && (k == 1 || k == 2)) {
            *slow |= active & dal__slow(&eq->block[0]);
            finite &= ~*slow;
        }
        lanes &= finite | ~active;
        active &= finite & ~quiet;
    }
    return lanes & ~active;
}

/* Solves the equation from the guess in u; lanes that fail are recorded and no longer alive. */
DAL_INLINE dal_status dal_solve(dal_step *s, dal_equation *eq)
{
    const int may_newton = eq->matrix && s->has_jacobian && s->solver != DAL_FIXED_POINT;
    dal_mask stiff = dal_less(dal_num(0.5), *s->stiff);
    if (!may_newton) stiff &= ~dal_all();
    if (may_newton && s->solver == DAL_NEWTON) stiff = dal_all();
    for (int b = 0; b < eq->blocks; b++)
        memcpy(eq->block[b].start, eq->block[b].u, (size_t)eq->block[b].size * sizeof(num));

    dal_mask slow = ~dal_all();
    dal_mask solved = dal__iterate(s, eq, s->alive & ~stiff, 0, may_newton ? &slow : NULL);
    const dal_mask left = s->alive & ~solved;
    if (may_newton && dal_any(left)) {
        for (int b = 0; b < eq->blocks; b++)
            for (int i = 0; i < eq->block[b].size; i++)
                eq->block[b].u[i] = dal_select(left, eq->block[b].start[i], eq->block[b].u[i]);
        DAL_TRY(eq->matrix(s, eq));
        solved |= dal__iterate(s, eq, left, 1, NULL);
        *s->stiff = dal_select(left & solved, dal_num(1.0), *s->stiff);
    }
    s->unconverged |= s->alive & ~solved;
    s->alive &= solved;
    return dal_any(s->alive) ? DAL_OK : DAL_NOT_CONVERGED;
}

/* The matrix of stage equations for frozen F_q, F_v (jacobian as dal_callbacks):
 *     M_ij = delta_ij 1 - z a_ij F_v - z^2 a2_ij [F_q 0]           i, j = 1..stages
 * and its inverse, [size*size] with size = stages*width; transposed: F_q^T, F_v^T, n*n each.
 * a2 is a squared (q moves with v), or 0 where q does not. */
typedef struct dal_stage_matrix {
    int stages;
    double z;
    const double *a, *a2; /* [stages*stages] */
    int transposed;
} dal_stage_matrix;

/* Entry (i, j) of F_q padded with zeros, and of F_(v,g); or of their transposes. */
DAL_INLINE num dal__fq(const dal_step *s, const num *jacobian, int i, int j)
{
    return j < s->n ? jacobian[i * s->n + j] : dal_num(0.0);
}
DAL_INLINE num dal__fv(const dal_step *s, const num *jacobian, int i, int j)
{
    return jacobian[s->nw * s->n + i * s->nw + j];
}

DAL_INLINE dal_status dal_stage_inverse(dal_step *s, const dal_stage_matrix *k, const num *jacobian,
                                        dal_block *block)
{
    const int width = block->size / k->stages, size = block->size;
    DAL_VECTOR(s, inverse, size * size);
    const size_t mark = s->used;
    DAL_VECTOR(s, m, size * size);
    for (int row = 0; row < size; row++) {
        for (int column = 0; column < size; column++) {
            const int i = row % width, j = column % width;
            const int x = k->transposed ? j : i, y = k->transposed ? i : j;
            const int stage = row / width * k->stages + column / width;
            m[row * size + column] = (row == column) -
                                     k->z * k->a[stage] * dal__fv(s, jacobian, x, y) -
                                     k->z * k->z * k->a2[stage] * dal__fq(s, jacobian, x, y);
        }
    }
    dal_invert(m, inverse, size);
    block->inverse = inverse;
    s->used = mark;
    return DAL_OK;
}

/* F_q, F_(v,g) at a point, [nw*n + nw*nw]. */
DAL_INLINE void dal_jacobian(dal_step *s, double t, const num *q, const num *v, num *out)
{
    s->ask(s, DAL_ASK_JACOBIAN, t, q, v, NULL, out);
}

#endif
