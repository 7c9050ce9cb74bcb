/* collect.c - sums of products, written with few operations.
 *
 *     sin u (a sin u + b cos u) + cos u (a cos u - b sin u) = a
 *
 * A term is a coefficient, which is constant along a run, times factors, which are no sums or
 * products themselves.  Equal terms are added last: what remains of f sin(u)^2 + f cos(u)^2 and
 * f - f is found among terms as they came. */
#include "expr/collect.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include <limits.h>
#include <stdlib.h>

enum { MAX_TERMS = 48, MAX_FACTORS = 12 };

typedef struct term {
    dal__node coefficient;
    int factors;
    dal__node factor[MAX_FACTORS]; /* ascending */
} term;

typedef struct sum {
    int terms; /* -1: too many, or one with too many factors */
    term term[MAX_TERMS];
} sum;

/* ---- expanding ---- */

static sum constant(dal__node coefficient)
{
    sum s = {.terms = 1};
    s.term[0] = (term){.coefficient = coefficient};
    return s;
}

static void multiply_term(dal__graph *graph, const term *x, const term *y, sum *out)
{
    if (out->terms < 0 || out->terms == MAX_TERMS || x->factors + y->factors > MAX_FACTORS) {
        out->terms = -1;
        return;
    }
    term *t = &out->term[out->terms++];
    *t = (term){.coefficient = dal__node_mul(graph, x->coefficient, y->coefficient)};
    for (int i = 0, j = 0; i < x->factors || j < y->factors;) {
        const bool first = j == y->factors || (i < x->factors && x->factor[i] <= y->factor[j]);
        t->factor[t->factors++] = first ? x->factor[i++] : y->factor[j++];
    }
}

static sum multiply(dal__graph *graph, const sum *x, const sum *y)
{
    sum out = {.terms = x->terms < 0 || y->terms < 0 ? -1 : 0};
    for (int i = 0; i < x->terms && out.terms >= 0; i++)
        for (int j = 0; j < y->terms; j++) multiply_term(graph, &x->term[i], &y->term[j], &out);
    return out;
}

static sum add(dal__graph *graph, const sum *x, const sum *y, bool minus)
{
    sum out = *x;
    if (x->terms < 0 || y->terms < 0 || x->terms + y->terms > MAX_TERMS) out.terms = -1;
    for (int j = 0; out.terms >= 0 && j < y->terms; j++) {
        term t = y->term[j];
        if (minus) t.coefficient = dal__node_neg(graph, t.coefficient);
        out.term[out.terms++] = t;
    }
    return out;
}

/* depth limits the recursion. */
static sum expand(dal__graph *graph, dal__node node, int depth)
{
    const dal__record r = dal__inspect(graph, node);
    if (r.fixed) return constant(node);
    const bool product = r.op == DAL__MUL, total = r.op == DAL__ADD || r.op == DAL__SUB;
    const bool ratio = r.op == DAL__DIV && dal__inspect(graph, r.b).fixed;
    sum x = constant(dal__number(graph, r.op == DAL__NEG ? -1.0 : 1.0));
    if (depth == 0) x.terms = -1;
    if (x.terms < 0) return x;
    if (product || total) {
        x = expand(graph, r.a, depth - 1);
        if (x.terms < 0) return x;
        const sum y = expand(graph, r.b, depth - 1);
        return product ? multiply(graph, &x, &y) : add(graph, &x, &y, r.op == DAL__SUB);
    }
    if (ratio || r.op == DAL__NEG) {
        if (ratio) x.term[0].coefficient = dal__node_div(graph, x.term[0].coefficient, r.b);
        const sum y = expand(graph, r.a, depth - 1);
        return multiply(graph, &x, &y);
    }
    x.term[0].factor[x.term[0].factors++] = node;
    return x;
}

/* ---- simplifying ---- */

static void drop(sum *s, int i) { s->term[i] = s->term[--s->terms]; }

static bool same_factors(const term *x, const term *y)
{
    bool same = x->factors == y->factors;
    for (int i = 0; same && i < x->factors; i++) same = x->factor[i] == y->factor[i];
    return same;
}

/* Takes the square of a factor out of a term; false where there is none. */
static bool take_square(const term *x, dal__node factor, term *rest)
{
    int taken = 0;
    *rest = (term){.coefficient = x->coefficient};
    for (int i = 0; i < x->factors; i++)
        if (x->factor[i] == factor && taken < 2)
            taken++;
        else
            rest->factor[rest->factors++] = x->factor[i];
    return taken == 2;
}

/* f sin(u)^2 + f cos(u)^2 = f: whether x is the first and y the second, with f in *common. */
static bool is_pythagoras(const dal__graph *graph, const term *x, const term *y, term *common)
{
    term other;
    if (x->coefficient != y->coefficient || x->factors != y->factors) return false;
    for (int i = 0; i < x->factors; i++) {
        const dal__record r = dal__inspect(graph, x->factor[i]);
        const dal__node cosine = r.op == DAL__SIN ? dal__find(graph, DAL__COS, r.a, 0) : 0;
        if (cosine && take_square(x, x->factor[i], common) && take_square(y, cosine, &other) &&
            same_factors(common, &other))
            return true;
    }
    return false;
}

