/* start.c - parameters and start of a run: set by name, completed by the system, checked; and a
 * parameter set between steps.
 *
 * A start is consistent when |g_j| and |D_a| are at most 1e-10 of their sizes, and its constraints
 * are independent (run/consistent.h). */
#include "run/start.h"
#include "core/error.h"
#include "core/settings.h"
#include "core/solved.h"
#include "core/vectors.h"
#include "dalembert_program.h"
#include "run/consistent.h"
#include "run/scales.h"
#include <dalembert_kernel.h>
#include <math.h>
#include <stdio.h>

#define CONSISTENT 1e-10

static dal_status prepare(dal_run *run, dal_error *error)
{
    const char *name = run->layout.system->name;
    const dal_status status = dal__run_prepare(run);
    if (status == DAL_STATUS_OK) return DAL_STATUS_OK;
    return dal__fail(error, status, "%s cannot be prepared with these parameters",
                     name ? name : "the system");
}

/* Suggests the name nearest to an unknown start name. */
static dal_status unknown_start(const dal_run *run, const char *name, dal_error *error)
{
    char best[DAL__NAME_SIZE] = "", other[DAL__NAME_SIZE];
    for (int i = 0; dal_run_component_name(run, i, other, sizeof other); i++) {
        const char *pair[] = {*best ? best : NULL, other};
        if (dal__nearest_name(name, pair, 2) == other) memcpy(best, other, sizeof best);
    }
    const char *names[] = {*best ? best : NULL};
    return dal__unknown(error, run->layout.lifted ? "start name" : "start name (q, v space)", name,
                        names, 1);
}

static dal_status override(dal_run *run, const dal_setting *settings, int count, dal_error *error)
{
    for (int k = 0; k < count; k++) {
        const int i = dal_run_component_index(run, settings[k].name);
        if (i < 0) return unknown_start(run, settings[k].name, error);
        if (!dal__is_possible(&run->layout, (size_t)i, settings[k].value))
            return dal__fail(error, DAL_STATUS_ARGUMENT, "start %s: %g is not a finite number",
                             settings[k].name, settings[k].value);
        run->persistent[i] = settings[k].value;
    }
    return DAL_STATUS_OK;
}

/* q, v, g and e of the system; momenta are 0. */
static dal_status default_start(dal_run *run, dal_error *error)
{
    const dal__layout *k = &run->layout;
    const int first = k->n + k->nw;
    memset(run->persistent, 0, k->persistent * sizeof *run->persistent);
    run->persistent[dal__at(k, DAL__TIME)] = k->start_time;
    for (size_t i = 0; i < k->lift_memory; i++)
        run->persistent[dal__at_lift(k) + i] = dal__lift_number(k->system, (int)i);
    double *out = run->scratch;
    for (int i = 0; i <= first; i++) out[i] = i == first;
    const dal_point at = dal__here(run);
    if (k->system->start && k->system->start(k->system, &at, out) != DAL_STATUS_OK)
        return dal__fail(error, DAL_STATUS_NOT_FINITE, "%s has no start with these parameters",
                         k->system->name ? k->system->name : "the system");
    memcpy(run->persistent, out, (size_t)first * sizeof *out);
    if (k->lifted) run->persistent[2 * k->n] = out[first];
    return DAL_STATUS_OK;
}

static dal_status check_finite(dal_run *run, dal_error *error)
{
    const int e = run->layout.lifted ? 2 * run->layout.n : -1;
    char name[DAL__NAME_SIZE];
    for (int i = 0; i < run->layout.dim; i++) {
        run->persistent[i] += 0.0; /* no -0: see lib/kernel/step.h */
        if (i == e && isinf(1.0 / run->persistent[i]))
            return dal__fail(error, DAL_STATUS_GAUGE, "start e = %g: e must not vanish",
                             run->persistent[i]);
        if (!dal__is_possible(&run->layout, (size_t)i, run->persistent[i]))
            return dal__fail(error, DAL_STATUS_NOT_FINITE, "start %s is not finite: %g",
                             dal_run_component_name(run, i, name, sizeof name), run->persistent[i]);
    }
    return DAL_STATUS_OK;
}

