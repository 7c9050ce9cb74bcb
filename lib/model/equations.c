/* equations.c - the equations of motion, as nodes.
 *
 *     W = L_vv,  b = L_q - L_vq v - L_vt + Q,  A = D_v,  c = D_q v + D_t
 *     G = A W^-1 B^T,  G h = -(c + A W^-1 b),  F = W^-1 (b + B^T h)              (nh3)-(nh5)
 *
 * with B = A by Chetaev's rule, or as given under reactions.  Given accelerations mean W = 1.
 * Vakonomic motion is that of L' = L - g.D with the multipliers g as further variables: (nh6),
 * (nh35)
 *
 *     ( L'_vv  -A^T ) (dv/dt)   ( L'_q - L'_vq v - L'_vt + Q )
 *     (   A      0  ) (dg/dt) = (       - D_q v - D_t        )  */
#include "model/equations.h"
#include "expr/derivative.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include "model/elimination.h"
#include "model/model.h"

dal__node dal__dot(dal__graph *graph, int count, const dal__node *a, const dal__node *b)
{
    dal__node sum = dal__number(graph, 0.0);
    for (int i = 0; i < count; i++)
        if (!dal__is_number(graph, a[i], 0.0))
            sum = dal__node_add(graph, sum, dal__node_mul(graph, a[i], b[i]));
    return sum;
}

dal__node dal__time_derivative(const dal__equations *e, dal__node f)
{
    return dal__tangent(e->graph, f, e->symbol + e->t, 1 + e->n, e->flow);
}

/* status: of dal__linear_solve. */
static dal_status unsolved(const dal_model *model, dal_status status, const char *matrix,
                           dal_error *error)
{
    const dal__equations *e = &model->equations;
    if (status == DAL_TOO_LARGE && e->graph->status == DAL_OK)
        return dal__fail(error, status, "%s of %d coordinates couples too many of them", matrix,
                         e->n);
    return dal__size_error(e->graph->status, error);
}

static dal_status exhausted(const dal_model *model, dal_error *error)
{
    return dal__size_error(model->equations.graph->status, error);
}

/* ---- W, b, A, c ---- */

/* W, L_v and b of a Lagrangian; b holds L_q first. */
static void derive_lagrangian(dal__equations *e, dal__node L)
{
    dal__graph *graph = e->graph;
    dal__gradient(graph, L, e->symbol + e->v, e->n, e->momentum);
    dal__gradient(graph, L, e->symbol + e->q, e->n, e->b);
    for (int i = 0; i < e->n; i++) {
        dal__gradient(graph, e->momentum[i], e->symbol + e->v, e->n, e->W + i * e->n);
        e->b[i] = dal__node_sub(graph, e->b[i], dal__time_derivative(e, e->momentum[i]));
        e->b[i] = dal__node_add(graph, e->b[i], e->force[i]);
    }
    dal__node twice = dal__dot(graph, e->n, e->flow + 1, e->momentum);
    e->energy = dal__node_sub(graph, twice, L);
}

static dal_status derive_constraints(dal_model *model, dal_error *error)
{
    dal__equations *e = &model->equations;
    for (int a = 0; a < e->m; a++) {
        const dal__entry *entry = dal__model_entry(model, DAL_SECTION_CONSTRAINTS, a);
        bool depends = false;
        dal__gradient(e->graph, e->constraint[a], e->symbol + e->v, e->n, e->A + a * e->n);
        e->c[a] = dal__time_derivative(e, e->constraint[a]);
        for (int i = 0; i < e->n; i++)
            depends |= !dal__is_number(e->graph, e->A[a * e->n + i], 0.0);
        if (!depends && e->graph->status == DAL_OK)
            return dal__fail_at(error, DAL_RANK, DAL__AT_TEXT(entry),
                                "constraint %d does not depend on the velocities", a + 1);
    }
    return DAL_OK;
}

/* ---- Lagrange-d'Alembert ---- */

static bool allocate_linear(dal_model *model, dal__linear *s, int n, int columns, int border)
{
    *s = (dal__linear){.n = n, .columns = columns, .border = border};
    s->matrix = dal__model_nodes(model, n * n, 0);
    s->rhs = dal__model_nodes(model, n * columns, 0);
    s->x = dal__model_nodes(model, n * columns, 0);
    return !model->out_of_memory;
}