/* Whether term i and a later one are simplified into one or none. */
static bool simplify_with_later(dal__graph *graph, sum *s, int i)
{
    const dal__node opposite = dal__node_neg(graph, s->term[i].coefficient);
    for (int j = 0; j < s->terms; j++) {
        term common;
        if (j == i) continue;
        if (is_pythagoras(graph, &s->term[i], &s->term[j], &common)) {
            s->term[i] = common;
            return drop(s, j), true;
        }
        if (s->term[j].coefficient == opposite && same_factors(&s->term[i], &s->term[j])) {
            drop(s, i > j ? i : j);
            return drop(s, i > j ? j : i), true;
        }
    }
    return false;
}

/* ---- writing ---- */

static bool has_factor(const term *t, dal__node factor)
{
    for (int i = 0; i < t->factors; i++)
        if (t->factor[i] == factor) return true;
    return false;
}

/* The factor of most terms, at least two; of equal ones a sine or cosine, then the oldest; or 0. */
static dal__node common_factor(const dal__graph *graph, const term *terms, int count)
{
    dal__node best = 0;
    int most = 3; /* twice the terms, and 1 for a sine or cosine */
    for (int i = 0; i < count; i++)
        for (int k = 0; k < terms[i].factors; k++) {
            const dal__node f = terms[i].factor[k];
            const dal__record r = dal__inspect(graph, f);
            int weight = r.op == DAL__SIN || r.op == DAL__COS;
            for (int j = 0; j < count; j++) weight += 2 * has_factor(&terms[j], f);
            if (weight < 4 || weight < most || (weight == most && best && f >= best)) continue;
            most = weight;
            best = f;
        }
    return best;
}

/* The terms are reordered. */
static dal__node write_sum(dal__graph *graph, term *terms, int count)
{
    dal__node total = dal__number(graph, 0.0);
    const dal__node factor = common_factor(graph, terms, count);
    int inside = 0;
    for (int i = 0; i < count; i++) {
        const term t = terms[i];
        if (!factor) {
            dal__node product = dal__number(graph, 1.0);
            for (int k = 0; k < t.factors; k++)
                product = dal__node_mul(graph, product, t.factor[k]);
            total = dal__node_add(graph, total, dal__node_mul(graph, t.coefficient, product));
            continue;
        }
        if (!has_factor(&t, factor)) continue;
        terms[i] = terms[inside];
        terms[inside] = (term){.coefficient = t.coefficient};
        bool taken = false;
        for (int k = 0; k < t.factors; k++)
            if (t.factor[k] == factor && !taken)
                taken = true;
            else
                terms[inside].factor[terms[inside].factors++] = t.factor[k];
        inside++;
    }
    if (!factor) return total;
    dal__node rest = write_sum(graph, terms + inside, count - inside);
    dal__node product = dal__node_mul(graph, factor, write_sum(graph, terms, inside));
    return dal__node_add(graph, product, rest);
}

int dal__cost(dal__graph *graph, const dal__node *nodes, int count)
{
    enum { DIVISION = 4, FUNCTION = 15 };
    const dal__node last = dal__last_of(nodes, count);
    int cost = 0;
    uint8_t *mark = dal__per_node(graph, last, 1);
    if (!mark) return INT_MAX;
    for (int k = 0; k < count; k++) mark[nodes[k]] = 1;
    for (dal__node i = last; i > 0; i--) {
        const dal__lowered l = dal__lower(graph, i);
        if (!mark[i] || dal__inspect(graph, i).fixed || !l.a) continue;
        mark[l.a] = mark[l.b] = mark[l.c] = 1;
        cost += l.op == DAL__DIV || l.op == DAL__SQRT    ? DIVISION
                : l.op >= DAL__POW && l.op <= DAL__ASINH ? FUNCTION
                                                         : 1;
    }
    free(mark);
    return cost;
}

dal__node dal__collect(dal__graph *graph, dal__node node)
{
    enum { MAX_DEPTH = 24 };
    const dal__record r = dal__inspect(graph, node);
    if (graph->status || r.fixed || !r.a) return node;
    sum s = expand(graph, node, MAX_DEPTH);
    for (int i = 0; i < s.terms; i++)
        if (simplify_with_later(graph, &s, i)) i = -1;
    for (int i = 0; i < s.terms; i++)
        for (int j = s.terms; j-- > i + 1;) {
            dal__node *sum_of = &s.term[i].coefficient;
            if (!same_factors(&s.term[i], &s.term[j])) continue;
            *sum_of = dal__node_add(graph, *sum_of, s.term[j].coefficient);
            drop(&s, j);
        }
    if (s.terms < 0) return node;
    dal__node written = write_sum(graph, s.term, s.terms);
    return dal__cost(graph, &written, 1) < dal__cost(graph, &node, 1) ? written : node;
}
