/* engine_wide.c - a step of one or several lanes as a transaction; see engine.h.
 *
 * After the integrator has stepped, the engine accepts or rejects lane by lane, see
 * kernel/acceptance.h. */
#include "core/sizes.h"
#include "kernel/acceptance.h"
#include "kernel/observables.h"
#include "run/engine.h"
#include "run/lane_bits.h"
#include <dalembert_kernel.h>

/* ---- memory and callbacks ---- */

typedef struct engine {
    dal_step step; /* first, so that step->owner is also the engine */
    dal__layout layout;
    const dal_integrator *layer[DAL_LAYERS];
    dal_callback *call[DAL_EVAL_COUNT];
    num *persistent, *backup, *work;
    const num *saved_pivots; /* in work, by the last evaluation of F */
    dal__failure *failure;
    /* Dense output, where a tolerance is given. */
    const dal_integrator *dense_layer[DAL_LAYERS]; /* the innermost evaluates the polynomial */
    dal_dense dense;
    double dense_h;             /* size of the step that was divided last */
    num *dense_from, *dense_to; /* what a checkpoint holds, before that step and after its last
                                   substep so far */
} engine;

static size_t bytes_of(size_t numbers) { return dal__align(numbers * sizeof(num)); }

/* Nums of the persistent state that a step may change; one that neither solves nor divides nor
 * compares pivots changes y and r only. */
static size_t changing(const engine *e)
{
    const bool alone = !e->layout.lifted && e->layout.depth == 1 &&
                       e->layout.options.tolerance == 0.0 && e->layout.pivots == 0;
    const bool plain = alone && (e->layer[0]->properties & DAL_COMPONENTWISE);
    return plain ? dal__at(&e->layout, 0) : e->layout.persistent;
}

/* Records the first evaluation that is not finite. */
static void trace(engine *e, dal_callback_code code, const dal_point *at, dal_status status,
                  const double *out)
{
    dal__failure *failure = e->failure;
    double sum = 0.0;
    for (int i = 0; i < dal__eval_size(&e->layout, code); i++) sum += out[i] - out[i];
    if (failure->not_finite || (sum == 0.0 && status == DAL_STATUS_OK)) return;
    failure->not_finite = true;
    failure->status = status;
    failure->t = at->t;
    memcpy(failure->q, at->q, (size_t)e->layout.n * sizeof(double));
    memcpy(failure->v, at->v, (size_t)e->layout.nw * sizeof(double));
}

/* Fills the output of a callback. */
static void fill(const engine *e, dal_callback_code code, double value, num *out)
{
    const int size = dal__eval_size(&e->layout, code);
    for (int i = 0; i < size; i++) out[i] = dal_num(value);
}

/* Copies the pivots of the first evaluation of F in a step. */
static void keep_pivots(engine *e)
{
    dal_step *s = &e->step;
    memcpy(s->pivots, e->saved_pivots, (size_t)s->pivot_count * sizeof(num));
    s->pivots_known[0] = true;
}

/* y = R l with A R l = l of before, for the rows of A from `first` on; D, A, R begin blocks. */
static void solve_by_blocks(dal_step *s, const num *blocks, int first, num *l, num *y)
{
    const int n = DAL_N(s), m = DAL_M(s), rows = m - first;
    DAL__MARK(s);
    DAL_VECTOR(s, R, n * rows);
    DAL_VECTOR(s, g, DAL_SQUARE_M(s));
    for (int k = 0; k < n * rows; k++) R[k] = blocks[m + m * n + k / rows * m + first + k % rows];
    dal_gram(blocks + m + first * n, R, rows, n, g);
    dal_eliminate_in_units(g, l, rows, DAL_LEVELS(s) ? DAL_LEVELS(s) + first : NULL, rows);
    dal_multiply(R, n, rows, l, y);
    DAL__RELEASE(s);
}

/* What DAL_EVAL_POSITION gives for c; without c, what DAL_EVAL_CORRECTION gives, of all D. */
static void by_constraint(dal_step *s, double t, const num *q, const num *v, const num *c, num *y)
{
    const int first = c ? DAL_M(s) - DAL_HOLONOMIC(s) : 0, rows = DAL_M(s) - first;
    DAL__MARK(s);
    DAL_VECTOR(s, out, DAL_CONSTRAINT_SIZE(s));
    DAL_VECTOR(s, l, DAL_M(s));
    dal_eval(s, DAL_EVAL_CONSTRAINT, t, q, v, NULL, out);
    for (int i = 0; i < rows; i++) l[i] = c ? c[first + i] : -out[i];
    solve_by_blocks(s, out, first, l, y);
    for (int i = 0; c && i < rows; i++) y[DAL_N(s) + i] = l[i];
    DAL__RELEASE(s);
}

