/* bordered.c - the linear system of accelerations and multipliers, as nodes.
 *
 *     ( W  -B^T ) (F)   ( b )
 *     ( A    0  ) (h) = (-c )         B = A by Chetaev's rule, or as given under reactions
 *
 * A constraint that holds a coordinate d which no other constraint contains, with a number alpha as
 * its coefficient, may be solved for it first (f: the free coordinates):
 *
 *     F_d = s + S F_f,   S = -A_f / alpha,   s = -c / alpha
 *     W' = W_ff + W_fd S + S^T W_df + S^T W_dd S,   b' = b_f - W_fd s + S^T (b_d - W_dd s)
 *
 * W' is positive definite where W is, so this brings no singularity of its own; where S is bounded
 * it does not spoil the conditioning either.  The other constraints are retained; they have no
 * entry at d, and
 *
 *     G = A W'^-1 B^T,   G h = -(c + A W'^-1 b'),   F_f = W'^-1 (b' + B^T h)        (nh3)-(nh5)
 *
 * Two constraints may be replaced by half their sum and half their difference (as for a board on
 * two axles), which changes neither singularities nor conditioning.
 *
 * Where W couples neighbours W'^-1 is full, and so is what is made of it.  The bordered matrix is
 * factored as a whole then, as ( W  A^T ) over ( A  0 ) of x and -h: with W positive definite, and
 * each constraint eliminated after its coordinates, its pivots vanish with W and G alone. */
#include "model/bordered.h"
#include "expr/collect.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include "model/model.h"

/* Rows of a matrix with few entries. */
typedef struct sparse {
    int *first, *column; /* entries first[i] .. first[i + 1] - 1 of row i */
    dal__node *value;
} sparse;

/* Vectors of one right-hand side. */
typedef struct vectors {
    dal__node *s, *u; /* [m] F_d of F_f = 0; b_d - W_dd s */
    dal__node *t, *y; /* [n] b'; W'^-1 b', then F_f */
    dal__node *pull;  /* [m] */
    dal__node *force; /* [m] */
} vectors;

/* Free coordinates and retained constraints are numbered among themselves; free and retained hold
 * their numbers in the model. */
struct dal__bordered {
    unsigned way; /* DAL__SOLVED, .. */
    vectors scratch;
    int solved, frees, retained_count;
    int *dependent, *by;       /* [solved] the coordinate and its constraint */
    dal__node *alpha;          /* [solved] */
    int *free, *retained;      /* [frees], [retained_count] */
    int *partner;              /* [retained_count] of a pair of constraints; itself: of none */
    sparse S, A, R;            /* [solved] by frees; [retained_count] by frees; R = W'^-1 B^T */
    dal__factors mass, forces; /* W', G */
    dal__factors whole;        /* of the bordered matrix, of x and -h, where the way is WHOLE */
};

static dal__node collect(const dal__equations *e, const dal__bordered *s, dal__node node)
{
    return s->way & DAL__COLLECTED ? dal__collect(e->graph, node) : node;
}

static void subtract_product(const dal__equations *e, dal__node *sum, dal__node a, dal__node b)
{
    if (!dal__node_is_zero(e->graph, a) && !dal__node_is_zero(e->graph, b))
        *sum = dal__node_sub(e->graph, *sum, dal__node_mul(e->graph, a, b));
}

/* Row i of a matrix times x. */
static dal__node row_product(const dal__equations *e, const sparse *s, int i, const dal__node *x)
{
    dal__node sum = dal__number(e->graph, 0.0);
    for (int k = s->first[i]; k < s->first[i + 1]; k++)
        dal__add_product(e->graph, &sum, s->value[k], x[s->column[k]]);
    return sum;
}

