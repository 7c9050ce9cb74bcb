/* energy.c - whether the motion preserves E = L_v.v - L.
 *
 *     dE/dt = v.Q + sum_a h_a v.B_a - L_t                          (Lagrange-d'Alembert)
 *     dE/dt = v.Q - L_t + g.D_t  on D = 0                          (vakonomic)
 *
 * For B = A and D_a homogeneous of degree k in v Euler's identity v.A_a = k D_a makes E an integral
 * on every level of D for k = 0, on D = 0 alone for other k; homogeneity is sufficient, but not
 * necessary.  An identity that simplification does not show is evaluated at irregular points, whose
 * distances from the start are measured by the units of the model: a sum counts as zero if it is
 * within rounding of what its terms are made of, S of expr/terms.h, at each.  Where the terms do
 * not vanish one by one, dE/dt as a whole may still vanish on D = 0 (a force orthogonal to all
 * motions that D allows, a constraint force that vanishes on D = 0): it is evaluated at points
 * projected there.
 *
 * The normal of a conserved E, for projections: E_q, E_v and W^-1 E_q.  (W^-1 E_v is v.)
 *
 * Where E is conserved on D = 0 alone, dE/dt vanishes there and nowhere else.  The motion can be
 * continued off D = 0 in another way, so that E is a true integral and D remains one:
 *
 *     F~ = F + alpha (v - W^-1 A^T beta),   (A W^-1 A^T) beta = A v
 *     alpha = -(dE/dt) / (v.W v - (A v).beta)
 *
 * The divisor is the square of that part of v that D leaves free, so F~ = F on D = 0. */
#include "model/energy.h"
#include "core/vectors.h"
#include "expr/derivative.h"
#include "expr/simplify.h"
#include "expr/terms.h"
#include "expr/traversal.h"
#include "model/bordered.h"
#include "model/model.h"
#include "model/motion.h"
#include "model/units.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- identities ---- */

enum { POINTS = 8, MAX_EXTENDED = 256 };
/* Each term is the outcome of some ten to hundred operations of relative error 1e-16. */
#define ROUNDING 1e-12
/* Added to the divisor of alpha, which vanishes at rest, where alpha is to be 0: far below v.W v of
 * any motion, and its square is still a number. */
#define REST 1e-150

typedef struct identity {
    dal_model *model;
    const dal__equations *e;
    double *point, *unit; /* [symbols] */
    double *moved;        /* [POINTS*symbols] the irregular points; NULL until they are used */
    dal__node *term;      /* [max_terms] */
    int terms, max_terms;
    double *scale, *value; /* [max_terms] of the terms */
} identity;

/* The units, and irregular points off the start. */
static bool find_units(identity *id)
{
    const dal__equations *e = id->e;
    const size_t symbols = (size_t)e->symbols;
    if (id->moved) return true;
    id->unit = dal__model_allocate(id->model, symbols, sizeof *id->unit);
    double *moved = dal__model_allocate(id->model, POINTS * symbols, sizeof *moved);
    if (!id->unit || !moved) return false;
    dal__model_units(id->model, id->unit);
    for (int k = 0; k < POINTS * e->symbols; k++) {
        const int i = k % e->symbols;
        moved[k] = e->value[i];
        if (i >= e->parameters) moved[k] += id->unit[i] * (0.1 + dal__golden_fraction(k));
    }
    id->moved = moved;
    return true;
}

static void move(const identity *id, int number)
{
    const size_t symbols = (size_t)id->e->symbols;
    memcpy(id->point, id->moved + (size_t)number * symbols, symbols * sizeof *id->point);
}

