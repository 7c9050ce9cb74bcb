/* curve.c - the actions of the theory on a curve given by rows.
 *
 *     S = int e/2 sum_i (S^i(q,q',q'',t))^2 dt                                        (nh8)
 *     S = int e/2 |q'' - F(q,q',t)|^2 dt                                             (nh10)
 *     S = int e/2 |v' - F(q,v,t)|^2 + lambda.(q' - v) dt                             (nh11)
 *     S = int p.q' + pi.v' + pi_e e' - H dt,                                         (nh23)
 *         H = pi.K pi/(2e) + pi.F + p.v + mu_e pi_e
 *
 * All functions of t are cubic splines through the rows.  Where the rows lie on a motion, q'' of
 * the spline has an error of the order h^2, so that the first action is of the order h^4.  The
 * integrand is smooth between two rows, where Gauss quadrature with four nodes has an error below
 * the spline's.  The error that is returned is the distance to the value with every second row. */
#include "analysis/evaluator.h"
#include "core/error.h"
#include "core/vectors.h"
#include "dalembert_action.h"
#include "expr/table.h"
#include "kernel/elementary.h"
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

enum { VALUE, FIRST };
enum { Q, V, LAMBDA, P, PI, E, PI_E, KINDS };

typedef struct splines {
    dal_evaluator *evaluator;
    dal_error *error;
    int n, knots;
    double *data; /* of all splines, each data[size]; then what follows */
    size_t size;
    int first[KINDS];         /* number of the first spline of a kind; -1: it is not given */
    double *t;                /* [knots] */
    double *x, *rate, *field; /* scratch, [3n] each, field[3n + equations] */
} splines;

static int width_of(const splines *s, int kind) { return kind < E ? s->n : 1; }

/* The value or a derivative of a function at t; velocities that are not given are q'. */
static double spline_at(const splines *s, int kind, int i, int order, double t)
{
    if (kind == V && s->first[V] < 0) return spline_at(s, Q, i, order + 1, t);
    if (s->first[kind] < 0) return kind == E && order == VALUE ? 1.0 : 0.0;
    return dal_piecewise(t, s->data + s->size * (size_t)(s->first[kind] + i), s->knots, order);
}

static dal_status check_curve(splines *s, dal_evaluator *evaluator, const dal_curve *c,
                              dal_error *error)
{
    const dal_system *system = dal_evaluator_system(evaluator);
    const int n = system->n;
    const double *const list[KINDS] = {c->q, c->v, c->lambda, c->p, c->pi, c->e, c->pi_e};
    DAL_REQUIRE(c->t && c->q, error);
    if (c->rows < DAL_CURVE_ROWS)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "a curve has %d rows, not %d or more", c->rows,
                         (int)DAL_CURVE_ROWS);
    for (int k = 0; k < c->rows; k++)
        if (!isfinite(c->t[k]) || (k > 0 && !(c->t[k] > c->t[k - 1])))
            return dal__fail(error, DAL_STATUS_ARGUMENT,
                             "row %d: t = %.17g does not come after the row before", k + 1,
                             c->t[k]);
    for (int kind = 0; kind < KINDS; kind++) {
        const int width = kind < E ? n : 1;
        for (int k = 0; list[kind] && k < c->rows * width; k++)
            if (!isfinite(list[kind][k]) || (kind == E && list[kind][k] == 0.0))
                return dal__fail(error, DAL_STATUS_ARGUMENT, "row %d: a number is not finite%s",
                                 k / width + 1, kind == E ? ", or e is 0" : "");
    }
    *s = (splines){.evaluator = evaluator, .error = error, .n = n};
    if (system->multipliers > 0)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "vakonomic motion has no F(q, q', t), of which the action is made");
    return DAL_STATUS_OK;
}

