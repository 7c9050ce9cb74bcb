/* spectrum.c - Lyapunov exponents of the step map, and the volume it keeps.
 *
 *     z' = step(z),   J = dz'/dz,   J V = V' R   (V, V' orthonormal, R upper triangular)
 *     exponent i = lim (1/T) sum log R_ii        (Benettin, Galgani, Giorgilli, Strelcyn 1980,
 *                                                 DOI 10.1007/BF02128236)
 *     log|det J| = sum log R_ii                  when V has all directions
 *
 * J V: a Runge-Kutta or polarised method applied to the tangent system (q, dq, v, dv) moves dq, dv
 * by its own derivative; any other map is differentiated numerically, along each vector by eight
 * steps.  R by modified Gram-Schmidt, every vector twice over, so that V' is orthonormal to
 * rounding (Giraud, Langou, Rozloznik 2005, DOI 10.1016/j.camwa.2005.08.009). */
#include "measure/measure.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* J = 1 + O(h), so that R_ii is near 1; a direction that the map loses leaves the noise of
 * differences. */
static const double lost_direction = 1e-6;

struct dal_spectrum {
    dal_run *run;   /* the trajectory */
    dal_run *aside; /* steps tangent vectors, or what differences need, from where the run is */
    dal_probe *probe;
    int n, nw, dimension, count, rank, exact;
    double h, divergence;       /* at the present state */
    double *vectors;            /* [dimension*dimension] the first count of them are in use */
    double *growth;             /* [dimension + 2] log R_ii / h of a step, their sum, div F */
    double *scratch;            /* [3*dimension], or the jacobian's [nw*n + nw*nw] */
    double t, *z;               /* [dimension] where the step began */
    const double *direction;    /* the vector along which is differentiated */
    dal_statistics *statistics; /* [count + 2] of growth */
    dal_error *error;
};

/* ---- J times a vector ---- */

/* (dq, dv) by a step of the tangent system from (q, dq, v, dv). */
static dal_status move_exactly(dal_spectrum *s, double *vector)
{
    const size_t n = (size_t)s->n, bytes = n * sizeof(double);
    double *x = s->scratch;
    memcpy(x, s->z, bytes);
    memcpy(x + n, vector, bytes);
    memcpy(x + 2 * n, s->z + n, bytes);
    memcpy(x + 3 * n, vector + n, bytes);
    DAL_TRY(dal_run_set_state(s->aside, s->t, x, s->error));
    DAL_TRY(dal_run_step(s->aside, s->error));
    memcpy(vector, dal_run_state(s->aside) + n, bytes);
    memcpy(vector + n, dal_run_state(s->aside) + 3 * n, bytes);
    return DAL_OK;
}

static dal_status step_along(void *user, double size, double *out)
{
    dal_spectrum *s = user;
    double *z = s->scratch;
    for (int i = 0; i < s->dimension; i++) z[i] = s->z[i] + size * s->direction[i];
    DAL_TRY(dal_run_set_state(s->aside, s->t, z, s->error));
    DAL_TRY(dal_run_step(s->aside, s->error));
    memcpy(out, dal_run_state(s->aside), (size_t)s->dimension * sizeof(double));
    return DAL_OK;
}

static dal_status move_by_differences(dal_spectrum *s, double *vector)
{
    const size_t count = (size_t)s->dimension;
    double *value = s->scratch + count, *out = value + count;
    const double size = dal__increment(dal__greatest(s->z, count));
    s->direction = vector;
    DAL_TRY(dal__differentiate(step_along, s, size, s->dimension, value, out));
    memcpy(vector, out, count * sizeof(double));
    return DAL_OK;
}

/* ---- Gram-Schmidt ---- */

static double dot(const double *a, const double *b, int count)
{
    double sum = 0.0;
    for (int i = 0; i < count; i++) sum += a[i] * b[i];
    return sum;
}

/* Vector j loses its parts along those before it and becomes a unit vector; its length then. */
static double straighten(const dal_spectrum *s, int j)
{
    const int d = s->dimension;
    double *x = s->vectors + j * d;
    for (int k = 0; k < j; k++) {
        const double *before = s->vectors + k * d, part = dot(before, x, d);
        for (int i = 0; i < d; i++) x[i] -= part * before[i];
    }
    const double length = sqrt(dot(x, x, d));
    for (int i = 0; i < d; i++) x[i] /= length;
    return length;
}

static dal_status orthonormalise(dal_spectrum *s, int count)
{
    for (int j = 0; j < count; j++) {
        s->growth[j] = straighten(s, j);
        if (s->growth[j] > 0.0 && isfinite(s->growth[j])) s->growth[j] *= straighten(s, j);
        if (!(s->growth[j] > 0.0) || !isfinite(s->growth[j]))
            return dal__error(s->error, DAL_SINGULAR, 0, 0,
                              "t = %g: the derivative of the step takes a vector to %g", s->t,
                              s->growth[j]);
    }
    return DAL_OK;
}

