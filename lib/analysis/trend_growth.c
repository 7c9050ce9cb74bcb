/* trend_growth.c - whether the amplitude of an oscillation grows, and how.
 *
 * a_i is the range of x over five blocks about block i; z = log a.  The amplitude grows when z
 * rises by more than 1 and
 *
 *     z = c + p log s    or    z = c + k s,     s = t/T,
 *
 * leaves residues whose root mean square is a small part of that rise.  Noise may cover the
 * beginning: if the whole does not fit, the part well above the beginning is tried.  Beats of two
 * tones rise by as much, but in other shapes.  Values to one side whose z rises in this way by many
 * e-folds explode: an exponential over more e-folds than the shapes of trend_tables.h have, or a
 * modulated one, is found in z alone. */
#include "analysis/trend_growth.h"
#include <math.h>

enum { NEAR = 2, MIN_POINTS = 10 };

static const double doubled = 0.7, grown = 1.0; /* rises of z */
static const double misfit = 0.035;             /* of the rise */
static const double clear_of_noise = 1.5;       /* rise of z above the beginning */

static const double exploded = 8.0;   /* rise of z */
static const double one_sided = 0.05; /* the nearer end over the farther one */

typedef struct curve {
    int count;
    double s[DAL_STATISTICS_BLOCKS], log_s[DAL_STATISTICS_BLOCKS], z[DAL_STATISTICS_BLOCKS];
} curve;

static bool read_curve(const dal__trend_series *x, curve *c)
{
    c->count = 0;
    for (int i = NEAR; i < x->count - NEAR; i++) {
        double low = INFINITY, high = -INFINITY;
        for (int k = i - NEAR; k <= i + NEAR; k++) {
            low = fmin(low, x->min[k]);
            high = fmax(high, x->max[k]);
        }
        if (!(high > low)) return false;
        c->s[c->count] = (i + 0.5) / x->count;
        c->log_s[c->count] = log(c->s[c->count]);
        c->z[c->count++] = log(high - low);
    }
    return true;
}

/* The root mean square of the residues of z about a rising line through (u, z). */
static double residue(const double *u, const double *z, int n)
{
    double mu = 0.0, mz = 0.0, uu = 0.0, uz = 0.0, zz = 0.0;
    for (int i = 0; i < n; i++) {
        mu += u[i] / n;
        mz += z[i] / n;
    }
    for (int i = 0; i < n; i++) {
        uu += (u[i] - mu) * (u[i] - mu);
        uz += (u[i] - mu) * (z[i] - mz);
        zz += (z[i] - mz) * (z[i] - mz);
    }
    return uz > 0.0 ? sqrt(fmax(zz - uz * uz / uu, 0.0) / n) : INFINITY;
}

/* From point `from` on. */
static dal__growth growth_from(const curve *c, int from)
{
    const int n = c->count - from;
    if (n < MIN_POINTS) return DAL__LARGER;
    const double rise = c->z[c->count - 1] - c->z[from];
    const double by_power = residue(c->log_s + from, c->z + from, n);
    const double by_rate = residue(c->s + from, c->z + from, n);
    if (rise < grown || fmin(by_power, by_rate) > misfit * rise) return DAL__LARGER;
    return by_rate < by_power ? DAL__GROWS_FAST : DAL__GROWS;
}

dal__growth dal__trend_growth(const dal__trend_series *x)
{
    curve c;
    double rise = 0.0;
    if (!read_curve(x, &c)) return DAL__STEADY;
    const int eighth = x->count / 8;
    for (int i = 0; i < eighth; i++) rise += (c.z[c.count - 1 - i] - c.z[i]) / eighth;
    if (rise < doubled) return DAL__STEADY;
    if (rise < grown) return DAL__LARGER;
    const dal__growth whole = growth_from(&c, 0);
    const double below = -x->low, above = x->high;
    const bool is_one_sided = fmin(below, above) < one_sided * fmax(below, above);
    if (whole == DAL__GROWS_FAST && rise > exploded && is_one_sided) return DAL__EXPLODES;
    int from = 0;
    while (from < c.count && c.z[from] < c.z[0] + clear_of_noise) from++;
    return whole != DAL__LARGER ? whole : growth_from(&c, from);
}
