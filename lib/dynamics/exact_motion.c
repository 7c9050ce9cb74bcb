/* exact_motion.c - the exact motion by polynomials, for predictions that share it.
 *
 * taylor under a tolerance has substeps as long as it likes, and in each the polynomial
 *
 *     x(t + u s) = x + u s (a_1 + u (a_2 + ...)),     0 <= u <= 1,
 *
 * which is kept.  They depend on the start and the parameters alone, so that methods, steps,
 * threads and processes have the same bits.
 *
 * Rounding moves D of the motion, and an error of D changes E and invariants: after some units of
 * time the velocities go back to D = 0, and taylor begins again; so it does where a constraint has
 * turned too far since it began. */
#include "dynamics/exact_motion.h"
#include "analysis/reference.h"
#include "analysis/scaled.h"
#include "core/error.h"
#include "core/settings.h"
#include "core/vectors.h"
#include "run/run.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NAME = 128, LIMIT = 1 << 25 };
/* Of substeps: below rounding. */
static const double series_tolerance = 1e-18;
/* In units of time: what is between two projections to D = 0.  A step of the run that fails before
 * this part of it is not begun again: before a singularity there is no end of ever shorter ones. */
static const double stretch = 16.0, shortest = 1e-3;

typedef struct substep {
    double from, size; /* since the start, without sign */
    int terms;
    double *numbers; /* x, what it has rounded off, a_1, a_2, ...: [(2 + terms)*2n] */
} substep;

struct dal_exact_motion {
    dal_run *run;             /* NULL: F has no Taylor series */
    dal_evaluator *evaluator; /* NULL: there is no D */
    int size;                 /* of (q, v) */
    double start, sign;       /* time, and direction */
    double stretch;        /* where the run begins again, since then; its step is twice as long */
    double *first, *state; /* [size] at the start; where the polynomials end */
    double *parameters;
    substep *substep;
    size_t count, capacity;
    size_t numbers, limit; /* that are kept, and may be; limit 0: the present ones alone */
    double begin, done;    /* where the run's step begins, since the start; what of it is known */
    double end;            /* of the polynomials, since the start */
    bool has_begun;
    dal_status failed; /* DAL_STATUS_OK: it has not, */
    dal_error failure; /* or this says why */
};

bool dal__exact_motion_has_series(const dal_exact_motion *m) { return m->run != NULL; }

/* Where the run begins again another motion continues this one with the same bits. */
static bool is_full(const dal_exact_motion *m)
{
    return m->limit > 0 && m->numbers >= m->limit && m->done > m->stretch;
}

bool dal__exact_motion_ends_before(const dal_exact_motion *m, double time)
{
    return is_full(m) && m->end < time;
}

void dal_exact_motion_free(dal_exact_motion *m)
{
    if (!m) return;
    for (size_t i = 0; i < m->count; i++) free(m->substep[i].numbers);
    free(m->substep);
    free(m->first);
    dal_run_free(m->run);
    dal_evaluator_free(m->evaluator);
    free(m);
}

/* ---- making one ---- */

dal_status dal__create_physical(const dal_run_spec *spec, dal_run_spec *own, dal_run **run,
                                bool *on_D, dal_error *error)
{
    dal_run *lifted;
    *run = NULL;
    *own = *spec;
    own->options.space = DAL_PHYSICAL;
    own->start = NULL;
    own->start_count = 0;
    own->options.consistent = true;
    DAL_TRY(dal_run_create(&lifted, spec, error));
    *on_D = dal__is_on_motion(lifted);
    dal_status status = dal_run_create(run, own, error);
    if (status == DAL_STATUS_OK)
        status = dal_run_set_state(*run, dal_run_time(lifted), dal_run_state(lifted), error);
    dal_run_free(lifted);
    return status;
}

