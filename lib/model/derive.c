/* derive.c - the equations of motion, as nodes.
 *
 *     W = L_vv,  b = L_q - L_vq v - L_vt + Q,  A = D_v,  c = D_q v + D_t
 *     G = A W^-1 B^T,  G h = -(c + A W^-1 b),  F = W^-1 (b + B^T h)              (nh3)-(nh5)
 *
 * with B = A by Chetaev's rule, or as given under reactions.  A holonomic constraint g(q,t) = 0 is
 * the row D = g_q v + g_t: D = const is an integral of F, and g = 0 where D = 0.  Given
 * accelerations mean W = 1; given equations S(q, v, t, q'') = Q + B^T h with S = M q'' + s mean
 * W = M, b = Q - s, or both multiplied by M^T where M is not symmetric.  Vakonomic motion follows
 * from L' = L - g.D with the multipliers g as further variables: (nh6), (nh35)
 *
 *     ( L'_vv  -A^T ) (dv/dt)   ( L'_q - L'_vq v - L'_vt + Q )
 *     (   A      0  ) (dg/dt) = (       - D_q v - D_t        )  */
#include "model/derive.h"
#include "core/settings.h"
#include "expr/angles.h"
#include "expr/derivative.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include "model/elimination.h"
#include "model/formulas.h"
#include "model/motion.h"

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

/* W^T W, and W^T b in place of b. */
static void make_symmetric(dal_model *model)
{
    dal__equations *e = &model->equations;
    const int n = e->n;
    dal__node *columns = dal__model_nodes(model, n * n, 0), *b = dal__model_nodes(model, n, 0);
    if (model->out_of_memory) return;
    for (int i = 0; i < n; i++) {
        b[i] = e->b[i];
        for (int j = 0; j < n; j++) columns[i * n + j] = e->W[j * n + i];
    }
    for (int i = 0; i < n; i++) {
        e->b[i] = dal__dot(e->graph, n, columns + i * n, b);
        for (int j = 0; j < n; j++)
            e->W[i * n + j] = dal__dot(e->graph, n, columns + i * n, columns + j * n);
    }
}

/* W and b of the section equations, where q'' has the places of pi. */
static dal_status derive_equations(dal_model *model, dal_error *error)
{
    dal__equations *e = &model->equations;
    const int n = e->n;
    const int *second = e->symbol + e->pi;
    dal__node *S = e->equation = dal__model_nodes(model, n, 0);
    dal__node *zero = dal__model_nodes(model, n, dal__number(e->graph, 0.0));
    if (model->out_of_memory) return DAL_STATUS_OK;
    DAL_TRY(dal__parse_motion_equations(model, S, error));
    for (int i = 0; i < n; i++) {
        const dal__entry *entry = dal__model_entry(model, DAL_SECTION_EQUATIONS, i);
        dal__gradient(e->graph, S[i], second, n, e->W + i * n);
        for (int j = 0; j < n; j++)
            if (dal__depends(e->graph, e->W[i * n + j], e->pi, e->pi + n))
                return dal__fail_at(error, DAL_STATUS_UNSUPPORTED, DAL__AT_TEXT(entry),
                                    "equation %d is not linear in %.80s'', and there is no "
                                    "lagrangian",
                                    i + 1, e->coordinate[j]);
        e->b[i] =
            dal__node_sub(e->graph, e->force[i], dal__substitute(e->graph, S[i], second, n, zero));
    }
    bool is_symmetric = true;
    for (int i = 0; i < n * n; i++) is_symmetric &= e->W[i] == e->W[i % n * n + i / n];
    if (is_symmetric) return DAL_STATUS_OK;
    if (e->m > 0)
        return dal__fail_at(error, DAL_STATUS_UNSUPPORTED,
                            DAL__AT_TEXT(dal__constraint_entry(model, 0)),
                            "constraints need equations with a symmetric matrix of the second "
                            "derivatives, as m*x'' + f and m*y'' + g");
    make_symmetric(model);
    return DAL_STATUS_OK;
}