/* The sum of the terms at the point and the size of what they are made of; NaN without memory. */
static void sum_terms(const identity *id, const dal__terms *terms, double *sum, double *size)
{
    double *memory = terms ? dal__numbers(1, dal__terms_memory(terms)) : NULL;
    const bool known =
        memory && dal__evaluate_all(id->e->graph, id->term, id->terms, id->point, id->value);
    *sum = *size = known ? 0.0 : NAN;
    id->model->out_of_memory |= !known;
    if (known) dal__terms_scales(terms, id->point, memory, id->scale);
    for (int i = 0; i < id->terms && known; i++) {
        *sum += id->value[i];
        *size += id->scale[i];
    }
    free(memory);
}

/* Makes scratch[a*n ...] the unit vector along the part of A_a orthogonal to the rows before it,
 * and adds to the shift the Newton step of D_a along it, all in units of v.  Returns the length of
 * that step. */
static double shift_along(const identity *id, int a, double *scratch, double *shift)
{
    const dal__equations *e = id->e;
    int n = e->n;
    double *row = scratch + a * n, missing = 0.0;
    for (int i = 0; i < n; i++) {
        row[i] = dal__evaluate(e->graph, e->A[a * n + i], id->point) * id->unit[e->v + i];
        missing -= row[i] * shift[i];
    }
    missing -= dal__evaluate(e->graph, e->constraint[a], id->point);
    const double size = dal__orthonormalise_row(scratch, a, n);
    for (int i = 0; i < n; i++) shift[i] += missing / size * row[i];
    return fabs(missing / size);
}

/* Newton's method in v.  False where it finds no point of D = 0. */
static bool reach_surface(identity *id, double *scratch)
{
    enum { MAX_ITERATIONS = 30 };
    const dal__equations *e = id->e;
    double *v = id->point + e->v, *shift = scratch + e->m * e->n;
    const double *unit = id->unit + e->v;
    for (int k = 0; k < MAX_ITERATIONS; k++) {
        double change = 0.0, square = 0.0;
        for (int i = 0; i < e->n; i++) square += v[i] / unit[i] * (v[i] / unit[i]);
        for (int i = 0; i < e->n; i++) shift[i] = 0.0;
        for (int a = 0; a < e->m; a++) change += shift_along(id, a, scratch, shift);
        if (!isfinite(change)) return false;
        for (int i = 0; i < e->n; i++) v[i] += unit[i] * shift[i];
        if (change <= 8 * DBL_EPSILON * sqrt(square)) return true;
    }
    return false;
}

/* Whether the terms add up to zero at irregular points; with scratch at points of D = 0. */
static bool vanishes_at_points(identity *id, double *scratch)
{
    int defined = 0;
    for (int i = 0; i < id->terms; i++) /* the points may all lie in one branch */
        if (dal__reaches(id->e->graph, id->term[i], DAL__ROUGH)) return false;
    if (!find_units(id)) return false;
    dal__terms *terms = dal__terms_create(id->e->graph, id->term, id->terms);
    bool differs = false;
    for (int number = 0; number < POINTS && !differs; number++) {
        double sum, size;
        move(id, number);
        if (scratch && !reach_surface(id, scratch)) continue;
        sum_terms(id, terms, &sum, &size);
        if (!isfinite(sum)) continue;
        differs = fabs(sum) > ROUNDING * size;
        defined++;
    }
    dal__terms_free(terms);
    return !differs && defined > POINTS / 2;
}

/* Whether the terms add up to zero wherever they are defined. */
static bool vanishes(identity *id)
{
    dal__graph *graph = id->e->graph;
    dal__node whole = dal__number(graph, 0.0);
    for (int i = 0; i < id->terms; i++) whole = dal__node_add(graph, whole, id->term[i]);
    return dal__node_is_zero(graph, whole) || vanishes_at_points(id, NULL);
}

/* ---- energy ---- */

static void add_term(identity *id, dal__node term)
{
    if (!dal__node_is_zero(id->e->graph, term)) id->term[id->terms++] = term;
}

static dal__node partial_t(const dal__equations *e, dal__node f)
{
    dal__node out;
    dal__gradient(e->graph, f, &e->t, 1, &out);
    return out;
}

