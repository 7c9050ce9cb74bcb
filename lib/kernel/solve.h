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
 * With the solver "auto" each lane chooses between the two by what they cost, see choice.h. */
#ifndef DAL_KERNEL_SOLVE_H
#define DAL_KERNEL_SOLVE_H

#include "choice.h"

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

/* How far the iteration of a block is, in each lane. */
typedef struct dal_progress {
    num scale;       /* size of the state that the block moves */
    num now, before; /* norms of the last two increments */
    num stagnations; /* successive iterations without decrease of the norm */
    num best, since; /* the min norm, and the iterations since then */
} dal_progress;

/* One block of unknowns, [size]. */
typedef struct dal_block {
    dal_progress DAL_OF_GROUPS(progress); /* of each group of lanes */
    double weight;                        /* a change of u by d moves the state by weight*d */
    int size;                             /* unknowns */
    num *u, *image;                       /* the unknowns; what map made of them */
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
    dal_block block[2];       /* the unknowns */
    int blocks;               /* 1 or 2 */
    void *context;            /* of the map */
    dal_lane_set active;      /* the lanes that still iterate */
    num DAL_OF_GROUPS(taken); /* with the solver auto: iterations of each lane, */
    num DAL_OF_GROUPS(limit); /* and how many the fixed point may take; */
    dal_newton_cost cost;     /* and of Newton's method */
    bool follows;             /* takes the method that other equations of the step chose */
} dal_equation;

/* A map may store values for the end of the step: of a lane's own last iteration, which
 * further iterations of its neighbours do not change. */
#if DAL_SCALAR
#define DAL_IF_ACTIVE(active, fresh, old) (fresh)
#else
#define DAL_IF_ACTIVE(active, fresh, old) dal_select(active, fresh, old)
#endif

/* The fixed point to its end; as far as it costs no more than Newton's method; that method. */
typedef enum dal__iteration {
    DAL__ITERATE_FIXED_POINT,
    DAL__TRY_FIXED_POINT,
    DAL__ITERATE_NEWTON
} dal__iteration;

/* Computes the image of u, for all blocks. */
typedef void dal_iteration_map(dal_step *step, dal_equation *equation);
/* Computes the inverse of Newton's matrix, for all blocks. */
typedef void dal_matrix(dal_step *step, dal_equation *equation);

/* The size of a block.  Compilers do not see the constant where several groups of lanes are stepped
 * as one system; such a file has blocks of one size only. */
#if DAL_HAS_GROUPS
#define DAL_SIZE(b) (DAL_FIXED_STAGES * DAL_NW(b))
#else
#define DAL_SIZE(b) ((b)->size)
#endif

/* Declares a block of count unknowns with its memory; has_inverse: also for the inverse of Newton's
 * matrix.  Its members have no names here, since generated files are C++17, too. */
