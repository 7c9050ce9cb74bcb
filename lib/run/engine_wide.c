/* engine_wide.c - a step of one or several lanes as a transaction; see engine.h.
 *
 * After the integrator has stepped, the engine accepts or rejects lane by lane.  A lane is accepted
 * if its equations are solved, its state is finite, e and the guards keep their signs, and the rank
 * check holds: det(A1 B0) det(A0 B0) > 0 for all leading minors, with B = W^-1 A^T.  If a gradient
 * of a constraint turns by a right angle within one step, then G = A B was singular in between (or
 * the step is far too large).
 *
 * Several groups of lanes are stepped as one system of DAL_GROUPS times as many components.  Such
 * an integrator acts on each component alike (DAL_COMPONENTWISE).  Number i of lane l of group g is
 * lane l of num i*DAL_GROUPS + g. */
#include "kernel/groups.h"

#include "run/engine.h"
#include <dalembert_kernel.h>

/* ---- lanes, as bits and as masks ---- */

/* The lanes that are stepped together. */
enum { LANES = DAL_GROUPS * DAL_LANES };
/* Doubles in one number of all lanes. */
enum { WIDTH = DAL_GROUPS * (int)(sizeof(num) / sizeof(double)) };

/* Lanes of all groups. */
typedef struct lane_mask {
    dal_mask group[DAL_GROUPS];
} lane_mask;

static inline lane_mask mask_of(dal__lanes lanes)
{
    int64_t all[LANES];
    lane_mask mask;
    for (int i = 0; i < LANES; i++) all[i] = -(int64_t)(lanes >> i & 1);
    memcpy(&mask, all, sizeof mask);
    return mask;
}

static inline dal__lanes lanes_of(const lane_mask *mask)
{
    dal__lanes lanes = 0;
    for (int g = 0; g < DAL_GROUPS; g++) {
        if (!dal_any(mask->group[g])) continue;
        for (int i = 0; i < DAL_LANES; i++)
            lanes |= (dal__lanes)dal_mask_lane(mask->group[g], i) << (g * DAL_LANES + i);
    }
    return lanes;
}

/* ---- memory and callbacks ---- */

typedef struct engine {
    dal_step step; /* first, so that step->owner is also the engine */
    dal__layout layout;
    const dal_integrator *layer[DAL_LAYERS];
    dal_callback *call[DAL_EVAL_COUNT];
    num *persistent, *backup, *work;
    dal__failure *failure;
} engine;

static size_t bytes_of(size_t numbers) { return dal__align(numbers * DAL_GROUPS * sizeof(num)); }

/* Nums of the persistent state that an integrator may change; one that neither solves nor divides
 * changes y and r only. */
static size_t changing(const engine *e)
{
    const bool alone =
        !e->layout.lifted && e->layout.depth == 1 && e->layout.options.tolerance == 0.0;
    const bool plain = alone && (e->layer[0]->properties & DAL_COMPONENTWISE);
    return (plain ? dal__at(&e->layout, 0) : e->layout.persistent) * DAL_GROUPS;
}

/* Records the first evaluation that is not finite. */
static void trace(engine *e, dal_callback_code code, const dal_point *at, dal_status status,
                  const double *out)
{
    dal__failure *failure = e->failure;
    double sum = 0.0;
    for (int i = 0; i < dal__eval_size(&e->layout, code); i++) sum += out[i] - out[i];
    if (failure->not_finite || (sum == 0.0 && status == DAL_OK)) return;
    failure->not_finite = true;
    failure->status = status;
    failure->t = at->t;
    memcpy(failure->q, at->q, (size_t)e->layout.n * sizeof(double));
    memcpy(failure->v, at->v, (size_t)e->layout.nw * sizeof(double));
}

/* Fills the output of a callback. */
static void fill(const engine *e, dal_callback_code code, double value, num *out)
{
    const int size = dal__eval_size(&e->layout, code) * DAL_GROUPS;
    for (int i = 0; i < size; i++) out[i] = dal_num(value);
}

static void eval_callback(dal_step *s, dal_callback_code code, double t, const num *q, const num *v,
                          const num *pi, num *out)
{
    engine *e = s->owner;
    dal_callback *const call = e->call[code];
    if (!call) { /* only the gauge may be missing */
        fill(e, code, 0.0, out);
        return;
    }
    const dal_point at = {t, (const double *)q, (const double *)v, (const double *)pi,
                          (double *)e->work};
    const dal_status status = call(e->layout.system, &at, (double *)out);
    if (status != DAL_OK) fill(e, code, NAN, out);
    if (LANES == 1 && e->failure) trace(e, code, &at, status, (const double *)out);
}

