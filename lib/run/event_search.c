/* event_search.c - the formulas of events, whose zeros crossing.c finds along a run. */
#include "run/event_search.h"
#include <float.h>
#include <string.h>

/* Multiples of DBL_EPSILON: below the first, |f| is 0 up to its rounding; below the second, a
 * rate is. */
static const double value_factor = 16.0, rate_factor = 64.0;

enum { MAX_HALVES = 12 };

/* ---- memory ---- */

enum { ARRAYS = 3 /* f, rate, there */ };

/* Numbers that hold a dal__zero_search. */
static size_t crossing_numbers(void)
{
    return (sizeof(dal__zero_search) + sizeof(double) - 1) / sizeof(double);
}

static int branch_count(const dal__layout *k)
{
    return k->system->branches ? k->system->branches->count : 0;
}

enum { BRANCH_ARRAYS = 5 /* point, value, its size, rate, across */ };

/* Numbers of a dal__held_places. */
static size_t held_numbers(const dal__layout *k, size_t stored)
{
    const size_t events = (size_t)k->system->events, branches = (size_t)branch_count(k);
    if (branches == 0) return 0;
    return crossing_numbers() + dal__crossing_numbers(events + branches, stored) +
           BRANCH_ARRAYS * branches + 2 * events +
           (branches * sizeof(dal__held_branch) + sizeof(double) - 1) / sizeof(double);
}

size_t dal__event_scratch(const dal__layout *k, size_t stored)
{
    const size_t events = (size_t)k->system->events, n = (size_t)k->n;
    if (events == 0) return 0;
    return (ARRAYS + 1 + 4 * n) * events + (size_t)k->dim + (size_t)dal__max_observables(k) +
           crossing_numbers() + dal__crossing_numbers(events, stored) + held_numbers(k, stored);
}

static dal__held_places held_places(const dal__layout *k, size_t stored, double *at)
{
    const size_t events = (size_t)k->system->events, branches = (size_t)branch_count(k);
    double *arrays = at + crossing_numbers() + dal__crossing_numbers(events + branches, stored);
    if (branches == 0) return (dal__held_places){.crossing = NULL};
    return (dal__held_places){
        .crossing = (dal__zero_search *)(void *)at,
        .point = arrays,
        .value = arrays + branches,
        .rate = arrays + 3 * branches,
        .across = arrays + 4 * branches,
        .event_rate = arrays + BRANCH_ARRAYS * branches,
        .event_scale = arrays + BRANCH_ARRAYS * branches + events,
        .branch = (dal__held_branch *)(void *)(arrays + BRANCH_ARRAYS * branches + 2 * events)};
}

dal__event_places dal__event_places_of(const dal_run *run)
{
    const dal__layout *k = &run->layout;
    const size_t E = (size_t)k->system->events, n = (size_t)k->n;
    double *side = run->persistent + dal__at_events(k), *at = run->event_scratch;
    return (dal__event_places){.side = side,
                               .count = side + E,
                               .stopped = side + 2 * E,
                               .stalled = side + 2 * E + 1,
                               .jump = side + 2 * E + 2,
                               .f = at,
                               .rate = at + E,
                               .there = at + 2 * E,
                               .normals = at + ARRAYS * E,
                               .states = at + (ARRAYS + 1 + 2 * n) * E,
                               .before = at + (ARRAYS + 1 + 4 * n) * E,
                               .observed = at + (ARRAYS + 1 + 4 * n) * E + k->dim};
}

/* ---- values ---- */

const char *dal__event_name(const dal_system *system, int k)
{
    return system->event[k].name ? system->event[k].name : "an event";
}

static dal_status evaluate(dal_run *run, dal_callback *callback, double *out, dal_error *error)
{
    const dal_system *system = run->layout.system;
    const dal_point at = dal__here(run);
    const dal_status status = callback(system, &at, out);
    for (int k = 0; k < system->events; k++)
        if (status != DAL_STATUS_OK || !isfinite(out[k]))
            return dal__fail(error, status == DAL_STATUS_OK ? DAL_STATUS_NOT_FINITE : status,
                             "%s has no value at t = %.17g", dal__event_name(system, k), at.t);
    return DAL_STATUS_OK;
}