/* A run of taylor from the (q, v) of a run. */
static dal_status create_series(dal_exact_motion *m, dal_run_spec own, const dal_run *run,
                                dal_error *error)
{
    const size_t size = (size_t)m->size;
    dal_setting *start = calloc(size, sizeof *start + NAME);
    char *names = (char *)(start + size);
    if (!start) return dal__memory_error(error);
    for (size_t i = 0; i < size; i++)
        start[i] =
            (dal_setting){dal_run_component_name(run, (int)i, names + i * NAME, NAME), m->first[i]};
    own.start = start;
    own.start_count = m->size;
    own.start_time = m->start;
    own.options.tolerance = series_tolerance;
    own.options.step = 2.0 * m->sign * m->stretch;
    dal_status status = dal_run_create(&m->run, &own, error);
    if (status == DAL_STATUS_OK && own.system->m > 0)
        status = dal__evaluator_of_run(&m->evaluator, NULL, run, error);
    free(start);
    return status;
}

static dal_status fill_motion(dal_exact_motion *m, const dal_run_spec *spec, const dal_run *run,
                              dal_error *error)
{
    const dal_system *system = dal_run_system(run);
    const size_t size = (size_t)m->size, parameters = (size_t)system->parameters;
    dal_scaled *scaled;
    m->first = dal__numbers(1, 2 * size + parameters + 1);
    if (!m->first) return dal__memory_error(error);
    m->state = m->first + size;
    m->parameters = m->state + size;
    memcpy(m->first, dal_run_state(run), size * sizeof *m->first);
    memcpy(m->state, m->first, size * sizeof *m->first);
    memcpy(m->parameters, dal_run_parameters(run), parameters * sizeof *m->first);
    DAL_TRY(dal_scaled_create_at(&scaled, run, error));
    m->stretch = stretch * dal_scaled_units(scaled)[0];
    dal_scaled_free(scaled);
    dal_run_spec own = {.system = system,
                        .parameters = spec->parameters,
                        .parameter_count = spec->parameter_count,
                        .method = dal__library_method("taylor"),
                        .options = dal_options_default()};
    own.options.space = DAL_PHYSICAL;
    const bool has_series = system->series && !system->series->refused;
    return has_series ? create_series(m, own, run, error) : DAL_STATUS_OK;
}

dal_status dal__exact_motion_of_run(dal_exact_motion **motion, const dal_run_spec *spec,
                                    const dal_run *run, size_t limit, dal_error *error)
{
    *motion = NULL;
    dal_exact_motion *m = calloc(1, sizeof *m);
    if (!m) return dal__memory_error(error);
    m->size = 2 * dal_run_system(run)->n;
    m->limit = limit;
    m->start = dal_run_time(run);
    m->sign = copysign(1.0, dal_run_step_size(run));
    const dal_status status = fill_motion(m, spec, run, error);
    if (status == DAL_STATUS_OK)
        *motion = m;
    else
        dal_exact_motion_free(m);
    return status;
}

dal_status dal_exact_motion_create(dal_exact_motion **motion, const dal_run_spec *spec,
                                   size_t bytes, dal_error *error)
{
    dal_run *run;
    dal_run_spec own;
    bool on_D;
    DAL_REQUIRE(motion, error);
    *motion = NULL;
    DAL_TRY(dal__check_spec(spec, error));
    DAL_TRY(dal__create_physical(spec, &own, &run, &on_D, error));
    const size_t limit = bytes > 0 ? bytes / sizeof(double) + 1 : LIMIT;
    const dal_status status = on_D ? dal__exact_motion_of_run(motion, spec, run, limit, error)
                                   : dal__fail(error, DAL_STATUS_UNSUPPORTED,
                                               "p and pi are not 0, and move the motion off D = 0");
    dal_run_free(run);
    return status;
}

bool dal__exact_motion_begins(const dal_exact_motion *m, const dal_run *run)
{
    const dal_system *system = dal_run_system(run);
    const size_t parameters = (size_t)system->parameters * sizeof(double);
    return m->size == 2 * system->n && m->start == dal_run_time(run) &&
           m->sign * dal_run_step_size(run) > 0.0 &&
           memcmp(m->first, dal_run_state(run), (size_t)m->size * sizeof(double)) == 0 &&
           memcmp(m->parameters, dal_run_parameters(run), parameters) == 0;
}

