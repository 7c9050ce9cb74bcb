/* root.c - roots of a function of one variable.
 *
 * Chandrupatla's method (1997, DOI 10.1016/S0965-9978(96)00051-8): inverse quadratic interpolation
 * where the three points at hand allow it, else bisection. */
#include "core/root.h"
#include "core/error.h"
#include <float.h>
#include <math.h>
#include <stdbool.h>

enum { ROUNDS = 200 };

static int sign(double x) { return (x > 0.0) - (x < 0.0); }

dal_status dal__find_root(dal__function *function, void *user, dal__value_at a, dal__value_at b,
                          dal__root *root)
{
    double fraction = 0.5;
    for (int round = 0; round < ROUNDS; round++) {
        const bool is_first = fabs(a.f) < fabs(b.f);
        const double width = fabs(b.s - a.s), resolution = DBL_EPSILON * fmax(fabs(a.s), fabs(b.s));
        *root = is_first ? (dal__root){a, b} : (dal__root){b, a};
        if (root->best.f == 0.0 || width <= 2.0 * resolution) return DAL_STATUS_OK;
        dal__value_at x = {.s = a.s + fraction * (b.s - a.s)};
        DAL_TRY(function(user, x.s, &x.f));
        const int same = sign(x.f) == sign(a.f);
        const dal__value_at dropped = same ? a : b;
        if (!same) b = a;
        a = x;
        const double min = resolution / fmax(fabs(b.s - a.s), resolution);
        const double xi = (a.s - b.s) / (dropped.s - b.s), phi = (a.f - b.f) / (dropped.f - b.f);
        fraction = 0.5; /* of the way from a */
        if (phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi)
            fraction =
                a.f / (b.f - a.f) * dropped.f / (b.f - dropped.f) +
                (dropped.s - a.s) / (b.s - a.s) * a.f / (dropped.f - a.f) * b.f / (dropped.f - b.f);
        fraction = fmin(fmax(fraction, min), 1.0 - min);
    }
    return DAL_STATUS_OK;
}
