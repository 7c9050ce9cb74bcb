/* crossing.c - where functions of the state pass through 0 along a run.
 *
 * Within a step from z at t, a function f of (q, v, t) is one of the size s of a step of the same
 * method,
 *
 *     f(s) = f(step(z, s), t + s),   0 <= s <= h,
 *
 * and its root is the crossing, without interpolation (Henon 1982, DOI
 * 10.1016/0167-2789(82)90034-3, turns the equations round to the same end); under a tolerance
 * step(z, s) is the dense output of step(z, h).
 *
 * A step is searched in intervals, at whose ends f and its rate f' along the motion are known.  S
 * being max |f| at the ends known so far, an interval from a to b is halved where
 *
 *     max |f'| (b - a) > pi S   or   |f(b) - f(a) - (b - a) (f'(a) + f'(b))/2| > S/4:
 *
 * what oscillates as sin(w s) has no two extrema closer than pi/w, and a value that the rates do
 * not explain has jumped.  Else f has a root where its sign at b is not that at a; and where |f|
 * falls at a and rises at b, the root of f' between them divides the interval if f has the other
 * sign there: two intervals with a root each.
 *
 * Where f has just left 0, f(0) is only rounding; the interval is halved then until f has the sign
 * of the side that it left to.
 *
 * A step that was divided under a tolerance may be long beside the motion: it is searched in
 * intervals from the beginning, some for each substep. */
#include "run/crossing.h"
#include "core/pi.h"
#include "core/root.h"
#include "run/failure.h"
#include "run/observe.h"
#include <float.h>
#include <math.h>
#include <string.h>

/* In units of S, what the rates may not explain. */
static const double max_jump = 0.25;
/* Of rounding, what a value must exceed to be no rounding. */
static const double certain = 4.0;

/* An upper bound of the intervals at first, and the evaluations of F in each: a substep has 12 with
 * dop853, with taylor as many as its order. */
enum { MAX_INTERVALS = 10000, INTERVAL_EVALUATIONS = 4 };

/* ---- memory ---- */

enum { ARRAYS = 3 /* of an end */, OTHERS = 3 /* there, roundings */ };

/* Numbers that hold the dal__zero of `count` functions. */
static size_t zero_numbers(size_t count)
{
    return (count * sizeof(dal__zero) + sizeof(double) - 1) / sizeof(double);
}

size_t dal__crossing_numbers(size_t count, size_t stored)
{
    return zero_numbers(count) + (ARRAYS * (1 + DAL__INTERVAL_ENDS) + OTHERS) * count + 2 * stored;
}

static double *place_end(dal__interval_end *end, double *at, size_t count)
{
    *end = (dal__interval_end){.f = at, .rate = at + count, .slack = at + 2 * count};
    return at + ARRAYS * count;
}

void dal__crossing_init(dal__zero_search *c, dal_run *run, const dal__functions *functions,
                        double *memory)
{
    const size_t count = (size_t)functions->count;
    *c = (dal__zero_search){.run = run,
                            .functions = *functions,
                            .zero = (dal__zero *)(void *)memory,
                            .first_unresolved = NAN};
    for (size_t k = 0; k < count; k++) c->zero[k] = (dal__zero){DAL__SIDE_UNKNOWN, INFINITY, 0.0};
    double *at = place_end(&c->begin, memory + zero_numbers(count), count);
    for (int i = 0; i < DAL__INTERVAL_ENDS; i++) at = place_end(&c->end[i], at, count);
    c->there = at;
    c->value_rounding = at + count;
    c->rate_rounding = at + 2 * count;
    c->before = at + OTHERS * count;
    c->after = c->before + run->stored;
}

/* ---- values ---- */

double dal__crossing_resolution(const dal__zero_search *c)
{
    return 4.0 * DBL_EPSILON * fmax(fabs(dal_run_time(c->run)), fabs(c->h));
}

/* Whether a zero that leaves this side counts. */
static bool counts_from(const dal__zero_search *c, int k, dal__side side)
{
    const int direction = c->functions.direction(c->functions.user, c->run, k);
    return direction == 0 || direction == -dal__side_sign(side);
}

static dal_status evaluate_end(const dal__zero_search *c, dal__interval_end *end)
{
    const dal__functions *f = &c->functions;
    DAL_TRY(f->values(f->user, c->run, end->f, c->error));
    return f->rates(f->user, c->run, end->rate, c->error);
}