/* D, A, R at a point, and beta W^-1 b, from blocks or, without them, from the constraint alone. */
static const num *find_blocks(dal_step *s, double t, const num *q, const num *v, num beta,
                              num *blocks)
{
    const engine *e = s->owner;
    num *const a = blocks + dal_blocks_a(s);
    if (e->call[DAL_EVAL_BLOCKS]) {
        dal_eval(s, DAL_EVAL_BLOCKS, t, q, v, NULL, blocks);
        DAL_EACH(i, DAL_N(s)) a[i] = beta * a[i];
    } else {
        dal_eval(s, DAL_EVAL_CONSTRAINT, t, q, v, NULL, blocks);
        DAL_EACH(i, DAL_N(s)) a[i] = dal_num(0.0);
    }
    return a;
}

/* What DAL_EVAL_REACTION gives, y = beta a + R l. */
static void react_by_blocks(dal_step *s, double t, const num *q, const num *v, const num *l, num *y)
{
    const int n = DAL_N(s), m = DAL_M(s);
    DAL__MARK(s);
    DAL_VECTOR(s, blocks, DAL_BLOCKS_SIZE(s));
    const num *a = find_blocks(s, t, q, v, l[m], blocks);
    dal_multiply(blocks + dal_blocks_B(s), n, m, l, y);
    DAL_EACH(i, n) y[i] += a[i];
    DAL__RELEASE(s);
}

/* What DAL_EVAL_ENFORCEMENT gives: the same with A y = A pi + c. */
static void enforce_by_blocks(dal_step *s, double t, const num *q, const num *v, const num *pi,
                              num *y)
{
    const int n = DAL_N(s), m = DAL_M(s);
    num *const l = y + n;
    DAL__MARK(s);
    DAL_VECTOR(s, blocks, DAL_BLOCKS_SIZE(s));
    const num *a = find_blocks(s, t, q, v, pi[n + m], blocks);
    DAL_EACH(i, n) y[i] = pi[i] - a[i];
    dal_multiply(blocks + dal_blocks_A(s), m, n, y, l);
    DAL_EACH(i, m) l[i] += pi[n + i];
    solve_by_blocks(s, blocks, 0, l, y);
    DAL_EACH(i, n) y[i] += a[i];
    DAL__RELEASE(s);
}

/* D alone. */
static void value_by_constraint(dal_step *s, double t, const num *q, const num *v, num *D)
{
    DAL__MARK(s);
    DAL_VECTOR(s, out, DAL_CONSTRAINT_SIZE(s));
    dal_eval(s, DAL_EVAL_CONSTRAINT, t, q, v, NULL, out);
    DAL_EACH(i, DAL_M(s)) D[i] = out[i];
    DAL__RELEASE(s);
}

/* The output of a callback that a system does not have, by others. */
static void eval_missing(dal_step *s, dal_callback_code code, double t, const num *q, const num *v,
                         const num *pi, num *out)
{
    switch (code) {
    case DAL_EVAL_CORRECTION:
        by_constraint(s, t, q, v, NULL, out);
        break;
    case DAL_EVAL_ENFORCEMENT:
        enforce_by_blocks(s, t, q, v, pi, out);
        break;
    case DAL_EVAL_REACTION:
        react_by_blocks(s, t, q, v, pi, out);
        break;
    case DAL_EVAL_CONSTRAINT_VALUE:
        value_by_constraint(s, t, q, v, out);
        break;
    case DAL_EVAL_POSITION:
        by_constraint(s, t, q, v, pi, out);
        break;
    default: /* the gauge, which is 0 */
        fill(s->owner, code, 0.0, out);
    }
}

static void eval_callback(dal_step *s, dal_callback_code code, double t, const num *q, const num *v,
                          const num *pi, num *out)
{
    engine *e = s->owner;
    dal_callback *const call = e->call[code];
    if (DAL_RARELY(!call)) {
        eval_missing(s, code, t, q, v, pi, out);
        return;
    }
    const dal_point at = {
        .t = t,
        .q = (const double *)q,
        .v = (const double *)v,
        .pi = (const double *)pi,
        .work = (double *)e->work,
#if DAL_HAS_TIMES
        .times = s->has_times ? (const double *)&s->times : NULL
#endif
    };
    const dal_status status = call(e->layout.system, &at, (double *)out);
    if (status != DAL_STATUS_OK) fill(e, code, NAN, out);
    if (DAL_LANES == 1 && e->failure) trace(e, code, &at, status, (const double *)out);
    if (DAL_RARELY(!s->pivots_known[0]) && dal_leaves_pivots(code)) keep_pivots(e);
}

