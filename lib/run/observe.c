/* observe.c - the observables of the present state, or of one within the next step, and the names
 * of observables and of state components.  The engine computes them (engine_wide.c). */
#include "run/observe.h"
#include "run/failure.h"
#include <stdio.h>
#include <string.h>

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

char *dal_run_component_name(const dal_run *run, int i, char *buffer, size_t size)
{
    if (!run || !buffer) return NULL;
    return state_name(run->layout.system, run->layout.lifted, i, buffer, size);
}

int dal_run_component_index(const dal_run *run, const char *name)
{
    char other[DAL__NAME_SIZE];
    for (int i = 0; name && dal_run_component_name(run, i, other, sizeof other); i++)
        if (strcmp(other, name) == 0) return i;
    return -1;
}

/* ---- observables ---- */

static int kind_size(const dal_run *run, dal__observable_kind kind)
{
    return dal__observable_count(&run->layout, kind, run->exact);
}

int dal_run_observables(const dal_run *run)
{
    int count = 0;
    for (int kind = 0; run && kind < DAL__OBSERVABLE_KINDS; kind++) count += kind_size(run, kind);
    return count;
}

dal__observable_kind dal__run_observable_kind(const dal_run *run, int i, int *number)
{
    int kind = 0;
    for (; kind < DAL__OBSERVABLE_KINDS && i >= kind_size(run, kind); kind++)
        i -= kind_size(run, kind);
    *number = i;
    return (dal__observable_kind)kind;
}

char *dal_run_observable_name(const dal_run *run, int i, char *buffer, size_t size)
{
    static const char *const lift[] = {"H", "|p|", "|pi|", "|pi_e|"};
    if (!run || !buffer || i < 0) return NULL;
    const dal_system *system = run->layout.system;
    const dal__observable_kind kind = dal__run_observable_kind(run, i, &i);
    if (kind == DAL__OBSERVABLE_KINDS) return NULL;
    if (kind == DAL__OBSERVE_D)
        snprintf(buffer, size, "D%d", i + 1);
    else if (kind == DAL__OBSERVE_LIFT)
        snprintf(buffer, size, "%s", lift[i]);
    else if (kind == DAL__OBSERVE_HOLONOMIC)
        snprintf(buffer, size, "C%d", i + 1);
    else if (kind == DAL__OBSERVE_INVARIANTS)
        snprintf(buffer, size, "%s", system->invariant ? system->invariant[i] : "invariant");
    else if (kind == DAL__OBSERVE_REACTIONS || kind == DAL__OBSERVE_MULTIPLIERS)
        dal__reaction_name(system, kind, i, buffer, size);
    else
        snprintf(buffer, size, "%s", kind == DAL__OBSERVE_E ? "E" : "error");
    return buffer;
}

dal_status dal_run_observe(dal_run *run, double *out)
{
    DAL_REQUIRE(run, NULL);
    DAL_REQUIRE(out, NULL);
    if (DAL__IS_QUAD(run)) return dal__quad_observe(&run->quad, run->exact, out);
    return run->kind->engine->observe(run->engine, run->exact, out);
}

dal_status dal__observe_intermediate(dal_run *run, double h, double size,
                                     dal_status (*observe)(void *user, dal_run *run), void *user,
                                     dal_error *error)
{
    dal__run_back_up(run);
    dal_status status = dal__step_intermediate(run, h, size);
    if (status != DAL_STATUS_OK) return dal__failure_reason(run, size, status, error);
    status = observe(user, run);
    dal__run_revert(run);
    return status;
}
