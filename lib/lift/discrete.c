/* discrete.c - whether the discrete action of a symplectic method is stationary at given rows.
 *
 * With the generating function G_k(X_k, P_(k+1)) of a step,
 *
 *     S_d = sum_k P_(k+1).X_(k+1) - G_k(X_k, P_(k+1)),
 *     dS_d/dP_(k+1) = X_(k+1) - dG_k/dP,   dS_d/dX_k = P_k - dG_k/dX
 *
 * The right sides vanish if and only if the method leads from row k to row k + 1, so that the step
 * itself decides.  On a step of constant e the discrete action is what e pi_e increases by: both
 * sum up h b_i pi.K pi/(2e) at the same stages.
 *
 * Marsden and West, Acta Numerica 10 (2001) 357; Leok and Zhang, IMA J. Numer. Anal. 31 (2011)
 * 1497. */
#include "core/error.h"
#include "core/vectors.h"
#include "dalembert_action.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Fractions of h by which a row may miss the time of its step, as rows of a run may. */
static const double aligned = 1e-9;
/* Roundings of a step and of its equations, which are solved to a few of them. */
#define ROUNDING (64 * DBL_EPSILON)

enum { VARIABLES = 6 }; /* q, v, e, p, pi, pi_e */

/* The largest |a - b| of each variable; b may be NULL. */
static void enlarge(double max[VARIABLES], int n, const double *a, const double *b)
{
    for (int g = 0, i = 0; g < VARIABLES; g++)
        for (int j = 0, width = g % 3 == 2 ? 1 : n; j < width; j++, i++) {
            const double distance = fabs(a[i] - (b ? b[i] : 0.0));
            if (!(distance <= max[g])) max[g] = distance;
        }
}

/* The first row that is not a whole number of steps h after the first one; the number of rows where
 * there is none. */
static int first_row_beside(const dal_curve *c, double h)
{
    int k = 0;
    while (k < c->rows && fabs(c->t[k] - (c->t[0] + k * h)) <= aligned * fabs(h)) k++;
    return k;
}

double dal_curve_step(const dal_curve *curve)
{
    if (!curve || curve->rows < 2 || !curve->t) return 0.0;
    const double h = (curve->t[curve->rows - 1] - curve->t[0]) / (curve->rows - 1);
    return h != 0.0 && first_row_beside(curve, h) == curve->rows ? h : 0.0;
}

static dal_status check_rows(const dal_run_spec *spec, const dal_curve *c, dal_error *error)
{
    char name[128];
    const double h = spec->options.step;
    if (!(dal_method_properties(&spec->method) & DAL_SYMPLECTIC))
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "%s has no discrete action: it is not symplectic",
                         dal_method_name(&spec->method, name, sizeof name));
    if (c->rows < 2 || !c->t || !c->q || !c->v || h == 0.0)
        return dal__fail(error, DAL_STATUS_ARGUMENT,
                         "a discrete action needs a step, and two rows with velocities");
    const int k = first_row_beside(c, h);
    if (k == c->rows) return DAL_STATUS_OK;
    return dal__fail(error, DAL_STATUS_ARGUMENT,
                     "row %d: t = %.15g is not %d steps of %.15g after %.15g", k + 1, c->t[k], k, h,
                     c->t[0]);
}

dal_status dal_check_discrete_action(const dal_run_spec *spec, const dal_curve *curve,
                                     dal_discrete_action *action, dal_error *error)
{
    DAL_REQUIRE(spec && spec->system && curve && action, error);
    DAL_TRY(check_rows(spec, curve, error));
    const int n = spec->system->n, pi_e = 4 * n + 1;
    const double h = spec->options.step;
    const double *const list[VARIABLES] = {curve->q, curve->v,  curve->e,
                                           curve->p, curve->pi, curve->pi_e};
    double size[VARIABLES] = {0.0}, distance[VARIABLES] = {0.0}, sum = 0.0;
    dal_system smooth = *spec->system;
    dal_run_spec own = *spec;
    dal_run *run = NULL;
    smooth.events = 0;
    own.system = &smooth;
    own.options.space = DAL_LIFTED;
    own.options.bare = true; /* steps of the method alone */
    DAL_TRY(dal_run_create(&run, &own, error));
    double *row = dal__numbers(2, (size_t)pi_e + 1), *next = row ? row + pi_e + 1 : NULL;
    dal_status status = row ? DAL_STATUS_OK : dal__memory_error(error);
    for (int k = 0; k < curve->rows && status == DAL_STATUS_OK; k++) {
        for (int g = 0, i = 0; g < VARIABLES; g++)
            for (int j = 0, width = g % 3 == 2 ? 1 : n; j < width; j++)
                next[i++] = list[g] ? list[g][k * width + j] : g == 2 ? 1.0 : 0.0;
        enlarge(size, n, next, NULL);
        if (k > 0) status = dal_run_set_state(run, curve->t[k - 1], row, error);
        if (k > 0 && status == DAL_STATUS_OK) status = dal_run_step(run, error);
        if (k > 0 && status == DAL_STATUS_OK) {
            const double *step = dal_run_state(run), e = row[2 * n];
            sum += step[2 * n] == e && next[2 * n] == e ? e * (step[pi_e] - row[pi_e]) : NAN;
            enlarge(distance, n, step, next);
        }
        memcpy(row, next, ((size_t)pi_e + 1) * sizeof *row);
    }
    dal_run_free(run);
    free(row);
    if (status != DAL_STATUS_OK) return status;
    *action = (dal_discrete_action){.value = sum, .is_stationary = true};
    size[0] += fabs(h) * size[1];
    for (int g = 0; g < VARIABLES; g++) {
        if (!(distance[g] <= ROUNDING * size[g])) action->is_stationary = false;
        if (!(distance[g] / fabs(h) <= action->defect)) action->defect = distance[g] / fabs(h);
    }
    return DAL_STATUS_OK;
}
