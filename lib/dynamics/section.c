/* section.c - Poincare sections: where a run crosses g(q,v,t) = 0.
 *
 * Within a step from t, g is a function of the size s of a step of the same method from there,
 *
 *     g(s) = g(step(z, s), t + s),   0 <= s <= h,
 *
 * smooth, and meeting the values of g at both ends: its root is the crossing, without interpolation
 * (Henon 1982, DOI 10.1016/0167-2789(82)90034-3, turns the equations round to the same end).  Under
 * a tolerance step(z, s) is the dense output of step(z, h).
 *
 * A pair of crossings within a step has an extremum of g between them.  Where |g| at a step is not
 * above its neighbours', the rate of g at the ends of the two steps there shows which holds the
 * extremum, and its place is the root of that rate.  The first and the last step lack a neighbour;
 * there the rates at both ends decide alone.
 *
 * A step that was divided under a tolerance may be long beside the motion: it is searched in parts,
 * about one for each substep, the rates at both ends of a part deciding alone. */
#include "core/error.h"
#include "core/root.h"
#include "core/vectors.h"
#include "dalembert_analysis.h"
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* A minimum of |g| below this part of max |g| is a touch; rounding errors are far smaller. */
static const double touching = 1e-12;

/* An upper bound of the parts, and the evaluations of F in each: a substep has 12 with dop853, with
 * taylor as many as its order. */
enum { POLL = 1000, MAX_PARTS = 10000, PART_EVALUATIONS = 4 };

typedef struct mark {
    double *memory; /* all of the run's persistent state */
    double g;
} mark;

typedef struct search {
    dal_run *run;
    const dal_poincare *section;
    dal_crossings *found;
    dal_error *error;
    dal_evaluator *evaluator;
    double *values; /* [count] of the callback */
    size_t carried;
    mark before, last, now; /* the states two steps and one step ago, and the present one */
    double h, max_g;        /* max |g| */
    long long searched;     /* the last step that was searched for an extremum */
    int side;               /* the sign of g where it was last not 0 */
    int rate;               /* whether the rate of g is evaluated, or g */
    double value;           /* the result */
    bool is_leaving;        /* g was 0 at the last mark, and at all before */
    dal_crossing crossing;
} search;

static int sign(double x) { return (x > 0.0) - (x < 0.0); }

/* ---- values of g ---- */

static dal_status evaluate(search *w, double *value)
{
    const double *z = dal_run_state(w->run);
    const dal_poincare *p = w->section;
    const int n = dal_run_system(w->run)->n;
    const dal_point at = {.t = dal_run_time(w->run), .q = z, .v = z + n};
    const dal_status status =
        w->rate ? dal_measure_rate(w->evaluator, p->callback, p->count, &at, w->values)
                : dal_evaluator_call(w->evaluator, p->callback, at.t, at.q, at.v, NULL, w->values);
    *value = w->values[p->index];
    if (status == DAL_OK && isfinite(*value)) return DAL_OK;
    return dal__fail(w->error, status == DAL_OK ? DAL_NOT_FINITE : status,
                     "the section has no value at t = %.17g: %g", at.t, *value);
}

static dal_status evaluate_there(void *user, dal_run *run)
{
    search *w = user;
    (void)run;
    return evaluate(w, &w->value);
}

static dal_status return_to(search *w, const mark *place)
{
    return dal_run_restore(w->run, place->memory, w->carried, w->error);
}

/* g, or its rate, a step of size s from where the searched step began. */
static dal_status value_at(void *user, double s, double *value)
{
    search *w = user;
    DAL_TRY(s > 0.0 ? dal_run_intermediate(w->run, s, evaluate_there, w, w->error)
                    : evaluate(w, &w->value));
    *value = w->value;
    return DAL_OK;
}

/* ---- crossings ---- */

static dal_status report_crossing(void *user, dal_run *run)
{
    search *w = user;
    w->crossing.t = dal_run_time(run);
    return w->section->cross(w->section->user, run, &w->crossing);
}

/* The crossing between two sizes of the searched step, away from the present side. */
static dal_status cross(search *w, dal__value_at a, dal__value_at b)
{
    double s;
    DAL_TRY(dal__find_root(value_at, w, a, b, &s));
    w->crossing.direction = w->side = -w->side;
    const int wanted = w->section->direction;
    *(w->side > 0 ? &w->found->up : &w->found->down) += 1;
    if (wanted && wanted != w->side) return DAL_OK;
    w->crossing.number++;
    if (!w->section->cross) return DAL_OK;
    return s > 0.0 ? dal_run_intermediate(w->run, s, report_crossing, w, w->error)
                   : report_crossing(w, w->run);
}