static dal_status move_vectors(dal_spectrum *s, int count)
{
    for (int j = 0; j < count; j++) {
        double *vector = s->vectors + j * s->dimension;
        DAL_TRY(s->exact ? move_exactly(s, vector) : move_by_differences(s, vector));
    }
    return DAL_OK;
}

/* Orthonormal vectors in directions of no particular kind. */
static dal_status draw_vectors(dal_spectrum *s)
{
    dal__random random = {1};
    for (int i = 0; i < s->dimension * s->dimension; i++) s->vectors[i] = dal__uniform(&random);
    return orthonormalise(s, s->dimension);
}

/* ---- a step ---- */

static dal_status find_divergence(dal_spectrum *s)
{
    const dal_system *system = dal_probe_system(s->probe);
    const double *z = dal_run_state(s->run), *by_v = s->scratch + s->nw * s->n;
    s->divergence = NAN;
    if (system->call.jacobian == NULL) return DAL_OK;
    const dal_status status = dal_probe_call(s->probe, system->call.jacobian, dal_run_time(s->run),
                                             z, z + s->n, NULL, s->scratch);
    if (status != DAL_OK)
        return dal__error(s->error, status, 0, 0, "t = %g: no jacobian: %s", dal_run_time(s->run),
                          dal_status_text(status));
    s->divergence = 0.0;
    for (int i = 0; i < s->nw; i++) s->divergence += by_v[i * s->nw + i];
    return DAL_OK;
}

static void hold_state(dal_spectrum *s)
{
    s->t = dal_run_time(s->run);
    memcpy(s->z, dal_run_state(s->run), (size_t)s->dimension * sizeof(double));
}

static dal_status take_step(dal_spectrum *s)
{
    const double before = s->divergence;
    double *sum = s->growth + s->count;
    hold_state(s);
    DAL_TRY(move_vectors(s, s->count));
    DAL_TRY(orthonormalise(s, s->count));
    DAL_TRY(dal_run_step(s->run, s->error));
    DAL_TRY(find_divergence(s));
    *sum = 0.0;
    for (int j = 0; j < s->count; j++) *sum += s->growth[j] = log(s->growth[j]) / s->h;
    sum[1] = 0.5 * (before + s->divergence);
    dal_statistics_add(s->statistics, s->count + 2, dal_run_time(s->run), s->growth);
    return DAL_OK;
}

dal_status dal_spectrum_advance(dal_spectrum *s, long long steps, dal_error *error)
{
    DAL_REQUIRE(s, error);
    DAL_REQUIRE_COUNT(steps, error);
    dal_status status = DAL_OK;
    s->error = error;
    for (; steps > 0 && status == DAL_OK; steps--) status = take_step(s);
    s->error = NULL;
    return status;
}

void dal_spectrum_forget(dal_spectrum *s)
{
    if (s) dal_statistics_start(s->statistics, s->count + 2);
}

/* ---- making one ---- */

/* A step that is made of values of F alone moves a tangent vector by its own derivative. */
static int is_exact(const dal_run_spec *spec, const dal_system *tangent)
{
    const unsigned of_field = DAL_NEEDS_FIELD | DAL_NEEDS_SYMMETRIC | DAL_NEEDS_ORDER_2;
    return tangent != NULL && !spec->options.extend_energy &&
           !(dal_method_needs(&spec->method) & ~of_field);
}

static dal_status check(const dal_run_spec *spec, const dal_system *tangent, dal_error *error)
{
    char name[128];
    dal_method_name(&spec->method, name, sizeof name);
    if (tangent && tangent->n != 2 * spec->system->n)
        return dal__error(error, DAL_ARGUMENT, 0, 0,
                          "a tangent system of %d coordinates for a system of %d", tangent->n,
                          spec->system->n);
    if (dal_method_claims(&spec->method) & DAL_CARRIES_MULTIPLIER)
        return dal__error(error, DAL_UNSUPPORTED, 0, 0,
                          "%s carries a multiplier along: its step is no map of (q,v) alone", name);
    if (spec->options.tolerance > 0.0)
        return dal__error(error, DAL_UNSUPPORTED, 0, 0,
                          "%s with a tolerance divides its step: it is no smooth map", name);
    return DAL_OK;
}

