/* sample.c - a run observed: rows at equal distances in t, and observations every so often.
 *
 * The trajectory consists of steps h.  A row counts as reached when its time is nearer than ALIGNED
 * steps, or than the rounding of the clock, to the time of a step; otherwise dal_run_intermediate
 * gives the row.  Times are compared in the direction of the run, the sign of h.
 *
 * dal_observer.values receives observations in batches.  With compiled observables the states are
 * collected and evaluated together, as many at a time as a register has lanes; else each is
 * evaluated at once.  A batch ends where the number of observations since the start is a multiple
 * of the capacity, wherever a run was begun or interrupted, so that sums in parts find whole parts.
 */
#include "core/error.h"
#include "dalembert_program.h"
#include "run/event_search.h"
#include "run/events.h"
#include "run/failure.h"
#include "run/observe.h"
#include "run/run.h"
#include "run/scales.h"
#include <float.h>
#include <math.h>

#define ALIGNED   1e-9
#define MAX_STEPS 0x1p53

enum { POLL = 992 /* whole batches of observations, see lib/jit/native.c */ };

typedef struct sampling {
    dal_run *run;
    const dal_observer *observer;
    dal_error *error;
    long long since_poll;
} sampling;

/* The status of an observer, which ends the run unless it is DAL_STATUS_OK. */
static dal_status observed(const sampling *k, dal_status status)
{
    if (status == DAL_STATUS_OK) return DAL_STATUS_OK;
    return dal__fail(k->error, status, "%s at t = %.17g", dal_status_text(status),
                     dal_run_time(k->run));
}

/* ---- observations ---- */

/* Stores the present state as observation number i. */
static dal_status store_observation(dal_run *run, int i)
{
    const dal__observations *o = &run->observations;
    o->times[i] = dal_run_time(run);
    if (!o->states) return dal_run_observe(run, o->values);
    for (int c = 0; c < run->layout.dim; c++)
        o->states[(size_t)c * (size_t)o->capacity + (size_t)i] = run->persistent[c];
    return DAL_STATUS_OK;
}

/* Evaluates the observables of count stored states together. */
static void evaluate_states(const dal_run *run, int count)
{
    const dal__observations *o = &run->observations;
    const bool changed = run->persistent[dal__at_changed(&run->layout)] != 0.0;
    double *error = o->values + (size_t)(dal_run_observables(run) - 1) * (size_t)o->capacity;
    o->code.observables(o->states, o->capacity, count, run->work, o->values);
    for (int i = 0; i < count && run->exact && changed; i++) error[i] = NAN;
}

/* Of the one observation that a run with events has at a time. */
static void leave_out_jumps(const dal_run *run)
{
    const dal__observations *o = &run->observations;
    for (int i = 0; i < dal_run_observables(run); i++)
        o->values[(size_t)i * (size_t)o->capacity] -= dal_run_event_jump(run, i);
}

/* The scales at each of the last count observations where they are due. */
static dal_status deliver_scales(const sampling *k, int count)
{
    dal_run *run = k->run;
    const long long last = dal_run_steps(run) / k->observer->every + 1, before = last - count;
    for (long long due = dal__scales_due(before); due <= last; due = dal__scales_due(due)) {
        dal_status status = DAL_STATUS_OK;
        const double *scales = dal__scales_observed(run, (int)(due - before - 1), &status);
        if (scales) status = k->observer->scales(k->observer->user, run, scales);
        DAL_TRY(observed(k, status));
    }
    return DAL_STATUS_OK;
}

static dal_status deliver(const sampling *k, int count)
{
    const dal__observations *o = &k->run->observations;
    if (count == 0) return DAL_STATUS_OK;
    if (k->observer->scales) DAL_TRY(deliver_scales(k, count));
    if (k->observer->states)
        DAL_TRY(observed(k, k->observer->states(k->observer->user, k->run, count, o->times,
                                                o->states ? o->states : k->run->persistent,
                                                (size_t)o->capacity)));
    if (o->states) evaluate_states(k->run, count);
    if (k->run->layout.system->events > 0) leave_out_jumps(k->run);
    return observed(k, k->observer->values(k->observer->user, k->run, count, o->times, o->values,
                                           (size_t)o->capacity));
}

