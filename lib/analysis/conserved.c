/* conserved.c - which observables the exact motion of a run conserves.
 *
 * From the start of a run it is known to conserve
 *
 *     D                     always: F satisfies dD/dt = 0
 *     E                     where an identity says so (lib/model/energy.c), on every level of D or
 *                           on D = 0, where runs start; and pi/e moves no q
 *     H, |p|, |pi|, |pi_e|  where p = pi = 0, which the lift keeps; H where F does not depend on t
 *     invariants            where dI/dt vanishes at points about the start, as `check` finds: on
 *                           D = 0, in units of the system's own; and pi/e moves no q
 *     reactions, the error  nothing is known */
#include "analysis/conserved.h"
#include "analysis/reference.h"
#include "analysis/scaled.h"
#include "core/error.h"
#include "core/vectors.h"
#include "dalembert_program.h"
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

enum { POINTS = 8 };
/* Points are this far from the start, in units of the system; a rate that is 0, in such units. */
static const double neighbourhood = 0.1, no_rate = 1e-9;

typedef struct start {
    const dal_system *system;
    dal_scaled *scaled;
    dal_evaluator *evaluator; /* of the scaled system */
    double t, *state, *point, *rate;
    int size; /* of (q, v, g) */
} start;

/* Where their rates are known at a point, those that are not 0 are not conserved. */
static dal_status try_point(start *w, dal__random *random, bool *conserved)
{
    const dal_system *s = dal_scaled_system(w->scaled);
    for (int i = 0; i < w->size; i++)
        w->point[i] = w->state[i] + neighbourhood * dal__uniform(random);
    const dal_point at = {
        .t = w->t + fabs(dal__uniform(random)), .q = w->point, .v = w->point + s->n};
    if (s->m > 0)
        DAL_TRY(dal_evaluator_project_velocity(w->evaluator, at.t, w->point, w->point + s->n));
    DAL_TRY(
        dal_evaluator_measure_rate(w->evaluator, s->invariant_values, s->invariants, &at, w->rate));
    for (int i = 0; i < s->invariants; i++)
        if (!(fabs(w->rate[i]) <= no_rate)) conserved[i] = false;
    return DAL_STATUS_OK;
}

static dal_status find_invariants(start *w, const dal_run_spec *spec, const dal_run *run,
                                  bool *conserved)
{
    const dal_system *s = w->system;
    dal__random random = {42};
    int known = 0;
    w->size = 2 * s->n + s->multipliers;
    DAL_TRY(dal_scaled_create(&w->scaled, spec, NULL));
    DAL_TRY(dal_evaluator_create(&w->evaluator, dal_scaled_system(w->scaled), spec->parameters,
                                 spec->parameter_count, NULL));
    w->state = dal__numbers(1, (size_t)(2 * w->size + s->invariants));
    if (!w->state) return DAL_STATUS_MEMORY;
    w->point = w->state + w->size;
    w->rate = w->point + w->size;
    w->t = dal_run_time(run) / dal_scaled_units(w->scaled)[0];
    dal__scaled_from_user(w->scaled, dal_run_state(run), w->state);
    for (int i = 0; i < s->invariants; i++) conserved[i] = true;
    for (int k = 0; k < POINTS; k++) {
        const dal_status status = try_point(w, &random, conserved);
        if (status == DAL_STATUS_MEMORY) return status;
        known += status == DAL_STATUS_OK;
    }
    for (int i = 0; i < s->invariants && known <= POINTS / 2; i++) conserved[i] = false;
    return DAL_STATUS_OK;
}

dal_status dal__find_conserved(const dal_run_spec *spec, const dal_run *run, bool *conserved,
                               dal_error *error)
{
    const dal_system *s = spec->system;
    const bool is_autonomous = s->properties & DAL_AUTONOMOUS;
    int number, invariants = 0;
    start w = {.system = s};
    dal_status status = DAL_STATUS_OK;
    const bool is_pushed = !dal__is_on_motion(run);
    const bool moves = is_pushed && isfinite(dal_run_state(run)[2 * s->n]); /* q, by pi/e */
    for (int i = 0; i < dal_run_observables(run); i++) {
        const dal__observable_kind kind = dal__run_observable_kind(run, i, &number);
        const bool is_hamiltonian = kind == DAL__OBSERVE_LIFT && number == 0;
        conserved[i] = kind == DAL__OBSERVE_D || (kind == DAL__OBSERVE_LIFT && !is_pushed) ||
                       (is_hamiltonian && is_autonomous);
        if (kind == DAL__OBSERVE_E)
            conserved[i] = !moves && (s->properties & (DAL_E_EXACT | DAL_E_ON_D));
        if (kind == DAL__OBSERVE_INVARIANTS && number == 0) invariants = i;
    }
    if (s->invariant_values && s->invariants > 0 && !moves) {
        status = find_invariants(&w, spec, run, conserved + invariants);
        if (status != DAL_STATUS_OK)
            for (int i = 0; i < s->invariants; i++) conserved[invariants + i] = false;
    }
    free(w.state);
    dal_evaluator_free(w.evaluator);
    dal_scaled_free(w.scaled);
    return status == DAL_STATUS_MEMORY ? dal__memory_error(error) : DAL_STATUS_OK;
}
