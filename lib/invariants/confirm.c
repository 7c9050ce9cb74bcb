/* confirm.c - formulas tried as invariants: their rates, and their independence.
 *
 * The rate of a formula at a point of D = 0 is compared with the sum of the sizes of its terms,
 *
 *     |I_t| + sum |I_q v| + sum |I_v F| + |power I tr F_v|
 *
 * Functions are independent on D = 0 where their gradients are, after projection off the gradients
 * of D; in units of q and v, at one point of three at least. */
#include "invariants/confirm.h"
#include "core/vectors.h"
#include "expr/derivative.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include "invariants/atoms.h"
#include "invariants/forms.h"
#include "invariants/points.h"
#include "kernel/quad.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { POINTS = 8, OF_INDEPENDENCE = 3 };
/* Fractions of the terms of a rate that are roundings of doubles; of a gradient, counted as 0. */
static const double rounding = 1e-10, dependent = 1e-7;

/* Likewise of quad precision, with the digits that terms lose in F. */
static const double quad_rounding = 1e5 * DBL_EPSILON * DAL_QUAD_ULP_RATIO;

/* ---- rates ---- */

/* The symbols that move: q, v, g; out[2n + multipliers]. */
static int list_symbols(const dal__equations *e, int *out)
{
    int count = 0;
    for (int i = 0; i < e->n; i++) out[count++] = e->q + i;
    for (int i = 0; i < e->n; i++) out[count++] = e->v + i;
    for (int i = 0; i < e->multipliers; i++) out[count++] = e->g + i;
    return count;
}

/* The terms of the rate of f, out[2 + moving], and the rate itself, the last. */
static void rate_terms(const dal__search *s, const dal__condition *condition, dal__node f,
                       const int *symbol, int moving, dal__node *out)
{
    const dal__equations *e = &s->model->equations;
    dal__node sum = dal__number(e->graph, 0.0);
    dal__gradient(e->graph, f, symbol, moving, out);
    for (int i = 0; i < moving; i++)
        out[i] = dal__node_mul(e->graph, out[i], i < e->n ? e->flow[1 + i] : e->F[i - e->n]);
    dal__gradient(e->graph, f, &e->t, 1, &out[moving]);
    out[moving + 1] = sum;
    if (condition->power != 0.0)
        out[moving + 1] = dal__node_mul(e->graph, dal__number(e->graph, condition->power),
                                        dal__node_mul(e->graph, f, dal__search_divergence(e)));
    for (int i = 0; i < moving + 2; i++) sum = dal__node_add(e->graph, sum, out[i]);
    out[moving + 2] = sum;
}

/* Outputs of one candidate: its value, then the terms of its rate, the rate the last. */
static int outputs_of(const dal__equations *e) { return 2 * e->n + e->multipliers + 4; }

static dal_status make_points(const dal__search *s, const dal__condition *condition,
                              const dal__candidate *candidate, int count, dal__points **points)
{
    const dal__equations *e = &s->model->equations;
    const int outputs = outputs_of(e);
    dal_status status = DAL_STATUS_MEMORY;
    int *symbol = calloc((size_t)outputs, sizeof *symbol);
    dal__node *node = calloc((size_t)outputs * (size_t)count + 1, sizeof *node);
    if (symbol && node) {
        const int moving = list_symbols(e, symbol);
        for (int k = 0; k < count; k++) {
            node[k * outputs] = candidate[k].node;
            rate_terms(s, condition, candidate[k].node, symbol, moving, node + k * outputs + 1);
        }
        status = dal__points_create(points, e, &s->region, node, count * outputs);
    }
    free(symbol);
    free(node);
    return status;
}

/* The largest rate of each candidate at some points over the sum of its terms, max[count], and its
 * sign. */
static dal_status measure_rates(dal__points *points, const double *parameter, int outputs,
                                dal__candidate *candidate, int count, double *out, double *max)
{
    dal__points_begin(points, parameter);
    for (int i = 0; i < POINTS; i++) {
        DAL_TRY(dal__points_next(points, out));
        for (int k = 0; k < count; k++) {
            const double *values = out + k * outputs;
            const bool is_negative = values[0] < 0.0;
            double sum = 0.0;
            for (int j = 1; j < outputs - 1; j++) sum += fabs(values[j]);
            if (sum > 0.0) max[k] = fmax(max[k], fabs(values[outputs - 1]) / sum);
            candidate[k].has_one_sign = values[0] != 0.0 && (i == 0 || candidate[k].has_one_sign) &&
                                        (i == 0 || candidate[k].is_negative == is_negative);
            candidate[k].is_negative = is_negative;
        }
    }
    return DAL_STATUS_OK;
}

