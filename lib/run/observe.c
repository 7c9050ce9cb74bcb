/* observe.c - the observables of the present state: D, E, H, norms, invariants, error; and the
 * names of observables and of state components. */
#include "run/quad.h"
#include <dalembert_kernel.h>
#include <stdio.h>

/* ---- names of state components ---- */

/* prefix, name of coordinate i (q1, q2, ... when it has none), suffix */
static char *compose(const dal_system *system, const char *prefix, int i, const char *suffix,
                     char *buffer, size_t size)
{
    if (system->coordinate)
        snprintf(buffer, size, "%s%s%s", prefix, system->coordinate[i], suffix);
    else
        snprintf(buffer, size, "%sq%d%s", prefix, i + 1, suffix);
    return buffer;
}

static char *state_name(const dal_system *system, bool lifted, int i, char *buffer, size_t size)
{
    const int n = system->n;
    if (i < 0) return NULL;
    if (i < n) return compose(system, "", i, "", buffer, size);
    if (i < 2 * n) return compose(system, "", i - n, "'", buffer, size);
    if (!lifted) {
        if (i >= 2 * n + system->multipliers) return NULL;
        snprintf(buffer, size, "g%d", i - 2 * n + 1);
        return buffer;
    }
    if (i == 2 * n || i == 4 * n + 1) {
        snprintf(buffer, size, "%s", i == 2 * n ? "e" : "pi_e");
        return buffer;
    }
    if (i < 3 * n + 1) return compose(system, "p_", i - 2 * n - 1, "", buffer, size);
    if (i < 4 * n + 1) return compose(system, "pi_", i - 3 * n - 1, "", buffer, size);
    return NULL;
}

char *dal_run_name(const dal_run *run, int i, char *buffer, size_t size)
{
    if (!run || !buffer) return NULL;
    return state_name(run->layout.system, run->layout.lifted, i, buffer, size);
}

/* ---- observables ---- */

/* The groups of observables in their order. */
enum { GROUP_D, GROUP_E, GROUP_H, GROUP_NORMS, GROUP_INVARIANTS, GROUP_ERROR, GROUPS };

static int group_size(const dal_run *run, int group)
{
    const dal_system *system = run->layout.system;
    switch (group) {
    case GROUP_D:
        return system->constraints ? system->m : 0;
    case GROUP_E:
        return system->energy != NULL;
    case GROUP_H:
        return run->layout.lifted;
    case GROUP_NORMS:
        return run->layout.lifted ? 3 : 0;
    case GROUP_INVARIANTS:
        return system->invariant_values ? system->invariants : 0;
    case GROUP_ERROR:
        return run->exact;
    }
    return 0;
}

int dal_run_observables(const dal_run *run)
{
    int count = 0;
    for (int group = 0; run && group < GROUPS; group++) count += group_size(run, group);
    return count;
}

char *dal_run_observable_name(const dal_run *run, int i, char *buffer, size_t size)
{
    static const char *const fixed[] = {NULL, "E", "H", NULL, NULL, "error"};
    static const char *const norms[] = {"|p|", "|pi|", "|pi_e|"};
    if (!run || !buffer) return NULL;
    const dal_system *system = run->layout.system;
    int group = 0;
    for (; i >= 0 && group < GROUPS && i >= group_size(run, group); group++)
        i -= group_size(run, group);
    if (i < 0 || group == GROUPS) return NULL;
    if (group == GROUP_D)
        snprintf(buffer, size, "D%d", i + 1);
    else if (group == GROUP_NORMS)
        snprintf(buffer, size, "%s", norms[i]);
    else if (group == GROUP_INVARIANTS)
        snprintf(buffer, size, "%s", system->invariant ? system->invariant[i] : "invariant");
    else
        snprintf(buffer, size, "%s", fixed[group]);
    return buffer;
}

/* H = pi.pi/(2e) + pi.F + p.v + mu_e pi_e */
static double hamiltonian(dal_run *run)
{
    const int n = run->layout.n;
    const double *y = run->persistent, *v = y + n, *p = y + 2 * n + 1, *pi = y + 3 * n + 1;
    double *f = run->scratch, mu = 0.0, sum = 0.0;
    const double t = dal_run_time(run);
    run->kind->engine->eval(run->engine, DAL_EVAL_FIELD, t, y, f);
    run->kind->engine->eval(run->engine, DAL_EVAL_GAUGE, t, y, &mu);
    for (int i = 0; i < n; i++)
        sum += pi[i] * pi[i] * (0.5 / y[2 * n]) + pi[i] * f[i] + p[i] * v[i];
    return sum + mu * y[4 * n + 1];
}

static void norms(const dal_run *run, double *out)
{
    const int n = run->layout.n;
    out[0] = dal_max_norm(run->persistent + 2 * n + 1, n);
    out[1] = dal_max_norm(run->persistent + 3 * n + 1, n);
    out[2] = fabs(run->persistent[4 * n + 1]);
}

static dal_status error_norm(dal_run *run, const dal_point *at, double *out)
{
    const dal_system *system = run->layout.system;
    double *exact = run->scratch;
    DAL_TRY(system->exact(system, at, exact));
    for (int i = 0; i < system->n; i++) exact[i] -= run->persistent[i];
    *out = dal_max_norm(exact, system->n);
    return DAL_OK;
}

dal_status dal_run_observe(dal_run *run, double *out)
{
    DAL_REQUIRE(run, NULL);
    DAL_REQUIRE(out, NULL);
    const dal_system *system = run->layout.system;
    const dal_point at = dal__here(run);
    double *next = out;
    if (run->quad.engine) return dal__quad_observe(run, out);
    for (int group = 0; group < GROUPS; next += group_size(run, group++)) {
        if (group_size(run, group) == 0) continue;
        if (group == GROUP_D) DAL_TRY(system->constraints(system, &at, next));
        if (group == GROUP_E) DAL_TRY(system->energy(system, &at, next));
        if (group == GROUP_H) *next = hamiltonian(run);
        if (group == GROUP_NORMS) norms(run, next);
        if (group == GROUP_INVARIANTS) DAL_TRY(system->invariant_values(system, &at, next));
        if (group == GROUP_ERROR) DAL_TRY(error_norm(run, &at, next));
    }
    for (double *x = out; x < next; x++) *x += 0.0; /* no -0 */
    return DAL_OK;
}