static dal_status values_of(void *user, dal_run *run, double *out, dal_error *error)
{
    (void)user;
    return evaluate(run, run->layout.system->event_values, out, error);
}

static dal_status rates_of(void *user, dal_run *run, double *out, dal_error *error)
{
    (void)user;
    return evaluate(run, run->layout.system->event_rates, out, error);
}

dal_status dal__evaluate_events(const dal__event_search *w)
{
    DAL_TRY(values_of(NULL, w->run, w->m.f, w->error));
    return dal__evaluate_event_rates(w);
}

const double *dal__event_normal(const dal__event_search *w, int k)
{
    return w->m.normals + (size_t)k * (1 + 2 * (size_t)w->system->n);
}

dal_status dal__evaluate_event_normals(const dal__event_search *w)
{
    const dal_point at = dal__here(w->run);
    const dal_status status = w->system->event_normals(w->system, &at, w->m.normals);
    if (status == DAL_STATUS_OK) return DAL_STATUS_OK;
    return dal__fail(w->error, status, "the events have no normals at t = %.17g", at.t);
}

/* The rounding of f, from the rounding of q; and of its rate, from the rounding of v. */
static double rounding_of(const dal__event_search *w, int k, const double *x)
{
    const double *normal = dal__event_normal(w, k) + 1;
    double sum = 0.0;
    for (int i = 0; i < w->system->n; i++) sum += fabs(normal[i] * x[i]);
    return DBL_EPSILON * sum;
}

double dal__event_rounding(const dal__event_search *w, int k)
{
    return value_factor * rounding_of(w, k, w->run->persistent);
}

double dal__event_rate_rounding(const dal__event_search *w, int k)
{
    return rate_factor * rounding_of(w, k, w->run->persistent + w->system->n);
}

static dal_status roundings_of(void *user, dal_run *run, double *value, double *rate,
                               dal_error *error)
{
    const dal__event_search w = dal__event_search_begin(run, error);
    (void)user;
    DAL_TRY(dal__evaluate_event_normals(&w));
    for (int k = 0; k < w.system->events; k++) {
        value[k] = dal__event_rounding(&w, k);
        rate[k] = dal__event_rate_rounding(&w, k);
    }
    return DAL_STATUS_OK;
}

static int direction_of(void *user, const dal_run *run, int k)
{
    (void)user;
    return run->layout.system->event[k].direction;
}

/* ---- branches ---- */

/* How many steps ahead a branch may be that a step meets: methods evaluate F beyond its ends. */
static const double reach = 4.0;
/* In steps, how far apart an event and the change of a branch may be that are the same. */
static const double same = 1e-9;
/* What a branch is away from its change by rounding, in units of eps; where it may be near. */
static const double branch_factor = 64.0, near_size = 1e-9;

/* A point between two ends, one of which may be infinite. */
static double point_between(double lower, double upper)
{
    if (isinf(lower)) return upper - (1.0 + fabs(upper));
    if (isinf(upper)) return lower + (1.0 + fabs(lower));
    return lower + 0.5 * (upper - lower);
}

static void set_bounds(const dal__event_search *w, int j, double point)
{
    dal__held_branch *b = &w->held.branch[j];
    w->system->branches->bounds(w->system, j, point, &b->lower, &b->upper);
    w->held.point[j] = point_between(b->lower, b->upper);
}

/* The end that is next to x. */
static double nearest_end(const dal__held_branch *b, double x)
{
    return x - b->lower <= b->upper - x ? b->lower : b->upper;
}

static dal_status evaluate_branches(const dal__event_search *w, dal_callback *callback, int count,
                                    double *out)
{
    const dal_point at = dal__here(w->run);
    DAL_TRY(callback(w->system, &at, out));
    for (int j = 0; j < count; j++)
        if (!isfinite(out[j])) return DAL_STATUS_NOT_FINITE;
    return DAL_STATUS_OK;
}

static dal_status branch_values(const dal__event_search *w)
{
    const dal_branches *b = w->system->branches;
    return evaluate_branches(w, b->values, 2 * b->count, w->held.value);
}

static dal_status branch_rates(const dal__event_search *w, double *out)
{
    return evaluate_branches(w, w->system->branches->rates, w->system->branches->count, out);
}

