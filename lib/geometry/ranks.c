/* ranks.c - whether the equations of motion have one solution at a point.
 *
 *     W v' - A^T h = b,   A v' = -c
 *
 * have one where A has rank m and W is regular on ker A, that is Z W Z^T of rank n - m for rows Z
 * that span ker A.  Entries are compared in the given units. */
#include "core/settings.h"
#include "core/vectors.h"
#include "expr/traversal.h"
#include "model/units.h"
#include <math.h>
#include <string.h>

/* Pivots below this fraction of the largest leave F less than six digits. */
static const double rank_tolerance = 1e-10;

/* The matrices at a point, in the units. */
typedef struct matrices {
    int n, m;
    double *A, *W;  /* [m*n], [n*n] */
    double *basis;  /* [n*n] orthonormal rows: of A, then of ker A */
    double *matrix; /* [n*n] whose rank is taken */
    double *work;   /* [n*(n+2)] */
} matrices;

static int rank_of(const matrices *k, int rows, int columns, double *pivot)
{
    return dal__least_squares(rows, columns, k->matrix, NULL, NULL, rank_tolerance, pivot, k->work);
}

/* Continues m orthonormal rows by n - m of them, each from the unit vector with the largest part
 * orthogonal to those before. */
static void complete_basis(const matrices *k)
{
    const int n = k->n;
    for (int row = k->m; row < n; row++) {
        double best = -1.0;
        int axis = 0;
        for (int i = 0; i < n; i++) {
            double rest = 1.0;
            for (int j = 0; j < row; j++) rest -= k->basis[j * n + i] * k->basis[j * n + i];
            if (rest > best) best = rest, axis = i;
        }
        memset(k->basis + row * n, 0, (size_t)n * sizeof *k->basis);
        k->basis[row * n + axis] = 1.0;
        dal__orthonormalise_row(k->basis, row, n);
        dal__orthonormalise_row(k->basis, row, n); /* against rounding */
    }
}

/* The rank of Z W Z^T, each row relative to the root of what its diagonal entry is a sum of: what
 * rounding leaves of W counts as 0. */
static int rank_on_kernel(const matrices *k, double *pivot)
{
    const int n = k->n, size = n - k->m;
    const double *Z = k->basis + k->m * n;
    double *root = k->work;
    for (int a = 0; a < size; a++)
        for (int b = 0; b < size; b++) {
            double sum = 0.0, terms = 0.0;
            for (int i = 0; i < n * n; i++) {
                const double term = Z[a * n + i / n] * k->W[i] * Z[b * n + i % n];
                sum += term;
                terms += fabs(term);
            }
            k->matrix[a * size + b] = sum;
            if (a == b) root[a] = sqrt(terms);
        }
    for (int i = 0; i < size * size; i++) {
        const double scale = root[i / size] * root[i % size];
        if (scale > 0.0) k->matrix[i] /= scale;
    }
    *pivot = 0.0;
    if (dal__max_abs(k->matrix, (size_t)(size * size)) < rank_tolerance) return 0;
    return rank_of(k, size, size, pivot);
}

/* Evaluates A, with rows of a largest entry of 1, and W. */
static bool fill_matrices(const matrices *k, const dal__equations *e, const double *value,
                          const double *units)
{
    const int n = k->n;
    for (int i = 0; i < k->m * n; i++)
        k->A[i] = dal__evaluate(e->graph, e->A[i], value) * units[1 + i % n];
    for (int a = 0; a < k->m; a++) {
        const double size = dal__max_abs(k->A + a * n, (size_t)n);
        for (int i = 0; i < n && size > 0.0; i++) k->A[a * n + i] /= size;
    }
    for (int i = 0; i < n * n; i++)
        k->W[i] = dal__evaluate(e->graph, e->W[i], value) * units[1 + i / n] * units[1 + i % n];
    return isfinite(dal__max_abs(k->A, (size_t)(k->m * n))) &&
           isfinite(dal__max_abs(k->W, (size_t)(n * n)));
}

/* False: out of memory. */
static bool allocate_matrices(dal_model *model, matrices *k)
{
    const size_t n = (size_t)model->equations.n, m = (size_t)model->equations.m;
    *k = (matrices){.n = model->equations.n,
                    .m = model->equations.m,
                    .A = dal__model_allocate(model, m * n + 1, sizeof(double)),
                    .W = dal__model_allocate(model, n * n, sizeof(double)),
                    .basis = dal__model_allocate(model, n * n, sizeof(double)),
                    .matrix = dal__model_allocate(model, n * n, sizeof(double)),
                    .work = dal__model_allocate(model, n * (n + 2), sizeof(double))};
    return !model->out_of_memory;
}

/* The rank of A and, where it is m, of W on ker A. */
static void find_ranks(const matrices *k, dal_ranks *out)
{
    const int n = k->n, m = k->m;
    for (int a = 0; a < m; a++)
        for (int i = 0; i < n; i++) k->matrix[i * m + a] = k->A[a * n + i];
    out->constraints = m > 0 ? rank_of(k, n, m, &out->constraints_pivot) : 0;
    if (out->constraints < m) return;
    memcpy(k->basis, k->A, (size_t)(m * n) * sizeof *k->basis);
    for (int a = 0; a < m; a++) dal__orthonormalise_row(k->basis, a, n);
    complete_basis(k);
    out->mass = n > m ? rank_on_kernel(k, &out->mass_pivot) : 0;
}

dal_status dal_model_ranks(dal_model *model, const dal_setting *parameters, int parameter_count,
                           const dal_point *at, const double *units, dal_ranks *out,
                           dal_error *error)
{
    DAL_REQUIRE(model, error);
    DAL_REQUIRE(out, error);
    DAL_REQUIRE(at && at->q && at->v, error);
    DAL_REQUIRE(model->made, error);
    DAL_TRY(dal__check_settings(parameters, parameter_count, "parameters", error));
    const dal__equations *e = &model->equations;
    const size_t n = (size_t)e->n;
    double *value;
    matrices k;
    *out = (dal_ranks){.mass = -1};
    if (e->vakonomic || e->servo)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         "the motion does not follow Chetaev's rule");
    DAL_TRY(dal__start_values(model, parameters, parameter_count, &value, error));
    units = dal__complete_units(model, units);
    if (!allocate_matrices(model, &k)) return dal__memory_error(error);
    value[e->t] = at->t;
    memcpy(value + e->q, at->q, n * sizeof *value);
    memcpy(value + e->v, at->v, n * sizeof *value);
    const bool is_finite = fill_matrices(&k, e, value, units);
    if (e->graph->status == DAL_STATUS_MEMORY) return dal__memory_error(error);
    if (!is_finite)
        return dal__fail(error, DAL_STATUS_NOT_FINITE, "A or W is not finite at t = %.17g", at->t);
    find_ranks(&k, out);
    return DAL_STATUS_OK;
}