static void compress(dal_model *model, sparse *s, int rows, int columns, const dal__node *matrix)
{
    const dal__equations *e = &model->equations;
    int count = 0;
    for (int i = 0; i < rows * columns; i++) count += !dal__node_is_zero(e->graph, matrix[i]);
    s->first = dal__model_allocate(model, (size_t)rows + 1, sizeof *s->first);
    s->column = dal__model_allocate(model, (size_t)count, sizeof *s->column);
    s->value = dal__model_nodes(model, count, 0);
    if (model->out_of_memory) return;
    count = 0;
    for (int i = 0; i < rows; i++) {
        for (int j = 0; j < columns; j++) {
            if (dal__node_is_zero(e->graph, matrix[i * columns + j])) continue;
            s->column[count] = j;
            s->value[count++] = matrix[i * columns + j];
        }
        s->first[i + 1] = count;
    }
}

/* ---- constraints that are solved for a coordinate ---- */

/* Whether a coefficient stays below a bound that parameters alone decide. */
static bool is_bounded(const dal__graph *graph, dal__node node, int depth)
{
    const dal__record r = dal__inspect(graph, node);
    if (r.fixed || r.op == DAL__SIN || r.op == DAL__COS) return true;
    if (depth == 0) return false;
    if (r.op == DAL__NEG) return is_bounded(graph, r.a, depth - 1);
    if (r.op != DAL__MUL && r.op != DAL__ADD && r.op != DAL__SUB) return false;
    return is_bounded(graph, r.a, depth - 1) && is_bounded(graph, r.b, depth - 1);
}

/* The coordinate that constraint a is solved for: the one that W couples least; -1: none. */
static int find_dependent(const dal__equations *e, int a)
{
    enum { DEPTH = 12 };
    int best = -1, least = e->n + 1;
    for (int i = 0; i < e->n; i++)
        if (!is_bounded(e->graph, e->A[a * e->n + i], DEPTH)) return -1;
    for (int d = 0; d < e->n; d++) {
        const dal__node alpha = e->A[a * e->n + d];
        int coupled = 0, others = 0;
        if (dal__node_is_zero(e->graph, alpha) || dal__inspect(e->graph, alpha).op != DAL__NUMBER)
            continue;
        for (int b = 0; b < e->m; b++)
            others += b != a && !dal__node_is_zero(e->graph, e->A[b * e->n + d]);
        if (others > 0) continue;
        for (int i = 0; i < e->n; i++) coupled += !dal__node_is_zero(e->graph, e->W[d * e->n + i]);
        if (coupled < least) least = coupled, best = d;
    }
    return best;
}

/* Decides which constraints are solved for which coordinates, none or all that can be; makes S. */
static void choose_dependent(dal_model *model, dal__bordered *s)
{
    const dal__equations *e = &model->equations;
    const size_t n = (size_t)e->n, m = (size_t)e->m;
    bool *dependent = dal__model_allocate(model, n, sizeof *dependent);
    s->dependent = dal__model_allocate(model, m, sizeof *s->dependent);
    s->by = dal__model_allocate(model, m, sizeof *s->by);
    s->alpha = dal__model_nodes(model, e->m, 0);
    s->free = dal__model_allocate(model, n, sizeof *s->free);
    s->retained = dal__model_allocate(model, m, sizeof *s->retained);
    s->partner = dal__model_allocate(model, m, sizeof *s->partner);
    if (model->out_of_memory) return;
    for (int a = 0; a < e->m; a++) {
        const int d = s->way & DAL__SOLVED && !e->servo ? find_dependent(e, a) : -1;
        if (d < 0) {
            s->retained[s->retained_count++] = a;
            continue;
        }
        dependent[d] = true;
        s->dependent[s->solved] = d;
        s->by[s->solved] = a;
        s->alpha[s->solved++] = e->A[a * e->n + d];
    }
    for (int i = 0; i < e->n; i++)
        if (!dependent[i]) s->free[s->frees++] = i;
    dal__node *S = dal__model_nodes(model, s->solved * s->frees, 0);
    for (int k = 0; S && k < s->solved; k++)
        for (int i = 0; i < s->frees; i++) {
            dal__node ratio =
                dal__node_div(e->graph, e->A[s->by[k] * e->n + s->free[i]], s->alpha[k]);
            S[k * s->frees + i] = dal__node_neg(e->graph, ratio);
        }
    if (S) compress(model, &s->S, s->solved, s->frees, S);
}