dal_status dal__confirm(const dal__search *s, const dal__condition *condition,
                        dal__candidate *candidate, int count)
{
    const dal__equations *e = &s->model->equations;
    const int outputs = outputs_of(e);
    const size_t n = (size_t)count, values = n * (size_t)outputs;
    if (count == 0) return DAL_STATUS_OK;
    dal__points *points = NULL;
    double *block = dal__numbers(1, values + 2 * n + (size_t)e->parameters);
    dal_status status =
        block ? make_points(s, condition, candidate, count, &points) : DAL_STATUS_MEMORY;
    if (status == DAL_STATUS_OK) {
        double *max = block + values, *max_there = max + n, *other = max_there + n;
        dal__other_parameters(e, s->parameter, other);
        const dal_status there =
            measure_rates(points, other, outputs, candidate, count, block, max_there);
        status = measure_rates(points, s->parameter, outputs, candidate, count, block, max);
        for (int k = 0; k < count; k++) {
            candidate[k].holds = max[k] <= rounding;
            candidate[k].exact = max[k] <= quad_rounding;
            candidate[k].at_any_parameters = there == DAL_STATUS_OK && max_there[k] <= rounding;
        }
    }
    dal__points_free(points);
    free(block);
    return status;
}

/* ---- independence ---- */

/* Gradients of all, in the order D, E and the invariants of the system, candidates. */
typedef struct gradients {
    int constraints, known, count, moving;
    int *symbol;   /* [moving] by which they are taken */
    double *value; /* [(constraints + known + count)*moving] at a point, in units */
    double *rows;  /* [as many*moving] orthonormal */
} gradients;

/* Whether a row adds a direction to rows[*held]; then it is added. */
static bool adds_direction(gradients *g, const double *row, int *held)
{
    const size_t width = (size_t)g->moving;
    const double length = sqrt(dal__dot_product(g->moving, row, row));
    if (*held == g->moving || !(length > 0.0)) return false;
    double *const next = g->rows + (size_t)*held * width;
    for (size_t i = 0; i < width; i++) next[i] = row[i] / length;
    for (int pass = 0; pass < 2; pass++)
        for (int k = 0; k < *held; k++)
            dal__remove_component(next, g->rows + (size_t)k * width, g->moving);
    const double rest = sqrt(dal__dot_product(g->moving, next, next));
    if (!(rest > dependent)) return false;
    for (size_t i = 0; i < width; i++) next[i] /= rest;
    ++*held;
    return true;
}

/* Of what candidates are to be independent beside the constraints: earlier candidates, or those and
 * the invariants that are known. */
typedef enum others { CANDIDATES, KNOWN_TOO } others;

static void mark_independent(gradients *g, dal__candidate *candidate, others of)
{
    const size_t width = (size_t)g->moving;
    int held = 0;
    for (int i = 0; i < g->constraints; i++) adds_direction(g, g->value + (size_t)i * width, &held);
    for (int i = g->constraints; of == KNOWN_TOO && i < g->constraints + g->known; i++)
        adds_direction(g, g->value + (size_t)i * width, &held);
    for (int k = 0; k < g->count; k++) {
        const size_t at = (size_t)(g->constraints + g->known + k);
        const bool adds = adds_direction(g, g->value + at * width, &held);
        bool *const result = of == KNOWN_TOO ? &candidate[k].is_new : &candidate[k].independent;
        *result = *result || adds;
    }
}

/* All derivatives as formulas, *out. */
static dal_status list_gradients(const dal__search *s, const dal__candidate *candidate,
                                 gradients *g, dal__node **out)
{
    const dal__equations *e = &s->model->equations;
    const bool has_energy = e->energy && e->properties & (DAL_E_EXACT | DAL_E_ON_D);
    const int given = e->invariants - e->observed;
    g->constraints = e->m;
    g->known = given + has_energy;
    g->moving = 2 * e->n + e->multipliers;
    const size_t rows = (size_t)(g->constraints + g->known + g->count), width = (size_t)g->moving;
    g->symbol = calloc(width, sizeof *g->symbol);
    *out = calloc(rows * width + 1, sizeof **out);
    if (!g->symbol || !*out) return DAL_STATUS_MEMORY;
    list_symbols(e, g->symbol);
    for (size_t k = 0; k < rows; k++) {
        const int i = (int)k - g->constraints;
        const dal__node f = i < 0                      ? e->constraint[k]
                            : i < given                ? e->invariant[i]
                            : i == given && has_energy ? e->energy
                                                       : candidate[i - g->known].node;
        dal__gradient(e->graph, f, g->symbol, g->moving, *out + k * width);
    }
    return DAL_STATUS_OK;
}

