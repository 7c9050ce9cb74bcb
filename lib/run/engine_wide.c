/* engine_wide.c - a step of one or several lanes as a transaction; see engine.h.
 *
 * After the integrator has done its work the engine accepts or rejects lane by lane: solved,
 * finite, e still on its side of zero, the guards of the constraints still on theirs, and no normal
 * of a watched constraint turned by a right angle or more: det(A1 B0) det(A0 B0) > 0 for all
 * leading minors, with B = W^-1 A^T.  A turn through a right angle within one step means that G = A
 * B vanished on the way (or that the step is far too large to tell). */
#include "run/engine.h"
#include <dalembert_kernel.h>

typedef struct engine {
    dal_step step; /* first, so that step->owner is also the engine */
    dal__shape shape;
    const dal_integrator *chain[DAL_CHAIN];
    dal_callback *call[DAL_ASK_GUARDS + 1];
    num *carried, *backup, *work;
    dal__cause *cause;
} engine;

static size_t round_up(size_t bytes) { return (bytes + 63) / 64 * 64; }

static const dal_callbacks *callbacks(const dal_system *system)
{
    if (DAL_LANES == 4) return system->wide4;
    if (DAL_LANES == 8) return system->wide8;
    return &system->call;
}

static int answer_size(const dal__shape *k, dal_question question)
{
    switch (question) {
    case DAL_ASK_FIELD:
        return k->nw;
    case DAL_ASK_ADJOINT:
        return 3 * k->n;
    case DAL_ASK_JACOBIAN:
        return k->nw * (k->n + k->nw);
    case DAL_ASK_CONSTRAINT:
        return k->m + 2 * k->m * k->n;
    case DAL_ASK_GAUGE:
        return 1;
    case DAL_ASK_GUARDS:
        return k->system->guards;
    }
    return 0;
}

/* Numbers of the carried array that a step may change: an explicit method has no stage slopes. */
static size_t changing(const engine *e)
{
    const bool is_explicit = (e->chain[0]->claims & DAL_EXPLICIT) != 0;
    return is_explicit ? dal__at(&e->shape, DAL__SLOPES) : e->shape.carried;
}

/* Remembers the first answer that is not finite. */
static void trace(engine *e, dal_question question, const dal_at *at, dal_status status,
                  const double *out)
{
    dal__cause *cause = e->cause;
    double sum = 0.0;
    for (int i = 0; i < answer_size(&e->shape, question); i++) sum += out[i] - out[i];
    if (cause->not_finite || (sum == 0.0 && status == DAL_OK)) return;
    cause->not_finite = true;
    cause->status = status;
    cause->t = at->t;
    memcpy(cause->q, at->q, (size_t)e->shape.n * sizeof(double));
    memcpy(cause->v, at->v, (size_t)e->shape.nw * sizeof(double));
}

/* The answer where there is none. */
static void fill(const engine *e, dal_question question, double value, num *out)
{
    const int size = answer_size(&e->shape, question);
    for (int i = 0; i < size; i++) out[i] = dal_num(value);
}

static void ask(dal_step *s, dal_question question, double t, const num *q, const num *v,
                const num *pi, num *out)
{
    engine *e = s->owner;
    dal_callback *const call = e->call[question];
    if (!call) { /* only the gauge may be missing here */
        fill(e, question, 0.0, out);
        return;
    }
    const dal_at at = {t, (const double *)q, (const double *)v, (const double *)pi,
                       (double *)e->work};
    const dal_status status = call(e->shape.system, &at, (double *)out);
    if (status != DAL_OK) fill(e, question, NAN, out);
    if (DAL_LANES == 1 && e->cause) trace(e, question, &at, status, (const double *)out);
}

size_t DAL_WIDE(dal__engine_bytes)(const dal__shape *k)
{
    const size_t numbers = 2 * k->carried + k->workspace + k->scratch;
    return round_up(sizeof(engine)) + 4 * 64 + numbers * sizeof(num);
}

static num *take(char **at, size_t count)
{
    num *p = (num *)(void *)*at;
    *at += round_up(count * sizeof(num));
    return p;
}

