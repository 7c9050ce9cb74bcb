/* restricted.c - the linear system of accelerations and multipliers where W alone may be singular.
 *
 *     W x - A^T h = top,   A x = bottom
 *
 * has one solution where A has full rank and W is regular on ker A, whether W has an inverse or
 * not.  With weights g > 0 of the coordinates,
 *
 *     S = A g^-1 A^T,   N = g^-1 A^T S^-1,   P = 1 - N A        (A N = 1, P projects to ker A)
 *     V = P^T W P + A^T C A,                                    C > 0, diagonal
 *     x = N bottom + y,   V y = P^T (top - W N bottom),   h = N^T (W x - top)
 *
 * V maps ker A to its annihilator as W does, and the range of N to the range of A^T: it is regular
 * exactly where the system is, and positive definite where W is so on ker A.  No coordinate is
 * singled out, so that no chart ends.  y loses the rounding that leads out of ker A.  This is the
 * null-space method with a projector for a basis: M. Benzi, G. H. Golub, J. Liesen, Acta Numerica
 * 14 (2005) 1, section 6, doi:10.1017/S0962492904000212.
 *
 * The weights are the diagonal of W; the weight of a coordinate without a mass balances its entries
 * of A.  All are powers of two from the values at the default start, and so is C. */
#include "model/restricted.h"
#include "core/vectors.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include "model/model.h"
#include <math.h>

/* ---- whether it is needed ---- */

bool dal__mass_may_turn_singular(dal_model *model)
{
    enum { POINTS = 256, MIN_EXPONENT = -4, MAX_EXPONENT = 60 };
    const dal__equations *e = &model->equations;
    const int n = e->n;
    double *point = dal__model_allocate(model, (size_t)(e->symbols + n), sizeof *point);
    double *const value = point + e->symbols;
    dal__node *pivot = dal__model_nodes(model, n, 0);
    dal__random random = {1};
    bool positive = false, negative = false, zero = false, varies = false, jumps = false;
    if (model->out_of_memory) return false;
    dal__list_pivots(e->mass, pivot);
    for (int i = 0; i < n * n; i++) {
        varies |= dal__depends(e->graph, e->W[i], e->parameters, e->symbols);
        jumps |= dal__reaches(e->graph, e->W[i], DAL__JUMPING);
    }
    for (int k = 0; k < POINTS && varies; k++) {
        for (int i = 0; i < e->symbols; i++) {
            const double u = dal__uniform(&random), range = MAX_EXPONENT - MIN_EXPONENT;
            const double far = exp2(MIN_EXPONENT + range * fabs(dal__uniform(&random)));
            point[i] = e->value[i] + (i < e->parameters || k == 0 ? 0.0 : copysign(far, u));
        }
        double det = 1.0;
        if (!dal__evaluate_all(e->graph, pivot, n, point, value)) return false;
        for (int i = 0; i < n; i++) det *= value[i];
        positive |= isfinite(det) && det > 0.0;
        negative |= isfinite(det) && det < 0.0;
        zero |= det == 0.0 && k > 0;
    }
    return (positive && negative) || (jumps && zero);
}

/* ---- weights ---- */

static double magnitude(const dal__equations *e, dal__node node)
{
    return dal__power_of_two(dal__evaluate(e->graph, node, e->value));
}

/* The weight with which coordinate i counts in A as the others do that have one; 0: none has. */
static double balance(const dal__equations *e, const double *A, const double *g, int i)
{
    double best = 0.0;
    for (int a = 0; a < e->m; a++) {
        const double *row = A + a * e->n;
        double size = 0.0;
        for (int j = 0; j < e->n; j++)
            if (g[j] > 0.0) size = fmax(size, row[j] * row[j] / g[j]);
        if (size > 0.0) best = fmax(best, row[i] * row[i] / size);
    }
    return dal__power_of_two(best);
}

