/* order.c - the observed order of a method: slopes of the error under halving of the step.
 *
 *     e_i = max_k |x_k(T; h_i) - x_k(T)| / max(u_k, |x_k(T)|),   h_i = h/2^i
 *     slope_i = log(e_(i-1) / e_i) / log(h_(i-1) / h_i)
 *
 * over the components of q, v and g, u_k being their units (scaled.c).
 * With e = C h^p (1 + a h + ..) the next term of the error moves a slope from p by
 *
 *     slope_i - p = a g_i + ..,   g_i = (h_(i-1) - h_i) / log(h_(i-1) / h_i),
 *
 * so that two successive slopes determine how far the second is from p:
 *
 *     slope_i - p = (slope_(i-1) - slope_i) g_i / (g_(i-1) - g_i)
 *
 * (for halved steps their difference; a third of it, and overestimated, where the next term is
 * a h^2).  An order is stated where that is small. */
#include "analysis/reference.h"
#include "core/error.h"
#include "core/settings.h"
#include "core/vectors.h"
#include "dalembert_order.h"
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Errors below this hold too much rounding for a slope good to 0.1: sums of 1e3 steps with
 * rounding 1e-16 each disturb it by a few percent. */
static const double clear_of_rounding = 2e-13;
/* An error near the size of the solution is bounded by that, not by the step. */
static const double below_the_solution = 0.5;
/* How far the next term of the error may move an order that is stated. */
static const double order_tolerance = 0.1;
/* How far a number of steps may miss a time, relative to it. */
static const double whole_tolerance = 1e-9;

long long dal_whole_steps(double from, double to, double step)
{
    const double steps = nearbyint((to - from) / step);
    return steps >= 1.0 && steps < 0x1p53 &&
                   fabs(steps * step - (to - from)) <= whole_tolerance * fmax(fabs(from), fabs(to))
               ? (long long)steps
               : 0;
}

/* A measurement: where the states are compared, in which units, and who observes the runs. */
typedef struct measurement {
    double T;
    const double *units; /* [numbers] */
    size_t numbers;
    const dal_observer *observer;
    dal_error *error;
} measurement;

/* Steps between polls. */
enum { POLL = 200 };

static dal_status advance_polled(const measurement *m, dal_run *run, long long steps)
{
    const dal_observer *o = m->observer;
    if (!o || !o->poll) return dal_run_advance(run, steps, m->error);
    for (; steps > 0; steps -= POLL) {
        DAL_TRY(dal_run_advance(run, steps < POLL ? steps : POLL, m->error));
        const dal_status status = o->poll(o->user, run);
        if (status != DAL_STATUS_OK)
            return dal__fail(m->error, status, "%s at t = %.17g", dal_status_text(status),
                             dal_run_time(run));
    }
    return DAL_STATUS_OK;
}

/* The state of a run of the spec at T into out[dimension]. */
static dal_status state_at(const measurement *m, const dal_run_spec *spec, double *out,
                           long long *evaluations)
{
    dal_run *run;
    const double T = m->T;
    dal_error *error = m->error;
    const long long steps = dal_whole_steps(spec->start_time, T, spec->options.step);
    if (steps == 0)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "time %g is not a whole number of steps of %g",
                         T, spec->options.step);
    DAL_TRY(dal__refuse_events(spec->system, "tables of the order", error));
    DAL_TRY(dal_run_create(&run, spec, error));
    const dal_status status = advance_polled(m, run, steps);
    size_t count = (size_t)dal_run_dimension(run);
    if (status == DAL_STATUS_OK) memcpy(out, dal_run_state(run), count * sizeof(double));
    *evaluations = dal_run_evaluations(run);
    dal_run_free(run);
    return status;
}

static double mean_step(const dal_order *o, int i)
{
    return (o->step[i - 1] - o->step[i]) / log(o->step[i - 1] / o->step[i]);
}

void dal_order_slopes(dal_order *o, double noise)
{
    if (!o) return;
    const int levels = o->levels < DAL_ORDER_LEVELS ? o->levels : DAL_ORDER_LEVELS;
    const double clear = fmax(clear_of_rounding, 10.0 * noise);
    o->order = o->slope[0] = NAN;
    o->outcome = levels < 3 ? DAL_ORDER_FEW : DAL_ORDER_COARSE;
    for (int i = 1; i < levels; i++)
        o->slope[i] = log(o->error[i - 1] / o->error[i]) / log(o->step[i - 1] / o->step[i]);
    /* The last three errors that come from the method. */
    int last = levels - 1, good = 0;
    for (int i = levels - 1; i >= 0 && good < 3; i--) {
        const bool is_good = o->error[i] > clear && o->error[i] < below_the_solution;
        if (!is_good) last = i - 1;
        good = is_good ? good + 1 : 0;
    }
    for (int i = 0; i < levels && levels >= 3 && good < 3; i++)
        if (o->error[i] <= clear) o->outcome = DAL_ORDER_ROUNDING;
    if (good < 3) return;
    /* The next term of the error. */
    const double g = mean_step(o, last), before = mean_step(o, last - 1);
    if (fabs(o->slope[last - 1] - o->slope[last]) * g <= order_tolerance * (before - g)) {
        o->order = o->slope[last];
        o->outcome = DAL_ORDER_FOUND;
    }
}

dal_status dal_order_measure(dal_order *order, const dal_run_spec *spec, double T, int levels,
                             const dal_method *reference_method, const double *reference,
                             const dal_observer *observer, dal_error *error)
{
    measurement m = {.T = T, .observer = observer, .error = error};
    dal_scaled *scaled;
    DAL_REQUIRE(order, error);
    dal_run *run;
    if (levels < 2 || levels > DAL_ORDER_LEVELS)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "levels = %d is not in 2..%d", levels,
                         DAL_ORDER_LEVELS);
    DAL_TRY(dal_run_create(&run, spec, error));
    const size_t count = (size_t)dal_run_dimension(run);
    dal_status status = dal_scaled_create_at(&scaled, run, error);
    dal_run_free(run);
    double *block = status == DAL_STATUS_OK ? dal__numbers(2, count) : NULL;
    if (block == NULL) {
        dal_scaled_free(scaled);
        return status != DAL_STATUS_OK ? status : dal__memory_error(error);
    }
    m.units = dal_scaled_units(scaled) + 1;
    m.numbers = 2 * (size_t)spec->system->n + (size_t)spec->system->multipliers;
    *order = (dal_order){.levels = levels};
    if (reference == NULL) {
        dal_run_spec accurate = *spec;
        long long evaluations;
        accurate.options.step = ldexp(spec->options.step, -levels);
        accurate.method = reference_method ? *reference_method : dal__library_method("gauss12");
        status = state_at(&m, &accurate, block, &evaluations);
        reference = block;
    }
    for (int i = 0; i < levels && status == DAL_STATUS_OK; i++) {
        dal_run_spec level = *spec;
        order->step[i] = level.options.step = ldexp(spec->options.step, -i);
        status = state_at(&m, &level, block + count, &order->evaluations[i]);
        if (status == DAL_STATUS_OK)
            order->error[i] = dal__distance(reference, block + count, m.units, m.numbers);
    }
    if (status == DAL_STATUS_OK) dal_order_slopes(order, 0.0);
    free(block);
    dal_scaled_free(scaled);
    return status;
}
