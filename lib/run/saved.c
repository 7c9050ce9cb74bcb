/* saved.c - saves and restores a run.
 *
 * A checkpoint may come from a damaged or edited file.  The persistent state, whose order
 * kernel/persistent.h and events.h state, has numbers with few possible values: counters, flags,
 * sides.  Steps and searches rely on these. */
#include "run/event_search.h"
#include "run/events.h"
#include <math.h>

static const double max_count = 0x1p53;

/* The values that a number may have. */
typedef enum kind { FLAG, COUNT, POSITIVE } kind;
static const char *const kind_text[] = {"0 or 1", "a whole number from 0 to 2^53", "0 or more"};

typedef struct saved {
    const dal_run *run;
    const double *memory;
    size_t at; /* the next number */
    dal_error *error;
} saved;

static bool is_count(double x) { return x >= 0.0 && x <= max_count && x == floor(x); }

static bool is_of_kind(kind possible, double x)
{
    switch (possible) {
    case FLAG:
        return x == 0.0 || x == 1.0;
    case COUNT:
        return is_count(x);
    case POSITIVE:
        return x >= 0.0;
    }
    return false;
}

static double number_at(const saved *s, size_t i)
{
    return DAL__IS_QUAD(s->run) ? dal__quad_rounded(s->memory, i) : s->memory[i];
}

static double next(saved *s) { return number_at(s, s->at++); }

static dal_status fail(const saved *s, const char *name, double x, const char *possible)
{
    return dal__fail(s->error, DAL_STATUS_ARGUMENT, "persistent number %zu, %s, is %.17g, not %s",
                     s->at, name, x, possible);
}

/* The next count numbers, all of one kind. */
static dal_status check(saved *s, const char *name, kind possible, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const double x = next(s);
        if (!is_of_kind(possible, x)) return fail(s, name, x, kind_text[possible]);
    }
    return DAL_STATUS_OK;
}

/* The clock, and the state of the method.  Of numbers that are passed over nothing more is known
 * than that they are finite. */
static dal_status check_steps(saved *s)
{
    const dal__layout *k = &s->run->layout;
    s->at = dal__at(k, DAL__TIME) + 2; /* after the time and its rounding */
    DAL_TRY(check(s, "the number of steps", COUNT, 1));
    DAL_TRY(check(s, "the number of evaluations", COUNT, 1));
    DAL_TRY(check(s, "uses_newton", FLAG, DAL__COUNT_ONE(k)));
    s->at += DAL__COUNT_ONE(k); /* derivatives_h */
    DAL_TRY(check(s, "has_multiplier", FLAG, DAL__COUNT_ONE(k)));
    s->at += (size_t)DAL__COUNT_MULTIPLIER(k); /* multipliers */
    if (k->acceleration > 0) {
        DAL_TRY(check(s, "whether an acceleration is known", FLAG, 1));
        s->at += (size_t)k->acceleration - 1; /* the accelerations */
    }
    DAL_TRY(check(s, "the size of a substep", POSITIVE, DAL__COUNT_ONE(k)));
    s->at += 1; /* the energy of the start */
    DAL_TRY(check(s, "whether that is known", FLAG, 1));
    if (k->pivots > 0) {
        DAL_TRY(check(s, "whether pivots are unsteady", FLAG, 1));
        s->at += (size_t)k->pivots; /* pivots */
    }
    s->at += (size_t)DAL__COUNT_DERIVATIVES(k); /* derivatives */
    DAL_TRY(check(s, "a count of the choice of a solver", POSITIVE, DAL__COUNT_THREE(k)));
    return check(s, "whether a parameter was changed", FLAG, 1);
}

/* Whether event number `stopped`, from 1, can have ended the run; 0: none has. */
static bool can_have_stopped(const saved *s, double stopped, size_t counts)
{
    const dal_system *system = s->run->layout.system;
    if (stopped == 0.0) return true;
    if (!is_count(stopped) || stopped > system->events) return false;
    const size_t event = (size_t)stopped - 1;
    return system->event[event].actions & DAL_EVENT_STOPS && number_at(s, counts + event) > 0.0;
}

