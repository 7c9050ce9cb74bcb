/* consistent.c - velocities on D = 0 by the least change in the mass metric.
 *
 * At v, with A = D_v there and W that at the velocities u given, the nearest point to u of the
 * linearised constraints is
 *
 *     v' = u + W^-1 A^T x,    A W^-1 A^T x = -(D + A (u - v)),
 *
 * whose fixed point has W (v - u) = A^T x and D = 0 with A at the solution.  Steps that grow, since
 * D = 0 curves away from u, are damped: along D = 0 the error is multiplied by a number below 1
 * where v is nearest, but that may be below -1.  A condition is one more row of A.  The same for
 * coordinates, with g and the rows g_q of A. */
#include "run/consistent.h"
#include "core/settings.h"
#include "core/vectors.h"
#include <dalembert_kernel.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* A pivot of G below this fraction of its diagonal entry means that rows are dependent. */
static const double independent = 1e-12;
/* The least fraction of a step that is taken. */
static const double min_damping = 1.0 / 16.0;

enum { MAX_MOVES = 1000 };

static void place_numbers(dal__linearised *k, double *memory)
{
    const int n = k->c.system->n, m = k->c.system->m, rows = k->c.rows;
    k->c.D = memory;
    k->c.A = k->c.D + rows;
    k->c.B = k->c.A + rows * n;
    k->G = k->c.B + rows * n;
    k->x = k->G + rows * rows;
    k->given = k->x + rows;
    k->c.out = k->given + n;
    k->unit = k->c.out + m + 2 * m * n + 1;
}

#ifndef DAL_MINIMAL
dal_status dal__reserve_matrices(dal_run *run, dal_error *error)
{
    const size_t bytes = run->layout.matrices * sizeof *run->matrices;
    if (run->layout.matrices <= run->layout.scratch) return DAL_STATUS_OK;
    double *const matrices = malloc(bytes);
    if (!matrices) return dal__fail(error, DAL_STATUS_MEMORY, "no %zu bytes for a start", bytes);
    run->matrices = matrices;
    return DAL_STATUS_OK;
}

void dal__release_matrices(dal_run *run)
{
    if (run->matrices != run->scratch) free(run->matrices);
    run->matrices = run->scratch;
}
#endif

dal__linearised dal__linearised_of(dal_run *run, const dal__condition *condition, const char *place)
{
    const dal_system *system = run->layout.system;
    dal__linearised k = {.c = {.system = system,
                               .at = dal__here(run),
                               .count = system->m,
                               .rows = system->m + (condition != NULL)},
                         .v = run->persistent + system->n,
                         .condition = condition,
                         .place = place};
    place_numbers(&k, run->matrices);
    return k;
}

dal__linearised dal__linearised_coordinates(dal_run *run, const char *place)
{
    const dal_system *system = run->layout.system;
    dal__linearised k = {.c = {.system = system,
                               .at = dal__here(run),
                               .of_coordinates = true,
                               .first = system->m - DAL__HOLONOMIC_COUNT(system),
                               .count = DAL__HOLONOMIC_COUNT(system),
                               .rows = DAL__HOLONOMIC_COUNT(system)},
                         .v = run->persistent,
                         .place = place};
    place_numbers(&k, run->matrices);
    return k;
}

dal_status dal__linearise(dal__linearised *k, const double *u, dal_error *error)
{
    const dal_system *s = k->c.system;
    const int m = s->m, n = s->n;
    const dal__condition *last = k->condition;
    const bool has_u = u && !k->c.of_coordinates;
    dal_callback *const callback = has_u && s->projection ? s->projection : s->call.constraint;
    k->c.at.pi = u;
    DAL_TRY(dal__evaluate_rows(&k->c, callback, k->place, error));
    if (last) k->c.D[m] = -last->value;
    for (int i = 0; last && i < n; i++) {
        k->c.A[m * n + i] = last->normal[i];
        k->c.B[i * k->c.rows + m] = last->lifted[i];
        k->c.D[m] += last->normal[i] * k->v[i];
    }
    return DAL_STATUS_OK;
}

