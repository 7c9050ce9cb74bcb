/* lyapunov.c - Lyapunov exponents of the step map, and its volume.
 *
 *     z' = step(z),   J = dz'/dz,   J V = V' R   (V, V' orthonormal, R upper triangular)
 *     exponent i = lim (1/T) sum log R_ii        (Benettin, Galgani, Giorgilli, Strelcyn 1980,
 *                                                 DOI 10.1007/BF02128236)
 *     log|det J| = sum log R_ii                  when V has all directions
 *
 * J V: a Runge-Kutta method or partitioned symplectic Euler, applied to the tangent system
 * (q, dq, v, dv), moves dq, dv by its own derivative; any other map is differentiated numerically,
 * along each vector by eight steps, or more where it is less smooth.  R by modified Gram-Schmidt,
 * twice for every vector, so that V' is orthonormal to rounding (Giraud, Langou, Rozloznik 2005,
 * DOI 10.1016/j.camwa.2005.08.009).
 *
 * V is a frame of (q/l, v/u, g/u) in the system's own units, see lib/analysis/scaled.c: what is
 * orthonormal, which direction is lost and how far the means are from their limits do not depend on
 * the units of the user.
 *
 * Of the lift it is a frame of (q/l, v/u, p l/s, pi u/s) at constant e, with one action
 * s = e u^2/tau of the largest u, so that the symplectic form is the same for every pair.  The lift
 * is Hamiltonian: its divergence is 0 and its exponents are in pairs, lambda and -lambda.  On
 * p = pi = 0 J is [[A, B], [0, A^-T]], A being the derivative of the step on (q, v): they are then
 * the exponents of (q, v) and their negatives. */
#include "analysis/derivatives.h"
#include "analysis/differences.h"
#include "analysis/scaled.h"
#include "core/error.h"
#include "core/settings.h"
#include "core/vectors.h"
#include "dalembert_dynamics.h"
#include "dynamics/tangent_map.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* J = 1 + O(h), so that R_ii is near 1, or the noise of differences in a direction that the map
 * loses. */
static const double lost_direction = 1e-6;

/* Means beside the means of the exponents, see growth. */
enum { EXTRA_MEANS = 4 };

struct dal_lyapunov {
    dal_run *run;       /* the trajectory */
    dal_run *auxiliary; /* steps tangent vectors, or displaced states, from the state of the run */
    dal_scaled *scaled; /* the system in its own units */
    dal_evaluator *evaluator;          /* of that */
    double *unit;                      /* [dimension] of the vectors */
    dal_space space;                   /* lifted: vectors are (dq, dv, dp, dpi) */
    double time;                       /* the unit of time */
    int n, nw, dimension, count, rank; /* dimension: of the vectors */
    int size;                          /* of the state */
    int order;                         /* of the method */
    int enforced;                      /* functions that the method enforces: D, then g, then E */
    bool is_symplectic;                /* J is, of the lift */
    bool is_exact;                     /* J is by the tangent system */
    bool turns_D;               /* the method turns D into -D: off D = 0 it is not near the flow */
    double h, divergence, rate; /* at the present state; rate: see find_divergence */
    double change;              /* max |J V - V| of a vector in the present step */
    double *vectors;            /* [dimension*dimension] the first count of them are in use */
    double *growth;    /* [dimension + 4] log R_ii / h of a step, their sum, div F, what the
                        error of the step may be, and by how much div F has changed */
    double *scratch;   /* [5*dimension], the jacobian's [nw*n + nw*nw], or [3*size] */
    double *gradients; /* [(m + holonomic + 1)*dimension] of what is enforced */
    double *place;     /* [dimension] the state of the run in units */
    double t, *z;      /* [size] where the step began */
    double *memory, *displaced; /* [memory_count] all of the run there, and beside it */
    size_t memory_count;
    bool has_remainder;         /* memory is y, r, ..: not in quad precision */
    double from, log_from;      /* where the means began: t, and log of the size of the gradients */
    dal_status from_status;     /* of the gradients there */
    const double *direction;    /* the vector along which is differentiated */
    dal_statistics *statistics; /* [count + 4] of growth */
    dal_error *error;
};

/* ---- J times a vector ---- */