/* What events have added to observables: to E and to invariants alone, and where any happened. */
static dal_status check_jumps(saved *s, bool any)
{
    const dal__layout *k = &s->run->layout;
    const size_t first = s->at;
    for (int which = 0; which < DAL__OBSERVABLE_KINDS; which++) {
        const int count = dal__observable_count(k, which, s->run->exact);
        const int observed = which == DAL__OBSERVE_INVARIANTS ? k->system->observed : 0;
        const bool jumps = which == DAL__OBSERVE_E || which == DAL__OBSERVE_INVARIANTS;
        for (int i = 0; i < count; i++) {
            const double x = next(s);
            if (x != 0.0 && !(any && jumps && i < count - observed))
                return fail(s, "the jump of an observable", x, "0");
        }
    }
    s->at = first + (size_t)dal__max_observables(k);
    return DAL_STATUS_OK;
}

static dal_status check_events(saved *s)
{
    const dal__layout *k = &s->run->layout;
    const int events = k->system->events;
    bool any = false;
    s->at = dal__at_events(k);
    for (int i = 0; i < events; i++) {
        const double side = next(s);
        if (side != 0.0 && fabs(side) != 1.0 && fabs(side) != 2.0)
            return fail(s, "the side of an event", side, "-2, -1, 0, 1 or 2");
    }
    const size_t counts = s->at;
    DAL_TRY(check(s, "the number of times that an event happened", COUNT, (size_t)events));
    for (int i = 0; i < events; i++) any = any || number_at(s, counts + (size_t)i) > 0.0;
    const double stopped = next(s);
    if (!can_have_stopped(s, stopped, counts))
        return fail(s, "the event that stopped the run", stopped,
                    "0 or the number of one that happened and stops runs");
    const double stalled = next(s);
    if (!is_count(stalled) || stalled > DAL__MAX_STALLED)
        return fail(s, "the number of events at one time", stalled, "one that can be");
    return check_jumps(s, any);
}

/* Refuses a state of another effort or gauge; numbers that name a lift are the last before the
 * parameters, and are missing where it is the paper's. */
static dal_status check_lift(const dal_run *run, const double *memory, size_t count,
                             dal_error *error)
{
    const dal__layout *k = &run->layout;
    const saved s = {run, memory, 0, error};
    const size_t width = run->stored / dal__saved_count(k);
    const size_t without = run->stored - k->lift_memory * width;
    const bool has_names = count == without + DAL__LIFT_SIZE * width;
    if (!k->lifted || (!has_names && count != without)) return DAL_STATUS_OK;
    const size_t at = dal__at_lift(k);
    const double effort = has_names ? number_at(&s, at + DAL__LIFT_EFFORT) : DAL_EFFORT_IDENTITY;
    const double gauge = has_names ? number_at(&s, at + DAL__LIFT_GAUGE) : 0.0;
    if (!is_count(effort) || effort >= DAL_EFFORT_COUNT || !is_count(gauge)) return DAL_STATUS_OK;
    if (effort != k->system->effort)
        return dal__fail(error, DAL_STATUS_ARGUMENT,
                         "the persistent state is of effort %s, and the run of effort %s",
                         dal_effort_name((dal_effort)effort), dal_effort_name(k->system->effort));
    if (gauge == dal__lift_number(k->system, DAL__LIFT_GAUGE)) return DAL_STATUS_OK;
    return dal__fail(error, DAL_STATUS_ARGUMENT,
                     "the persistent state is of another gauge than the run, whose mu_e is %.80s",
                     k->system->gauge        ? k->system->gauge
                     : k->system->call.gauge ? "a callback"
                                             : "0");
}

const double *dal_run_save(const dal_run *run, size_t *count)
{
    if (count) *count = run ? run->stored : 0;
    return run && count ? run->storage : NULL;
}

dal_status dal_run_restore(dal_run *run, const double *memory, size_t count, dal_error *error)
{
    DAL_REQUIRE(run, error);
    DAL_REQUIRE(memory, error);
    DAL_TRY(check_lift(run, memory, count, error));
    if (count != run->stored)
        return dal__fail(error, DAL_STATUS_ARGUMENT,
                         "the persistent state of this run has %zu numbers, not %zu", run->stored,
                         count);
    const dal__layout *k = &run->layout;
    saved s = {run, memory, 0, error};
    for (size_t i = 0; i < dal__saved_count(k); i++)
        if (!dal__is_possible(k, i, number_at(&s, i)))
            return dal__fail(error, DAL_STATUS_NOT_FINITE, "persistent number %zu is not finite",
                             i + 1);
    DAL_TRY(check_steps(&s));
    if (k->event_memory > 0) DAL_TRY(check_events(&s));
    dal__run_back_up(run);
    const dal_status status = dal__run_load(run, memory);
    if (status == DAL_STATUS_OK) return DAL_STATUS_OK;
    dal__run_revert(run);
    return dal__fail(error, status, "the system cannot be prepared with the saved parameters");
}
