/* start.c - parameters and start of a run: set by name, completed by the system, checked.
 *
 * A start is consistent when |D_a| <= 1e-10 |A_a| |v| (1-norm times max norm), and the constraints
 * are independent when no pivot of G is below 1e-12 of its diagonal entry. */
#include "run/start.h"
#include "core/error.h"
#include <dalembert_kernel.h>

#define CONSISTENT  1e-10
#define INDEPENDENT 1e-12

enum { NAME_SIZE = 128 };

static dal_status set_parameters(dal_run *run, const dal_setting *settings, int count,
                                 dal_error *error)
{
    const dal_system *system = run->layout.system;
    DAL_TRY(dal__set_parameters(system, settings, count, DAL_ARGUMENT, run->work, error));
    const dal_point at = dal__here(run);
    const dal_status status = system->prepare ? system->prepare(system, &at, NULL) : DAL_OK;
    if (status == DAL_OK) return DAL_OK;
    return dal__fail(error, status, "%s cannot be prepared with these parameters",
                     system->name ? system->name : "the system");
}

/* Suggests the name nearest to an unknown start name. */
static dal_status unknown_start(const dal_run *run, const char *name, dal_error *error)
{
    char best[NAME_SIZE] = "", other[NAME_SIZE];
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
    char name[NAME_SIZE];
    for (int k = 0; k < count; k++) {
        int i = 0;
        while (dal_run_name(run, i, name, sizeof name) && strcmp(name, settings[k].name) != 0) i++;
        if (i == run->layout.dim) return unknown_start(run, settings[k].name, error);
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
    double *out = run->scratch;
    for (int i = 0; i <= first; i++) out[i] = i == first;
    const dal_point at = {0.0, run->persistent, run->persistent + k->n, NULL, run->work};
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
    char name[NAME_SIZE];
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

static dal_status check_consistent(const dal_run *run, const double *d, const double *a,
                                   dal_error *error)
{
    const dal__layout *k = &run->layout;
    const double speed = dal_max_norm(run->persistent + k->n, k->n);
    for (int i = 0; i < k->m; i++) {
        double scale = 0.0;
        for (int j = 0; j < k->n; j++) scale += fabs(a[i * k->n + j]);
        if (fabs(d[i]) <= CONSISTENT * scale * speed) continue;
        return dal__fail(error, isfinite(d[i]) ? DAL_INCONSISTENT : DAL_NOT_FINITE,
                         "the start violates constraint %d: D%d = %.6g", i + 1, i + 1, d[i]);
    }
    return DAL_OK;
}

/* Constraint k has no pivot in G; W itself may be singular. */
static dal_status refuse_pivot(dal_run *run, int k, double pivot, dal_error *error)
{
    const dal_system *system = run->layout.system;
    const dal_point at = dal__here(run);
    double number = 0.0;
    if (system->diagnose && system->diagnose(system, &at, &number) == DAL_SINGULAR_MASS)
        return dal__fail(error, DAL_SINGULAR_MASS, "the mass matrix is singular at the start");
    return dal__fail(error, DAL_RANK,
                     "constraint %d restricts no velocity at the start, or none that those "
                     "before it leave free (pivot %g of G)",
                     k + 1, pivot);
}

/* Pivots of G = A B, each against its diagonal entry before elimination, constraint by constraint.
 */
static dal_status check_rank(dal_run *run, const double *a, const double *b, double *g,
                             dal_error *error)
{
    const int m = run->layout.m, n = run->layout.n;
    double *diagonal = g + m * m;
    dal_gram(a, b, m, n, g);
    for (int i = 0; i < m; i++) diagonal[i] = fabs(g[i * m + i]);
    for (int k = 0; k < m; k++) {
        const double rest = dal_eliminate(g, m, k);
        if (fabs(rest) > INDEPENDENT * diagonal[k] && isfinite(rest)) continue;
        return refuse_pivot(run, k, rest, error);
    }
    return DAL_OK;
}

static dal_status check_constraints(dal_run *run, dal_error *error)
{
    const dal__layout *k = &run->layout;
    const dal_callbacks *call = &k->system->call;
    if (k->m == 0 || !call->constraint) return DAL_OK;
    const int m = k->m, n = k->n;
    const dal_point at = dal__here(run);
    double *d = run->scratch, *a = d + m, *b = a + m * n;
    const dal_status status = call->constraint(k->system, &at, d);
    if (status != DAL_OK)
        return dal__fail(error, status, "the constraints cannot be evaluated at the start");
    DAL_TRY(check_consistent(run, d, a, error));
    return check_rank(run, a, b, b + n * m, error);
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
    DAL_TRY(set_parameters(run, parameters, parameter_count, error));
    DAL_TRY(default_start(run, error));
    DAL_TRY(override(run, start, start_count, error));
    DAL_TRY(check_finite(run, error));
    DAL_TRY(check_constraints(run, error));
    run->exact = exact_agrees(run);
    return DAL_OK;
}