/* A vector by a step of the tangent system. */
static dal_status move_exactly(dal_lyapunov *s, double *vector)
{
    const dal_system *system = dal_run_system(s->run);
    double *of_state = s->scratch, *x = of_state + s->size, change = 0.0;
    for (int i = 0; i < s->dimension; i++)
        of_state[dal__varied_place(s->space, s->n, i)] = vector[i] * s->unit[i];
    if (s->space == DAL_LIFTED) of_state[s->size - 1] = 0.0; /* dpi_e moves nothing */
    dal__tangent_scatter(system, s->space, s->z, of_state, x);
    DAL_TRY(dal_run_set_state(s->auxiliary, s->t, x, s->error));
    DAL_TRY(dal_run_step(s->auxiliary, s->error));
    dal__tangent_gather(system, s->space, dal_run_state(s->auxiliary), of_state);
    for (int i = 0; i < s->dimension; i++) {
        const double moved = of_state[dal__varied_place(s->space, s->n, i)] / s->unit[i];
        change = hypot(change, moved - vector[i]);
        vector[i] = moved;
    }
    s->change = fmax(s->change, change);
    return DAL_STATUS_OK;
}

/* Puts the auxiliary run at z + size * direction: what rounding takes from y goes to its remainder
 * r, so that a coordinate may be any distance away.  In quad precision the state is rounded. */
static dal_status displace(dal_lyapunov *s, double size)
{
    const int d = s->dimension;
    double *z = s->displaced;
    memcpy(z, s->memory, s->memory_count * sizeof(double));
    for (int i = 0; i < d; i++) {
        const double change = size * s->direction[i] * s->unit[i];
        const double y = s->z[i] + change, added = y - s->z[i];
        z[i] = y;
        if (s->has_remainder) z[d + i] += (s->z[i] - (y - added)) + (change - added);
    }
    if (s->has_remainder) return dal_run_restore(s->auxiliary, z, s->memory_count, s->error);
    return dal_run_set_state(s->auxiliary, s->t, z, s->error);
}

/* How far that is then from z, in units. */
static dal_status step_along(void *user, double size, double *out)
{
    dal_lyapunov *s = user;
    const int d = s->dimension;
    size_t count;
    DAL_TRY(displace(s, size));
    DAL_TRY(dal_run_step(s->auxiliary, s->error));
    const double *y = dal_run_state(s->auxiliary), *r = dal_run_save(s->auxiliary, &count) + d;
    for (int i = 0; i < d; i++) out[i] = y[i] - s->z[i];
    for (int i = 0; i < d && s->has_remainder; i++) out[i] += r[i] - s->memory[d + i];
    for (int i = 0; i < d; i++) out[i] /= s->unit[i];
    return DAL_STATUS_OK;
}

/* By how much the vector exceeds what its components are measured by. */
static double size_of(const dal_lyapunov *s, const double *vector)
{
    double max = 0.0;
    for (int i = 0; i < s->dimension; i++) {
        const double rate = i < s->n ? s->h * s->z[s->n + i] : s->z[i];
        max = fmax(max, fabs(vector[i]) / fmax(1.0, fabs(rate / s->unit[i])));
    }
    return max;
}

static dal_status move_by_differences(dal_lyapunov *s, double *vector)
{
    const size_t count = (size_t)s->dimension;
    double *value = s->scratch + count, *out = value + 3 * count;
    const double size = DAL__INCREMENT / size_of(s, vector);
    s->direction = vector;
    DAL_TRY(dal__differentiate(step_along, s, size, s->dimension, value, out));
    memcpy(vector, out, count * sizeof(double));
    return DAL_STATUS_OK;
}

/* ---- Gram-Schmidt ---- */

static dal_status orthonormalise(dal_lyapunov *s, int count)
{
    for (int j = 0; j < count; j++) {
        const int d = s->dimension;
        s->growth[j] = dal__orthonormalise_row(s->vectors, j, d);
        if (s->growth[j] > 0.0 && isfinite(s->growth[j]))
            s->growth[j] *= dal__orthonormalise_row(s->vectors, j, d);
        if (!(s->growth[j] > 0.0) || !isfinite(s->growth[j]))
            return dal__fail(s->error, DAL_STATUS_SINGULAR,
                             "t = %g: the derivative of the step takes a vector to %g", s->t,
                             s->growth[j]);
    }
    return DAL_STATUS_OK;
}

static dal_status move_vectors(dal_lyapunov *s, int count)
{
    for (int j = 0; j < count; j++) {
        double *vector = s->vectors + j * s->dimension;
        DAL_TRY(s->is_exact ? move_exactly(s, vector) : move_by_differences(s, vector));
    }
    return DAL_STATUS_OK;
}

/* ---- a step ---- */

