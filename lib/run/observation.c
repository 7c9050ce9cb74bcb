/* observation.c - the observables along a run, handed over several looks at a time.
 *
 * A record is taken after every so many steps.  With compiled observables the states are collected
 * and evaluated together, as many at a time as a register has lanes; else each record is evaluated
 * at once.  Looks are handed over where their number is a multiple of the room, wherever a run was
 * begun or interrupted, so that sums in parts find whole parts. */
#include "run/run.h"
#include <dalembert_kernel.h>

dal_status dal__stopped(const dal_run *run, dal_status status, dal_error *error)
{
    if (status == DAL_OK) return DAL_OK;
    return dal__fail(error, status, "%s at t = %.17g", dal_status_text(status), dal_run_time(run));
}

/* Takes the present state as record number k. */
static dal_status record(dal_run *run, int k)
{
    const dal__observations *observations = &run->observations;
    observations->times[k] = dal_run_time(run);
    if (!observations->states) return dal_run_observe(run, observations->values);
    for (int i = 0; i < run->layout.dim; i++)
        observations->states[(size_t)i * (size_t)observations->capacity + (size_t)k] =
            run->persistent[i];
    return DAL_OK;
}

static dal_status deliver(dal_run *run, const dal_observer *o, int count, dal_error *error)
{
    const dal__observations *observations = &run->observations;
    if (count == 0) return DAL_OK;
    if (observations->states)
        observations->code.observables(observations->states, observations->capacity, count,
                                       run->work, observations->values);
    return dal__stopped(run,
                        o->values(o->user, run, count, observations->times, observations->values,
                                  (size_t)observations->capacity),
                        error);
}

/* Takes count steps and the looks on their way; *taken are those observations. */
static dal_status collect(dal_run *run, long long every, long long count, int *taken)
{
    const double h = run->layout.options.step;
    while (count > 0) {
        const long long due = every - dal_run_steps(run) % every;
        const long long steps = due < count ? due : count;
        DAL_TRY(dal__run_steps(run, h, steps));
        if (steps == due) DAL_TRY(record(run, *taken));
        *taken += steps == due;
        count -= steps;
    }
    return DAL_OK;
}

/* The same where every step is looked at and compiled steps leave their trace. */
static dal_status collect_trace(dal_run *run, long long count, int *taken)
{
    unsigned failed = 0;
    int why = DAL_OK;
    const long long tried =
        run->native.traced(run->persistent, run->work, run->layout.options.step, count, &failed,
                           &why, run->observations.states, run->observations.capacity);
    *taken = (int)(failed ? tried - 1 : tried);
    return failed ? (dal_status)why : DAL_OK;
}

/* Steps until all the room is used. */
static long long steps_to_delivery(const dal_run *run, long long every)
{
    const long long made = dal_run_steps(run), last = made / every;
    const long long left = run->observations.capacity - (last + 1) % run->observations.capacity;
    return (last + left) * every - made;
}

dal_status dal__observe_steps(dal_run *run, const dal_observer *o, long long count,
                              dal_error *error)
{
    const bool traced = o->every == 1 && run->native.traced && run->observations.states;
    while (count > 0) {
        const long long ahead = steps_to_delivery(run, o->every),
                        steps = ahead < count ? ahead : count;
        int taken = 0;
        const dal_status status =
            traced ? collect_trace(run, steps, &taken) : collect(run, o->every, steps, &taken);
        DAL_TRY(deliver(run, o, taken, error));
        if (status != DAL_OK)
            return dal__failure_reason(run, run->layout.options.step, status, error);
        count -= steps;
    }
    return DAL_OK;
}

dal_status dal__observe_start(dal_run *run, const dal_observer *o, dal_error *error)
{
    DAL_TRY(dal__stopped(run, record(run, 0), error));
    return deliver(run, o, 1, error);
}