/* Adds weight S_k to row and column j of a matrix of the free coordinates, of which the upper half
 * is kept. */
static void add_scaled_row(const dal__equations *e, const dal__bordered *s, int k, dal__node weight,
                           int j, dal__node *out)
{
    for (int x = s->S.first[k]; x < s->S.first[k + 1]; x++) {
        const int i = s->S.column[x], high = i < j ? i * s->frees + j : j * s->frees + i;
        dal__add_product(e->graph, &out[high], s->S.value[x], weight);
        if (i == j) dal__add_product(e->graph, &out[high], s->S.value[x], weight);
    }
}

/* Adds S_k^T weight S_l to its upper half. */
static void add_outer(const dal__equations *e, const dal__bordered *s, int k, int l,
                      dal__node weight, dal__node *out)
{
    const sparse *S = &s->S;
    for (int x = S->first[k]; x < S->first[k + 1]; x++) {
        const dal__node scaled = dal__node_mul(e->graph, S->value[x], weight);
        for (int y = S->first[l]; y < S->first[l + 1]; y++)
            if (S->column[x] <= S->column[y])
                dal__add_product(e->graph, &out[S->column[x] * s->frees + S->column[y]], scaled,
                                 S->value[y]);
    }
}

/* W' = W_ff + W_fd S + S^T W_df + S^T W_dd S: its upper half, then the lower. */
static void reduce_mass(const dal__equations *e, const dal__bordered *s, dal__node *out)
{
    const int n = e->n, f = s->frees;
    for (int i = 0; i < f * f; i++) out[i] = e->W[s->free[i / f] * n + s->free[i % f]];
    for (int k = 0; k < s->solved; k++) {
        const dal__node *row = e->W + s->dependent[k] * n;
        for (int j = 0; j < f; j++)
            if (!dal__node_is_zero(e->graph, row[s->free[j]]))
                add_scaled_row(e, s, k, row[s->free[j]], j, out);
        for (int l = 0; l < s->solved; l++)
            if (!dal__node_is_zero(e->graph, row[s->dependent[l]]))
                add_outer(e, s, k, l, row[s->dependent[l]], out);
    }
    for (int i = 0; i < f; i++)
        for (int j = i; j < f; j++) out[i * f + j] = out[j * f + i] = collect(e, s, out[i * f + j]);
}

/* ---- factors ---- */

void dal__bordered_record_pivots(dal__equations *e, const dal__bordered *s,
                                 const dal__factors *mass)
{
    e->pivots = 0;
    if (s->way & DAL__WHOLE) {
        dal__record_pivots(e, mass, DAL__DIVIDES_MASS);
        dal__record_pivots(e, &s->whole, DAL__DIVIDES_MOTION);
        return;
    }
    dal__record_pivots(e, mass, DAL__DIVIDES_MASS | (s->solved == 0 ? DAL__DIVIDES_MOTION : 0));
    if (s->solved > 0) dal__record_pivots(e, &s->mass, DAL__DIVIDES_MOTION);
    dal__record_pivots(e, &s->forces, DAL__DIVIDES_MOTION);
}

/* Half the sum and half the difference of two nodes. */
static void combine(const dal__equations *e, dal__node *a, dal__node *b)
{
    const dal__node half = dal__number(e->graph, 0.5), x = *a, y = *b;
    *a = dal__node_mul(e->graph, half, dal__node_add(e->graph, x, y));
    *b = dal__node_mul(e->graph, half, dal__node_sub(e->graph, x, y));
}

/* The same of all pairs of a vector of the retained constraints. */
static void combine_pairs(const dal__equations *e, const dal__bordered *s, dal__node *x)
{
    for (int a = 0; a < s->retained_count; a++)
        if (s->partner[a] > a) combine(e, &x[a], &x[s->partner[a]]);
}

