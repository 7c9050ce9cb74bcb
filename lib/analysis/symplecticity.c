/* symplecticity.c - the step as a map on phase space: symplecticity, reversibility.
 *
 *     J = d(step)/dz by differences,   J^T Omega J = Omega,   Omega = [[0, 1], [-1, 0]]
 *     rho step rho step = id,          rho: (t,q,v,e,p,pi,pi_e) -> (-t,q,-v,e,-p,pi,-pi_e)
 *
 * rho is antisymplectic, leaves H = pi.pi/(2e) + pi.F + p.v alone when F(q,-v,-t) = F(q,v,t), and
 * so reverses its flow. */
#include "analysis/differences.h"
#include "core/error.h"
#include "core/settings.h"
#include "core/vectors.h"
#include "dalembert_action.h"
#include "dalembert_order.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A run and the point it steps from. */
typedef struct stepmap {
    dal_run *run;
    double t;
    double *z;    /* [dimension] */
    double *unit; /* [dimension] of the state */
    int dimension;
    dal_error *error;
} stepmap;

static dal_status step_from(stepmap *m, double t, const double *z, double *out)
{
    DAL_TRY(dal_run_set_state(m->run, t, z, m->error));
    DAL_TRY(dal_run_step(m->run, m->error));
    memcpy(out, dal_run_state(m->run), (size_t)m->dimension * sizeof(double));
    return DAL_STATUS_OK;
}

/* The unit of number i of the state by the units of the system; the products of canonical pairs
 * are 1. */
static double unit_of(const stepmap *m, int i)
{
    const dal_system *s = dal_run_system(m->run);
    const int e = 2 * s->n, first_momentum = e + 1, pi_e = 4 * s->n + 1;
    if (s->units == NULL) return 1.0;
    if (m->dimension != 4 * s->n + 2 || i < e) return s->units[i];
    return i == e || i == pi_e ? 1.0 : 1.0 / s->units[i - first_momentum];
}

/* A run of the spec; z is a copy of state, or of the run's start, with rows further vectors of the
 * dimension after it. */
static dal_status open_map(stepmap *m, const dal_run_spec *spec, double t, const double *state,
                           size_t rows, dal_error *error)
{
    *m = (stepmap){.error = error};
    DAL_TRY(dal__check_spec(spec, error));
    DAL_TRY(dal__refuse_events(spec->system, "maps of a step", error));
    DAL_TRY(dal_run_create(&m->run, spec, error));
    m->dimension = dal_run_dimension(m->run);
    m->t = state != NULL ? t : dal_run_time(m->run);
    m->z = dal__numbers(rows + 2, (size_t)m->dimension);
    if (m->z == NULL) {
        dal_run_free(m->run);
        return dal__memory_error(error);
    }
    if (state == NULL) state = dal_run_state(m->run);
    memcpy(m->z, state, (size_t)m->dimension * sizeof(double));
    m->unit = m->z + (rows + 1) * (size_t)m->dimension;
    for (int i = 0; i < m->dimension; i++) m->unit[i] = unit_of(m, i);
    return DAL_STATUS_OK;
}

static void close_map(stepmap *m)
{
    free(m->z);
    dal_run_free(m->run);
}

/* ---- symplecticity ---- */

static dal_status step_of(void *user, double *out)
{
    stepmap *m = user;
    return step_from(m, m->t, m->z, out);
}

/* columns[j] = d(step)/dz_j, in units of the system. */
static dal_status differentiate_step(stepmap *m, double increment, double *columns, double *scratch)
{
    const int n = dal_run_system(m->run)->n;
    for (int j = 0; j < m->dimension; j++) {
        /* The scale of a coordinate is the way of a step. */
        const double way = j < n ? dal_run_step_size(m->run) * m->z[n + j] : m->z[j];
        const double unit = m->unit[j], d = increment * fmax(unit, fabs(way));
        double *out = columns + (size_t)j * (size_t)m->dimension;
        DAL_TRY(dal__differentiate_by(&m->z[j], step_of, m, d, m->dimension, scratch, out));
        for (int i = 0; i < m->dimension; i++) out[i] *= unit / m->unit[i];
    }
    return DAL_STATUS_OK;
}

