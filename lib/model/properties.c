/* properties.c - what the formulas say about constraints and motion, decided on the graph: their
 * properties, and what must keep its sign along a run.  A system without constraints has none of
 * the properties of D. */
#include "model/properties.h"
#include "core/settings.h"
#include "expr/derivative.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include "model/bordered.h"
#include "model/energy.h"
#include "model/model.h"
#include <stdlib.h>

/* ---- constraints ---- */

/* The derivatives of a node by q and v, one after the other. */
static void state_gradient(const dal__equations *e, dal__node f, dal__node *out)
{
    dal__gradient(e->graph, f, e->symbol + e->q, e->n, out);
    dal__gradient(e->graph, f, e->symbol + e->v, e->n, out + e->n);
}

static bool varies(const dal__equations *e, dal__node f)
{
    return dal__depends(e->graph, f, e->parameters, e->symbols);
}

/* Whether a velocity decides which branch of f is taken. */
static bool branches_by_v(const dal__equations *e, dal__node f)
{
    const int v = e->v, end = e->v + e->n;
    uint8_t *mark = dal__reach(e->graph, f);
    bool found = !mark;
    for (dal__node i = f; i > 0 && !found; i--) {
        const dal__record r = dal__inspect(e->graph, i);
        if (!mark[i] || !(DAL__ROUGH >> r.op & 1)) continue;
        found = dal__depends(e->graph, r.op == DAL__IF ? r.a : i, v, end);
    }
    free(mark);
    return found;
}

/* What the second derivatives of a constraint allow; first and second: [2n] each, scratch. */
static unsigned constraint_class(const dal__equations *e, dal__node D, dal__node *first,
                                 dal__node *second)
{
    int n = e->n;
    unsigned all = DAL_D_LINEAR | DAL_D_CONSTANT | DAL_D_BILINEAR | DAL_D_QUADRATIC;
    state_gradient(e, D, first);
    if (dal__depends(e->graph, D, e->t, e->t + 1)) all = DAL_D_LINEAR;
    if (dal__reaches(e->graph, D, DAL__ROUGH)) all = branches_by_v(e, D) ? 0 : DAL_D_LINEAR;
    for (int i = 0; i < 2 * n; i++) {
        if (!varies(e, first[i])) continue;
        state_gradient(e, first[i], second);
        all &= ~(unsigned)DAL_D_CONSTANT;
        for (int j = 0; j < 2 * n; j++) {
            if (dal__node_is_zero(e->graph, second[j])) continue;
            if (i >= n && j >= n) all &= ~(unsigned)(DAL_D_LINEAR | DAL_D_BILINEAR);
            if (i < n && j < n) all &= ~(unsigned)DAL_D_BILINEAR;
            if (varies(e, second[j])) all &= ~(unsigned)(DAL_D_BILINEAR | DAL_D_QUADRATIC);
        }
    }
    return all;
}

/* ---- what methods need that enforce D ---- */

static bool depends_on_v(const dal__equations *e, const dal__node *f, int count)
{
    for (int i = 0; i < count; i++)
        if (dal__depends(e->graph, f[i], e->v, e->v + e->n)) return true;
    return false;
}

/* A W_00 = D_00 W v, where D_00 is the first entry of D_vv and W constant: D = k (v.Wv/2 - K). */
static bool is_isokinetic(const dal__equations *e, dal__node *row)
{
    dal__graph *graph = e->graph;
    const dal__node *v = e->flow + 1;
    if (e->m != 1 || e->servo || !dal__node_is_zero(graph, e->c[0])) return false;
    if (dal__node_is_zero(graph, e->W[0])) return false;
    dal__gradient(graph, e->A[0], e->symbol + e->v, e->n, row);
    const dal__node first = row[0];
    for (int i = 0; i < e->n; i++) {
        dal__gradient(graph, e->A[i], e->symbol + e->v, e->n, row);
        for (int j = 0; j < e->n; j++) {
            dal__node expected = dal__node_mul(graph, first, e->W[i * e->n + j]);
            dal__node defect =
                dal__node_sub(graph, dal__node_mul(graph, row[j], e->W[0]), expected);
            if (!dal__node_is_zero(graph, defect)) return false;
        }
        dal__node rest = dal__node_sub(graph, e->A[i], dal__dot(graph, e->n, row, v));
        if (!dal__node_is_zero(graph, rest)) return false;
    }
    return true;
}

static unsigned blocks_properties(const dal__equations *e, dal__node *row)
{
    const int n = e->n, mn = e->m * e->n;
    if (e->vakonomic || depends_on_v(e, e->a, n)) return 0;
    const bool steady = e->properties & DAL_MASS_CONSTANT;
    const bool has_R = mn > 0 && e->R[0]; /* W^-1 B^T may be full, and is not made then */
    const dal__node *directions = steady || !has_R ? e->B : e->R;
    if (!depends_on_v(e, e->A, mn) && !depends_on_v(e, directions, mn))
        return DAL_BLOCKS_POSITIONAL;
    return steady && is_isokinetic(e, row) ? DAL_D_ISOKINETIC : 0;
}

