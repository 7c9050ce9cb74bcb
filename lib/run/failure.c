/* failure.c - the reason why a step failed: the step is repeated and its evaluations are
 * recorded. */
#include "run/failure.h"
#include "core/settings.h"
#include <dalembert_kernel.h>

/* max |x_i| of numbers of (q, v, g) from first on, in units of the system. */
static double max_in_units(const dal__layout *k, const double *x, int first, int count)
{
    const double *const units = dal__units(k, DAL__UNITS_OF_STATE);
    double max = 0.0;
    for (int i = 0; i < count; i++)
        max = dal_max(max, dal_abs(dal_in_units(x[i], units, first + i)));
    return max;
}

/* Whether the point is far away, in the iteration or in the whole run: then the overflow says
 * nothing about the system. */
static bool is_far_away(const dal_run *run, const dal__failure *failure)
{
    const dal__layout *k = &run->layout;
    const double far = fmin(1e8 * (1.0 + max_in_units(k, run->persistent, 0, k->n + k->nw)), 1e60);
    return max_in_units(k, failure->q, 0, k->n) > far ||
           max_in_units(k, failure->v, k->n, k->nw) > far;
}

/* The reason that the system gives for the point; DAL_STATUS_OK: none. */
static dal_status diagnose(dal_run *run, const dal__failure *failure, dal_error *error)
{
    const dal_system *system = run->layout.system;
    const dal_point at = {.t = failure->t, .q = failure->q, .v = failure->v, .work = run->work};
    double number = 0.0;
    if (!system->diagnose || is_far_away(run, failure)) return DAL_STATUS_OK;
    const dal_status status = system->diagnose(system, &at, &number);
    if (status == DAL_STATUS_SINGULAR)
        return dal__fail(error, status,
                         "%s became singular near t = %.17g: G = A W^-1 A^T has no inverse",
                         DAL__CONSTRAINT_NAME(system, (int)number - 1), failure->t);
    if (status == DAL_STATUS_SINGULAR_MASS)
        return dal__fail(error, status, "%s became singular near t = %.17g",
                         dal__mass_words(system), failure->t);
    if (status == DAL_STATUS_NOT_FINITE)
        return dal__fail(error, status, "table %.80s is read outside its points near t = %.17g",
                         system->table[(int)number - 1], failure->t);
    return DAL_STATUS_OK;
}

/* Whether e would pass zero in the step; a stage may have reached it. */
static bool gauge_crosses(dal_run *run, double t, double h)
{
    if (!run->layout.lifted) return false;
    const double e = run->persistent[2 * run->layout.n];
    double mu[2] = {0.0, 0.0};
    for (int i = 0; i < 2; i++)
        if (run->kind->engine->eval(run->engine, DAL_EVAL_GAUGE, t + i * h, run->persistent,
                                    &mu[i]) != DAL_STATUS_OK)
            return false;
    return e * (e + h * mu[0]) <= 0.0 || e * (e + h * mu[1]) <= 0.0;
}

#ifdef DAL_MINIMAL
#define inverse_entry(run, k, t, state) NAN
#else
/* Entry (k, k) of G^-1 by the factors of F: one over the square of the distance of gradient k from
 * the span of the others. */
static double inverse_entry(dal_run *run, int k, double t, const double *state)
{
    const dal_system *system = run->layout.system;
    const int n = system->n, m = system->m;
    double *in = run->scratch, *out = in + n + m + 1;
    const dal_point at = {.t = t, .q = state, .v = state + n, .pi = in, .work = run->work};
    for (int i = 0; i <= n + m; i++) in[i] = i == n + k;
    return system->call.enforcement(system, &at, out) == DAL_STATUS_OK ? out[n + k] : NAN;
}
#endif

/* The pivot of a constraint, from 1, in G at the present state; NaN: it has none. */
static double pivot_of(dal_run *run, int constraint, double t)
{
    const int m = run->layout.m, n = run->layout.n;
    double *c = run->scratch, *g = c + m + 2 * m * n, pivot = NAN;
    if (dal__checks_rank_by_factors(&run->layout))
        return fabs(1.0 / inverse_entry(run, constraint - 1, t, run->persistent));
    if (run->kind->engine->eval(run->engine, DAL_EVAL_CONSTRAINT, t, run->persistent, c) !=
        DAL_STATUS_OK)
        return NAN;
    dal_gram(c + m, c + m + m * n, m, n, g);
    for (int k = 0; k < constraint; k++) pivot = fabs(dal_eliminate(g, m, k));
    return pivot;
}

/* Whether small steps pass where one of h fails, and G keeps its size: where it vanishes at an even
 * pace its pivot, the square of a distance, is below 1/64^2 of the largest in one of them, and
 * small from the beginning where errors of D lead past the singular place. */