/* What helps a start that violates row a: names the velocity, or coordinate, that it restricts
 * most, of those that are not solved; "" where all are. */
static const char *suggest(const dal__linearised *k, const dal_run *run, int a, char *hint,
                           size_t size)
{
    const dal_system *s = k->c.system;
    const bool of_q = k->c.of_coordinates;
    const int n = s->n, count = of_q ? s->solved_coordinates : s->solved_velocities;
    const dal_solved *solved = s->solved && !of_q ? s->solved + s->solved_coordinates : s->solved;
    char name[DAL__NAME_SIZE];
    double max = 0.0;
    int best = -1;
    for (int i = 0; i < n; i++) {
        if (dal__is_solved(solved, count, i) || !(fabs(k->c.A[a * n + i]) > max)) continue;
        max = fabs(k->c.A[a * n + i]);
        best = i;
    }
    *hint = 0;
    if (best < 0) return hint;
    dal_run_component_name(run, of_q ? best : n + best, name, sizeof name);
    if (count > 0)
        snprintf(hint, size, "; solve under start can name one more %s, as %.60s",
                 of_q ? "coordinate" : "velocity", name);
    else
        snprintf(hint, size,
                 "; the option consistent moves its %s to %s = 0, and 'solve: [%.60s]' "
                 "under start solves those it names",
                 of_q ? "coordinates" : "velocities", of_q ? "g" : "D", name);
    return hint;
}

/* before: D, or g, of the parameters before a change; NULL: it is the start of the run. */
static dal_status check_consistent(dal_run *run, dal__linearised *k, const double *before,
                                   dal_error *error)
{
    char hint[256] = "";
    const int n = k->c.system->n;
    const double *scales = dal__constraint_scales(run);
    const int positions = k->c.system->m + 1 + k->c.system->invariants;
    dal__constraint_sizes(k, scales && k->c.of_coordinates ? scales + positions : scales);
    for (int i = 0; i < k->c.rows; i++) {
        const double small = CONSISTENT * k->x[i];
        const bool is_regular = isfinite(dal__max_abs(k->c.A + i * n, (size_t)n));
        if (fabs(k->c.D[i]) <= small) continue;
        if (isfinite(k->c.D[i]) && !is_regular) continue; /* dal__linearised_check_rank says so */
        if (before && fabs(k->c.D[i] - before[i]) <= small) continue; /* the drift of a run */
        if (!isfinite(k->c.D[i])) DAL_TRY(dal__check_mass(k, error));
        return dal__fail(
            error, isfinite(k->c.D[i]) ? DAL_STATUS_INCONSISTENT : DAL_STATUS_NOT_FINITE,
            "%s violates %s: %c%d = %.6g%s", k->place,
            DAL__CONSTRAINT_NAME(k->c.system, k->c.first + i), k->c.of_coordinates ? 'C' : 'D',
            i + 1, k->c.D[i], before ? hint : suggest(k, run, i, hint, sizeof hint));
    }
    return DAL_STATUS_OK;
}

static bool has_constraints(const dal_run *run)
{
    return run->layout.m > 0 && run->layout.system->call.constraint;
}

/* Momenta would be cleared by a projection, and pi/e, of another K, pushes v off D and q off g. */
static dal_status check_momenta(const dal_run *run, dal_error *error)
{
    const dal__layout *k = &run->layout;
    const double *const e = run->persistent + 2 * k->n;
    const bool is_projected = dal_method_properties(&k->method) & DAL_PRESERVES_HOLONOMIC;
    bool any = false;
    for (int i = 1; k->lifted && i <= 2 * k->n; i++) any = any || e[i] != 0.0;
    if (!any) return DAL_STATUS_OK;
    if (is_projected)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "p and pi of the start are not 0, and a projection to holonomic "
                         "constraints would clear them: take the option bare, with effort "
                         "constraint");
    if (k->system->effort == DAL_EFFORT_CONSTRAINT || isinf(*e)) return DAL_STATUS_OK;
    return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                     "p and pi of the start are not 0, and K of effort %s would push the motion "
                     "off its holonomic constraints: take effort constraint",
                     dal_effort_name(k->system->effort));
}

