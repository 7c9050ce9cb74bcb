/* start.c - parameters and start of a run: set by name, completed by the system, checked; and a
 * parameter set between steps.
 *
 * A start is consistent when |D_a| <= 1e-10 |A_a| |v| (1-norm times max norm), and the constraints
 * are independent when no pivot of G is below 1e-12 of its diagonal entry. */
#include "run/start.h"
#include "core/error.h"
#include "run/quad.h"
#include <dalembert_kernel.h>
#include <float.h>

#define CONSISTENT  1e-10
#define INDEPENDENT 1e-12

dal_status dal__run_prepare(dal_run *run)
{
    const dal__layout *k = &run->layout;
    const dal_point at = dal__here(run);
    if (k->system->prepare) DAL_TRY(k->system->prepare(k->system, &at, NULL));
    if (!run->quad.engine) return DAL_OK;
    dal__quad_push(run, k->persistent);
    return dal__quad_prepare(run);
}

static dal_status prepare(dal_run *run, dal_error *error)
{
    const char *name = run->layout.system->name;
    const dal_status status = dal__run_prepare(run);
    if (status == DAL_OK) return DAL_OK;
    return dal__fail(error, status, "%s cannot be prepared with these parameters",
                     name ? name : "the system");
}

/* Suggests the name nearest to an unknown start name. */
static dal_status unknown_start(const dal_run *run, const char *name, dal_error *error)
{
    char best[DAL__NAME_SIZE] = "", other[DAL__NAME_SIZE];
    for (int i = 0; dal_run_name(run, i, other, sizeof other); i++) {
        const char *pair[] = {*best ? best : NULL, other};
        if (dal_nearest(name, pair, 2) == other) memcpy(best, other, sizeof best);
    }
    const char *names[] = {*best ? best : NULL};
    return dal__unknown(error, run->layout.lifted ? "start name" : "start name (q, v space)", name,
                        names, 1);
}

static dal_status override(dal_run *run, const dal_setting *settings, int count, dal_error *error)
{
    for (int k = 0; k < count; k++) {
        const int i = dal_run_index(run, settings[k].name);
        if (i < 0) return unknown_start(run, settings[k].name, error);
        if (!dal__is_possible(&run->layout, (size_t)i, settings[k].value))
            return dal__fail(error, DAL_ARGUMENT, "start %s: %g is not a finite number",
                             settings[k].name, settings[k].value);
        run->persistent[i] = settings[k].value;
    }
    return DAL_OK;
}

/* q, v, g and e of the system; momenta are 0. */
static dal_status default_start(dal_run *run, dal_error *error)
{
    const dal__layout *k = &run->layout;
    const int first = k->n + k->nw;
    memset(run->persistent, 0, k->persistent * sizeof *run->persistent);
    run->persistent[dal__at(k, DAL__TIME)] = k->start_time;
    double *out = run->scratch;
    for (int i = 0; i <= first; i++) out[i] = i == first;
    const dal_point at = dal__here(run);
    if (k->system->start && k->system->start(k->system, &at, out) != DAL_OK)
        return dal__fail(error, DAL_NOT_FINITE, "%s has no start with these parameters",
                         k->system->name ? k->system->name : "the system");
    memcpy(run->persistent, out, (size_t)first * sizeof *out);
    if (k->lifted) run->persistent[2 * k->n] = out[first];
    return DAL_OK;
}

static dal_status check_finite(dal_run *run, dal_error *error)
{
    const int e = run->layout.lifted ? 2 * run->layout.n : -1;
    char name[DAL__NAME_SIZE];
    for (int i = 0; i < run->layout.dim; i++) {
        run->persistent[i] += 0.0; /* no -0: see lib/kernel/step.h */
        if (i == e && isinf(1.0 / run->persistent[i]))
            return dal__fail(error, DAL_GAUGE, "start e = %g: e must not vanish",
                             run->persistent[i]);
        if (!dal__is_possible(&run->layout, (size_t)i, run->persistent[i]))
            return dal__fail(error, DAL_NOT_FINITE, "start %s is not finite: %g",
                             dal_run_name(run, i, name, sizeof name), run->persistent[i]);
    }
    return DAL_OK;
}

