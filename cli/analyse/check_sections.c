/* check_sections.c - what `dalembert check` examines, section by section.
 *
 * Energy: dE/dt = v.Q + sum_a h_a v.A_a - L_t.  For D_a homogeneous of degree k in v the second
 * term is k h_a D_a, so E is conserved on D = 0 only; an affine D, as on a turntable, need not
 * conserve E at all.
 *
 * Actions: int e/2 |q'' - F|^2 dt is 0 on a solution and positive off it.  int P.X' - H is
 * stationary on a trajectory; discretised at midpoints, it is so to rounding on a trajectory of
 * implicit-midpoint, and on none of another method. */
#include "check_sections.h"
#include "analysis.h"
#include "check_dirac.h"
#include "check_invariants.h"
#include "check_methods.h"
#include "dalembert_action.h"
#include "dalembert_order.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The library's own limit for a consistent start. */
static const double consistent = 1e-10;
/* What comes from differences counts as zero below this. */
static const double zero = 1e-9;

static const char claimed_only[] = ", but the system claims it";
static const char found_only[] = ", but its form does not show it";

/* ---- rates along the motion ---- */

/* max |d/dt of a callback's values| along the motion over some points. */
typedef struct motion_rate {
    double max;
    int points, measured; /* of these, how many gave a value */
    dal_status status;    /* the reason why another gave none */
} motion_rate;

/* Of value i; of all values for i < 0. */
static motion_rate measure_rate(check *c, dal_callback *callback, int values, int i,
                                const dal_point *points, int count)
{
    motion_rate rate = {.points = count};
    for (int k = 0; k < count; k++) {
        const dal_status status =
            dal_evaluator_measure_rate(c->evaluator, callback, values, &points[k], c->values);
        if (!cli_is_ok(status)) {
            rate.status = status;
            continue;
        }
        rate.measured++;
        for (int j = i < 0 ? 0 : i; j < (i < 0 ? values : i + 1); j++)
            rate.max = fmax(rate.max, fabs(c->values[j]));
    }
    return rate;
}

/* limit: infinite where the rate is for information. */
static void check_motion_rate(check *c, const char *what, const motion_rate *rate, double limit)
{
    char extent[64] = "";
    if (rate->measured < rate->points)
        snprintf(extent, sizeof extent, ", at %d of %d points", rate->measured, rate->points);
    if (rate->points == 0)
        check_item(c, CHECK_UNMEASURED, what, "there is no point for it");
    else if (rate->measured == 0)
        check_item(c, CHECK_UNMEASURED, what, "at none of %d points: %s", rate->points,
                   dal_status_text(rate->status));
    else if (isinf(limit))
        check_number(c, CHECK_INFO, what, rate->max, -INFINITY, limit, "%.2g%s", rate->max, extent);
    else
        check_number(c, rate->max <= limit ? CHECK_OK : CHECK_FAIL, what, rate->max, -INFINITY,
                     limit, "%.2g  (at most %.0e)%s", rate->max, limit, extent);
}

/* ---- the start ---- */

/* max |D| relative to sum |A| |v|; NaN where one of them is not finite. */
static double start_defect(check *c)
{
    double *block = c->values, size = 1.0, defect = 0.0;
    if (dal_evaluator_call(c->evaluator, c->system->call.constraint, c->origin.t, c->start,
                           c->start + c->n, NULL, block))
        return NAN;
    for (int a = 0; a < c->m; a++) {
        double sum = 0.0;
        for (int i = 0; i < c->n; i++) sum += fabs(block[c->m + a * c->n + i] * c->start[c->n + i]);
        if (!isfinite(sum) || !isfinite(block[a])) return NAN;
        size = fmax(size, sum);
        defect = fmax(defect, fabs(block[a]));
    }
    return defect / size;
}

static void check_rank(check *c, const char *what, int rank, int full, double pivot)
{
    check_number(c, rank == full ? CHECK_OK : CHECK_FAIL, what, rank, full, full,
                 "%d of %d, smallest pivot %.2g", rank, full, pivot);
}

