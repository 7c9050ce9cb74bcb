/* elimination.c - symbolic elimination with pivots chosen numerically.
 *
 * The pivots are chosen before any node is made, by eliminating the numbers at the default start
 * (or near it, when the matrix is singular there).  Among the entries of at
 * least a tenth of the largest, each relative to the size of its row and column, the first choice
 * are those that depend on parameters alone (they cannot vanish along a run), then untouched ones
 * (no cancellation), then those of the diagonal (they preserve the symmetry).  W may thus be
 * indefinite and have zeros on its diagonal.
 *
 * Every other pivot is checked along a run against the sum of the absolute values it came from. */
#include "model/elimination.h"
#include "core/vectors.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include "model/model.h"
#include <math.h>

enum { VARYING = 1, TOUCHED = 2, PRESENT = 4 };

/* The elimination in numbers. */
typedef struct plan {
    int n;
    double *value;                  /* [n*n] */
    unsigned char *flag;            /* [n*n] */
    double *row_root, *column_root; /* [n] of the largest entry of each */
    int *row, *column;              /* [n]: the order of pivots; unused ones behind */
    int *place;                     /* [n] of a column in column */
    int *entry; /* [n*n] the columns of the entries of each row, entries[n] of them */
    int *entries;
} plan;

/* ---- the order ---- */

static double score(const plan *p, int i, int j)
{
    double size = p->row_root[i] * p->column_root[j];
    double s = fabs(p->value[i * p->n + j]) / size;
    return size > 0.0 && isfinite(s) ? s : 0.0;
}

static void swap(int *a, int *b)
{
    int c = *a;
    *a = *b;
    *b = c;
}

/* The best score of all entries that are left. */
static double max_score(const plan *p, int k)
{
    double max = 0.0;
    for (int i = k; i < p->n; i++) {
        const int row = p->row[i];
        for (int l = 0; l < p->entries[row]; l++)
            if (p->place[p->entry[row * p->n + l]] >= k)
                max = fmax(max, score(p, row, p->entry[row * p->n + l]));
    }
    return max;
}

/* Brings the best pivot to place k, of equal ones the first; false when none is left. */
static bool choose(plan *p, int k)
{
    const double max = max_score(p, k);
    double best_score = 0.0;
    int best = -1, best_i = k, best_j = k;
    if (max <= DAL__PIVOT_LEAST) return false;
    for (int i = k; i < p->n; i++) {
        const int row = p->row[i];
        for (int l = 0; l < p->entries[row]; l++) {
            const int column = p->entry[row * p->n + l], j = p->place[column];
            const double s = score(p, row, column);
            if (j < k || s < 0.1 * max) continue;
            const unsigned char flag = p->flag[row * p->n + column];
            const int preferred =
                (flag & VARYING ? 0 : 4) + (flag & TOUCHED ? 0 : 2) + (row == column);
            const bool first = s == best_score && i == best_i && j < best_j;
            if (preferred < best || (preferred == best && s <= best_score && !first)) continue;
            best = preferred, best_score = s, best_i = i, best_j = j;
        }
    }
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
            p->value[other + d] -= factor * p->value[row + d];
            p->flag[other + d] |= (unsigned char)((from & VARYING) | TOUCHED | PRESENT);
        }
    }
}

/* Fills in the values of the matrix at a point, and the largest of each row and column. */
static void evaluate(plan *p, const dal__equations *e, const dal__node *matrix, const double *at)
{
    for (int i = 0; i < p->n; i++) {
        p->row_root[i] = p->column_root[i] = 0.0;
        p->row[i] = p->column[i] = p->place[i] = i;
        p->entries[i] = 0;
    }
    for (int i = 0; i < p->n * p->n; i++) {
        double *row_size = &p->row_root[i / p->n], *column_size = &p->column_root[i % p->n];
        bool present = !dal__is_number(e->graph, matrix[i], 0.0);
        bool varying = dal__depends(e->graph, matrix[i], e->parameters, e->symbols);
        p->value[i] = present ? dal__evaluate(e->graph, matrix[i], at) : 0.0;
        p->flag[i] = (unsigned char)((present ? PRESENT : 0) | (varying ? VARYING : 0));
        if (present) p->entry[i / p->n * p->n + p->entries[i / p->n]++] = i % p->n;
        *row_size = fmax(*row_size, fabs(p->value[i]));
        *column_size = fmax(*column_size, fabs(p->value[i]));
    }
    for (int i = 0; i < p->n; i++) {
        p->row_root[i] = sqrt(p->row_root[i]);
        p->column_root[i] = sqrt(p->column_root[i]);
    }
}