/* Rates of the arguments with the present points; also notes the rates of events. */
static dal_status held_rates(const dal__event_search *w, double *out)
{
    const dal__held_places *held = &w->held;
    dal__run_hold(w->run, held->point);
    DAL_TRY(branch_rates(w, out));
    DAL_TRY(rates_of(NULL, w->run, held->event_rate, NULL));
    for (int k = 0; k < w->system->events; k++)
        held->event_scale[k] = fmax(held->event_scale[k], fabs(held->event_rate[k]));
    return DAL_STATUS_OK;
}

/* Holds branch j at an end, which no side leads away from. */
static dal_status hold_at_end(const dal__event_search *w, int j, double end)
{
    dal__held_branch *b = &w->held.branch[j];
    b->lower = -INFINITY;
    b->upper = INFINITY;
    w->held.point[j] = end;
    DAL_TRY(held_rates(w, w->held.rate));
    b->is_sliding = fabs(w->held.rate[j]) > branch_factor * DBL_EPSILON * b->scale;
    return DAL_STATUS_OK;
}

/* At an end the side of branch j is the one to which its rate there leads, if both do the one that
 * it is on. */
static dal_status choose_side(const dal__event_search *w, int j)
{
    dal__held_branch *b = &w->held.branch[j];
    const double s = w->held.value[j], h = w->run->layout.options.step;
    const double end = nearest_end(b, s), outwards = end == b->lower ? -w->toward : w->toward;
    const double point = w->held.point[j],
                 across = end == b->lower ? nextafter(end, -INFINITY) : end;
    DAL_TRY(held_rates(w, w->held.rate));
    const dal__held_branch own = *b;
    set_bounds(w, j, across);
    /* Where the formulas of the other side have no values here, it is not near. */
    const bool has_other = held_rates(w, w->held.across) == DAL_STATUS_OK;
    const double inner = w->held.rate[j], outer = has_other ? w->held.across[j] : 0.0;
    b->scale = fmax(fabs(inner), fabs(outer));
    b->is_at_end = fabs(s - end) <= branch_factor * DBL_EPSILON * (b->size + fabs(h) * b->scale);
    const bool stays = outwards * inner < 0.0;
    const bool leaves = outwards * outer > 0.0;
    if (b->is_at_end && !stays && leaves) return DAL_STATUS_OK;
    if (b->is_at_end && !stays) return hold_at_end(w, j, end);
    b->lower = own.lower;
    b->upper = own.upper;
    w->held.point[j] = point;
    return DAL_STATUS_OK;
}

/* The arguments here, and the ends between which they are. */
static dal_status place_branches(const dal__event_search *w)
{
    const int count = w->system->branches->count;
    DAL_TRY(branch_values(w));
    for (int j = 0; j < count; j++) {
        w->held.branch[j] = (dal__held_branch){.size = w->held.value[count + j]};
        set_bounds(w, j, w->held.value[j]);
    }
    return DAL_STATUS_OK;
}

/* Chooses at the present state where the branches are held, and holds them. */
static dal_status choose_branches(const dal__event_search *w)
{
    bool is_at_end = false;
    w->held.crossing->is_kept = false;
    for (int k = 0; k < w->system->events; k++) w->held.event_scale[k] = 0.0;
    DAL_TRY(place_branches(w));
    for (int j = 0; j < w->system->branches->count; j++) {
        DAL_TRY(choose_side(w, j));
        is_at_end = is_at_end || w->held.branch[j].is_at_end;
    }
    for (int k = 0; k < w->system->events && !is_at_end; k++) w->held.event_scale[k] = 0.0;
    dal__run_hold(w->run, w->held.point);
    return DAL_STATUS_OK;
}

/* How far inside of its ends a branch is, for the argument s: positive there, with simple zeros;
 * and its derivative. */
static double inside(const dal__held_branch *b, double s, double *slope)
{
    const bool has_lower = isfinite(b->lower), has_upper = isfinite(b->upper);
    const double above = s - b->lower, below = b->upper - s, length = b->upper - b->lower;
    *slope = has_lower && has_upper ? (below - above) / length : has_lower ? 1.0 : -1.0;
    if (has_lower && has_upper) return above * (below / length);
    if (!has_lower && !has_upper) return *slope = 0.0, 1.0;
    return has_lower ? above : below;
}