static size_t engine_bytes(const dal__layout *k)
{
    return dal__align(sizeof(engine)) + 2 * bytes_of(k->persistent) + bytes_of(k->workspace) +
           bytes_of(k->scratch);
}

static num *allocate(char **at, size_t count)
{
    num *p = (num *)(void *)*at;
    *at += bytes_of(count);
    return p;
}

/* Number `place` behind y and r. */
static num *persistent_at(const engine *e, int place)
{
    return e->persistent + dal__at(&e->layout, place) * DAL_GROUPS;
}

/* The state of the method, one member after the other. */
static void place_method_state(engine *e)
{
    num *at = e->step.method_state = persistent_at(e, DAL__METHOD_STATE);
#define MEMBER(member, count)                                                                      \
    e->step.member = at;                                                                           \
    at += DAL__COUNT_##count(&e->layout) * DAL_GROUPS;
    DAL__METHOD_STATE_LIST(MEMBER)
#undef MEMBER
    e->step.method_state_count = (int)(at - e->step.method_state);
    e->step.derivatives_kept = e->layout.derivatives;
}

/* What is the same in every step. */
static void prepare_step(engine *e)
{
    const dal__layout *k = &e->layout;
    dal_step *s = &e->step;
    *s = (dal_step){.m = k->m, .lifted = k->lifted, .n = k->n * DAL_GROUPS};
    s->nw = k->nw * DAL_GROUPS;
    s->dim = k->dim * DAL_GROUPS;
    s->y = e->persistent;
    s->r = e->persistent + s->dim;
    s->solver = k->options.solver;
    s->iterations = k->options.iterations;
    s->solver_tolerance = k->options.solver_tolerance;
    s->extra_iterations = k->options.extra_iterations;
    s->plain = k->options.sums == DAL_SUMS_PLAIN;
    s->has_jacobian = k->system->call.jacobian != NULL;
    s->properties = k->system->properties;
    s->tolerance = k->options.tolerance;
    s->capacity = k->scratch * DAL_GROUPS;
    place_method_state(e);
    s->layer = e->layer;
    s->eval = eval_callback;
    s->owner = e;
}

static void *place_engine(const dal__layout *k, void *memory, double **persistent, double **work)
{
    char *at = memory;
    engine *e = memory;
    at += dal__align(sizeof *e);
    memset(memory, 0, engine_bytes(k) - bytes_of(k->scratch));
    e->layout = *k;
    for (int i = 0; i < k->depth; i++)
        e->layer[i] = dal__integrator_wide(k->method.layer[i], DAL_WIDE(DAL__VARIANT));
    const dal_system *system = k->system;
    const dal_callbacks *c = LANES == 4   ? system->wide4
                             : LANES == 8 ? system->wide8
                                          : &system->call;
#define CALLBACK(code, member) e->call[DAL_EVAL_##code] = c->member;
    DAL__CALLBACK_LIST(CALLBACK)
#undef CALLBACK
    e->persistent = allocate(&at, k->persistent);
    e->backup = allocate(&at, k->persistent);
    e->work = allocate(&at, k->workspace);
    prepare_step(e);
    e->step.scratch = allocate(&at, k->scratch);
    *persistent = (double *)e->persistent;
    *work = (double *)e->work;
    return e;
}

static void trace_engine(void *engine_, dal__failure *failure)
{
    ((engine *)engine_)->failure = failure;
}

static dal_status eval_engine(void *engine_, int code, double t, const double *state, double *out)
{
    engine *e = engine_;
    const int n = e->layout.n;
    if (!e->call[code]) return DAL_UNSUPPORTED;
    const dal_point at = {t, state, state + n * WIDTH, state + (3 * n + 1) * WIDTH,
                          (double *)e->work};
    return e->call[code](e->layout.system, &at, out);
}

/* ---- checks of a step, group by group ---- */

/* 0, or NaN where some component of a group is not finite. */
static num sum_nonfinite(const engine *e, int group, int first, int count)
{
    const num *y = e->persistent + first * DAL_GROUPS + group;
    num sum = dal_num(0.0);
    if (DAL_GROUPS == 1) return dal_nonfinite(y, count);
    for (int i = 0; i < count * DAL_GROUPS; i += DAL_GROUPS) sum += y[i] - y[i];
    return sum;
}