static bool passes_in_intervals(dal_run *run, int constraint, double t, double h)
{
    enum { INTERVALS = 64 };
    const double least = 0.1;
    const size_t bytes = run->layout.persistent * sizeof *run->persistent;
    dal_status reason = DAL_STATUS_OK;
    double min = pivot_of(run, constraint, t), max = min;
    bool passes = true;
    memcpy(run->shadow, run->persistent, bytes);
    for (int i = 0; i < INTERVALS && passes; i++) {
        passes = run->kind->engine->step(run->engine, h / INTERVALS, 1u, &reason) == 0;
        const double pivot = pivot_of(run, constraint, t + (i + 1) * h / INTERVALS);
        min = fmin(min, pivot);
        max = fmax(max, pivot);
    }
    memcpy(run->persistent, run->shadow, bytes);
    return passes && min > least * max;
}

static dal_status turned(dal_run *run, const dal__failure *failure, double t, double h,
                         dal_error *error)
{
    const dal_system *system = run->layout.system;
    if (failure->guard)
        return dal__fail(error,
                         failure->guard == system->mass_guard ? DAL_STATUS_SINGULAR_MASS
                                                              : DAL_STATUS_SINGULAR,
                         "%s goes to zero between t = %.17g and %.17g: singular there",
                         system->guard ? system->guard[failure->guard - 1] : "a guard", t, t + h);
    const char *const name = DAL__CONSTRAINT_NAME(system, failure->constraint - 1);
    if (passes_in_intervals(run, failure->constraint, t, h))
        return dal__fail(error, DAL_STATUS_NOT_CONVERGED,
                         "the gradient of %s by the velocities turns by more than a "
                         "right angle in the step of %g from t = %.17g, though G = A W^-1 A^T is "
                         "regular; take a smaller step",
                         name, h, t);
    return dal__fail(error, DAL_STATUS_SINGULAR,
                     "%s becomes singular between t = %.17g and %.17g: its normal "
                     "shrinks or turns round, so that G = A W^-1 A^T vanishes",
                     name, t, t + h);
}

/* Where the stages of a small step are not solved, a constraint may be about to become singular: a
 * guard, or a pivot of G, would vanish within NEAR steps at its rate over PIECE*h of the
 * tangent. */
#define PIECE 1e-4
#define NEAR  4.0

static bool would_vanish(double now, double then) { return !(1.0 - then / now < PIECE / NEAR); }

/* Stores q, v a piece dt of the tangent ahead in run->shadow. */
static bool predict(dal_run *run, double t, double dt)
{
    const dal__layout *k = &run->layout;
    double *f = run->scratch;
    if (run->kind->engine->eval(run->engine, DAL_EVAL_FIELD, t, run->persistent, f) !=
        DAL_STATUS_OK)
        return false;
    for (int i = 0; i < k->n; i++)
        run->shadow[i] = run->persistent[i] + dt * run->persistent[k->n + i];
    for (int i = 0; i < k->nw; i++) run->shadow[k->n + i] = run->persistent[k->n + i] + dt * f[i];
    return true;
}

/* Evaluates a callback at the present state and at the predicted one; returns the second output. */
static double *eval_both_ends(dal_run *run, int code, int size, double t, double dt)
{
    double *first = run->scratch, *second = first + size;
    const bool good =
        run->kind->engine->eval(run->engine, code, t, run->persistent, first) == DAL_STATUS_OK &&
        run->kind->engine->eval(run->engine, code, t + dt, run->shadow, second) == DAL_STATUS_OK;
    return good ? second : NULL;
}

static int vanishing_guard(dal_run *run, double t, double dt)
{
    const int guards = run->layout.system->guards;
    const double *g0 = run->scratch, *g1 = eval_both_ends(run, DAL_EVAL_GUARDS, guards, t, dt);
    for (int i = 0; g1 && i < guards; i++)
        if (would_vanish(g0[i], g1[i])) return i + 1;
    return 0;
}

#ifdef DAL_MINIMAL
#define vanishing_distance(run, t, dt) 0
#else
/* The same of a distance of inverse_entry, in place of a pivot of G. */
static int vanishing_distance(dal_run *run, double t, double dt)
{
    for (int k = 0; k < run->layout.m; k++) {
        const double now = inverse_entry(run, k, t, run->persistent);
        if (would_vanish(1.0 / now, 1.0 / inverse_entry(run, k, t + dt, run->shadow))) return k + 1;
    }
    return 0;
}
#endif