/* Splines through every stride-th row, and the last one. */
static dal_status make_splines(splines *s, const dal_curve *c, int stride)
{
    const double *const list[KINDS] = {c->q, c->v, c->lambda, c->p, c->pi, c->e, c->pi_e};
    const int last = (c->rows - 1) / stride + ((c->rows - 1) % stride != 0);
    const dal_system *system = dal_evaluator_system(s->evaluator);
    int count = 0;
    s->knots = last + 1;
    s->size = dal__table_size(s->knots);
    for (int kind = 0; kind < KINDS; kind++) {
        s->first[kind] = list[kind] ? count : -1;
        if (list[kind]) count += width_of(s, kind);
    }
    const size_t knots = (size_t)s->knots, vectors = 9 * (size_t)s->n + (size_t)system->equations;
    s->data = dal__numbers(1, s->size * (size_t)count + 2 * knots + vectors);
    if (!s->data) return dal__memory_error(s->error);
    double *t = s->t = s->data + s->size * (size_t)count, *column = t + knots;
    s->x = column + knots, s->rate = s->x + 3 * s->n, s->field = s->rate + 3 * s->n;
    for (int k = 0; k <= last; k++) t[k] = c->t[k == last ? c->rows - 1 : k * stride];
    for (int kind = 0; kind < KINDS; kind++)
        for (int i = 0, width = width_of(s, kind); list[kind] && i < width; i++) {
            for (int k = 0; k <= last; k++)
                column[k] = list[kind][(k == last ? c->rows - 1 : k * stride) * width + i];
            const dal_table table = {t, column, s->knots, DAL_NOT_A_KNOT, DAL_EXTEND_LINEAR};
            dal__table_fill(&table, s->data + s->size * (size_t)(s->first[kind] + i));
        }
    return DAL_STATUS_OK;
}

/* ---- integrands ---- */

/* s->x, s->rate and s->field hold q, v; v'; and F. */
static dal_status hamiltonian(const splines *s, double t, double *out)
{
    const dal_system *system = dal_evaluator_system(s->evaluator);
    const int n = s->n;
    const double *q = s->x, *v = q + n, e = spline_at(s, E, 0, VALUE, t);
    const double pi_e = spline_at(s, PI_E, 0, VALUE, t);
    double *pi = s->x + 2 * n, mu = 0.0, square = 0.0;
    *out = pi_e * spline_at(s, E, 0, FIRST, t);
    for (int i = 0; i < n; i++) {
        pi[i] = spline_at(s, PI, i, VALUE, t);
        *out += spline_at(s, P, i, VALUE, t) * (spline_at(s, Q, i, FIRST, t) - v[i]) +
                pi[i] * (s->rate[i] - s->field[i]);
    }
    DAL_TRY(dal__evaluator_square(s->evaluator, t, q, v, pi, s->field, &square));
    if (system->call.gauge)
        DAL_TRY(dal_evaluator_call(s->evaluator, system->call.gauge, t, q, v, &e, &mu));
    *out -= square / (2.0 * e) + mu * pi_e;
    return DAL_STATUS_OK;
}

/* e/2 |a - F(q,v,t)|^2, a being the derivative of v, and what a form adds to it. */
static dal_status integrand(const splines *s, dal_action_form form, double t, double *out)
{
    const dal_system *system = dal_evaluator_system(s->evaluator);
    const int kind = form <= DAL_ACTION_SECOND_ORDER ? Q : V, order = kind == Q ? FIRST : VALUE;
    const bool has_equations = form == DAL_ACTION_EQUATIONS;
    dal_callback *callback = has_equations ? system->equation_values : system->call.field;
    double *v = s->x + s->n, sum = 0.0;
    for (int i = 0; i < s->n; i++) {
        s->x[i] = spline_at(s, Q, i, VALUE, t);
        v[i] = spline_at(s, kind, i, order, t);
        s->rate[i] = spline_at(s, kind, i, order + 1, t);
    }
    DAL_TRY(dal_evaluator_call(s->evaluator, callback, t, s->x, v, s->rate, s->field));
    if (form == DAL_ACTION_HAMILTONIAN) return hamiltonian(s, t, out);
    for (int i = 0; i < (has_equations ? system->equations : s->n); i++) {
        const double residual = has_equations ? s->field[i] : s->rate[i] - s->field[i];
        sum += residual * residual;
    }
    *out = 0.5 * spline_at(s, E, 0, VALUE, t) * sum;
    for (int i = 0; form == DAL_ACTION_FIRST_ORDER && i < s->n; i++)
        *out += spline_at(s, LAMBDA, i, VALUE, t) * (spline_at(s, Q, i, FIRST, t) - v[i]);
    return DAL_STATUS_OK;
}