dal_status dal__solve_vector(dal_model *model, int n, const dal__node *matrix, const dal__node *rhs,
                             dal__node *x)
{
    dal__equations *e = &model->equations;
    const int pivots = e->pivots;
    dal__linear s;
    if (!allocate_linear(model, &s, n, 1, n)) return DAL_MEMORY;
    for (int i = 0; i < n * n; i++) s.matrix[i] = matrix[i];
    for (int i = 0; i < n; i++) s.rhs[i] = rhs[i];
    dal_status status = dal__linear_solve(model, &s);
    e->pivots = pivots;
    for (int i = 0; i < n; i++) x[i] = s.x[i];
    return status;
}

/* The column of W^-1 B_a; that of W^-1 A_a is 1 + a. */
static int force_column(const dal__equations *e, int a) { return 1 + a + (e->servo ? e->m : 0); }

/* x = W^-1 (b, A^T, B^T), the last only where it differs from A^T. */
static dal_status solve_mass(dal_model *model, dal__linear *s)
{
    dal__equations *e = &model->equations;
    int columns = force_column(e, e->m);
    if (!allocate_linear(model, s, e->n, columns, e->n)) return DAL_MEMORY;
    for (int i = 0; i < e->n * e->n; i++) s->matrix[i] = e->W[i];
    for (int i = 0; i < e->n; i++) {
        s->rhs[i * columns] = e->b[i];
        for (int a = 0; a < e->m; a++) {
            s->rhs[i * columns + 1 + a] = e->A[a * e->n + i];
            s->rhs[i * columns + force_column(e, a)] = e->B[a * e->n + i];
        }
    }
    DAL_TRY(dal__linear_solve(model, s));
    e->mass_positive = s->positive;
    for (int i = 0; i < e->n; i++) e->a[i] = s->x[i * columns];
    for (int i = 0; i < e->n; i++)
        for (int a = 0; a < e->m; a++) {
            e->U[i * e->m + a] = s->x[i * columns + 1 + a];
            e->R[i * e->m + a] = s->x[i * columns + force_column(e, a)];
        }
    return DAL_OK;
}

/* A W^-1 x for column k of W^-1 (b, A^T, B^T). */
static dal__node project(const dal__equations *e, int a, const dal__linear *mass, int k)
{
    dal__node sum = dal__number(e->graph, 0.0);
    for (int i = 0; i < e->n; i++) {
        if (dal__is_number(e->graph, e->A[a * e->n + i], 0.0)) continue;
        dal__node term =
            dal__node_mul(e->graph, e->A[a * e->n + i], mass->x[i * mass->columns + k]);
        sum = dal__node_add(e->graph, sum, term);
    }
    return sum;
}

static dal_status singular_mass(const dal_model *model, int row, dal_error *error)
{
    const dal__equations *e = &model->equations;
    const dal__entry *L = dal__model_entry(model, DAL_SECTION_LAGRANGIAN, 0);
    return dal__fail_at(
        error, DAL_SINGULAR_MASS, L ? L->line : 0, L ? L->column : 0,
        "the mass matrix is singular: it does not determine the acceleration of '%s'",
        e->coordinate[row]);
}

static dal_status dependent_constraints(const dal_model *model, int row, dal_error *error)
{
    const dal__entry *entry = dal__model_entry(model, DAL_SECTION_CONSTRAINTS, row);
    return dal__fail_at(
        error, DAL_RANK, DAL__AT_TEXT(entry),
        model->equations.servo
            ? "constraint %d is not held by the reactions: A W^-1 B^T is singular"
            : "constraint %d is not independent of the others: A W^-1 A^T is singular",
        row + 1);
}

static dal_status solve_motion(dal_model *model, dal_error *error)
{
    dal__equations *e = &model->equations;
    dal__linear mass, force;
    dal_status status = solve_mass(model, &mass);
    if (status == DAL_SINGULAR) return singular_mass(model, mass.singular, error);
    if (status != DAL_OK) return unsolved(model, status, "the mass matrix", error);
    if (!allocate_linear(model, &force, e->m, 1, 0)) return exhausted(model, error);
    for (int a = 0; a < e->m; a++) { /* G h = -(c + A W^-1 b) */
        dal__node pull = dal__node_add(e->graph, e->c[a], project(e, a, &mass, 0));
        force.rhs[a] = dal__node_neg(e->graph, pull);
        for (int b = 0; b < e->m; b++)
            force.matrix[a * e->m + b] = b < a && !e->servo
                                             ? force.matrix[b * e->m + a]
                                             : project(e, a, &mass, force_column(e, b));
    }
    status = dal__linear_solve(model, &force);
    if (status == DAL_SINGULAR) return dependent_constraints(model, force.singular, error);
    if (status != DAL_OK) return unsolved(model, status, "A W^-1 A^T", error);
    for (int a = 0; a < e->m; a++) e->h[a] = force.x[a];
    for (int i = 0; i < e->n; i++) {
        dal__node pushed = dal__dot(e->graph, e->m, e->R + i * e->m, force.x);
        e->F[i] = dal__node_add(e->graph, mass.x[i * mass.columns], pushed);
    }
    return DAL_OK;
}