dal_status dal__exact_motion_continue(const dal_exact_motion *from, dal_exact_motion **motion,
                                      dal_error *error)
{
    const dal_run *run = from->run;
    const dal_system *system = dal_run_system(run);
    dal_setting *parameter = calloc((size_t)system->parameters + 1, sizeof *parameter);
    dal_run *at = NULL;
    *motion = NULL;
    if (!parameter) return dal__memory_error(error);
    for (int i = 0; i < system->parameters; i++)
        parameter[i] = (dal_setting){system->parameter[i], from->parameters[i]};
    dal_run_spec spec = {.system = system,
                         .parameters = parameter,
                         .parameter_count = system->parameters,
                         .start_time = from->start,
                         .method = dal__library_method("taylor"),
                         .options = dal_options_default()};
    spec.options.space = DAL_PHYSICAL;
    spec.options.consistent = true;
    spec.options.step = from->sign;
    dal_status status = dal_run_create(&at, &spec, error);
    if (status == DAL_STATUS_OK) status = dal_run_set_state(at, from->start, from->first, error);
    if (status == DAL_STATUS_OK) status = dal__exact_motion_of_run(motion, &spec, at, 0, error);
    if (status == DAL_STATUS_OK) {
        memcpy((*motion)->state, from->state, (size_t)from->size * sizeof(double));
        (*motion)->end = from->end;
    }
    dal_run_free(at);
    free(parameter);
    return status;
}

/* ---- polynomials ---- */

/* x at u of a substep. */
static void evaluate_substep(const substep *s, int size, double u, double *out)
{
    const double *x = s->numbers, *rounded = x + size, *a = rounded + size;
    for (int i = 0; i < size; i++) out[i] = 0.0;
    for (int k = s->terms - 1; k >= 0; k--)
        for (int i = 0; i < size; i++) out[i] = fma(u, out[i], a[k * size + i]);
    for (int i = 0; i < size; i++) out[i] = x[i] + fma(u * s->size, out[i], rounded[i]);
}

/* Begins a step of the run where the polynomials end, with velocities on D = 0. */
static dal_status begin_step(dal_exact_motion *m, dal_error *error)
{
    const double t = m->start + m->sign * m->end;
    if (m->evaluator && m->end > 0.0 &&
        dal_evaluator_project_velocity(m->evaluator, t, m->state, m->state + m->size / 2) ==
            DAL_STATUS_MEMORY)
        return dal__memory_error(error); /* else v stays as it is */
    m->begin = m->end;
    m->done = 0.0;
    m->has_begun = true;
    return dal_run_set_state(m->run, t, m->state, error);
}

static dal_status no_observation(void *user, dal_run *run)
{
    (void)user;
    (void)run;
    return DAL_STATUS_OK;
}

/* Finds the substep of the run that follows the polynomials. */
static dal_status find_substep(dal_exact_motion *m, dal__polynomial *p, dal_error *error)
{
    const double step = 2.0 * m->stretch;
    const double past = fmax(m->done * (1.0 + 8.0 * DBL_EPSILON), step * DBL_EPSILON);
    DAL_TRY(dal_run_intermediate(m->run, m->sign * past, no_observation, NULL, error));
    if (m->run->kind->engine->polynomial(m->run->engine, p) && p->from + p->size > m->done)
        return DAL_STATUS_OK;
    DAL_TRY(dal_run_step(m->run, error)); /* which says why there is none */
    return dal__fail(error, DAL_STATUS_NOT_CONVERGED, "t = %g: the exact motion ends",
                     m->start + m->sign * m->end);
}