dal_status dal__check_mass(const dal__linearised *k, dal_error *error)
{
    const dal_system *system = k->c.system;
    double number;
    if (!system->diagnose ||
        system->diagnose(system, &k->c.at, &number) != DAL_STATUS_SINGULAR_MASS)
        return DAL_STATUS_OK;
    return dal__fail(error, DAL_STATUS_SINGULAR_MASS, "%s is singular at %s",
                     dal__mass_words(system), k->place);
}

void dal__constraint_sizes(dal__linearised *k, const double *scales)
{
    const int n = k->c.system->n;
    double *energy = k->given, kinetic = 0.0; /* E, E_q, E_v = W v, and n more */
    dal_callback *const energy_normal =
        k->c.of_coordinates ? NULL : k->c.system->call.energy_normal;
    const bool are_known = k->c.of_coordinates && scales;
    if (!energy_normal || energy_normal(k->c.system, &k->c.at, energy) != DAL_STATUS_OK)
        kinetic = NAN;
    for (int i = 0; i < n && !isnan(kinetic); i++) kinetic += fabs(k->v[i] * energy[1 + n + i]);
    for (int a = 0; a < k->c.rows; a++) {
        double G = 0.0, sum = 0.0;
        for (int i = 0; i < n; i++) G += k->c.A[a * n + i] * k->c.B[i * k->c.rows + a];
        for (int i = 0; i < n; i++) sum += fabs(k->c.A[a * n + i]);
        const double size = are_known ? 0.0 : sqrt(fabs(G)) * sqrt(kinetic);
        k->x[a] = isfinite(size) ? size : sum * dal_max_norm(k->v, n);
        if (scales && isfinite(scales[a])) k->x[a] += scales[a];
    }
}

/* Lists the rows of which row a, where elimination ended, is a combination, ", constraint 1", and
 * returns how many they are; where there are none the list is left alone.  x is scratch. */
static int list_dependence(const dal__linearised *k, int a, char *list, size_t size)
{
    static const double fraction = 1e-6;
    const int rows = k->c.rows;
    int count = 0;
    size_t length = 0;
    for (int b = a - 1; b >= 0; b--) {
        k->x[b] = k->G[b * rows + a];
        for (int c = b + 1; c < a; c++) k->x[b] -= k->G[b * rows + c] * k->x[c];
        k->x[b] /= k->G[b * rows + b];
    }
    for (int b = 0; b < a; b++) {
        const double share = fabs(k->x[b]) * sqrt(k->c.out[b]);
        if (!(share > fraction * sqrt(k->c.out[a])) || length >= size) continue;
        length += (size_t)snprintf(list + length, size - length, ", %s",
                                   DAL__CONSTRAINT_NAME(k->c.system, k->c.first + b));
        count++;
    }
    return count;
}

/* The error that row a of G has no pivot; k->c.out[a] was its entry on the diagonal. */
static dal_status dependent(const dal__linearised *k, int a, double pivot, dal_error *error)
{
    const dal_system *system = k->c.system;
    const double size = dal__max_abs(k->c.A + a * system->n, (size_t)system->n);
    const char *const name = DAL__CONSTRAINT_NAME(system, k->c.first + a);
    char list[256] = ", earlier ones";
    DAL_TRY(dal__check_mass(k, error));
    if (a == k->c.count)
        return dal__fail(error, DAL_STATUS_RANK,
                         "%s changes no velocity that the constraints leave free (pivot %g of G)",
                         k->place, pivot);
    if (size == 0.0)
        return dal__fail(error, DAL_STATUS_RANK,
                         "%s restricts no velocity at %s: its derivatives by the velocities are 0",
                         name, k->place);
    if (isinf(size))
        return dal__fail(error, DAL_STATUS_RANK,
                         "%s has infinite derivatives by the velocities at %s", name, k->place);
    if (system->properties & DAL_MASS_ON_KERNEL && isnan(pivot))
        return dal__fail(error, DAL_STATUS_RANK,
                         "the constraints are dependent at %s: %s restricts only velocities that "
                         "others restrict",
                         k->place, name);
    if (size * size < DBL_MIN || isinf(size * size))
        return dal__fail(
            error, DAL_STATUS_RANK,
            "%s is badly scaled: its derivatives by the velocities reach %g at %s, and "
            "G = A W^-1 A^T has their squares; multiply it by a number",
            name, size, k->place);
    if (!(k->c.out[a] > 0.0) || a == 0)
        return dal__fail(error, DAL_STATUS_RANK,
                         "%s has %g on the diagonal of G = A W^-1 A^T at %s", name, k->c.out[a],
                         k->place);
    const bool is_one = list_dependence(k, a, list, sizeof list) == 1;
    return dal__fail(
        error, DAL_STATUS_RANK,
        "%s restricts, except for rounding, only velocities that %s restrict%s at %s: of its %g on "
        "the diagonal of G %s %.2g",
        name, list + 2, is_one ? "s" : "", k->place, k->c.out[a],
        is_one ? "it leaves" : "they leave", pivot);
}

