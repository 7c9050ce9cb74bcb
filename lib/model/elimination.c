/* elimination.c - symbolic elimination with pivots chosen numerically.
 *
 *     P M Q = L U:   u_kj = m_kj - sum_l l_kl u_lj,   l_ik = (m_ik - sum_l l_il u_lk) / u_kk
 *
 * Of a symmetric matrix with pivots on the diagonal only one half is computed, for U = D L^T.
 *
 * The pivots are chosen before any node is made, by eliminating the numbers at the default start
 * (or near it, when the matrix is singular there).  Among the entries of at
 * least a tenth of the largest, each relative to the size of its row and column (Jacobi scaling),
 * the first choice are those that depend on parameters alone (they cannot vanish along a run), then
 * untouched ones (no cancellation), then diagonal ones (they preserve the symmetry).  W may
 * thus be indefinite and have zeros on its diagonal.
 *
 * Pivots that come from a subtraction are checked along a run against what it subtracted from. */
#include "model/elimination.h"
#include "core/vectors.h"
#include "expr/collect.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include "model/model.h"
#include "model/units.h"
#include <math.h>

enum { VARYING = 1, TOUCHED = 2, PRESENT = 4 };

/* Beyond this size the pivots that fill few entries come first. */
enum { MAX_DENSE = 16 };

/* The elimination in numbers. */
typedef struct plan {
    int n, saddle;
    double *value;       /* [n*n] */
    unsigned char *flag; /* [n*n] */
    double *size;        /* [n] of the row and the column of each, as a diagonal entry has it */
    int *row, *column;   /* [n]: the order of pivots; unused ones last */
    int *place;          /* [n] of a column in column */
    int *entry;          /* [n*n] the columns of the entries of each row, entries[n] of them */
    int *entries;
    int *given;   /* [n] of these, those that are not filled in */
    int *counts;  /* [2n] of the entries that remain in rows, and in columns */
    long updates; /* of entries that vary along a run */
} plan;

/* ---- the order ---- */

/* m_ij^2/(d_i d_j) with the sizes d: a number without units.  No digit of it depends on the units
 * of the coordinates where they are powers of two, so that the same pivots are chosen. */
static double score(const plan *p, int i, int j)
{
    const double m = p->value[i * p->n + j];
    if (m == 0.0) return 0.0;
    const double s = fabs(m / p->size[i]) * fabs(m / p->size[j]);
    return isfinite(s) ? s : 0.0;
}

static void swap(int *a, int *b)
{
    int c = *a;
    *a = *b;
    *b = c;
}

/* The best score of all entries that remain; counts these in each row and in each column. */
static double survey_entries(plan *p, int k)
{
    double max = 0.0;
    for (int i = 0; i < 2 * p->n; i++) p->counts[i] = 0;
    for (int i = k; i < p->n; i++) {
        const int row = p->row[i];
        for (int l = 0; l < p->entries[row]; l++) {
            const int column = p->entry[row * p->n + l];
            if (p->place[column] < k) continue;
            max = fmax(max, score(p, row, column));
            p->counts[row]++;
            p->counts[p->n + column]++;
        }
    }
    return max;
}

/* Whether a row of a saddle point may have its diagonal pivot: a constraint after all coordinates
 * that it holds, so that the pivot vanishes only where the rank of the constraints falls. */
static bool is_ready(const plan *p, int row, int column, int k)
{
    if (row != column) return false;
    for (int l = 0; row >= p->saddle && l < p->given[row]; l++)
        if (p->place[p->entry[row * p->n + l]] >= k) return false;
    return true;
}

/* Brings the best pivot to place k, of equal ones the first; false when none remains.  In large
 * matrices the best ones are those that fill few entries (Markowitz). */
static bool choose(plan *p, int k)
{
    enum { KINDS = 8 };
    const double max = survey_entries(p, k), least = DAL__PIVOT_LEAST * DAL__PIVOT_LEAST;
    double best_score = 0.0, best = -INFINITY;
    int best_i = k, best_j = k;
    if (max <= least) return false;
    for (int i = k; i < p->n; i++) {
        const int row = p->row[i];
        for (int l = 0; l < p->entries[row]; l++) {
            const int column = p->entry[row * p->n + l], j = p->place[column];
            const double s = score(p, row, column);
            if (j < k || s < (p->saddle ? least : 0.01 * max)) continue;
            if (p->saddle && !is_ready(p, row, column, k)) continue;
            const unsigned char flag = p->flag[row * p->n + column];
            const double fill = (p->counts[row] - 1.0) * (p->counts[p->n + column] - 1.0);
            const double preferred = (flag & VARYING ? 0 : 4) + (flag & TOUCHED ? 0 : 2) +
                                     (row == column) - (p->n > MAX_DENSE ? KINDS * fill : 0.0);
            const bool first = s == best_score && i == best_i && j < best_j;
            if (preferred < best || (preferred == best && s <= best_score && !first)) continue;
            best = preferred, best_score = s, best_i = i, best_j = j;
        }
    }
    if (best == -INFINITY) return false;
    swap(&p->row[k], &p->row[best_i]);
    swap(&p->column[k], &p->column[best_j]);
    p->place[p->column[k]] = k;
    p->place[p->column[best_j]] = best_j;
    return true;
}