/* The ranks of A and of W on ker A, at the start of the run in the units of the file. */
static void check_ranks(check *c)
{
    const request_settings *set = &c->simulation->request.set;
    const double *units = dal_scaled_units(c->scaled);
    double *q = cli_calloc(2 * (size_t)c->n, sizeof *q), *v = q + c->n;
    dal_ranks ranks;
    for (int i = 0; i < c->n; i++) {
        q[i] = c->start[i] * units[1 + i];
        v[i] = c->start[c->n + i] * units[1 + i] / units[0];
    }
    const dal_point at = {.t = c->simulation->request.from, .q = q, .v = v};
    const dal_status status =
        dal_model_ranks(c->simulation->model, set->item, set->count, &at, units, &ranks, NULL);
    free(q);
    if (!cli_is_ok(status)) {
        if (status != DAL_STATUS_UNSUPPORTED)
            check_item(c, CHECK_FAIL, "rank of A at the start", "it has no value: %s",
                       dal_status_text(status));
        return;
    }
    check_rank(c, "rank of A at the start", ranks.constraints, c->m, ranks.constraints_pivot);
    if (ranks.mass >= 0 && c->n > c->m)
        check_rank(c, "rank of W on ker A", ranks.mass, c->n - c->m, ranks.mass_pivot);
}

static void check_start(check *c)
{
    static const char points[] = "points about the start";
    const double e = c->start[c->size];
    check_item(c, c->is_regular ? CHECK_OK : CHECK_FAIL, "F at the start", "%s",
               c->is_regular ? "finite" : "not finite: the motion is not determined");
    check_number(c, e != 0.0 && !isnan(e) ? CHECK_OK : CHECK_FAIL, "gauge variable e", e, -INFINITY,
                 INFINITY, "%g", e);
    const check_result found = c->near_count > 0 ? CHECK_OK : CHECK_FAIL;
    if (c->m == 0) {
        check_number(c, found, points, c->near_count, 1, INFINITY, "%d", c->near_count);
        return;
    }
    const double defect = c->system->call.constraint ? start_defect(c) : 0.0;
    if (isnan(defect))
        check_item(c, CHECK_UNMEASURED, "|D| at the start", "D or its derivative is not finite");
    else if (defect > consistent)
        check_number(c, CHECK_FAIL, "|D| at the start", defect, -INFINITY, consistent,
                     "%.2g  (at most %.0e): --consistent moves velocities to D = 0, and 'solve: "
                     "[..]' under start solves those it names",
                     defect, consistent);
    else if (c->system->call.constraint)
        check_bound(c, "|D| at the start", defect, consistent);
    if (!(c->system->properties & DAL_MASS_ON_KERNEL)) { /* else G is 1 */
        int rank = 0;
        double pivot = 0.0;
        const dal_status status =
            dal_evaluator_measure_rank(c->evaluator, &c->origin, &rank, &pivot);
        if (cli_is_ok(status))
            check_rank(c, "rank of G at the start", rank, c->m, pivot);
        else if (status != DAL_STATUS_UNSUPPORTED)
            check_item(c, CHECK_FAIL, "rank of G at the start", "it has no value: %s",
                       dal_status_text(status));
    }
    check_ranks(c);
    check_number(c, found, points, c->near_count, 1, INFINITY, "%d; %d projected to %sD = 0",
                 c->near_count, c->surface_count, c->system->holonomic > 0 ? "g = 0 and " : "");
}

/* ---- constraints ---- */

/* A property that numbers contradict is a fault; one that the system does not state is none. */
static void check_classes(check *c, const dal_constraint_class *d)
{
    const struct {
        unsigned property;
        const char *what;
        bool found;
    } classes[] = {
        {DAL_D_LINEAR, "D affine in v", d->linear},
        {DAL_D_CONSTANT, "D linear, constant coefficients", d->constant},
        {DAL_D_BILINEAR, "D bilinear in (q,v)", d->bilinear},
        {DAL_D_QUADRATIC, "D quadratic in (q,v)", d->quadratic},
    };
    for (size_t k = 0; k < sizeof classes / sizeof classes[0]; k++) {
        const bool claimed = (c->system->properties & classes[k].property) != 0;
        const bool found = classes[k].found;
        const check_result result = !claimed ? CHECK_INFO : found ? CHECK_OK : CHECK_FAIL;
        check_item(c, result, classes[k].what, "%s%s", found ? "yes" : "no",
                   claimed == found ? ""
                   : claimed        ? claimed_only
                                    : found_only);
    }
}

