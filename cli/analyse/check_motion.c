/* check_motion.c - energy, invariants, derivatives and the exact solution of a system.
 *
 * dE/dt = v.Q + sum_a h_a v.A_a: for D_a homogeneous of degree k in v the last is k h_a D_a, so E
 * is conserved on D = 0 alone (weakly), and not at all for affine D such as a turntable's. */
#include "check.h"

#include <math.h>
#include <string.h>

/* A rate by differences counts as zero below this part of the size of what changes. */
static const double zero = 1e-9;

/* ---- energy ---- */

typedef enum conservation { NOT, WEAK, EXACT } conservation;
static const char *const conservation_text[] = {
    "not conserved", "conserved on D = 0 alone (weakly)", "conserved on every level of D"};

static void check_one_energy(check *c)
{
    dal_callback *E = c->system->energy;
    const unsigned properties = c->system->properties;
    const check_rate on = check_measure_rate(c, E, 1, 0, c->surface, c->surface_count);
    const check_rate off = check_measure_rate(c, E, 1, 0, c->near, c->near_count);
    check_rate_info(c, "|dE/dt| along F, on D = 0", &on);
    if (c->m > 0) check_rate_info(c, "|dE/dt| along F, off D = 0", &off);
    if (on.measured == 0 || off.measured == 0) {
        check_unmeasured(c, "energy E", "its rates are not known");
        return;
    }
    const conservation found = off.most <= zero ? EXACT : on.most <= zero ? WEAK : NOT;
    const conservation claimed = properties & DAL_E_EXACT  ? EXACT
                                 : properties & DAL_E_WEAK ? WEAK
                                                           : NOT;
    check_item(c, found >= claimed ? CHECK_OK : CHECK_FAIL, "energy E", "%s%s",
               conservation_text[found],
               found < claimed   ? ", though the system claims more"
               : found > claimed ? ", though its form does not show it"
                                 : "");
}

void check_energy(check *c)
{
    const dal_system *s = c->system;
    if (s->energy == NULL)
        check_item(c, CHECK_INFO, "energy E", "none is known: there is no Lagrangian");
    else
        check_one_energy(c);
    for (int i = 0; i < s->invariants; i++) {
        char what[32];
        snprintf(what, sizeof what, "invariant %.20s", s->invariant[i]);
        const check_rate rate = check_measure_rate(c, s->invariant_values, s->invariants, i,
                                                   c->surface, c->surface_count);
        check_rate_bound(c, what, &rate, zero);
    }
}

/* ---- derivatives ---- */

void check_derivatives(check *c)
{
    static const double limit = 1e-8;
    dal_derivatives worst = {NAN, NAN, NAN, NAN}, d;
    dal_status status = DAL_OK;
    int points = 0;
    for (int k = 0; k < c->near_count; k++) {
        const dal_status here = dal_measure_derivatives(c->probe, &c->near[k], &d);
        if (!cli_is_ok(here)) {
            status = here;
            continue;
        }
        points++;
        worst.jacobian = fmax(worst.jacobian, d.jacobian);
        worst.adjoint = fmax(worst.adjoint, d.adjoint);
        worst.normal = fmax(worst.normal, d.normal);
        worst.gram = fmax(worst.gram, d.gram);
    }
    if (points == 0) {
        check_unmeasured(c, "derivatives", "at none of %d points: %s", c->near_count,
                         c->near_count > 0 ? dal_status_text(status) : "F is not finite");
        return;
    }
    const struct {
        const char *what;
        double value; /* NaN: there is nothing to compare */
    } items[] = {{"F_q, F_v", worst.jacobian},
                 {"F_q^T pi, F_v^T pi of the lift", worst.adjoint},
                 {"A = dD/dv", worst.normal},
                 {"symmetry of G = A W^-1 A^T", worst.gram}};
    for (size_t k = 0; k < sizeof items / sizeof items[0]; k++)
        if (!isnan(items[k].value)) check_bound(c, items[k].what, items[k].value, limit);
}