/* The step's fixed part. */
static void prepare_step(engine *e)
{
    const dal__shape *k = &e->shape;
    dal_step *s = &e->step;
    *s = (dal_step){.n = k->n, .nw = k->nw, .m = k->m, .dim = k->dim, .lifted = k->lifted};
    s->y = e->carried;
    s->r = e->carried + k->dim;
    s->stiff = e->carried + dal__at(k, DAL__STIFF);
    s->slopes_h = e->carried + dal__at(k, DAL__SLOPES_H);
    s->slopes = e->carried + dal__at(k, DAL__SLOPES);
    s->solver = k->options.solver;
    s->iterations = k->options.iterations;
    s->has_jacobian = k->system->call.jacobian != NULL;
    s->room = k->scratch;
    s->chain = e->chain;
    s->ask = ask;
    s->owner = e;
}

void *DAL_WIDE(dal__engine_place)(const dal__shape *k, void *memory, double **carried,
                                  double **work)
{
    char *at = memory;
    engine *e = memory;
    at += round_up(sizeof *e);
    memset(memory, 0, DAL_WIDE(dal__engine_bytes)(k));
    e->shape = *k;
    for (int i = 0; i < k->depth; i++)
        e->chain[i] = dal__integrator_wide(k->method.chain[i], DAL_LANES);
    const dal_callbacks *c = callbacks(k->system);
    e->call[DAL_ASK_FIELD] = c->field;
    e->call[DAL_ASK_ADJOINT] = c->adjoint;
    e->call[DAL_ASK_JACOBIAN] = c->jacobian;
    e->call[DAL_ASK_CONSTRAINT] = c->constraint;
    e->call[DAL_ASK_GAUGE] = c->gauge;
    e->call[DAL_ASK_GUARDS] = c->guards;
    e->carried = take(&at, k->carried);
    e->backup = take(&at, k->carried);
    e->work = take(&at, k->workspace);
    prepare_step(e);
    e->step.scratch = take(&at, k->scratch);
    *carried = (double *)e->carried;
    *work = (double *)e->work;
    return e;
}

void DAL_WIDE(dal__engine_trace)(void *engine_, dal__cause *cause)
{
    engine *e = engine_;
    e->cause = cause;
}

dal_status DAL_WIDE(dal__engine_ask)(void *engine_, int question, double t, const double *state,
                                     double *out)
{
    engine *e = engine_;
    const int n = e->shape.n;
    if (!e->call[question]) return DAL_UNSUPPORTED;
    const dal_at at = {t, state, state + n * DAL_LANES, state + (3 * n + 1) * DAL_LANES,
                       (double *)e->work};
    return e->call[question](e->shape.system, &at, out);
}

/* Lanes in which every component of the state is finite; 1/e stands for e. */
static dal_mask finite(const engine *e)
{
    const int dim = e->shape.dim, at_e = 2 * e->shape.n;
    if (!e->shape.lifted) return dal_equal(dal_poison(e->carried, dim), dal_num(0.0));
    const num w = 1.0 / e->carried[at_e];
    return dal_equal(dal_poison(e->carried, at_e) + (w - w) +
                         dal_poison(e->carried + at_e + 1, dim - at_e - 1),
                     dal_num(0.0));
}

static dal_mask gauge_holds(const engine *e)
{
    if (!e->shape.lifted) return dal_all();
    const int i = 2 * e->shape.n;
    return dal_less(dal_num(0.0), 1.0 / e->backup[i] * e->carried[i]) | ~dal_finite(e->carried[i]);
}

/* Notes in the cause, if somebody wants to know, the first number that failed in lane 0. */
static void note(int *which, dal_mask good, int number)
{
    if (!*which && !dal_mask_lane(good, 0)) *which = number;
}

static dal_mask guards_hold(engine *e)
{
    const int count = e->shape.system->guards, n = e->shape.n;
    dal_step *s = &e->step;
    dal_mask good = dal_all();
    if (count == 0) return good;
    num *before = dal_scratch(s, count), *after = dal_scratch(s, count);
    const double t0 = s->t - s->h;
    ask(s, DAL_ASK_GUARDS, t0, e->backup, e->backup + n, NULL, before);
    ask(s, DAL_ASK_GUARDS, s->t, e->carried, e->carried + n, NULL, after);
    for (int i = 0; i < count; i++) {
        good &= dal_less(dal_num(0.0), before[i] * after[i]);
        if (e->cause) note(&e->cause->guard, good, i + 1);
    }
    return good;
}