/* D, A, W^-1 A^T of the present state, and behind them the numbers for G and its diagonal.  place:
 * that state in messages.  before: D of the parameters before a change; NULL at the start. */
typedef struct constraint_values {
    const double *D, *A, *B, *before;
    double *G;
    const char *place, *hint; /* hint: what may help, or NULL */
} constraint_values;

static dal_status eval_constraints(dal_run *run, constraint_values *c, dal_error *error)
{
    const dal_system *system = run->layout.system;
    const int m = system->m, n = system->n;
    const dal_point at = dal__here(run);
    const dal_status status = system->call.constraint(system, &at, run->scratch);
    c->D = run->scratch;
    c->A = c->D + m;
    c->B = c->A + m * n;
    c->G = run->scratch + m + 2 * m * n;
    if (status == DAL_OK) return DAL_OK;
    return dal__fail(error, status, "the constraints cannot be evaluated at %s", c->place);
}

static dal_status check_consistent(const dal_run *run, const constraint_values *c, dal_error *error)
{
    const dal__layout *k = &run->layout;
    const double speed = dal_max_norm(run->persistent + k->n, k->n);
    for (int i = 0; i < k->m; i++) {
        double scale = 0.0;
        for (int j = 0; j < k->n; j++) scale += fabs(c->A[i * k->n + j]);
        const double small = CONSISTENT * scale * speed;
        if (fabs(c->D[i]) <= small) continue;
        if (c->before && fabs(c->D[i] - c->before[i]) <= small) continue; /* the drift of a run */
        return dal__fail(error, isfinite(c->D[i]) ? DAL_INCONSISTENT : DAL_NOT_FINITE,
                         "%s violates constraint %d: D%d = %.6g%s", c->place, i + 1, i + 1, c->D[i],
                         c->hint ? c->hint : "");
    }
    return DAL_OK;
}

/* Pivots of G = A B, each against its diagonal entry before elimination, constraint by constraint.
 * Without a pivot W itself may be singular. */
static dal_status check_rank(dal_run *run, const constraint_values *c, dal_error *error)
{
    const dal_system *system = run->layout.system;
    const int m = run->layout.m, n = run->layout.n;
    double *diagonal = c->G + m * m, rest = 0.0, number = 0.0;
    int k = 0;
    dal_gram(c->A, c->B, m, n, c->G);
    for (int i = 0; i < m; i++) diagonal[i] = fabs(c->G[i * m + i]);
    for (; k < m; k++) {
        rest = dal_eliminate(c->G, m, k);
        if (!(fabs(rest) > INDEPENDENT * diagonal[k] && isfinite(rest))) break;
    }
    if (k == m) return DAL_OK;
    const dal_point at = dal__here(run);
    if (system->diagnose && system->diagnose(system, &at, &number) == DAL_SINGULAR_MASS)
        return dal__fail(error, DAL_SINGULAR_MASS, "the mass matrix is singular at %s", c->place);
    return dal__fail(error, DAL_RANK,
                     "constraint %d restricts no velocity at %s, or none that those before it "
                     "leave free (pivot %g of G)",
                     k + 1, c->place, rest);
}

/* ---- a consistent start ---- */

/* Replaces v by the point nearest to given[n] of D + A (v' - v) = 0, the linearisation at v:
 *
 *     v' = given + W^-1 A^T x,    A W^-1 A^T x = -(D + A (given - v))
 *
 * without pivoting: check_rank has found the pivots.  Returns max |v' - v|. */