static void virtual_power(identity *id, int a)
{
    const dal__equations *e = id->e;
    id->terms = 0;
    for (int i = 0; i < e->n; i++)
        add_term(id, dal__node_mul(e->graph, e->flow[1 + i], e->B[a * e->n + i]));
}

/* v.B_a = k D_a for some k, which is found at one point. */
static bool is_homogeneous(identity *id, int a)
{
    const dal__equations *e = id->e;
    double power, size;
    virtual_power(id, a);
    if (!find_units(id)) return false;
    move(id, 0);
    dal__terms *terms = dal__terms_create(e->graph, id->term, id->terms);
    sum_terms(id, terms, &power, &size);
    dal__terms_free(terms);
    const double D = dal__evaluate(e->graph, e->constraint[a], id->point);
    double k = power / D;
    if (!isfinite(k)) return false;
    if (fabs(k - nearbyint(k)) < ROUNDING * size / fabs(D)) k = nearbyint(k);
    add_term(id, dal__node_mul(e->graph, dal__number(e->graph, -k), e->constraint[a]));
    return vanishes(id);
}

static unsigned by_sources(identity *id)
{
    const dal__equations *e = id->e;
    bool exact = !e->multipliers, weak = true;
    id->terms = 0;
    for (int i = 0; i < e->n; i++)
        add_term(id, dal__node_mul(e->graph, e->flow[1 + i], e->force[i]));
    add_term(id, dal__node_neg(e->graph, partial_t(e, e->lagrangian)));
    for (int a = 0; a < e->multipliers; a++)
        add_term(id, dal__node_mul(e->graph, dal__symbol(e->graph, e->g + a),
                                   partial_t(e, e->constraint[a])));
    if (!vanishes(id)) return 0;
    for (int a = 0; a < e->m && !e->vakonomic; a++) {
        virtual_power(id, a);
        if (vanishes(id)) continue;
        exact = false;
        weak = weak && is_homogeneous(id, a);
    }
    return exact ? DAL_E_EXACT : weak ? DAL_E_ON_D : 0;
}

void dal__energy_properties(dal_model *model)
{
    dal__equations *e = &model->equations;
    identity id = {.model = model, .e = e, .max_terms = e->n + e->m + 2};
    if (e->accelerations) return;
    id.point = dal__model_allocate(model, (size_t)e->symbols, sizeof *id.point);
    id.term = dal__model_nodes(model, id.max_terms, 0);
    id.scale = dal__model_allocate(model, 2 * (size_t)id.max_terms, sizeof *id.scale);
    id.value = id.scale + id.max_terms;
    dal__node *E_v = dal__model_nodes(model, e->n, 0);
    double *scratch = dal__model_allocate(model, (size_t)((e->m + 1) * e->n), sizeof *scratch);
    if (model->out_of_memory) return;
    unsigned found = by_sources(&id);
    if (!found && e->m > 0 && !e->vakonomic) {
        id.terms = 0; /* dE/dt = E_q v + E_t + E_v F */
        add_term(&id, dal__time_derivative(e, e->energy));
        dal__gradient(e->graph, e->energy, e->symbol + e->v, e->n, E_v);
        for (int i = 0; i < e->n; i++) add_term(&id, dal__node_mul(e->graph, E_v[i], e->F[i]));
        found = vanishes(&id) ? DAL_E_EXACT : vanishes_at_points(&id, scratch) ? DAL_E_ON_D : 0;
    }
    e->properties |= found;
}

/* ---- a conserved energy ---- */