static dal_mask normals_hold(engine *e)
{
    const int m = e->shape.m, n = e->shape.n, size = m + 2 * m * n;
    dal_step *s = &e->step;
    dal_mask good = dal_all();
    if (!(e->shape.system->properties & DAL_D_WATCHED) || !e->call[DAL_ASK_CONSTRAINT]) return good;
    num *c0 = dal_scratch(s, size), *c1 = dal_scratch(s, size);
    num *g0 = dal_scratch(s, m * m), *g1 = dal_scratch(s, m * m);
    ask(s, DAL_ASK_CONSTRAINT, s->t - s->h, e->backup, e->backup + n, NULL, c0);
    ask(s, DAL_ASK_CONSTRAINT, s->t, e->carried, e->carried + n, NULL, c1);
    dal_gram(c0 + m, c0 + m + m * n, m, n, g0);
    dal_gram(c1 + m, c0 + m + m * n, m, n, g1);
    for (int k = 0; k < m; k++) {
        good &= dal_less(dal_num(0.0), dal_eliminate(g0, m, k) / dal_eliminate(g1, m, k));
        if (e->cause) note(&e->cause->constraint, good, k + 1);
    }
    return good;
}

static dal_mask mask_of(unsigned lanes)
{
    dal_mask mask = ~dal_all();
    for (int i = 0; i < DAL_LANES; i++)
        if (lanes >> i & 1) mask |= dal_lane_mask(i);
    return mask;
}

/* Records a reason for the lanes that lack `good`; returns them. */
static unsigned reject(dal_mask good, unsigned lanes, dal_status status, dal_status *why)
{
    unsigned failed = 0;
    for (int i = 0; i < DAL_LANES; i++) {
        if (!(lanes >> i & 1) || dal_mask_lane(good, i)) continue;
        failed |= 1u << i;
        why[i] = status;
    }
    return failed;
}

static unsigned accept(engine *e, unsigned lanes, dal_status status, dal_status *why)
{
    const dal_mask solved = ~e->step.unconverged;
    unsigned failed = 0;
    if (status != DAL_OK && status != DAL_NOT_CONVERGED)
        return reject(~dal_all(), lanes, status, why);
    failed |= reject(solved, lanes, DAL_NOT_CONVERGED, why);
    failed |= reject(gauge_holds(e), lanes & ~failed, DAL_GAUGE, why);
    failed |= reject(finite(e), lanes & ~failed, DAL_NOT_FINITE, why);
    if (failed == lanes) return failed;
    e->step.used = 0;
    failed |= reject(guards_hold(e), lanes & ~failed, DAL_SINGULAR, why);
    failed |= reject(normals_hold(e), lanes & ~failed, DAL_SINGULAR, why);
    return failed;
}

/* The clock of the lanes that made it, compensated, and the counters. */
static void advance_clock(engine *e, double h, dal_mask moved)
{
    const dal__shape *k = &e->shape;
    num *time = e->carried + dal__at(k, DAL__TIME);
    num *error = e->carried + dal__at(k, DAL__TIME_ERROR);
    const num a = *time, b = h + *error, sum = a + b, c = sum - a;
    *error = dal_select(moved, (a - (sum - c)) + (b - c), *error);
    *time = dal_select(moved, sum, a);
    num *steps = e->carried + dal__at(k, DAL__STEPS);
    num *evaluations = e->carried + dal__at(k, DAL__EVALUATIONS);
    *steps = dal_select(moved, *steps + 1.0, *steps);
    *evaluations = dal_select(moved, *evaluations + (double)e->step.evaluations, *evaluations);
}

unsigned DAL_WIDE(dal__engine_step)(void *engine_, double h, unsigned lanes, dal_status *why)
{
    engine *e = engine_;
    dal_step *s = &e->step;
    int first = 0;
    while (first < DAL_LANES - 1 && !(lanes >> first & 1)) first++;
    memcpy(e->backup, e->carried, changing(e) * sizeof(num));
    s->t = dal_lane(e->carried[dal__at(&e->shape, DAL__TIME)], first);
    s->h = h;
    s->alive = mask_of(lanes);
    s->unconverged = ~dal_all();
    s->used = 0;
    s->evaluations = 0;
    s->depth = e->shape.depth - 1;
    const dal_status status = e->chain[s->depth]->step(s);
    const unsigned failed = accept(e, lanes, status, why);
    const dal_mask moved = mask_of(lanes & ~failed);
    advance_clock(e, h, moved);
    if (failed)
        for (size_t i = 0; i < changing(e); i++)
            e->carried[i] = dal_select(moved, e->carried[i], e->backup[i]);
    return failed;
}