static dal_status open_runs(dal_spectrum *s, const dal_run_spec *given, const dal_system *tangent,
                            dal_error *error)
{
    dal_run_spec spec = *given;
    spec.options.space = DAL_PHYSICAL;
    DAL_TRY(dal_run_create(&s->run, &spec, error));
    const dal_system *system = dal_run_system(s->run);
    s->exact = is_exact(&spec, tangent);
    if (s->exact) spec.system = tangent, spec.start_count = 0;
    DAL_TRY(dal_run_create(&s->aside, &spec, error));
    s->n = system->n;
    s->nw = system->n + system->multipliers;
    s->dimension = s->n + s->nw;
    s->h = spec.options.step;
    return dal_probe_create(&s->probe, system, spec.parameters, spec.parameter_count, error);
}

static dal_status allocate(dal_spectrum *s, dal_error *error)
{
    const size_t d = (size_t)s->dimension, jacobian = (size_t)s->nw * d;
    const size_t scratch = jacobian > 3 * d ? jacobian : 3 * d;
    double *block = dal__numbers(1, d * d + d + d + 2 + scratch);
    s->vectors = block;
    s->statistics = calloc(d + 2, sizeof *s->statistics);
    if (block == NULL || s->statistics == NULL)
        return dal__error(error, DAL_MEMORY, 0, 0, "spectrum: out of memory");
    s->z = block + d * d;
    s->growth = s->z + d;
    s->scratch = s->growth + d + 2;
    return DAL_OK;
}

/* How many directions a step from the start leaves: behind them R_ii is 0, or noise.  The vectors
 * stay as that step left them: where it forces D = 0 they are tangent to that surface by then. */
static dal_status find_rank(dal_spectrum *s)
{
    dal_error ignored;
    dal_error *error = s->error;
    hold_state(s);
    DAL_TRY(draw_vectors(s));
    DAL_TRY(move_vectors(s, s->dimension));
    s->error = &ignored;
    orthonormalise(s, s->dimension);
    s->error = error;
    while (s->rank < s->dimension && s->growth[s->rank] > lost_direction) s->rank++;
    return DAL_OK;
}

static dal_status make(dal_spectrum *s, const dal_run_spec *spec, const dal_system *tangent,
                       int count, dal_error *error)
{
    DAL_TRY(open_runs(s, spec, tangent, error));
    DAL_TRY(allocate(s, error));
    s->error = error;
    DAL_TRY(find_rank(s));
    DAL_TRY(find_divergence(s));
    if (count < 0 || count > s->rank)
        return dal__error(error, DAL_ARGUMENT, 0, 0,
                          "%d exponents are asked for; the step map has %d directions", count,
                          s->rank);
    s->count = count > 0 ? count : s->rank;
    s->error = NULL;
    dal_spectrum_forget(s);
    return DAL_OK;
}

dal_status dal_spectrum_create(dal_spectrum **spectrum, const dal_run_spec *spec,
                               const dal_system *tangent, int count, dal_error *error)
{
    DAL_REQUIRE(spectrum, error);
    *spectrum = NULL;
    DAL_TRY(dal__check_spec(spec, error));
    DAL_TRY(check(spec, tangent, error));
    dal_spectrum *s = calloc(1, sizeof *s);
    if (s == NULL) return dal__error(error, DAL_MEMORY, 0, 0, "spectrum: out of memory");
    const dal_status status = make(s, spec, tangent, count, error);
    if (status == DAL_OK)
        *spectrum = s;
    else
        dal_spectrum_free(s);
    return status;
}

void dal_spectrum_free(dal_spectrum *s)
{
    if (s == NULL) return;
    dal_run_free(s->run);
    dal_run_free(s->aside);
    dal_probe_free(s->probe);
    free(s->vectors);
    free(s->statistics);
    free(s);
}

/* ---- what is asked of it ---- */

const dal_run *dal_spectrum_run(const dal_spectrum *s) { return s ? s->run : NULL; }
int dal_spectrum_count(const dal_spectrum *s) { return s ? s->count : 0; }
int dal_spectrum_is_exact(const dal_spectrum *s) { return s && s->exact; }
int dal_spectrum_is_whole(const dal_spectrum *s) { return s && s->count == s->rank; }

/* The mean of number i of growth; NaN where there is no such number. */
static void mean_of(const dal_spectrum *s, int i, dal_average *average)
{
    dal_statistics_mean(s && i >= 0 ? &s->statistics[i] : NULL, average);
}

void dal_spectrum_exponent(const dal_spectrum *s, int i, dal_average *average)
{
    mean_of(s, s && i < s->count ? i : -1, average);
}

void dal_spectrum_sum(const dal_spectrum *s, dal_average *average)
{
    mean_of(s, s ? s->count : -1, average);
}

void dal_spectrum_divergence(const dal_spectrum *s, dal_average *average)
{
    mean_of(s, s ? s->count + 1 : -1, average);
}