static void eval_series(dal_step *s, int k, int stride, const num *in, num *memory, num *out)
{
    engine *e = s->owner;
    const dal__layout *layout = &e->layout;
    const dal_series *series = layout->system->series;
    dal_series_callback *const call = DAL_LANES == 4   ? series->wide4
                                      : DAL_LANES == 8 ? series->wide8
                                                       : series->call;
    const dal_status status = call(layout->system, layout->lifted, k, stride, (const double *)in,
                                   (double *)e->work, (double *)memory, (double *)out);
    if (status != DAL_STATUS_OK) fill(e, DAL_EVAL_FIELD, NAN, out);
    if (DAL_RARELY(!s->pivots_known[0])) keep_pivots(e);
    if (DAL_LANES > 1 || k > 0 || !e->failure) return;
    const double *first = (const double *)in;
    const dal_point at = {
        .t = first[0], .q = first + 1, .v = first + 1 + layout->n, .work = (double *)e->work};
    trace(e, DAL_EVAL_FIELD, &at, status, (const double *)out);
}

static bool has_dense(const dal__layout *k) { return DAL_LANES == 1 && k->options.tolerance > 0.0; }

/* y, r, rate of a dal_dense. */
static size_t dense_count(const dal__layout *k) { return (2 + DAL_DENSE_TERMS) * (size_t)k->dim; }

static size_t engine_bytes(const dal__layout *k)
{
    const size_t dense = 2 * bytes_of(dal__saved_count(k)) + bytes_of(dense_count(k));
    return dal__align(sizeof(engine)) + bytes_of(k->persistent + k->workspace) +
           bytes_of(k->persistent) + bytes_of((size_t)k->pivots) + (has_dense(k) ? dense : 0) +
           bytes_of(k->scratch);
}

static num *allocate(char **at, size_t count)
{
    num *p = (num *)(void *)*at;
    *at += bytes_of(count);
    return p;
}

/* Number `place` after y and r. */
static num *persistent_at(const engine *e, int place)
{
    return e->persistent + dal__at(&e->layout, place);
}

/* The state of the method, one member after the other. */
static void place_method_state(engine *e)
{
    num *at = e->step.method_state = persistent_at(e, DAL__CLOCK_SIZE);
#define MEMBER(member, count)                                                                      \
    e->step.member = at;                                                                           \
    at += DAL__COUNT_##count(&e->layout);
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
    *s = (dal_step){.n = k->n, .nw = k->nw, .m = k->m, .dim = k->dim, .lifted = k->lifted};
    s->holonomic = k->system->holonomic;
    s->effort = k->lifted && k->system->call.effort;
    s->gauge = k->lifted && k->system->call.gauge_gradient;
    s->y = e->persistent;
    s->r = e->persistent + s->dim;
    s->solver = k->options.solver;
    s->iterations = k->options.iterations;
    s->solver_tolerance = k->options.solver_tolerance;
    s->extra_iterations = k->options.extra_iterations;
    s->plain = k->options.sums == DAL_SUMS_PLAIN;
    s->has_jacobian = k->system->call.jacobian != NULL;
    s->field_operations = k->field_operations;
    s->jacobian_operations = k->jacobian_operations;
    s->properties = k->system->properties;
    s->guards = k->system->guards;
    s->rank_checked = dal__checks_rank(k->system);
    s->rank_by_factors = dal__checks_rank_by_factors(k);
    s->pivot_count = k->pivots;
    s->tolerance = k->options.tolerance;
    s->units = dal__units(k, DAL__UNITS_OF_STATE);
    s->speeds = dal__units(k, DAL__UNITS_OF_SPEEDS);
    s->levels = dal__units(k, DAL__UNITS_OF_LEVELS);
    s->capacity = k->scratch;
    place_method_state(e);
    s->layer = e->layer;
    s->eval = eval_callback;
    s->series = eval_series;
    s->series_count = k->system->series ? (int)k->system->series->size[k->lifted] : 0;
    s->taylor_order = k->taylor_order;
    s->tolerance_root = k->tolerance_root;
    s->unit_of_time = dal__unit_of_time(k->system);
    s->owner = e;
}

