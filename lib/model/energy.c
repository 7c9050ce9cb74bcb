/* energy.c - whether the motion keeps E = L_v.v - L.
 *
 *     dE/dt = v.Q + sum_a h_a v.B_a - L_t                          (Lagrange-d'Alembert)
 *     dE/dt = v.Q - L_t + g.D_t  on D = 0                          (vakonomic)
 *
 * For B = A and D_a homogeneous of degree k in v Euler's identity v.A_a = k D_a makes E an integral
 * on every level of D for k = 0, on D = 0 (a weak one) for other k; homogeneity is enough, but not
 * necessary.  An identity that simplification does not show is tried at irregular points: a sum
 * counts as zero if it is within rounding of its terms at each.  Where the parts do not vanish one
 * by one, dE/dt as a whole may still do so on D = 0 (a force across all motions that D allows, a
 * reaction that is none on D = 0): that is tried at points brought there. */
#include "model/mechanics.h"
#include <float.h>
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
        add_term(id, dal__mul(e->graph, e->flow[1 + i], e->B[a * e->n + i]));
}

/* v.B_a = k D_a for some k, which is read off at one point. */
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

static unsigned by_parts(identity *id)
{
    const dal__equations *e = id->e;
    bool exact = !e->multipliers, weak = true;
    if (!power_vanishes(id)) return 0;
    for (int a = 0; a < e->m && !e->vakonomic; a++) {
        virtual_power(id, a);
        if (vanishes(id)) continue;
        exact = false;
        weak = weak && is_homogeneous(id, a);
    }
    return exact ? DAL_E_EXACT : weak ? DAL_E_WEAK : 0;
}

/* ---- on D = 0 ---- */

static double dot(int n, const double *a, const double *b)
{
    double sum = 0.0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

/* Makes room[a*n ...] the unit vector along what A_a has across the rows before it, and adds to
 * the shift what D_a lacks along it.  The size of the addition. */
static double shift_along(const identity *id, int a, double *room, double *shift)
{
    const dal__equations *e = id->e;
    int n = e->n;
    double *unit = room + a * n, missing = 0.0;
    for (int i = 0; i < n; i++) {
        unit[i] = dal__evaluate(e->graph, e->A[a * n + i], id->point);
        missing -= unit[i] * shift[i];
    }
    missing -= dal__evaluate(e->graph, e->constraint[a], id->point);
    for (int b = 0; b < a; b++) {
        double along = dot(n, unit, room + b * n);
        for (int i = 0; i < n; i++) unit[i] -= along * room[b * n + i];
    }
    double size = sqrt(dot(n, unit, unit));
    for (int i = 0; i < n; i++) unit[i] /= size;
    for (int i = 0; i < n; i++) shift[i] += missing / size * unit[i];
    return fabs(missing / size);
}

/* Newton's method in v.  False where it finds no point of D = 0. */
static bool reach_surface(identity *id, double *room)
{
    enum { MOST = 30 };
    const dal__equations *e = id->e;
    double *v = id->point + e->v, *shift = room + e->m * e->n;
    for (int k = 0; k < MOST; k++) {
        double change = 0.0, size = sqrt(dot(e->n, v, v));
        for (int i = 0; i < e->n; i++) shift[i] = 0.0;
        for (int a = 0; a < e->m; a++) change += shift_along(id, a, room, shift);
        if (!isfinite(change)) return false;
        for (int i = 0; i < e->n; i++) v[i] += shift[i];
        if (change <= 8 * DBL_EPSILON * size) return true;
    }
    return false;
}

/* dE/dt = E_q v + E_t + E_v F. */
static void whole_rate(identity *id, dal__node *slope)
{
    const dal__equations *e = id->e;
    id->terms = 0;
    add_term(id, dal__along(e, e->energy));
    dal__gradient(e->graph, e->energy, e->symbol + e->v, e->n, slope);
    for (int i = 0; i < e->n; i++) add_term(id, dal__mul(e->graph, slope[i], e->F[i]));
}

static bool vanishes_on_surface(identity *id, double *room)
{
    int defined = 0;
    for (int number = 0; number < POINTS; number++) {
        double sum, size;
        move(id, number);
        if (!reach_surface(id, room)) continue;
        sum_terms(id, &sum, &size);
        if (!isfinite(sum)) continue;
        if (fabs(sum) > ROUNDING * size) return false;
        defined++;
    }
    return defined > POINTS / 2;
}

dal_status dal__energy_properties(dal_model *model)
{
    dal__equations *e = &model->equations;
    identity id = {.e = e};
    if (e->accelerations) return DAL_OK;
    id.point = dal__model_take(model, (size_t)e->symbols, sizeof *id.point);
    id.term = dal__model_take(model, (size_t)(e->n + e->m + 2), sizeof *id.term);
    dal__node *slope = dal__model_take(model, (size_t)e->n, sizeof *slope);
    double *room = dal__model_take(model, (size_t)((e->m + 1) * e->n), sizeof *room);
    if (model->starved) return DAL_MEMORY;
    unsigned found = by_parts(&id);
    if (!found && e->m > 0 && !e->vakonomic) {
        whole_rate(&id, slope);
        found = vanishes(&id) ? DAL_E_EXACT : vanishes_on_surface(&id, room) ? DAL_E_WEAK : 0;
    }
    e->properties |= found;
    return e->graph->status;
}