static int vanishing_normal(dal_run *run, double t, double dt)
{
    const int m = run->layout.m, n = run->layout.n, size = m + 2 * m * n;
    if (!(run->layout.system->properties & DAL_D_RANK_CHECKED)) return 0;
    if (dal__checks_rank_by_factors(&run->layout)) return vanishing_distance(run, t, dt);
    const double *c0 = run->scratch, *c1 = eval_both_ends(run, DAL_EVAL_CONSTRAINT, size, t, dt);
    double *g0 = run->scratch + 2 * size, *g1 = g0 + m * m;
    if (!c1) return 0;
    dal_gram(c0 + m, c0 + m + m * n, m, n, g0);
    dal_gram(c1 + m, c1 + m + m * n, m, n, g1);
    for (int k = 0; k < m; k++)
        if (would_vanish(dal_eliminate(g0, m, k), dal_eliminate(g1, m, k))) return k + 1;
    return 0;
}

static bool vanishes(dal_run *run, double t, double h, dal__failure *failure)
{
    if (!predict(run, t, PIECE * h)) return false;
    failure->guard = vanishing_guard(run, t, PIECE * h);
    if (!failure->guard) failure->constraint = vanishing_normal(run, t, PIECE * h);
    return failure->guard || failure->constraint;
}

static dal_status unsolved(dal_run *run, double t, double h, dal_error *error)
{
    char name[128];
    return dal__fail(error, DAL_STATUS_NOT_CONVERGED,
                     "the implicit equations of %s did not converge in the step of %g from "
                     "t = %.17g (at most %d iterations); take a smaller step",
                     dal_method_name(&run->layout.method, name, sizeof name), h, t,
                     run->layout.options.iterations);
}

/* Step-size control failed. */
static dal_status undivided(dal_run *run, const dal__failure *failure, double t, double h,
                            dal_error *error)
{
    const double tolerance = run->layout.options.tolerance;
    if (failure->substep > 0.0)
        return dal__fail(error, DAL_STATUS_NOT_CONVERGED,
                         "too many substeps (more than %d) for tolerance %g in the step of %g from "
                         "t = %.17g: at t = %.17g their size is %g",
                         DAL__MAX_TRIALS, tolerance, h, t, failure->reached, failure->substep);
    return dal__fail(error, DAL_STATUS_NOT_CONVERGED,
                     "the step size went to zero at t = %.17g in the step of %g from t = %.17g: "
                     "no substep there keeps the error within tolerance %g",
                     failure->reached, h, t, tolerance);
}

/* Repeats the step and records it.  A system that is not a pure function may succeed now, so the
 * state is restored. */
static void repeat(dal_run *run, double h, dal__failure *failure)
{
    const size_t bytes = run->layout.persistent * sizeof *run->persistent;
    dal_status reason = DAL_STATUS_OK;
    memcpy(run->shadow, run->persistent, bytes);
    run->kind->engine->trace(run->engine, failure);
    run->kind->engine->step(run->engine, h, 1u, &reason);
    run->kind->engine->trace(run->engine, NULL);
    memcpy(run->persistent, run->shadow, bytes);
}

dal_status dal__failure_reason(dal_run *run, double h, dal_status status, dal_error *error)
{
    const dal__layout *k = &run->layout;
    const double t = dal_run_time(run);
    dal__failure failure = {.q = run->point, .v = run->point + k->n};
    repeat(run, h, &failure);
    if (status == DAL_STATUS_GAUGE || (status != DAL_STATUS_SINGULAR && gauge_crosses(run, t, h)))
        return dal__fail(error, DAL_STATUS_GAUGE,
                         "e reached zero between t = %.17g and %.17g: 1/e is not defined", t,
                         t + h);
    if (failure.guard || failure.constraint) return turned(run, &failure, t, h, error);
    if (failure.not_finite) {
        const dal_status said = diagnose(run, &failure, error);
        if (said != DAL_STATUS_OK) return said;
        if (failure.status != DAL_STATUS_OK)
            return dal__fail(error, failure.status, "the system failed at t = %.17g: %s", failure.t,
                             dal_status_text(failure.status));
    }
    if (status == DAL_STATUS_NOT_CONVERGED && vanishes(run, t, h, &failure))
        return turned(run, &failure, t, h, error);
    if (status == DAL_STATUS_NOT_CONVERGED && k->options.tolerance > 0.0 &&
        fabs(failure.reached - t) < fabs(h))
        return undivided(run, &failure, t, h, error);
    if (status == DAL_STATUS_NOT_CONVERGED) return unsolved(run, t, h, error);
    if (status == DAL_STATUS_NOT_FINITE)
        return dal__fail(error, status, "a value is not finite in the step of %g from t = %.17g", h,
                         t);
    return dal__fail(error, status, "%s in the step of %g from t = %.17g", dal_status_text(status),
                     h, t);
}
