/* solved.c - velocities of a start that are solved from D(q,v,t) = 0.
 *
 * Newton's method for the velocities named, u, the others being kept:
 *
 *     D_u (u' - u) = -D,
 *
 * with as many columns as names, by elimination with pivots from all rows, each relative to its
 * largest entry; velocities are in the units in which constraints move them.  Where D is linear one
 * step solves it.  Rows remain where the velocities named are fewer than the constraints. */
#include "core/solved.h"
#include "core/vectors.h"
#include <math.h>
#include <stdio.h>

/* A pivot below this fraction of its column's largest entry means that columns are dependent. */
static const double independent = 1e-12;

enum { MAX_STEPS = 200, NAME_SIZE = 128 };

/* The linear equations of a step, a row for each constraint: [columns] entries, one for each
 * velocity, the right-hand side, and the number of the constraint. */
typedef struct newton {
    const dal_system *system;
    dal_point at;
    double *v;
    double *D, *A;  /* [m], [m*n] */
    double *unit;   /* [n] see dal__velocity_units */
    double *matrix; /* [m*width] */
    int columns, width;
} newton;

bool dal__is_solved(const dal_solved *solved, int count, int velocity)
{
    for (int k = 0; k < count; k++)
        if (solved[k].velocity == velocity) return true;
    return false;
}

size_t dal__solve_size(const dal_system *s)
{
    const size_t m = (size_t)s->m, n = (size_t)s->n;
    return m + 2 * m * n + n + m * ((size_t)s->solved_velocities + 2);
}

static const char *name_of(const newton *k, int column, char *buffer)
{
    const int i = k->system->solved[column].velocity;
    if (k->system->coordinate)
        snprintf(buffer, NAME_SIZE, "%s'", k->system->coordinate[i]);
    else
        snprintf(buffer, NAME_SIZE, "q%d'", i + 1);
    return buffer;
}

/* Reports that a column, before which the equations are triangular, has no pivot. */
static dal_status undetermined(const newton *k, int column, dal_error *error)
{
    const dal_solved *place = &k->system->solved[column];
    char name[NAME_SIZE], other[NAME_SIZE];
    int row = 0;
    name_of(k, column, name);
    for (int a = 1; a < column; a++)
        if (fabs(k->matrix[a * k->width + column]) > fabs(k->matrix[row * k->width + column]))
            row = a;
    if (column > 0 && k->matrix[row * k->width + column] != 0.0)
        return dal__fail_at(error, DAL_STATUS_RANK, place->line, place->column,
                            "the start cannot be solved for both %s and %s, which constraint %d "
                            "restricts: name fewer velocities",
                            name_of(k, row, other), name,
                            (int)k->matrix[row * k->width + k->columns + 1] + 1);
    if (k->system->properties & DAL_D_LINEAR)
        return dal__fail_at(error, DAL_STATUS_RANK, place->line, place->column,
                            "the start cannot be solved for %s: no constraint restricts it", name);
    return dal__fail_at(error, DAL_STATUS_RANK, place->line, place->column,
                        "the start cannot be solved for %s: no constraint restricts it at the "
                        "first guess %g; give another one",
                        name, k->v[place->velocity]);
}

/* Fills the rows, each relative to its largest entry. */
static void fill_matrix(const newton *k)
{
    const int n = k->system->n, m = k->system->m;
    dal__velocity_units(n, m, k->A, k->A + m * n, k->unit);
    for (int j = 0; j < n; j++)
        if (!(k->unit[j] > 0.0)) k->unit[j] = 1.0;
    for (int a = 0; a < m; a++) {
        double scale = 0.0, *row = &k->matrix[a * k->width];
        for (int j = 0; j < k->columns; j++) {
            const int i = k->system->solved[j].velocity;
            row[j] = k->A[a * n + i] * k->unit[i];
            scale = fmax(scale, fabs(row[j]));
        }
        if (scale == 0.0) scale = 1.0;
        for (int j = 0; j < k->columns; j++) row[j] /= scale;
        row[k->columns] = -k->D[a] / scale;
        row[k->columns + 1] = a;
    }
}