/* ---- vakonomic ---- */

static dal_status solve_vakonomic(dal_model *model, dal_error *error)
{
    dal__equations *e = &model->equations;
    dal__linear mass, s;
    derive_lagrangian(e, e->lagrangian);
    /* W^-1 A^T of L alone, for projections.  A singular W means that there are none: U stays 0. */
    dal_status status = solve_mass(model, &mass);
    if (status != DAL_OK && status != DAL_SINGULAR) return exhausted(model, error);
    e->pivots = 0;
    dal__node L = e->lagrangian;
    for (int a = 0; a < e->m; a++) {
        dal__node g = dal__symbol(e->graph, e->g + a);
        L = dal__node_sub(e->graph, L, dal__node_mul(e->graph, g, e->constraint[a]));
    }
    derive_lagrangian(e, L);
    if (!allocate_linear(model, &s, e->n + e->m, 1, e->n)) return exhausted(model, error);
    const int n = e->n, size = s.n;
    for (int i = 0; i < size * size; i++) s.matrix[i] = dal__number(e->graph, 0.0);
    for (int i = 0; i < n; i++) {
        s.rhs[i] = e->b[i];
        for (int j = 0; j < n; j++) s.matrix[i * size + j] = e->W[i * n + j];
        for (int a = 0; a < e->m; a++) {
            s.matrix[(n + a) * size + i] = e->A[a * n + i];
            s.matrix[i * size + n + a] = dal__node_neg(e->graph, e->A[a * n + i]);
        }
    }
    for (int a = 0; a < e->m; a++) s.rhs[n + a] = dal__node_neg(e->graph, e->c[a]);
    status = dal__linear_solve(model, &s);
    if (status == DAL_SINGULAR && s.singular < e->n) return singular_mass(model, s.singular, error);
    if (status == DAL_SINGULAR) return dependent_constraints(model, s.singular - e->n, error);
    if (status != DAL_OK) return exhausted(model, error);
    for (int i = 0; i < s.n; i++) e->F[i] = s.x[i];
    return DAL_OK;
}

/* ---- the reactions in invariants ---- */

/* Replaces h and R = B^T h by their formulas.  Their nodes are made where they are used alone. */
static dal_status insert_reactions(dal_model *model)
{
    dal__equations *e = &model->equations;
    const int n = e->n, m = e->m, count = m + n;
    bool used = false;
    for (int k = 0; k < e->invariants; k++)
        used |= dal__depends(e->graph, e->invariant[k], e->reaction, e->reaction + count);
    if (!used) return e->graph->status;
    dal__node *by = dal__model_nodes(model, count, dal__number(e->graph, 0.0));
    int *symbol = dal__model_allocate(model, (size_t)count, sizeof *symbol);
    if (model->out_of_memory) return DAL_MEMORY;
    for (int i = 0; i < count; i++) symbol[i] = e->reaction + i;
    for (int a = 0; a < m; a++) {
        by[a] = e->h[a];
        for (int i = 0; i < n; i++)
            by[m + i] = dal__node_add(e->graph, by[m + i],
                                      dal__node_mul(e->graph, e->B[a * n + i], e->h[a]));
    }
    for (int k = 0; k < e->invariants; k++)
        e->invariant[k] = dal__substitute(e->graph, e->invariant[k], symbol, count, by);
    return e->graph->status;
}

dal_status dal__equations_derive(dal_model *model, dal_error *error)
{
    dal__equations *e = &model->equations;
    DAL_TRY(derive_constraints(model, error));
    if (e->vakonomic) {
        DAL_TRY(solve_vakonomic(model, error));
    } else {
        if (!e->accelerations) derive_lagrangian(e, e->lagrangian);
        for (int i = 0; i < e->n && e->accelerations; i++) {
            e->W[i * e->n + i] = dal__number(e->graph, 1.0);
            e->b[i] = e->force[i];
        }
        DAL_TRY(solve_motion(model, error));
    }
    return insert_reactions(model) == DAL_OK ? DAL_OK : exhausted(model, error);
}
