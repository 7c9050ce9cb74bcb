/* order_run.c - the runs of `dalembert order`: a reference, then methods x steps on threads. */
#include "order.h"
#include "run/pool.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A run so short is taken again, and the least of some times counts; steps between two looks at
 * the flag of interruption. */
static const double short_time = 0.01;
enum { REPEATS = 3, CHUNK = 1000 };
static const double rounding = 1e-16; /* the least error that is claimed of a reference */

const char *order_state_word(order_state state)
{
    static const char *const words[] = {
#define X(code, word) word,
        ORDER_STATE_LIST(X)
#undef X
    };
    return words[state];
}

/* ---- one run ------------------------------------------------------------------------------- */

static dal_run_spec spec_of(const order_study *s, const dal_method *method, double step)
{
    const cli_job *job = &s->job;
    dal_run_spec spec = {.system = job->made,
                         .method = *method,
                         .options = job->options,
                         .parameters = job->set.item,
                         .parameter_count = job->set.count,
                         .start = job->start.item,
                         .start_count = job->start.count};
    spec.options.step = step;
    return spec;
}

static dal_status advance(dal_run *run, long long steps, dal_error *error)
{
    dal_status status = DAL_OK;
    while (steps > 0 && status == DAL_OK) {
        const long long count = steps < CHUNK ? steps : CHUNK;
        if (cli_interrupted()) return DAL_INTERRUPTED;
        status = dal_run_advance(run, count, error);
        steps -= count;
    }
    return status;
}

typedef struct outcome {
    long long evaluations;
    double seconds;
} outcome;

/* The numbers that are compared, at T. */
static dal_status end_of(const order_study *s, const dal_run_spec *spec, double *out, outcome *o,
                         dal_error *error)
{
    dal_run *run;
    const dal_status made = dal_run_create(&run, spec, error);
    if (made != DAL_OK) return made;
    const double before = cli_thread_seconds();
    const long long steps = llround(s->job.time / spec->options.step);
    const dal_status status = advance(run, steps, error);
    *o = (outcome){dal_run_evaluations(run), cli_thread_seconds() - before};
    memcpy(out, dal_run_state(run), (size_t)s->numbers * sizeof *out);
    dal_run_free(run);
    return status;
}

/* ---- the reference ------------------------------------------------------------------------- */

/* The exact solution, when it begins at this start. */
static int exact_reference(order_study *s)
{
    const dal_system *system = s->job.made;
    const cli_job *job = &s->job;
    dal_probe *probe = NULL;
    double *start = s->reference + s->numbers, off = 0.0;
    dal_status made = DAL_UNSUPPORTED;
    if (system->exact && !system->multipliers)
        made = dal_probe_create(&probe, system, job->set.item, job->set.count, NULL);
    int found =
        cli_is_ok(made) &&
        dal_probe_start(probe, job->start.item, job->start.count, start, NULL) == DAL_OK &&
        dal_probe_call(probe, system->exact, 0.0, start, start, NULL, s->reference) == DAL_OK;
    if (found) off = analysis_distance(start, s->reference, s->numbers);
    found =
        found && off <= 1e-10 &&
        dal_probe_call(probe, system->exact, job->time, start, start, NULL, s->reference) == DAL_OK;
    dal_probe_free(probe);
    s->judge = "the exact solution";
    return found && isfinite(analysis_distance(s->reference, s->reference, s->numbers));
}

/* Two runs of a fine method: the finer is the reference, their distance the error of the other. */
static dal_status judged_by(order_study *s, const char *name, dal_error *error)
{
    const double h = s->step[s->levels - 1];
    double *coarse = s->reference + s->numbers;
    dal_method method;
    outcome o;
    dal_status status = dal_method_parse(&method, name, error);
    dal_run_spec spec = spec_of(s, &method, h);
    spec.options.space = DAL_PHYSICAL;
    if (status == DAL_OK) status = end_of(s, &spec, coarse, &o, error);
    spec.options.step = 0.5 * h;
    if (status == DAL_OK) status = end_of(s, &spec, s->reference, &o, error);
    if (status != DAL_OK) return status;
    s->noise = fmax(analysis_distance(coarse, s->reference, s->numbers), rounding);
    snprintf(s->judge_text, sizeof s->judge_text, "%s with h = %g, itself within %.0e", name,
             0.5 * h, s->noise);
    s->judge = s->judge_text;
    return DAL_OK;
}

int order_reference(order_study *s)
{
    dal_error error = {0};
    s->numbers = 2 * s->job.made->n + s->job.made->multipliers;
    s->reference = cli_calloc(2 * (size_t)s->numbers + 1, sizeof(double));
    if (exact_reference(s)) return CLI_DONE;
    dal_status status = judged_by(s, "gauss12", &error);
    if (status == DAL_NOT_CONVERGED) status = judged_by(s, "dop853", &error);
    if (status == DAL_OK) return CLI_DONE;
    if (status == DAL_INTERRUPTED) return CLI_SIGNAL;
    return cli_error(cli_exit(status), "reference", &error);
}

/* ---- methods x steps ----------------------------------------------------------------------- */

static void run_cell(void *user, int i)
{
    order_study *s = user;
    order_method *m = &s->methods[i / s->levels];
    const int level = s->levels - 1 - i % s->levels; /* the longest first */
    const dal_run_spec spec = spec_of(s, &m->method, s->step[level]);
    double *out = cli_calloc((size_t)s->numbers + 1, sizeof *out);
    dal_error *why = &m->why[level];
    outcome o = {0};
    m->seconds[level] = INFINITY;
    why->status = DAL_OK;
    for (int k = 0; k < REPEATS && why->status == DAL_OK; k++) {
        why->status = end_of(s, &spec, out, &o, why);
        m->seconds[level] = fmin(m->seconds[level], o.seconds);
        if (o.seconds > short_time) break;
    }
    m->order.step[level] = s->step[level];
    m->order.evaluations[level] = o.evaluations;
    m->order.error[level] =
        cli_is_ok(why->status) ? analysis_distance(out, s->reference, s->numbers) : NAN;
    free(out);
}

static void conclude(order_study *s, order_method *m)
{
    m->order.levels = s->levels;
    dal_order_slopes(&m->order, s->noise);
    for (int i = 0; i < s->levels; i++) {
        if (m->why[i].status == DAL_OK) continue;
        if (!m->why[i].message[0])
            snprintf(m->why[i].message, sizeof m->why[i].message, "%s",
                     dal_status_text(m->why[i].status));
        m->state = m->why[i].status == DAL_UNSUPPORTED ? ORDER_REFUSED : ORDER_FAILED;
    }
}

int order_run(order_study *s)
{
    pool_run(s->method_count * s->levels, s->threads, run_cell, s);
    if (cli_interrupted()) return CLI_SIGNAL;
    for (int i = 0; i < s->method_count; i++) conclude(s, &s->methods[i]);
    return CLI_DONE;
}
