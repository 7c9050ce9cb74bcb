/* conserved.c - what the exact motion from the start of a run is known to conserve.
 *
 *     D                     always: F satisfies dD/dt = 0
 *     E                     where an identity says so (lib/model/energy.c), on every level of D or
 *                           on D = 0, where runs start; and pi/e moves no q
 *     H, |p|, |pi|, |pi_e|  where p = pi = 0, which the lift keeps; H where F does not depend on t
 *     invariants            where dI/dt vanishes at points about the start, as `check` finds: on
 *                           D = 0, in units of the system's own; and pi/e moves no q
 *     reactions, the error  nothing is known */
#include "analysis/reference.h"
#include "analysis/scaled.h"
#include "core/error.h"
#include "core/vectors.h"
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

enum { POINTS = 8, LIFT_OBSERVABLES = 4 };
/* Points are this far from the start, in units of the system; a rate that is 0, in such units. */
static const double neighbourhood = 0.1, no_rate = 1e-9;

typedef struct start {
    const dal_system *system;
    dal_scaled *scaled;
    dal_evaluator *evaluator; /* of the scaled system */
    double t, *state, *point, *rate;
    int size; /* of (q, v, g) */
} start;

/* ---- invariants ---- */

/* Whether their rates are known at a point; then those that are not 0 are not conserved. */
static bool try_point(start *w, dal__random *random, int *conserved)
{
    const dal_system *s = dal_scaled_system(w->scaled);
    for (int i = 0; i < w->size; i++)
        w->point[i] = w->state[i] + neighbourhood * dal__uniform(random);
    const dal_point at = {
        .t = w->t + fabs(dal__uniform(random)), .q = w->point, .v = w->point + s->n};
    if (s->m > 0 && dal_project_velocity(w->evaluator, at.t, w->point, w->point + s->n) != DAL_OK)
        return false;
    if (dal_measure_rate(w->evaluator, s->invariant_values, s->invariants, &at, w->rate) != DAL_OK)
        return false;
    for (int i = 0; i < s->invariants; i++)
        if (!(fabs(w->rate[i]) <= no_rate)) conserved[i] = 0;
    return true;
}

static dal_status find_invariants(start *w, const dal_run_spec *spec, const dal_run *run,
                                  int *conserved)
{
    const dal_system *s = w->system;
    dal__random random = {42};
    int known = 0;
    w->size = 2 * s->n + s->multipliers;
    DAL_TRY(dal_scaled_create(&w->scaled, spec, NULL));
    DAL_TRY(dal_evaluator_create(&w->evaluator, dal_scaled_system(w->scaled), spec->parameters,
                                 spec->parameter_count, NULL));
    w->state = dal__numbers(1, (size_t)(2 * w->size + s->invariants));
    if (!w->state) return DAL_MEMORY;
    w->point = w->state + w->size;
    w->rate = w->point + w->size;
    w->t = dal_run_time(run) / dal_scaled_units(w->scaled)[0];
    dal__scaled_from_user(w->scaled, dal_run_state(run), w->state);
    for (int i = 0; i < s->invariants; i++) conserved[i] = 1;
    for (int k = 0; k < POINTS; k++) known += try_point(w, &random, conserved);
    for (int i = 0; i < s->invariants && known <= POINTS / 2; i++) conserved[i] = 0;
    return DAL_OK;
}

/* ---- all ---- */

dal_status dal__find_conserved(const dal_run_spec *spec, const dal_run *run, int *conserved,
                               dal_error *error)
{
    const dal_system *s = spec->system;
    const int count = dal_run_observables(run), m = s->constraints ? s->m : 0;
    const int has_energy = s->energy != NULL, is_lifted = dal_run_dimension(run) == 4 * s->n + 2;
    const int invariants = m + has_energy + (is_lifted ? LIFT_OBSERVABLES : 0);
    start w = {.system = s};
    dal_status status = DAL_OK;
    const bool is_pushed =
        is_lifted && dal__max_abs(dal_run_state(run) + 2 * s->n + 1, (size_t)(2 * s->n)) > 0.0;
    const bool moves = is_pushed && isfinite(dal_run_state(run)[2 * s->n]); /* q, by pi/e */
    for (int i = 0; i < count; i++) conserved[i] = i < m || (i < invariants && !is_pushed);
    if (has_energy) conserved[m] = !moves && (s->properties & (DAL_E_EXACT | DAL_E_ON_D));
    if (is_lifted && s->properties & DAL_AUTONOMOUS) conserved[m + has_energy] = 1;
    if (s->invariant_values && s->invariants > 0 && !moves) {
        status = find_invariants(&w, spec, run, conserved + invariants);
        if (status != DAL_OK)
            for (int i = 0; i < s->invariants; i++) conserved[invariants + i] = 0;
    }
    free(w.state);
    dal_evaluator_free(w.evaluator);
    dal_scaled_free(w.scaled);
    return status == DAL_MEMORY ? dal__fail(error, DAL_MEMORY, "out of memory") : DAL_OK;
}