static dal_status append_substep(dal_exact_motion *m, const dal__polynomial *p, dal_error *error)
{
    const int dim = dal_run_dimension(m->run);
    const size_t size = (size_t)m->size, numbers = (2 + (size_t)p->terms) * size;
    if (m->count == m->capacity) {
        const size_t capacity = 2 * m->capacity + 64;
        substep *more = realloc(m->substep, capacity * sizeof *more);
        if (!more) return dal__memory_error(error);
        m->substep = more;
        m->capacity = capacity;
    }
    double *to = dal__numbers(1, numbers);
    if (!to) return dal__memory_error(error);
    m->substep[m->count] = (substep){m->end, p->size, p->terms, to};
    memcpy(to, p->y, size * sizeof *to);
    memcpy(to + size, p->r, size * sizeof *to);
    for (int k = 0; k < p->terms; k++)
        memcpy(to + (2 + (size_t)k) * size, p->rate + k * dim, size * sizeof *to);
    m->numbers += numbers;
    evaluate_substep(&m->substep[m->count], m->size, 1.0, m->state);
    m->done = p->from + p->size;
    m->end = m->begin + m->done;
    m->count++;
    return DAL_STATUS_OK;
}

static dal_status add_substep(dal_exact_motion *m, dal_error *error)
{
    dal__polynomial p;
    if (!m->has_begun || m->done > m->stretch) DAL_TRY(begin_step(m, error));
    dal_status status = find_substep(m, &p, error);
    if (status != DAL_STATUS_OK && m->done > shortest * m->stretch) {
        DAL_TRY(begin_step(m, error));
        status = find_substep(m, &p, error);
    }
    return status == DAL_STATUS_OK ? append_substep(m, &p, error) : status;
}

/* Adds substeps up to a time, or until it is full; a failure is the same whenever it is met. */
static dal_status extend(dal_exact_motion *m, double time, dal_error *error)
{
    while (m->failed == DAL_STATUS_OK && !(m->end > time) && !is_full(m))
        m->failed = add_substep(m, &m->failure);
    if (m->count > 0 && (m->end >= time || is_full(m))) return DAL_STATUS_OK;
    return dal__fail(error, m->failed, "%s", m->failure.message);
}

/* Drops what ends before a time. */
static void drop_before(dal_exact_motion *m, double time)
{
    size_t old = 0;
    while (old < m->count && m->substep[old].from + m->substep[old].size < time)
        free(m->substep[old++].numbers);
    if (old == 0) return;
    m->count -= old;
    memmove(m->substep, m->substep + old, m->count * sizeof *m->substep);
}

dal_status dal__exact_motion_reach(dal_exact_motion *m, double from, double time, dal_error *error)
{
    if (m->count > 0 && m->end >= time) return DAL_STATUS_OK;
    if (m->limit == 0) drop_before(m, from);
    return extend(m, time, error);
}

void dal__exact_motion_state(const dal_exact_motion *m, double time, double *out)
{
    size_t first = 0, last = m->count - 1; /* the last substep that begins at `time` or before */
    while (first < last) {
        const size_t middle = first + (last - first + 1) / 2;
        if (m->substep[middle].from <= time)
            first = middle;
        else
            last = middle - 1;
    }
    const substep *s = &m->substep[first];
    evaluate_substep(s, m->size, (time - s->from) / s->size, out);
}

dal_status dal_exact_motion_extend(dal_exact_motion *m, double T,
                                   const dal_predict_observer *observer, dal_error *error)
{
    DAL_REQUIRE(m, error);
    if (!isfinite(T)) return dal__fail(error, DAL_STATUS_ARGUMENT, "T = %g is not finite", T);
    /* Steps may end a little later than T. */
    const double time = fmax(m->sign * (T - m->start), 0.0), all = time * (1.0 + 1e-6);
    const double by = all / 256.0;
    for (int i = 1; i <= 256 && m->run && !dal__exact_motion_ends_before(m, all); i++) {
        const dal_status status = extend(m, i * by, error);
        if (status == DAL_STATUS_MEMORY) return status;
        if (m->failed != DAL_STATUS_OK)
            return DAL_STATUS_OK; /* predictions end there, and say why */
        if (observer && observer->step &&
            observer->step(observer->user, i / 256.0) != DAL_STATUS_OK)
            return dal__fail(error, DAL_STATUS_INTERRUPTED, "interrupted");
    }
    return DAL_STATUS_OK;
}