/* What the velocities with D = 0 generate by their brackets: whether D is holonomic. */
static void check_growth(check *c)
{
    static const char what[] = "growth vector of D = 0";
    const request_settings *set = &c->simulation->request.set;
    dal_error error;
    char text[256] = "";
    size_t length = 0;
    dal_growth *g = &c->growth;
    const double *units = dal_scaled_units(c->scaled);
    const dal_status status =
        dal_model_growth(c->simulation->model, set->item, set->count, units, g, &error);
    if (!cli_is_ok(status)) {
        check_item(c, CHECK_INFO, what, "none: %s", error.message);
        return;
    }
    for (int k = 0; k < g->levels && length < sizeof text - 16; k++)
        length += (size_t)snprintf(text + length, sizeof text - length, "%s%d", k > 0 ? ", " : "",
                                   g->rank[k]);
    const int integrable = g->dimension - g->rank[g->levels - 1];
    const char *const space = g->dimension > c->n ? "(t, q)" : "q";
    if (!g->is_complete)
        check_item(c, CHECK_INFO, what, "(%s, ..) on %s: further brackets are too large", text,
                   space);
    else if (g->levels == 1)
        check_item(c, CHECK_INFO, what, "(%s) on %s: integrable, D is holonomic", text, space);
    else if (integrable > 0)
        check_item(c, CHECK_INFO, what,
                   "(%s) on %s: nonholonomic, but %d of %d combinations of D "
                   "are integrable",
                   text, space, integrable, c->m);
    else
        check_item(c, CHECK_INFO, what, "(%s) on %s: nonholonomic, every q is reached", text,
                   space);
}

/* The degrees at two points may differ by this where D is homogeneous: the rest is noise. */
static const double noise_of_degree = 1e-8;

static void check_constraints(check *c)
{
    dal_constraint_class d;
    dal_callback *D = c->system->constraints;
    if (c->m == 0) return;
    const motion_rate on = measure_rate(c, D, c->m, -1, c->surface, c->surface_count);
    const motion_rate off = measure_rate(c, D, c->m, -1, c->near, c->near_count);
    check_motion_rate(c, "dD/dt along F, on D = 0", &on, zero);
    check_motion_rate(c, "dD/dt along F, off D = 0", &off, zero);
    check_growth(c);
    check_integrable_constraints(c);
    double *degree = cli_calloc((size_t)c->m + 1, sizeof *degree);
    const dal_status status =
        dal_evaluator_classify_constraints(c->evaluator, &c->origin, &d, degree);
    if (cli_is_ok(status)) {
        char text[64] = "not homogeneous";
        int written = 0;
        for (int a = 0; d.homogeneous && a < c->m && written < 44; a++)
            written += snprintf(text + written, sizeof text - (size_t)written,
                                "%sD%d of degree %.4g", a > 0 ? ", " : "", a + 1,
                                nearbyint(degree[a] / noise_of_degree) * noise_of_degree + 0.0);
        check_item(c, CHECK_INFO, "homogeneity of D in v", "%s%s", text,
                   d.linear ? "; affine" : "");
        check_classes(c, &d);
        check_preserving(c, d.constant,
                         DAL_PRESERVES_D | (d.bilinear ? DAL_PRESERVES_BILINEAR : 0u) |
                             (d.quadratic ? DAL_PRESERVES_QUADRATIC : 0u));
    } else {
        check_item(c, CHECK_UNMEASURED, "class of D", "%s", dal_status_text(status));
    }
    free(degree);
}

/* ---- energy, invariants, reversal ---- */

static void check_system_energy(check *c)
{
    enum conservation { NOT, ON_D, EXACT };
    static const char *const texts[] = {"not conserved", "conserved on D = 0 only",
                                        "conserved on every level of D"};
    dal_callback *E = c->system->energy;
    const unsigned properties = c->system->properties;
    const motion_rate on = measure_rate(c, E, 1, 0, c->surface, c->surface_count);
    const motion_rate off = measure_rate(c, E, 1, 0, c->near, c->near_count);
    check_motion_rate(c, "|dE/dt| along F, on D = 0", &on, INFINITY);
    if (c->m > 0) check_motion_rate(c, "|dE/dt| along F, off D = 0", &off, INFINITY);
    if (on.measured == 0 || off.measured == 0) {
        check_item(c, CHECK_UNMEASURED, "energy E", "its rates are not known");
        return;
    }
    const enum conservation found = off.max <= zero ? EXACT : on.max <= zero ? ON_D : NOT;
    const enum conservation claimed = properties & DAL_E_EXACT  ? EXACT
                                      : properties & DAL_E_ON_D ? ON_D
                                                                : NOT;
    check_item(c, found >= claimed ? CHECK_OK : CHECK_FAIL, "energy E", "%s%s", texts[found],
               found < claimed   ? ", but the system claims more"
               : found > claimed ? found_only
                                 : "");
}

