/* properties.c - what the formulas say about constraints and energy, decided on the graph.
 *
 *     dE/dt = v.Q + sum_a h_a v.A_a - L_t                          (Lagrange-d'Alembert)
 *     dE/dt = v.Q - L_t + g.D_t  on D = 0                          (vakonomic)
 *
 * For D_a homogeneous of degree k in v Euler's identity v.A_a = k D_a makes E a weak integral.
 * An identity that simplification does not show is tried at irregular points: a sum counts as zero
 * if it is within rounding of its terms at each.  A system without constraints has none of the
 * properties of D. */
#include "mechanics/mechanics.h"
#include <math.h>

/* ---- identities ---- */

enum { POINTS = 8 };
/* Each term is the outcome of some ten to hundred operations of relative error 1e-16. */
#define ROUNDING 1e-12

typedef struct identity {
    const dal__equations *e;
    double *point; /* [symbols] */
    dal__node *term;
    int terms;
} identity;

static void move(const identity *id, int number)
{
    const double golden = 0.6180339887498949;
    const dal__equations *e = id->e;
    for (int i = 0; i < e->symbols; i++) {
        id->point[i] = e->value[i];
        if (i >= e->parameters) id->point[i] += 0.1 + fmod((number * e->symbols + i) * golden, 1.0);
    }
}

static void sum_terms(const identity *id, double *sum, double *size)
{
    *sum = *size = 0.0;
    for (int i = 0; i < id->terms; i++) {
        double term = dal__evaluate(id->e->graph, id->term[i], id->point);
        *sum += term;
        *size += fabs(term);
    }
}

/* Whether the terms add up to zero wherever they are defined. */
static bool vanishes(identity *id)
{
    dal__graph *graph = id->e->graph;
    dal__node whole = dal__number(graph, 0.0);
    for (int i = 0; i < id->terms; i++) whole = dal__add(graph, whole, id->term[i]);
    if (dal__is_number(graph, whole, 0.0)) return true;
    int defined = 0;
    for (int number = 0; number < POINTS; number++) {
        double sum, size;
        move(id, number);
        sum_terms(id, &sum, &size);
        if (!isfinite(sum)) continue;
        if (fabs(sum) > ROUNDING * size) return false;
        defined++;
    }
    return defined > POINTS / 2;
}

/* ---- energy ---- */

static void add_term(identity *id, dal__node term)
{
    if (!dal__is_number(id->e->graph, term, 0.0)) id->term[id->terms++] = term;
}

static dal__node by_time(const dal__equations *e, dal__node f)
{
    dal__node out;
    dal__gradient(e->graph, f, &e->t, 1, &out);
    return out;
}

static bool power_vanishes(identity *id)
{
    const dal__equations *e = id->e;
    id->terms = 0;
    for (int i = 0; i < e->n; i++) add_term(id, dal__mul(e->graph, e->flow[1 + i], e->force[i]));
    add_term(id, dal__neg(e->graph, by_time(e, e->lagrangian)));
    for (int a = 0; a < e->multipliers; a++)
        add_term(id,
                 dal__mul(e->graph, dal__symbol(e->graph, e->g + a), by_time(e, e->constraint[a])));
    return vanishes(id);
}

static void virtual_power(identity *id, int a)
{
    const dal__equations *e = id->e;
    id->terms = 0;
    for (int i = 0; i < e->n; i++)
        add_term(id, dal__mul(e->graph, e->flow[1 + i], e->A[a * e->n + i]));
}

/* v.A_a = k D_a for some k, which is read off at one point. */
static bool is_homogeneous(identity *id, int a)
{
    const dal__equations *e = id->e;
    double power, size;
    virtual_power(id, a);
    move(id, 0);
    sum_terms(id, &power, &size);
    double k = power / dal__evaluate(e->graph, e->constraint[a], id->point);
    if (!isfinite(k)) return false;
    if (fabs(k - nearbyint(k)) < ROUNDING * fabs(k)) k = nearbyint(k);
    add_term(id, dal__mul(e->graph, dal__number(e->graph, -k), e->constraint[a]));
    return vanishes(id);
}