/* In place of the innermost method: the state after s->h by the polynomial of its substep. */
static dal_status evaluate_polynomial(dal_step *s)
{
    const engine *e = s->owner;
    const dal_dense *d = &e->dense;
    const num size = dal_num(fabs(s->h)) - d->from;
    DAL_VECTOR(s, rate, DAL_DIM(s));
    dal_dense_rate(d, s->dim, size / d->size, rate);
    DAL_EACH(i, s->dim) s->y[i] = d->y[i];
    DAL_EACH(i, s->dim) s->r[i] = d->r[i];
    dal_update_lanes(s, s->h < 0.0 ? -size : size, rate);
    s->t += s->h;
    return DAL_STATUS_OK;
}
static const dal_integrator polynomial = {.step = evaluate_polynomial};

static void place_dense(engine *e, char **at)
{
    const size_t dim = (size_t)e->layout.dim;
    e->dense_from = allocate(at, dal__saved_count(&e->layout));
    e->dense_to = allocate(at, dal__saved_count(&e->layout));
    e->dense.y = allocate(at, dense_count(&e->layout));
    e->dense.r = e->dense.y + dim;
    e->dense.rate = e->dense.r + dim;
    memcpy(e->dense_layer, e->layer, sizeof e->layer);
    e->dense_layer[0] = &polynomial;
}

static void *place_engine(const dal__layout *k, void *memory, double **persistent, double **work,
                          double **scratch)
{
    char *at = memory;
    engine *e = memory;
    at += dal__align(sizeof *e);
    memset(memory, 0, engine_bytes(k) - bytes_of(k->scratch));
    e->layout = *k;
    for (int i = 0; i < k->depth; i++)
        e->layer[i] = dal__integrator_wide(k->method.layer[i], DAL_WIDE(DAL__VARIANT));
    const dal_system *system = k->system;
    const dal_callbacks *c = DAL_LANES == 4   ? system->wide4
                             : DAL_LANES == 8 ? system->wide8
                                              : &system->call;
#define CALLBACK(code, member, ...) e->call[DAL_EVAL_##code] = c->member;
    DAL_CALLBACK_LIST(CALLBACK)
#undef CALLBACK
    e->persistent = allocate(&at, k->persistent + k->workspace);
    e->work = e->persistent + k->persistent;
    e->saved_pivots = e->work + k->workspace - k->pivots;
    e->backup = allocate(&at, k->persistent);
    prepare_step(e);
    e->step.pivots = allocate(&at, (size_t)k->pivots);
    if (has_dense(k)) place_dense(e, &at);
    e->step.scratch = allocate(&at, k->scratch);
    *persistent = (double *)e->persistent;
    *work = (double *)e->work;
    if (scratch) *scratch = (double *)e->step.scratch;
    return e;
}

static void trace_engine(void *engine_, dal__failure *failure)
{
    ((engine *)engine_)->failure = failure;
}

static dal_status eval_engine(void *engine_, int code, double t, const double *state, double *out)
{
    engine *e = engine_;
    const int n = e->layout.n, width = (int)(sizeof(num) / sizeof(double));
    if (!e->call[code]) return DAL_STATUS_UNSUPPORTED;
    const dal_point at = {.t = t,
                          .q = state,
                          .v = state + n * width,
                          .pi = state + (code == DAL_EVAL_GAUGE ? 2 * n : 3 * n + 1) * width,
                          .work = (double *)e->work};
    return e->call[code](e->layout.system, &at, out);
}

/* ---- observables ---- */

#if DAL_LANES == 1
static void observe_lift(engine *e, double t, num *out)
{
    const num *y = e->persistent;
    const int n = e->layout.n;
    num *f = out + 4, *effort = f + e->layout.nw, mu;
    const num *pi = y + 3 * n + 1;
    eval_callback(&e->step, DAL_EVAL_FIELD, t, y, y + n, NULL, f);
    eval_callback(&e->step, DAL_EVAL_GAUGE, t, y, y + n, y + 2 * n, &mu);
    if (e->step.effort) eval_callback(&e->step, DAL_EVAL_EFFORT, t, y, y + n, pi, effort);
    dal_lift_observables(y, n, f, e->step.effort ? effort : pi, mu, out);
}

/* The multipliers of the method's last step; before the first the multipliers of F, which `values`
 * begins with. */