static void check_energy(check *c)
{
    const dal_system *s = c->system;
    if (s->energy)
        check_system_energy(c);
    else
        check_item(c, CHECK_INFO, "energy E", "none is known: there is no Lagrangian");
    for (int i = 0; i < s->invariants - s->observed; i++) {
        char what[32];
        snprintf(what, sizeof what, "invariant %.20s", s->invariant[i]);
        const motion_rate rate =
            measure_rate(c, s->invariant_values, s->invariants, i, c->surface, c->surface_count);
        check_motion_rate(c, what, &rate, zero);
    }
    check_further_invariants(c);
}

static void check_reversal(check *c)
{
    static const char *const parity[] = {"D(q,-v) = -D(q,v)", "neither even nor odd in v",
                                         "D(q,-v) = +D(q,v)"};
    static const char what[] = "F(q,-v,-t) = F(q,v,t)";
    dal_constraint_class d;
    const dal_status status =
        dal_evaluator_classify_constraints(c->evaluator, &c->origin, &d, NULL);
    if (!cli_is_ok(status) || isnan(d.force_defect)) {
        check_item(c, CHECK_UNMEASURED, what, "%s",
                   dal_status_text(cli_is_ok(status) ? DAL_STATUS_NOT_FINITE : status));
        return;
    }
    check_number(c, CHECK_INFO, what, d.force_defect, -INFINITY, INFINITY, "%s (difference %.2g)",
                 d.reversible ? "yes: reversible" : "no: not reversible", d.force_defect);
    if (c->m > 0) check_item(c, CHECK_INFO, "D under v -> -v", "%s", parity[d.parity + 1]);
}

/* ---- derivatives ---- */

static void add_branch(void *user, const char *what, const char *text)
{
    check_item(user, CHECK_INFO, what, "%s", text);
}

static void check_derivatives(check *c)
{
    static const double limit = 1e-8;
    dal_derivatives max = {NAN, NAN, NAN, NAN, NAN, NAN}, d;
    dal_status failure = DAL_STATUS_OK;
    int points = 0;
    for (int k = 0; k < c->near_count; k++) {
        const dal_status status = dal_evaluator_check_derivatives(c->evaluator, &c->near[k], &d);
        if (!cli_is_ok(status)) {
            failure = status;
            continue;
        }
        points++;
        max.jacobian = fmax(max.jacobian, d.jacobian);
        max.adjoint = fmax(max.adjoint, d.adjoint);
        max.effort = fmax(max.effort, d.effort);
        max.effort_constraint = fmax(max.effort_constraint, d.effort_constraint);
        max.constraint_jacobian = fmax(max.constraint_jacobian, d.constraint_jacobian);
        max.gram = fmax(max.gram, d.gram);
    }
    if (points == 0) {
        check_item(c, CHECK_UNMEASURED, "derivatives", "at none of %d points: %s", c->near_count,
                   c->near_count > 0 ? dal_status_text(failure) : "F is not finite");
        return;
    }
    const struct {
        const char *what;
        double value; /* NaN: there is nothing to compare */
    } items[] = {{"F_q, F_v", max.jacobian},
                 {"F_q^T pi, F_v^T pi of the lift", max.adjoint},
                 {"(pi.K pi)_q, (pi.K pi)_v", max.effort},
                 {"A K = 0", max.effort_constraint},
                 {"A = dD/dv", max.constraint_jacobian},
                 {"symmetry of G = A W^-1 A^T", max.gram}};
    for (size_t k = 0; k < sizeof items / sizeof items[0]; k++)
        if (!isnan(items[k].value)) check_bound(c, items[k].what, items[k].value, limit);
    analysis_list_branches(c->simulation->model, add_branch, c);
}

/* ---- the exact solution ---- */

static bool exact_at(check *c, double t, double *out)
{
    return dal_evaluator_call(c->evaluator, c->system->exact, t, c->start, c->start, NULL, out) ==
           DAL_STATUS_OK;
}