/* g[n]; A[m*n] is scratch. */
static void find_weights(const dal__equations *e, const dal__node *W, double *g, double *A)
{
    const int n = e->n;
    for (int i = 0; i < e->m * n; i++) A[i] = magnitude(e, e->A[i]);
    for (int i = 0; i < n; i++) g[i] = magnitude(e, W[i * n + i]);
    for (int i = 0; i < n; i++)
        if (g[i] == 0.0) g[i] = balance(e, A, g, i);
    for (int i = 0; i < n; i++)
        if (g[i] == 0.0) g[i] = balance(e, A, g, i);
    for (int i = 0; i < n; i++)
        if (g[i] == 0.0) g[i] = 1.0;
}

/* ---- factors ---- */

/* S, N and P; lifted[n*m]: A g^-1, column by column. */
static dal_status make_projector(dal_model *model, dal__restricted *r, const double *g,
                                 dal__node *lifted)
{
    const dal__equations *e = &model->equations;
    const int n = e->n, m = e->m;
    int *whose = dal__model_allocate(model, (size_t)m, sizeof *whose);
    for (int a = 0; whose && a < m; a++) whose[a] = a;
    dal__factors_allocate(model, &r->S, m, whose);
    if (model->out_of_memory) return DAL_STATUS_OK;
    for (int i = 0; i < n; i++)
        for (int a = 0; a < m; a++)
            lifted[i * m + a] =
                dal__node_mul(e->graph, dal__number(e->graph, 1.0 / g[i]), e->A[a * n + i]);
    for (int a = 0; a < m; a++)
        for (int b = 0; b < m; b++) {
            dal__node *sum = &r->S.matrix[a * m + b];
            *sum = dal__number(e->graph, 0.0);
            for (int i = 0; i < n && b >= a; i++)
                dal__add_product(e->graph, sum, e->A[a * n + i], lifted[i * m + b]);
            if (b < a) *sum = r->S.matrix[b * m + a];
        }
    const dal_status status = dal__factor(model, &r->S);
    if (status == DAL_STATUS_SINGULAR) r->singular = r->S.constraint[r->S.singular] - 1;
    DAL_TRY(status);
    dal__factors_solve(model, &r->S, DAL__SUMS_UNCHANGED, n, lifted, r->N);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            dal__node sum = dal__number(e->graph, 0.0);
            for (int a = 0; a < m; a++)
                dal__add_product(e->graph, &sum, r->N[i * m + a], e->A[a * n + j]);
            r->P[i * n + j] = dal__node_sub(e->graph, dal__number(e->graph, i == j), sum);
        }
    return DAL_STATUS_OK;
}

dal_status dal__restricted_factor(dal_model *model, const dal__node *W, dal__restricted *r)
{
    const dal__equations *e = &model->equations;
    const int n = e->n, m = e->m;
    *r = (dal__restricted){.W = W, .singular = -1};
    r->N = dal__model_nodes(model, n * m, 0);
    r->P = dal__model_nodes(model, n * n, 0);
    dal__node *scratch = dal__model_nodes(model, n * n, 0);
    double *g = dal__model_allocate(model, (size_t)(n + m * n), sizeof *g);
    dal__factors_allocate(model, &r->V, n, NULL);
    if (model->out_of_memory) return DAL_STATUS_OK;
    find_weights(e, W, g, g + n);
    DAL_TRY(make_projector(model, r, g, scratch));
    if (model->out_of_memory) return DAL_STATUS_OK;
    dal__node *V = r->V.matrix, *WP = scratch;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            WP[i * n + j] = dal__number(e->graph, 0.0);
            for (int k = 0; k < n; k++)
                dal__add_product(e->graph, &WP[i * n + j], r->W[i * n + k], r->P[k * n + j]);
        }
    for (int i = 0; i < n; i++)
        for (int j = i; j < n; j++) {
            dal__node sum = dal__number(e->graph, 0.0);
            for (int k = 0; k < n; k++)
                dal__add_product(e->graph, &sum, r->P[k * n + i], WP[k * n + j]);
            for (int a = 0; a < m; a++) {
                const double size = magnitude(e, r->S.given[a * m + a]);
                const dal__node C = dal__number(e->graph, size > 0.0 ? 1.0 / size : 1.0);
                dal__add_product(e->graph, &sum, dal__node_mul(e->graph, C, e->A[a * n + i]),
                                 e->A[a * n + j]);
            }
            V[i * n + j] = V[j * n + i] = sum;
        }
    return dal__factor(model, &r->V);
}