#define DAL_BLOCK(step, name, count, has_inverse)                                                  \
    DAL_VECTOR(step, name##_u, count);                                                             \
    DAL_VECTOR(step, name##_image, count);                                                         \
    DAL_VECTOR(step, name##_start, count);                                                         \
    DAL_VECTOR(step, name##_inverse, (has_inverse) ? DAL_PER_GROUP((count) * (count)) : 0);        \
    DAL_VECTOR(step, name##_scratch, (has_inverse) ? 3 * (count) : 0);                             \
    dal_block name = {                                                                             \
        {{dal_num(0.0), dal_num(0.0), dal_num(0.0), dal_num(0.0), dal_num(0.0), dal_num(0.0)}},    \
        1.0,                                                                                       \
        (count),                                                                                   \
        name##_u,                                                                                  \
        name##_image,                                                                              \
        name##_start,                                                                              \
        name##_inverse,                                                                            \
        name##_scratch,                                                                            \
        NULL,                                                                                      \
        1,                                                                                         \
        NULL,                                                                                      \
        1,                                                                                         \
        0.0}

/* Declares an equation of `count` blocks for the lanes alive; where Newton's method may solve it,
 * its cost is set. */
#define DAL_EQUATION(step, name, count, context, ...)                                              \
    dal_equation name = {{__VA_ARGS__},  (count),        (context),  (step)->alive,                \
                         {dal_num(0.0)}, {dal_num(0.0)}, {0.0, 0.0}, false}

/* The units of a block.  Compilers see in files without units that there are none. */
#ifdef DAL_SPECIALISED
#define DAL_BLOCK_UNIT(b) (DAL_FIXED_SPEEDS ? (b)->unit : NULL)
#else
#define DAL_BLOCK_UNIT(b) ((b)->unit)
#endif

DAL_INLINE num dal__block_norm(const dal_block *b, const num *x, int j)
{
    return dal_group_norm(x, DAL_SIZE(b), DAL_BLOCK_UNIT(b), b->width, j);
}

/* Sizes of a group's state for blocks that move v or pi, with the effect of rounding in q or p
 * within a step that contracts. */
DAL_INLINE num dal_velocity_scale(const dal_step *s, double h, int group)
{
    const double *unit = DAL_SPEEDS(s);
    const int n = DAL_N(s), nw = DAL_NW(s);
    return dal_group_norm(s->y + n, nw, unit, DAL_PER_GROUP(nw), group) +
           dal_group_norm(s->y, n, unit, DAL_PER_GROUP(n), group) / dal_num(fabs(h));
}
/* The max norm of a velocity of all lanes, v[n]. */
DAL_INLINE num dal_speed_norm(const dal_step *s, const num *v)
{
    return dal_group_norm(v, DAL_N(s), DAL_SPEEDS(s), DAL_N(s), 0);
}
/* Declares the unknowns of a block velocities, or their rates, of count numbers each stage. */
DAL_INLINE void dal_set_speeds(const dal_step *s, dal_block *b, int count)
{
    b->unit = DAL_SPEEDS(s);
    b->width = DAL_PER_GROUP(count);
}
DAL_INLINE num dal_momentum_scale(const dal_step *s, double h, int group)
{
    return dal_group_norm(s->y + dal_at_pi(s), DAL_N(s), NULL, 1, group) +
           fabs(h) * dal_group_norm(s->y + dal_at_p(s), DAL_N(s), NULL, 1, group);
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
    const int rows = DAL_PER_GROUP(DAL_SIZE(b));
    const num *inverse = b->inverse + j * rows * rows;
    if (b->eigensystem)
        dal_apply_eigensystem(b->eigensystem, DAL_STAGES(b), DAL_PER_GROUP(DAL_NW(s)), inverse,
                              b->image + j, DAL_STEP_GROUPS, b->scratch);
    else
        dal_group_multiply(inverse, rows, b->image, j, b->scratch);
}

/* u += d (or M^-1 d) in the active lanes; now: the norm of the increment, NaN if not finite.
 * Packs exist for one lane only, which is then active. */
DAL_INLINE void dal__advance(const dal_step *s, dal_block *b, dal_lane_set active,
                             dal__iteration method)
{
    const bool newton = method == DAL__ITERATE_NEWTON;
    num DAL_OF_GROUPS(norm), DAL_OF_GROUPS(nonfinite);
    DAL_EACH_GROUP(j) norm[j] = nonfinite[j] = dal_num(0.0);
    const int seen = newton ? 0 : dal__advance_packs(b->u, b->image, DAL_SIZE(b), norm, nonfinite);
    num *u = b->u + seen, *image = b->image + seen;
    DAL_EACH(i, DAL_SIZE(b) - seen) image[i] -= u[i];
    if (newton)
        DAL_EACH_GROUP(j) dal__apply_inverse(s, b, j);
    dal_add_increment(active, u, image, DAL_SIZE(b) - seen, norm, nonfinite);
    if (DAL_BLOCK_UNIT(b) != NULL)
        DAL_EACH_GROUP(j) norm[j] = dal__block_norm(b, b->image, j);
    DAL_EACH_GROUP(j) {
        dal_progress *const p = &b->progress[j];
        p->before = p->now;
        p->now = b->weight * norm[j] + nonfinite[j];
    }
}

DAL_INLINE num dal__size(const dal_block *b, int j)
{
    return b->progress[j].scale + b->weight * dal__block_norm(b, b->u, j);
}

/* Lanes where an increment is zero, or small enough after several iterations. */
DAL_INLINE dal_mask dal__negligible(dal_progress *p, int k, num size)
{
    const double faint = k < DAL__MANY_ITERATIONS       ? 0.0
                         : k < 2 * DAL__MANY_ITERATIONS ? DAL__FAINT
                                                        : DAL__LATE_FAINT;
    const double cycle = k < DAL__MANY_ITERATIONS ? 0.0 : DAL__CYCLE_SIZE;
    const dal_mask less = dal_less(p->now, p->best);
    p->best = dal_select(less, p->now, p->best);
    p->since = dal_select(less, dal_num(0.0), p->since + 1.0);
    return dal_less_equal(p->now, faint * size) |
           (dal_less_equal(p->now, cycle * size) &
            dal_less(dal_num(DAL__CYCLE_LENGTH - 0.5), p->since));
}

/* Lanes of a group where the increment of iteration k is zero, stagnates, or is below the
 * tolerance.  A single lane with its smallest increment yet, the usual case, is decided first:
 * the size of the state is not needed there. */
DAL_INLINE dal_mask dal__converged(const dal_step *s, dal_block *b, int j, int k)
{
    dal_progress *const p = &b->progress[j];
    const num now = p->now;
    if (DAL_LANES == 1 && k < DAL__MANY_ITERATIONS && !(DAL_SOLVER_TOLERANCE(s) > 0.0) &&
        !(b->enough > 0.0) && dal_any(dal_less(dal_num(0.0), now)) &&
        dal_any(dal_less(now, p->best))) {
        p->best = now;
        p->since = p->stagnations = dal_num(0.0);
        return ~dal_all();
    }
    const num size = dal__size(b, j);
    p->stagnations = dal_select(dal_less_equal(p->before, now), p->stagnations + 1.0, dal_num(0.0));
    const dal_mask once = dal_less(dal_num(0.5), p->stagnations),
                   twice = dal_less(dal_num(1.5), p->stagnations);
    const dal_mask stagnates =
        dal__negligible(p, k, size) | (once & dal_less_equal(now, DAL__ROUNDING * size)) |
        (twice & dal_less_equal(now, DAL__SMALL * size)) | dal_less_equal(now, b->enough * size);
    if (DAL_RARELY(DAL_SOLVER_TOLERANCE(s) > 0.0))
        return stagnates | dal_less_equal(now, DAL_SOLVER_TOLERANCE(s) * size);
    return stagnates;
}

DAL_INLINE dal_mask dal__slow(const dal_block *b, int j)
{
    const dal_progress *const p = &b->progress[j];
    const dal_mask slow = dal_less(DAL__SLOW_CONTRACTION * p->before, p->now);
    if (!dal_any(slow)) return slow;
    return slow & dal_less(DAL__NOISE * dal__size(b, j), p->now);
}

DAL_INLINE void dal__begin_block(dal_block *b)
{
    DAL_EACH_GROUP(j) {
        dal_progress *const p = &b->progress[j];
        p->now = p->best = dal_num(INFINITY);
        p->stagnations = p->since = dal_num(0.0);
    }
}

/* One iteration of all blocks in the active lanes. */
DAL_INLINE_EARLY void dal__iterate_once(dal_step *s, dal_equation *eq, dal_iteration_map *map,
                                        dal__iteration method)
{
    map(s, eq);
    dal__advance(s, &eq->block[0], eq->active, method);
    if (eq->blocks > 1) dal__advance(s, &eq->block[1], eq->active, method);
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
DAL_INLINE void dal__update_active(dal_step *s, dal_equation *eq, int j, dal__iteration method,
                                   int k, dal_lane_set *lanes)
{
    const dal_mask active = DAL_LANES_AT(eq->active, j);
    dal_mask converged = dal__converged(s, &eq->block[0], j, k),
             going = dal_finite(eq->block[0].progress[j].now);
    if (eq->blocks > 1) {
        converged &= dal__converged(s, &eq->block[1], j, k);
        going &= dal_finite(eq->block[1].progress[j].now);
    }
    eq->taken[j] = dal_select(active, dal_num(k + 1), eq->taken[j]);
    if (method == DAL__TRY_FIXED_POINT) going &= converged | ~dal__gives_up(eq, j, k);
    DAL_LANES_AT(*lanes, j) &= going | ~active;
    DAL_LANES_AT(eq->active, j) = active & going & ~converged;
}

/* Iterates in the given lanes; removes from them those that do not converge. */
DAL_INLINE_EARLY void dal__iterate(dal_step *s, dal_equation *eq, dal_iteration_map *map,
                                   dal__iteration method, dal_lane_set *lanes)
{
    dal__begin_block(&eq->block[0]);
    if (eq->blocks > 1) dal__begin_block(&eq->block[1]);
    eq->active = *lanes;
    for (int k = 0; k < DAL_ITERATIONS(s) && dal_any_lanes(eq->active); k++) {
        dal__iterate_once(s, eq, map, method);
        DAL_EACH_GROUP(j) dal__update_active(s, eq, j, method, k, lanes);
    }
    eq->active = *lanes = dal_lanes_without(*lanes, eq->active);
    for (int k = 0; k < DAL_EXTRA_ITERATIONS(s); k++) dal__iterate_once(s, eq, map, method);
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
DAL_INLINE void dal__restore_block(dal_block *b, dal_lane_set lanes)
{
    dal_copy_lanes(lanes, b->u, b->start, DAL_SIZE(b));
}

/* Iterates again from the first guess in the given lanes; removes those that do not converge. */
DAL_INLINE_EARLY void dal__solve_again(dal_step *s, dal_equation *eq, dal_iteration_map *map,
                                       dal_matrix *matrix, dal_lane_set *lanes)
{
    dal__restore_block(&eq->block[0], *lanes);
    if (eq->blocks > 1) dal__restore_block(&eq->block[1], *lanes);
    if (matrix) {
        DAL__MARK(s);
        matrix(s, eq);
        DAL__RELEASE(s);
    }
    dal__iterate(s, eq, map, matrix ? DAL__ITERATE_NEWTON : DAL__ITERATE_FIXED_POINT, lanes);
}

/* Lanes that are solved by Newton's method at first. */
DAL_INLINE dal_lane_set dal__begins_with_newton(const dal_step *s, const dal_equation *eq)
{
    dal_lane_set lanes = s->alive;
    if (DAL_SOLVER(s) == DAL_NEWTON) return lanes;
    DAL_EACH_GROUP(j) {
        dal_mask newton = dal__newton_in_use(s, j);
        if (!eq->follows) newton ^= dal__trial_is_due(s, j);
        DAL_LANES_AT(lanes, j) &= newton;
    }
    return lanes;
}

/* Solves with Newton's method the lanes that the fixed point did not, `solved`; then by the fixed
 * point after all those in which Newton's method was only tried. */
DAL_INLINE_EARLY void dal__solve_rest(dal_step *s, dal_equation *eq, dal_iteration_map *map,
                                      dal_matrix *matrix, dal_lane_set *solved)
{
    dal_lane_set by_newton = dal_lanes_without(s->alive, *solved);
    if (dal_any_lanes(by_newton)) dal__solve_again(s, eq, map, matrix, &by_newton);
    *solved = dal_lanes_or(*solved, by_newton);
    if (DAL_SOLVER(s) == DAL_NEWTON) return;
    dal_lane_set tried = dal_lanes_without(dal__begins_with_newton(s, eq), *solved);
    DAL_EACH_GROUP(j) DAL_LANES_AT(tried, j) &= ~dal__newton_in_use(s, j);
    if (dal_any_lanes(tried)) dal__solve_again(s, eq, map, NULL, &tried);
    *solved = dal_lanes_or(*solved, tried);
    DAL_EACH_GROUP(j) {
        const dal_mask newton = DAL_LANES_AT(by_newton, j);
        if (eq->follows)
            s->uses_newton[j] = dal_select(newton, dal_num(1.0), s->uses_newton[j]);
        else
            dal__choose_solver(s, &eq->cost, j,
                               DAL_LANES_AT(s->alive, j) & DAL_LANES_AT(*solved, j), newton,
                               eq->taken[j]);
    }
}

/* Solves the equation from the guess in u; lanes that fail are marked unconverged and no longer
 * alive.  matrix NULL: the fixed point only. */
DAL_SHARED_EARLY dal_status dal_solve(dal_step *s, dal_equation *eq, dal_iteration_map *map,
                                      dal_matrix *matrix)
{
    const bool may_newton = matrix && DAL_MAY_NEWTON(s);
    dal_lane_set solved = s->alive;
    if (may_newton) {
        solved = dal_lanes_without(solved, dal__begins_with_newton(s, eq));
        DAL_EACH_GROUP(j)
            eq->limit[j] = dal__fixed_point_limit(s, &eq->cost, j, dal__newton_in_use(s, j));
    }
    dal__save_guess(eq);
    dal__iterate(s, eq, map, may_newton ? DAL__TRY_FIXED_POINT : DAL__ITERATE_FIXED_POINT, &solved);
    if (may_newton) dal__solve_rest(s, eq, map, matrix, &solved);
    s->unconverged = dal_lanes_or(s->unconverged, dal_lanes_without(s->alive, solved));
    s->alive = dal_lanes_and(s->alive, solved);
    return dal_any_lanes(s->alive) ? DAL_STATUS_OK : DAL_STATUS_NOT_CONVERGED;
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
    bool transposed;
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
    const int n = DAL_PER_GROUP(DAL_N(s)), nw = DAL_PER_GROUP(DAL_NW(s));
    const int row = k->transposed ? j : i, column = k->transposed ? i : j;
    const num fq = column < n ? jacobian[row * n + column] : dal_num(0.0);
    return diagonal - x * jacobian[nw * n + row * nw + column] - y * fq;
}

/* The inverses for dal_apply_eigensystem; m is scratch. */
DAL_INLINE void dal__eigen_inverse(dal_step *s, const dal_stage_matrix *k, const num *jacobian,
                                   num *m, num *inverse)
{
    const int width = DAL_PER_GROUP(DAL_NW(s));
    const double *unit = k->transposed ? NULL : DAL_SPEEDS(s);
    for (int e = 0; e < (DAL_STAGES(k) + 1) / 2; e++) {
        const double *value = k->eigensystem->value + 2 * e;
        const double re = k->z * value[0], im = k->z * value[1];
        const bool real = value[1] == 0.0;
        const int row = real ? width : 4 * width;
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
    const int size = DAL_PER_GROUP(DAL_SIZE(block)), width = size / k->stages;
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