static dal_status rate_at(search *w, const mark *place, double *rate)
{
    DAL_TRY(return_to(w, place));
    w->rate = 1;
    const dal_status status = evaluate(w, rate);
    w->rate = 0;
    return status;
}

/* An extremum between two places in the step from here, the rates there being of different
 * signs. */
static dal_status search_between(search *w, dal__value_at from, double rate, dal__value_at to,
                                 double rate_to)
{
    double s, g;
    w->rate = 1;
    const dal_status status = dal__find_root(value_at, w, (dal__value_at){from.s, rate},
                                             (dal__value_at){to.s, rate_to}, &s);
    w->rate = 0;
    DAL_TRY(status);
    DAL_TRY(value_at(w, s, &g));
    if (sign(g) == -w->side && fabs(g) > touching * w->max_g) {
        /* Where a run starts on the surface it leaves it, which is no crossing. */
        if (w->is_leaving)
            w->side = -w->side;
        else
            DAL_TRY(cross(w, from, (dal__value_at){s, g}));
        return cross(w, (dal__value_at){s, g}, to);
    }
    if (!w->is_leaving && fabs(g) <= touching * w->max_g) w->found->touches++;
    return DAL_OK;
}

/* The same between two marks. */
static dal_status search_extremum(search *w, const mark *from, double rate, const mark *to,
                                  double rate_to)
{
    DAL_TRY(return_to(w, from));
    return search_between(w, (dal__value_at){0.0, from->g}, rate, (dal__value_at){w->h, to->g},
                          rate_to);
}

/* |g| has a minimum about the last mark, which may hide a pair of crossings. */
static dal_status search_minimum(search *w, long long step)
{
    double first, middle, last;
    DAL_TRY(rate_at(w, &w->before, &first));
    DAL_TRY(rate_at(w, &w->last, &middle));
    DAL_TRY(rate_at(w, &w->now, &last));
    if (sign(first) != -w->side || sign(last) != w->side) return DAL_OK;
    const bool is_later = sign(middle) == -w->side;
    const long long searched = w->searched;
    w->searched = is_later ? step : step - 1;
    if (w->searched == searched) return DAL_OK;
    return is_later ? search_extremum(w, &w->last, middle, &w->now, last)
                    : search_extremum(w, &w->before, first, &w->last, middle);
}

/* The first or the last step.  Where g has no rate there, no extremum is known. */
static dal_status search_end(search *w, long long step)
{
    double first, last;
    if (w->searched == step) return DAL_OK;
    dal_status status = rate_at(w, &w->last, &first);
    if (status == DAL_OK) status = rate_at(w, &w->now, &last);
    if (status == DAL_NOT_FINITE) {
        if (w->error) *w->error = (dal_error){0};
        return DAL_OK;
    }
    DAL_TRY(status);
    if (sign(first) != -w->side || sign(last) != w->side) return DAL_OK;
    w->searched = step;
    return search_extremum(w, &w->last, first, &w->now, last);
}

/* ---- parts of a step ---- */

/* The rate of g a step of size s from here; NaN where it has none. */
static dal_status rate_within(search *w, double s, double *rate)
{
    w->rate = 1;
    const dal_status status = value_at(w, s, rate);
    w->rate = 0;
    if (status != DAL_NOT_FINITE) return status;
    if (w->error) *w->error = (dal_error){0};
    *rate = NAN;
    return DAL_OK;
}

/* The step from the last mark, in parts. */
static dal_status search_parts(search *w, long long parts)
{
    dal__value_at from = {0.0, w->last.g}, to;
    double rate, rate_to;
    DAL_TRY(return_to(w, &w->last));
    DAL_TRY(rate_within(w, 0.0, &rate));
    for (long long i = 1; i <= parts; i++, from = to, rate = rate_to) {
        to.s = i < parts ? w->h * ((double)i / (double)parts) : w->h;
        DAL_TRY(value_at(w, to.s, &to.f));
        DAL_TRY(rate_within(w, to.s, &rate_to));
        w->max_g = fmax(w->max_g, fabs(to.f));
        w->is_leaving = w->side == 0;
        if (w->is_leaving) w->side = sign(to.f);
        if (sign(to.f) == -w->side && w->side != 0)
            DAL_TRY(cross(w, from, to));
        else if (w->side * rate < 0.0 && w->side * rate_to > 0.0)
            DAL_TRY(search_between(w, from, rate, to, rate_to));
    }
    w->is_leaving = false;
    return DAL_OK;
}

