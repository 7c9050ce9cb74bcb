/* consistent.c - velocities on D = 0 by the least change in the mass metric.
 *
 * At v, with A = D_v there and W that at the velocities u given, the nearest point to u of the
 * linearised constraints is
 *
 *     v' = u + W^-1 A^T x,    A W^-1 A^T x = -(D + A (u - v)),
 *
 * whose fixed point has W (v - u) = A^T x and D = 0 with A at the solution.  Steps that grow, since
 * D = 0 curves away from u, are damped: along D = 0 the error is multiplied by a number below 1
 * where v is nearest, but that may be below -1.  A condition is one more row of A. */
#include "run/consistent.h"
#include "core/settings.h"
#include "core/vectors.h"
#include <dalembert_kernel.h>
#include <float.h>

/* A pivot of G below this part of its diagonal entry means that rows are dependent. */
static const double independent = 1e-12;
/* The least part of a step that is taken. */
static const double min_damping = 1.0 / 16.0;

enum { MAX_MOVES = 1000 };

dal__linearised dal__linearised_of(dal_run *run, const dal__condition *condition, const char *place)
{
    const dal_system *system = run->layout.system;
    const int n = system->n, rows = system->m + (condition != NULL);
    dal__linearised k = {.system = system,
                         .at = dal__here(run),
                         .v = run->persistent + n,
                         .condition = condition,
                         .place = place,
                         .rows = rows,
                         .D = run->scratch};
    k.A = k.D + rows;
    k.B = k.A + rows * n;
    k.G = k.B + rows * n;
    k.x = k.G + rows * rows;
    k.given = k.x + rows;
    k.out = k.given + n;
    k.unit = k.out + system->m + 2 * system->m * n + 1;
    return k;
}

dal_status dal__linearise(dal__linearised *k, const double *u, dal_error *error)
{
    const dal_system *s = k->system;
    const int m = s->m, n = s->n, rows = k->rows;
    const dal__condition *last = k->condition;
    dal_callback *const callback = u && s->projection ? s->projection : s->call.constraint;
    k->at.pi = u;
    const dal_status status = m > 0 ? callback(s, &k->at, k->out) : DAL_STATUS_OK;
    if (status != DAL_STATUS_OK)
        return dal__fail(error, status, "the constraints cannot be evaluated at %s", k->place);
    memcpy(k->D, k->out, (size_t)m * sizeof *k->D);
    memcpy(k->A, k->out + m, (size_t)(m * n) * sizeof *k->A);
    if (last) k->D[m] = -last->value;
    for (int i = 0; i < n; i++) {
        for (int a = 0; a < m; a++) k->B[i * rows + a] = k->out[m + m * n + i * m + a];
        if (!last) continue;
        k->A[m * n + i] = last->normal[i];
        k->B[i * rows + m] = last->lifted[i];
        k->D[m] += last->normal[i] * k->v[i];
    }
    return DAL_STATUS_OK;
}

dal_status dal__check_mass(const dal__linearised *k, dal_error *error)
{
    const dal_system *system = k->system;
    double number;
    if (!system->diagnose || system->diagnose(system, &k->at, &number) != DAL_STATUS_SINGULAR_MASS)
        return DAL_STATUS_OK;
    return dal__fail(error, DAL_STATUS_SINGULAR_MASS, "%s is singular at %s",
                     dal__mass_words(system), k->place);
}

void dal__constraint_sizes(dal__linearised *k, const double *scales)
{
    const int n = k->system->n;
    double *energy = k->given, kinetic = 0.0; /* E, E_q, E_v = W v, and n more */
    dal_callback *const energy_normal = k->system->call.energy_normal;
    if (!energy_normal || energy_normal(k->system, &k->at, energy) != DAL_STATUS_OK) kinetic = NAN;
    for (int i = 0; i < n && !isnan(kinetic); i++) kinetic += fabs(k->v[i] * energy[1 + n + i]);
    for (int a = 0; a < k->rows; a++) {
        double G = 0.0, sum = 0.0;
        for (int i = 0; i < n; i++) G += k->A[a * n + i] * k->B[i * k->rows + a];
        for (int i = 0; i < n; i++) sum += fabs(k->A[a * n + i]);
        const double size = sqrt(fabs(G)) * sqrt(kinetic);
        k->x[a] = isfinite(size) ? size : sum * dal_max_norm(k->v, n);
        if (scales && isfinite(scales[a])) k->x[a] += scales[a];
    }
}

