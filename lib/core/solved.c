/* solved.c - velocities of a start that are solved from D(q,v,t) = 0, and coordinates from
 * g(q,t) = 0.
 *
 * Newton's method for the velocities named, u, the others being kept:
 *
 *     D_u (u' - u) = -D,
 *
 * with as many columns as names, by elimination with pivots from all rows, each relative to its
 * largest entry; velocities are in the units in which constraints move them.  Where D is linear one
 * step solves it.  Rows remain where the velocities named are fewer than the constraints.  The same
 * with g, g_u for coordinates: g_q are the last rows of D_v. */
#include "core/solved.h"
#include "core/constraint_rows.h"
#include "core/settings.h"
#include "core/vectors.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* A pivot below this fraction of its column's largest entry means that columns are dependent. */
static const double independent = 1e-12;

enum { MAX_STEPS = 200, NAME_SIZE = 128 };

/* The linear equations of a step, a row for each constraint: [columns] entries, one for each
 * velocity, the right-hand side, and the number of the constraint. */
typedef struct newton {
    dal__constraint_rows c;
    const dal_solved *solved; /* [columns] */
    double *x;                /* [n] the velocities or coordinates */
    double *unit;             /* [n] see dal__velocity_units */
    double *matrix;           /* [rows*width] */
    int columns, width;
} newton;

bool dal__is_solved(const dal_solved *solved, int count, int number)
{
    for (int k = 0; k < count; k++)
        if (solved[k].number == number) return true;
    return false;
}

size_t dal__solve_size(const dal_system *s)
{
    const size_t m = (size_t)s->m, n = (size_t)s->n;
    const int most =
        s->solved_velocities > s->solved_coordinates ? s->solved_velocities : s->solved_coordinates;
    return 2 * (m + 2 * m * n) + n + m * ((size_t)most + 2);
}

static const char *name_of(const newton *k, int column, char *buffer)
{
    const int i = k->solved[column].number;
    const char *const prime = k->c.of_coordinates ? "" : "'";
    if (k->c.system->coordinate)
        snprintf(buffer, NAME_SIZE, "%s%s", k->c.system->coordinate[i], prime);
    else
        snprintf(buffer, NAME_SIZE, "q%d%s", i + 1, prime);
    return buffer;
}

/* Reports that a column, before which the equations are triangular, has no pivot. */
static dal_status undetermined(const newton *k, int column, dal_error *error)
{
    const dal_solved *place = &k->solved[column];
    char name[NAME_SIZE], other[NAME_SIZE];
    int row = 0;
    name_of(k, column, name);
    for (int a = 1; a < column; a++)
        if (fabs(k->matrix[a * k->width + column]) > fabs(k->matrix[row * k->width + column]))
            row = a;
    if (column > 0 && k->matrix[row * k->width + column] != 0.0)
        return dal__fail_at(
            error, DAL_STATUS_RANK, place->line, place->column,
            "the start cannot be solved for both %s and %s, which %s "
            "restricts: name fewer %s",
            name_of(k, row, other), name,
            DAL__CONSTRAINT_NAME(k->c.system, (int)k->matrix[row * k->width + k->columns + 1]),
            k->c.of_coordinates ? "coordinates" : "velocities");
    if (k->c.system->properties & DAL_D_LINEAR && !k->c.of_coordinates)
        return dal__fail_at(error, DAL_STATUS_RANK, place->line, place->column,
                            "the start cannot be solved for %s: no constraint restricts it", name);
    return dal__fail_at(error, DAL_STATUS_RANK, place->line, place->column,
                        "the start cannot be solved for %s: no %sconstraint restricts it at the "
                        "first guess %g; give another one",
                        name, k->c.of_coordinates ? "holonomic " : "", k->x[place->number]);
}

/* Fills the rows, each relative to its largest entry. */
static void fill_matrix(const newton *k)
{
    const int n = k->c.system->n;
    dal__velocity_units(n, k->c.rows, k->c.A, k->c.B, k->unit);
    for (int j = 0; j < n; j++)
        if (!(k->unit[j] > 0.0)) k->unit[j] = 1.0;
    for (int a = 0; a < k->c.rows; a++) {
        double scale = 0.0, *row = &k->matrix[a * k->width];
        for (int j = 0; j < k->columns; j++) {
            const int i = k->solved[j].number;
            row[j] = k->c.A[a * n + i] * k->unit[i];
            scale = fmax(scale, fabs(row[j]));
        }
        if (scale == 0.0) scale = 1.0;
        for (int j = 0; j < k->columns; j++) row[j] /= scale;
        row[k->columns] = -k->c.D[a] / scale;
        row[k->columns + 1] = k->c.first + a;
    }
}

/* The row from number j on with the largest entry of column j; -1: they are negligible. */
static int find_pivot(const newton *k, int j)
{
    const int m = k->c.rows, width = k->width;
    double size = 0.0;
    int pivot = j;
    for (int a = 0; a < m; a++) size = fmax(size, fabs(k->matrix[a * width + j]));
    for (int a = j; a < m; a++)
        if (fabs(k->matrix[a * width + j]) > fabs(k->matrix[pivot * width + j])) pivot = a;
    return fabs(k->matrix[pivot * width + j]) > independent * size ? pivot : -1;
}