static double move_to_linear(dal_run *run, const constraint_values *c, const double *given)
{
    const int m = run->layout.m, n = run->layout.n;
    double *v = run->persistent + n, *G = c->G, *x = G + m * m, change = 0.0;
    dal_gram(c->A, c->B, m, n, G);
    for (int a = 0; a < m; a++) {
        x[a] = -c->D[a];
        for (int i = 0; i < n; i++) x[a] -= c->A[a * n + i] * (given[i] - v[i]);
        for (int k = 0; k < a; k++) {
            const double factor = G[a * m + k] / G[k * m + k];
            for (int j = k; j < m; j++) G[a * m + j] -= factor * G[k * m + j];
            x[a] -= factor * x[k];
        }
    }
    for (int k = m - 1; k >= 0; k--) {
        for (int j = k + 1; j < m; j++) x[k] -= G[k * m + j] * x[j];
        x[k] /= G[k * m + k];
    }
    for (int i = 0; i < n; i++) {
        double moved = given[i];
        for (int a = 0; a < m; a++) moved += c->B[i * m + a] * x[a];
        change = fmax(change, fabs(moved - v[i]));
        v[i] = moved + 0.0; /* no -0: see lib/kernel/step.h */
    }
    return change;
}

enum { MAX_MOVES = 1000 };

/* Least change of the velocities: (v - given).W (v - given) is stationary on D = 0, with A at the
 * solution, which is the fixed point of move_to_linear; linear D need one move. */
static dal_status make_consistent(dal_run *run, dal_error *error)
{
    const int n = run->layout.n;
    const double *v = run->persistent + n;
    double *given = run->point, change = INFINITY, before;
    constraint_values c = {.place = "the start"};
    memcpy(given, v, (size_t)n * sizeof *given);
    for (int k = 0; k < MAX_MOVES; k++) {
        DAL_TRY(eval_constraints(run, &c, error));
        DAL_TRY(check_rank(run, &c, error));
        before = change;
        change = move_to_linear(run, &c, given);
        const double resolution = DBL_EPSILON * dal_max_norm(v, n);
        if (change <= resolution || (change >= before && change <= 64.0 * resolution))
            return DAL_OK;
    }
    DAL_TRY(eval_constraints(run, &c, error));
    int k = 0; /* violated most */
    for (int a = 1; a < run->layout.m; a++)
        if (!(fabs(c.D[a]) <= fabs(c.D[k]))) k = a;
    return dal__fail(error, DAL_INCONSISTENT,
                     "no velocities near those of the start were found that satisfy constraint %d: "
                     "D%d = %.6g; give others",
                     k + 1, k + 1, c.D[k]);
}

static bool has_constraints(const dal_run *run)
{
    return run->layout.m > 0 && run->layout.system->call.constraint;
}

static dal_status check_constraints(dal_run *run, dal_error *error)
{
    constraint_values c = {.place = "the start",
                           .hint = "; the option consistent moves its velocities to D = 0"};
    if (!has_constraints(run)) return DAL_OK;
    DAL_TRY(eval_constraints(run, &c, error));
    DAL_TRY(check_consistent(run, &c, error));
    return check_rank(run, &c, error);
}

/* Whether the exact solution has the start of this run. */
static bool exact_agrees(dal_run *run)
{
    const dal__layout *k = &run->layout;
    const dal_point at = dal__here(run);
    if (!k->system->exact || k->system->exact(k->system, &at, run->scratch) != DAL_OK) return false;
    const double size = 1.0 + dal_max_norm(run->persistent, 2 * k->n);
    for (int i = 0; i < 2 * k->n; i++)
        if (!(fabs(run->scratch[i] - run->persistent[i]) <= CONSISTENT * size)) return false;
    return true;
}

dal_status dal__run_start(dal_run *run, const dal_setting *parameters, int parameter_count,
                          const dal_setting *start, int start_count, dal_error *error)
{
    DAL_TRY(dal__set_parameters(run->layout.system, parameters, parameter_count, DAL_ARGUMENT,
                                run->work, error));
    DAL_TRY(prepare(run, error));
    DAL_TRY(default_start(run, error));
    DAL_TRY(override(run, start, start_count, error));
    DAL_TRY(check_finite(run, error));
    if (run->layout.options.consistent && has_constraints(run))
        DAL_TRY(make_consistent(run, error));
    DAL_TRY(check_constraints(run, error));
    run->exact = exact_agrees(run);
    return DAL_OK;
}