/* The functions at the present state, which is the top end. */
static dal_status evaluate_top(void *user, dal_run *run)
{
    dal__zero_search *c = user;
    const dal__functions *f = &c->functions;
    dal__interval_end *top = &c->end[c->ends - 1];
    const double size = fabs(top->s - c->begin.s);
    bool has_just_left = false;
    DAL_TRY(evaluate_end(c, top));
    for (int k = 0; k < f->count; k++) {
        top->slack[k] = 0.0;
        has_just_left = has_just_left || dal__is_just(c->zero[k].side);
        c->zero[k].size = fmax(c->zero[k].size, fabs(top->f[k]));
    }
    if (!has_just_left) return DAL_STATUS_OK;
    DAL_TRY(f->roundings(f->user, run, top->slack, c->there, c->error));
    for (int k = 0; k < f->count; k++)
        top->slack[k] = certain * (top->slack[k] + size * c->there[k]);
    return DAL_STATUS_OK;
}

/* Puts an end, the next one, before those that are known. */
static dal_status add_interval_end(dal__zero_search *c, double s, int halvings)
{
    dal__interval_end *end = &c->end[c->ends++];
    end->s = s;
    end->halvings = halvings;
    return dal__observe_intermediate(c->run, c->h, s, evaluate_top, c, c->error);
}

static dal_status evaluate_there(void *user, dal_run *run)
{
    const dal__zero_search *c = user;
    const dal__functions *f = &c->functions;
    return (c->by_rate ? f->rates : f->values)(f->user, run, c->there, c->error);
}

/* Function k, or its rate, a step of size s from here. */
static dal_status value_at(void *user, double s, double *value)
{
    dal__zero_search *c = user;
    if (s == 0.0)
        DAL_TRY(evaluate_there(c, c->run));
    else
        DAL_TRY(dal__observe_intermediate(c->run, c->h, s, evaluate_there, c, c->error));
    *value = c->there[c->k];
    return DAL_STATUS_OK;
}

/* What is rounding of function k at the begin of the step. */
static dal_status rounding_of(dal__zero_search *c, int k, double *rounding)
{
    const dal__functions *f = &c->functions;
    if (!c->has_roundings)
        DAL_TRY(f->roundings(f->user, c->run, c->value_rounding, c->rate_rounding, c->error));
    c->has_roundings = true;
    *rounding = c->value_rounding[k];
    return DAL_STATUS_OK;
}

/* ---- intervals ---- */

/* Whether function k has a rate with which it may turn more than once in the interval, or changes
 * by more than its rates explain; neither counts where it is only rounding. */
static dal_status examine(dal__zero_search *c, int k, bool *is_fast, bool *jumps)
{
    const dal__interval_end *a = &c->begin, *b = &c->end[c->ends - 1];
    const double s = b->s - a->s, change = b->f[k] - a->f[k], size = c->zero[k].size;
    const double most = fabs(s) * fmax(fabs(a->rate[k]), fabs(b->rate[k]));
    const double unexplained = fabs(change - 0.5 * s * (a->rate[k] + b->rate[k]));
    double rounding;
    *is_fast = most > DAL__PI * size;
    *jumps = unexplained > max_jump * size;
    if (!*is_fast && !*jumps) return DAL_STATUS_OK;
    DAL_TRY(rounding_of(c, k, &rounding));
    rounding = certain * (rounding + fabs(s) * c->rate_rounding[k]);
    const bool is_rounding = fmax(fabs(change), most) <= rounding;
    *is_fast = *is_fast && !is_rounding;
    *jumps = *jumps && !is_rounding;
    return DAL_STATUS_OK;
}

/* Halves the interval where a function is not resolved in it. */
static dal_status halve(dal__zero_search *c, bool *is_divided)
{
    dal__interval_end *end = &c->end[c->ends - 1];
    const double middle = c->begin.s + 0.5 * (end->s - c->begin.s);
    bool any_fast = false, any_jump = false;
    *is_divided = false;
    for (int k = 0; k < c->functions.count; k++) {
        bool is_fast, jumps;
        DAL_TRY(examine(c, k, &is_fast, &jumps));
        any_fast = any_fast || is_fast;
        any_jump = any_jump || jumps;
    }
    if (!any_fast && !any_jump) return DAL_STATUS_OK;
    *is_divided = end->halvings > 0 && c->ends < DAL__INTERVAL_ENDS &&
                  fabs(middle - c->begin.s) > dal__crossing_resolution(c);
    if (*is_divided) return add_interval_end(c, middle, --end->halvings);
    if (any_fast && !c->is_unresolved && c->unresolved++ == 0)
        c->first_unresolved = dal_run_time(c->run);
    c->is_unresolved = c->is_unresolved || any_fast;
    return DAL_STATUS_OK;
}

/* Whether |f| falls at the begin of the interval and not at its end, f having one sign there. */
static bool turns(const dal__zero_search *c, int k)
{
    const dal__interval_end *a = &c->begin, *b = &c->end[c->ends - 1];
    const int side = dal__side_sign(c->zero[k].side), toward = side * dal__sign_of(c->h);
    return side != 0 && !dal__is_just(c->zero[k].side) && side * a->f[k] >= 0.0 &&
           side * b->f[k] >= 0.0 && toward * a->rate[k] < 0.0 && toward * b->rate[k] >= 0.0;
}