/* Takes count steps and stores *made observations on their way. */
static dal_status collect(dal_run *run, long long every, long long count, int *made)
{
    while (count > 0) {
        const long long due = every - dal_run_steps(run) % every;
        const long long steps = due < count ? due : count;
        DAL_TRY(dal__step_run(run, run->layout.options.step, steps));
        if (steps == due) DAL_TRY(store_observation(run, *made));
        *made += steps == due;
        count -= steps;
    }
    return DAL_STATUS_OK;
}

/* The same where every step is observed and compiled steps leave a trace. */
static dal_status collect_trace(dal_run *run, long long count, int *made)
{
    unsigned failed = 0;
    int reason = DAL_STATUS_OK;
    const long long tried =
        run->native.traced(run->persistent, run->work, run->layout.options.step, count, &failed,
                           &reason, run->observations.states, run->observations.capacity);
    *made = (int)(failed ? tried - 1 : tried);
    return failed ? (dal_status)reason : DAL_STATUS_OK;
}

static dal_status observe_steps(const sampling *k, long long count)
{
    dal_run *run = k->run;
    const long long every = k->observer->every, capacity = run->observations.capacity;
    const bool traced = every == 1 && run->native.traced && run->observations.states;
    while (count > 0) {
        const long long made = dal_run_steps(run), last = made / every;
        const long long ahead = (last + capacity - (last + 1) % capacity) * every - made;
        const long long steps = ahead < count ? ahead : count;
        int stored = 0;
        const dal_status status =
            traced ? collect_trace(run, steps, &stored) : collect(run, every, steps, &stored);
        DAL_TRY(deliver(k, stored));
        if (status != DAL_STATUS_OK)
            return dal__failure_reason(run, run->layout.options.step, status, k->error);
        count -= steps;
    }
    return DAL_STATUS_OK;
}

static dal_status observe_start(const sampling *k)
{
    const dal_observer *o = k->observer;
    if (o->every < 1) return DAL_STATUS_OK;
    if (!o->values) return o->step ? observed(k, o->step(o->user, k->run)) : DAL_STATUS_OK;
    DAL_TRY(observed(k, store_observation(k->run, 0)));
    return deliver(k, 1);
}

/* An event of the run, for the observer. */
static dal_status report_event(void *user, dal_run *run, const dal_occurrence *event)
{
    const sampling *k = user;
    (void)run;
    return observed(k, k->observer->event(k->observer->user, k->run, event));
}

/* Takes up to count steps and observes those that are due. */
static dal_status advance(const sampling *k, long long count)
{
    const dal_observer *o = k->observer;
    const dal__event_listener listener = {o->event ? report_event : NULL, (void *)k};
    for (; count > 0 && k->run->layout.system->events > 0; count--) {
        const long long made = dal_run_steps(k->run);
        const dal_status status = dal__advance_events(k->run, 1, &listener, k->error);
        if (status != DAL_STATUS_OK && status != DAL_STATUS_STOPPED) return status;
        const bool is_due =
            o->every > 0 && dal_run_steps(k->run) > made && dal_run_steps(k->run) % o->every == 0;
        if (is_due && o->values) {
            DAL_TRY(observed(k, store_observation(k->run, 0)));
            DAL_TRY(deliver(k, 1));
        } else if (is_due && o->step) {
            DAL_TRY(observed(k, o->step(o->user, k->run)));
        }
        DAL_TRY(status);
    }
    if (o->values && o->every > 0) return observe_steps(k, count);
    if (!o->step || o->every < 1) return dal_run_advance(k->run, count, k->error);
    while (count > 0) {
        const long long due = o->every - dal_run_steps(k->run) % o->every;
        const long long steps = due < count ? due : count;
        DAL_TRY(dal_run_advance(k->run, steps, k->error));
        if (steps == due) DAL_TRY(observed(k, o->step(o->user, k->run)));
        count -= steps;
    }
    return DAL_STATUS_OK;
}