/* Pairs two constraints, and combines their rows of A, where these become cheaper. */
static void pair_constraints(dal_model *model, dal__bordered *s, dal__node *A)
{
    const dal__equations *e = &model->equations;
    const int f = s->frees;
    dal__node *row = dal__model_nodes(model, 2 * f, 0), *both = dal__model_nodes(model, 2 * f, 0);
    for (int a = 0; row && both && a < s->retained_count; a++)
        for (int b = a + 1; b < s->retained_count && s->partner[a] == a; b++) {
            if (s->partner[b] != b) continue;
            for (int i = 0; i < f; i++) {
                row[i] = both[i] = A[a * f + i];
                row[f + i] = both[f + i] = A[b * f + i];
                combine(e, &both[i], &both[f + i]);
            }
            for (int i = 0; i < 2 * f; i++) both[i] = dal__collect(e->graph, both[i]);
            if (dal__cost(e->graph, both, 2 * f) >= dal__cost(e->graph, row, 2 * f)) continue;
            s->partner[a] = b;
            s->partner[b] = a;
            for (int i = 0; i < f; i++) {
                A[a * f + i] = both[i];
                A[b * f + i] = both[f + i];
            }
        }
}

/* R = W'^-1 B^T, and G = A R. */
static dal_status factor_forces(dal_model *model, dal__bordered *s)
{
    dal__equations *e = &model->equations;
    const int f = s->frees, m = s->retained_count;
    dal__node *A = dal__model_nodes(model, m * f, 0), *B = dal__model_nodes(model, m * f, 0);
    dal__node *R = dal__model_nodes(model, m * f, 0);
    int *whose = dal__model_allocate(model, (size_t)m, sizeof *whose); /* a pair's: the later */
    if (model->out_of_memory) return DAL_STATUS_OK;
    for (int a = 0; a < m; a++) {
        s->partner[a] = a;
        for (int i = 0; i < f; i++) {
            A[a * f + i] = e->A[s->retained[a] * e->n + s->free[i]];
            B[a * f + i] = e->B[s->retained[a] * e->n + s->free[i]];
        }
    }
    if (s->way & DAL__PAIRED && !e->servo) pair_constraints(model, s, A);
    for (int a = 0; a < m; a++) whose[a] = s->retained[s->partner[a] > a ? s->partner[a] : a];
    dal__factors_allocate(model, &s->forces, m, whose);
    dal__factors_solve(model, &s->mass, DAL__SUMS_UNCHANGED, m, e->servo ? B : A, R);
    compress(model, &s->A, m, f, A);
    compress(model, &s->R, m, f, R);
    if (model->out_of_memory) return DAL_STATUS_OK;
    for (int a = 0; a < m; a++)
        for (int b = 0; b < m; b++) {
            const bool known = b < a && !e->servo;
            s->forces.matrix[a * m + b] = known
                                              ? s->forces.matrix[b * m + a]
                                              : collect(e, s, row_product(e, &s->A, a, R + b * f));
        }
    return dal__factor(model, &s->forces);
}

/* ---- a right-hand side ---- */

/* s, u and t = b' of a right-hand side (top, bottom). */
static void reduce_rhs(const dal__equations *e, const dal__bordered *s, const dal__node *top,
                       const dal__node *bottom, vectors *w)
{
    const int n = e->n;
    for (int k = 0; k < s->solved; k++)
        w->s[k] = dal__node_div(e->graph, bottom[s->by[k]], s->alpha[k]);
    for (int i = 0; i < s->frees; i++) w->t[i] = top[s->free[i]];
    for (int k = 0; k < s->solved; k++) w->u[k] = top[s->dependent[k]];
    for (int l = 0; l < s->solved; l++) {
        const dal__node *row = e->W + s->dependent[l] * n;
        if (dal__node_is_zero(e->graph, w->s[l])) continue;
        for (int k = 0; k < s->solved; k++)
            subtract_product(e, &w->u[k], row[s->dependent[k]], w->s[l]);
        for (int i = 0; i < s->frees; i++) subtract_product(e, &w->t[i], row[s->free[i]], w->s[l]);
    }
    for (int k = 0; k < s->solved; k++)
        for (int x = s->S.first[k]; x < s->S.first[k + 1]; x++)
            dal__add_product(e->graph, &w->t[s->S.column[x]], s->S.value[x], w->u[k]);
}

