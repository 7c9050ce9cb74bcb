/* orbit.c - the exact motion from the start of a run, at any time within its steps.
 *
 * It is read from polynomials (exact_motion.c).  Where F has no Taylor series dop853 integrates the
 * system in units of its own, as for error budgets; its steps are the steps of the run, since its
 * polynomials within a step are of a lower order, and every LONG steps the velocities go back to
 * D = 0. */
#include "dynamics/orbit.h"
#include "analysis/reference.h"
#include "analysis/scaled.h"
#include "core/error.h"
#include "core/vectors.h"
#include "dynamics/exact_motion.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LONG = 256 };

struct dal__orbit {
    dal_exact_motion *motion; /* polynomials; or, without them: */
    dal_exact_motion *own;    /* to be freed with this */
    double step;              /* of the user, in units of run */
    dal_scaled *scaled;
    dal_run *run;             /* of dop853 */
    dal_evaluator *evaluator; /* of its system */
    double *state;            /* [size] of the run, in the units of the user */
    int size;                 /* of (q, v) */
    long long last;           /* the step of the user where the run is */
    double start;             /* start time */
    double *out;
};

void dal__orbit_free(dal__orbit *o)
{
    if (!o) return;
    dal_exact_motion_free(o->own);
    dal_run_free(o->run);
    dal_scaled_free(o->scaled);
    dal_evaluator_free(o->evaluator);
    free(o->state);
    free(o);
}

bool dal__orbit_has_series(const dal__orbit *o) { return o->scaled == NULL; }

/* ---- without Taylor series ---- */

static dal_status create_reference(dal__orbit *o, const dal_run_spec *spec, const dal_run *run,
                                   dal_error *error)
{
    o->state = dal__numbers(1, (size_t)o->size);
    if (!o->state) return dal__memory_error(error);
    DAL_TRY(dal_scaled_create_at(&o->scaled, run, error));
    DAL_TRY(dal__create_reference_run(&o->run, o->scaled, spec, run, o->state, error));
    o->start = dal_run_time(o->run);
    o->step = dal_run_step_size(o->run);
    if (dal_run_system(run)->m == 0) return DAL_STATUS_OK;
    return dal__evaluator_of_run(&o->evaluator, o->scaled, run, error);
}

static dal_status copy_state(void *user, dal_run *run)
{
    const dal__orbit *o = user;
    dal__scaled_to_user(o->scaled, dal_run_state(run), o->out);
    return DAL_STATUS_OK;
}

/* Begins again at the state of step number last, with velocities on D = 0. */
static dal_status begin_again(dal__orbit *o, dal_error *error)
{
    const double t = o->start + (double)o->last * o->step;
    memcpy(o->state, dal_run_state(o->run), (size_t)o->size * sizeof *o->state);
    if (o->evaluator && dal_evaluator_project_velocity(o->evaluator, t, o->state,
                                                       o->state + o->size / 2) == DAL_STATUS_MEMORY)
        return dal__memory_error(error); /* else v stays as it is */
    return dal_run_set_state(o->run, t, o->state, error);
}

static dal_status find_state(dal__orbit *o, long long k, double fraction, double *out,
                             dal_error *error)
{
    while (o->last < k) {
        DAL_TRY(dal_run_advance(o->run, 1, error));
        if (++o->last % LONG == 0) DAL_TRY(begin_again(o, error));
    }
    o->out = out;
    if (fraction == 0.0) return copy_state(o, o->run);
    return dal_run_intermediate(o->run, fraction * o->step, copy_state, o, error);
}

/* ---- all ---- */

dal_status dal__orbit_create(dal__orbit **orbit, const dal_run_spec *spec, const dal_run *run,
                             dal_exact_motion *motion, dal_error *error)
{
    dal_status status = DAL_STATUS_OK;
    dal__orbit *o = calloc(1, sizeof *o);
    *orbit = NULL;
    if (!o) return dal__memory_error(error);
    o->size = 2 * dal_run_system(run)->n;
    o->step = dal_run_step_size(run);
    o->motion = motion;
    if (!motion) {
        status = dal__exact_motion_of_run(&o->own, spec, run, 0, error);
        o->motion = o->own;
    }
    if (status == DAL_STATUS_OK && !dal__exact_motion_has_series(o->motion))
        status = create_reference(o, spec, run, error);
    if (status == DAL_STATUS_OK)
        *orbit = o;
    else
        dal__orbit_free(o);
    return status;
}

dal_status dal__orbit_state(dal__orbit *o, long long k, double fraction, double *out,
                            dal_error *error)
{
    if (o->scaled) return find_state(o, k, fraction, out, error);
    const double step = fabs(o->step), from = (double)k * step,
                 time = ((double)k + fraction) * step;
    DAL_TRY(dal__exact_motion_reach(o->motion, from, time, error));
    if (dal__exact_motion_ends_before(o->motion, time)) {
        DAL_TRY(dal__exact_motion_continue(o->motion, &o->own, error));
        o->motion = o->own;
        DAL_TRY(dal__exact_motion_reach(o->motion, from, time, error));
    }
    dal__exact_motion_state(o->motion, time, out);
    return DAL_STATUS_OK;
}