static void eliminate_numbers(plan *p, int k)
{
    int n = p->n, row = p->row[k] * n, c = p->column[k];
    for (int i = k + 1; i < n; i++) {
        int other = p->row[i] * n;
        if (!(p->flag[other + c] & PRESENT)) continue;
        double factor = p->value[other + c] / p->value[row + c];
        for (int j = k + 1; j < n; j++) {
            int d = p->column[j];
            if (!(p->flag[row + d] & PRESENT)) continue;
            unsigned from = p->flag[other + c] | p->flag[row + d] | p->flag[row + c];
            if (!(p->flag[other + d] & PRESENT)) p->entry[other + p->entries[p->row[i]]++] = d;
            p->updates += (from & VARYING) != 0;
            p->value[other + d] -= factor * p->value[row + d];
            p->flag[other + d] |= (unsigned char)((from & VARYING) | TOUCHED | PRESENT);
        }
    }
}

/* Fills in the values of the matrix at a point, and the sizes of its rows. */
static void evaluate(plan *p, const dal__equations *e, const dal__node *matrix, const double *at)
{
    for (int i = 0; i < p->n; i++) {
        p->row[i] = p->column[i] = p->place[i] = i;
        p->entries[i] = 0;
    }
    for (int i = 0; i < p->n * p->n; i++) {
        bool present = !dal__node_is_zero(e->graph, matrix[i]);
        bool varying = dal__depends(e->graph, matrix[i], e->parameters, e->symbols);
        p->flag[i] = (unsigned char)((present ? PRESENT : 0) | (varying ? VARYING : 0));
        if (present) p->entry[i / p->n * p->n + p->entries[i / p->n]++] = i % p->n;
    }
    for (int i = 0; i < p->n; i++) p->given[i] = p->entries[i];
    dal__evaluate_all(e->graph, matrix, p->n * p->n, at, p->value);
    dal__jacobi_sizes(p->n, p->value, p->size);
}

/* -1, or the row that has no pivot.  Ends early where the elimination, whose every
 * update makes a node or more, would exceed the limit of a graph. */
static int order(plan *p, int limit)
{
    p->updates = 0;
    for (int k = 0; k < p->n && p->updates <= limit; k++) {
        if (!choose(p, k)) return p->row[k];
        eliminate_numbers(p, k);
    }
    return -1;
}

/* Chooses the pivots at the start or, where the matrix is singular there, at a point moved off it
 * by irregular amounts between 1/8 and 5/8: what is singular there too is singular everywhere. */
static dal_status make_plan(dal_model *model, dal__factors *f, plan *p)
{
    const dal__equations *e = &model->equations;
    const size_t n = (size_t)f->n;
    double *point = dal__model_allocate(model, (size_t)e->symbols, sizeof *point);
    double *scratch = dal__model_allocate(model, n * n, sizeof *scratch);
    *p = (plan){.n = f->n,
                .saddle = f->saddle,
                .given = dal__model_allocate(model, n, sizeof *p->given),
                .value = dal__model_allocate(model, n * n, sizeof *p->value),
                .flag = dal__model_allocate(model, n * n, sizeof *p->flag),
                .size = dal__model_allocate(model, n, sizeof *p->size),
                .place = dal__model_allocate(model, n, sizeof *p->place),
                .entry = dal__model_allocate(model, n * n, sizeof *p->entry),
                .entries = dal__model_allocate(model, n, sizeof *p->entries),
                .counts = dal__model_allocate(model, 2 * n, sizeof *p->counts),
                .row = f->row,
                .column = f->column};
    if (model->out_of_memory) return DAL_STATUS_OK;
    evaluate(p, e, f->matrix, e->value);
    f->positive = dal__is_positive_definite(f->n, p->value, DAL__PIVOT_LEAST, scratch);
    f->singular = order(p, e->graph->limit);
    if (p->updates > e->graph->limit) return DAL_STATUS_TOO_LARGE;
    if (f->singular < 0) return DAL_STATUS_OK;
    dal__model_units(model, point);
    for (int i = 0; i < e->symbols; i++) {
        const double moved = point[i] * (0.125 + 0.5 * dal__golden_fraction(i + 1));
        point[i] = e->value[i] + (i >= e->parameters ? moved : 0.0);
    }
    evaluate(p, e, f->matrix, point);
    f->singular = order(p, e->graph->limit);
    if (p->updates > e->graph->limit) return DAL_STATUS_TOO_LARGE;
    /* What a full graph lacks has no value, which does not make a matrix singular. */
    const bool is_known = e->graph->status == DAL_STATUS_OK;
    return f->singular >= 0 && is_known ? DAL_STATUS_SINGULAR : DAL_STATUS_OK;
}

