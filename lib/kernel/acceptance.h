/* acceptance.h - whether a step is accepted, and the clock that it advances.
 *
 * A lane is accepted if its equations are solved, its state is finite, e and the guards keep their
 * signs, and the rank check holds: det(A1 B0) det(A0 B0) > 0 for all leading minors, with
 * B = W^-1 A^T.  If a gradient of a constraint turns by a right angle within one step, then
 * G = A B was singular in between (or the step is far too large).
 *
 * Two evaluations and a product of matrices cost more than many a step.  They are spared where the
 * pivots of the equations that F solves give no warning: those at the first evaluation of F in each
 * step, which the system leaves.  One of them is the square of the distance s of a gradient
 * from the span of others (or s itself, with given reactions), and vanishes with G.  Where s passes
 * through zero at an even pace, it is half of what it was, or less, in that step or in the step
 * before: s^2 has fallen to a quarter.  The warning is a change of sign or by more than
 * DAL__PIVOT_CHANGE, of s by 1/8, in this step or in the last; it fails only where s moves at least
 * 8 times as far in a step as in the one before.
 *
 * Many constraints are checked without matrices, by the factors of F.  The change of velocity of
 * least energy that constraint k alone feels, C_k = W^-1 A^T G^-1 e_k, is along the component of
 * its gradient that is orthogonal to the others.  This component turns by a right angle where
 *
 *     C1_k . W1 C0_k = (G^-1 A)_1 C0_k
 *
 * has component k = 0: it must be positive for each k.  (Where G has a null vector, this
 * is so of all constraints in it.)
 *
 * The engine (lib/run) and generated files (lib/codegen) drive these checks, each by a loop of its
 * own.  y0 is the state before the step.  Its number i of a group of lanes is
 * y0[i*DAL_STEP_GROUPS + group], as in the state of the step. */
#ifndef DAL_KERNEL_ACCEPTANCE_H
#define DAL_KERNEL_ACCEPTANCE_H

#include "algebra.h"
#include "step.h"

/* Lanes of a group that have passed each check. */
typedef struct dal_checks {
    dal_mask solved, gauge, finite, regular;
} dal_checks;

/* Why a lane failed in a step that returned status: the first check it did not pass. */
DAL_INLINE dal_status dal_rejection(const dal_checks *c, dal_status status, int lane)
{
    if (status != DAL_STATUS_OK && status != DAL_STATUS_NOT_CONVERGED) return status;
    if (!dal_mask_lane(c->solved, lane)) return DAL_STATUS_NOT_CONVERGED;
    if (!dal_mask_lane(c->gauge, lane)) return DAL_STATUS_GAUGE;
    if (!dal_mask_lane(c->finite, lane)) return DAL_STATUS_NOT_FINITE;
    return dal_mask_lane(c->regular, lane) ? DAL_STATUS_OK : DAL_STATUS_SINGULAR;
}

/* 0, or NaN where one of count numbers of a group is not finite. */
#if DAL_HAS_GROUPS
DAL_INLINE num dal_group_nonfinite(const num *x, int count, int group)
{
    num nonfinite = dal_num(0.0);
    DAL_EACH(i, count) nonfinite += x[i * DAL_STEP_GROUPS + group] - x[i * DAL_STEP_GROUPS + group];
    return nonfinite;
}
#else
#define dal_group_nonfinite(x, count, group) ((void)(group), dal_nonfinite(x, count))
#endif

/* Lanes in which every component of the state is finite; 1/e is tested instead of e. */
DAL_INLINE dal_mask dal_finite_state(const dal_step *s, int group)
{
    const int dim = DAL_PER_GROUP(DAL_DIM(s));
    if (!DAL_LIFTED(s)) return dal_equal(dal_group_nonfinite(s->y, dim, group), dal_num(0.0));
    const int at_e = dal_at_e(s), at_p = dal_at_p(s);
    const num w = 1.0 / s->y[at_e]; /* the lifted space has one group */
    return dal_equal(dal_nonfinite(s->y, at_e) + (w - w) + dal_nonfinite(s->y + at_p, dim - at_p),
                     dal_num(0.0));
}