/* ---- rows ---- */

dal_status dal_run_intermediate(dal_run *run, double h,
                                dal_status (*observe)(void *user, dal_run *run), void *user,
                                dal_error *error)
{
    DAL_REQUIRE(run, error);
    DAL_REQUIRE(observe, error);
    if (!isfinite(h))
        return dal__fail(error, DAL_STATUS_ARGUMENT,
                         "an intermediate step must be finite; it is %g", h);
    const double step = run->layout.options.step, fraction = h / step;
    const double whole = fraction > 0.0 && fraction < 1.0 ? step : h;
    dal__hold_as_kept(run);
    const dal_status status = dal__observe_intermediate(run, whole, h, observe, user, error);
    if (run->is_held) dal__run_hold(run, NULL);
    return status;
}

/* Steps and rows between polls: 992 / 2^i, so that polls coincide with ends of batches. */
static long long polling(const sampling *k)
{
    const long long wanted = k->observer->polling;
    long long steps = POLL;
    while (wanted > 0 && steps > wanted) steps /= 2;
    return steps;
}

static dal_status poll(sampling *k)
{
    if (++k->since_poll < polling(k) || !k->observer->poll) return DAL_STATUS_OK;
    k->since_poll = 0;
    return observed(k, k->observer->poll(k->observer->user, k->run));
}

typedef struct sampled_row {
    const sampling *k;
    long long row;
    double t;
} sampled_row;

static dal_status sample_row(void *user, dal_run *run)
{
    const sampled_row *r = user;
    const dal_observer *o = r->k->observer;
    return o->sample ? observed(r->k, o->sample(o->user, run, r->row, r->t)) : DAL_STATUS_OK;
}

/* Steps that surely end before a row at distance `rest`, the last two excepted, and not after the
 * next end of a batch. */
static long long steps_towards(const sampling *k, double rest, double h)
{
    const double steps = rest / h - 2.0;
    const long long batch = polling(k), max = batch - (dal_run_steps(k->run) + 1) % batch;
    return steps < 1.0 ? 1 : steps > (double)max ? max : (long long)steps;
}

static dal_status advance_to_row(sampling *k, long long row, double t)
{
    const double step = k->run->layout.options.step, h = fabs(step);
    const double near = fmax(ALIGNED * h, 4.0 * DBL_EPSILON * fabs(t));
    sampled_row r = {k, row, t};
    for (;;) {
        const double rest = copysign(1.0, step) * (t - dal_run_time(k->run));
        if (rest <= near) return sample_row(&r, k->run);
        const bool is_within = rest < h - near;
        double event = INFINITY;
        if (is_within) DAL_TRY(dal__next_event(k->run, copysign(rest, step), &event, k->error));
        if (is_within && event > rest) {
            DAL_TRY(dal_run_intermediate(k->run, copysign(rest, step), sample_row, &r, k->error));
            return poll(k);
        }
        const long long steps = steps_towards(k, rest, h);
        DAL_TRY(advance(k, steps));
        const bool batch_ends = (dal_run_steps(k->run) + 1) % polling(k) == 0;
        k->since_poll += batch_ends ? polling(k) : steps - 1;
        DAL_TRY(poll(k));
    }
}

/* When rows are, as decimal numbers: how many there are changes no row that two runs share. */
typedef struct row_times {
    const dal_observer *observer;
    double from, last;
    dal__decimal length;
    long long samples;
} row_times;

static row_times make_row_times(const dal_run *run, const dal_observer *o, double T,
                                long long samples)
{
    const double from = run->layout.start_time;
    return (row_times){o, from, T, dal__decimal_difference(T, from), samples};
}

static double row_time(const row_times *r, long long row)
{
    const dal_observer *o = r->observer;
    if (row == r->samples) return r->last;
    return o->row_time ? o->row_time(o->user, row)
                       : dal__add_share(r->from, r->length, (double)row, (double)r->samples);
}

