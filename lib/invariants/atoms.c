/* atoms.c - the factors from which invariants are made, and their products.
 *
 * Coordinates count where F or D contain them outside of sines, cosines and tangents; an argument
 * of one of these gives its cosine and its sine.  A product is made once, with the atoms in their
 * order:
 *
 *     1;  a, b, ..;  a a, a b, .., b b, ..;  a a a, .. */
#include "invariants/atoms.h"
#include "core/error.h"
#include "expr/derivative.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include "model/symbols.h"
#include <stdlib.h>
#include <string.h>

static dal_status add_atom(dal__search *s, const char *text, dal__node node)
{
    if (!text) return DAL_STATUS_MEMORY;
    for (int i = 0; i < s->atoms; i++)
        if (s->atom[i].node == node) return DAL_STATUS_OK;
    if (s->atoms == s->capacity) {
        const int capacity = 2 * s->capacity + 16;
        dal__atom *atom = dal__model_allocate(s->model, (size_t)capacity, sizeof *atom);
        if (!atom) return DAL_STATUS_MEMORY;
        for (int i = 0; i < s->atoms; i++) atom[i] = s->atom[i];
        s->atom = atom;
        s->capacity = capacity;
    }
    s->atom[s->atoms++] = (dal__atom){text, node};
    return DAL_STATUS_OK;
}

/* The name of a symbol in formulas; NULL: it has none. */
static const char *symbol_name(dal_model *model, int symbol)
{
    const dal__equations *e = &model->equations;
    if (symbol < e->parameters) return e->parameter[symbol];
    if (symbol == e->t) return "t";
    if (symbol >= e->q && symbol < e->q + e->n) return e->coordinate[symbol - e->q];
    if (symbol >= e->v && symbol < e->v + e->n)
        return dal__model_print(model, "%s'", e->coordinate[symbol - e->v]);
    if (symbol >= e->g && symbol < e->g + e->multipliers)
        return dal__model_print(model, "g%d", symbol - e->g + 1);
    return NULL;
}

/* The text of an argument that is a sum of multiples of symbols; NULL: it is not. */
static const char *argument_text(dal_model *model, dal__node node, int depth)
{
    const dal__record r = dal__inspect(model->equations.graph, node);
    const char *a, *b;
    if (depth == 0) return NULL;
    switch ((dal__op)r.op) {
    case DAL__SYMBOL:
        return symbol_name(model, r.symbol);
    case DAL__NUMBER:
        return r.value > 0.0 && r.value < 100.0 && r.value == (int)r.value
                   ? dal__model_print(model, "%d", (int)r.value)
                   : NULL;
    case DAL__ADD:
    case DAL__SUB:
    case DAL__MUL:
        a = argument_text(model, r.a, depth - 1);
        b = argument_text(model, r.b, depth - 1);
        if (!a || !b) return NULL;
        return r.op == DAL__MUL   ? dal__model_print(model, "%s*%s", a, b)
               : r.op == DAL__ADD ? dal__model_print(model, "(%s + %s)", a, b)
                                  : dal__model_print(model, "(%s - %s)", a, b);
    default:
        return NULL;
    }
}

/* Cosine and sine of an argument, unless they are atoms already. */
static dal_status add_angle(dal__search *s, dal__node argument)
{
    enum { MAX_DEPTH = 8 };
    dal__graph *graph = s->model->equations.graph;
    const dal__node opposite = dal__node_neg(graph, argument);
    const dal__record r = dal__inspect(graph, argument);
    const dal__node angle = r.op == DAL__NEG ? opposite : argument;
    const char *text = argument_text(s->model, angle, MAX_DEPTH);
    if (!text) return DAL_STATUS_OK;
    const size_t length = strlen(text);
    const bool is_wrapped = text[0] == '(' && strchr(text, ')') == text + length - 1;
    const char *begin = is_wrapped ? "" : "(", *end = is_wrapped ? "" : ")";
    DAL_TRY(add_atom(s, dal__model_print(s->model, "cos%s%s%s", begin, text, end),
                     dal__apply(graph, DAL__COS, angle, 0)));
    return add_atom(s, dal__model_print(s->model, "sin%s%s%s", begin, text, end),
                    dal__apply(graph, DAL__SIN, angle, 0));
}

/* Marks what F and D contain: 1 outside of sines and the like, 2 as an argument of one. */
static uint8_t *mark_equations(const dal__equations *e)
{
    uint8_t *mark = calloc((size_t)e->graph->count + 1, sizeof *mark);
    for (int i = 0; mark && i < e->n + e->multipliers; i++) mark[e->F[i]] = 1;
    for (int a = 0; mark && a < e->m; a++) mark[e->constraint[a]] = 1;
    for (dal__node i = e->graph->count; mark && i > 0; i--) {
        const dal__record r = dal__inspect(e->graph, i);
        if (!(mark[i] & 1)) continue;
        if ((r.op == DAL__SIN || r.op == DAL__COS || r.op == DAL__TAN) && !r.fixed) {
            mark[r.a] |= 2;
            continue;
        }
        mark[r.a] |= 1;
        mark[r.b] |= 1;
        mark[r.c] |= 1;
    }
    return mark;
}