/* The free coordinates and the forces of the retained constraints, from b' in t. */
static void solve_free(dal_model *model, const dal__bordered *s, dal__sum_form sums,
                       const dal__node *bottom, vectors *w)
{
    const dal__equations *e = &model->equations;
    dal__factors_solve(model, &s->mass, sums, 1, w->t, w->y);
    for (int a = 0; a < s->retained_count; a++) w->pull[a] = bottom[s->retained[a]];
    combine_pairs(e, s, w->pull);
    for (int a = 0; a < s->retained_count; a++) {
        if (s->partner[a] != a) w->pull[a] = collect(e, s, w->pull[a]);
        w->pull[a] = dal__node_sub(e->graph, w->pull[a], row_product(e, &s->A, a, w->y));
    }
    dal__factors_solve(model, &s->forces, sums, 1, w->pull, w->force);
    for (int a = 0; a < s->retained_count; a++)
        for (int x = s->R.first[a]; x < s->R.first[a + 1]; x++)
            dal__add_product(e->graph, &w->y[s->R.column[x]], s->R.value[x], w->force[a]);
}

/* All multipliers: of the retained constraints and, from row d of W x - A^T h, of the constraints
 * that were solved for a coordinate. */
static void find_forces(const dal__equations *e, const dal__bordered *s, const vectors *w,
                        const dal__node *top, const dal__node *x, dal__node *h)
{
    combine_pairs(e, s, w->force);
    for (int a = 0; a < s->retained_count; a++) h[s->retained[a]] = w->force[a];
    for (int k = 0; k < s->solved; k++) {
        const int d = s->dependent[k];
        dal__node sum = dal__node_neg(e->graph, top[d]);
        for (int i = 0; i < e->n; i++) dal__add_product(e->graph, &sum, e->W[d * e->n + i], x[i]);
        h[s->by[k]] = dal__node_div(e->graph, sum, s->alpha[k]);
    }
}

/* The dependent coordinates, collected while the free ones are symbols. */
static void collect_dependent(dal_model *model, const dal__bordered *s, const vectors *w,
                              dal__node *x)
{
    const dal__equations *e = &model->equations;
    int *symbol = dal__model_allocate(model, (size_t)s->frees, sizeof *symbol);
    dal__node *out = dal__model_nodes(model, s->solved, 0);
    dal__node *y = dal__model_nodes(model, s->frees, 0);
    if (model->out_of_memory) return;
    for (int i = 0; i < s->frees; i++) {
        symbol[i] = e->symbols + i;
        y[i] = dal__symbol(e->graph, symbol[i]);
    }
    for (int k = 0; k < s->solved; k++)
        out[k] = collect(e, s, dal__node_add(e->graph, w->s[k], row_product(e, &s->S, k, y)));
    dal__substitute_all(e->graph, s->solved, out, symbol, s->frees, w->y);
    for (int k = 0; k < s->solved; k++) x[s->dependent[k]] = out[k];
}

/* By the factors of the bordered matrix. */
static void solve_whole(dal_model *model, const dal__bordered *s, const dal__node *top,
                        const dal__node *bottom, dal__node *x, dal__node *h)
{
    const dal__equations *e = &model->equations;
    const int n = e->n, m = e->m;
    dal__node *const rhs = dal__model_nodes(model, 2 * (n + m), 0), *const all = rhs + n + m;
    if (model->out_of_memory) return;
    for (int k = 0; k < n + m; k++) rhs[k] = k < n ? top[k] : bottom[k - n];
    dal__factors_solve(model, &s->whole, DAL__SUMS_UNCHANGED, 1, rhs, all);
    for (int i = 0; i < n; i++) x[i] = all[i];
    for (int a = 0; a < m && h; a++) h[a] = dal__node_neg(e->graph, all[n + a]);
}

