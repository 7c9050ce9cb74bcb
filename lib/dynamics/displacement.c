/* displacement.c - how far the steps of a run lead away from the exact motion.
 *
 * With e_k = S_h(x_k) - x_(k+1), the local errors, the displacement of a run is to first order
 *
 *     d_(k+1) = J d_k + e_k,     J the derivative of the exact motion over a step:
 *     dq' = dv,   dv' = F_q dq + F_v dv,
 *
 * integrated over some steps at once, whose local errors are added at the end, by rk4 between
 * states of the exact motion, with differences of F: a percent of d is enough.  What oscillates
 * along a run is as far from the prediction as d is from 0. */
#include "dynamics/displacement.h"
#include "core/error.h"
#include "core/vectors.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of tau, the longest step of rk4; of a difference, in units. */
static const double longest = 0.25, displaced = 1e-4;

struct dal__displacement {
    dal__local *local;
    int size, span;         /* of (q, v); steps of a step of rk4 */
    double *d, *errors;     /* [size] displacement, and local errors since */
    double *first, *middle; /* [size] of the exact motion */
    double *end;            /* [size] of the last step */
    double *at, *rate;      /* [size] scratch; [4*size] */
    double t[2];            /* of first and middle */
    double max;             /* of the displacement, in units */
};

void dal__displacement_free(dal__displacement *s)
{
    if (!s) return;
    free(s->d);
    free(s);
}

dal_status dal__displacement_create(dal__displacement **made, dal__local *local, double tau,
                                    dal_error *error)
{
    const size_t size = 2 * (size_t)local->n;
    dal__displacement *s = *made = calloc(1, sizeof *s);
    if (s) s->d = dal__numbers(10, size);
    if (!s || !s->d) return dal__memory_error(error);
    s->local = local;
    s->size = (int)size;
    s->span = 2;
    while (2 * s->span <= DAL__LOCAL_STEPS && 2 * s->span * fabs(local->step) <= longest * tau)
        s->span *= 2;
    s->errors = s->d + size;
    s->first = s->errors + size;
    s->middle = s->first + size;
    s->end = s->middle + size;
    s->at = s->end + size;
    s->rate = s->at + size;
    return DAL_STATUS_OK;
}

/* The rate of a displacement at x, by a difference of F along it. */
static void find_rate(const dal__displacement *s, double t, const double *x, const double *d,
                      double *rate)
{
    const dal__local *k = s->local;
    const int n = k->n;
    double size = 0.0;
    memcpy(rate, d + n, (size_t)n * sizeof *rate);
    memset(rate + n, 0, (size_t)n * sizeof *rate);
    for (int i = 0; i < s->size; i++) size = fmax(size, fabs(d[i]) / k->unit[1 + i]);
    if (size == 0.0) return;
    for (int side = -1; side <= 1; side += 2) {
        const double distance = side * displaced / size;
        double *F = k->values;
        for (int i = 0; i < s->size; i++) s->at[i] = x[i] + distance * d[i];
        if (dal_evaluator_call(k->evaluator, k->system->call.field, t, s->at, s->at + n, NULL, F) !=
            DAL_STATUS_OK)
            F[0] = NAN;
        for (int i = 0; i < n; i++) rate[n + i] += F[i] / (2.0 * distance);
    }
}

/* Moves d from the state first to x, and adds the local errors. */
static void move(dal__displacement *s, double t, const double *x)
{
    static const double node[] = {0.0, 0.5, 0.5, 1.0}, weight[] = {1.0, 2.0, 2.0, 1.0};
    const size_t bytes = (size_t)s->size * sizeof *s->d;
    const double T = t - s->t[0], times[] = {s->t[0], s->t[1], s->t[1], t};
    const double *states[] = {s->first, s->middle, s->middle, x};
    double *stage = s->rate + 3 * s->size;
    memset(s->rate, 0, 3 * bytes); /* the rate before, their sum */
    double *before = s->rate, *sum = before + s->size, *now = sum + s->size;
    for (int j = 0; j < 4; j++) {
        for (int i = 0; i < s->size; i++) stage[i] = s->d[i] + node[j] * T * before[i];
        find_rate(s, times[j], states[j], stage, now);
        for (int i = 0; i < s->size; i++) sum[i] += weight[j] * now[i];
        memcpy(before, now, bytes);
    }
    for (int i = 0; i < s->size; i++) s->d[i] += T / 6.0 * sum[i] + s->errors[i];
    memset(s->errors, 0, bytes);
}

double dal__displacement_add(dal__displacement *s, long long k, double t, const double *x,
                             const double *end, const bool *counts)
{
    const size_t bytes = (size_t)s->size * sizeof *x;
    const int within = (int)(k % s->span);
    for (int i = 0; i < s->size && k > 0; i++) s->errors[i] += s->end[i] - x[i];
    if (within == 0 && k > 0) {
        move(s, t, x);
        for (int i = 0; i < s->size; i++)
            if (counts[i] && !(fabs(s->d[i]) / s->local->unit[1 + i] <= s->max))
                s->max = fabs(s->d[i]) / s->local->unit[1 + i];
    }
    if (within == 0 || 2 * within == s->span) {
        memcpy(within == 0 ? s->first : s->middle, x, bytes);
        s->t[within != 0] = t;
    }
    memcpy(s->end, end, bytes);
    return s->max;
}