/* ---- the elimination ---- */

/* Entry of the row and the column of pivots i and j. */
static dal__node *at(const dal__factors *f, int i, int j)
{
    return &f->matrix[f->row[i] * f->n + f->column[j]];
}

/* Subtracts multiples of row k from those below, which keep the factors in column k. */
static void eliminate(dal__graph *graph, dal__factors *f, int k, bool symmetric, int *below)
{
    const int n = f->n;
    int rows = 0;
    for (int i = k + 1; i < n; i++)
        if (!dal__node_is_zero(graph, *at(f, i, k))) below[rows++] = i;
    const dal__node pivot = *at(f, k, k);
    const dal__node inverse = dal__node_div(graph, dal__number(graph, 1.0), pivot);
    for (int r = rows; r-- > 0;) {
        const int i = below[r];
        const dal__node first = *at(f, i, k);
        const dal__node factor =
            rows > 1 ? dal__node_mul(graph, first, inverse) : dal__node_div(graph, first, pivot);
        for (int j = symmetric ? i : k + 1; j < n; j++) {
            const dal__node beside = *at(f, k, j);
            if (dal__node_is_zero(graph, beside)) continue;
            *at(f, i, j) = dal__node_sub(graph, *at(f, i, j), dal__node_mul(graph, factor, beside));
        }
        *at(f, i, k) = factor;
    }
    for (int r = 0; symmetric && r < rows; r++)
        for (int s = 0; s < r; s++) *at(f, below[r], below[s]) = *at(f, below[s], below[r]);
}

/* ---- the pivots ---- */

/* Whether a node is a product of symbols, functions and what is constant along a run: computed
 * without a subtraction.  Products deeper than DEPTH count as sums. */
static bool is_product(const dal__graph *graph, dal__node node, int depth)
{
    const dal__record r = dal__inspect(graph, node);
    if (r.fixed || r.op == DAL__SYMBOL) return true;
    if (depth == 0 || r.op == DAL__ADD || r.op == DAL__SUB) return false;
    if (r.op == DAL__MUL || r.op == DAL__DIV)
        return is_product(graph, r.a, depth - 1) && is_product(graph, r.b, depth - 1);
    return r.op != DAL__NEG || is_product(graph, r.a, depth - 1);
}

/* What pivot k came from: the sum of the absolute values of the entry and of all that was
 * subtracted but the last, which cannot be the only large one when the pivot is small. */
static dal__node pivot_size(dal__graph *graph, const dal__factors *f, dal__node entry, int k)
{
    dal__node size = dal__apply(graph, DAL__ABS, entry, 0), last = 0;
    for (int l = 0; l < k; l++) {
        const dal__node left = *at(f, k, l), right = *at(f, l, k);
        if (dal__node_is_zero(graph, left) || dal__node_is_zero(graph, right)) continue;
        if (last) size = dal__node_add(graph, size, dal__apply(graph, DAL__ABS, last, 0));
        last = dal__node_mul(graph, left, right);
    }
    return size;
}

void dal__record_pivots(dal__equations *e, const dal__factors *f, unsigned divides)
{
    enum { DEPTH = 8 };
    for (int k = 0; k < f->n; k++) {
        const dal__node pivot = *at(f, k, k), entry = f->given[f->row[k] * f->n + f->column[k]];
        const int by_row = f->constraint[f->row[k]], by_column = f->constraint[f->column[k]];
        if (dal__inspect(e->graph, pivot).op == DAL__NUMBER) continue;
        e->pivot[e->pivots++] =
            (dal__pivot){.pivot = pivot,
                         .size = pivot_size(e->graph, f, entry, k),
                         .constraint = by_row > by_column ? by_row : by_column,
                         .checked = pivot != entry && !is_product(e->graph, pivot, DEPTH),
                         .divides = divides};
    }
}

void dal__list_pivots(const dal__factors *f, dal__node *pivot)
{
    for (int k = 0; k < f->n; k++) pivot[k] = *at(f, k, k);
}

/* ---- the whole ---- */

void dal__factors_allocate(dal_model *model, dal__factors *f, int n, const int *constraints)
{
    int *constraint = dal__model_allocate(model, (size_t)n, sizeof *constraint);
    *f = (dal__factors){.n = n, .constraint = constraint};
    f->matrix = dal__model_nodes(model, n * n, 0);
    for (int i = 0; constraint && constraints && i < n; i++) constraint[i] = constraints[i] + 1;
}