/* Lanes in which every component of the state is finite; 1/e stands for e. */
static dal_mask finite(const engine *e, int group)
{
    const int dim = e->layout.dim, at_e = 2 * e->layout.n;
    if (!e->layout.lifted) return dal_equal(sum_nonfinite(e, group, 0, dim), dal_num(0.0));
    const num w = 1.0 / e->persistent[at_e * DAL_GROUPS + group];
    return dal_equal(sum_nonfinite(e, group, 0, at_e) + (w - w) +
                         sum_nonfinite(e, group, at_e + 1, dim - at_e - 1),
                     dal_num(0.0));
}

static dal_mask check_gauge(const engine *e, int group)
{
    if (!e->layout.lifted) return dal_all();
    const int i = 2 * e->layout.n * DAL_GROUPS + group;
    return dal_less(dal_num(0.0), 1.0 / e->backup[i] * e->persistent[i]) |
           ~dal_finite(e->persistent[i]);
}

/* Records the first number that failed in lane 0. */
static void record(int *which, dal_mask good, int number)
{
    if (!*which && !dal_mask_lane(good, 0)) *which = number;
}

/* Evaluates a callback before and after the step. */
static void eval_both_ends(engine *e, dal_callback_code code, num *before, num *after)
{
    dal_step *s = &e->step;
    eval_callback(s, code, s->t - s->h, e->backup, e->backup + s->n, NULL, before);
    eval_callback(s, code, s->t, e->persistent, e->persistent + s->n, NULL, after);
}

static lane_mask check_guards(engine *e)
{
    const int count = e->layout.system->guards * DAL_GROUPS;
    dal_step *s = &e->step;
    lane_mask good = mask_of(~(dal__lanes)0);
    num *before = dal_scratch(s, count), *after = dal_scratch(s, count);
    eval_both_ends(e, DAL_EVAL_GUARDS, before, after);
    for (int i = 0; i < count; i++) {
        good.group[i % DAL_GROUPS] &= dal_less(dal_num(0.0), before[i] * after[i]);
        if (e->failure) record(&e->failure->guard, good.group[0], i + 1);
    }
    return good;
}

/* Gathers the numbers of one group. */
static void gather_group(const num *from, int group, int count, num *to)
{
    for (int i = 0; i < count; i++) to[i] = from[i * DAL_GROUPS + group];
}

/* The rank check of a group; c0, c1: D, A, B before and after. */
static dal_mask check_group_rank(engine *e, const num *c0, const num *c1)
{
    const int m = e->layout.m, n = e->layout.n;
    dal_step *s = &e->step;
    dal_mask good = dal_all();
    num *g0 = dal_scratch(s, m * m), *g1 = dal_scratch(s, m * m);
    dal_gram(c0 + m, c0 + m + m * n, m, n, g0);
    dal_gram(c1 + m, c0 + m + m * n, m, n, g1);
    for (int k = 0; k < m; k++) {
        good &= dal_less(dal_num(0.0), dal_eliminate(g0, m, k) / dal_eliminate(g1, m, k));
        if (e->failure) record(&e->failure->constraint, good, k + 1);
    }
    return good;
}

static lane_mask check_rank(engine *e)
{
    const int m = e->layout.m, n = e->layout.n, size = m + 2 * m * n;
    dal_step *s = &e->step;
    lane_mask good;
    num *before = dal_scratch(s, size * DAL_GROUPS), *after = dal_scratch(s, size * DAL_GROUPS);
    num *c0 = dal_scratch(s, size), *c1 = dal_scratch(s, size);
    eval_both_ends(e, DAL_EVAL_CONSTRAINT, before, after);
    for (int g = 0; g < DAL_GROUPS; g++) {
        const size_t mark = s->used;
        gather_group(before, g, size, c0);
        gather_group(after, g, size, c1);
        good.group[g] = check_group_rank(e, c0, c1);
        s->used = mark;
    }
    return good;
}

/* ---- a step ---- */

/* Removes the lanes that are not good from `left`, sets their reason, and returns them. */
static dal__lanes reject(lane_mask *left, lane_mask good, dal_status status, dal_status *reason)
{
    dal_mask any = ~dal_all();
    for (int g = 0; g < DAL_GROUPS; g++) any |= left->group[g] & ~good.group[g];
    if (!dal_any(any)) return 0;
    lane_mask bad;
    for (int g = 0; g < DAL_GROUPS; g++) {
        bad.group[g] = left->group[g] & ~good.group[g];
        left->group[g] &= good.group[g];
    }
    const dal__lanes lanes = lanes_of(&bad);
    for (int i = 0; i < LANES; i++)
        if (lanes >> i & 1) reason[i] = status;
    return lanes;
}