/* The counts of an observer, and the times of its rows, which may repeat. */
static dal_status check_observer(const dal_run *run, const row_times *times, long long first_row,
                                 dal_error *error)
{
    const dal_observer *o = times->observer;
    const double direction = copysign(1.0, run->layout.options.step);
    double before = row_time(times, first_row);
    if (o->every < 0 || (double)o->every > MAX_STEPS)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "observations every %lld steps cannot be made",
                         o->every);
    if (o->polling < 0)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "polls every %lld steps cannot be made",
                         o->polling);
    for (long long row = first_row; o->row_time && row <= times->samples; row++) {
        const double t = row_time(times, row);
        if (!(direction * (t - before) >= 0.0) || !isfinite(t))
            return dal__fail(error, DAL_STATUS_ARGUMENT,
                             "row %lld is at t = %.17g, the row before it at %.17g", row, t,
                             before);
        before = t;
    }
    return DAL_STATUS_OK;
}

static dal_status check_arguments(const dal_run *run, const row_times *times, long long first_row,
                                  dal_error *error)
{
    const double T = times->last;
    const long long samples = times->samples;
    const double h = run->layout.options.step, from = run->layout.start_time, whole = T - from;
    if (!isfinite(T) || !isfinite(whole))
        return dal__fail(error, DAL_STATUS_ARGUMENT, "the time must be finite; it is %g", T);
    if (!(whole * copysign(1.0, h) > 0.0))
        return dal__fail(error, DAL_STATUS_ARGUMENT, "a step of %g does not lead from t = %g to %g",
                         h, from, T);
    if (fabs(h) - fabs(whole) > DBL_EPSILON * fmax(fabs(from), fabs(T)))
        return dal__fail(error, DAL_STATUS_ARGUMENT, "the step %g is larger than the time %g", h,
                         whole);
    if (whole / h > MAX_STEPS)
        return dal__fail(error, DAL_STATUS_ARGUMENT,
                         "%g steps of %g are more than can be counted (2^53)", whole / h, h);
    if (samples < 1 || (double)samples > MAX_STEPS)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "samples must be at least 1; it is %lld",
                         samples);
    if (first_row < 0 || first_row > samples)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "there is no row %lld among 0..%lld",
                         first_row, samples);
    const double first = row_time(times, first_row);
    if (copysign(1.0, h) * (first - dal_run_time(run)) < -fabs(h))
        return dal__fail(error, DAL_STATUS_ARGUMENT, "row %lld lies before the present t = %g",
                         first_row, dal_run_time(run));
    return DAL_STATUS_OK;
}

dal_status dal_run_sample(dal_run *run, double T, long long samples, long long first_row,
                          const dal_observer *observer, dal_error *error)
{
    static const dal_observer nobody = {0};
    DAL_REQUIRE(run, error);
    if (!observer) observer = &nobody;
    const row_times times = make_row_times(run, observer, T, samples);
    DAL_TRY(check_arguments(run, &times, first_row, error));
    DAL_TRY(check_observer(run, &times, first_row, error));
    DAL_TRY(dal__check_events(run, error));
    sampling k = {run, observer, error, 0};
    if (first_row == 0 && dal_run_steps(run) == 0) DAL_TRY(observe_start(&k));
    double last = dal_run_time(run), t; /* the time of the last row, or of the start */
    for (long long row = first_row; row <= samples; row++, last = t) {
        t = row_time(&times, row);
        const dal_status status = advance_to_row(&k, row, t);
        const bool is_endless = status == DAL_STATUS_EVENT && dal_run_time(run) != last;
        if ((is_endless || status == DAL_STATUS_STOPPED) &&
            observer->sample) /* the last row is there */
            DAL_TRY(observed(&k, observer->sample(observer->user, run, row, dal_run_time(run))));
        if (status == DAL_STATUS_STOPPED) return dal__check_events(run, error);
        DAL_TRY(status);
    }
    return DAL_STATUS_OK;
}