static void observe_multipliers(const engine *e, num *values)
{
    const dal_mask known = dal_less(dal_num(0.5), *e->step.has_multiplier);
    DAL_EACH(a, e->layout.multiplier)
        values[a] = dal_select(known, e->step.multiplier[a], values[a]);
}

static dal_status observe_engine(void *engine_, bool exact_known, double *out)
{
    engine *e = engine_;
    const dal_system *system = e->layout.system;
    const num *q = e->persistent;
    const bool changed = e->persistent[dal__at_changed(&e->layout)] != 0.0;
    num *const scratch = e->step.scratch;
    const dal_point at = {.t = (double)*persistent_at(e, DAL__TIME),
                          .q = (const double *)q,
                          .v = (const double *)(q + e->layout.n),
                          .work = (double *)e->work};
    dal_callback *const formulas[] = {[DAL__OBSERVE_D] = system->constraints,
                                      [DAL__OBSERVE_E] = system->energy,
                                      [DAL__OBSERVE_INVARIANTS] = system->invariant_values,
                                      [DAL__OBSERVE_REACTIONS] = system->reactions,
                                      [DAL__OBSERVE_MULTIPLIERS] = system->reactions,
                                      [DAL__OBSERVE_HOLONOMIC] = system->call.holonomic,
                                      [DAL__OBSERVE_ERROR] = system->exact};
    for (int kind = 0; kind < DAL__OBSERVABLE_KINDS; kind++) {
        const int count = dal__observable_count(&e->layout, kind, exact_known);
        if (count == 0) continue;
        num *values = scratch;
        dal_status status = DAL_STATUS_OK;
        if (kind == DAL__OBSERVE_LIFT)
            observe_lift(e, at.t, values);
        else
            status = formulas[kind](system, &at, (double *)values);
        if (status != DAL_STATUS_OK) return status;
        if (kind == DAL__OBSERVE_REACTIONS) {
            values += e->layout.m * (1 + e->layout.n);
            dal_reaction_observables(scratch, e->layout.m, e->layout.n, values);
        }
        if (kind == DAL__OBSERVE_MULTIPLIERS) observe_multipliers(e, values);
        if (kind == DAL__OBSERVE_ERROR)
            values[0] = changed ? dal_num(NAN) : dal_max_distance(values, q, e->layout.n);
        for (int i = 0; i < count; i++) *out++ = (double)values[i] + 0.0; /* no -0 */
    }
    return DAL_STATUS_OK;
}
#else
#define observe_engine NULL
#endif

/* ---- a step ---- */

/* Removes the lanes that fail from `alive`, and returns them. */
static dal__lanes check_step(engine *e, dal_mask *alive, dal_status status, dal_status *reason)
{
    dal_step *s = &e->step;
    dal__failure *failure = e->failure;
    const dal_mask before = *alive;
    dal_checks c = {~s->unconverged, dal_check_gauge(s, e->backup), dal_finite_state(s, 0),
                    dal_all()};
    *alive &= c.solved & c.gauge & c.finite;
    if (status != DAL_STATUS_OK && status != DAL_STATUS_NOT_CONVERGED) *alive = ~dal_all();
    s->used = 0;
    if (dal_any(*alive))
        c.regular = dal_check_regular(s, 0, e->backup, failure ? &failure->guard : NULL,
                                      failure ? &failure->constraint : NULL);
    *alive &= c.regular;
    const dal__lanes failed = dal__lanes_of(before & ~*alive);
    for (int i = 0; failed && i < DAL_LANES; i++)
        if (failed >> i & 1) reason[i] = dal_rejection(&c, status, i);
    return failed;
}

/* Advances clock and counters of the lanes that moved. */
static void advance_clock(engine *e, double h, dal_mask moved)
{
    num *time = persistent_at(e, DAL__TIME), *error = persistent_at(e, DAL__TIME_ERROR);
    num *steps = persistent_at(e, DAL__STEPS), *evaluations = persistent_at(e, DAL__EVALUATIONS);
    dal_clock clock = {*time, *error};
    dal_advance_clock(&clock, h);
    *time = dal_select(moved, clock.time, *time);
    *error = dal_select(moved, clock.error, *error);
    *steps = dal_select(moved, *steps + 1.0, *steps);
    *evaluations = dal_select(moved, *evaluations + (double)e->step.evaluations, *evaluations);
}

