/* solve.h - implicit equations u = map(u), solved to stagnation at rounding level.
 *
 * Fixed point:          u <- u + d,           d = map(u) - u
 * Simplified Newton:    u <- u + M^-1 d,      M = 1 - map'(u) at the beginning of the step
 *
 * An iteration ends when every block has d = 0, or a d at rounding level that no longer decreases
 * (Hairer, McLachlan, Razakarivony, BIT 48 (2008) 231), or one that twice in a row does not
 * decrease and is small: not at a tolerance.  "Small" only tells stagnation from divergence.  Each
 * lane ends by itself and is then left alone, so its bits do not depend on its neighbours.  To see
 * what the solver does to a run one can ask it to end earlier (DAL_SOLVE_TO) or to iterate on
 * (DAL_EXTRA_SWEEPS).
 *
 * With the solver "auto" a lane whose fixed point contracts more slowly than DAL__SLOW, or not at
 * all, goes over to Newton and stays there (step->stiff, which is carried along). */
#ifndef DAL_KERNEL_SOLVE_H
#define DAL_KERNEL_SOLVE_H

/* Newton pays from this rate on: a fixed point needs 36/log2(1/rate) sweeps. */
#define DAL__SLOW 0.3
/* Increments against the size of the state: rounding, stagnation, and where no rate is measured. */
#define DAL__ROUNDING (1.4e-14 * DAL_FINER)
#define DAL__SMALL    (1e-12 * DAL_FINER)
#define DAL__NOISE    (1e-12 * DAL_FINER)

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

typedef struct dal_equation {
    dal_block block[2];
    int blocks; /* 1 or 2 */
    void *context;
    dal_mask active; /* the lanes that still iterate */
} dal_equation;

/* What a map keeps beside the image for the end of the step is that of a lane's own last sweep: the
 * sweeps its neighbours still need do not touch it. */
#if DAL_LANES == 1
#define DAL_KEEP(active, fresh, kept) (fresh)
#else
#define DAL_KEEP(active, fresh, kept) dal_select(active, fresh, kept)
#endif

typedef void dal_map(dal_step *step, dal_equation *equation);          /* u -> image, all blocks */
typedef dal_status dal_matrix(dal_step *step, dal_equation *equation); /* fills inverse */