/* -1, or the row that is left without a pivot. */
static int order(plan *p)
{
    for (int k = 0; k < p->n; k++) {
        if (!choose(p, k)) return p->row[k];
        eliminate_numbers(p, k);
    }
    return -1;
}

/* Chooses the pivots at the start or, where the matrix is singular there, at a point moved off it
 * by irregular amounts between 1/8 and 5/8, multiples of the golden ratio modulo 1/2: what is
 * singular there too is singular everywhere. */
static dal_status make_plan(dal_model *model, dal__linear *s, plan *p)
{
    const dal__equations *e = &model->equations;
    const size_t n = (size_t)s->n;
    double *point = dal__model_allocate(model, (size_t)e->symbols, sizeof *point);
    double *scratch = dal__model_allocate(model, n * n, sizeof *scratch);
    *p = (plan){.n = s->n,
                .value = dal__model_allocate(model, n * n, sizeof *p->value),
                .flag = dal__model_allocate(model, n * n, sizeof *p->flag),
                .row_root = dal__model_allocate(model, n, sizeof *p->row_root),
                .column_root = dal__model_allocate(model, n, sizeof *p->column_root),
                .place = dal__model_allocate(model, n, sizeof *p->place),
                .entry = dal__model_allocate(model, n * n, sizeof *p->entry),
                .entries = dal__model_allocate(model, n, sizeof *p->entries),
                .row = dal__model_allocate(model, n, sizeof *p->row),
                .column = dal__model_allocate(model, n, sizeof *p->column)};
    if (model->out_of_memory) return DAL_MEMORY;
    evaluate(p, e, s->matrix, e->value);
    s->positive = dal__is_positive_definite(s->n, p->value, DAL__PIVOT_LEAST, scratch);
    s->singular = order(p);
    if (s->singular < 0) return DAL_OK;
    const double golden = 0.6180339887498949;
    for (int i = 0; i < e->symbols; i++) {
        point[i] = e->value[i];
        if (i >= e->parameters) point[i] += 0.125 + 0.5 * fmod((i + 1) * golden, 1.0);
    }
    evaluate(p, e, s->matrix, point);
    s->singular = order(p);
    DAL_TRY(e->graph->status);
    return s->singular < 0 ? DAL_OK : DAL_SINGULAR;
}

/* ---- the elimination ---- */

/* The same in nodes; size[] holds the sums of absolute values. */
typedef struct elimination {
    dal__graph *graph;
    dal__linear *s;
    const plan *p;
    dal__node *size;
    dal__node *reciprocal; /* [n] of the pivots */
} elimination;

/* x over pivot k.  A single right-hand side is divided, with one rounding: that of a multiplied
 * reciprocal would be the same in every step where the pivot is constant, and make D drift. */
static dal__node over_pivot(elimination *w, dal__node x, int k)
{
    const plan *p = w->p;
    dal__node pivot = w->s->matrix[p->row[k] * w->s->n + p->column[k]];
    if (w->s->columns == 1) return dal__node_div(w->graph, x, pivot);
    return dal__node_mul(w->graph, x, w->reciprocal[k]);
}

static bool is_zero(const elimination *w, dal__node node)
{
    return dal__is_number(w->graph, node, 0.0);
}