/* Lists the entries of both triangles row by row, for sparse solutions. */
static void list_entries(dal_model *model, dal__factors *f)
{
    const dal__graph *graph = model->equations.graph;
    const int n = f->n;
    int count = 0;
    f->first = dal__model_allocate(model, 2 * (size_t)n + 1, sizeof *f->first);
    for (int i = 0; i < n * n; i++) count += !dal__node_is_zero(graph, f->matrix[i]);
    f->other = dal__model_allocate(model, (size_t)count, sizeof *f->other);
    if (model->out_of_memory) return;
    count = 0;
    for (int i = 0; i < n; i++) {
        f->first[2 * i] = count;
        for (int j = 0; j < i; j++)
            if (!dal__node_is_zero(graph, *at(f, i, j))) f->other[count++] = j;
        f->first[2 * i + 1] = count;
        for (int j = i + 1; j < n; j++)
            if (!dal__node_is_zero(graph, *at(f, i, j))) f->other[count++] = j;
    }
    f->first[2 * n] = count;
}

/* Eliminating n coordinates makes n^3/3 nodes of a full matrix, and few of one that couples each
 * with a few others.  A full one is refused before its n^2 entries are evaluated; what fills later
 * is counted with the pivots. */
dal_status dal__factor(dal_model *model, dal__factors *f)
{
    enum { MAX_FULL = 256, MAX_COUPLED = 64 };
    dal__equations *e = &model->equations;
    const size_t n = (size_t)f->n;
    const long coupled = (long)MAX_COUPLED * f->n;
    long entries = 0;
    bool symmetric = true;
    for (size_t i = 0; i < n * n; i++) entries += !dal__node_is_zero(e->graph, f->matrix[i]);
    if (f->n > MAX_FULL && entries > coupled) return DAL_STATUS_TOO_LARGE;
    f->given = dal__model_nodes(model, f->n * f->n, 0);
    int *below = dal__model_allocate(model, n, sizeof *below);
    f->row = dal__model_allocate(model, n, sizeof *f->row);
    f->column = dal__model_allocate(model, n, sizeof *f->column);
    plan p;
    if (model->out_of_memory) return DAL_STATUS_OK;
    for (size_t i = 0; i < n * n; i++) f->given[i] = f->matrix[i];
    DAL_TRY(make_plan(model, f, &p));
    if (model->out_of_memory) return DAL_STATUS_OK;
    for (int i = 0; i < f->n; i++) {
        symmetric = symmetric && f->row[i] == f->column[i];
        for (int j = 0; j < i && symmetric; j++)
            symmetric = f->matrix[i * f->n + j] == f->matrix[j * f->n + i];
    }
    for (int k = 0; k < f->n; k++) eliminate(e->graph, f, k, symmetric, below);
    list_entries(model, f);
    return DAL_STATUS_OK;
}

/* One right-hand side; y[n] is scratch.  The last division has one rounding: the rounding of a
 * multiplied reciprocal would be the same in every step where the pivot is constant, and make D
 * drift. */
static void solve_one(dal__graph *graph, const dal__factors *f, dal__sum_form sums,
                      const dal__node *rhs, dal__node *x, dal__node *y)
{
    for (int k = 0; k < f->n; k++) {
        y[k] = rhs[f->row[k]];
        for (int l = f->first[2 * k]; l < f->first[2 * k + 1]; l++) {
            const int j = f->other[l];
            if (!dal__node_is_zero(graph, y[j]))
                y[k] = dal__node_sub(graph, y[k], dal__node_mul(graph, *at(f, k, j), y[j]));
        }
        if (sums == DAL__SUMS_COLLECTED && f->first[2 * k] < f->first[2 * k + 1])
            y[k] = dal__collect(graph, y[k]);
    }
    for (int k = f->n; k-- > 0;) {
        for (int l = f->first[2 * k + 1]; l < f->first[2 * k + 2]; l++) {
            const int j = f->other[l];
            const dal__node known = x[f->column[j]];
            if (!dal__node_is_zero(graph, known))
                y[k] = dal__node_sub(graph, y[k], dal__node_mul(graph, *at(f, k, j), known));
        }
        x[f->column[k]] = dal__node_div(graph, y[k], *at(f, k, k));
    }
}

void dal__factors_solve(dal_model *model, const dal__factors *f, dal__sum_form sums, int columns,
                        const dal__node *rhs, dal__node *x)
{
    dal__graph *graph = model->equations.graph;
    dal__node *y = dal__model_nodes(model, f->n, 0);
    if (model->out_of_memory) return;
    for (int c = 0; c < columns; c++) solve_one(graph, f, sums, rhs + c * f->n, x + c * f->n, y);
}