/* Declares a block of count unknowns with its memory; newton: it may get an inverse. */
#define DAL_BLOCK(step, name, count, newton)                                                       \
    DAL_VECTOR(step, name##_u, count);                                                             \
    DAL_VECTOR(step, name##_image, count);                                                         \
    DAL_VECTOR(step, name##_start, count);                                                         \
    DAL_VECTOR(step, name##_inverse, (newton) ? (count) * (count) : 0);                            \
    dal_block name = {(count), name##_u,     name##_image, name##_start, name##_inverse,           \
                      1.0,     dal_num(0.0), dal_num(0.0), dal_num(0.0), dal_num(0.0)}

/* Sizes of the state for blocks that move v or pi: what rounding in q or p can do to them within a
 * step that contracts. */
DAL_INLINE num dal_velocity_scale(const dal_step *s, double h)
{
    return dal_max_norm(s->y + DAL_N(s), DAL_NW(s)) +
           dal_max_norm(s->y, DAL_N(s)) / dal_num(fabs(h));
}
DAL_INLINE num dal_momentum_scale(const dal_step *s, double h)
{
    return dal_max_norm(s->y + dal_at_pi(s), DAL_N(s)) +
           fabs(h) * dal_max_norm(s->y + dal_at_p(s), DAL_N(s));
}

#if DAL_LANES == 1 && !defined DAL_SPECIALISED && !defined DAL_LONG
/* image -= u, u += image; norm and poison of what is then in image. */
DAL_INLINE int dal__advance_packs(num *u, num *image, int count, num *norm, num *poison)
{
    dal__pack sum = {0};
    int i = 0;
    for (; i + DAL__PACK <= count; i += DAL__PACK) {
        dal__pack *v = (dal__pack *)(u + i), *d = (dal__pack *)(image + i);
        *d -= *v;
        sum += *d - *d;
        *v += *d;
    }
    for (int j = 0; j < DAL__PACK; j++) *poison += sum[j];
    dal__norm_packs(image, i, norm);
    return i;
}
#else
#define dal__advance_packs(u, image, count, norm, poison) 0
#endif

/* u += d (or M^-1 d) in the active lanes; b->now: the norm of the increment, NaN if not finite.  A
 * pack belongs to one lane, which is active or nobody would call. */
DAL_INLINE void dal__advance(dal_block *b, dal_mask active, int newton)
{
    num norm = dal_num(0.0), poison = dal_num(0.0);
    const int seen = newton ? 0 : dal__advance_packs(b->u, b->image, b->size, &norm, &poison);
    num *u = b->u + seen, *image = b->image + seen;
    DAL_EACH(i, b->size - seen) image[i] -= u[i];
    DAL_EACH(i, b->size - seen) {
        num d = image[i];
        if (newton) dal_multiply(b->inverse + i * b->size, 1, b->size, image, &d);
        norm = dal_max(norm, dal_abs(d));
        poison += d - d;
        u[i] = dal_select(active, u[i] + d, u[i]);
    }
    b->before = b->now;
    b->now = b->weight * norm + poison;
}

/* Lanes where a block's increment is zero or stagnates, or is as small as was asked for. */
DAL_INLINE dal_mask dal__quiet(const dal_step *s, dal_block *b)
{
    const num size = b->scale + b->weight * dal_max_norm(b->u, b->size);
    b->stalls = dal_select(dal_less_equal(b->before, b->now), b->stalls + 1.0, dal_num(0.0));
    const dal_mask once = dal_less(dal_num(0.5), b->stalls),
                   twice = dal_less(dal_num(1.5), b->stalls);
    const dal_mask stagnates = dal_equal(b->now, dal_num(0.0)) |
                               (once & dal_less_equal(b->now, DAL__ROUNDING * size)) |
                               (twice & dal_less_equal(b->now, DAL__SMALL * size));
    if (DAL_RARELY(DAL_SOLVE_TO(s) > 0.0))
        return stagnates | dal_less_equal(b->now, DAL_SOLVE_TO(s) * size);
    return stagnates;
}

DAL_INLINE dal_mask dal__slow(const dal_block *b)
{
    return dal_less(DAL__SLOW * b->before, b->now) &
           dal_less(DAL__NOISE * (b->scale + b->weight * dal_max_norm(b->u, b->size)), b->now);
}

DAL_INLINE void dal__begin_block(dal_block *b)
{
    b->now = dal_num(INFINITY);
    b->stalls = dal_num(0.0);
}

/* Takes the new image into a block; lanes that are now quiet, and lanes that are still finite. */
DAL_INLINE void dal__sweep(const dal_step *s, dal_block *b, dal_mask active, int newton,
                           dal_mask *quiet, dal_mask *finite)
{
    dal__advance(b, active, newton);
    *quiet &= dal__quiet(s, b);
    *finite &= dal_finite(b->now);
}

/* The sweeps that were asked for beyond the solution. */
DAL_INLINE void dal__sweep_on(dal_step *s, dal_equation *eq, dal_map *map, dal_mask lanes,
                              int newton)
{
    eq->active = lanes;
    for (int k = 0; k < DAL_EXTRA_SWEEPS(s) && dal_any(lanes); k++) {
        map(s, eq);
        dal__advance(&eq->block[0], lanes, newton);
        if (eq->blocks > 1) dal__advance(&eq->block[1], lanes, newton);
    }
}

/* Iterates in the given lanes; returns those that stagnated.  *slow receives lanes that were given
 * up after the third sweep because they contract slowly, if they may be. */
DAL_INLINE dal_mask dal__iterate(dal_step *s, dal_equation *eq, dal_map *map, dal_mask lanes,
                                 int newton, int may_give_up, dal_mask *slow)
{
    dal_mask active = lanes;
    dal__begin_block(&eq->block[0]);
    if (eq->blocks > 1) dal__begin_block(&eq->block[1]);
    for (int k = 0; k < DAL_ITERATIONS(s) && dal_any(active); k++) {
        dal_mask quiet = dal_all(), finite = dal_all();
        eq->active = active;
        map(s, eq);
        dal__sweep(s, &eq->block[0], active, newton, &quiet, &finite);
        if (eq->blocks > 1) dal__sweep(s, &eq->block[1], active, newton, &quiet, &finite);
        if (may_give_up && (k == 1 || k == 2)) {
            *slow |= active & dal__slow(&eq->block[0]);
            finite &= ~*slow;
        }
        lanes &= finite | ~active;
        active &= finite & ~quiet;
    }
    lanes &= ~active;
    if (DAL_RARELY(DAL_EXTRA_SWEEPS(s) > 0)) dal__sweep_on(s, eq, map, lanes, newton);
    return lanes;
}

DAL_INLINE void dal__remember(dal_block *b)
{
    DAL_EACH(i, b->size) b->start[i] = b->u[i];
}
DAL_INLINE void dal__return(dal_block *b, dal_mask lanes)
{
    DAL_EACH(i, b->size) b->u[i] = dal_select(lanes, b->start[i], b->u[i]);
}

/* Solves the equation from the guess in u; lanes that fail are recorded and no longer alive.
 * Without a matrix (NULL) there is no Newton. */
DAL_INLINE dal_status dal_solve(dal_step *s, dal_equation *eq, dal_map *map, dal_matrix *matrix)
{
    const int may_newton = matrix && DAL_MAY_NEWTON(s);
    dal_mask stiff = dal_less(dal_num(0.5), *s->stiff);
    if (!may_newton) stiff &= ~dal_all();
    if (may_newton && DAL_SOLVER(s) == DAL_NEWTON) stiff = dal_all();
    dal__remember(&eq->block[0]);
    if (eq->blocks > 1) dal__remember(&eq->block[1]);

    dal_mask slow = ~dal_all();
    dal_mask solved = dal__iterate(s, eq, map, s->alive & ~stiff, 0, may_newton, &slow);
    const dal_mask left = s->alive & ~solved;
    if (may_newton && dal_any(left)) {
        dal__return(&eq->block[0], left);
        if (eq->blocks > 1) dal__return(&eq->block[1], left);
        DAL_TRY(matrix(s, eq));
        solved |= dal__iterate(s, eq, map, left, 1, 0, &slow);
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
    return j < DAL_N(s) ? jacobian[i * DAL_N(s) + j] : dal_num(0.0);
}
DAL_INLINE num dal__fv(const dal_step *s, const num *jacobian, int i, int j)
{
    return jacobian[DAL_NW(s) * DAL_N(s) + i * DAL_NW(s) + j];
}

/* Fills block->inverse; m is scratch, [size*size]. */
DAL_INLINE void dal_stage_inverse(dal_step *s, const dal_stage_matrix *k, const num *jacobian,
                                  num *m, dal_block *block)
{
    const int width = block->size / k->stages, size = block->size;
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
    dal_invert(m, block->inverse, size);
}

/* F_q, F_(v,g) at a point, [nw*n + nw*nw]. */
DAL_INLINE void dal_jacobian(dal_step *s, double t, const num *q, const num *v, num *out)
{
    dal_ask(s, DAL_ASK_JACOBIAN, t, q, v, NULL, out);
}

#endif