static double row_norm(const double *matrix, int rows, int columns)
{
    double max = 0.0;
    for (int i = 0; i < rows; i++) {
        double sum = 0.0;
        for (int j = 0; j < columns; j++) sum += fabs(matrix[i * columns + j]);
        max = fmax(max, sum);
    }
    return max;
}

/* The state of the run in units. */
static dal_point scale_point(const dal_lyapunov *s)
{
    const double *z = dal_run_state(s->run);
    for (int i = 0; i < s->n + s->nw; i++) s->place[i] = z[i] / s->unit[i];
    return (dal_point){.t = dal_run_time(s->run) / s->time, .q = s->place, .v = s->place + s->n};
}

/* The trace of F_(v,g), or 0 of the lift, and a rate at which motions near this one come and go. */
static dal_status find_divergence(dal_lyapunov *s)
{
    const dal_system *system = dal_evaluator_system(s->evaluator);
    const double *by_v = s->scratch + s->nw * s->n;
    s->divergence = s->rate = NAN;
    if (system->call.jacobian == NULL) return DAL_STATUS_OK;
    const dal_point at = scale_point(s);
    const dal_status status =
        dal_evaluator_call(s->evaluator, system->call.jacobian, at.t, at.q, at.v, NULL, s->scratch);
    if (status != DAL_STATUS_OK)
        return dal__fail(s->error, status, "t = %g: no jacobian: %s", dal_run_time(s->run),
                         dal_status_text(status));
    s->divergence = 0.0;
    for (int i = 0; i < s->nw && s->space == DAL_PHYSICAL; i++)
        s->divergence += by_v[i * s->nw + i] / s->time;
    s->rate = fmax(sqrt(row_norm(s->scratch, s->nw, s->n)), row_norm(by_v, s->nw, s->nw)) / s->time;
    return DAL_STATUS_OK;
}

/* Where a run is. */
static void hold_state(dal_lyapunov *s, const dal_run *run)
{
    const double *memory = dal_run_save(run, &s->memory_count);
    s->t = dal_run_time(run);
    memcpy(s->z, dal_run_state(run), (size_t)s->size * sizeof(double));
    memcpy(s->memory, memory, s->memory_count * sizeof(double));
}

static dal_status step_vectors(dal_lyapunov *s)
{
    const double before = s->divergence;
    double *sum = s->growth + s->count;
    hold_state(s, s->run);
    s->change = 0.0;
    DAL_TRY(move_vectors(s, s->count));
    DAL_TRY(orthonormalise(s, s->count));
    DAL_TRY(dal_run_step(s->run, s->error));
    DAL_TRY(find_divergence(s));
    /* Off p = pi = 0 the lift has rates that F_q and F_v do not have. */
    if (s->space == DAL_LIFTED) s->rate = fmax(s->rate, s->change / s->h);
    *sum = 0.0;
    for (int j = 0; j < s->count; j++) *sum += s->growth[j] = log(s->growth[j]) / s->h;
    sum[1] = 0.5 * (before + s->divergence);
    /* An error bound: a power series in h r without its terms up to the order of the method; there
     * is none where it does not converge, and none is needed where det J = 1. */
    const double x = s->h * s->rate;
    sum[2] = s->is_symplectic ? 0.0
             : x < 1.0        ? s->dimension * s->rate * pow(x, s->order) / (1.0 - x)
                              : INFINITY;
    sum[3] = s->divergence - before;
    dal_statistics_add(s->statistics, s->count + EXTRA_MEANS, dal_run_time(s->run), s->growth);
    return DAL_STATUS_OK;
}

dal_status dal_lyapunov_advance(dal_lyapunov *s, long long steps, dal_error *error)
{
    DAL_REQUIRE(s, error);
    DAL_REQUIRE_COUNT(steps, error);
    dal_status status = DAL_STATUS_OK;
    s->error = error;
    for (; steps > 0 && status == DAL_STATUS_OK; steps--) status = step_vectors(s);
    s->error = NULL;
    return status;
}

/* ---- what the method enforces ---- */

/* Finds the gradients of what is enforced, orthonormalises them and leaves the log of the volume
 * that they spanned, NaN where they cannot be computed. */