#if DAL_WITH(GAUGE)
/* Lanes in which e keeps its sign; an infinite one has none to lose. */
DAL_INLINE dal_mask dal_check_gauge(const dal_step *s, const num *y0)
{
    if (!DAL_LIFTED(s)) return dal_all();
    const num e0 = y0[dal_at_e(s)], e = s->y[dal_at_e(s)];
    return dal_less(dal_num(0.0), 1.0 / e0 * e) | ~dal_finite(e);
}
#endif

#if DAL_WITH(REGULAR)
/* Evaluates a callback for a group before and after the step. */
DAL_INLINE void dal_eval_both_ends(dal_step *s, int group, dal_callback_code code, const num *y0,
                                   num *before, num *after)
{
    dal_eval_group(s, group, code, s->t - s->h, y0, y0 + DAL_N(s), before);
    dal_eval_group(s, group, code, s->t, s->y, s->y + DAL_N(s), after);
}

/* Removes from good the lanes where x is not positive; *first becomes the number of the first x
 * for which lane 0 is removed (NULL: not recorded). */
DAL_INLINE void dal_keep_positive(num x, int number, dal_mask *good, int *first)
{
    *good &= dal_less(dal_num(0.0), x);
    if (first && !*first && !dal_mask_lane(*good, 0)) *first = number;
}
#endif

#if DAL_WITH(GUARDS)
/* Lanes where the guards keep their signs. */
DAL_INLINE dal_mask dal_check_guards(dal_step *s, int group, const num *y0, int *first)
{
    dal_mask good = dal_all();
    DAL_VECTOR(s, before, DAL_GUARDS(s));
    DAL_VECTOR(s, after, DAL_GUARDS(s));
    dal_eval_both_ends(s, group, DAL_EVAL_GUARDS, y0, before, after);
    DAL_EACH(i, DAL_GUARDS(s)) dal_keep_positive(before[i] * after[i], i + 1, &good, first);
    return good;
}
#endif

#if DAL_WITH(PIVOTS)
#define DAL__PIVOT_CHANGE 1.25

/* Lanes where a pivot differs in sign or size from the step before, in this step or in the
 * last, or where one of them is not known.  Saves the pivots of this step. */
DAL_INLINE dal_mask dal_pivots_warn(dal_step *s, int group)
{
    const bool known = s->pivots_known[group];
    const dal_mask alive = DAL_LANES_AT(s->alive, group);
    num *const unsteady = s->last_pivots + group;
    dal_mask steady = dal_all();
    DAL_EACH(i, DAL_PIVOTS(s)) {
        num *const last = unsteady + (1 + i) * DAL_STEP_GROUPS, before = *last;
        const num now = known ? s->pivots[i * DAL_STEP_GROUPS + group] : dal_num(0.0);
        const num bound = DAL__PIVOT_CHANGE * (now * before);
        steady &= dal_less(now * now, bound) & dal_less(before * before, bound);
        *last = dal_select(alive & dal_finite(now), now, before);
    }
    const dal_mask warned = ~steady | dal_less(dal_num(0.5), *unsteady);
    *unsteady = dal_select(alive, dal_select(steady, dal_num(0.0), dal_num(1.0)), *unsteady);
    return warned;
}
#endif

/* Whether the rank check uses the factors of F. */
#if DAL_WITH(RANK_BY_FACTORS) && DAL_WITH(RANK_BY_MINORS)
#define DAL_RANK_BY_FACTORS(s) ((s)->rank_by_factors)
#elif DAL_WITH(RANK_BY_FACTORS)
#define DAL_RANK_BY_FACTORS(s) 1
#else
#define DAL_RANK_BY_FACTORS(s) 0
#endif