/* The row from number j on with the largest entry of column j; -1: they are negligible. */
static int find_pivot(const newton *k, int j)
{
    const int m = k->system->m, width = k->width;
    double size = 0.0;
    int pivot = j;
    if (j == m) return -1;
    for (int a = 0; a < m; a++) size = fmax(size, fabs(k->matrix[a * width + j]));
    for (int a = j; a < m; a++)
        if (fabs(k->matrix[a * width + j]) > fabs(k->matrix[pivot * width + j])) pivot = a;
    return fabs(k->matrix[pivot * width + j]) > independent * size ? pivot : -1;
}

/* Makes the matrix triangular. */
static dal_status eliminate(const newton *k, dal_error *error)
{
    const int m = k->system->m, width = k->width;
    double *M = k->matrix;
    for (int j = 0; j < k->columns; j++) {
        const int pivot = find_pivot(k, j);
        if (pivot < 0) return undetermined(k, j, error);
        for (int i = 0; i < width; i++) {
            const double other = M[j * width + i];
            M[j * width + i] = M[pivot * width + i];
            M[pivot * width + i] = other;
        }
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
        const int velocity = k->system->solved[j].velocity;
        double *x = &M[j * width + last], *v = &k->v[velocity];
        for (int i = j + 1; i < last; i++) *x -= M[j * width + i] * M[i * width + last];
        *x /= M[j * width + j];
        *change = fmax(*change, fabs(*x));
        *v = *v + *x * k->unit[velocity] + 0.0; /* no -0: see lib/kernel/step.h */
    }
    return DAL_STATUS_OK;
}

/* Whether the system can be solved for the velocities it names. */
static dal_status check_solved(const dal_system *s, dal_error *error)
{
    bool is_usable = s->solved_velocities > 0 && s->solved_velocities <= s->m && s->solved;
    for (int j = 0; is_usable && j < s->solved_velocities; j++)
        is_usable = s->solved[j].velocity >= 0 && s->solved[j].velocity < s->n;
    if (!is_usable)
        return dal__fail(error, DAL_STATUS_ARGUMENT,
                         "%d velocities to be solved from %d constraints, of %d velocities",
                         s->solved_velocities, s->m, s->n);
    if (s->call.constraint) return DAL_STATUS_OK;
    return dal__fail_at(error, DAL_STATUS_UNSUPPORTED, s->solved[0].line, s->solved[0].column,
                        "the start cannot be solved for velocities: the mass matrix has no "
                        "inverse");
}

dal_status dal__solve_velocities(const dal_system *s, double t, const double *q, double *v,
                                 double *work, double *memory, dal_error *error)
{
    const int m = s->m, n = s->n;
    newton k = {.system = s,
                .at = {.t = t, .q = q, .v = v, .work = work},
                .v = v,
                .D = memory,
                .A = memory + m};
    double change = INFINITY, before;
    char name[NAME_SIZE];
    int max = 0;
    if (s->solved_velocities == 0) return DAL_STATUS_OK;
    DAL_TRY(check_solved(s, error));
    k.unit = k.A + 2 * m * n;
    k.matrix = k.unit + n;
    k.columns = s->solved_velocities;
    k.width = k.columns + 2;
    for (int i = 0; i < MAX_STEPS; i++) {
        const dal_status status = s->call.constraint(s, &k.at, memory);
        if (status != DAL_STATUS_OK)
            return dal__fail(error, status, "the constraints cannot be evaluated at the start");
        max = dal__find_max_abs(k.D, m);
        if (!isfinite(k.D[max])) break;
        before = change;
        DAL_TRY(take_step(&k, &change, error));
        if (dal__is_converged(change, before, dal__max_in_units(n, v, k.unit)))
            return DAL_STATUS_OK;
    }
    return dal__fail_at(error, isfinite(k.D[max]) ? DAL_STATUS_INCONSISTENT : DAL_STATUS_NOT_FINITE,
                        s->solved[0].line, s->solved[0].column,
                        "the start cannot be solved for %s%s: no root of constraint %d was found "
                        "from these first guesses, D%d = %.6g",
                        name_of(&k, 0, name), k.columns > 1 ? " and others" : "", max + 1, max + 1,
                        k.D[max]);
}