static dal_status find_gradients(dal_lyapunov *s, double *log_volume)
{
    const dal_system *system = dal_evaluator_system(s->evaluator);
    const dal_point at = scale_point(s);
    const struct {
        dal_callback *values;
        int count;
    } kinds[] = {{system->constraints, system->m},
                 {system->call.holonomic, system->holonomic},
                 {system->energy, 1}};
    double size = 0.0;
    int found = 0;
    dal_status status = DAL_STATUS_OK;
    for (int k = 0; found < s->enforced && status == DAL_STATUS_OK; found += kinds[k++].count)
        if (kinds[k].count > 0)
            status = dal__gradients(s->evaluator, kinds[k].values, kinds[k].count, &at,
                                    s->gradients + found * s->dimension);
    for (int j = 0; j < s->enforced && status == DAL_STATUS_OK; j++)
        size += log(dal__orthonormalise_row(s->gradients, j, s->dimension));
    *log_volume = status == DAL_STATUS_OK ? size : NAN;
    return status;
}

/* The functions whose directions are lost: D, then g, then E; 0: others are. */
static int find_enforced(const dal_lyapunov *s, unsigned properties)
{
    const dal_system *system = dal_evaluator_system(s->evaluator);
    const int lost = s->dimension - s->rank, D = system->m, g = D + system->holonomic;
    const int E = g + ((properties & DAL_PRESERVES_ENERGY) != 0);
    return lost == D || lost == g || lost == E ? lost : 0;
}

void dal_lyapunov_discard_transient(dal_lyapunov *s)
{
    if (!s) return;
    dal_statistics_start(s->statistics, s->count + EXTRA_MEANS);
    s->from = dal_run_time(s->run);
    s->from_status = find_gradients(s, &s->log_from);
}

dal_status dal_lyapunov_balance(dal_lyapunov *s, dal_balance *balance, dal_error *error)
{
    DAL_REQUIRE(s, error);
    DAL_REQUIRE(balance, error);
    dal_average sum, divergence, step;
    const double T = dal_run_time(s->run) - s->from;
    dal_statistics_mean(&s->statistics[s->count], &sum);
    dal_statistics_mean(&s->statistics[s->count + 1], &divergence);
    dal_statistics_mean(&s->statistics[s->count + 2], &step);
    if (s->count < s->rank)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED, "%d of %d exponents have no sum to compare",
                         s->count, s->rank);
    if (s->rank + s->enforced < s->dimension)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "the step map loses %d directions: more than constraints explain",
                         s->dimension - s->rank);
    if (s->turns_D)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "the method turns D into -D, the motion does not");
    if (isnan(divergence.mean))
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "there is no divergence: no step, or no jacobian");
    if (isnan(step.mean))
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "the step is too long: h max(|F_q|^(1/2), |F_v|) reaches 1");
    const double noise = s->is_exact ? 1e-13 : 1e-7;
    const double jump = dal_statistics_max_abs(&s->statistics[s->count + 3]);
    double log_volume;
    if (s->from_status == DAL_STATUS_MEMORY || find_gradients(s, &log_volume) == DAL_STATUS_MEMORY)
        return dal__memory_error(error);
    balance->surface = (log_volume - s->log_from) / T;
    if (isnan(balance->surface))
        return dal__fail(error, DAL_STATUS_UNSUPPORTED, "the gradient of D or E is not finite");
    balance->difference = sum.mean - divergence.mean - balance->surface;
    balance->margin = step.mean + s->h * jump / T + noise * s->count / s->h;
    balance->holds = fabs(balance->difference) <= balance->margin;
    return DAL_STATUS_OK;
}

/* ---- making one ---- */

static dal_status check_map(const dal_run_spec *spec, dal_space space, const dal_system *tangent,
                            dal_error *error)
{
    char name[128];
    dal_method_name(&spec->method, name, sizeof name);
    if (tangent && tangent->n != 2 * spec->system->n)
        return dal__fail(error, DAL_STATUS_ARGUMENT,
                         "a tangent system of %d coordinates for a system of %d", tangent->n,
                         spec->system->n);
    const char *fault = tangent ? dal__tangent_fault(spec, space) : "it has no tangent system";
    if (space == DAL_LIFTED && fault)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED, "no exponents of the lift by %s: %s", name,
                         fault);
    if (dal_method_properties(&spec->method) & DAL_PERSISTENT_MULTIPLIER)
        return dal__fail(
            error, DAL_STATUS_UNSUPPORTED,
            "%s has a multiplier as persistent state: its step is no map of (q,v) alone", name);
    if (spec->options.tolerance > 0.0)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "%s with a tolerance divides its step: it is no smooth map", name);
    return DAL_STATUS_OK;
}

