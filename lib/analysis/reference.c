/* reference.c - the exact motion of a run, to rounding.
 *
 * dop853 controls its error across kinks and jumps, too, where there is no Taylor series.  Its
 * tolerance is absolute below 1, so it integrates the system in units of its own (scaled.c): the
 * reference is as good in all units.  A run of the spec itself is put at the states that it
 * reaches, and says what its observables are there.
 *
 * The exact motion from the start of a run is known to conserve
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
#include "dalembert_program.h"
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

/* Of its substeps, in units of the system's own. */
static const double tolerance = 1e-16;

struct dal__reference {
    dal_scaled *scaled;
    dal_run *motion;   /* of the scaled system, (q, v, g) */
    dal_run *observed; /* of the spec */
    double *state;     /* [dimension of observed, or of motion] */
};

void dal__reference_free(dal__reference *r)
{
    if (!r) return;
    dal_run_free(r->motion);
    dal_run_free(r->observed);
    dal_scaled_free(r->scaled);
    free(r->state);
    free(r);
}

dal_run *dal__reference_run(dal__reference *r) { return r->observed; }

long long dal__reference_steps(const dal__reference *r)
{
    enum { EVALUATIONS = 12 }; /* of dop853 in a substep */
    return dal_run_evaluations(r->motion) / EVALUATIONS;
}

bool dal__is_on_motion(const dal_run *run)
{
    const int n = dal_run_system(run)->n;
    const double *state = dal_run_state(run);
    if (dal_run_dimension(run) != 4 * n + 2) return true;
    return dal__max_abs(state + 2 * n + 1, (size_t)(2 * n)) == 0.0;
}

dal_status dal__create_reference_run(dal_run **reference, const dal_scaled *scaled,
                                     const dal_run_spec *spec, const dal_run *run, double *state,
                                     dal_error *error)
{
    const double tau = dal_scaled_units(scaled)[0];
    dal_run_spec own = {.system = dal_scaled_system(scaled),
                        .parameters = spec->parameters,
                        .parameter_count = spec->parameter_count,
                        .start_time = dal_run_time(run) / tau,
                        .options = dal_options_default()};
    DAL_TRY(dal_method_parse(&own.method, "dop853", error));
    own.options.space = DAL_PHYSICAL;
    own.options.step = dal_run_step_size(run) / tau;
    own.options.tolerance = tolerance;
    DAL_TRY(dal_run_create(reference, &own, error));
    dal__scaled_from_user(scaled, dal_run_state(run), state);
    return dal_run_set_state(*reference, own.start_time, state, error);
}

dal_status dal__reference_create(dal__reference **reference, const dal_run_spec *spec,
                                 dal_error *error)
{
    const dal_system *s = spec->system;
    dal__reference *r = calloc(1, sizeof *r);
    *reference = NULL;
    if (!r) return dal__memory_error(error);
    r->state = dal__numbers(1, (size_t)(4 * s->n + 2 + s->multipliers));
    dal_status status =
        r->state ? dal_run_create(&r->observed, spec, error) : dal__memory_error(error);
    if (status == DAL_STATUS_OK && !dal__is_on_motion(r->observed))
        status = dal__fail(error, DAL_STATUS_UNSUPPORTED, "p and pi are not 0");
    if (status == DAL_STATUS_OK) status = dal_scaled_create(&r->scaled, spec, error);
    if (status == DAL_STATUS_OK)
        status =
            dal__create_reference_run(&r->motion, r->scaled, spec, r->observed, r->state, error);
    if (status == DAL_STATUS_OK)
        *reference = r;
    else
        dal__reference_free(r);
    return status;
}

dal_status dal__reference_advance(dal__reference *r, long long steps, dal_error *error)
{
    const double tau = dal_scaled_units(r->scaled)[0];
    DAL_TRY(dal_run_advance(r->motion, steps, error));
    const int dimension = dal_run_dimension(r->observed);
    for (int i = 0; i < dimension; i++) r->state[i] = dal_run_state(r->observed)[i];
    dal__scaled_to_user(r->scaled, dal_run_state(r->motion), r->state);
    return dal_run_set_state(r->observed, dal_run_time(r->motion) * tau, r->state, error);
}

/* ---- what it conserves ---- */

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