static unsigned energy_properties(identity *id)
{
    const dal__equations *e = id->e;
    bool exact = !e->multipliers, weak = true;
    if (e->accelerations || !power_vanishes(id)) return 0;
    for (int a = 0; a < e->m && !e->vakonomic; a++) {
        virtual_power(id, a);
        if (vanishes(id)) continue;
        exact = false;
        weak = weak && is_homogeneous(id, a);
    }
    return exact ? DAL_E_EXACT : weak ? DAL_E_WEAK : 0;
}

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

/* What the second derivatives of a constraint allow; first and second are room for [2n] each. */
static unsigned degree(const dal__equations *e, dal__node D, dal__node *first, dal__node *second)
{
    int n = e->n;
    unsigned all = DAL_D_LINEAR | DAL_D_CONSTANT | DAL_D_BILINEAR | DAL_D_QUADRATIC;
    state_gradient(e, D, first);
    if (dal__depends(e->graph, D, e->t, e->t + 1)) all = DAL_D_LINEAR;
    for (int i = 0; i < 2 * n; i++) {
        state_gradient(e, first[i], second);
        if (varies(e, first[i])) all &= ~(unsigned)DAL_D_CONSTANT;
        for (int j = 0; j < 2 * n; j++) {
            if (dal__is_number(e->graph, second[j], 0.0)) continue;
            if (i >= n && j >= n) all &= ~(unsigned)(DAL_D_LINEAR | DAL_D_BILINEAR);
            if (i < n && j < n) all &= ~(unsigned)DAL_D_BILINEAR;
            if (varies(e, second[j])) all &= ~(unsigned)(DAL_D_BILINEAR | DAL_D_QUADRATIC);
        }
    }
    return all;
}

/* Watched are normals that can vanish where no formula shows it: those of nonlinear constraints,
 * and several that vary, which may become parallel (a snakeboard with its axles across). */
static unsigned constraint_properties(const dal__equations *e, dal__node *first, dal__node *second)
{
    const unsigned steady = e->m > 1 ? DAL_D_CONSTANT : DAL_D_LINEAR;
    unsigned all = e->m ? ~0u : 0;
    for (int a = 0; a < e->m; a++) all &= degree(e, e->constraint[a], first, second);
    if (e->m && !(all & steady)) all |= DAL_D_WATCHED;
    return all;
}

/* ---- the whole ---- */

static unsigned motion_properties(const dal__equations *e)
{
    bool autonomous = true, constant = true;
    for (int i = 0; i < e->n + e->multipliers; i++)
        autonomous = autonomous && !dal__depends(e->graph, e->F[i], e->t, e->t + 1);
    for (int i = 0; i < e->n * e->n; i++) constant = constant && !varies(e, e->W[i]);
    return (autonomous ? DAL_AUTONOMOUS : 0u) | (constant ? DAL_MASS_CONSTANT : 0u) |
           (e->vakonomic ? DAL_VAKONOMIC : 0u);
}

dal_status dal__properties(dal_model *model)
{
    dal__equations *e = &model->equations;
    size_t most = (size_t)(e->n + e->m + 2), room = (size_t)(2 * e->n);
    identity id = {.e = e};
    id.point = dal__model_take(model, (size_t)e->symbols, sizeof *id.point);
    id.term = dal__model_take(model, most, sizeof *id.term);
    dal__node *first = dal__model_take(model, room, sizeof *first);
    dal__node *second = dal__model_take(model, room, sizeof *second);
    if (model->starved) return DAL_MEMORY;
    e->properties =
        motion_properties(e) | constraint_properties(e, first, second) | energy_properties(&id);
    return dal__graph_status(e->graph);
}