/* Makes the matrix triangular. */
static dal_status eliminate(const newton *k, dal_error *error)
{
    const int m = k->c.rows, width = k->width;
    double *M = k->matrix;
    for (int j = 0; j < k->columns; j++) {
        const int pivot = find_pivot(k, j);
        if (pivot < 0) return undetermined(k, j, error);
        dal__swap(width, M + j * width, M + pivot * width);
        for (int a = j + 1; a < m; a++) {
            const double factor = M[a * width + j] / M[j * width + j];
            for (int i = j; i <= k->columns; i++) M[a * width + i] -= factor * M[j * width + i];
        }
    }
    return DAL_STATUS_OK;
}

/* max |u' - u| of one step, in units. */
static dal_status take_step(newton *k, double *change, dal_error *error)
{
    const int width = k->width, last = k->columns;
    double *M = k->matrix;
    fill_matrix(k);
    DAL_TRY(eliminate(k, error));
    *change = 0.0;
    for (int j = last - 1; j >= 0; j--) {
        const int number = k->solved[j].number;
        double *x = &M[j * width + last], *to = &k->x[number];
        for (int i = j + 1; i < last; i++) *x -= M[j * width + i] * M[i * width + last];
        *x /= M[j * width + j];
        *change = fmax(*change, fabs(*x));
        *to = *to + *x * k->unit[number] + 0.0; /* no -0: see lib/kernel/step.h */
    }
    return DAL_STATUS_OK;
}

/* Whether the system can be solved for what it names. */
static dal_status check_solved(const newton *k, dal_error *error)
{
    const dal_system *s = k->c.system;
    const char *const what = k->c.of_coordinates ? "coordinates" : "velocities";
    bool is_usable = k->columns > 0 && k->columns <= k->c.rows && s->solved;
    for (int j = 0; is_usable && j < k->columns; j++)
        is_usable = k->solved[j].number >= 0 && k->solved[j].number < s->n;
    if (!is_usable)
        return dal__fail(error, DAL_STATUS_ARGUMENT,
                         "%d %s to be solved from %d constraints, of %d %s", k->columns, what,
                         k->c.rows, s->n, what);
    if (s->call.constraint) return DAL_STATUS_OK;
    return dal__fail_at(error, DAL_STATUS_UNSUPPORTED, k->solved[0].line, k->solved[0].column,
                        "the start cannot be solved for %s: the mass matrix has no inverse", what);
}

static dal_status solve_named(newton *k, double *memory, dal_error *error)
{
    const int m = k->c.system->m, n = k->c.system->n, rows = k->c.rows;
    double change = INFINITY, before;
    char name[NAME_SIZE];
    int max = 0;
    if (k->columns == 0) return DAL_STATUS_OK;
    DAL_TRY(check_solved(k, error));
    k->c.out = memory;
    k->c.D = k->c.out + m + 2 * m * n;
    k->c.A = k->c.D + rows;
    k->c.B = k->c.A + rows * n;
    k->unit = k->c.B + rows * n;
    k->matrix = k->unit + n;
    k->width = k->columns + 2;
    for (int i = 0; i < MAX_STEPS; i++) {
        DAL_TRY(dal__evaluate_rows(&k->c, k->c.system->call.constraint, "the start", error));
        max = dal__find_max_abs(k->c.D, rows);
        if (!isfinite(k->c.D[max])) break;
        before = change;
        DAL_TRY(take_step(k, &change, error));
        if (dal__is_converged(change, before, dal__max_in_units(n, k->x, k->unit)))
            return DAL_STATUS_OK;
    }
    return dal__fail_at(error,
                        isfinite(k->c.D[max]) ? DAL_STATUS_INCONSISTENT : DAL_STATUS_NOT_FINITE,
                        k->solved[0].line, k->solved[0].column,
                        "the start cannot be solved for %s%s: no root of %s was found "
                        "from these first guesses, %c%d = %.6g",
                        name_of(k, 0, name), k->columns > 1 ? " and others" : "",
                        DAL__CONSTRAINT_NAME(k->c.system, k->c.first + max),
                        k->c.of_coordinates ? 'C' : 'D', max + 1, k->c.D[max]);
}

dal_status dal__solve_velocities(const dal_system *s, double t, const double *q, double *v,
                                 double *work, double *memory, dal_error *error)
{
    newton k = {.c = {.system = s,
                      .at = {.t = t, .q = q, .v = v, .work = work},
                      .count = s->m,
                      .rows = s->m},
                .solved = s->solved ? s->solved + s->solved_coordinates : NULL,
                .x = v,
                .columns = s->solved_velocities};
    return solve_named(&k, memory, error);
}

dal_status dal__solve_coordinates(const dal_system *s, double t, double *q, const double *v,
                                  double *work, double *memory, dal_error *error)
{
    newton k = {.c = {.system = s,
                      .at = {.t = t, .q = q, .v = v, .work = work},
                      .of_coordinates = true,
                      .first = s->m - DAL__HOLONOMIC_COUNT(s),
                      .count = DAL__HOLONOMIC_COUNT(s),
                      .rows = DAL__HOLONOMIC_COUNT(s)},
                .solved = s->solved,
                .x = q,
                .columns = s->solved_coordinates};
    return solve_named(&k, memory, error);
}

dal_status dal__solve_start(const dal_system *s, double t, double *state, double *work,
                            double *memory, dal_error *error)
{
    DAL_TRY(dal__solve_coordinates(s, t, state, state + s->n, work, memory, error));
    return dal__solve_velocities(s, t, state, state + s->n, work, memory, error);
}