/* Gauss quadrature of order 8 between two rows: nodes (1 +- c)/2, c^2 = 3/7 -+ 2/7 sqrt(6/5),
 * weights (18 +- sqrt(30))/72. */
static dal_status integrate(const splines *s, dal_action_form form, double *sum)
{
    const double *t = s->t;
    const double root = 2.0 / 7.0 * sqrt(6.0 / 5.0);
    const double c[2] = {sqrt(3.0 / 7.0 - root), sqrt(3.0 / 7.0 + root)};
    const double weight[2] = {(18.0 + sqrt(30.0)) / 72.0, (18.0 - sqrt(30.0)) / 72.0};
    double value = 0.0;
    *sum = 0.0;
    for (int k = 0; k + 1 < s->knots; k++) {
        const double h = t[k + 1] - t[k];
        for (int i = 0; i < 4; i++) {
            const double at = t[k] + 0.5 * h * (1.0 + (i % 2 ? 1.0 : -1.0) * c[i / 2]);
            const dal_status status = integrand(s, form, at, &value);
            if (status == DAL_STATUS_MEMORY) return dal__memory_error(s->error);
            if (status != DAL_STATUS_OK || !isfinite(value))
                return dal__fail(
                    s->error, status == DAL_STATUS_OK ? DAL_STATUS_NOT_FINITE : status,
                    "the action is not determined at t = %.15g: %s", at,
                    dal_status_text(status == DAL_STATUS_OK ? DAL_STATUS_NOT_FINITE : status));
            *sum += h * weight[i / 2] * value;
        }
    }
    return DAL_STATUS_OK;
}

dal_status dal_evaluator_integrate_action(dal_evaluator *evaluator, const dal_curve *curve,
                                          dal_action_form form, dal_action *action,
                                          dal_error *error)
{
    DAL_REQUIRE(evaluator && curve && action, error);
    if ((unsigned)form >= DAL_ACTIONS)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "no action has the number %d", (int)form);
    if (form == DAL_ACTION_EQUATIONS && !dal_evaluator_system(evaluator)->equation_values)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED, "the system has no equations S^i = 0");
    splines s;
    double value[2] = {0.0};
    DAL_TRY(check_curve(&s, evaluator, curve, error));
    dal_status status = DAL_STATUS_OK;
    for (int k = 0; k < 2 && status == DAL_STATUS_OK; k++) {
        status = make_splines(&s, curve, k + 1);
        if (status == DAL_STATUS_OK) status = integrate(&s, form, &value[k]);
        free(s.data);
    }
    if (status != DAL_STATUS_OK) return status;
    *action = (dal_action){.value = value[0], .error = fabs(value[0] - value[1])};
    return DAL_STATUS_OK;
}

dal_status dal_evaluator_measure_curve(dal_evaluator *evaluator, const dal_curve *curve,
                                       double *max_constraint, dal_error *error)
{
    DAL_REQUIRE(evaluator && curve && max_constraint, error);
    const dal_system *system = dal_evaluator_system(evaluator);
    splines s;
    DAL_TRY(check_curve(&s, evaluator, curve, error));
    *max_constraint = 0.0;
    if (system->m == 0) return DAL_STATUS_OK;
    double *D = dal__numbers(1, (size_t)system->m);
    dal_status status = D ? make_splines(&s, curve, 1) : dal__memory_error(error);
    for (int k = 0; k < curve->rows && status == DAL_STATUS_OK; k++) {
        for (int i = 0; i < s.n; i++) {
            s.x[i] = spline_at(&s, Q, i, VALUE, curve->t[k]);
            s.x[s.n + i] = spline_at(&s, Q, i, FIRST, curve->t[k]);
        }
        status = dal_evaluator_call(evaluator, system->constraints, curve->t[k], s.x, s.x + s.n,
                                    NULL, D);
        for (int a = 0; a < system->m; a++)
            if (!(fabs(D[a]) <= *max_constraint)) *max_constraint = fabs(D[a]);
        if (status == DAL_STATUS_OK && !isfinite(*max_constraint)) status = DAL_STATUS_NOT_FINITE;
        if (status != DAL_STATUS_OK)
            dal__fail(error, status, "D is not determined at t = %.15g: %s", curve->t[k],
                      dal_status_text(status));
    }
    free(s.data);
    free(D);
    return status;
}
