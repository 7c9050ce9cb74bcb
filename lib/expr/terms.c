/* terms.c - the size of the terms that a formula adds up.
 *
 * The scale of a formula f at a point is the largest product
 *
 *     S(f) = max |df/dn n|       over the nodes n of f that vary along a run, and f itself
 *
 * with values in one forward sweep and df/dn in one reverse sweep, both in numbers.  It contains
 * |f|, every |x df/dx| and every intermediate term, so that eps S is what one rounding can do.  It
 * is 0 only where every term is, and changes with the units as f does: exactly by a power of two.
 *
 * A node of a branch that is not taken has df/dn = 0 and counts for nothing, whatever its value;
 * neither does one that is 0.  A term that is not finite makes S infinite. */
#include "expr/terms.h"
#include "expr/partials.h"
#include "expr/table.h"
#include "expr/traversal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The nodes of all formulas, each once: the operands of each are places before it, and place 0 is
 * no node. */
struct dal__terms {
    const struct dal__tape_table *tables;
    dal__record *place; /* [places] */
    int *root;          /* [formulas] places of the formulas themselves */
    int places, formulas;
};

void dal__terms_free(dal__terms *t)
{
    if (t) free(t->place);
    if (t) free(t->root);
    free(t);
}

void dal__terms_count_fixed(dal__terms *t)
{
    for (int i = 0; i < t->places; i++) t->place[i].fixed = false;
}

/* Copies the marked nodes in their order; image[node] is where each went. */
static void copy_nodes(dal__terms *t, const dal__graph *graph, dal__node last, const uint8_t *mark,
                       int *image)
{
    t->places = 1;
    for (dal__node i = dal__first_marked(mark, 1, last); i > 0;
         i = dal__first_marked(mark, i + 1, last)) {
        dal__record r = dal__inspect(graph, i);
        r.a = image[r.a];
        r.b = image[r.b];
        r.c = image[r.c];
        image[i] = t->places;
        t->place[t->places++] = r;
    }
}

/* False: out of memory. */
static bool copy_formulas(dal__terms *t, dal__graph *graph, const dal__node *formula, int count)
{
    const dal__node last = dal__last_of(formula, count);
    uint8_t *mark = dal__reach_all(graph, formula, count);
    int *image = dal__per_node(graph, last, sizeof *image);
    size_t places = 1;
    for (dal__node i = mark ? dal__last_marked(mark, last) : 0; i > 0;
         i = dal__last_marked(mark, i - 1))
        places++;
    t->place = calloc(places, sizeof *t->place);
    t->root = calloc((size_t)count + 1, sizeof *t->root);
    const bool made = mark && image && t->place && t->root;
    if (made) copy_nodes(t, graph, last, mark, image);
    for (int k = 0; k < count && made; k++) t->root[k] = image[formula[k]];
    t->formulas = count;
    free(mark);
    free(image);
    return made;
}

dal__terms *dal__terms_create(dal__graph *graph, const dal__node *formula, int count)
{
    dal__terms *t = calloc(1, sizeof *t);
    if (t) t->tables = graph->tables;
    if (t && copy_formulas(t, graph, formula, count)) return t;
    dal__terms_free(t);
    return NULL;
}

/* Values, adjoints, and a mark for each. */
size_t dal__terms_memory(const dal__terms *t)
{
    const size_t places = (size_t)t->places;
    return 2 * places + (places + sizeof(double) - 1) / sizeof(double);
}

/* ---- the derivatives of one operation ---- */

#define SUM(x, y)        ((x) + (y))
#define DIFFERENCE(x, y) ((x) - (y))
#define PRODUCT(x, y)    ((x) * (y))
#define RATIO(x, y)      ((x) / (y))
#define MINUS(x)         (-(x))
#define SQUARE(x)        ((x) * (x))
#define NUMBER(x)        (x)
#define POWER(x, y)      dal__operate(DAL__POW, x, y, 0.0)
#define DIRECTION(x, r)  ((r) == 0.0 ? 0.0 : (x) / (r))
#define ROOT(c, sign, x) sqrt((c) + (sign) * (x) * (x))
#define TABLE_SLOPE(x)   dal__table_value(tables, r->symbol + 1, x)
#define OF(function, x)  dal__operate(DAL__##function, x, 0.0, 0.0)

