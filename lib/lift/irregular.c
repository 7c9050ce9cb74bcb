/* irregular.c - constraints whose gradient vanishes wherever they do.
 *
 *     f = 1/2 pi.Q pi, Q semidefinite     f = 0 <=> Q pi = 0, of which rank Q rows are independent
 *     f = sum_i c_i s_i^2, c_i > 0        f = 0 <=> s_i = 0
 *
 * The first is decided by the second derivatives of f and a factorisation of Q at points, the
 * second by the form of f in the graph. */
#include "lift/irregular.h"
#include "core/error.h"
#include "core/vectors.h"
#include "expr/derivative.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include "lift/squares.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double rank_tolerance = 1e-9;

/* ---- quadratic forms ----------------------------------------------------------------------- */

/* f as a function of momenta pi: its gradient and Hessian Q. */
typedef struct form {
    int size, *symbol;       /* [size] of the momenta */
    dal__node *gradient, *Q; /* [size], [size*size] */
    int rank, *row;          /* [rank] rows of Q that are independent */
} form;

/* Whether f is a quadratic form in the momenta that it contains: Q is free of them, and f and its
 * gradient vanish with them. */
static bool is_quadratic(const dal__surface *s, dal__node f, form *w)
{
    dal__graph *graph = s->theory->graph;
    dal__node *by = w->Q, *value; /* before it is Q */
    for (int i = 0; i < s->theory->pairs; i++) {
        const int symbol = s->theory->variable[s->theory->pairs + i];
        if (dal__depends(graph, f, symbol, symbol + 1)) w->symbol[w->size++] = symbol;
    }
    if (w->size == 0) return false;
    dal__gradient(graph, f, w->symbol, w->size, w->gradient);
    value = by + w->size;
    for (int i = 0; i < w->size; i++) by[i] = dal__number(graph, 0.0);
    memcpy(value, w->gradient, (size_t)w->size * sizeof *value);
    value[w->size] = f;
    dal__substitute_all(graph, w->size + 1, value, w->symbol, w->size, by);
    for (int i = 0; i <= w->size; i++)
        if (!dal__node_is_zero(graph, value[i])) return false;
    for (int i = 0; i < w->size; i++)
        dal__gradient(graph, w->gradient[i], w->symbol, w->size, w->Q + i * w->size);
    for (int i = 0; i < w->size * w->size * w->size; i++) {
        const int symbol = w->symbol[i % w->size];
        if (dal__depends(graph, w->Q[i / w->size], symbol, symbol + 1)) return false;
    }
    return true;
}

/* The rank of a semidefinite a[size*size] and its pivots, row[size]; -1: it is not semidefinite. */
static int factorise(int size, double *a, int *row)
{
    double trace = 0.0, largest = 0.0;
    int rank = 0;
    for (int i = 0; i < size; i++) trace += a[i * size + i];
    for (int i = 0; i < size * size; i++) {
        if (trace < 0.0) a[i] = -a[i];
        largest = fmax(largest, fabs(a[i]));
    }
    for (; rank < size; rank++) {
        int pivot = 0;
        for (int i = 1; i < size; i++)
            if (a[i * size + i] > a[pivot * size + pivot]) pivot = i;
        const double p = a[pivot * size + pivot];
        if (!(p > rank_tolerance * largest)) break;
        row[rank] = pivot;
        for (int i = 0; i < size * size; i++)
            if (i / size != pivot && i % size != pivot)
                a[i] -= a[i / size * size + pivot] * a[pivot * size + i % size] / p;
        for (int i = 0; i < size; i++) a[i * size + pivot] = a[pivot * size + i] = 0.0;
    }
    return dal__max_abs(a, (size_t)(size * size)) <= sqrt(rank_tolerance) * largest ? rank : -1;
}

void dal__regular_functions(const dal__surface *s, dal__node f, dal__node *regular, int *count)
{
    const size_t pairs = (size_t)s->theory->pairs;
    dal__graph *graph = s->theory->graph;
    form w = {.symbol = dal__pool_allocate(s->pool, 2 * pairs, sizeof *w.symbol)};
    w.gradient = dal__pool_nodes(s->pool, graph, pairs);
    w.Q = dal__pool_nodes(s->pool, graph, (pairs + 3) * (pairs + 1));
    *count = 0;
    if (s->pool->out_of_memory) return;
    w.row = w.symbol + pairs;
    if (is_quadratic(s, f, &w)) {
        const int size = w.size * w.size;
        double *value = dal__numbers(DAL__SURFACE_POINTS, (size_t)size);
        s->pool->out_of_memory |= !value;
        if (value) dal__surface_values(s, size, w.Q, value);
        /* One rank at all points; 0: the form is not semidefinite. */
        for (int k = 0; value && k < DAL__SURFACE_POINTS; k++) {
            const int rank = factorise(w.size, value + k * size, w.row);
            w.rank = rank < 0 || (k > 0 && rank != w.rank) ? 0 : rank;
        }
        free(value);
    }
    for (int i = 0; i < w.rank; i++)
        regular[(*count)++] =
            w.rank == w.size ? dal__symbol(graph, w.symbol[i]) : w.gradient[w.row[i]];
    if (w.rank == 0) dal__squared_functions(s, f, regular, count);
}