/* q on g = 0, by what the start solves and by the option consistent. */
static dal_status check_coordinates(dal_run *run, dal_error *error)
{
    dal__linearised k = dal__linearised_coordinates(run, "the start");
    DAL_TRY(check_momenta(run, error));
    DAL_TRY(dal__solve_coordinates(k.c.system, k.c.at.t, k.v, k.c.at.v, run->work, run->matrices,
                                   error));
    if (run->layout.options.consistent) DAL_TRY(dal__make_consistent(&k, error));
    DAL_TRY(dal__linearise(&k, NULL, error));
    return check_consistent(run, &k, NULL, error);
}

static dal_status check_velocities(dal_run *run, dal_error *error)
{
    dal__linearised k = dal__linearised_of(run, NULL, "the start");
    if (DAL__HOLONOMIC_COUNT(run->layout.system) > 0) DAL_TRY(check_coordinates(run, error));
    DAL_TRY(dal__solve_velocities(run->layout.system, k.c.at.t, k.c.at.q, k.v, run->work,
                                  run->matrices, error));
    if (run->layout.options.consistent) DAL_TRY(dal__make_consistent(&k, error));
    DAL_TRY(dal__linearise(&k, NULL, error));
    DAL_TRY(check_consistent(run, &k, NULL, error));
    return dal__linearised_check_rank(&k, error);
}

static dal_status check_constraints(dal_run *run, dal_error *error)
{
    const bool is_solved_for = run->layout.system->solved_velocities != 0;
    if (!has_constraints(run) && !is_solved_for) return DAL_STATUS_OK;
    DAL_TRY(dal__reserve_matrices(run, error));
    const dal_status status = check_velocities(run, error);
    dal__release_matrices(run);
    return status;
}

/* Whether the exact solution has the start of this run, each number relative to its largest value
 * there and up to 1024 steps later. */
static bool exact_agrees(dal_run *run)
{
    enum { TIMES = 11 };
    const dal__layout *k = &run->layout;
    dal_point at = dal__here(run);
    double *exact = run->scratch, *size = exact + 2 * k->n, *other = size + 2 * k->n;
    if (!k->system->exact || k->system->exact(k->system, &at, exact) != DAL_STATUS_OK) return false;
    for (int i = 0; i < 2 * k->n; i++) size[i] = fabs(run->persistent[i]);
    for (int time = 0; time < TIMES; time++) {
        at.t = dal_run_time(run) + ldexp(k->options.step, time);
        if (k->system->exact(k->system, &at, other) != DAL_STATUS_OK) break;
        for (int i = 0; i < 2 * k->n; i++)
            size[i] = isfinite(other[i]) ? fmax(size[i], fabs(other[i])) : size[i];
    }
    for (int i = 0; i < 2 * k->n; i++)
        if (!(fabs(exact[i] - run->persistent[i]) <= CONSISTENT * size[i])) return false;
    return true;
}

dal_status dal__run_start(dal_run *run, const dal_setting *parameters, int parameter_count,
                          const dal_setting *start, int start_count, const double *added,
                          dal_error *error)
{
    DAL_TRY(dal__set_parameters(run->layout.system, parameters, parameter_count,
                                DAL_STATUS_ARGUMENT, run->work, error));
    DAL_TRY(prepare(run, error));
    DAL_TRY(default_start(run, error));
    DAL_TRY(override(run, start, start_count, error));
    for (int i = 0; added && i < run->layout.dim; i++) run->persistent[i] += added[i];
    DAL_TRY(check_finite(run, error));
    DAL_TRY(check_constraints(run, error));
    run->exact = exact_agrees(run);
    return DAL_STATUS_OK;
}

/* ---- a parameter between steps ---- */