static void subtract(elimination *w, dal__node *from, dal__node a, dal__node b)
{
    if (!is_zero(w, a) && !is_zero(w, b))
        *from = dal__node_sub(w->graph, *from, dal__node_mul(w->graph, a, b));
}

static void eliminate_row(elimination *w, int k, int other)
{
    int n = w->s->n, columns = w->s->columns, row = w->p->row[k];
    dal__node *below = w->s->matrix + other * n, *pivots = w->s->matrix + row * n;
    dal__node first = below[w->p->column[k]];
    if (is_zero(w, first)) return;
    dal__node factor = over_pivot(w, first, k);
    for (int j = k + 1; j < n; j++) {
        int c = w->p->column[j];
        if (is_zero(w, pivots[c])) continue;
        dal__node product = dal__node_mul(w->graph, factor, pivots[c]);
        dal__node size = dal__apply(w->graph, DAL__ABS, product, 0);
        below[c] = dal__node_sub(w->graph, below[c], product);
        w->size[other * n + c] = dal__node_add(w->graph, w->size[other * n + c], size);
    }
    for (int j = 0; j < columns; j++)
        subtract(w, &w->s->rhs[other * columns + j], factor, w->s->rhs[row * columns + j]);
}

static void record_pivot(dal__equations *e, const elimination *w, int k)
{
    int row = w->p->row[k], place = row * w->s->n + w->p->column[k];
    int last = w->p->column[k] > row ? w->p->column[k] : row;
    bool varying = dal__depends(e->graph, w->s->matrix[place], e->parameters, e->symbols);
    if (dal__inspect(e->graph, w->s->matrix[place]).op == DAL__NUMBER) return;
    e->pivot[e->pivots++] =
        (dal__pivot){.pivot = w->s->matrix[place],
                     .size = w->size[place],
                     .constraint = last >= w->s->border ? last - w->s->border + 1 : 0,
                     .checked = varying && w->p->flag[place] & TOUCHED};
}

/* Eliminating n coordinates makes n^3/3 nodes of a full matrix, and few of one that couples each
 * with a few others. */
static bool is_too_dense(const dal__graph *graph, const dal__linear *s)
{
    enum { MAX_FULL = 256, MAX_COUPLED = 64 };
    long entries = 0;
    for (int i = 0; i < s->n * s->n && s->n > MAX_FULL; i++)
        entries += !dal__is_number(graph, s->matrix[i], 0.0);
    return entries > (long)MAX_COUPLED * s->n;
}

dal_status dal__linear_solve(dal_model *model, dal__linear *s)
{
    dal__equations *e = &model->equations;
    plan p;
    if (is_too_dense(e->graph, s)) return DAL_TOO_LARGE;
    elimination w = {.graph = e->graph, .s = s, .p = &p};
    DAL_TRY(make_plan(model, s, &p));
    w.size = dal__model_nodes(model, s->n * s->n, 0);
    w.reciprocal = dal__model_nodes(model, s->n, 0);
    if (model->out_of_memory) return DAL_MEMORY;
    dal__node one = dal__number(e->graph, 1.0);
    for (int i = 0; i < s->n * s->n; i++)
        w.size[i] = dal__apply(e->graph, DAL__ABS, s->matrix[i], 0);
    for (int k = 0; k < s->n; k++) {
        record_pivot(e, &w, k);
        w.reciprocal[k] = dal__node_div(e->graph, one, s->matrix[p.row[k] * s->n + p.column[k]]);
        for (int i = k + 1; i < s->n; i++) eliminate_row(&w, k, p.row[i]);
    }
    for (int k = s->n; k-- > 0;)
        for (int j = 0; j < s->columns; j++) { /* those of the later pivots are known */
            dal__node x = s->rhs[p.row[k] * s->columns + j];
            for (int l = k + 1; l < s->n; l++)
                subtract(&w, &x, s->matrix[p.row[k] * s->n + p.column[l]],
                         s->x[p.column[l] * s->columns + j]);
            s->x[p.column[k] * s->columns + j] = over_pivot(&w, x, k);
        }
    return e->graph->status;
}