/* ---- the exact solution ---- */

enum { EXACT_TIMES = 4 };
static const double exact_time[EXACT_TIMES] = {0.125, 0.375, 0.625, 0.875};

typedef struct solution {
    check *c;
    double t, *x; /* the exact q, v at some time */
    double *held; /* the same at time t; then their rates and F, each [2n] */
} solution;

static int exact_at(solution *w, double t, double *out)
{
    const dal_system *s = w->c->system;
    return dal_probe_call(w->c->probe, s->exact, t, w->c->start, w->c->start, NULL, out) == DAL_OK;
}

/* d/dt of (q, v), order 8 with the increment d. */
static int differentiate(solution *w, double d, double *rate)
{
    static const double weight[] = {4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};
    int count = 2 * w->c->n;
    memset(rate, 0, (size_t)count * sizeof *rate);
    for (int k = 1; k <= 4; k++) {
        for (int side = -1; side <= 1; side += 2) {
            if (!exact_at(w, w->t + side * k * d, w->x)) return 0;
            for (int i = 0; i < count; i++) rate[i] += side * weight[k - 1] * w->x[i] / d;
        }
    }
    return 1;
}

/* Largest |(q', v') - (v, F)| relative to the size of either. */
static double residual(solution *w, double d)
{
    int n = w->c->n;
    double *rate = w->held + 2 * n, *field = rate + 2 * n, most = 0.0;
    if (!exact_at(w, w->t, w->held) || !differentiate(w, d, rate)) return INFINITY;
    if (dal_probe_call(w->c->probe, w->c->system->call.field, w->t, w->held, w->held + n, NULL,
                       field) != DAL_OK)
        return INFINITY;
    for (int i = 0; i < 2 * n; i++) {
        double expected = i < n ? w->held[n + i] : field[i - n];
        double gap = fabs(rate[i] - expected) / fmax(1.0, fabs(expected));
        most = gap <= most ? most : isnan(gap) ? INFINITY : gap;
    }
    return most;
}

/* The smallest residual over increments: which is best depends on how fast the solution is. */
static double best_residual(solution *w)
{
    double least = INFINITY;
    for (double d = 0.02; d > 1e-4; d *= 0.5) least = fmin(least, residual(w, d));
    return least;
}

/* NaN where the solution has no value. */
static double start_distance(check *c, const double *exact)
{
    double most = 0.0;
    for (int i = 0; i < 2 * c->n; i++) {
        const double gap = fabs(exact[i] - c->start[i]) / fmax(1.0, fabs(c->start[i]));
        if (!(gap <= most)) most = gap;
        if (isnan(gap)) return NAN;
    }
    return most;
}

static void check_residual(check *c, solution *w)
{
    static const char what[] = "residual of q' = v, v' = F, t < 1";
    double worst = 0.0;
    for (int k = 0; k < EXACT_TIMES; k++) {
        w->t = exact_time[k];
        const double residual = best_residual(w);
        if (isinf(residual)) {
            check_unmeasured(c, what, "the solution or F has no value near t = %g", w->t);
            return;
        }
        worst = fmax(worst, residual);
    }
    check_bound(c, what, worst, 1e-8);
}

void check_exact(check *c)
{
    static const char what[] = "exact solution at t = 0";
    solution w = {.c = c, .x = c->values, .held = c->values + 2 * c->n};
    if (c->system->exact == NULL) return;
    const double distance = exact_at(&w, 0.0, w.x) ? start_distance(c, w.x) : NAN;
    if (isnan(distance))
        check_unmeasured(c, what, "it has no value");
    else
        check_item(c, distance <= zero ? CHECK_OK : CHECK_INFO, what,
                   distance <= zero ? "the start, to %.2g" : "another start, %.2g away", distance);
    check_residual(c, &w);
}