static dal_status add_symbols(dal__search *s, int first, int count, const uint8_t *mark)
{
    for (int i = first; i < first + count; i++) {
        const dal__node node = dal__find_symbol(s->model->equations.graph, i);
        if (mark && !(node && mark[node] & 1)) continue;
        DAL_TRY(add_atom(s, symbol_name(s->model, i), dal__symbol(s->model->equations.graph, i)));
    }
    return DAL_STATUS_OK;
}

dal_status dal__search_parse(dal_model *model, const char *text, int number, dal__node *node,
                             dal_error *error)
{
    const dal__scope scope =
        dal__scope_of(&model->equations, DAL__MAY_T | DAL__MAY_STATE | DAL__MAY_MULTIPLIERS);
    const dal__entry entry = {.section = DAL_SECTION_INVARIANTS,
                              .name = text,
                              .text = text,
                              .line = number,
                              .column = 1,
                              .observed = true};
    return dal__parse_entry(model, &entry, scope, node, error);
}

/* Whether a formula is a name, or a call of a function, so that it needs no parentheses. */
static bool is_primary(const char *text)
{
    const size_t name = strcspn(text, "+-*/^<>=!&|,( ");
    int depth = 0;
    for (const char *c = text + name; *c; c++) {
        depth += (*c == '(') - (*c == ')');
        if (depth == 0 && c[1] != '\0') return false;
    }
    return name > 0 && depth == 0;
}

dal_status dal__search_atoms(dal__search *s, const dal_invariants_settings *settings,
                             dal_error *error)
{
    const dal__equations *e = &s->model->equations;
    const dal__node last = e->graph->count;
    uint8_t *mark = mark_equations(e);
    if (!mark) return dal__memory_error(error);
    dal_status status = add_symbols(s, e->q, e->n, settings->of_coordinates ? NULL : mark);
    for (dal__node i = 1; i <= last && status == DAL_STATUS_OK; i++)
        if (mark[i] & 2) status = add_angle(s, i);
    if (status == DAL_STATUS_OK) status = add_symbols(s, e->v, e->n, NULL);
    if (status == DAL_STATUS_OK) status = add_symbols(s, e->g, e->multipliers, NULL);
    if (status == DAL_STATUS_OK && settings->of_coordinates) status = add_symbols(s, e->t, 1, mark);
    free(mark);
    DAL_TRY(dal__check_size(status, error));
    for (int i = 0; i < settings->with_count; i++) {
        dal__node node;
        const char *text = settings->with[i];
        DAL_TRY(dal__search_parse(s->model, text, i + 1, &node, error));
        const char *name = dal__model_print(s->model, is_primary(text) ? "%s" : "(%s)", text);
        DAL_TRY(dal__check_size(add_atom(s, name, node), error));
    }
    return DAL_STATUS_OK;
}

void dal__search_remove(dal__search *s, int first, int end)
{
    int kept = 0;
    for (int i = 0; i < s->atoms; i++)
        if (!dal__depends(s->model->equations.graph, s->atom[i].node, first, end))
            s->atom[kept++] = s->atom[i];
    s->atoms = kept;
}

dal_status dal__search_products(dal__search *s, dal_error *error)
{
    double count = 1.0; /* binomial of atoms + degree over degree */
    for (int k = 1; k <= s->degree; k++) count *= (double)(s->atoms + k) / k;
    if (count > DAL__MAX_PRODUCTS + 1.5)
        return dal__fail(error, DAL_STATUS_TOO_LARGE,
                         "%d atoms have %.0f products of degree %d at most; %d are possible",
                         s->atoms, count - 1.0, s->degree, (int)DAL__MAX_PRODUCTS);
    s->product = dal__model_allocate(s->model, (size_t)(count + 0.5), sizeof *s->product);
    if (!s->product) return dal__memory_error(error);
    s->product[0] = (dal__product){0, 0};
    s->products = 1;
    for (int first = 0, k = 1; k <= s->degree; k++) {
        const int end = s->products;
        for (int parent = first; parent < end; parent++)
            for (int i = s->product[parent].last; i < s->atoms; i++)
                s->product[s->products++] = (dal__product){parent, i};
        first = end;
    }
    return DAL_STATUS_OK;
}

/* ---- derivatives along the motion ---- */

dal__node dal__search_rate(const dal__equations *e, dal__node f)
{
    const int flow = 1 + e->n, count = flow + e->n + e->multipliers;
    int *symbol = malloc((size_t)count * sizeof *symbol);
    dal__node *seed = malloc((size_t)count * sizeof *seed), rate = 0;
    for (int i = 0; symbol && seed && i < count; i++) {
        symbol[i] = i == 0 ? e->t : i < flow ? e->q + i - 1 : e->v + i - flow;
        if (i >= flow + e->n) symbol[i] = e->g + i - flow - e->n;
        seed[i] = i < flow ? e->flow[i] : e->F[i - flow];
    }
    if (symbol && seed) rate = dal__tangent(e->graph, f, symbol, count, seed);
    if (!rate && e->graph->status == DAL_STATUS_OK) e->graph->status = DAL_STATUS_MEMORY;
    free(symbol);
    free(seed);
    return rate;
}

dal__node dal__search_divergence(const dal__equations *e)
{
    dal__node sum = dal__number(e->graph, 0.0);
    for (int i = 0; i < e->n; i++) {
        const int symbol = e->v + i;
        dal__node derivative;
        dal__gradient(e->graph, e->F[i], &symbol, 1, &derivative);
        sum = dal__node_add(e->graph, sum, derivative);
    }
    return sum;
}