/* ---- the whole ---- */

void dal__properties(dal_model *model)
{
    dal__equations *e = &model->equations;
    dal__node *first = dal__model_nodes(model, 2 * e->n, 0);
    dal__node *second = dal__model_nodes(model, 2 * e->n, 0);
    if (model->out_of_memory) return;
    bool autonomous = true, constant = true;
    for (int i = 0; i < e->n + e->multipliers; i++)
        autonomous = autonomous && !dal__depends(e->graph, e->F[i], e->t, e->t + 1);
    for (int i = 0; i < e->n * e->n; i++) constant = constant && !varies(e, e->W[i]);
    e->properties = e->m ? ~0u : 0;
    for (int a = 0; a < e->m; a++)
        e->properties &= constraint_class(e, e->constraint[a], first, second);
    /* The rank of A is to be checked where it can fall and no formula shows it: for nonlinear
     * constraints, and for several that vary and may become parallel (a snakeboard with its axles
     * across).  A W^-1 A^T vanishes with the rank of A alone where W is positive definite, which
     * its guard det W keeps it. */
    const bool keeps_rank =
        e->bordered && dal__bordered_keeps_rank(e->bordered) && e->mass_positive && !e->vakonomic;
    if (e->m && !keeps_rank && !(e->properties & (e->m > 1 ? DAL_D_CONSTANT : DAL_D_LINEAR)))
        e->properties |= DAL_D_RANK_CHECKED;
    e->properties |= (autonomous ? DAL_AUTONOMOUS : 0u) | (constant ? DAL_MASS_CONSTANT : 0u) |
                     (e->vakonomic ? DAL_VAKONOMIC : 0u) | (e->servo ? DAL_SERVO : 0u) |
                     (e->restricted ? DAL_MASS_ON_KERNEL : 0u);
    dal__energy_properties(model);
    e->properties |= blocks_properties(e, first);
    if (!e->vakonomic && !depends_on_v(e, e->F, e->n)) e->properties |= DAL_F_POSITIONAL;
}

/* ---- guards ---- */

/* Expressions of the constraints, det W and, with given reactions, det A W^-1 B^T.
 *
 * Where a denominator passes through zero, or tan(x) through a pole, a step can pass the
 * singularity without noticing it; so it can where the Jacobian of D = f(q,t) (...) vanishes with
 * f.  Guards are the factors of every denominator, cos(x) for every tan(x) and the factors of D
 * itself that are free of velocities, if they depend on more than parameters. */
enum { REACHED = 1, FACTOR = 2, WHOLE = 4, MAX_GUARDS = 4096 };

typedef struct search {
    dal_model *model;
    unsigned char *flag; /* [nodes] */
    int constraint;
    bool full;
} search;

/* False where the node is no guard, since it is constant along a run or may jump from one sign to
 * the other, or there are too many. */
static bool append_guard(search *s, dal__node node, const char *name)
{
    dal__equations *e = &s->model->equations;
    if (!varies(e, node) || dal__reaches(e->graph, node, DAL__JUMPING)) return false;
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
        append_guard(
            s, node,
            dal__model_print(s->model, "%s: %s", DAL__CONSTRAINT_NAME(e, s->constraint - 1), text));
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
    if (r.b && r.op != DAL__IF) s->flag[r.b] |= REACHED; /* a branch need not be taken */
    if (r.op == DAL__DIV) s->flag[r.b] |= FACTOR;
    if (r.op == DAL__TAN) add_guard(s, dal__apply(graph, DAL__COS, r.a, 0), "a denominator");
    if (r.op != DAL__POW) return;
    dal__record exponent = dal__inspect(graph, r.b);
    if (exponent.op == DAL__NUMBER && exponent.value < 0.0) s->flag[r.a] |= FACTOR;
}

/* Whether it is a pivot of W, or of A W^-1 B^T. */
static bool is_of_mass(const dal__pivot *p)
{
    return p->divides & DAL__DIVIDES_MASS && p->constraint == 0;
}
static bool is_of_constraints(const dal__pivot *p) { return p->constraint > 0; }

/* The product of these pivots, where it varies along a run: the matrix is singular where it passes
 * through zero, and a step can pass that, too. */
static bool guard_determinant(search *s, bool (*is_factor)(const dal__pivot *p), const char *name)
{
    dal__equations *e = &s->model->equations;
    dal__node det = dal__number(e->graph, 1.0);
    for (int k = 0; k < e->pivots; k++)
        if (is_factor(&e->pivot[k])) det = dal__node_mul(e->graph, det, e->pivot[k].pivot);
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
    if (model->out_of_memory) return DAL_STATUS_OK;
    if (e->servo) guard_determinant(&s, is_of_constraints, "the reactions: det A W^-1 B^T");
    const char *name =
        e->restricted ? "the mass matrix on ker A: its determinant" : "the mass matrix: det W";
    if (guard_determinant(&s, is_of_mass, name)) e->mass_guard = e->guards;
    return s.full ? DAL_STATUS_TOO_LARGE : DAL_STATUS_OK;
}
