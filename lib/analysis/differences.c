/* differences.c - derivatives by central differences of order 8, with increments that adapt. */
#include "analysis/differences.h"
#include "core/error.h"
#include "core/vectors.h"
#include <math.h>
#include <stdbool.h>
#include <string.h>

/* An increment is good where orders 8 and 6 agree to the first of these or to the roundings of the
 * values; two are, where both agree to the second, the error of order 8 then being near 2e-9, and
 * with each other: what oscillates fast may look smooth once. */
static const double close_agreement = 1e-10, agreement = 1e-7, rounding = 2e-14;
/* No power of it is near 1/2: what is periodic does not look smooth twice. */
static const double shortening = 0.37;
enum { ATTEMPTS = 24 };

static const double order_8[4] = {4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};
static const double order_6[4] = {3.0 / 4.0, -3.0 / 20.0, 1.0 / 60.0, 0.0};

/* The derivative by the increment d into out; by how much those of order 8 and of order 6 differ,
 * relative to max(1, |derivative|), and how much of that the roundings of the values may be. */
static dal_status difference(dal__curve *curve, void *user, double d, int count, double *scratch,
                             double *out, double *gap, double *noise)
{
    double *lower = scratch + count, size = 0.0;
    for (int i = 0; i < count; i++) out[i] = lower[i] = 0.0;
    for (int k = 4; k >= 1; k--) {
        for (int side = -1; side <= 1; side += 2) {
            DAL_TRY(curve(user, side * k * d, scratch));
            const double weight = side * order_8[k - 1] / d, less = side * order_6[k - 1] / d;
            for (int i = 0; i < count; i++) out[i] += weight * scratch[i];
            for (int i = 0; i < count; i++) lower[i] += less * scratch[i];
            size = fmax(size, dal__max_abs(scratch, (size_t)count));
        }
    }
    *gap = dal__distance(out, lower, (size_t)count);
    *noise = isfinite(size) ? rounding * size / d : 0.0;
    return DAL_OK;
}

dal_status dal__differentiate(dal__curve *curve, void *user, double d, int count, double *scratch,
                              double *out)
{
    double *best = scratch + 2 * count, min = INFINITY, gap, noise;
    dal_status failure = DAL_OK;
    bool good = false;
    for (int i = 0; i < count; i++) best[i] = NAN;
    for (int k = 0; k < ATTEMPTS && !good; k++, d *= shortening) {
        const dal_status status = difference(curve, user, d, count, scratch, out, &gap, &noise);
        if (status != DAL_OK && failure == DAL_OK) failure = status;
        if (status != DAL_OK) continue;
        good = gap <= fmax(close_agreement, noise) ||
               fmax(fmax(gap, min), dal__distance(best, out, (size_t)count)) <= agreement;
        if (!(gap < min)) continue;
        min = gap;
        memcpy(best, out, (size_t)count * sizeof(double));
    }
    memcpy(out, best, (size_t)count * sizeof(double));
    return isinf(min) ? failure : DAL_OK;
}