/* Whether the present state has accelerations: W and G are regular there, F is finite. */
static dal_status check_field(dal_run *run, dal_error *error)
{
    const dal_system *system = run->layout.system;
    const dal_point at = dal__here(run);
    double number = 0.0, *f = run->scratch;
    const dal_status fault =
        system->diagnose ? system->diagnose(system, &at, &number) : DAL_STATUS_OK;
    if (fault == DAL_STATUS_SINGULAR_MASS)
        return dal__fail(error, fault, "%s is singular at the present state",
                         dal__mass_words(system));
    if (fault == DAL_STATUS_SINGULAR)
        return dal__fail(error, fault, "%s is singular at the present state",
                         DAL__CONSTRAINT_NAME(system, (int)number - 1));
    if (fault == DAL_STATUS_NOT_FINITE)
        return dal__fail(error, fault,
                         "table %.80s is read outside its points at the present state",
                         system->table[(int)number - 1]);
    const dal_status status = system->call.field(system, &at, f);
    if (status != DAL_STATUS_OK)
        return dal__fail(error, status, "the system fails at the present state");
    for (int i = 0; i < run->layout.nw; i++)
        if (!isfinite(f[i]))
            return dal__fail(error, DAL_STATUS_NOT_FINITE,
                             "acceleration %d is not finite at the present state: %g", i + 1, f[i]);
    return DAL_STATUS_OK;
}

/* Stores D, then g, of the present state; NaN where they cannot be evaluated. */
static void note_constraints(dal_run *run, double *D)
{
    dal__linearised k = dal__linearised_of(run, NULL, "the present state");
    const bool known = has_constraints(run) && dal__linearise(&k, NULL, NULL) == DAL_STATUS_OK;
    for (int i = 0; i < run->layout.m; i++) D[i] = known ? k.c.D[i] : NAN;
    if (DAL__HOLONOMIC_COUNT(run->layout.system) == 0) return;
    k = dal__linearised_coordinates(run, "the present state");
    const bool has = has_constraints(run) && dal__linearise(&k, NULL, NULL) == DAL_STATUS_OK;
    for (int j = 0; j < k.c.rows; j++) D[run->layout.m + j] = has ? k.c.D[j] : NAN;
}

/* DAL_STATUS_INCONSISTENT: the parameters can be used, but D, which was `before`, is not 0 with
 * them. */
static dal_status check_parameters(dal_run *run, const double *before, dal_error *error)
{
    dal__linearised k = dal__linearised_of(run, NULL, "the present state");
    DAL_TRY(prepare(run, error));
    DAL_TRY(check_field(run, error));
    if (!has_constraints(run)) return DAL_STATUS_OK;
    DAL_TRY(dal__linearise(&k, NULL, error));
    DAL_TRY(dal__linearised_check_rank(&k, error));
    DAL_TRY(check_consistent(run, &k, before, error));
    if (DAL__HOLONOMIC_COUNT(k.c.system) == 0) return DAL_STATUS_OK;
    k = dal__linearised_coordinates(run, "the present state");
    DAL_TRY(dal__linearise(&k, NULL, error));
    return check_consistent(run, &k, before + run->layout.m, error);
}

void dal__restart_method(dal_run *run)
{
    const dal__layout *k = &run->layout;
    const size_t first = dal__at(k, DAL__CLOCK_SIZE), changed = dal__at_changed(k);
    memset(run->persistent + first, 0, (changed - first) * sizeof *run->persistent);
    if (DAL__IS_QUAD(run)) dal__quad_push(&run->quad, run->persistent, first);
}

/* The next step is the method's first, and the solution no longer the exact one. */
static void begin_again(dal_run *run)
{
    run->persistent[dal__at_changed(&run->layout)] = 1.0;
    dal__restart_method(run);
}

dal_status dal__change_parameter(dal_run *run, const char *name, double value, dal_error *error)
{
    dal_error reason = {0};
    int i;
    DAL_TRY(dal__find_parameter(run->layout.system, name, &i, error));
    if (!isfinite(value))
        return dal__fail(error, DAL_STATUS_NOT_FINITE, "parameter %s: %g is not a finite number",
                         name, value);
    const double before = run->work[i];
    DAL_TRY(dal__reserve_matrices(run, error));
    note_constraints(run, run->point);
    run->work[i] = value;
    const dal_status status = check_parameters(run, run->point, &reason);
    dal__release_matrices(run);
    if (status == DAL_STATUS_OK || status == DAL_STATUS_INCONSISTENT) {
        begin_again(run);
    } else {
        run->work[i] = before;
        dal__run_prepare(run);
    }
    if (status == DAL_STATUS_OK) return DAL_STATUS_OK;
    return dal__fail(error, status, "parameter %s = %g: %s", name, value, reason.message);
}
