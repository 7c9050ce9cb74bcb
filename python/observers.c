/* observers.c - observers of runs in C, so that neither rows nor steps call Python; only events and
 * the polls do, which let it handle signals. */
#include <dalembert_analysis.h>
#include <dalembert_codegen.h>
#include <stdlib.h>
#include <string.h>

static dal_status python_poll(void *user, dal_run *run);
static dal_status python_event(void *user, dal_run *run, const dal_occurrence *event);

/* ---- rows at times that are given ---------------------------------------------------------- */

typedef struct row_table {
    const double *times;
    double *rows; /* of t, state, observables */
    size_t dimension, columns;
    long long made;
} row_table;

/* Row 0 of dal_run_sample is left out: the first of ours may be its last. */
static double row_time(void *user, long long row) { return ((row_table *)user)->times[row - 1]; }

static dal_status add_row(void *user, dal_run *run, long long row, double t)
{
    row_table *table = user;
    double *out = table->rows + (size_t)(row - 1) * table->columns;
    out[0] = t;
    memcpy(out + 1, dal_run_state(run), table->dimension * sizeof *out);
    const dal_status status = dal_run_observe(run, out + 1 + table->dimension);
    if (status == DAL_STATUS_OK) table->made = row;
    return status;
}

/* Writes rows[count][1 + dimension + observables] at times[count], *made of them where it fails. */
static dal_status python_rows(dal_run *run, long long count, const double *times, double *rows,
                              long long *made, dal_error *error)
{
    row_table table = {.times = times, .rows = rows, .dimension = (size_t)dal_run_dimension(run)};
    table.columns = 1 + table.dimension + (size_t)dal_run_observables(run);
    const dal_observer observer = {
        .user = &table, .sample = add_row, .row_time = row_time, .poll = python_poll};
    const dal_status status = dal_run_sample(run, times[count - 1], count, 1, &observer, error);
    *made = table.made;
    return status;
}

/* ---- events -------------------------------------------------------------------------------- */

/* Advances a run to time T and calls python_event with `user` after each event. */
static dal_status python_events(dal_run *run, double T, void *user, dal_error *error)
{
    const dal_observer observer = {.user = user, .event = python_event, .poll = python_poll};
    return dal_run_sample(run, T, 1, 1, &observer, error);
}

/* ---- statistics of all observables --------------------------------------------------------- */

typedef struct followed {
    dal_statistics *statistics;
    int observables;
} followed;

static dal_status add_values(void *user, dal_run *run, int count, const double *t,
                             const double *values, size_t stride)
{
    const followed *f = user;
    (void)run;
    dal_statistics_add_many(f->statistics, f->observables, count, t, values, stride);
    return DAL_STATUS_OK;
}

static dal_status add_scales(void *user, dal_run *run, const double *scales)
{
    const followed *f = user;
    (void)run;
    dal_statistics_add_scales(f->statistics, f->observables, scales);
    return DAL_STATUS_OK;
}

/* Advances a run to time T and fills statistics[observables] with the values at the start, and then
 * with the values of one step in `every`. */
static dal_status python_follow(dal_run *run, double T, long long every, dal_statistics *statistics,
                                dal_error *error)
{
    followed f = {statistics, dal_run_observables(run)};
    const dal_observer observer = {.user = &f,
                                   .values = add_values,
                                   .scales = add_scales,
                                   .every = every,
                                   .poll = python_poll};
    dal_statistics_start(statistics, f.observables);
    return dal_run_sample(run, T, 1, 0, &observer, error);
}