/* Whether a step from or to the present state, of these arguments, may meet an end. */
static bool may_meet_end(const dal__event_search *w)
{
    const int count = w->system->branches->count;
    const double h = w->run->layout.options.step;
    if (branch_rates(w, w->held.rate) != DAL_STATUS_OK) return true;
    for (int j = 0; j < count; j++) {
        const dal__held_branch *b = &w->held.branch[j];
        const double s = w->held.value[j], distance = fmin(s - b->lower, b->upper - s);
        if (distance <= reach * fabs(h * w->held.rate[j]) + near_size * b->size) return true;
    }
    return false;
}

/* Whether an evaluation of F in the free step may be beyond an end of a branch. */
static bool is_near(const dal__event_search *w)
{
    const bool is_long = w->run->layout.options.tolerance > 0.0;
    if (is_long || place_branches(w) != DAL_STATUS_OK || may_meet_end(w)) return true;
    dal__run_load(w->run, w->free->after);
    const bool is_near = branch_values(w) != DAL_STATUS_OK || may_meet_end(w);
    dal__run_load(w->run, w->free->before);
    return is_near;
}

/* ---- events and branches ---- */

static dal_status held_values_of(void *user, dal_run *run, double *out, dal_error *error)
{
    const dal__event_search w = dal__event_search_begin(run, error);
    double slope;
    DAL_TRY(values_of(user, run, out, error));
    DAL_TRY(branch_values(&w));
    for (int j = 0; j < w.system->branches->count; j++)
        out[w.system->events + j] = inside(&w.held.branch[j], w.held.value[j], &slope);
    return DAL_STATUS_OK;
}

static dal_status held_rates_of(void *user, dal_run *run, double *out, dal_error *error)
{
    const dal__event_search w = dal__event_search_begin(run, error);
    double slope;
    DAL_TRY(rates_of(user, run, out, error));
    DAL_TRY(branch_values(&w));
    DAL_TRY(branch_rates(&w, w.held.rate));
    for (int j = 0; j < w.system->branches->count; j++) {
        inside(&w.held.branch[j], w.held.value[j], &slope);
        out[w.system->events + j] = slope * w.held.rate[j];
    }
    return DAL_STATUS_OK;
}

static dal_status held_roundings_of(void *user, dal_run *run, double *value, double *rate,
                                    dal_error *error)
{
    const dal__event_search w = dal__event_search_begin(run, error);
    const double unit = branch_factor * DBL_EPSILON, h = fabs(run->layout.options.step);
    const int events = w.system->events;
    DAL_TRY(roundings_of(user, run, value, rate, error));
    for (int k = 0; k < events; k++) value[k] += unit * h * w.held.event_scale[k];
    for (int j = 0; j < w.system->branches->count; j++) {
        const dal__held_branch *b = &w.held.branch[j];
        value[events + j] = unit * (b->size + h * b->scale);
        rate[events + j] = unit * b->scale;
    }
    return DAL_STATUS_OK;
}

static int held_direction_of(void *user, const dal_run *run, int k)
{
    return k < run->layout.system->events ? direction_of(user, run, k) : -1;
}

/* ---- the search ---- */

static dal__zero_search *free_crossing(const dal_run *run, const dal__event_places *m)
{
    return (dal__zero_search *)(void *)(m->observed + dal__max_observables(&run->layout));
}

const dal__zero_search *dal__event_crossing(const dal_run *run)
{
    const dal__event_places m = dal__event_places_of(run);
    return run->has_search ? free_crossing(run, &m) : NULL;
}