/* Adds k times the derivatives of a node, whose value is y, to the adjoints of its operands. */
static void add_partials(const struct dal__tape_table *tables, const dal__record *r, double y,
                         double k, const double *value, double *adjoint)
{
    const double a = value[r->a], b = value[r->b];
    double *const to_a = &adjoint[r->a], *const to_b = &adjoint[r->b];
    switch ((dal__op)r->op) {
#define OF_BOTH(code, first, second)                                                               \
    case DAL__##code:                                                                              \
        *to_a += first;                                                                            \
        *to_b += second;                                                                           \
        break;
#define OF_ONE(code, derivative)                                                                   \
    case DAL__##code:                                                                              \
        *to_a += derivative;                                                                       \
        break;
        DAL__PARTIAL_LIST(OF_BOTH, OF_ONE)
#undef OF_BOTH
#undef OF_ONE
    case DAL__IF:
        adjoint[a != 0.0 ? r->b : r->c] += k;
        break;
    case DAL__MIN:
        *(b < a ? to_b : to_a) += k;
        break;
    case DAL__MAX:
        *(a < b ? to_b : to_a) += k;
        break;
    default: /* a step, which has no derivative */
        break;
    }
}

/* ---- both sweeps ---- */

static void forward(const dal__terms *t, const double *symbol, double *value)
{
    value[0] = NAN;
    for (int i = 1; i < t->places; i++) {
        const dal__record *r = &t->place[i];
        value[i] = r->op == DAL__NUMBER   ? r->value
                   : r->op == DAL__SYMBOL ? symbol[r->symbol]
                   : r->op == DAL__TABLE
                       ? dal__table_value(t->tables, r->symbol, value[r->a])
                       : dal__operate(r->op, value[r->a], value[r->b], value[r->c]);
    }
}

/* Where x is 0 and the derivative infinite, as of sqrt(x), neither x nor what it is made of
 * counts. */
static bool counts(double adjoint, double x)
{
    return adjoint != 0.0 && (x != 0.0 || isfinite(adjoint));
}

/* adjoint and mark, which says where an adjoint need not be 0, are 0 before and after: a formula
 * has few of the nodes. */
static double reverse(const dal__terms *t, int root, const double *value, double *adjoint,
                      uint8_t *mark)
{
    double scale = fabs(value[root]);
    adjoint[root] = 1.0;
    mark[root] = 1;
    for (int i = root; i > 0; i = dal__last_marked(mark, i - 1)) {
        const dal__record *r = &t->place[i];
        const double k = adjoint[i];
        adjoint[i] = 0.0;
        mark[i] = 0;
        if (r->fixed || !counts(k, value[i])) continue;
        const double term = fabs(k * value[i]);
        if (!(term <= scale)) scale = term;
        add_partials(t->tables, r, value[i], k, value, adjoint);
        mark[r->a] = mark[r->b] = mark[r->c] = 1;
    }
    adjoint[0] = 0.0;
    mark[0] = 0;
    return isnan(scale) ? INFINITY : scale;
}

void dal__terms_scales(const dal__terms *t, const double *symbol, double *memory, double *out)
{
    double *const value = memory, *const adjoint = value + t->places;
    uint8_t *const mark = (uint8_t *)(adjoint + t->places);
    forward(t, symbol, value);
    memset(adjoint, 0, (size_t)t->places * sizeof *adjoint);
    memset(mark, 0, (size_t)t->places);
    for (int k = 0; k < t->formulas; k++) out[k] = reverse(t, t->root[k], value, adjoint, mark);
}