void dal__bordered_solve(dal_model *model, dal__bordered *s, dal__sum_form sums,
                         const dal__node *top, const dal__node *bottom, dal__node *x, dal__node *h)
{
    const dal__equations *e = &model->equations;
    const bool collected = sums == DAL__SUMS_COLLECTED;
    if (model->out_of_memory) return; /* there may be no factors */
    vectors *const w = &s->scratch;
    if (s->way & DAL__WHOLE) {
        solve_whole(model, s, top, bottom, x, h);
        return;
    }
    reduce_rhs(e, s, top, bottom, w);
    for (int i = 0; collected && i < s->frees; i++) w->t[i] = collect(e, s, w->t[i]);
    solve_free(model, s, s->way & DAL__FORWARD ? sums : DAL__SUMS_UNCHANGED, bottom, w);
    for (int i = 0; i < s->frees; i++) x[s->free[i]] = w->y[i];
    for (int k = 0; k < s->solved; k++)
        x[s->dependent[k]] = dal__node_add(e->graph, w->s[k], row_product(e, &s->S, k, w->y));
    if (collected) collect_dependent(model, s, w, x);
    if (h) find_forces(e, s, w, top, x, h);
}

/* ---- the whole ---- */

bool dal__bordered_is_reduced(const dal__bordered *s) { return s->solved > 0; }

bool dal__bordered_keeps_rank(const dal__bordered *s) { return s->retained_count == 0; }

/* Factors the bordered matrix of x and -h. */
static dal_status factor_whole(dal_model *model, dal__factors *f)
{
    const dal__equations *e = &model->equations;
    const int n = e->n, size = n + e->m;
    int *whose = dal__model_allocate(model, (size_t)size, sizeof *whose);
    for (int k = 0; whose && k < size; k++) whose[k] = k < n ? -1 : k - n;
    dal__factors_allocate(model, f, size, whose);
    if (model->out_of_memory) return DAL_STATUS_OK;
    for (int k = 0; k < size * size; k++) {
        const int i = k / size, j = k % size;
        f->matrix[k] = i < n && j < n ? e->W[i * n + j]
                       : i < n        ? e->A[(j - n) * n + i]
                       : j < n        ? e->A[(i - n) * n + j]
                                      : dal__number(e->graph, 0.0);
    }
    f->saddle = n;
    return dal__factor(model, f);
}

dal_status dal__bordered_factor(dal_model *model, const dal__factors *mass, unsigned way,
                                dal__bordered **bordered, int *singular)
{
    const int n = model->equations.n, m = model->equations.m;
    dal__bordered *s = *bordered = dal__model_allocate(model, 1, sizeof *s);
    *singular = -1;
    if (!s) return DAL_STATUS_OK;
    s->way = way;
    s->scratch = (vectors){.s = dal__model_nodes(model, m, 0),
                           .u = dal__model_nodes(model, m, 0),
                           .t = dal__model_nodes(model, n, 0),
                           .y = dal__model_nodes(model, n, 0),
                           .pull = dal__model_nodes(model, m, 0),
                           .force = dal__model_nodes(model, m, 0)};
    choose_dependent(model, s);
    if (model->out_of_memory) return DAL_STATUS_OK;
    if (way & DAL__WHOLE) {
        const dal_status status = factor_whole(model, &s->whole);
        if (status == DAL_STATUS_SINGULAR) *singular = s->whole.constraint[s->whole.singular] - 1;
        return status;
    }
    if (s->solved == 0) {
        s->mass = *mass;
    } else {
        dal__factors_allocate(model, &s->mass, s->frees, NULL);
        if (model->out_of_memory) return DAL_STATUS_OK;
        reduce_mass(&model->equations, s, s->mass.matrix);
        DAL_TRY(dal__factor(model, &s->mass));
    }
    const dal_status status = factor_forces(model, s);
    if (status == DAL_STATUS_SINGULAR) *singular = s->forces.constraint[s->forces.singular] - 1;
    return status;
}
