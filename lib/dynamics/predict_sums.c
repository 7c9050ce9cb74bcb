/* predict_sums.c - what the steps of a run change, added up: of D, E and the invariants.
 *
 *     D_(k+1) = D_k + d_k,     I_(k+1) = I_k + c_k + D_k . integral of lambda      (local_change.c)
 *
 * are sums, not integrals of c/h over t: an integral counts half a step of lambda d twice.  The
 * integral of lambda is by two Gauss points in the step, with an error of h^5. */
#include "dynamics/predict_sums.h"
#include "core/error.h"
#include <float.h>
#include <math.h>
#include <string.h>

typedef dal__prediction_work work;
enum { GAUSS = DAL__GAUSS_POINTS };

void dal__predict_add_row(work *w, double t)
{
    dal_prediction *p = w->of;
    p->t[w->row] = t;
    memcpy(p->change + (size_t)w->row * (size_t)w->count, w->total,
           (size_t)w->count * sizeof(double));
    w->row++;
}

dal_status dal__predict_add_step(work *w, long long k, int i)
{
    dal_prediction *p = w->of;
    const int m = w->local.m;
    const size_t bytes = (size_t)w->count * sizeof(double);
    bool is_off = false;
    const long long in_piece = k % w->steps + 1, piece = k / w->steps;
    double *bin = w->bins + (size_t)(k / w->steps_of_bin) * (size_t)w->count;
    memcpy(w->increment, w->local_change + (size_t)i * (size_t)w->count, bytes);
    for (int a = 0; a < m; a++) is_off |= fabs(w->total[a]) > p->predicted[a].rounding;
    for (int g = 0; g < GAUSS && w->has_points && is_off; g++) { /* D . integral of lambda */
        const double *x = w->points + ((size_t)i * GAUSS + (size_t)g) * 2 * (size_t)w->n;
        const double t = w->t[i] + dal__gauss_points[g] * p->step;
        DAL_TRY(dal__local_pull(&w->local, t, x, w->total, w->pull));
        for (int j = m; j < w->count; j++) w->increment[j] += p->step / GAUSS * w->pull[j];
    }
    for (int a = 0; a < m && w->local.enforces_D; a++) w->increment[a] -= w->total[a];
    for (int j = 0; j < w->count; j++) {
        const double y = w->increment[j] + w->rest[j], sum = w->total[j] + y;
        w->rest[j] = y - (sum - w->total[j]);
        w->total[j] = sum;
        bin[j] += w->increment[j];
        if (piece > 0) continue;
        p->predicted[j].change = sum;
        p->predicted[j].max_change = fmax(p->predicted[j].max_change, fabs(sum));
    }
    if (piece == 0) p->end = p->from + (double)in_piece * p->step;
    if (piece == 0 && (in_piece * w->rows >= w->row * w->whole || in_piece == w->steps))
        dal__predict_add_row(w, p->end);
    if (w->pieces == 0) return DAL_STATUS_OK;
    if (2 * in_piece == w->steps) memcpy(w->half, w->total, bytes);
    if (in_piece < w->steps) return DAL_STATUS_OK;
    for (int j = 0; j < w->count; j++) {
        double *of = w->moments + 3 * j;
        const double first = w->half[j], second = w->total[j] - first;
        of[0] += w->total[j];
        of[1] += w->total[j] * w->total[j];
        of[2] += first * first + second * second;
    }
    p->pieces++;
    memset(w->total, 0, 2 * bytes); /* and rest */
    return DAL_STATUS_OK;
}
