/* solve.h - implicit equations u = map(u), solved to stagnation at rounding level.
 *
 * Fixed point:          u <- u + d,           d = map(u) - u
 * Simplified Newton:    u <- u + M^-1 d,      M = 1 - map'(u) at the beginning of the step
 *
 * The iteration ends, not at a tolerance, when every block has
 *   - d = 0, or
 *   - d at rounding level that no longer decreases (Hairer, McLachlan, Razakarivony, BIT 48 (2008)
 *     231), or
 *   - a small d that twice in a row does not decrease ("small" excludes divergence),
 *   - a d below what the equation says is enough: of an iteration that converges quadratically.
 * After several iterations two more ends count: d far below rounding level (components smaller than
 * the rounding of others may let d decrease without end), and a small d that several iterations
 * have not decreased (cycles of roundings).  Each lane ends by itself and is then left alone, so
 * its bits do not depend on its neighbours.  For experiments DAL_SOLVER_TOLERANCE ends the
 * iteration earlier, DAL_EXTRA_ITERATIONS continues it.
 *
 * Groups of lanes that are stepped as one system (DAL_STEP_GROUPS) have norms and masks of their
 * own.
 *
 * With the solver "auto" each lane chooses between the two by what they cost, see choice.h. */
#ifndef DAL_KERNEL_SOLVE_H
#define DAL_KERNEL_SOLVE_H

#include "choice.h"
#include "eigensystem.h"

enum { DAL_MAX_STAGES = 16 };

/* A fixed point whose third increment is not below this share of the second is given up. */
#define DAL__SLOW_CONTRACTION 0.9
/* Increments relative to the state: rounding, stagnation, too small to measure a rate. */
#define DAL__ROUNDING (1.4e-14 * DAL_ULP_RATIO)
#define DAL__SMALL    (1e-12 * DAL_ULP_RATIO)
#define DAL__NOISE    (1e-12 * DAL_ULP_RATIO)
/* From iteration MANY on an increment below FAINT is enough, from twice that on one below
 * LATE_FAINT; so is one below CYCLE_SIZE after CYCLE_LENGTH iterations without a smaller one. */
#define DAL__MANY_ITERATIONS 8
#define DAL__FAINT           (1e-17 * DAL_ULP_RATIO)
#define DAL__LATE_FAINT      (1e-16 * DAL_ULP_RATIO)
#define DAL__CYCLE_LENGTH    6
#define DAL__CYCLE_SIZE      (1e-10 * DAL_ULP_RATIO)

/* One block of unknowns, [size]. */
typedef struct dal_block {
    num scale[DAL_STEP_GROUPS];                        /* size of the state it moves */
    num now[DAL_STEP_GROUPS], before[DAL_STEP_GROUPS]; /* norms of the last two increments */
    num stagnations[DAL_STEP_GROUPS];   /* successive iterations without decrease of the norm */
    num best[2][DAL_STEP_GROUPS];       /* the min norm, and the iterations since then */
    double weight;                      /* a change of u by d moves the state by weight*d */
    int size;                           /* unknowns */
    num *u, *image;                     /* the unknowns; what map made of them */
    num *start;                         /* [size] a copy of the first guess, for a second attempt */
    num *inverse;                       /* [size*size] M^-1 (of each group), Newton only */
    num *scratch;                       /* [3*size], Newton only */
    const dal_eigensystem *eigensystem; /* inverse holds the inverses of N_e; NULL: M^-1 */
    int stages;                         /* with an eigensystem */
    const double *unit;                 /* [width] of the unknowns, again and again; NULL: equal */
    int width;                          /* units before they repeat */
    double enough; /* an increment of this share of the state ends the iteration; 0: see above */
} dal_block;

/* An implicit equation u = map(u), of one or two blocks. */
typedef struct dal_equation {
    dal_block block[2];               /* the unknowns */
    int blocks;                       /* 1 or 2 */
    void *context;                    /* of the map */
    dal_mask active[DAL_STEP_GROUPS]; /* the lanes that still iterate */
    num taken[DAL_STEP_GROUPS];       /* with the solver auto: iterations of each lane, */
    num limit[DAL_STEP_GROUPS];       /* and how many the fixed point may take; */
    dal_newton_cost cost;             /* and of Newton's method */
    int follows; /* 1: takes the method that other equations of the step chose */
} dal_equation;