/* The error that row a of G has no pivot; k->out[a] was its entry on the diagonal. */
static dal_status dependent(const dal__linearised *k, int a, double pivot, dal_error *error)
{
    const dal_system *system = k->system;
    const double size = dal__max_abs(k->A + a * system->n, (size_t)system->n);
    DAL_TRY(dal__check_mass(k, error));
    if (a == system->m)
        return dal__fail(error, DAL_STATUS_RANK,
                         "%s changes no velocity that the constraints leave free (pivot %g of G)",
                         k->place, pivot);
    if (size == 0.0)
        return dal__fail(error, DAL_STATUS_RANK,
                         "constraint %d restricts no velocity at %s: its derivatives by the "
                         "velocities are 0",
                         a + 1, k->place);
    if (isinf(size))
        return dal__fail(error, DAL_STATUS_RANK,
                         "constraint %d has infinite derivatives by the velocities at %s", a + 1,
                         k->place);
    if (system->properties & DAL_MASS_ON_KERNEL && isnan(pivot))
        return dal__fail(error, DAL_STATUS_RANK,
                         "the constraints are dependent at %s: constraint %d restricts only "
                         "velocities that others restrict",
                         k->place, a + 1);
    if (size * size < DBL_MIN || isinf(size * size))
        return dal__fail(error, DAL_STATUS_RANK,
                         "constraint %d is badly scaled: its derivatives by the velocities reach "
                         "%g at %s, and G = A W^-1 A^T has their squares; multiply it by a number",
                         a + 1, size, k->place);
    if (!(k->out[a] > 0.0) || a == 0)
        return dal__fail(error, DAL_STATUS_RANK,
                         "constraint %d has %g on the diagonal of G = A W^-1 A^T at %s", a + 1,
                         k->out[a], k->place);
    return dal__fail(
        error, DAL_STATUS_RANK,
        "constraint %d restricts, except for rounding, only velocities that earlier ones "
        "restrict at %s: of its %g on the diagonal of G they leave %.2g",
        a + 1, k->place, k->out[a], pivot);
}

/* Solves G x = x without exchanges of rows. */
static dal_status solve(dal__linearised *k, dal_error *error)
{
    const int rows = k->rows;
    double *G = k->G, *x = k->x, *diagonal = k->out;
    dal_gram(k->A, k->B, rows, k->system->n, G);
    for (int a = 0; a < rows; a++) diagonal[a] = fabs(G[a * rows + a]);
    for (int a = 0; a < rows; a++) {
        const double pivot = G[a * rows + a];
        if (!(fabs(pivot) > independent * diagonal[a] && isfinite(pivot)))
            return dependent(k, a, pivot, error);
        for (int b = a + 1; b < rows; b++) x[b] -= G[b * rows + a] / pivot * x[a];
        dal_eliminate(G, rows, a);
    }
    for (int a = rows - 1; a >= 0; a--) {
        for (int b = a + 1; b < rows; b++) x[a] -= G[a * rows + b] * x[b];
        x[a] /= G[a * rows + a];
    }
    return DAL_STATUS_OK;
}

dal_status dal__linearised_check_rank(dal__linearised *k, dal_error *error)
{
    memset(k->x, 0, (size_t)k->rows * sizeof *k->x);
    return solve(k, error);
}

/* Moves v by the given part of v' - v; *change is max |v' - v|, in units. */
static dal_status move(dal__linearised *k, double part, double *change, dal_error *error)
{
    const int n = k->system->n, rows = k->rows;
    double *v = k->v, *x = k->x;
    dal__velocity_units(n, rows, k->A, k->B, k->unit);
    for (int a = 0; a < rows; a++) {
        x[a] = -k->D[a];
        for (int i = 0; i < n; i++) x[a] -= k->A[a * n + i] * (k->given[i] - v[i]);
    }
    DAL_TRY(solve(k, error));
    *change = 0.0;
    for (int i = 0; i < n; i++) {
        double moved = k->given[i];
        for (int a = 0; a < rows; a++) moved += k->B[i * rows + a] * x[a];
        if (k->unit[i] > 0.0) *change = fmax(*change, fabs(moved - v[i]) / k->unit[i]);
        if (part < 1.0) moved = v[i] + part * (moved - v[i]);
        v[i] = moved + 0.0; /* no -0: see lib/kernel/step.h */
    }
    return DAL_STATUS_OK;
}

dal_status dal__make_consistent(dal__linearised *k, dal_error *error)
{
    const int n = k->system->n, m = k->system->m;
    double change = INFINITY, before, part = 1.0;
    int max = 0;
    if (k->rows == 0) return DAL_STATUS_OK;
    if (m > 0 && !k->system->call.constraint)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "velocities cannot be moved to D = 0: the mass matrix has no inverse");
    memcpy(k->given, k->v, (size_t)n * sizeof *k->v);
    for (int i = 0; i < MAX_MOVES; i++) {
        DAL_TRY(dal__linearise(k, k->given, error));
        max = dal__find_max_abs(k->D, m);
        if (m > 0 && !isfinite(k->D[max])) break;
        before = change;
        DAL_TRY(move(k, part, &change, error));
        if (dal__is_converged(change, before, dal__max_in_units(n, k->v, k->unit)))
            return DAL_STATUS_OK;
        if (change > before) part = fmax(0.5 * part, min_damping);
    }
    return dal__fail(
        error, isfinite(k->D[max]) ? DAL_STATUS_INCONSISTENT : DAL_STATUS_NOT_FINITE,
        "no velocities near the velocities of %s were found that satisfy constraint %d: "
        "D%d = %.6g",
        k->place, max + 1, max + 1, k->D[max]);
}