static double omega_defect(const double *columns, int dimension)
{
    int pairs = dimension / 2;
    double max = 0.0;
    for (int i = 0; i < dimension; i++) {
        for (int j = 0; j < i; j++) {
            const double *a = columns + (size_t)i * (size_t)dimension;
            const double *b = columns + (size_t)j * (size_t)dimension;
            double expected = i == j + pairs ? -1.0 : 0.0;
            double defect = fabs(dal_poisson(a, b, pairs) - expected);
            if (!(defect <= max)) max = isnan(defect) ? INFINITY : defect;
        }
    }
    return max;
}

dal_status dal_check_symplecticity(const dal_run_spec *spec, double t, const double *state,
                                   double increment, double *defect, dal_error *error)
{
    DAL_REQUIRE(defect, error);
    DAL_TRY(dal__check_spec(spec, error));
    stepmap m;
    if (spec->options.space != DAL_LIFTED)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "symplecticity is a property of the lifted space");
    if (!(increment > 0.0)) increment = DAL__INCREMENT;
    size_t dimension = 4 * (size_t)spec->system->n + 2;
    DAL_TRY(open_map(&m, spec, t, state, dimension + 3, error));
    double *columns = m.z + dimension;
    dal_status status = differentiate_step(&m, increment, columns, columns + dimension * dimension);
    if (status == DAL_STATUS_OK) *defect = omega_defect(columns, m.dimension);
    close_map(&m);
    return status;
}

/* ---- reversibility ---- */

/* -1 where D is odd in v: then g of L - g.D changes its sign too. */
static dal_status multiplier_sign(const dal_run_spec *spec, const stepmap *m, double *sign,
                                  dal_error *error)
{
    dal_evaluator *evaluator;
    dal_constraint_class class;
    *sign = 1.0;
    if (spec->system->multipliers == 0) return DAL_STATUS_OK;
    DAL_TRY(dal_evaluator_create(&evaluator, spec->system, spec->parameters, spec->parameter_count,
                                 error));
    dal_point at = {.t = m->t, .q = m->z, .v = m->z + spec->system->n};
    dal_status status = dal_evaluator_classify_constraints(evaluator, &at, &class, NULL);
    if (status == DAL_STATUS_OK && class.parity == -1) *sign = -1.0;
    dal_evaluator_free(evaluator);
    if (status == DAL_STATUS_OK) return DAL_STATUS_OK;
    return dal__fail(error, status, "t = %g: the parity of D cannot be found: %s", m->t,
                     dal_status_text(status));
}

static void reverse_time(int n, int dimension, double sign, double *z)
{
    for (int i = n; i < 2 * n; i++) z[i] = -z[i];
    if (dimension == 4 * n + 2) {
        for (int i = 2 * n + 1; i < 3 * n + 1; i++) z[i] = -z[i];
        z[4 * n + 1] = -z[4 * n + 1];
    } else {
        for (int i = 2 * n; i < dimension; i++) z[i] *= sign;
    }
}

dal_status dal_check_reversibility(const dal_run_spec *spec, double t, const double *state,
                                   double *defect, dal_error *error)
{
    DAL_REQUIRE(defect, error);
    stepmap m;
    double sign;
    DAL_TRY(open_map(&m, spec, t, state, 1, error));
    double *z = m.z + m.dimension;
    dal_status status = multiplier_sign(spec, &m, &sign, error);
    if (status == DAL_STATUS_OK) status = step_from(&m, m.t, m.z, z);
    reverse_time(spec->system->n, m.dimension, sign, z);
    if (status == DAL_STATUS_OK) status = step_from(&m, -dal_run_time(m.run), z, z);
    reverse_time(spec->system->n, m.dimension, sign, z);
    if (status == DAL_STATUS_OK) *defect = dal__distance(m.z, z, m.unit, (size_t)m.dimension);
    close_map(&m);
    return status;
}
