/* reference.c - the exact motion of a run, to rounding.
 *
 * dop853 controls its error across kinks and jumps, too, where there is no Taylor series.  Its
 * tolerance is absolute below 1, so it integrates the system in units of its own (scaled.c): the
 * reference is as good in all units.  A run of the spec itself is put at the states that it
 * reaches, and says what its observables are there. */
#include "analysis/reference.h"
#include "analysis/scaled.h"
#include "core/error.h"
#include "core/vectors.h"
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

dal_method dal__library_method(const char *name)
{
    dal_method method;
    (void)dal_method_parse(&method, name, NULL);
    return method;
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
                        .method = dal__library_method("dop853"),
                        .options = dal_options_default()};
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