/* The extremum of function k, which turns in the interval, and whether that is beyond 0. */
static dal_status find_extremum(dal__zero_search *c, int k, double *s, bool *is_beyond)
{
    const dal__interval_end *a = &c->begin, *b = &c->end[c->ends - 1];
    double f, rounding;
    dal__root root;
    c->k = k;
    c->by_rate = true;
    const dal_status status = dal__find_root(value_at, c, (dal__value_at){a->s, a->rate[k]},
                                             (dal__value_at){b->s, b->rate[k]}, &root);
    c->by_rate = false;
    DAL_TRY(status);
    *s = root.best.s;
    DAL_TRY(value_at(c, *s, &f));
    DAL_TRY(rounding_of(c, k, &rounding));
    *is_beyond = dal__side_sign(c->zero[k].side) * f < -rounding;
    c->touches += fabs(f) <= rounding;
    return DAL_STATUS_OK;
}

/* Divides the interval at the first extremum that is beyond 0. */
static dal_status divide(dal__zero_search *c, bool *is_divided)
{
    const dal__interval_end *end = &c->end[c->ends - 1];
    double first = INFINITY, s;
    bool is_beyond;
    for (int k = 0; k < c->functions.count; k++) {
        if (!turns(c, k)) continue;
        DAL_TRY(find_extremum(c, k, &s, &is_beyond));
        if (is_beyond && fabs(s) < fabs(first)) first = s;
    }
    *is_divided =
        isfinite(first) && first != c->begin.s && first != end->s && c->ends < DAL__INTERVAL_ENDS;
    return *is_divided ? add_interval_end(c, first, end->halvings) : DAL_STATUS_OK;
}

dal_status dal__zero_accuracy(dal__zero_search *c, int k, double *accuracy, dal_error *error)
{
    c->error = error; /* the search may have had another, which is gone */
    const dal__interval_end *a = &c->begin, *b = &c->end[c->ends - 1];
    DAL_TRY(rounding_of(c, k, accuracy));
    *accuracy += fmax(fabs(a->rate[k]), fabs(b->rate[k])) * dal__crossing_resolution(c);
    *accuracy *= certain;
    return DAL_STATUS_OK;
}

/* The zero of function k between two places; where f jumps there, the place beyond the jump. */
static dal_status locate_between(dal__zero_search *c, int k, dal__value_at begin, dal__value_at end)
{
    const int side = dal__side_sign(c->zero[k].side);
    double accuracy;
    dal__root root;
    DAL_TRY(dal__find_root(value_at, c, begin, end, &root));
    DAL_TRY(dal__zero_accuracy(c, k, &accuracy, c->error));
    const bool is_before_jump = side * root.best.f > accuracy;
    c->zero[k].s = fabs(is_before_jump ? root.other.s : root.best.s);
    return DAL_STATUS_OK;
}

/* The zero of function k in the interval, if one counts. */
static dal_status locate(dal__zero_search *c, int k)
{
    const dal__interval_end *a = &c->begin, *b = &c->end[c->ends - 1];
    dal__zero *zero = &c->zero[k];
    const int side = dal__side_sign(zero->side);
    const bool has_just_left = dal__is_just(zero->side);
    dal__value_at begin = {a->s, a->f[k]}, end = {b->s, b->f[k]}, middle = end;
    zero->s = INFINITY;
    if (!(side * end.f < 0.0) || !counts_from(c, k, zero->side)) return DAL_STATUS_OK;
    if (has_just_left && -side * end.f <= b->slack[k]) return DAL_STATUS_OK;
    c->k = k;
    while (has_just_left && side * middle.f <= 0.0) {
        end = middle;
        middle.s = a->s + 0.5 * (end.s - a->s);
        if (fabs(middle.s - a->s) <= dal__crossing_resolution(c)) break;
        DAL_TRY(value_at(c, middle.s, &middle.f));
        begin = middle;
    }
    if (side * begin.f > 0.0) return locate_between(c, k, begin, end);
    zero->s = fabs(a->s);
    return DAL_STATUS_OK;
}

dal__side dal__side_at(const dal__zero_search *c, int k, double f, double slack)
{
    const dal__side side = c->zero[k].side;
    const int from = dal__side_sign(side), to = dal__sign_of(f);
    if (dal__is_just(side) && (fabs(f) <= slack || (to == -from && counts_from(c, k, side))))
        return side;
    if (to == 0 || to == from || counts_from(c, k, side)) return (dal__side)from;
    return (dal__side)to;
}

