/* action.c - the two actions of the theory, on computed curves.
 *
 *     S   = int e/2 |q'' - F(q,q',t)|^2 dt                                             (nh10)
 *     S_d = sum_k P_k.(X_(k+1) - X_k) - h H((X_k + X_(k+1))/2, P_k)                    (nh23)
 *
 * with X = (q,v,e), P = (p,pi,pi_e) at mid-interval and H = pi.K pi/(2e) + pi.F + p.v + mu_e pi_e:
 *     dS_d/dP_k = X_(k+1) - X_k - h H_P,
 *     dS_d/dX_k = P_(k-1) - P_k - h/2 (H_X of interval k-1 + H_X of interval k). */
#include "analysis/evaluator.h"
#include "core/error.h"
#include "core/vectors.h"
#include "dalembert_action.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* First and second derivative from values at -4h..4h. */
static const double first_weight[5] = {0.0, 4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};
static const double second_weight[5] = {-205.0 / 72.0, 8.0 / 5.0, -1.0 / 5.0, 8.0 / 315.0,
                                        -1.0 / 560.0};

static dal_status lagrangian(dal_evaluator *evaluator, double t, double h, const double *row,
                             double *scratch, double *value)
{
    const dal_system *s = dal_evaluator_system(evaluator);
    int n = s->n;
    double *v = scratch, *a = scratch + n, *field = scratch + 2 * n;
    for (int i = 0; i < n; i++) {
        double first = 0.0, second = second_weight[0] * row[i];
        for (int k = 4; k >= 1; k--) {
            double after = row[i + k * n], before = row[i - k * n];
            first += first_weight[k] * (after - before);
            second += second_weight[k] * (after + before);
        }
        v[i] = first / h;
        a[i] = second / (h * h);
    }
    DAL_TRY(dal_evaluator_call(evaluator, s->call.field, t, row, v, NULL, field));
    *value = 0.0;
    for (int i = 0; i < n; i++) *value += (a[i] - field[i]) * (a[i] - field[i]);
    return DAL_STATUS_OK;
}

dal_status dal_evaluator_measure_action(dal_evaluator *evaluator, double t0, double h,
                                        long long count, const double *q, double e, double *action)
{
    DAL_REQUIRE(evaluator && q && action, NULL);
    const dal_system *s = dal_evaluator_system(evaluator);
    if (s->multipliers > 0) return DAL_STATUS_UNSUPPORTED;
    if (count < 10 || !(h > 0.0)) return DAL_STATUS_ARGUMENT;
    double *scratch = dal__numbers(3, (size_t)s->n), sum = 0.0, value = 0.0;
    if (scratch == NULL) return DAL_STATUS_MEMORY;
    dal_status status = DAL_STATUS_OK;
    for (long long k = 4; k < count - 4 && status == DAL_STATUS_OK; k++) {
        status = lagrangian(evaluator, t0 + h * (double)k, h, q + k * s->n, scratch, &value);
        sum += (k == 4 || k == count - 5 ? 0.5 : 1.0) * value;
    }
    *action = 0.5 * e * h * sum;
    free(scratch);
    if (status != DAL_STATUS_OK) return status;
    return isfinite(*action) ? DAL_STATUS_OK : DAL_STATUS_NOT_FINITE;
}

/* ---- the first-order action ---- */

typedef struct path {
    dal_evaluator *evaluator;
    int n, half; /* half = 2n+1 */
    double t, h;
    dal_status status;
    double *z, *gradient, *before, *field; /* [2*half] x 3, [3n] */
} path;

static double hamiltonian(void *user, const double *z)
{
    path *w = user;
    const dal_system *s = dal_evaluator_system(w->evaluator);
    int n = w->n;
    const double *v = z + n, *p = z + w->half, *pi = p + n;
    double e = z[2 * n], mu = 0.0, sum = 0.0, square = 0.0;
    dal_status status = dal__evaluator_square(w->evaluator, w->t, z, v, pi, w->field, &square);
    if (status == DAL_STATUS_OK)
        status = dal_evaluator_call(w->evaluator, s->call.field, w->t, z, v, NULL, w->field);
    if (status == DAL_STATUS_OK && s->call.gauge != NULL)
        status = dal_evaluator_call(w->evaluator, s->call.gauge, w->t, z, v, &e, &mu);
    if (status != DAL_STATUS_OK) w->status = status;
    for (int i = 0; i < n; i++) sum += pi[i] * w->field[i] + p[i] * v[i];
    return square / (2.0 * e) + sum + mu * pi[n];
}

/* before holds P - h/2 H_X of the interval before, a term of dS/dX at the node between. */
static double variation(path *w, const double *row, bool inner)
{
    double max = 0.0;
    int half = w->half;
    for (int i = 0; i < half; i++) {
        double in_p = row[i + 2 * half] - row[i] - w->h * w->gradient[half + i];
        double force = 0.5 * w->h * w->gradient[i];
        double in_x = w->before[i] - w->z[half + i] - force;
        max = fmax(max, fabs(in_p));
        if (inner) max = fmax(max, fabs(in_x));
        w->before[i] = w->z[half + i] - force;
    }
    return max / w->h;
}

dal_status dal_evaluator_check_stationarity(dal_evaluator *evaluator, double t0, double h,
                                            long long count, const double *states, double *defect)
{
    DAL_REQUIRE(evaluator && states && defect, NULL);
    const dal_system *s = dal_evaluator_system(evaluator);
    if (s->multipliers > 0) return DAL_STATUS_UNSUPPORTED;
    if (count < 3 || !(h > 0.0)) return DAL_STATUS_ARGUMENT;
    size_t n = (size_t)s->n, size = 4 * n + 2;
    double *block = dal__numbers(1, 3 * size + 3 * n);
    if (block == NULL) return DAL_STATUS_MEMORY;
    path w = {.evaluator = evaluator, .n = s->n, .half = 2 * s->n + 1, .h = h, .z = block};
    w.gradient = block + size, w.before = block + 2 * size, w.field = block + 3 * size;
    *defect = 0.0;
    for (long long k = 0; k + 1 < count; k++) {
        const double *row = states + (size_t)k * size;
        /* z = midpoint X, mean P of the interval that begins at row; the gradient of H there. */
        for (size_t i = 0; i < size; i++) w.z[i] = 0.5 * (row[i] + row[i + size]);
        w.t = t0 + h * (double)k + 0.5 * h;
        dal_measure_gradient(hamiltonian, &w, (int)size, w.z, w.gradient);
        double here = variation(&w, row, k > 0);
        if (!(here <= *defect)) *defect = isnan(here) ? INFINITY : here;
    }
    free(block);
    return w.status;
}