static dal_status open_runs(dal_lyapunov *s, const dal_run_spec *given, const dal_system *tangent,
                            dal_error *error)
{
    dal_run_spec spec = *given;
    spec.options.space = s->space;
    if (spec.options.step < 0.0)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "exponents need a positive step; it is %g",
                         spec.options.step);
    DAL_TRY(dal__refuse_events(spec.system, "tangent vectors", error));
    DAL_TRY(dal_run_create(&s->run, &spec, error));
    const dal_system *system = dal_run_system(s->run);
    dal_method method = spec.method;
    bool is_projected; /* to g = 0, which no tangent vector is */
    DAL_TRY(dal_method_complete(&method, system, &spec.options, &is_projected, error));
    s->is_exact = tangent && !is_projected && dal__tangent_fault(&spec, s->space) == NULL;
    if (s->space == DAL_LIFTED && !s->is_exact)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "no exponents of the lift: steps are projected to holonomic constraints, "
                         "and tangent vectors are not: take the option bare");
    if (s->is_exact) spec.system = tangent, spec.start_count = 0;
    DAL_TRY(dal_run_create(&s->auxiliary, &spec, error));
    s->n = system->n;
    s->nw = system->n + system->multipliers;
    s->size = dal_run_dimension(s->run);
    s->dimension = s->space == DAL_LIFTED ? 4 * s->n : s->n + s->nw;
    s->h = spec.options.step;
    s->order = dal_method_order(&spec.method);
    s->has_remainder = spec.options.precision == DAL_DOUBLE;
    DAL_TRY(dal_scaled_create_at(&s->scaled, s->run, error));
    DAL_TRY(dal__evaluator_of_run(&s->evaluator, s->scaled, s->run, error));
    s->time = dal_scaled_units(s->scaled)[0];
    return DAL_STATUS_OK;
}

static void fill_units(dal_lyapunov *s)
{
    const double *unit = dal_scaled_units(s->scaled) + 1;
    const int n = s->n;
    memcpy(s->unit, unit, (size_t)(n + s->nw) * sizeof *unit);
    if (s->space == DAL_PHYSICAL) return;
    const double e = fabs(dal_run_state(s->run)[2 * n]), u = dal__max_abs(unit + n, (size_t)n);
    const double action = (isfinite(e) ? e : 1.0) * u * u / s->time;
    for (int i = 0; i < 2 * n; i++) s->unit[2 * n + i] = action / unit[i];
}

static dal_status allocate_vectors(dal_lyapunov *s, dal_error *error)
{
    const size_t d = (size_t)s->dimension, size = (size_t)s->size;
    const size_t scratch = (size_t)s->nw * (size_t)(s->n + s->nw) + 5 * d + 3 * size;
    const dal_system *system = dal_run_system(s->run);
    const size_t gradients = (size_t)(system->m + system->holonomic + 1) * d;
    dal_run_save(s->run, &s->memory_count);
    const size_t memory = s->memory_count > d ? s->memory_count : d;
    double *block =
        dal__numbers(1, d * d + 3 * d + size + EXTRA_MEANS + scratch + gradients + 2 * memory);
    s->vectors = block;
    s->statistics = calloc(d + EXTRA_MEANS, sizeof *s->statistics);
    if (block == NULL || s->statistics == NULL) return dal__memory_error(error);
    s->z = block + d * d;
    s->growth = s->z + size;
    s->scratch = s->growth + d + EXTRA_MEANS;
    s->gradients = s->scratch + scratch;
    s->place = s->gradients + gradients;
    s->memory = s->place + d;
    s->displaced = s->memory + memory;
    s->unit = s->displaced + memory;
    fill_units(s);
    return DAL_STATUS_OK;
}

/* How many directions a step leaves: after them R_ii is 0, or noise.  The vectors stay as that
 * step left them. */
static dal_status find_rank(dal_lyapunov *s, unsigned properties)
{
    dal__random random = {1};
    dal_error ignored, *error = s->error;
    hold_state(s, s->run);
    if (properties & DAL_PRESERVES_ENERGY) { /* it knows from its first step on which */
        DAL_TRY(dal_run_restore(s->auxiliary, s->memory, s->memory_count, s->error));
        DAL_TRY(dal_run_step(s->auxiliary, s->error));
        hold_state(s, s->auxiliary);
    }
    for (int i = 0; i < s->dimension * s->dimension; i++) s->vectors[i] = dal__uniform(&random);
    DAL_TRY(orthonormalise(s, s->dimension));
    DAL_TRY(move_vectors(s, s->dimension));
    s->error = &ignored;
    orthonormalise(s, s->dimension);
    s->error = error;
    while (s->rank < s->dimension && s->growth[s->rank] > lost_direction) s->rank++;
    return DAL_STATUS_OK;
}