/* Goes to the end of the interval, which has been searched. */
static void leave_interval(dal__zero_search *c)
{
    dal__interval_end *end = &c->end[--c->ends];
    const dal__interval_end begin = c->begin;
    for (int k = 0; k < c->functions.count; k++) {
        dal__zero *zero = &c->zero[k];
        const dal__side across = (dal__side)-dal__side_sign(zero->side);
        zero->side = isfinite(zero->s) ? across : dal__side_at(c, k, end->f[k], end->slack[k]);
        if (zero->side == DAL__SIDE_UNKNOWN) zero->side = (dal__side)dal__sign_of(end->f[k]);
        zero->s = INFINITY;
    }
    c->begin = *end;
    *end = begin;
    c->is_searched = false;
}

/* ---- a step ---- */

/* The sides at the begin of the step that are not known.  Where f is 0, a zero of one direction is
 * there if f leads that way. */
static void choose_sides(dal__zero_search *c)
{
    const int toward = dal__sign_of(c->h);
    for (int k = 0; k < c->functions.count; k++) {
        dal__zero *zero = &c->zero[k];
        const int direction = c->functions.direction(c->functions.user, c->run, k);
        const int rate = toward * dal__sign_of(c->begin.rate[k]), f = dal__sign_of(c->begin.f[k]);
        zero->s = INFINITY;
        zero->size = fabs(c->begin.f[k]);
        if (zero->side != DAL__SIDE_UNKNOWN) continue;
        if (f != 0)
            zero->side = (dal__side)f;
        else if (direction != 0 && rate == direction)
            zero->side = (dal__side)-direction;
        else
            zero->side = dal__just(rate != 0 ? rate : -direction);
    }
}

static void save_into(const dal_run *run, double *copy)
{
    memcpy(copy, run->storage, run->stored * sizeof *copy);
}

dal_status dal__crossing_begin(dal__zero_search *c, double h, dal_error *error)
{
    const long long evaluations = dal_run_evaluations(c->run);
    c->h = h;
    c->error = error;
    c->is_kept = c->has_roundings = c->is_searched = c->is_unresolved = false;
    c->ends = c->interval = 0;
    c->intervals = 1;
    c->begin.s = 0.0;
    if (!c->is_begun) DAL_TRY(evaluate_end(c, &c->begin));
    c->is_begun = false;
    choose_sides(c);
    save_into(c->run, c->before);
    dal_status status = dal__step_run(c->run, h, 1);
    if (status != DAL_STATUS_OK) return dal__failure_reason(c->run, h, status, error);
    save_into(c->run, c->after);
    c->end[0].s = h;
    c->end[0].halvings = DAL__HALVINGS;
    c->ends = 1;
    status = evaluate_top(c, c->run);
    const long long evaluated = dal_run_evaluations(c->run) - evaluations;
    dal__run_load(c->run, c->before);
    DAL_TRY(status);
    if (c->run->layout.options.tolerance > 0.0 && evaluated > INTERVAL_EVALUATIONS)
        c->intervals = evaluated / INTERVAL_EVALUATIONS;
    if (c->intervals > MAX_INTERVALS) c->intervals = MAX_INTERVALS;
    return DAL_STATUS_OK;
}

/* Leaves the interval that was searched, and adds the next one of those at first where none
 * remains. */
static dal_status next_interval(dal__zero_search *c)
{
    if (c->is_searched) leave_interval(c);
    if (c->ends != 1 || c->interval + 1 >= c->intervals) return DAL_STATUS_OK;
    c->interval++;
    return add_interval_end(c, c->h * ((double)c->interval / (double)c->intervals), DAL__HALVINGS);
}

dal_status dal__crossing_next(dal__zero_search *c, double *distance)
{
    *distance = INFINITY;
    for (;;) {
        bool is_divided;
        DAL_TRY(next_interval(c));
        if (c->ends == 0) break;
        DAL_TRY(halve(c, &is_divided));
        if (!is_divided) DAL_TRY(divide(c, &is_divided));
        if (is_divided) continue;
        for (int k = 0; k < c->functions.count; k++) {
            DAL_TRY(locate(c, k));
            *distance = fmin(*distance, c->zero[k].s);
        }
        c->is_searched = true;
        if (isfinite(*distance)) return DAL_STATUS_OK;
    }
    return DAL_STATUS_OK;
}

void dal__crossing_keep(dal__zero_search *c, double length, double distance)
{
    c->is_kept = true;
    c->length = length;
    c->distance = distance;
}

bool dal__crossing_is_kept(const dal__zero_search *c)
{
    const dal_run *run = c->run;
    return c->is_kept && memcmp(c->before, run->storage, run->stored * sizeof *c->before) == 0;
}

bool dal__crossing_has_kept(const dal__zero_search *c, double length, double *distance)
{
    *distance = c->distance;
    return dal__crossing_is_kept(c) && c->length == length;
}

void dal__crossing_take(dal__zero_search *c)
{
    dal__run_load(c->run, c->after);
    c->is_kept = false;
    c->is_begun = true;
}
