/* causes.c - shares of a drift, from a run and its twins; see dalembert_causes.h.
 *
 * A drift is measured by its rate where the run's line of least squares rises by half of all it
 * deviates, and clearly so; rates of parts add up to that of the sum.  Else it is measured by the
 * greatest deviation, and parts are as large as they are. */
#include "analysis/causes.h"
#include <float.h>
#include <math.h>

/* The solver's part must exceed what rounding does by this, or be a rate this far from zero. */
static const double stands_out = 4.0, clear = 2.0;
/* What moves no more than this part of a drift is no cause of it; and what is no more than this is
 * nothing, but rounding of long numbers. */
static const double small = 0.1, nothing = 1e-12;
/* Coefficients move a run by no more than so many roundings of its scale in each step. */
static const double coefficient_roundings = 16.0;
static const double half_an_order = 0.5;

const char *dal_cause_name(dal_cause cause)
{
    static const char *const names[] = {
#define X(code, word) word,
        DAL_CAUSE_LIST(X)
#undef X
    };
    return (unsigned)cause < DAL_CAUSES ? names[cause] : "?";
}

static double half_width(const dal_trend *f) { return 0.5 * (f->rate_high - f->rate_low); }

static int drifts(const dal_trend *f, double time)
{
    return fabs(f->rate) > half_width(f) && fabs(f->rate) * time >= 0.5 * f->deviation;
}

static double size_of(const dal_trend *f, int by_rate)
{
    return by_rate ? fabs(f->rate) : f->deviation;
}

/* log2 of what halving divides by; NaN where there is nothing left. */
static double order_of(const dal_trend *whole, const dal_trend *halved, int by_rate)
{
    const double a = size_of(whole, by_rate), b = size_of(halved, by_rate);
    return a > 0.0 && b > 0.0 ? log2(a / b) : NAN;
}

static void put_share(dal_attribution *a, dal_cause cause, const dal_trend *part)
{
    const double whole = size_of(&a->early, a->by_rate);
    a->share[cause] = a->by_rate ? part->rate / a->early.rate : part->deviation / whole;
    a->margin[cause] = a->by_rate ? half_width(part) / whole : NAN;
}

/* Whether what long numbers leave is the work of coefficients: small, and not falling with the step
 * as the method's order says. */
static int is_of_coefficients(const dal_explanation *e, const dal_attribution *a)
{
    const double scale = fmax(1.0, a->early.max_abs);
    const double max = coefficient_roundings * DBL_EPSILON * scale * (double)e->early;
    const int order = dal_method_order(&e->spec.method);
    return a->twin[DAL_TWIN_LONG].deviation <= max && !isnan(a->order) &&
           a->order < order - half_an_order;
}

/* What long numbers leave is truncation, the work of coefficients, or the motion itself, which does
 * not fall with the step at all. */
static void weigh_long(const dal_explanation *e, dal_attribution *a)
{
    const dal_trend *in_long = &a->twin[DAL_TWIN_LONG];
    const double whole = size_of(&a->early, a->by_rate);
    a->is_nothing = size_of(in_long, a->by_rate) <= nothing * whole ||
                    in_long->deviation <= 2.0 * DBL_EPSILON * a->early.max_abs;
    if (!a->is_nothing) a->order = order_of(in_long, &a->twin[DAL_TWIN_LONG_HALVED], a->by_rate);
    const int coefficients = is_of_coefficients(e, a);
    a->is_motion = !coefficients && a->order < half_an_order;
    put_share(a, coefficients ? DAL_CAUSE_COEFFICIENTS : DAL_CAUSE_TRUNCATION, in_long);
    a->share[coefficients ? DAL_CAUSE_TRUNCATION : DAL_CAUSE_COEFFICIENTS] = 0.0;
    if (a->is_motion) a->share[DAL_CAUSE_TRUNCATION] = a->margin[DAL_CAUSE_TRUNCATION] = NAN;
}

/* Long numbers tell truncation and coefficients from rounding, further sweeps the solver. */
static void share_early(const dal_explanation *e, dal_attribution *a)
{
    a->by_rate = drifts(&a->early, (double)e->early * e->spec.options.step);
    if (!(size_of(&a->early, a->by_rate) > 0.0)) return;
    weigh_long(e, a);
    const int moves = a->by_rate && fabs(a->solver.rate) > clear * half_width(&a->solver);
    a->solver_tells = a->solver.deviation > stands_out * a->rounding.deviation || moves;
    put_share(a, DAL_CAUSE_ROUNDING, a->solver_tells ? &a->rounding : &a->both);
    if (a->solver_tells)
        put_share(a, DAL_CAUSE_SOLVER, &a->solver);
    else if (!e->ran[DAL_TWIN_TIGHTER] || a->solver.deviation < small * a->early.deviation)
        a->share[DAL_CAUSE_SOLVER] = 0.0;
}

/* Without long numbers halving alone: T 2^p is left of T + R, or 1/2^p of it is not. */
static void share_by_halving(const dal_explanation *e, dal_attribution *a)
{
    const double whole = size_of(&a->all, a->all_by_rate);
    if (!e->ran[DAL_TWIN_HALVED] || !(whole > 0.0)) return;
    const dal_trend *half = &a->twin[DAL_TWIN_HALVED];
    a->order = order_of(&a->all, half, a->all_by_rate);
    const double divisor = exp2(dal_method_order(&e->spec.method));
    if (fabs(a->order - dal_method_order(&e->spec.method)) < half_an_order)
        a->share[DAL_CAUSE_TRUNCATION] =
            (whole - size_of(half, a->all_by_rate)) / whole * divisor / (divisor - 1.0);
}

static void share_projection(const dal_explanation *e, dal_attribution *a)
{
    const double whole = size_of(&a->all, a->all_by_rate);
    if (!e->ran[DAL_TWIN_PROJECTION] || !(whole > 0.0)) return;
    const double other = size_of(&a->twin[DAL_TWIN_PROJECTION], a->all_by_rate);
    a->share[DAL_CAUSE_PROJECTION] = fmax(1.0 - other / whole, 0.0);
}

void dal__attribute(const dal_explanation *e, dal_attribution *a)
{
    for (int k = 0; k < DAL_CAUSES; k++) a->share[k] = a->margin[k] = NAN;
    a->order = NAN;
    if (!isfinite(a->all.deviation)) return;
    a->all_by_rate = drifts(&a->all, (double)e->steps * e->spec.options.step);
    if (e->early > 0)
        share_early(e, a);
    else
        share_by_halving(e, a);
    share_projection(e, a);
}