dal__event_search dal__event_search_begin(dal_run *run, dal_error *error)
{
    const dal__layout *k = &run->layout;
    dal__functions functions = {.count = k->system->events,
                                .values = values_of,
                                .rates = rates_of,
                                .roundings = roundings_of,
                                .direction = direction_of};
    const dal__event_places m = dal__event_places_of(run);
    dal__zero_search *const free = free_crossing(run, &m);
    double *at = (double *)free + crossing_numbers();
    double *end = at + dal__crossing_numbers((size_t)k->system->events, run->stored);
    const dal__held_places held = held_places(k, run->stored, end);
    if (!run->has_search && functions.count > 0) {
        run->has_search = true;
        dal__crossing_init(free, run, &functions, at);
        functions = (dal__functions){.count = functions.count + branch_count(k),
                                     .values = held_values_of,
                                     .rates = held_rates_of,
                                     .roundings = held_roundings_of,
                                     .direction = held_direction_of};
        if (held.crossing)
            dal__crossing_init(held.crossing, run, &functions, end + crossing_numbers());
    }
    return (dal__event_search){.run = run,
                               .error = error,
                               .system = k->system,
                               .m = m,
                               .held = held,
                               .free = run->has_search ? free : NULL,
                               .crossing = run->has_search ? free : NULL,
                               .toward = copysign(1.0, k->options.step)};
}

dal_status dal__events_endless(const dal__event_search *w, int k)
{
    const char *name = dal__event_name(w->system, k);
    const double t = dal_run_time(w->run);
    if (w->m.count[k] == 0.0)
        return dal__fail(w->error, DAL_STATUS_EVENT,
                         "%s happens infinitely often from t = %.17g on", name, t);
    return dal__fail(w->error, DAL_STATUS_EVENT,
                     "%s happens infinitely often: number %lld is at t = %.17g, and the next ones "
                     "follow closer than can be resolved",
                     name, (long long)w->m.count[k], t);
}

/* Searches the next step, or a shorter one of size h; NaN: the result does not count. */
typedef dal_status search_function(const dal__event_search *w, double h, double *distance,
                                   dal_error *error);

/* Whether the run is where the last step ended, whose values are known there. */
static bool is_at_last_end(const dal__zero_search *c)
{
    const dal_run *run = c->run;
    const size_t width = run->stored / dal__saved_count(&run->layout), bytes = sizeof *c->after;
    const size_t state = dal__at_events(&run->layout) * width;
    const size_t parameters = run->layout.persistent * width;
    return c->is_begun && memcmp(run->storage, c->after, state * bytes) == 0 &&
           memcmp(run->storage + parameters, c->after + parameters,
                  (run->stored - parameters) * bytes) == 0;
}

static dal_status search_free(const dal__event_search *w, double h, double *distance,
                              dal_error *error)
{
    dal__zero_search *c = w->free;
    for (int k = 0; k < w->system->events; k++) c->zero[k].side = (dal__side)w->m.side[k];
    c->is_begun = is_at_last_end(c);
    DAL_TRY(dal__crossing_begin(c, h, error));
    return dal__crossing_next(c, distance);
}

/* Whether the step that was begun has the bits of the free one: then no branch has changed.  At an
 * end of a branch rounding may make them so. */
static bool is_as_free(const dal__event_search *w)
{
    const dal__zero_search *c = w->held.crossing;
    for (int j = 0; j < w->system->branches->count; j++)
        if (w->held.branch[j].is_at_end) return false;
    return c->h == w->free->h && !w->has_failed &&
           memcmp(c->after, w->free->after, w->run->stored * sizeof *c->after) == 0;
}

/* With the branches held as they are here.  An event counts that is not after the first change of a
 * branch, and so does a step without either. */
static dal_status search_held(const dal__event_search *w, double h, double *distance,
                              dal_error *error)
{
    dal__zero_search *c = w->held.crossing;
    const int events = w->system->events, count = c->functions.count;
    double change = INFINITY, event = INFINITY;
    for (int k = 0; k < events; k++) c->zero[k].side = (dal__side)w->m.side[k];
    for (int k = events; k < count; k++)
        c->zero[k].side = w->held.branch[k - events].is_at_end ? DAL__JUST_ABOVE : DAL__ABOVE;
    c->is_begun = false;
    *distance = NAN;
    DAL_TRY(dal__crossing_begin(c, h, error));
    if (is_as_free(w)) return DAL_STATUS_OK;
    DAL_TRY(dal__crossing_next(c, distance));
    for (int k = 0; k < events; k++) event = fmin(event, c->zero[k].s);
    for (int k = events; k < count; k++) change = fmin(change, c->zero[k].s);
    const double first = change + same * fabs(h) + dal__crossing_resolution(c);
    *distance = isfinite(change) && event > first ? NAN : event;
    return DAL_STATUS_OK;
}