/* The exact solution at t against the motion: max |(q',v') - (v,F)| / max(1, |(v,F)|), with (q',v')
 * by differences of order 8 and increment d; infinite where something has no value. */
static double exact_residual(check *c, double t, double d)
{
    static const double weight[] = {4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};
    const int n = c->n;
    double *x = c->values, *q = x + 2 * n, *v = q + n, *field = v + n, *rate = field + n;
    if (!exact_at(c, t, q) || dal_evaluator_call(c->evaluator, c->system->call.field, t, q, v, NULL,
                                                 field) != DAL_STATUS_OK)
        return INFINITY;
    memset(rate, 0, 2 * (size_t)n * sizeof *rate);
    for (int k = 1; k <= 4; k++)
        for (int side = -1; side <= 1; side += 2) {
            if (!exact_at(c, t + side * k * d, x)) return INFINITY;
            for (int i = 0; i < 2 * n; i++) rate[i] += side * weight[k - 1] * x[i] / d;
        }
    return analysis_distance(rate, v, NULL, 2 * n); /* after v is F */
}

/* Where it has values up to a time; infinite where it has not. */
static double max_exact_residual(check *c, double time)
{
    static const double times[] = {0.125, 0.375, 0.625, 0.875};
    double max = 0.0;
    for (size_t k = 0; k < sizeof times / sizeof times[0]; k++) {
        /* Which increment is best depends on how fast the solution is. */
        double residual = INFINITY;
        for (double d = 0.02; d > 1e-4; d *= 0.5)
            residual = fmin(residual, exact_residual(c, c->origin.t + times[k] * time, d * time));
        max = fmax(max, residual);
    }
    return max;
}

static void check_exact(check *c)
{
    static const char equation[] = "residual of q' = v, v' = F";
    const double t0 = c->origin.t;
    char start[64];
    if (!c->system->exact) return;
    snprintf(start, sizeof start, "exact solution at t = %.6g", c->simulation->request.from);
    const double distance = exact_at(c, t0, c->values)
                                ? analysis_distance(c->values, c->start, NULL, 2 * c->n)
                                : INFINITY;
    if (isinf(distance))
        check_item(c, CHECK_UNMEASURED, start, "it has no value");
    else
        check_number(c, distance <= zero ? CHECK_OK : CHECK_INFO, start, distance, -INFINITY,
                     INFINITY, distance <= zero ? "the start, to %.2g" : "another start, %.2g away",
                     distance);
    double max = INFINITY; /* of a shorter time where the solution soon has no value */
    for (double time = 1.0; isinf(max) && time > 1e-2; time *= 0.25)
        max = max_exact_residual(c, time);
    if (isinf(max))
        check_item(c, CHECK_UNMEASURED, equation, "the solution or F has no value near the start");
    else
        check_bound(c, equation, max, 1e-8);
}

/* ---- actions ---- */

enum { NODES = 61, LIFTED_NODES = 21, MAX_REFINEMENTS = 6 };

typedef struct sampled_path {
    const char *method;
    dal_space space;
    double h, *rows;  /* [count * width] */
    int count, width; /* states; numbers of each that are kept */
} sampled_path;

static bool sample_path(check *c, const sampled_path *path, const double *start)
{
    dal_system smooth = *c->system;
    dal_run_spec spec = {.system = &smooth,
                         .options = dal_options_default(),
                         .parameters = c->simulation->request.set.item,
                         .parameter_count = c->simulation->request.set.count,
                         .start_time = c->origin.t};
    dal_run *run = NULL;
    smooth.events = 0;
    const size_t width = (size_t)path->width;
    spec.options.step = path->h;
    spec.options.space = path->space;
    spec.options.bare = true;
    bool done = dal_method_parse(&spec.method, path->method, NULL) == DAL_STATUS_OK &&
                cli_is_ok(dal_run_create(&run, &spec, NULL)) &&
                dal_run_set_state(run, c->origin.t, start, NULL) == DAL_STATUS_OK;
    for (int k = 0; done && k < path->count; k++) {
        if (k > 0) done = dal_run_step(run, NULL) == DAL_STATUS_OK;
        memcpy(path->rows + (size_t)k * width, dal_run_state(run), width * sizeof *path->rows);
    }
    dal_run_free(run);
    return done;
}

