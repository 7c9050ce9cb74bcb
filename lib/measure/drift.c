/* drift.c - statistics of a quantity along a run, and what they amount to.
 *
 * The least-squares line through (t_i, x_i) from running means and sums about them,
 *
 *     d = t - mean_t,   mean_t += d/k,   S_tt += d (t - mean_t),   S_tx += d (x - mean_x)
 *
 * (Welford 1962, DOI 10.1080/00401706.1962.10490022), t and x counted from their first values: no
 * cancellation of large sums, nor of a large x that changes little. */
#include "dalembert.h"
#include <math.h>

/* The rule of dalembert_measure.h.  Of x = sin(2 pi P t/T) the line's slope over the whole time is
 * 6/(pi P) and the mean square distance from it 1/2 - 3/(pi P)^2: a ratio of 4.3 for one period,
 * 1.5 for two. */
static const double rounding_level = 1e-12;
static const double quarter_growth = 2.5;
static const double slope_growth = 5.0;

void dal_drift_start(dal_drift *drift, int count, double from, double to)
{
    for (int i = 0; i < count; i++) drift[i] = (dal_drift){.from = from, .to = to};
}

static int quarter_of(const dal_drift *d, double t)
{
    double part = 4.0 * (t - d->from) / (d->to - d->from);
    return part < 1.0 ? 0 : part < 2.0 ? 1 : part < 3.0 ? 2 : 3;
}

static void extend_line(dal_drift *d, double t, double x)
{
    double dt = t - d->t, dx = x - d->x;
    d->t += dt / (double)d->count;
    d->x += dx / (double)d->count;
    d->tt += dt * (t - d->t);
    d->tx += dt * (x - d->x);
    d->xx += dx * (x - d->x);
}

static void add_one(dal_drift *d, double t, double x)
{
    if (!isfinite(x)) {
        d->greatest = d->deviation = INFINITY;
        return;
    }
    if (d->count++ == 0) d->first = x;
    double deviation = fabs(x - d->first);
    double *quarter = &d->quarter[quarter_of(d, t)];
    d->last = x;
    d->greatest = fmax(d->greatest, fabs(x));
    d->deviation = fmax(d->deviation, deviation);
    *quarter = fmax(*quarter, deviation);
    extend_line(d, t - d->from, x - d->first);
}

void dal_drift_add(dal_drift *drift, int count, double t, const double *values)
{
    for (int i = 0; i < count; i++) add_one(&drift[i], t, values[i]);
}

void dal_drift_finish(dal_drift *drift, int count)
{
    for (int i = 0; i < count; i++) {
        dal_drift *d = &drift[i];
        d->rate = d->tt > 0.0 ? d->tx / d->tt : 0.0;
        double square = d->xx - d->rate * d->tx;
        d->residue = d->count > 0 && square > 0.0 ? sqrt(square / (double)d->count) : 0.0;
    }
}

dal_verdict dal_drift_verdict(const dal_drift *d, double scale)
{
    if (d->count == 0 || !isfinite(d->deviation)) return DAL_VERDICT_LOST;
    if (d->deviation == 0.0) return DAL_VERDICT_EXACT;
    if (d->deviation <= rounding_level * scale) return DAL_VERDICT_ROUNDING;
    int grows = d->quarter[3] > quarter_growth * d->quarter[0];
    int leans = fabs(d->rate) * (d->to - d->from) > slope_growth * d->residue;
    return grows || leans ? DAL_VERDICT_DRIFTS : DAL_VERDICT_BOUNDED;
}

const char *dal_verdict_text(dal_verdict verdict)
{
    static const char *const text[] = {
#define X(code, word) word,
        DAL_VERDICT_LIST(X)
#undef X
    };
    return (unsigned)verdict < DAL_VERDICT_COUNT ? text[verdict] : "?";
}
