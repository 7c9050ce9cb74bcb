/* squares.c - sums of squares, by the form of a formula in the graph. */
#include "lift/squares.h"
#include "core/error.h"

/* A term of f that is to be a sum of squares, with its sign. */
typedef struct term {
    dal__node node;
    int sign;
} term;

void dal__squared_functions(const dal__surface *s, dal__node f, dal__node *squared, int *count)
{
    enum { MAX_TERMS = 256 };
    const dal__graph *graph = s->theory->graph;
    term waiting[MAX_TERMS + 2] = {{f, 1}};
    double value[DAL__SURFACE_POINTS];
    int terms = 1, sign = 0, of_factor = 0;
    *count = 0;
    while (terms > 0) {
        const term t = waiting[--terms];
        const dal__record r = dal__inspect(graph, t.node);
        const bool is_square = (r.op == DAL__MUL && r.a == r.b) ||
                               (r.op == DAL__POW && dal__is_number(graph, r.b, 2.0));
        bool fits = terms < MAX_TERMS;
        if (is_square) {
            fits = (sign == 0 || sign == t.sign) && *count < 2 * s->theory->pairs;
            sign = t.sign;
            if (fits) squared[(*count)++] = r.a;
        } else if (r.op == DAL__ADD || r.op == DAL__SUB) {
            waiting[terms++] = (term){r.a, t.sign};
            waiting[terms++] = (term){r.b, r.op == DAL__ADD ? t.sign : -t.sign};
        } else if (r.op == DAL__NEG) {
            waiting[terms++] = (term){r.a, -t.sign};
        } else if (r.op == DAL__DIV || r.op == DAL__MUL) {
            const bool is_first = r.op == DAL__MUL && dal__inspect(graph, r.a).fixed;
            const dal__node factor = is_first ? r.a : r.b;
            dal__surface_values(s, 1, &factor, value);
            of_factor = value[0] > 0.0 ? 1 : -1;
            for (int k = 0; k < DAL__SURFACE_POINTS; k++)
                of_factor *= value[k] * value[0] > 0.0; /* one sign at all points, or none */
            waiting[terms++] = (term){is_first ? r.b : r.a, of_factor * t.sign};
            fits = of_factor != 0;
        } else {
            fits = false;
        }
        if (fits) continue;
        *count = 0;
        return;
    }
}