/* Solves G x = x without exchanges of rows. */
static dal_status solve(dal__linearised *k, dal_error *error)
{
    const int rows = k->c.rows;
    double *G = k->G, *x = k->x, *diagonal = k->c.out;
    dal_gram(k->c.A, k->c.B, rows, k->c.system->n, G);
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
    memset(k->x, 0, (size_t)k->c.rows * sizeof *k->x);
    return solve(k, error);
}

/* Moves v by the given fraction of v' - v; *change is max |v' - v|, in units. */
static dal_status move(dal__linearised *k, double fraction, double *change, dal_error *error)
{
    const int n = k->c.system->n, rows = k->c.rows;
    double *v = k->v, *x = k->x;
    dal__velocity_units(n, rows, k->c.A, k->c.B, k->unit);
    for (int a = 0; a < rows; a++) {
        x[a] = -k->c.D[a];
        for (int i = 0; i < n; i++) x[a] -= k->c.A[a * n + i] * (k->given[i] - v[i]);
    }
    DAL_TRY(solve(k, error));
    *change = 0.0;
    for (int i = 0; i < n; i++) {
        double moved = k->given[i];
        for (int a = 0; a < rows; a++) moved += k->c.B[i * rows + a] * x[a];
        if (k->unit[i] > 0.0) *change = fmax(*change, fabs(moved - v[i]) / k->unit[i]);
        if (fraction < 1.0) moved = v[i] + fraction * (moved - v[i]);
        v[i] = moved + 0.0; /* no -0: see lib/kernel/step.h */
    }
    return DAL_STATUS_OK;
}

dal_status dal__make_consistent(dal__linearised *k, dal_error *error)
{
    const int n = k->c.system->n, m = k->c.count;
    const char *const moved = k->c.of_coordinates ? "coordinates" : "velocities";
    const char letter = k->c.of_coordinates ? 'C' : 'D';
    double change = INFINITY, before, fraction = 1.0;
    int max = 0;
    if (k->c.rows == 0) return DAL_STATUS_OK;
    if (m > 0 && !k->c.system->call.constraint)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "%s cannot be moved to %s = 0: the mass matrix has no inverse", moved,
                         k->c.of_coordinates ? "g" : "D");
    memcpy(k->given, k->v, (size_t)n * sizeof *k->v);
    for (int i = 0; i < MAX_MOVES; i++) {
        DAL_TRY(dal__linearise(k, k->given, error));
        max = dal__find_max_abs(k->c.D, m);
        if (m > 0 && !isfinite(k->c.D[max])) break;
        before = change;
        DAL_TRY(move(k, fraction, &change, error));
        if (dal__is_converged(change, before, dal__max_in_units(n, k->v, k->unit)))
            return DAL_STATUS_OK;
        if (change > before) fraction = fmax(0.5 * fraction, min_damping);
    }
    return dal__fail(error, isfinite(k->c.D[max]) ? DAL_STATUS_INCONSISTENT : DAL_STATUS_NOT_FINITE,
                     "no %s near the %s of %s were found that satisfy %s: %c%d = %.6g", moved,
                     moved, k->place, DAL__CONSTRAINT_NAME(k->c.system, k->c.first + max), letter,
                     max + 1, k->c.D[max]);
}