#if DAL_WITH(RANK_BY_FACTORS)
/* Lanes where no gradient, as far as it is orthogonal to the others, turns by a right angle. */
DAL_INLINE dal_mask dal__rank_by_factors(dal_step *s, const num *y0, int *first)
{
    const int n = DAL_N(s), m = DAL_M(s);
    dal_mask good = dal_all();
    DAL_VECTOR(s, in, DAL_N(s) + DAL_M(s) + 1); /* pi, c, beta */
    DAL_VECTOR(s, out, DAL_N(s) + DAL_M(s));
    for (int k = 0; k < m; k++) {
        DAL_EACH(i, n + m + 1) in[i] = dal_num(i == n + k);
        dal_eval(s, DAL_EVAL_ENFORCEMENT, s->t - s->h, y0, y0 + n, in, out);
        DAL_EACH(i, n) in[i] = out[i];
        in[n + k] = dal_num(0.0);
        dal_eval(s, DAL_EVAL_ENFORCEMENT, s->t, s->y, s->y + n, in, out);
        dal_keep_positive(out[n + k], k + 1, &good, first);
    }
    return good;
}
#endif

#if DAL_WITH(RANK_BY_MINORS)
/* Lanes where the leading minors of A1 B0 and A0 B0 have the same signs. */
DAL_INLINE dal_mask dal__rank_by_minors(dal_step *s, int group, const num *y0, int *first)
{
    const int m = DAL_M(s), n = DAL_PER_GROUP(DAL_N(s));
    DAL_VECTOR(s, c0, DAL_CONSTRAINT_SIZE(s));
    DAL_VECTOR(s, c1, DAL_CONSTRAINT_SIZE(s));
    DAL_VECTOR(s, g0, DAL_SQUARE_M(s));
    DAL_VECTOR(s, g1, DAL_SQUARE_M(s));
    dal_mask good = dal_all();
    dal_eval_both_ends(s, group, DAL_EVAL_CONSTRAINT, y0, c0, c1);
    dal_gram(c0 + m, c0 + m + m * n, m, n, g0);
    dal_gram(c1 + m, c0 + m + m * n, m, n, g1);
    DAL_EACH(k, m)
        dal_keep_positive(dal_eliminate(g0, m, k) / dal_eliminate(g1, m, k), k + 1, &good, first);
    return good;
}
#endif

#if DAL_WITH(RANK)
/* Lanes where the rank check holds. */
DAL_INLINE dal_mask dal_check_rank(dal_step *s, int group, const num *y0, int *first)
{
    dal_mask warned = dal_all(), good = dal_all();
#if DAL_WITH(PIVOTS)
    if (DAL_PIVOTS(s) > 0) warned = dal_pivots_warn(s, group);
    if (!DAL_RARELY(dal_any(warned))) return dal_all();
#endif
#if DAL_WITH(RANK_BY_FACTORS)
    if (DAL_RANK_BY_FACTORS(s)) good = dal__rank_by_factors(s, y0, first);
#endif
#if DAL_WITH(RANK_BY_MINORS)
    if (!DAL_RANK_BY_FACTORS(s)) good = dal__rank_by_minors(s, group, y0, first);
#endif
    return good | ~warned;
}
#endif

#if DAL_WITH(REGULAR)
/* Lanes where the constraints stay independent; *guard, *constraint as *first above. */
DAL_INLINE dal_mask dal_check_regular(dal_step *s, int group, const num *y0, int *guard,
                                      int *constraint)
{
    dal_mask good = dal_all();
#if DAL_WITH(GUARDS)
    if (DAL_GUARDS(s) > 0) good &= dal_check_guards(s, group, y0, guard);
#endif
#if DAL_WITH(RANK)
    if (DAL_RANK_CHECKED(s)) good &= dal_check_rank(s, group, y0, constraint);
#endif
    return good;
}
#endif

/* The time of all lanes, compensated. */
typedef struct dal_clock {
    num time, error;
} dal_clock;

DAL_INLINE void dal_advance_clock(dal_clock *clock, double h)
{
    const num a = clock->time, b = h + clock->error, sum = a + b, c = sum - a;
    clock->error = (a - (sum - c)) + (b - c);
    clock->time = sum;
}

#endif