/* The checks that do not evaluate the system. */
static dal__lanes check_state(const engine *e, lane_mask *left, dal_status status,
                              dal_status *reason)
{
    lane_mask solved, gauge, sound;
    dal__lanes failed = 0;
    for (int g = 0; g < DAL_GROUPS; g++) {
        solved.group[g] = ~e->step.unconverged[0];
        gauge.group[g] = check_gauge(e, g);
        sound.group[g] = finite(e, g);
    }
    if (status != DAL_OK && status != DAL_NOT_CONVERGED)
        failed = reject(left, mask_of(0), status, reason);
    if (dal_any(e->step.unconverged[0])) failed |= reject(left, solved, DAL_NOT_CONVERGED, reason);
    if (e->layout.lifted) failed |= reject(left, gauge, DAL_GAUGE, reason);
    return failed | reject(left, sound, DAL_NOT_FINITE, reason);
}

/* Removes the lanes that failed from `left`, the alive ones, and returns them. */
static dal__lanes check_step(engine *e, lane_mask *left, dal__lanes alive, dal_status status,
                             dal_status *reason)
{
    const dal_system *system = e->layout.system;
    dal__lanes failed = check_state(e, left, status, reason);
    if (failed == alive) return failed;
    e->step.used = 0;
    if (system->guards > 0) failed |= reject(left, check_guards(e), DAL_SINGULAR, reason);
    if ((system->properties & DAL_D_RANK_CHECKED) && e->call[DAL_EVAL_CONSTRAINT])
        failed |= reject(left, check_rank(e), DAL_SINGULAR, reason);
    return failed;
}

/* Advances clock (compensated) and counters of the lanes that moved. */
static void advance_clock(engine *e, double h, const lane_mask *moved)
{
    num *time = persistent_at(e, DAL__TIME), *error = persistent_at(e, DAL__TIME_ERROR);
    num *steps = persistent_at(e, DAL__STEPS), *evaluations = persistent_at(e, DAL__EVALUATIONS);
    for (int g = 0; g < DAL_GROUPS; g++) {
        const dal_mask m = moved->group[g];
        const num a = time[g], b = h + error[g], sum = a + b, c = sum - a;
        error[g] = dal_select(m, (a - (sum - c)) + (b - c), error[g]);
        time[g] = dal_select(m, sum, a);
        steps[g] = dal_select(m, steps[g] + 1.0, steps[g]);
        evaluations[g] =
            dal_select(m, evaluations[g] + (double)e->step.evaluations, evaluations[g]);
    }
}

/* Restores the lanes that did not move. */
static void restore(engine *e, const lane_mask *moved)
{
    for (size_t g = 0; g < DAL_GROUPS; g++) {
        if (!dal_any(~moved->group[g])) continue;
        for (size_t i = g; i < changing(e); i += DAL_GROUPS)
            e->persistent[i] = dal_select(moved->group[g], e->persistent[i], e->backup[i]);
    }
}

static void begin_step(engine *e, double h, dal__lanes alive, const lane_mask *lanes)
{
    dal_step *s = &e->step;
    memcpy(e->backup, e->persistent, changing(e) * sizeof(num));
    int first = 0; /* alive lane; its time is that of all of them */
    while (first < LANES - 1 && !(alive >> first & 1)) first++;
    s->t = dal_lane(persistent_at(e, DAL__TIME)[first / DAL_LANES], first % DAL_LANES);
    s->h = h;
    s->alive[0] = DAL_GROUPS > 1 ? dal_all() : lanes->group[0];
    s->unconverged[0] = ~dal_all();
    s->used = 0;
    s->exhausted = 0;
    s->evaluations = 0;
    s->depth = e->layout.depth - 1;
}

static dal__lanes step_engine(void *engine_, double h, dal__lanes alive, dal_status *reason)
{
    engine *e = engine_;
    lane_mask moved = mask_of(alive);
    begin_step(e, h, alive, &moved);
    dal_status status = e->layer[e->step.depth]->step(&e->step);
    if (e->step.exhausted) status = DAL_MEMORY;
    if (e->failure) {
        e->failure->reached = e->step.t;
        e->failure->substep = dal_lane(e->step.substep[0], 0);
    }
    const dal__lanes failed = check_step(e, &moved, alive, status, reason);
    advance_clock(e, h, &moved);
    const bool moved_others =
        DAL_GROUPS > 1 && alive != ~(dal__lanes)0; /* lanes that are not alive moved */
    if (failed || moved_others) restore(e, &moved);
    return failed;
}

const dal__engine DAL_WIDE(dal__engine) = {.bytes = engine_bytes,
                                           .place = place_engine,
                                           .step = step_engine,
                                           .eval = eval_engine,
                                           .trace = trace_engine};