void dal__restricted_record_pivots(dal__equations *e, const dal__restricted *r)
{
    e->pivots = 0;
    dal__record_pivots(e, &r->S, DAL__DIVIDES_MASS | DAL__DIVIDES_MOTION);
    dal__record_pivots(e, &r->V, DAL__DIVIDES_MASS | DAL__DIVIDES_MOTION);
}

/* ---- a right-hand side ---- */

/* x += N u for u [m] */
static void add_lift(const dal__equations *e, const dal__restricted *r, const dal__node *u,
                     dal__node *x)
{
    for (int i = 0; i < e->n; i++)
        for (int a = 0; a < e->m; a++) dal__add_product(e->graph, &x[i], r->N[i * e->m + a], u[a]);
}

/* out = W x - top */
static void apply_mass(const dal__equations *e, const dal__restricted *r, const dal__node *x,
                       const dal__node *top, dal__node *out)
{
    for (int i = 0; i < e->n; i++) {
        out[i] = dal__number(e->graph, 0.0);
        for (int j = 0; j < e->n; j++)
            dal__add_product(e->graph, &out[i], r->W[i * e->n + j], x[j]);
        out[i] = dal__node_sub(e->graph, out[i], top[i]);
    }
}

void dal__restricted_solve(dal_model *model, const dal__restricted *r, const dal__node *top,
                           const dal__node *bottom, dal__node *x, dal__node *h)
{
    const dal__equations *e = &model->equations;
    const int n = e->n, m = e->m;
    const dal__node zero = dal__number(e->graph, 0.0);
    dal__node *rest = dal__model_nodes(model, n, zero), *rhs = dal__model_nodes(model, n, zero);
    dal__node *y = dal__model_nodes(model, n, zero), *out = dal__model_nodes(model, m, zero);
    if (model->out_of_memory) return;
    for (int i = 0; i < n; i++) x[i] = zero;
    add_lift(e, r, bottom, x);
    apply_mass(e, r, x, top, rest);
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < n; k++) dal__add_product(e->graph, &rhs[i], r->P[k * n + i], rest[k]);
        rhs[i] = dal__node_neg(e->graph, rhs[i]);
    }
    dal__factors_solve(model, &r->V, DAL__SUMS_UNCHANGED, 1, rhs, y);
    for (int a = 0; a < m; a++) {
        for (int i = 0; i < n; i++) dal__add_product(e->graph, &out[a], e->A[a * n + i], y[i]);
        out[a] = dal__node_neg(e->graph, out[a]);
    }
    add_lift(e, r, out, y);
    for (int i = 0; i < n; i++) x[i] = dal__node_add(e->graph, x[i], y[i]);
    if (!h) return;
    apply_mass(e, r, x, top, rest);
    for (int a = 0; a < m; a++) {
        h[a] = zero;
        for (int i = 0; i < n; i++) dal__add_product(e->graph, &h[a], r->N[i * m + a], rest[i]);
    }
}

void dal__restricted_directions(dal_model *model, const dal__restricted *r, dal__node *x)
{
    const dal__equations *e = &model->equations;
    const int n = e->n, m = e->m;
    dal__node *zeros = dal__model_nodes(model, n, dal__number(e->graph, 0.0));
    dal__node *unit = dal__model_nodes(model, m, dal__number(e->graph, 0.0));
    dal__node *column = dal__model_nodes(model, n, 0);
    if (model->out_of_memory) return;
    for (int a = 0; a < m; a++) {
        unit[a] = dal__number(e->graph, 1.0);
        dal__restricted_solve(model, r, zeros, unit, column, NULL);
        for (int i = 0; i < n; i++) x[i * m + a] = column[i];
        unit[a] = dal__number(e->graph, 0.0);
    }
}