/* The same.  Where the step fails, as beyond a wall, a shorter one may have an event. */
static dal_status search_next(const dal__event_search *w, search_function *search, double h,
                              double *distance, dal_error *reason)
{
    const dal_status status = search(w, h, distance, reason);
    double low = 0.0, high = h;
    bool found = status == DAL_STATUS_OK;
    for (int i = 0; i < MAX_HALVES && !found; i++) {
        const double middle = 0.5 * (low + high);
        dal_error ignored = {0};
        const dal_status shorter = search(w, middle, distance, &ignored);
        found = shorter == DAL_STATUS_OK && isfinite(*distance);
        *(shorter == DAL_STATUS_OK ? &low : &high) = middle;
    }
    return found ? DAL_STATUS_OK : status;
}

/* Searches a step of size h with the branches held, and whether the result counts. */
static bool repeat_held(const dal__event_search *w, double h, double *distance)
{
    dal_error ignored = {0};
    bool slides = false;
    dal_status status = choose_branches(w);
    for (int j = 0; j < w->system->branches->count && status == DAL_STATUS_OK; j++)
        slides = slides || w->held.branch[j].is_sliding;
    if (status == DAL_STATUS_OK && !slides)
        status = search_next(w, search_held, h, distance, &ignored);
    dal__run_hold(w->run, NULL);
    return status == DAL_STATUS_OK && !slides && !isnan(*distance);
}

dal_status dal__search_events(dal__event_search *w, double h, double *distance)
{
    dal__zero_search *const free = w->free, *const held = w->held.crossing;
    const long long unresolved = free->unresolved;
    const double first_unresolved = free->first_unresolved;
    dal_error reason = {0};
    double repeated;
    w->crossing = free;
    if (dal__crossing_has_kept(free, h, distance)) return DAL_STATUS_OK;
    if (held && dal__crossing_has_kept(held, h, distance)) return w->crossing = held, DAL_STATUS_OK;
    const dal_status status = search_next(w, search_free, h, distance, &reason);
    w->has_failed = status != DAL_STATUS_OK;
    if (held && (w->has_failed || is_near(w)) && repeat_held(w, h, &repeated)) {
        w->crossing = held;
        *distance = repeated;
        free->unresolved = unresolved + held->is_unresolved;
        free->first_unresolved =
            unresolved == 0 && held->is_unresolved ? dal_run_time(w->run) : first_unresolved;
    } else if (w->has_failed) {
        if (w->error) *w->error = reason;
        return status;
    }
    dal__crossing_keep(w->crossing, h, *distance);
    return DAL_STATUS_OK;
}

/* ---- holding ---- */

void dal__hold_as_searched(const dal__event_search *w)
{
    if (w->crossing == w->held.crossing) dal__run_hold(w->run, w->held.point);
}

void dal__let_go_as_searched(const dal__event_search *w)
{
    if (w->crossing == w->held.crossing) dal__run_hold(w->run, NULL);
}

void dal__hold_as_kept(dal_run *run)
{
    if (!run->layout.system->branches || !run->has_search) return;
    const dal__event_search w = dal__event_search_begin(run, NULL);
    if (dal__crossing_is_kept(w.held.crossing)) dal__run_hold(run, w.held.point);
}

bool dal__event_slides(const dal__event_search *w, int k)
{
    const dal__zero_search *c = w->crossing;
    for (int j = 0; c == w->held.crossing && j < w->system->branches->count; j++) {
        const double apart = fabs(c->zero[w->system->events + j].s - c->zero[k].s);
        if (w->held.branch[j].is_sliding && apart <= same * fabs(c->h)) return true;
    }
    return false;
}

dal_status dal__evaluate_event_rates(const dal__event_search *w)
{
    if (!w->held.crossing) return rates_of(NULL, w->run, w->m.rate, w->error);
    if (choose_branches(w) != DAL_STATUS_OK) dal__run_hold(w->run, NULL);
    const dal_status status = rates_of(NULL, w->run, w->m.rate, w->error);
    dal__run_hold(w->run, NULL);
    return status;
}