static void begin_step(engine *e, double h, dal__lanes alive, dal_mask lanes)
{
    dal_step *s = &e->step;
    memcpy(e->backup, e->persistent, changing(e) * sizeof(num));
    int first = 0; /* alive lane; all of them have its time */
    while (first < DAL_LANES - 1 && !(alive >> first & 1)) first++;
    s->t = dal_lane(*persistent_at(e, DAL__TIME), first);
    s->h = h;
    s->alive = lanes;
    s->unconverged = ~dal_all();
    s->used = 0;
    s->exhausted = false;
    s->evaluations = 0;
    s->depth = e->layout.depth - 1;
    s->pivots_known[0] = s->pivot_count == 0;
}

static dal__lanes step_engine(void *engine_, double h, dal__lanes alive, dal_status *reason)
{
    engine *e = engine_;
    dal_mask moved = dal__mask_of(alive);
    begin_step(e, h, alive, moved);
    dal_status status = e->step.layer[e->step.depth]->step(&e->step);
    if (e->step.exhausted) status = DAL_STATUS_MEMORY;
    if (e->failure) {
        e->failure->reached = e->step.t;
        e->failure->substep = dal_lane(e->step.substep[0], 0);
    }
    const dal__lanes failed = check_step(e, &moved, status, reason);
    advance_clock(e, h, moved);
    for (size_t i = 0; failed && i < changing(e); i++)
        e->persistent[i] = dal_select(moved, e->persistent[i], e->backup[i]);
    return failed;
}

#if DAL_LANES == 1
/* Divides a step of size h up to the substep that contains `size`, for its polynomial; continues
 * from the substep found last where that belongs to the same step and is not past. */
static dal_status find_substep(engine *e, double h, double size)
{
    dal_step *s = &e->step;
    dal_dense *d = &e->dense;
    const size_t bytes = dal__saved_count(&e->layout) * sizeof(num);
    const size_t half = (size_t)s->dim * sizeof(num);
    dal_status status = DAL_STATUS_OK;
    if (e->dense_h != h || !(size > d->from) || memcmp(e->dense_from, e->persistent, bytes) != 0) {
        memcpy(e->dense_from, e->persistent, bytes);
        memcpy(e->dense_to, e->persistent, bytes);
        e->dense_h = h;
        d->from = d->size = 0.0;
    }
    begin_step(e, h, 1u, dal_all());
    memcpy(e->persistent, e->dense_to, bytes);
    s->depth = 0;
    s->dense = d;
    while (status == DAL_STATUS_OK && size > d->from + d->size) {
        memcpy(d->y, s->y, half);
        memcpy(d->r, s->r, half);
        d->terms = 0;
        s->used = 0;
        status = e->layer[0]->step(s);
        if (d->terms == 0 || s->exhausted) status = DAL_STATUS_UNSUPPORTED;
    }
    s->dense = NULL;
    if (status != DAL_STATUS_OK) e->dense_h = 0.0;
    memcpy(e->dense_to, e->persistent, bytes);
    memcpy(e->persistent, e->dense_from, bytes);
    return status;
}

static dal__lanes intermediate_engine(void *engine_, double h, double size, dal_status *reason)
{
    engine *e = engine_;
    if (has_dense(&e->layout) && size / h > 0.0 && size / h < 1.0 &&
        find_substep(e, h, fabs(size)) == DAL_STATUS_OK)
        e->step.layer = e->dense_layer;
    const dal__lanes failed = step_engine(e, size, 1u, reason);
    e->step.layer = e->layer;
    return failed;
}

static bool give_polynomial(const void *engine_, dal__polynomial *out)
{
    const engine *e = engine_;
    const dal_dense *d = &e->dense;
    *out =
        (dal__polynomial){(void *)d->y, (void *)d->r, (void *)d->rate, d->terms, d->from, d->size};
    return has_dense(&e->layout) && e->dense_h != 0.0;
}

static void hold_engine(void *engine_, const double *point)
{
    engine *e = engine_;
    const dal_system *system = e->layout.system;
    system->branches->hold(system, point, (double *)e->work);
    e->dense_h = 0.0; /* the substeps found last had other formulas */
}
#else
#define intermediate_engine NULL
#define hold_engine         NULL
#define give_polynomial     NULL
#endif

const dal__engine DAL_WIDE(dal__engine) = {.bytes = engine_bytes,
                                           .place = place_engine,
                                           .step = step_engine,
                                           .step_intermediate = intermediate_engine,
                                           .polynomial = give_polynomial,
                                           .hold = hold_engine,
                                           .eval = eval_engine,
                                           .observe = observe_engine,
                                           .trace = trace_engine};
