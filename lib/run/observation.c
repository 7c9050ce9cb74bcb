/* observation.c - the observables along a run, handed over several looks at a time.
 *
 * A look is taken after every so many steps.  With compiled observables the states are collected
 * and evaluated together, as many at a time as a register has lanes; else each look is evaluated at
 * once.  Looks are handed over where their number is a multiple of the room, wherever a run was
 * begun or interrupted, so that sums in parts find whole parts. */
#include "run/run.h"
#include <dalembert_kernel.h>

dal_status dal__stopped(const dal_run *run, dal_status status, dal_error *error)
{
    if (status == DAL_OK) return DAL_OK;
    return dal__fail(error, status, "%s at t = %.17g", dal_status_text(status), dal_run_time(run));
}

/* Takes the present state as look number k. */
static dal_status look(dal_run *run, int k)
{
    const dal__looks *looks = &run->looks;
    looks->times[k] = dal_run_time(run);
    if (!looks->states) return dal_run_observe(run, looks->values);
    for (int i = 0; i < run->layout.dim; i++)
        looks->states[(size_t)i * (size_t)looks->room + (size_t)k] = run->persistent[i];
    return DAL_OK;
}

static dal_status hand_over(dal_run *run, const dal_observer *o, int count, dal_error *error)
{
    const dal__looks *looks = &run->looks;
    if (count == 0) return DAL_OK;
    if (looks->states)
        looks->code.looks(looks->states, looks->room, count, run->work, looks->values);
    return dal__stopped(
        run, o->values(o->user, run, count, looks->times, looks->values, (size_t)looks->room),
        error);
}

/* Takes count steps and the looks on their way; *taken are those looks. */
static dal_status collect(dal_run *run, long long every, long long count, int *taken)
{
    const double h = run->layout.options.step;
    while (count > 0) {
        const long long due = every - dal_run_steps(run) % every;
        const long long steps = due < count ? due : count;
        DAL_TRY(dal__run_steps(run, h, steps));
        if (steps == due) DAL_TRY(look(run, *taken));
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
                           &why, run->looks.states, run->looks.room);
    *taken = (int)(failed ? tried - 1 : tried);
    return failed ? (dal_status)why : DAL_OK;
}

/* Steps until all the room is used. */
static long long steps_ahead(const dal_run *run, long long every)
{
    const long long made = dal_run_steps(run), last = made / every;
    const long long left = run->looks.room - (last + 1) % run->looks.room;
    return (last + left) * every - made;
}

dal_status dal__follow(dal_run *run, const dal_observer *o, long long count, dal_error *error)
{
    const bool traced = o->every == 1 && run->native.traced && run->looks.states;
    while (count > 0) {
        const long long ahead = steps_ahead(run, o->every), steps = ahead < count ? ahead : count;
        int taken = 0;
        const dal_status status =
            traced ? collect_trace(run, steps, &taken) : collect(run, o->every, steps, &taken);
        DAL_TRY(hand_over(run, o, taken, error));
        if (status != DAL_OK) return dal__explain(run, run->layout.options.step, status, error);
        count -= steps;
    }
    return DAL_OK;
}

dal_status dal__follow_start(dal_run *run, const dal_observer *o, dal_error *error)
{
    DAL_TRY(dal__stopped(run, look(run, 0), error));
    return hand_over(run, o, 1, error);
}