/* ---- the run ---- */

static dal_status take_mark(search *w)
{
    size_t count;
    memcpy(w->now.memory, dal_run_save(w->run, &count), w->carried * sizeof(double));
    DAL_TRY(evaluate(w, &w->now.g));
    w->max_g = fmax(w->max_g, fabs(w->now.g));
    return DAL_OK;
}

static dal_status search_step(search *w, long long step, bool is_end)
{
    const mark oldest = w->before;
    const long long evaluations = dal_run_evaluations(w->run);
    long long parts = 1;
    w->before = w->last;
    w->last = w->now;
    w->now = oldest;
    DAL_TRY(dal_run_step(w->run, w->error));
    if (dal_run_tolerance(w->run) > 0.0)
        parts = (dal_run_evaluations(w->run) - evaluations) / PART_EVALUATIONS;
    DAL_TRY(take_mark(w));
    const int side = sign(w->now.g);
    const double g0 = w->side * w->before.g, g1 = w->side * w->last.g, g2 = w->side * w->now.g;
    if (parts > 1) {
        w->searched = step;
        DAL_TRY(search_parts(w, parts < MAX_PARTS ? parts : MAX_PARTS));
    } else if (w->side == 0) {
        w->side = side;
        w->is_leaving = true;
        if (side != 0) DAL_TRY(search_end(w, step));
        w->is_leaving = false;
    } else if (side == -w->side) {
        DAL_TRY(return_to(w, &w->last));
        DAL_TRY(cross(w, (dal__value_at){0.0, w->last.g}, (dal__value_at){w->h, w->now.g}));
    } else {
        if (step > 1 && g0 >= g1 && g1 >= 0.0 && g2 >= g1) DAL_TRY(search_minimum(w, step));
        if (is_end) DAL_TRY(search_end(w, step));
    }
    return return_to(w, &w->now);
}

static dal_status search_steps(search *w, long long steps)
{
    const dal_poincare *p = w->section;
    DAL_TRY(take_mark(w));
    w->side = sign(w->now.g);
    for (long long step = 1; step <= steps; step++) {
        DAL_TRY(search_step(w, step, step == 1 || step == steps));
        if (p->poll && step % POLL == 0) DAL_TRY(p->poll(p->user, w->run));
    }
    return DAL_OK;
}

/* ---- making one ---- */

static dal_status evaluator_of(search *w)
{
    const dal_system *s = dal_run_system(w->run);
    const double *value = dal_run_parameters(w->run);
    dal_setting *settings = calloc((size_t)s->parameters + 1, sizeof *settings);
    if (settings == NULL) return dal__fail(w->error, DAL_MEMORY, "section: out of memory");
    for (int i = 0; i < s->parameters; i++) settings[i] = (dal_setting){s->parameter[i], value[i]};
    const dal_status status =
        dal_evaluator_create(&w->evaluator, s, settings, s->parameters, w->error);
    free(settings);
    return status;
}

dal_status dal_run_crossings(dal_run *run, double T, const dal_poincare *section,
                             dal_crossings *found, dal_error *error)
{
    DAL_REQUIRE(run, error);
    DAL_REQUIRE(section, error);
    DAL_REQUIRE(found, error);
    const double h = dal_run_step_size(run);
    search w = {.run = run, .section = section, .found = found, .error = error, .h = h};
    *found = (dal_crossings){0};
    if (section->callback == NULL || section->index < 0 || section->index >= section->count)
        return dal__fail(error, DAL_ARGUMENT, "the section is value %d of %d", section->index + 1,
                         section->callback == NULL ? 0 : section->count);
    if (h < 0.0)
        return dal__fail(error, DAL_ARGUMENT, "a section needs a positive step; it is %g", h);
    DAL_TRY(dal__refuse_events(dal_run_system(run), "sections", error));
    const long long steps = dal_whole_steps(dal_run_time(run), T, h);
    if (steps == 0)
        return dal__fail(error, DAL_ARGUMENT, "time %g is not a whole number of steps of %g", T, h);
    dal_run_save(run, &w.carried);
    double *block = dal__numbers(1, 3 * w.carried + (size_t)section->count);
    if (block == NULL) return dal__fail(error, DAL_MEMORY, "section: out of memory");
    w.before.memory = block;
    w.last.memory = block + w.carried;
    w.now.memory = block + 2 * w.carried;
    w.values = block + 3 * w.carried;
    dal_status status = evaluator_of(&w);
    if (status == DAL_OK) status = search_steps(&w, steps);
    dal_evaluator_free(w.evaluator);
    free(block);
    return status;
}
