/* sample.c - rows at t = row*T/samples from a trajectory of steps h.
 *
 * A row time counts as reached when it is nearer than ALIGNED steps, or than the rounding of the
 * clock, to the time of a step; otherwise a side step gives the row and is then forgotten. */
#include "run/run.h"
#include <float.h>
#include <math.h>
#include <string.h>

#define ALIGNED    1e-9
#define MOST_STEPS 0x1p53

enum { POLL = 992 /* whole blocks of looks, lib/jit/native.c */ };

typedef struct sampling {
    dal_run *run;
    const dal_observer *observer;
    dal_error *error;
    long long since_poll;
} sampling;

static dal_status stopped(dal_status status, const sampling *k)
{
    return dal__stopped(k->run, status, k->error);
}

/* A power of two, so that polls fall together with whole groups of observations. */
static long long polling(const sampling *k)
{
    const long long wanted = k->observer->polling;
    long long most = POLL;
    while (wanted > 0 && most > wanted) most /= 2;
    return most;
}

static dal_status poll(sampling *k)
{
    if (++k->since_poll < polling(k) || !k->observer->poll) return DAL_OK;
    k->since_poll = 0;
    return stopped(k->observer->poll(k->observer->user, k->run), k);
}

static dal_status sample_row(sampling *k, long long row, double t)
{
    if (!k->observer->sample) return DAL_OK;
    return stopped(k->observer->sample(k->observer->user, k->run, row, t), k);
}

/* Up to count steps, shown where that is asked for. */
static dal_status advance(sampling *k, long long count)
{
    const dal_observer *o = k->observer;
    if (o->values && o->every > 0) return dal__observe_steps(k->run, o, count, k->error);
    if (!o->step || o->every < 1) return dal_run_advance(k->run, count, k->error);
    while (count > 0) {
        const long long due = o->every - dal_run_steps(k->run) % o->every;
        const long long steps = due < count ? due : count;
        DAL_TRY(dal_run_advance(k->run, steps, k->error));
        if (steps == due) DAL_TRY(stopped(o->step(o->user, k->run), k));
        count -= steps;
    }
    return DAL_OK;
}

dal_status dal_run_intermediate(dal_run *run, double h,
                                dal_status (*observe)(void *user, dal_run *run), void *user,
                                dal_error *error)
{
    DAL_REQUIRE(run, error);
    DAL_REQUIRE(observe, error);
    if (!isfinite(h))
        return dal__fail(error, DAL_ARGUMENT, "an intermediate step must be finite; it is %g", h);
    dal__run_back_up(run);
    dal_status status = dal__run_steps(run, h, 1);
    if (status != DAL_OK) return dal__failure_reason(run, h, status, error);
    status = observe(user, run);
    dal__run_revert(run);
    return status;
}

typedef struct intermediate_row {
    sampling *k;
    long long row;
    double t;
} intermediate_row;

static dal_status sample_intermediate(void *user, dal_run *run)
{
    const intermediate_row *r = user;
    (void)run;
    return sample_row(r->k, r->row, r->t);
}

/* A row between two steps: a step of size h from the present state, shown and taken back. */
static dal_status intermediate_step(sampling *k, double h, long long row, double t)
{
    intermediate_row r = {k, row, t};
    const dal_status shown = dal_run_intermediate(k->run, h, sample_intermediate, &r, k->error);
    return shown == DAL_OK ? poll(k) : shown;
}

/* Whether the run stands where a group of looks has just been handed over. */
static bool ends_group(const sampling *k) { return (dal_run_steps(k->run) + 1) % polling(k) == 0; }

/* Steps that surely end before a row that is left away, the last two are taken one by one; and not
 * beyond a step at which looks are handed over anyway. */
static long long steps_to(const sampling *k, double left, double h)
{
    const double steps = left / h - 2.0;
    const long long group = polling(k), most = group - (dal_run_steps(k->run) + 1) % group;
    return steps < 1.0 ? 1 : steps > (double)most ? most : (long long)steps;
}

static dal_status advance_to_row(sampling *k, long long row, double t)
{
    const double h = k->run->layout.options.step;
    const double near = fmax(ALIGNED * h, 4.0 * DBL_EPSILON * fabs(t));
    for (;;) {
        const double left = t - dal_run_time(k->run);
        if (left <= near) return sample_row(k, row, t);
        if (left < h - near) return intermediate_step(k, left, row, t);
        const long long steps = steps_to(k, left, h);
        DAL_TRY(advance(k, steps));
        k->since_poll += ends_group(k) ? polling(k) : steps - 1;
        DAL_TRY(poll(k));
    }
}

static double row_time(const dal_observer *o, double T, long long row, long long samples)
{
    if (o->row_time && row < samples) return o->row_time(o->user, row);
    return row == samples ? T : T * ((double)row / (double)samples);
}

static dal_status check(const dal_run *run, const dal_observer *observer, double T,
                        long long samples, long long first_row, dal_error *error)
{
    const double h = run->layout.options.step;
    if (!(T > 0.0) || !isfinite(T))
        return dal__fail(error, DAL_ARGUMENT, "the time must be positive; it is %g", T);
    if (h > T)
        return dal__fail(error, DAL_ARGUMENT, "the step %g is larger than the time %g", h, T);
    if (T / h > MOST_STEPS)
        return dal__fail(error, DAL_ARGUMENT, "%g steps of %g are more than can be counted (2^53)",
                         T / h, h);
    if (samples < 1 || (double)samples > MOST_STEPS)
        return dal__fail(error, DAL_ARGUMENT, "samples must be at least 1; it is %lld", samples);
    if (first_row < 0 || first_row > samples)
        return dal__fail(error, DAL_ARGUMENT, "there is no row %lld among 0..%lld", first_row,
                         samples);
    if (row_time(observer, T, first_row, samples) < dal_run_time(run) - h)
        return dal__fail(error, DAL_ARGUMENT, "row %lld lies before the present t = %g", first_row,
                         dal_run_time(run));
    return DAL_OK;
}

static dal_status observe_start(const sampling *k)
{
    const dal_observer *o = k->observer;
    if (o->every < 1) return DAL_OK;
    if (o->values) return dal__observe_start(k->run, o, k->error);
    return o->step ? stopped(o->step(o->user, k->run), k) : DAL_OK;
}

dal_status dal_run_sample(dal_run *run, double T, long long samples, long long first_row,
                          const dal_observer *observer, dal_error *error)
{
    static const dal_observer nobody = {0};
    DAL_REQUIRE(run, error);
    if (!observer) observer = &nobody;
    DAL_TRY(check(run, observer, T, samples, first_row, error));
    sampling k = {run, observer, error, 0};
    if (first_row == 0 && dal_run_steps(run) == 0) DAL_TRY(observe_start(&k));
    for (long long row = first_row; row <= samples; row++)
        DAL_TRY(advance_to_row(&k, row, row_time(observer, T, row, samples)));
    return DAL_OK;
}