static dal_status start_vectors(dal_lyapunov *s, const dal_run_spec *spec,
                                const dal_system *tangent, int count, dal_error *error)
{
    const unsigned properties = dal_method_properties(&spec->method);
    DAL_TRY(open_runs(s, spec, tangent, error));
    DAL_TRY(allocate_vectors(s, error));
    s->error = error;
    DAL_TRY(find_rank(s, properties));
    s->enforced = find_enforced(s, properties);
    s->turns_D =
        spec->system->m > 0 && s->rank == s->dimension && properties & DAL_PRESERVES_D_MIDPOINT;
    DAL_TRY(find_divergence(s));
    if (count > s->rank)
        return dal__fail(error, DAL_STATUS_ARGUMENT,
                         "%d exponents are requested; the step map has %d directions", count,
                         s->rank);
    s->count = count > 0 ? count : s->rank;
    dal_lyapunov_discard_transient(s);
    if (s->from_status == DAL_STATUS_MEMORY) return dal__memory_error(error);
    for (int j = 0; j < s->rank && isfinite(s->log_from); j++) /* tangent to what is enforced */
        for (int k = 0; k < s->enforced; k++)
            dal__remove_component(s->vectors + j * s->dimension, s->gradients + k * s->dimension,
                                  s->dimension);
    s->is_symplectic = s->space == DAL_LIFTED && properties & DAL_SYMPLECTIC;
    const dal_status status = orthonormalise(s, s->rank);
    s->error = NULL;
    return status;
}

static dal_status create_lyapunov(dal_lyapunov **lyapunov, const dal_run_spec *spec,
                                  dal_space space, const dal_system *tangent, int count,
                                  dal_error *error)
{
    DAL_REQUIRE(lyapunov, error);
    *lyapunov = NULL;
    DAL_REQUIRE_COUNT(count, error);
    DAL_TRY(dal__check_spec(spec, error));
    DAL_TRY(check_map(spec, space, tangent, error));
    dal_lyapunov *s = calloc(1, sizeof *s);
    if (s == NULL) return dal__memory_error(error);
    s->space = space;
    const dal_status status = start_vectors(s, spec, tangent, count, error);
    if (status == DAL_STATUS_OK)
        *lyapunov = s;
    else
        dal_lyapunov_free(s);
    return status;
}

dal_status dal_lyapunov_create(dal_lyapunov **lyapunov, const dal_run_spec *spec,
                               const dal_system *tangent, int count, dal_error *error)
{
    return create_lyapunov(lyapunov, spec, DAL_PHYSICAL, tangent, count, error);
}

dal_status dal_lyapunov_create_lifted(dal_lyapunov **lyapunov, const dal_run_spec *spec,
                                      const dal_system *tangent, int count, dal_error *error)
{
    return create_lyapunov(lyapunov, spec, DAL_LIFTED, tangent, count, error);
}

void dal_lyapunov_free(dal_lyapunov *s)
{
    if (s == NULL) return;
    dal_run_free(s->run);
    dal_run_free(s->auxiliary);
    dal_evaluator_free(s->evaluator);
    dal_scaled_free(s->scaled);
    free(s->vectors);
    free(s->statistics);
    free(s);
}

/* ---- results ---- */

const dal_run *dal_lyapunov_run(const dal_lyapunov *s) { return s ? s->run : NULL; }
int dal_lyapunov_count(const dal_lyapunov *s) { return s ? s->count : 0; }
bool dal_lyapunov_is_exact(const dal_lyapunov *s) { return s && s->is_exact; }
bool dal_lyapunov_is_whole(const dal_lyapunov *s) { return s && s->count == s->rank; }

double dal_lyapunov_time_unit(const dal_lyapunov *s) { return s ? s->time : NAN; }

/* The mean of number i of growth; NaN where there is no such number. */
static void mean_of(const dal_lyapunov *s, int i, dal_average *average)
{
    dal_statistics_mean(s && i >= 0 ? &s->statistics[i] : NULL, average);
}

void dal_lyapunov_exponent(const dal_lyapunov *s, int i, dal_average *average)
{
    mean_of(s, s && i < s->count ? i : -1, average);
}

void dal_lyapunov_sum(const dal_lyapunov *s, dal_average *average)
{
    mean_of(s, s ? s->count : -1, average);
}

void dal_lyapunov_divergence(const dal_lyapunov *s, dal_average *average)
{
    mean_of(s, s ? s->count + 1 : -1, average);
}