dal_status dal__find_independent(const dal__search *s, dal__candidate *candidate, int count)
{
    gradients g = {.count = count};
    dal__node *node = NULL;
    dal__points *points = NULL;
    if (count == 0) return DAL_STATUS_OK;
    dal_status status = list_gradients(s, candidate, &g, &node);
    const size_t width = (size_t)g.moving,
                 values = (size_t)(g.constraints + g.known + count) * width;
    if (status == DAL_STATUS_OK) {
        g.value = dal__numbers(2, values);
        g.rows = g.value + values;
        status = g.value ? dal__points_create(&points, &s->model->equations, &s->region, node,
                                              (int)values)
                         : DAL_STATUS_MEMORY;
    }
    if (status == DAL_STATUS_OK) dal__points_begin(points, s->parameter);
    for (int i = 0; i < OF_INDEPENDENCE && status == DAL_STATUS_OK; i++) {
        status = dal__points_next(points, g.value);
        if (status != DAL_STATUS_OK) break;
        for (size_t k = 0; k < values; k++) g.value[k] *= s->region.reach[g.symbol[k % width]];
        mark_independent(&g, candidate, CANDIDATES);
        mark_independent(&g, candidate, KNOWN_TOO);
    }
    dal__points_free(points);
    free(node);
    free(g.symbol);
    free(g.value);
    return status;
}

/* ---- integrable constraints ---- */

/* D of a constraint at a point as a row of (t, q): out[1 + n], in units. */
static void row_of_constraint(const dal__equations *e, int a, double *value, const double *reach,
                              double *out)
{
    memset(value + e->v, 0, (size_t)e->n * sizeof *value);
    out[0] = dal__evaluate(e->graph, e->constraint[a], value) * reach[e->t];
    for (int i = 0; i < e->n; i++)
        out[1 + i] = dal__evaluate(e->graph, e->A[a * e->n + i], value) * reach[e->q + i];
}

static bool are_parallel(int count, const double *a, const double *b)
{
    const double aa = dal__dot_product(count, a, a), bb = dal__dot_product(count, b, b);
    const double ab = dal__dot_product(count, a, b);
    return aa > 0.0 && bb > 0.0 && aa * bb - ab * ab <= dependent * dependent * aa * bb;
}

/* Whether gradients by (t, q) are multiples of the row of constraint a at a point about the start,
 * number k from 1; memory[symbols + 2 (1 + n)]. */
static bool is_multiple(const dal__search *s, const dal__node *gradient, int a, int k,
                        double *memory)
{
    const dal__equations *e = &s->model->equations;
    const dal__region *r = &s->region;
    double *value = memory, *of_f = value + e->symbols, *row = of_f + 1 + e->n;
    for (int i = 0; i < e->symbols; i++)
        value[i] = r->centre[i] + r->reach[i] * (dal__golden_fraction((i + 1) * k) - 0.5);
    for (int i = 0; i < e->parameters; i++) value[i] = s->parameter[i];
    for (int i = 0; i <= e->n; i++)
        of_f[i] = dal__evaluate(e->graph, gradient[i], value) * r->reach[i ? e->q + i - 1 : e->t];
    row_of_constraint(e, a, value, r->reach, row);
    return are_parallel(1 + e->n, of_f, row);
}

dal_status dal__find_constraint(const dal__search *s, dal__node f, int *constraint)
{
    const dal__equations *e = &s->model->equations;
    const int rows = e->m - e->holonomic;
    double *memory = dal__numbers(1, (size_t)(e->symbols + 2 * (1 + e->n)));
    dal__node *gradient = calloc((size_t)e->n + 1, sizeof *gradient);
    const bool has_memory = memory && gradient;
    *constraint = -1;
    if (has_memory) dal__gradient(e->graph, f, e->symbol + e->t, 1 + e->n, gradient);
    for (int a = 0; has_memory && a < rows && *constraint < 0; a++) {
        int k = 1;
        while (k <= OF_INDEPENDENCE && is_multiple(s, gradient, a, k, memory)) k++;
        if (k > OF_INDEPENDENCE) *constraint = a;
    }
    free(gradient);
    free(memory);
    return has_memory ? DAL_STATUS_OK : DAL_STATUS_MEMORY;
}
