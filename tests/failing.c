/* failing.c - a system of which one call fails. */
#include "failing.h"

#include <stddef.h>
#include <string.h>

#define MISLEADING 1e6 /* what a callback that fails leaves, which nothing may use */

static dal_system original, original_quad; /* their callbacks */
static dal_system quad;
static long calls, failing, last_failing;
static const char *failed;
static const char *const *counted;
static dal_branches branches;

void failing_begin(long call, long last)
{
    calls = 0;
    failing = call;
    last_failing = last;
}

/* Counts a call. */
static bool fails(void)
{
    calls++;
    return failing <= calls && calls <= last_failing;
}

static bool counts(const char *name)
{
    if (!counted) return true;
    for (const char *const *k = counted; *k; k++)
        if (strcmp(*k, name) == 0) return true;
    return false;
}

long failing_calls(void) { return calls; }
const char *failing_name(void) { return failed; }

#define MEMBERS(MEMBER)                                                                            \
    MEMBER(call.field, field)                                                                      \
    MEMBER(call.adjoint, adjoint)                                                                  \
    MEMBER(call.effort, effort)                                                                    \
    MEMBER(call.jacobian, jacobian)                                                                \
    MEMBER(call.constraint, constraint)                                                            \
    MEMBER(call.energy_normal, energy_normal)                                                      \
    MEMBER(call.gauge, gauge)                                                                      \
    MEMBER(call.gauge_gradient, gauge_gradient)                                                    \
    MEMBER(call.guards, guards)                                                                    \
    MEMBER(call.blocks, blocks)                                                                    \
    MEMBER(call.potential, potential)                                                              \
    MEMBER(call.correction, correction)                                                            \
    MEMBER(call.enforcement, enforcement)                                                          \
    MEMBER(call.reaction, reaction)                                                                \
    MEMBER(call.constraint_value, constraint_value)                                                \
    MEMBER(prepare, prepare)                                                                       \
    MEMBER(start, start)                                                                           \
    MEMBER(call.holonomic, holonomic)                                                              \
    MEMBER(call.position, position)                                                                \
    MEMBER(constraints, constraints)                                                               \
    MEMBER(energy, energy)                                                                         \
    MEMBER(invariant_values, invariant_values)                                                     \
    MEMBER(reactions, reactions)                                                                   \
    MEMBER(equation_values, equation_values)                                                       \
    MEMBER(projection, projection)                                                                 \
    MEMBER(event_values, event_values)                                                             \
    MEMBER(event_rates, event_rates)                                                               \
    MEMBER(event_states, event_states)                                                             \
    MEMBER(event_normals, event_normals)
#define FAIL(member, name)                                                                         \
    static dal_status fail_##name(const dal_system *system, const dal_point *at, double *out)      \
    {                                                                                              \
        if (counts(#name) && fails()) {                                                            \
            failed = #name;                                                                        \
            if (out) out[0] = MISLEADING;                                                          \
            return DAL_STATUS_IO;                                                                  \
        }                                                                                          \
        return (system == &quad ? &original_quad : &original)->member(system, at, out);            \
    }
MEMBERS(FAIL)
FAIL(branches->values, branch_values)
FAIL(branches->rates, branch_rates)
#undef FAIL

#define NAME(member, name) #name,
const char *const failing_callbacks[] = {MEMBERS(NAME) NULL};
#undef NAME

static void wrap(dal_system *copy, const dal_system *system)
{
#define WRAP(member, name)                                                                         \
    if (system->member) copy->member = fail_##name;
    MEMBERS(WRAP)
#undef WRAP
}

dal_system failing_system(const dal_system *system, const char *const *names)
{
    dal_system copy = *system;
    original = *system;
    counted = names;
    copy.wide4 = copy.wide8 = NULL;
    copy.extended = NULL;
    copy.series = NULL;
    copy.scales = copy.reaction_scales = NULL;
    copy.diagnose = NULL;
    wrap(&copy, system);
    if (system->quad) {
        quad = original_quad = *system->quad;
        wrap(&quad, system->quad);
        copy.quad = &quad;
    }
    if (system->branches) {
        branches = *system->branches;
        branches.values = fail_branch_values;
        branches.rates = fail_branch_rates;
        copy.branches = &branches;
    }
    return copy;
}