/* ---- a parameter between steps ---- */

/* Whether the present state has accelerations: W and G are regular there, F is finite. */
static dal_status check_field(dal_run *run, dal_error *error)
{
    const dal_system *system = run->layout.system;
    const dal_point at = dal__here(run);
    double number = 0.0, *f = run->scratch;
    const dal_status fault = system->diagnose ? system->diagnose(system, &at, &number) : DAL_OK;
    if (fault == DAL_SINGULAR_MASS)
        return dal__fail(error, fault, "the mass matrix is singular at the present state");
    if (fault == DAL_SINGULAR)
        return dal__fail(error, fault, "constraint %d is singular at the present state",
                         (int)number);
    if (fault == DAL_NOT_FINITE)
        return dal__fail(error, fault,
                         "table %.80s is read outside its points at the present state",
                         system->table[(int)number - 1]);
    const dal_status status = system->call.field(system, &at, f);
    if (status != DAL_OK) return dal__fail(error, status, "the system fails at the present state");
    for (int i = 0; i < run->layout.nw; i++)
        if (!isfinite(f[i]))
            return dal__fail(error, DAL_NOT_FINITE,
                             "acceleration %d is not finite at the present state: %g", i + 1, f[i]);
    return DAL_OK;
}

/* Stores D of the present state; NaN where it cannot be evaluated. */
static void note_constraints(dal_run *run, double *D)
{
    constraint_values c;
    const bool known = has_constraints(run) && eval_constraints(run, &c, NULL) == DAL_OK;
    for (int i = 0; i < run->layout.m; i++) D[i] = known ? c.D[i] : NAN;
}

/* DAL_INCONSISTENT: the parameters can be used, but D, which was `before`, is not 0 with them. */
static dal_status check_parameters(dal_run *run, const double *before, dal_error *error)
{
    constraint_values c = {.place = "the present state", .before = before};
    DAL_TRY(prepare(run, error));
    DAL_TRY(check_field(run, error));
    if (!has_constraints(run)) return DAL_OK;
    DAL_TRY(eval_constraints(run, &c, error));
    DAL_TRY(check_rank(run, &c, error));
    return check_consistent(run, &c, error);
}

void dal__restart_method(dal_run *run)
{
    const dal__layout *k = &run->layout;
    const size_t first = dal__at(k, DAL__CLOCK_SIZE), changed = dal__at_changed(k);
    memset(run->persistent + first, 0, (changed - first) * sizeof *run->persistent);
    if (run->quad.engine) dal__quad_push(run, first);
}

/* The next step is the method's first, and the solution no longer the exact one. */
static void begin_again(dal_run *run)
{
    run->persistent[dal__at_changed(&run->layout)] = 1.0;
    dal__restart_method(run);
}

dal_status dal_run_set_parameter(dal_run *run, const char *name, double value, dal_error *error)
{
    dal_error reason = {0};
    int i;
    DAL_REQUIRE(run, error);
    DAL_REQUIRE(name, error);
    DAL_TRY(dal__find_parameter(run->layout.system, name, &i, error));
    if (!isfinite(value))
        return dal__fail(error, DAL_NOT_FINITE, "parameter %s: %g is not a finite number", name,
                         value);
    const double before = run->work[i];
    note_constraints(run, run->point);
    run->work[i] = value;
    const dal_status status = check_parameters(run, run->point, &reason);
    if (status == DAL_OK || status == DAL_INCONSISTENT) {
        begin_again(run);
    } else {
        run->work[i] = before;
        dal__run_prepare(run);
    }
    if (status == DAL_OK) return DAL_OK;
    return dal__fail(error, status, "parameter %s = %g: %s", name, value, reason.message);
}