static dal_status derive_constraints(dal_model *model, dal_error *error)
{
    dal__equations *e = &model->equations;
    for (int j = 0; j < DAL__HOLONOMIC_COUNT(e); j++)
        e->constraint[e->m - DAL__HOLONOMIC_COUNT(e) + j] = dal__time_derivative(e, e->position[j]);
    for (int a = 0; a < e->m; a++) {
        const dal__entry *entry = dal__constraint_entry(model, a);
        const bool is_holonomic = a >= e->m - DAL__HOLONOMIC_COUNT(e);
        bool depends = false;
        dal__gradient(e->graph, e->constraint[a], e->symbol + e->v, e->n, e->A + a * e->n);
        e->c[a] = dal__time_derivative(e, e->constraint[a]);
        for (int i = 0; i < e->n; i++) depends |= !dal__node_is_zero(e->graph, e->A[a * e->n + i]);
        if (!depends)
            return dal__fail_at(error, DAL_STATUS_RANK, DAL__AT_TEXT(entry),
                                is_holonomic ? "%s does not depend on the coordinates"
                                             : "%s does not depend on the velocities; f(q) = 0 "
                                               "belongs under holonomic",
                                DAL__CONSTRAINT_NAME(e, a));
        for (int i = 0; i < e->n && e->servo && is_holonomic; i++)
            e->B[a * e->n + i] = e->A[a * e->n + i];
    }
    return DAL_STATUS_OK;
}

/* ---- vakonomic ---- */

static dal_status solve_vakonomic(dal_model *model, dal_error *error)
{
    dal__equations *e = &model->equations;
    dal__factors f;
    derive_lagrangian(e, e->lagrangian);
    /* W^-1 A^T of L alone, for projections.  A singular W means that there are none: U stays 0. */
    dal_status status = dal__solve_mass(model);
    if (status == DAL_STATUS_TOO_LARGE) return dal__size_error(status, error);
    dal__node L = e->lagrangian;
    for (int a = 0; a < e->m; a++) {
        dal__node g = dal__symbol(e->graph, e->g + a);
        L = dal__node_sub(e->graph, L, dal__node_mul(e->graph, g, e->constraint[a]));
    }
    derive_lagrangian(e, L);
    const int size = e->n + e->m;
    int *constraint = dal__model_allocate(model, (size_t)size, sizeof *constraint);
    f = (dal__factors){.n = size, .constraint = constraint};
    f.matrix = dal__model_nodes(model, size * size, dal__number(e->graph, 0.0));
    dal__node *rhs = dal__model_nodes(model, size, 0);
    if (model->out_of_memory) return DAL_STATUS_OK;
    for (int a = 0; a < e->m; a++) constraint[e->n + a] = a + 1;
    const int n = e->n;
    for (int i = 0; i < n; i++) {
        rhs[i] = e->b[i];
        for (int j = 0; j < n; j++) f.matrix[i * size + j] = e->W[i * n + j];
        for (int a = 0; a < e->m; a++) {
            f.matrix[(n + a) * size + i] = e->A[a * n + i];
            f.matrix[i * size + n + a] = dal__node_neg(e->graph, e->A[a * n + i]);
        }
    }
    for (int a = 0; a < e->m; a++) rhs[n + a] = dal__node_neg(e->graph, e->c[a]);
    status = dal__factor(model, &f);
    if (status == DAL_STATUS_SINGULAR)
        return f.singular < e->n ? dal__singular_mass(model, f.singular, error)
                                 : dal__dependent_constraints(model, f.singular - e->n, error);
    DAL_TRY(dal__check_size(status, error));
    if (model->out_of_memory) return DAL_STATUS_OK;
    dal__record_pivots(e, &f, DAL__DIVIDES_MOTION);
    dal__factors_solve(model, &f, DAL__SUMS_UNCHANGED, 1, rhs, e->F);
    return DAL_STATUS_OK;
}

