/* consistent.c - velocities on D = 0 by the least change in the mass metric.
 *
 * At v, with A = D_v there, the nearest point to u of the linearised constraints is
 *
 *     v' = u + W^-1 A^T x,    A W^-1 A^T x = -(D + A (u - v)),
 *
 * whose fixed point has W (v - u) = A^T x and D = 0 with A at the solution.  A condition is one
 * more row of A. */
#include "run/consistent.h"
#include <dalembert_kernel.h>
#include <float.h>

/* A pivot of G below this part of its diagonal entry means that rows are dependent. */
static const double independent = 1e-12;

enum { MAX_MOVES = 200 };

/* The rows and their values at the present state, in the scratch of the run: m of D, then that of
 * the condition. */
typedef struct linearised {
    int n, rows;
    double *values; /* [rows] */
    double *A, *B;  /* [rows*n], [n*rows] W^-1 A^T */
    double *G, *x;  /* [rows*rows], [rows] */
    double *given;  /* [n] */
} linearised;

/* Replaces v by v', *change is max |v' - v|; or finds that rows are dependent.  G x = x is solved
 * without exchanges of rows. */
static dal_status move(dal_run *run, const linearised *k, double *change, const char *where,
                       dal_error *error)
{
    const int n = k->n, rows = k->rows;
    double *v = run->persistent + n, *G = k->G, *x = k->x;
    dal_gram(k->A, k->B, rows, n, G);
    for (int a = 0; a < rows; a++) {
        x[a] = -k->values[a];
        for (int i = 0; i < n; i++) x[a] -= k->A[a * n + i] * (k->given[i] - v[i]);
    }
    for (int a = 0; a < rows; a++) {
        double whole = 0.0;
        for (int i = 0; i < n; i++) whole += fabs(k->A[a * n + i] * k->B[i * rows + a]);
        if (!(fabs(G[a * rows + a]) > independent * whole))
            return dal__fail(error, DAL_RANK,
                             "condition %d of the velocities at %s depends on those before it",
                             a + 1, where);
        for (int b = a + 1; b < rows; b++) x[b] -= G[b * rows + a] / G[a * rows + a] * x[a];
        dal_eliminate(G, rows, a);
    }
    for (int a = rows - 1; a >= 0; a--) {
        for (int b = a + 1; b < rows; b++) x[a] -= G[a * rows + b] * x[b];
        x[a] /= G[a * rows + a];
    }
    *change = 0.0;
    for (int i = 0; i < n; i++) {
        double moved = k->given[i];
        for (int a = 0; a < rows; a++) moved += k->B[i * rows + a] * x[a];
        *change = fmax(*change, fabs(moved - v[i]));
        v[i] = moved + 0.0; /* no -0: see lib/kernel/step.h */
    }
    return DAL_OK;
}

dal_status dal__make_consistent(dal_run *run, const dal__condition *condition, const char *where,
                                dal_error *error)
{
    const int n = run->layout.n, m = run->layout.m;
    const double *v = run->persistent + n;
    double *out = run->scratch, change = INFINITY, before;
    const int rows = m + (condition != NULL);
    linearised k = {.n = n, .rows = rows, .values = out + m + 2 * m * n};
    k.A = k.values + rows;
    k.B = k.A + rows * n;
    k.G = k.B + rows * n;
    k.x = k.G + rows * rows;
    k.given = k.x + rows;
    if (k.rows == 0) return DAL_OK;
    if (m > 0 && !run->layout.system->call.constraint)
        return dal__fail(error, DAL_UNSUPPORTED,
                         "velocities cannot be moved to D = 0: the mass matrix has no inverse");
    memcpy(k.given, v, (size_t)n * sizeof *v);
    for (int i = 0; i < MAX_MOVES; i++) {
        const dal_point at = dal__here(run);
        const dal_status status =
            m > 0 ? run->layout.system->call.constraint(run->layout.system, &at, out) : DAL_OK;
        if (status != DAL_OK)
            return dal__fail(error, status, "the constraints cannot be evaluated at %s", where);
        memcpy(k.values, out, (size_t)m * sizeof *out);
        memcpy(k.A, out + m, (size_t)(m * n) * sizeof *out);
        if (condition) k.values[m] = -condition->value;
        for (int j = 0; j < n; j++) {
            for (int a = 0; a < m; a++) k.B[j * rows + a] = out[m + m * n + j * m + a];
            if (!condition) continue;
            k.A[m * n + j] = condition->normal[j];
            k.B[j * rows + m] = condition->lifted[j];
            k.values[m] += condition->normal[j] * v[j];
        }
        before = change;
        DAL_TRY(move(run, &k, &change, where, error));
        const double resolution = DBL_EPSILON * dal_max_norm(v, n);
        if (change <= resolution || (change >= before && change <= 64.0 * resolution))
            return DAL_OK;
    }
    return dal__fail(error, DAL_INCONSISTENT,
                     "no velocities near those of %s satisfy the constraints", where);
}