/* A map may store values for the end of the step: of a lane's own last iteration, which
 * further iterations of its neighbours do not change. */
#if DAL_SCALAR
#define DAL_IF_ACTIVE(active, fresh, old) (fresh)
#else
#define DAL_IF_ACTIVE(active, fresh, old) dal_select(active, fresh, old)
#endif

/* Computes the image of u, for all blocks. */
typedef void dal_iteration_map(dal_step *step, dal_equation *equation);
/* Computes the inverse of Newton's matrix, for all blocks. */
typedef void dal_matrix(dal_step *step, dal_equation *equation);

/* The size of a block.  Compilers do not see the constant where several groups are stepped as one
 * system; such a file has blocks of one size only. */
#ifdef DAL_SPECIALISED
#define DAL_SIZE(b)                                                                                \
    (DAL_STEP_GROUPS > 1 ? DAL_FIXED_STAGES * DAL_FIXED_NW * DAL_STEP_GROUPS : (b)->size)
#else
#define DAL_SIZE(b) ((b)->size)
#endif

/* Declares a block of count unknowns with its memory; newton: with an inverse.  Its members have no
 * names here, since generated files are C++17, too. */
#define DAL_BLOCK(step, name, count, newton)                                                       \
    DAL_VECTOR(step, name##_u, count);                                                             \
    DAL_VECTOR(step, name##_image, count);                                                         \
    DAL_VECTOR(step, name##_start, count);                                                         \
    DAL_VECTOR(step, name##_inverse, (newton) ? (count) * (count) / DAL_STEP_GROUPS : 0);          \
    DAL_VECTOR(step, name##_scratch, (newton) ? 3 * (count) : 0);                                  \
    dal_block name = {{dal_num(0.0)},                                                              \
                      {dal_num(0.0)},                                                              \
                      {dal_num(0.0)},                                                              \
                      {dal_num(0.0)},                                                              \
                      {{dal_num(0.0)}},                                                            \
                      1.0,                                                                         \
                      (count),                                                                     \
                      name##_u,                                                                    \
                      name##_image,                                                                \
                      name##_start,                                                                \
                      name##_inverse,                                                              \
                      name##_scratch,                                                              \
                      NULL,                                                                        \
                      1,                                                                           \
                      NULL,                                                                        \
                      1,                                                                           \
                      0.0}

/* Declares an equation of `count` blocks; where Newton's method may solve it, its cost is set. */
#define DAL_EQUATION(name, count, context, ...)                                                    \
    dal_equation name = {{__VA_ARGS__},  (count),        (context),  {dal_all()},                  \
                         {dal_num(0.0)}, {dal_num(0.0)}, {0.0, 0.0}, 0}

DAL_INLINE int dal__any_group(const dal_mask *lanes)
{
    dal_mask some = lanes[0];
    DAL_EACH(j, DAL_STEP_GROUPS - 1) some |= lanes[j + 1];
    return dal_any(some);
}

/* The units of a block.  Compilers see in files without units that there are none. */
#ifdef DAL_SPECIALISED
#define DAL_BLOCK_UNIT(b) (DAL_FIXED_SPEEDS ? (b)->unit : NULL)
#else
#define DAL_BLOCK_UNIT(b) ((b)->unit)
#endif

/* The max norm over group j, in units[width] that repeat; NULL: 1. */
DAL_INLINE num dal__group_norm(const num *x, int count, const double *unit, int width, int j)
{
    if (DAL_STEP_GROUPS == 1 && !unit) return dal_max_norm(x, count);
    const int all = count / DAL_STEP_GROUPS, period = unit ? width : all;
    num norm = dal_num(0.0);
    for (int first = 0; first < all; first += period)
        DAL_EACH(i, period)
            norm =
                dal_max(norm, dal_abs(dal_in_units(x[(first + i) * DAL_STEP_GROUPS + j], unit, i)));
    return norm;
}
DAL_INLINE num dal__block_norm(const dal_block *b, const num *x, int j)
{
    return dal__group_norm(x, DAL_SIZE(b), DAL_BLOCK_UNIT(b), b->width, j);
}

/* Sizes of a group's state for blocks that move v or pi, with the effect of rounding in q or p
 * within a step that contracts. */
DAL_INLINE num dal_velocity_scale(const dal_step *s, double h, int group)
{
    const double *unit = DAL_SPEEDS(s);
    const int n = DAL_N(s), nw = DAL_NW(s);
    return dal__group_norm(s->y + n, nw, unit, nw / DAL_STEP_GROUPS, group) +
           dal__group_norm(s->y, n, unit, n / DAL_STEP_GROUPS, group) / dal_num(fabs(h));
}
/* The max norm of a velocity of all lanes, v[n]. */
DAL_INLINE num dal_speed_norm(const dal_step *s, const num *v)
{
    return dal__group_norm(v, DAL_N(s), DAL_SPEEDS(s), DAL_N(s), 0);
}
/* Declares the unknowns of a block velocities, or their rates, of count numbers each stage. */
DAL_INLINE void dal_set_speeds(const dal_step *s, dal_block *b, int count)
{
    b->unit = DAL_SPEEDS(s);
    b->width = count / DAL_STEP_GROUPS;
}
DAL_INLINE num dal_momentum_scale(const dal_step *s, double h, int group)
{
    return dal__group_norm(s->y + dal_at_pi(s), DAL_N(s), NULL, 1, group) +
           fabs(h) * dal__group_norm(s->y + dal_at_p(s), DAL_N(s), NULL, 1, group);
}

#define dal_solve DAL_WIDE(dal_solve)
DAL_SHARED_EARLY dal_status dal_solve(dal_step *s, dal_equation *eq, dal_iteration_map *map,
                                      dal_matrix *matrix);

#ifndef DAL_LINKED
#if DAL_PACKS
/* image -= u, u += image; norm: of image; nonfinite: NaN unless image is finite. */
DAL_INLINE int dal__advance_packs(num *u, num *image, int count, num *norm, num *nonfinite)
{
    dal__pack sum = {0};
    int i = 0;
    for (; i + DAL__PACK <= count; i += DAL__PACK) {
        dal__pack *v = (dal__pack *)(u + i), *d = (dal__pack *)(image + i);
        *d -= *v;
        sum += *d - *d;
        *v += *d;
    }
    for (int j = 0; j < DAL__PACK; j++) *nonfinite += sum[j];
    dal__norm_packs(image, i, norm);
    return i;
}
#else
#define dal__advance_packs(u, image, count, norm, nonfinite) 0
#endif

/* image <- M^-1 image, in group j. */
DAL_INLINE void dal__apply_inverse(const dal_step *s, dal_block *b, int j)
{
    const int rows = DAL_SIZE(b) / DAL_STEP_GROUPS;
    const num *inverse = b->inverse + j * rows * rows;
    num *const image = b->image + j;
    if (b->eigensystem) {
        dal_apply_eigensystem(b->eigensystem, DAL_STAGES(b), DAL_NW(s) / DAL_STEP_GROUPS, inverse,
                              image, DAL_STEP_GROUPS, b->scratch);
        return;
    }
    for (int i = 0; i < rows; i++) {
        num sum = dal_num(0.0);
        for (int k = 0; k < rows; k++)
            sum = dal_fma(inverse[i * rows + k], image[k * DAL_STEP_GROUPS], sum);
        b->scratch[i] = sum;
    }
    for (int i = 0; i < rows; i++) image[i * DAL_STEP_GROUPS] = b->scratch[i];
}

/* u += d (or M^-1 d) in the active lanes; b->now: the norm of the increment, NaN if not finite.
 * Packs exist for one lane only, which is then active. */
DAL_INLINE void dal__advance(const dal_step *s, dal_block *b, const dal_mask *active, int newton)
{
    num norm[DAL_STEP_GROUPS], nonfinite[DAL_STEP_GROUPS];
    DAL_EACH(j, DAL_STEP_GROUPS) norm[j] = nonfinite[j] = dal_num(0.0);
    const int seen = newton ? 0 : dal__advance_packs(b->u, b->image, DAL_SIZE(b), norm, nonfinite);
    num *u = b->u + seen, *image = b->image + seen;
    DAL_EACH(i, DAL_SIZE(b) - seen) image[i] -= u[i];
    if (newton)
        DAL_EACH(j, DAL_STEP_GROUPS) dal__apply_inverse(s, b, j);
    DAL_EACH(i, DAL_SIZE(b) - seen) {
        const int j = i % DAL_STEP_GROUPS;
        const num d = image[i];
        norm[j] = dal_max(norm[j], dal_abs(d));
        nonfinite[j] += d - d;
        u[i] = dal_select(active[j], u[i] + d, u[i]);
    }
    if (DAL_BLOCK_UNIT(b) != NULL)
        DAL_EACH(j, DAL_STEP_GROUPS) norm[j] = dal__block_norm(b, b->image, j);
    DAL_EACH(j, DAL_STEP_GROUPS) {
        b->before[j] = b->now[j];
        b->now[j] = b->weight * norm[j] + nonfinite[j];
    }
}

DAL_INLINE num dal__size(const dal_block *b, int j)
{
    return b->scale[j] + b->weight * dal__block_norm(b, b->u, j);
}

/* Lanes where an increment is zero, or small enough after several iterations. */
DAL_INLINE dal_mask dal__negligible(dal_block *b, int j, int k, num now, num size)
{
    const double faint = k < DAL__MANY_ITERATIONS       ? 0.0
                         : k < 2 * DAL__MANY_ITERATIONS ? DAL__FAINT
                                                        : DAL__LATE_FAINT;
    const double cycle = k < DAL__MANY_ITERATIONS ? 0.0 : DAL__CYCLE_SIZE;
    num *min = &b->best[0][j], *since = &b->best[1][j];
    const dal_mask less = dal_less(now, *min);
    *min = dal_select(less, now, *min);
    *since = dal_select(less, dal_num(0.0), *since + 1.0);
    return dal_less_equal(now, faint * size) |
           (dal_less_equal(now, cycle * size) & dal_less(dal_num(DAL__CYCLE_LENGTH - 0.5), *since));
}

/* Lanes of a group where the increment of iteration k is zero, stagnates, or is below the
 * tolerance.  A single lane with its smallest increment yet, the usual case, is decided first:
 * the size of the state is not needed there. */
DAL_INLINE dal_mask dal__converged(const dal_step *s, dal_block *b, int j, int k)
{
    const num now = b->now[j];
    if (DAL_LANES == 1 && k < DAL__MANY_ITERATIONS && !(DAL_SOLVER_TOLERANCE(s) > 0.0) &&
        !(b->enough > 0.0) && dal_any(dal_less(dal_num(0.0), now)) &&
        dal_any(dal_less(now, b->best[0][j]))) {
        b->best[0][j] = now;
        b->best[1][j] = b->stagnations[j] = dal_num(0.0);
        return ~dal_all();
    }
    const num size = dal__size(b, j);
    b->stagnations[j] =
        dal_select(dal_less_equal(b->before[j], now), b->stagnations[j] + 1.0, dal_num(0.0));
    const dal_mask once = dal_less(dal_num(0.5), b->stagnations[j]),
                   twice = dal_less(dal_num(1.5), b->stagnations[j]);
    const dal_mask stagnates =
        dal__negligible(b, j, k, now, size) | (once & dal_less_equal(now, DAL__ROUNDING * size)) |
        (twice & dal_less_equal(now, DAL__SMALL * size)) | dal_less_equal(now, b->enough * size);
    if (DAL_RARELY(DAL_SOLVER_TOLERANCE(s) > 0.0))
        return stagnates | dal_less_equal(now, DAL_SOLVER_TOLERANCE(s) * size);
    return stagnates;
}

DAL_INLINE dal_mask dal__slow(const dal_block *b, int j)
{
    const dal_mask slow = dal_less(DAL__SLOW_CONTRACTION * b->before[j], b->now[j]);
    if (!dal_any(slow)) return slow;
    return slow & dal_less(DAL__NOISE * dal__size(b, j), b->now[j]);
}

DAL_INLINE void dal__begin_block(dal_block *b)
{
    DAL_EACH(j, DAL_STEP_GROUPS) b->now[j] = dal_num(INFINITY);
    DAL_EACH(j, DAL_STEP_GROUPS) b->stagnations[j] = dal_num(0.0);
    DAL_EACH(j, DAL_STEP_GROUPS) b->best[0][j] = dal_num(INFINITY);
    DAL_EACH(j, DAL_STEP_GROUPS) b->best[1][j] = dal_num(0.0);
}

/* One iteration of all blocks in the active lanes. */
DAL_INLINE_EARLY void dal__iterate_once(dal_step *s, dal_equation *eq, dal_iteration_map *map,
                                        int newton)
{
    map(s, eq);
    dal__advance(s, &eq->block[0], eq->active, newton);
    if (eq->blocks > 1) dal__advance(s, &eq->block[1], eq->active, newton);
}

/* Lanes in which the fixed point is given up after iteration k. */
DAL_INLINE dal_mask dal__gives_up(const dal_equation *eq, int j, int k)
{
    dal_mask reasons = dal_less(eq->limit[j], eq->taken[j] + 0.5);
    if (k == 2) reasons |= dal__slow(&eq->block[0], j);
    return reasons;
}

/* After iteration k: removes the lanes of a group that have failed, or in which the fixed point is
 * given up, from `lanes`, and those and the converged ones from the active lanes. */
DAL_INLINE void dal__update_active(dal_step *s, dal_equation *eq, int j, int may_give_up, int k,
                                   dal_mask *lanes)
{
    const dal_mask active = eq->active[j];
    dal_mask converged = dal__converged(s, &eq->block[0], j, k),
             going = dal_finite(eq->block[0].now[j]);
    if (eq->blocks > 1) {
        converged &= dal__converged(s, &eq->block[1], j, k);
        going &= dal_finite(eq->block[1].now[j]);
    }
    eq->taken[j] = dal_select(active, dal_num(k + 1), eq->taken[j]);
    if (may_give_up) going &= converged | ~dal__gives_up(eq, j, k);
    *lanes &= going | ~active;
    eq->active[j] = active & going & ~converged;
}

/* Iterates in the given lanes and leaves those that converged in `lanes`.  may_give_up: the fixed
 * point need not be iterated to its end. */
DAL_INLINE_EARLY void dal__iterate(dal_step *s, dal_equation *eq, dal_iteration_map *map,
                                   dal_mask *lanes, int newton, int may_give_up)
{
    dal__begin_block(&eq->block[0]);
    if (eq->blocks > 1) dal__begin_block(&eq->block[1]);
    DAL_EACH(j, DAL_STEP_GROUPS) eq->active[j] = lanes[j];
    for (int k = 0; k < DAL_ITERATIONS(s) && dal__any_group(eq->active); k++) {
        dal__iterate_once(s, eq, map, newton);
        DAL_EACH(j, DAL_STEP_GROUPS) dal__update_active(s, eq, j, may_give_up, k, &lanes[j]);
    }
    DAL_EACH(j, DAL_STEP_GROUPS) lanes[j] &= ~eq->active[j];
    DAL_EACH(j, DAL_STEP_GROUPS) eq->active[j] = lanes[j];
    for (int k = 0; k < DAL_EXTRA_ITERATIONS(s); k++) dal__iterate_once(s, eq, map, newton);
}

DAL_INLINE void dal__save_block(dal_block *b)
{
    DAL_EACH(i, DAL_SIZE(b)) b->start[i] = b->u[i];
}
DAL_INLINE void dal__save_guess(dal_equation *eq)
{
    dal__save_block(&eq->block[0]);
    if (eq->blocks > 1) dal__save_block(&eq->block[1]);
}
DAL_INLINE void dal__restore_block(dal_block *b, const dal_mask *lanes)
{
    DAL_EACH(i, DAL_SIZE(b)) b->u[i] = dal_select(lanes[i % DAL_STEP_GROUPS], b->start[i], b->u[i]);
}

/* Iterates again from the first guess in the lanes left, and leaves those that converged. */
DAL_INLINE_EARLY void dal__solve_again(dal_step *s, dal_equation *eq, dal_iteration_map *map,
                                       dal_matrix *matrix, dal_mask *left)
{
    dal__restore_block(&eq->block[0], left);
    if (eq->blocks > 1) dal__restore_block(&eq->block[1], left);
    if (matrix) matrix(s, eq);
    dal__iterate(s, eq, map, left, matrix != NULL, 0);
}

/* Lanes of group j that are solved by Newton's method at first. */
DAL_INLINE dal_mask dal__begins_with_newton(const dal_step *s, const dal_equation *eq, int j)
{
    const dal_mask newton = dal_less(dal_num(0.5), s->uses_newton[j]);
    if (DAL_SOLVER(s) == DAL_NEWTON) return s->alive[j];
    if (eq->follows) return s->alive[j] & newton;
    return s->alive[j] & (newton ^ dal__trial_is_due(s, j));
}

/* Solves with Newton's method the lanes that the fixed point did not, `solved`; then by the fixed
 * point after all those in which Newton's method was only tried. */
DAL_INLINE_EARLY void dal__solve_rest(dal_step *s, dal_equation *eq, dal_iteration_map *map,
                                      dal_matrix *matrix, dal_mask *solved)
{
    dal_mask left[DAL_STEP_GROUPS], by_newton[DAL_STEP_GROUPS];
    DAL_EACH(j, DAL_STEP_GROUPS) left[j] = s->alive[j] & ~solved[j];
    DAL_EACH(j, DAL_STEP_GROUPS) by_newton[j] = left[j];
    if (dal__any_group(left)) dal__solve_again(s, eq, map, matrix, by_newton);
    DAL_EACH(j, DAL_STEP_GROUPS) solved[j] |= by_newton[j];
    if (DAL_SOLVER(s) == DAL_NEWTON) return;
    DAL_EACH(j, DAL_STEP_GROUPS)
        left[j] = s->alive[j] & ~solved[j] & dal__begins_with_newton(s, eq, j) &
                  ~dal_less(dal_num(0.5), s->uses_newton[j]);
    if (dal__any_group(left)) dal__solve_again(s, eq, map, NULL, left);
    DAL_EACH(j, DAL_STEP_GROUPS) solved[j] |= left[j];
    DAL_EACH(j, DAL_STEP_GROUPS) {
        if (eq->follows)
            s->uses_newton[j] = dal_select(by_newton[j], dal_num(1.0), s->uses_newton[j]);
        else
            dal__choose_solver(s, &eq->cost, j, s->alive[j] & solved[j], by_newton[j],
                               eq->taken[j]);
    }
}

/* Solves the equation from the guess in u; lanes that fail are marked unconverged and no longer
 * alive.  matrix NULL: the fixed point only. */
DAL_SHARED_EARLY dal_status dal_solve(dal_step *s, dal_equation *eq, dal_iteration_map *map,
                                      dal_matrix *matrix)
{
    const int may_newton = matrix && DAL_MAY_NEWTON(s);
    dal_mask solved[DAL_STEP_GROUPS];
    DAL_EACH(j, DAL_STEP_GROUPS) {
        const dal_mask newton = dal_less(dal_num(0.5), s->uses_newton[j]);
        solved[j] = s->alive[j];
        if (may_newton) solved[j] &= ~dal__begins_with_newton(s, eq, j);
        eq->limit[j] = may_newton ? dal__fixed_point_limit(s, &eq->cost, j, newton) : dal_num(0.0);
    }
    dal__save_guess(eq);
    dal__iterate(s, eq, map, solved, 0, may_newton);
    if (may_newton) dal__solve_rest(s, eq, map, matrix, solved);
    DAL_EACH(j, DAL_STEP_GROUPS) {
        s->unconverged[j] |= s->alive[j] & ~solved[j];
        s->alive[j] &= solved[j];
    }
    return dal__any_group(s->alive) ? DAL_STATUS_OK : DAL_STATUS_NOT_CONVERGED;
}
#endif

/* The matrix of stage equations for frozen F_q, F_v (jacobian as dal_callbacks):
 *     M_ij = delta_ij 1 - z a_ij F_v - z^2 a2_ij [F_q 0]           i, j = 1..stages
 * and its inverse, [size*size] with size = stages*width; transposed: F_q^T, F_v^T, n*n each.
 * a2 is a squared (q moves with v), or 0 where q does not.  With the eigensystem of a the inverse
 * is made of the inverses of the N_e, see eigensystem.h. */
typedef struct dal_stage_matrix {
    int stages;
    double z;
    const double *a, *a2; /* [stages*stages] */
    int transposed;
    const dal_eigensystem *eigensystem; /* NULL: none */
} dal_stage_matrix;

#define dal_stage_inverse DAL_WIDE(dal_stage_inverse)
DAL_SHARED void dal_stage_inverse(dal_step *s, const dal_stage_matrix *k, const num *jacobian,
                                  num *m, dal_block *block, int group);

#ifndef DAL_LINKED
/* Entry (i, j) of diagonal - x F_(v,g) - y [F_q 0], or of its transpose. */
DAL_INLINE num dal__newton_entry(const dal_step *s, const dal_stage_matrix *k, const num *jacobian,
                                 int i, int j, double diagonal, double x, double y)
{
    const int n = DAL_N(s) / DAL_STEP_GROUPS, nw = DAL_NW(s) / DAL_STEP_GROUPS;
    const int row = k->transposed ? j : i, column = k->transposed ? i : j;
    const num fq = column < n ? jacobian[row * n + column] : dal_num(0.0);
    return diagonal - x * jacobian[nw * n + row * nw + column] - y * fq;
}

/* The inverses for dal_apply_eigensystem; m is scratch. */
DAL_INLINE void dal__eigen_inverse(dal_step *s, const dal_stage_matrix *k, const num *jacobian,
                                   num *m, num *inverse)
{
    const int width = DAL_NW(s) / DAL_STEP_GROUPS;
    const double *unit = k->transposed ? NULL : DAL_SPEEDS(s);
    for (int e = 0; e < (DAL_STAGES(k) + 1) / 2; e++) {
        const double *value = k->eigensystem->value + 2 * e;
        const double re = k->z * value[0], im = k->z * value[1];
        const int real = value[1] == 0.0, row = real ? width : 4 * width;
        num *const from = inverse + 2 * e * width * width;
        for (int place = 0; place < width * width; place++) {
            const int i = place / width, j = place % width;
            num *const x = m + i * row, *const y = x + 2 * width;
            x[j] = dal__newton_entry(s, k, jacobian, i, j, i == j, re, re * re - im * im);
            if (real) continue;
            y[j] = dal__newton_entry(s, k, jacobian, i, j, 0.0, im, 2.0 * re * im);
            x[width + j] = dal_num(i == j);
            y[width + j] = dal_num(0.0);
        }
        if (real) {
            dal_invert_in_units(m, from, width, unit, width);
            continue;
        }
        dal__scale_rows(m, width, row, unit, width);
        dal_invert_complex(m, from, width);
    }
}

/* Fills block->inverse for a group; m is scratch, of the same size. */
DAL_SHARED void dal_stage_inverse(dal_step *s, const dal_stage_matrix *k, const num *jacobian,
                                  num *m, dal_block *block, int group)
{
    const int size = DAL_SIZE(block) / DAL_STEP_GROUPS, width = size / k->stages;
    num *const inverse = block->inverse + group * size * size;
    block->eigensystem = k->eigensystem;
    block->stages = k->stages;
    if (k->eigensystem) {
        dal__eigen_inverse(s, k, jacobian, m, inverse);
        return;
    }
    for (int row = 0; row < size; row++) {
        for (int column = 0; column < size; column++) {
            const int stage = row / width * k->stages + column / width;
            m[row * size + column] =
                dal__newton_entry(s, k, jacobian, row % width, column % width, row == column,
                                  k->z * k->a[stage], k->z * k->z * k->a2[stage]);
        }
    }
    dal_invert_in_units(m, inverse, size, k->transposed ? NULL : DAL_SPEEDS(s), width);
}
#endif

/* ab = a b for s*s coefficients each. */
DAL_INLINE void dal__product(int s, const double *a, const double *b, double *ab)
{
    for (int i = 0; i < s * s; i++) {
        ab[i] = 0.0;
        for (int j = 0; j < s; j++) ab[i] += a[i / s * s + j] * b[j * s + i % s];
    }
}

/* F_q, F_(v,g) of a group at a point of all, [nw*n + nw*nw]. */
DAL_INLINE void dal_jacobian(dal_step *s, int group, double t, const num *q, const num *v, num *out)
{
    dal_eval_group(s, group, DAL_EVAL_JACOBIAN, t, q, v, out);
}

#endif