/* A v and beta; of many coordinates by the factors of F, which are sparse, and with U beta. */
static dal_status find_beta(dal_model *model, dal__node *along, dal__node *beta, dal__node *pushed)
{
    enum { MAX_DENSE = 16 };
    const dal__equations *e = &model->equations;
    const int n = e->n, m = e->m;
    dal__node *G = dal__model_nodes(model, m * m, 0);
    dal__node *none = dal__model_nodes(model, n, dal__number(e->graph, 0.0));
    if (model->out_of_memory) return DAL_STATUS_OK;
    if (n > MAX_DENSE && e->bordered && !e->servo) {
        for (int a = 0; a < m; a++) along[a] = dal__dot(e->graph, n, e->A + a * n, e->flow + 1);
        dal__bordered_solve(model, e->bordered, DAL__SUMS_UNCHANGED, none, along, pushed, beta);
        return DAL_STATUS_OK;
    }
    for (int a = 0; a < m; a++) {
        along[a] = dal__dot(e->graph, n, e->A + a * n, e->flow + 1);
        for (int b = a; b < m; b++) {
            const dal__node zero = dal__number(e->graph, 0.0);
            G[a * m + b] = G[b * m + a] =
                dal__add_strided_dot(e->graph, zero, n, e->A + a * n, 1, e->U + b, m);
        }
    }
    return dal__solve_vector(model, m, G, along, beta);
}

static void extend(dal_model *model)
{
    dal__equations *e = &model->equations;
    dal__graph *graph = e->graph;
    const int n = e->n, m = e->m;
    dal__node *along = dal__model_nodes(model, m, 0), *beta = dal__model_nodes(model, m, 0);
    dal__node *extended = dal__model_nodes(model, n, 0), *push = dal__model_nodes(model, n, 0);
    if (model->out_of_memory) return;
    if (find_beta(model, along, beta, push) != DAL_STATUS_OK) return; /* B is not A */
    const dal__node *v = e->flow + 1;
    const dal__node *E_v = e->normal + 1 + n;
    dal__node free = dal__dot(graph, n, v, E_v);
    if (!e->restricted) free = dal__node_sub(graph, free, dal__dot(graph, m, along, beta));
    for (int a = 0; a < m && e->restricted; a++) /* U is not W^-1 A^T itself */
        for (int i = 0; i < n; i++)
            free = dal__node_sub(
                graph, free,
                dal__node_mul(graph, E_v[i], dal__node_mul(graph, e->U[i * m + a], beta[a])));
    dal__node divisor = dal__node_add(graph, free, dal__number(graph, REST));
    dal__node rate =
        dal__node_sub(graph, dal__dot(graph, n, v, e->force), partial_t(e, e->lagrangian));
    for (int a = 0; a < m; a++) {
        dal__node pushed = dal__dot(graph, n, e->B + a * n, v);
        rate = dal__node_add(graph, rate, dal__node_mul(graph, e->h[a], pushed));
    }
    dal__node alpha = dal__node_neg(graph, dal__node_div(graph, rate, divisor));
    for (int i = 0; i < n; i++) {
        dal__node pushed = push[i] ? push[i] : dal__dot(graph, m, e->U + i * m, beta);
        dal__node along_free = dal__node_sub(graph, v[i], pushed);
        extended[i] = dal__node_add(graph, e->F[i], dal__node_mul(graph, alpha, along_free));
    }
    e->extended = extended;
}

void dal__conserved_energy(dal_model *model)
{
    dal__equations *e = &model->equations;
    e->normal = e->extended = NULL;
    if (!(e->properties & (DAL_E_EXACT | DAL_E_ON_D)) || e->vakonomic) return;
    const int n = e->n;
    dal__node *normal = dal__model_nodes(model, 1 + 3 * n, 0);
    if (model->out_of_memory) return;
    normal[0] = e->energy;
    dal__gradient(e->graph, e->energy, e->symbol + e->q, n, normal + 1);
    dal__gradient(e->graph, e->energy, e->symbol + e->v, n, normal + 1 + n);
    e->normal = normal;
    dal__solve_force(model, normal + 1, normal + 1 + 2 * n);
    /* F~ couples all coordinates, so its derivatives have the square of their number. */
    if (e->properties & DAL_E_ON_D && n <= MAX_EXTENDED) extend(model);
}