/* ---- the reactions in invariants and events ---- */

void dal__list_reactions(const dal__equations *e, dal__node *out)
{
    const int n = e->n, m = e->m;
    for (int a = 0; a < m; a++) {
        const dal__node *B = e->B + a * n;
        out[a] = e->h[a];
        for (int i = 0; i < n; i++)
            out[m + i] =
                dal__node_add(e->graph, out[m + i], dal__node_mul(e->graph, B[i], e->h[a]));
    }
}

void dal__insert_reactions(dal_model *model)
{
    dal__equations *e = &model->equations;
    const int n = e->n, m = e->m, count = m + n;
    const struct {
        dal__node *list;
        int count;
    } lists[] = {{e->invariant, e->invariants},
                 {e->event_value, e->events},
                 {e->event_state, 2 * n * e->events},
                 {e->event_normal, (1 + 2 * n) * e->events}};
    enum { LISTS = sizeof lists / sizeof *lists };
    bool used = false;
    for (int k = 0; k < LISTS; k++)
        for (int i = 0; i < lists[k].count; i++)
            used |= dal__depends(e->graph, lists[k].list[i], e->reaction, e->reaction + count);
    if (!used) return;
    dal__node *by = dal__model_nodes(model, count, dal__number(e->graph, 0.0));
    int *symbol = dal__model_allocate(model, (size_t)count, sizeof *symbol);
    if (model->out_of_memory) return;
    for (int i = 0; i < count; i++) symbol[i] = e->reaction + i;
    dal__list_reactions(e, by);
    for (int k = 0; k < LISTS; k++)
        if (lists[k].count > 0)
            dal__substitute_all(e->graph, lists[k].count, lists[k].list, symbol, count, by);
}

/* ---- the whole ---- */

/* Writes what F is derived from, D and E with few sines and cosines: after the derivatives, which
 * are shorter of a sine of a sum. */
static void expand_angles(dal_model *model)
{
    dal__equations *e = &model->equations;
    const int n = e->n, m = e->m;
    const struct {
        dal__node *list;
        int count;
    } lists[] = {{e->W, n * n},
                 {e->b, n},
                 {e->A, m * n},
                 {e->c, m},
                 {&e->energy, e->energy != 0},
                 {e->constraint, m},
                 {e->position, DAL__HOLONOMIC_COUNT(e)},
                 {e->B, e->servo ? m * n : 0}};
    enum { LISTS = sizeof lists / sizeof *lists };
    int total = 0, at = 0;
    for (int k = 0; k < LISTS; k++) total += lists[k].count;
    dal__node *all = dal__model_nodes(model, total, 0);
    if (model->out_of_memory) return;
    for (int k = 0; k < LISTS; k++)
        for (int i = 0; i < lists[k].count; i++) all[at++] = lists[k].list[i];
    dal__expand_angles(e->graph, all, total);
    at = 0;
    for (int k = 0; k < LISTS; k++)
        for (int i = 0; i < lists[k].count; i++) lists[k].list[i] = all[at++];
}

dal_status dal__equations_derive(dal_model *model, dal_error *error)
{
    dal__equations *e = &model->equations;
    DAL_TRY(derive_constraints(model, error));
    if (e->vakonomic) {
        DAL_TRY(solve_vakonomic(model, error));
    } else {
        if (!e->accelerations) derive_lagrangian(e, e->lagrangian);
        for (int i = 0; i < e->n && e->accelerations && !e->implicit; i++) {
            e->W[i * e->n + i] = dal__number(e->graph, 1.0);
            e->b[i] = e->force[i];
        }
        if (DAL__SOLVES_EQUATIONS && e->implicit) DAL_TRY(derive_equations(model, error));
        expand_angles(model);
        DAL_TRY(dal__motion_derive(model, error));
    }
    dal__insert_reactions(model);
    return DAL_STATUS_OK;
}
