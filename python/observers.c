/* observers.c - observers of runs in C, so that neither rows nor steps call Python; only events and
 * the polls do, which let it handle signals.  Also many points in one call, and bodies. */
#include "cli/report/report_body.c"
#include <dalembert_analysis.h>
#include <dalembert_codegen.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What python_sample observes. */
typedef struct python_request {
    void *user;                 /* of python_event and python_progress */
    const double *times;        /* [count], of the rows; NULL: rows 0..count at equal distances */
    double *rows;               /* of t, state, observables; NULL: none */
    dal_statistics *statistics; /* [observables]; NULL: none */
    long long every;            /* steps between two of their values */
    long long made;             /* receives the number of rows */
} python_request;

static dal_status python_event(void *user, dal_run *run, const dal_occurrence *event);
static dal_status python_progress(void *user, double done);

/* Row 0 of dal_run_sample is left out where times are given: the first of them may be the last. */
static double row_time(void *user, long long row)
{
    return ((python_request *)user)->times[row - 1];
}

static dal_status add_row(void *user, dal_run *run, long long row, double t)
{
    python_request *request = user;
    const size_t dimension = (size_t)dal_run_dimension(run);
    const size_t columns = 1 + dimension + (size_t)dal_run_observables(run);
    const long long place = request->times ? row - 1 : row;
    double *out = request->rows + (size_t)place * columns;
    out[0] = t;
    memcpy(out + 1, dal_run_state(run), dimension * sizeof *out);
    const dal_status status = dal_run_observe(run, out + 1 + dimension);
    if (status == DAL_STATUS_OK) request->made = place + 1;
    return status;
}

static dal_status add_values(void *user, dal_run *run, int count, const double *t,
                             const double *values, size_t stride)
{
    const python_request *request = user;
    dal_statistics_add_many(request->statistics, dal_run_observables(run), count, t, values,
                            stride);
    return DAL_STATUS_OK;
}

static dal_status add_scales(void *user, dal_run *run, const double *scales)
{
    const python_request *request = user;
    dal_statistics_add_scales(request->statistics, dal_run_observables(run), scales);
    return DAL_STATUS_OK;
}

static dal_status pass_event(void *user, dal_run *run, const dal_occurrence *event)
{
    return python_event(((python_request *)user)->user, run, event);
}

static dal_status pass_time(void *user, dal_run *run)
{
    return python_progress(((python_request *)user)->user, dal_run_time(run));
}

/* Advances a run to time T, and observes what the request has: count rows, statistics of the values
 * at the start and of one step in `every`, and events where it has a user. */
static dal_status python_sample(dal_run *run, double T, long long count, python_request *request,
                                dal_error *error)
{
    const bool from_start = (request->rows && !request->times) || request->statistics;
    const dal_observer observer = {.user = request,
                                   .sample = request->rows ? add_row : NULL,
                                   .row_time = request->times ? row_time : NULL,
                                   .values = request->statistics ? add_values : NULL,
                                   .scales = request->statistics ? add_scales : NULL,
                                   .every = request->statistics ? request->every : 0,
                                   .event = request->user ? pass_event : NULL,
                                   .poll = pass_time};
    if (request->statistics) dal_statistics_start(request->statistics, dal_run_observables(run));
    return dal_run_sample(run, T, count, from_start ? 0 : 1, &observer, error);
}

/* Evaluates a callback at count points t, q[n], v[width] of arrays; out[size] each, NaN where it
 * has no values. */
static void python_evaluate(dal_evaluator *evaluator, dal_callback *callback, long long count,
                            const double *t, const double *q, const double *v, int width, int size,
                            double *out)
{
    const int n = dal_evaluator_system(evaluator)->n;
    for (long long k = 0; k < count; k++, q += n, v += width, out += size)
        if (dal_evaluator_call(evaluator, callback, t[k], q, v, NULL, out) != DAL_STATUS_OK)
            for (int i = 0; i < size; i++) out[i] = NAN;
}

/* The numbers of the picture of a system, DAL_PICTURE_COUNT of them; NULL: it has none. */
static dal_callback *python_picture(const dal_system *system)
{
    return system->picture ? system->picture->evaluate : NULL;
}

/* The shape of a system's body after another one, the first one for NULL; NULL after the last. */
static const body_shape *python_shape(const dal_system *system, const body_shape *shape)
{
    return body_next(system->picture ? system->picture->body : DAL_BODY_POINT, shape);
}
