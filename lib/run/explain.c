/* explain.c - why a step failed: it is stepped once more, the system's answers being watched. */
#include "run/run.h"
#include <dalembert_kernel.h>

static dal_status singular(const dal__cause *cause, double number, dal_error *error)
{
    return dal__error(error, DAL_SINGULAR, 0, 0,
                      "constraint %d became singular near t = %.17g: G = A W^-1 A^T has no inverse",
                      (int)number, cause->t);
}

/* Whether the iteration had run away before the answer ceased to be finite: then the point says
 * nothing about the system. */
static bool ran_away(const dal_run *run, const dal__cause *cause)
{
    const dal__shape *k = &run->shape;
    const double far = 1e8 * (1.0 + dal_max_norm(run->carried, k->n + k->nw));
    return dal_max_norm(cause->q, k->n) > far || dal_max_norm(cause->v, k->nw) > far;
}

/* What the system itself says of the point where its answer was not finite; DAL_OK: nothing. */
static dal_status ask_system(dal_run *run, const dal__cause *cause, dal_error *error)
{
    const dal_system *system = run->shape.system;
    const dal_at at = {cause->t, cause->q, cause->v, NULL, run->work};
    double number = 0.0;
    if (!system->diagnose || ran_away(run, cause)) return DAL_OK;
    const dal_status status = system->diagnose(system, &at, &number);
    if (status == DAL_SINGULAR) return singular(cause, number, error);
    if (status == DAL_SINGULAR_MASS)
        return dal__error(error, status, 0, 0, "the mass matrix became singular near t = %.17g",
                          cause->t);
    return DAL_OK;
}

/* Whether e would pass zero in the step: then a stage may have met it first. */
static bool gauge_crosses(dal_run *run, double t, double h)
{
    if (!run->shape.lifted) return false;
    const double e = run->carried[2 * run->shape.n];
    double mu[2] = {0.0, 0.0};
    for (int i = 0; i < 2; i++)
        if (dal__engine_ask_x1(run->engine, DAL_ASK_GAUGE, t + i * h, run->carried, &mu[i]) !=
            DAL_OK)
            return false;
    return e * (e + h * mu[0]) <= 0.0 || e * (e + h * mu[1]) <= 0.0;
}

static dal_status turned(dal_run *run, const dal__cause *cause, double t, double h,
                         dal_error *error)
{
    const dal_system *system = run->shape.system;
    if (cause->guard)
        return dal__error(error, DAL_SINGULAR, 0, 0, "%s between t = %.17g and %.17g",
                          system->guard ? system->guard[cause->guard - 1]
                                        : "a guard of the constraints changes sign",
                          t, t + h);
    return dal__error(
        error, DAL_SINGULAR, 0, 0,
        "constraint %d became singular between t = %.17g and %.17g: its normal turned "
        "by a right angle or more, so G = A W^-1 A^T vanished on the way",
        cause->constraint, t, t + h);
}

static dal_status unsolved(dal_run *run, double t, double h, dal_error *error)
{
    char name[128];
    return dal__error(error, DAL_NOT_CONVERGED, 0, 0,
                      "the implicit equations of %s did not converge in the step of %g from "
                      "t = %.17g (at most %d iterations); take a smaller step",
                      dal_method_name(&run->shape.method, name, sizeof name), h, t,
                      run->shape.options.iterations);
}

dal_status dal__explain(dal_run *run, double h, dal_status status, dal_error *error)
{
    const dal__shape *k = &run->shape;
    const double t = dal_run_time(run);
    dal__cause cause = {.q = run->point, .v = run->point + k->n};
    dal__engine_trace_x1(run->engine, &cause);
    dal_status again = DAL_OK;
    dal__engine_step_x1(run->engine, h, 1u, &again);
    dal__engine_trace_x1(run->engine, NULL);
    if (status == DAL_GAUGE || (status != DAL_SINGULAR && gauge_crosses(run, t, h)))
        return dal__error(error, DAL_GAUGE, 0, 0,
                          "e reached zero between t = %.17g and %.17g: 1/e is not defined", t,
                          t + h);
    if (cause.guard || cause.constraint) return turned(run, &cause, t, h, error);
    if (cause.not_finite) {
        const dal_status said = ask_system(run, &cause, error);
        if (said != DAL_OK) return said;
    }
    if (status == DAL_NOT_CONVERGED) return unsolved(run, t, h, error);
    if (status == DAL_NOT_FINITE)
        return dal__error(error, status, 0, 0,
                          "a value is not finite in the step of %g from t = %.17g", h, t);
    return dal__error(error, status, 0, 0, "%s in the step of %g from t = %.17g",
                      dal_status_text(status), h, t);
}