/* The action of a trajectory of gauss8, and of the same with a smooth bump on every coordinate. */
static bool measure_actions(check *c, const sampled_path *path, double *solved, double *perturbed)
{
    const double e = c->start[c->size], pi = acos(-1.0);
    if (!sample_path(c, path, c->start) ||
        !cli_is_ok(dal_evaluator_measure_action(c->evaluator, c->origin.t, path->h, NODES,
                                                path->rows, e, solved)))
        return false;
    for (int k = 0; k < NODES; k++) {
        const double s = sin(pi * k / (NODES - 1));
        for (int i = 0; i < c->n; i++) path->rows[k * c->n + i] += 1e-3 * s * s * s * s;
    }
    return cli_is_ok(dal_evaluator_measure_action(c->evaluator, c->origin.t, path->h, NODES,
                                                  path->rows, e, perturbed));
}

static void check_second_order_action(check *c)
{
    static const char what[] = "action int e/2 |q'' - F|^2 dt";
    double solved = INFINITY, perturbed = 0.0;
    bool done = false;
    sampled_path path = {"gauss8", DAL_PHYSICAL, .h = 0.01, .count = NODES, .width = c->n};
    path.rows = cli_calloc((size_t)NODES * (size_t)c->n, sizeof *path.rows);
    /* With a smaller step where the motion is too fast for the differences. */
    for (int k = 0; k < MAX_REFINEMENTS && !(solved < 1e-9 * perturbed); k++) {
        done |= measure_actions(c, &path, &solved, &perturbed);
        path.h *= 0.25;
    }
    free(path.rows);
    if (done)
        check_number(c, solved < 1e-9 * perturbed ? CHECK_OK : CHECK_FAIL, what, solved, -INFINITY,
                     1e-9 * perturbed, "%.2g; %.2g on a perturbed path", solved, perturbed);
    else
        check_item(c, CHECK_UNMEASURED, what,
                   "gauss8 gives no trajectory, or F is not finite on it");
}

/* From p = 0.1, -0.1, .. and pi likewise, so that p, pi and pi_e change. */
static void check_stationarity(check *c, const char *method, double limit)
{
    double defect = NAN;
    char what[64];
    sampled_path path = {method, DAL_LIFTED, .h = 0.01, .count = LIFTED_NODES,
                         .width = 4 * c->n + 2};
    const size_t width = (size_t)path.width;
    path.rows = cli_calloc((LIFTED_NODES + 1) * width, sizeof *path.rows);
    double *state = path.rows + LIFTED_NODES * width;
    memcpy(state, c->start, (size_t)(c->size + 1) * sizeof *state);
    for (int i = 2 * c->n + 1; i < 4 * c->n + 1; i++) state[i] = i % 2 ? 0.1 : -0.1;
    snprintf(what, sizeof what, "d int P.X' - H, %s", method);
    bool done = false; /* with a smaller step where the motion leaves its domain */
    for (int k = 0; k < MAX_REFINEMENTS && !done; k++) {
        done = sample_path(c, &path, state) &&
               cli_is_ok(dal_evaluator_check_stationarity(c->evaluator, c->origin.t, path.h,
                                                          LIFTED_NODES, path.rows, &defect));
        path.h *= 0.25;
    }
    if (!done)
        check_item(c, CHECK_UNMEASURED, what, "there is no trajectory");
    else if (isinf(limit))
        check_number(c, CHECK_INFO, what, defect, -INFINITY, INFINITY, "%.2g", defect);
    else
        check_bound(c, what, defect, limit);
    free(path.rows);
}

static void check_action(check *c)
{
    const double e = c->start[c->size];
    if (c->system->multipliers > 0 || e == 0.0 || isinf(e)) return;
    check_second_order_action(c);
    if (!c->system->call.adjoint) return;
    check_stationarity(c, "implicit-midpoint", 1e-8);
    check_stationarity(c, "rk4", INFINITY);
}

const struct check_section check_sections[CHECK_SECTIONS] = {
    {"start", check_start},
    {"constraints", check_constraints},
    {"energy and invariants", check_energy},
    {"reversal of the motion", check_reversal},
    {"derivatives against differences", check_derivatives},
    {"exact solution", check_exact},
    {"Dirac's procedure", check_dirac},
    {"actions", check_action},
    {"methods", check_methods},
};
