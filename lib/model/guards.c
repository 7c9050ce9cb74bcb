/* guards.c - expressions of the constraints, det W and, with given reactions, det A W^-1 B^T: they
 * must keep their signs along a run.
 *
 * Where a denominator passes through zero, or tan(x) through a pole, a step can pass the
 * singularity without noticing it; so it can where the Jacobian of D = f(q,t) (...) vanishes with
 * f.  Guards are the factors of every denominator, cos(x) for every tan(x) and the factors of D
 * itself that are free of velocities, if they depend on more than parameters. */
#include "model/guards.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include "model/model.h"

enum { REACHED = 1, FACTOR = 2, WHOLE = 4, MAX_GUARDS = 4096 };

typedef struct search {
    dal_model *model;
    unsigned char *flag; /* [nodes] */
    int constraint;
    bool full;
} search;

/* False where the node is no guard, since it is constant along a run, or there are too many. */
static bool append_guard(search *s, dal__node node, const char *name)
{
    dal__equations *e = &s->model->equations;
    if (!dal__depends(e->graph, node, e->parameters, e->symbols)) return false;
    s->full = s->full || e->guards == MAX_GUARDS;
    if (s->full) return false;
    e->guard[e->guards] = node;
    e->guard_name[e->guards++] = name;
    return true;
}

static void add_guard(search *s, dal__node node, const char *text)
{
    const dal__equations *e = &s->model->equations;
    dal__record r = dal__inspect(e->graph, node);
    dal__record inner = r.op == DAL__COS ? dal__inspect(e->graph, r.a) : r;
    if (inner.op == DAL__SYMBOL) {
        const int i = inner.symbol - e->q, j = inner.symbol - e->v;
        text = "t";
        if (i >= 0 && i < e->n) text = e->coordinate[i];
        if (j >= 0 && j < e->n) text = dal__model_print(s->model, "%s'", e->coordinate[j]);
    }
    if (text && inner.op == DAL__SYMBOL && r.op == DAL__COS)
        text = dal__model_print(s->model, "cos(%s)", text);
    if (text)
        append_guard(s, node, dal__model_print(s->model, "constraint %d: %s", s->constraint, text));
}

/* A denominator, or a factor of one or of D: split until it is no product. */
static void split_factor(search *s, dal__node node, dal__record r)
{
    switch (r.op) {
    case DAL__MUL:
        s->flag[r.b] |= FACTOR;
        s->flag[r.a] |= FACTOR;
        break;
    case DAL__DIV:
    case DAL__NEG:
    case DAL__SQRT:
        s->flag[r.a] |= FACTOR;
        break;
    case DAL__POW:
        if (!dal__depends(s->model->equations.graph, r.b, 0, s->model->equations.symbols))
            s->flag[r.a] |= FACTOR;
        break;
    case DAL__NUMBER:
        break;
    default:
        add_guard(s, node, s->flag[node] & WHOLE ? "a factor" : "a denominator");
    }
}

static void visit(search *s, dal__node node)
{
    const dal__equations *e = &s->model->equations;
    dal__graph *graph = e->graph;
    dal__record r = dal__inspect(graph, node);
    if (s->flag[node] & WHOLE) { /* D itself, or a factor of it */
        const bool factors = r.op == DAL__MUL || r.op == DAL__DIV || r.op == DAL__NEG;
        if (!dal__depends(graph, node, e->v, e->v + e->n)) s->flag[node] |= FACTOR;
        if (r.op == DAL__MUL) s->flag[r.b] |= WHOLE;
        if (factors) s->flag[r.a] |= WHOLE;
    }
    if (s->flag[node] & FACTOR) split_factor(s, node, r);
    if (r.a) s->flag[r.a] |= REACHED;
    if (r.b) s->flag[r.b] |= REACHED;
    if (r.op == DAL__DIV) s->flag[r.b] |= FACTOR;
    if (r.op == DAL__TAN) add_guard(s, dal__apply(graph, DAL__COS, r.a, 0), "a denominator");
    if (r.op != DAL__POW) return;
    dal__record exponent = dal__inspect(graph, r.b);
    if (exponent.op == DAL__NUMBER && exponent.value < 0.0) s->flag[r.a] |= FACTOR;
}

/* The product of the pivots of W or of A W^-1 B^T, where it varies along a run: the matrix is
 * singular where it passes through zero, and a step can pass that, too. */
static bool guard_determinant(search *s, bool mass, const char *name)
{
    dal__equations *e = &s->model->equations;
    dal__node det = dal__number(e->graph, 1.0);
    for (int k = 0; k < e->pivots; k++)
        if (mass == (e->pivot[k].constraint == 0))
            det = dal__node_mul(e->graph, det, e->pivot[k].pivot);
    return !e->vakonomic && append_guard(s, det, name);
}

dal_status dal__guards(dal_model *model)
{
    dal__equations *e = &model->equations;
    int count = e->graph->count;
    search s = {.model = model};
    e->guard = dal__model_nodes(model, MAX_GUARDS, 0);
    e->guard_name = dal__model_allocate(model, MAX_GUARDS, sizeof *e->guard_name);
    for (int a = 0; a < e->m && !model->out_of_memory; a++) {
        s.constraint = a + 1;
        s.flag = dal__model_allocate(model, (size_t)count + 1, 1);
        if (!s.flag) break;
        s.flag[e->constraint[a]] = REACHED | WHOLE;
        for (dal__node node = e->constraint[a]; node > 0; node--)
            if (s.flag[node]) visit(&s, node);
    }
    if (model->out_of_memory) return DAL_MEMORY;
    if (e->servo) guard_determinant(&s, false, "the reactions: det A W^-1 B^T");
    if (guard_determinant(&s, true, "the mass matrix: det W")) e->mass_guard = e->guards;
    return s.full ? DAL_TOO_LARGE : e->graph->status;
}
