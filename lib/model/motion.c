/* motion.c - accelerations and multipliers of the Lagrange-d'Alembert equations, as nodes: in the
 * cheapest of a few ways, and their derivatives.
 *
 * Derivatives do not go through the elimination (bordered.c).  With its matrix K, as in
 * K (F, -h) = r, which is symmetric,
 *
 *     K (F, -h)_x = r_x - K_x (F, -h),        pi.F_x = w.(r_x - K_x (F, -h)),  K w = (pi, 0)
 *
 * so each costs a solution by the same factors. */
#include "model/motion.h"
#include "core/error.h"
#include "core/settings.h"
#include "core/vectors.h"
#include "expr/collect.h"
#include "expr/derivative.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include "model/bordered.h"
#include "model/model.h"
#include "model/restricted.h"
#include "model/units.h"
#include <limits.h>
#include <math.h>
#include <stdio.h>

/* ---- errors ---- */

dal_status dal__singular_mass(const dal_model *model, int row, dal_error *error)
{
    const dal__equations *e = &model->equations;
    const dal__entry *L = dal__model_entry(model, DAL_SECTION_LAGRANGIAN, 0);
    return dal__fail_at(
        error, DAL_STATUS_SINGULAR_MASS, L ? L->line : 0, L ? L->column : 0,
        e->restricted ? "the mass matrix is singular on the velocities that the constraints allow: "
                        "with them it does not determine the acceleration of '%s'"
                      : "the mass matrix is singular: it does not determine the acceleration of "
                        "'%s'",
        e->coordinate[row]);
}

/* Lists the constraints whose rows of A combine to the row of one, ", 1, 2", at an irregular point;
 * returns the largest entry that their combination leaves of it.  rows[m*(n+m)]: the rows of A, in
 * units in which the diagonal of W and the largest entry of each row are 1, and after each how it
 * is combined of them. */
static double list_dependence(const dal__equations *e, int row, double *rows, char *list,
                              size_t size)
{
    const double rounding = 1e-9;
    const int n = e->n, m = e->m, width = n + m;
    double *point = rows + m * width;
    const double *unit = point + e->symbols;
    for (int i = 0; i < e->symbols; i++) {
        const double off = dal__golden_fraction(i + 1) - 0.5;
        point[i] = e->value[i] + (i < e->parameters ? 0.0 : unit[i] * off);
    }
    for (int a = 0; a < m; a++) {
        double *w = rows + a * width; /* row comes last */
        const int number = a == m - 1 ? row : a + (a >= row);
        for (int i = 0; i < n; i++) {
            const double mass = fabs(dal__evaluate(e->graph, e->W[i * n + i], point));
            w[i] = dal__evaluate(e->graph, e->A[number * n + i], point);
            if (mass > 0.0) w[i] /= sqrt(mass);
        }
        const double largest = dal__max_abs(w, (size_t)n);
        for (int i = 0; i < n && largest > 0.0; i++) w[i] /= largest;
        w[n + number] = 1.0;
        for (int b = 0; b < a; b++) {
            const double *other = rows + b * width;
            int best = 0;
            for (int i = 1; i < n; i++) best = fabs(other[i]) > fabs(other[best]) ? i : best;
            const double factor = fabs(other[best]) > rounding ? w[best] / other[best] : 0.0;
            for (int i = 0; i < width; i++) w[i] -= factor * other[i];
        }
    }
    const double *made = rows + (m - 1) * width + n;
    for (int a = 0, length = 0; a < m && length < (int)size; a++)
        if (a != row && fabs(made[a]) > rounding)
            length += e->holonomic > 0
                          ? snprintf(list + length, size - (size_t)length, ", %s",
                                     DAL__CONSTRAINT_NAME(e, a))
                          : snprintf(list + length, size - (size_t)length, ", %d", a + 1);
    return dal__max_abs(made - n, (size_t)n);
}

/* Rounding leaves no more of a row that depends on others. */
static const double no_rest = 1e-13;

dal_status dal__dependent_constraints(dal_model *model, int row, dal_error *error)
{
    const dal__equations *e = &model->equations;
    const dal__entry *entry = dal__constraint_entry(model, row);
    const size_t before = (size_t)(e->m * (e->n + e->m) + e->symbols);
    double *rows = dal__model_allocate(model, before + (size_t)e->symbols, sizeof *rows);
    char list[128] = ", others";
    if (e->servo)
        return dal__fail_at(error, DAL_STATUS_RANK, DAL__AT_TEXT(entry),
                            "%s is not held by the reactions: A W^-1 B^T is singular",
                            DAL__CONSTRAINT_NAME(e, row));
    double rest = 0.0;
    if (rows) {
        dal__model_units(model, rows + before);
        rest = list_dependence(e, row, rows, list, sizeof list);
    }
    if (rest > no_rest && isfinite(rest))
        return dal__fail_at(error, DAL_STATUS_RANK, DAL__AT_TEXT(entry),
                            "%s nearly depends on %s: they differ by %.1g of its "
                            "coefficients, and A W^-1 A^T is singular in double precision",
                            DAL__CONSTRAINT_NAME(e, row), list + 2, rest);
    return dal__fail_at(error, DAL_STATUS_RANK, DAL__AT_TEXT(entry),
                        "%s is redundant, it depends on %s: A W^-1 A^T is singular",
                        DAL__CONSTRAINT_NAME(e, row), list + 2);
}

/* status: of dal__factor, where the matrix may be singular no more. */
static dal_status check_coupling(const dal_model *model, dal_status status, const char *matrix,
                                 dal_error *error)
{
    if (status == DAL_STATUS_OK) return status;
    return dal__fail(error, status, "%s of %d coordinates couples too many of them", matrix,
                     model->equations.n);
}

/* ---- W alone ---- */

dal_status dal__solve_vector(dal_model *model, int n, const dal__node *matrix, const dal__node *rhs,
                             dal__node *x)
{
    dal__factors f;
    dal__factors_allocate(model, &f, n, NULL);
    if (model->out_of_memory) return DAL_STATUS_OK;
    for (int i = 0; i < n * n; i++) f.matrix[i] = matrix[i];
    DAL_TRY(dal__factor(model, &f));
    dal__factors_solve(model, &f, DAL__SUMS_UNCHANGED, 1, rhs, x);
    return DAL_STATUS_OK;
}

/* Whether W^-1 A^T has many more entries than A: the factors of W then give its columns when a
 * run needs them (program_list.h).  It is made in any case where formulas are made of it. */
static bool fills_directions(dal_model *model)
{
    enum { MAX_COUPLED = 16 };
    const dal__equations *e = &model->equations;
    const int n = e->n, m = e->m;
    bool is_of_v = false;
    long filled = 0;
    if (e->vakonomic || e->servo || !e->mass_positive || (e->holonomic && e->holonomic < m))
        return false;
    int *block = dal__model_allocate(model, 3 * (size_t)n, sizeof *block); /* that W couples */
    if (!block) return false;
    int *const size = block + n, *const counted = size + n; /* of a block; by which constraint */
    for (int i = 0; i < n; i++) block[i] = i;
    for (int k = 0; k < n * n; k++) {
        const int i = k / n, from = block[i], to = block[k % n];
        is_of_v |= dal__depends(e->graph, e->W[k], e->v, e->v + n);
        if (k % n >= i || from == to || dal__node_is_zero(e->graph, e->W[k])) continue;
        for (int l = 0; l <= i; l++) block[l] = block[l] == from ? to : block[l];
    }
    for (int i = 0; i < n; i++) size[block[i]]++;
    for (int k = 0; k < m * n; k++) {
        const int a = k / n, of = block[k % n];
        if (dal__node_is_zero(e->graph, e->A[k])) continue;
        filled += (counted[of] > a ? 0 : size[of]) - 1;
        counted[of] = a + 1;
    }
    return !is_of_v && filled > (long)MAX_COUPLED * (n + m);
}

dal_status dal__solve_mass(dal_model *model)
{
    dal__equations *e = &model->equations;
    const int n = e->n;
    dal__factors *mass = e->mass = dal__model_allocate(model, 1, sizeof *mass);
    if (mass) dal__factors_allocate(model, mass, n, NULL);
    if (model->out_of_memory) return DAL_STATUS_OK;
    for (int i = 0; i < n * n; i++) mass->matrix[i] = e->W[i];
    DAL_TRY(dal__factor(model, mass));
    e->mass_positive = mass->positive;
    const int m = fills_directions(model) ? 0 : e->m, columns = 1 + m + (e->servo ? m : 0);
    dal__node *rhs = dal__model_nodes(model, columns * n, 0);
    dal__node *x = dal__model_nodes(model, columns * n, 0);
    if (model->out_of_memory) return DAL_STATUS_OK;
    for (int i = 0; i < n; i++) rhs[i] = e->b[i];
    for (int i = 0; i < m * n; i++) rhs[n + i] = e->A[i];
    for (int i = 0; i < m * n && e->servo; i++) rhs[n + m * n + i] = e->B[i];
    dal__factors_solve(model, mass, DAL__SUMS_UNCHANGED, columns, rhs, x);
    for (int i = 0; i < n; i++) {
        e->a[i] = x[i];
        for (int a = 0; a < m; a++) {
            e->U[i * m + a] = x[(1 + a) * n + i];
            e->R[i * m + a] = x[(columns - m + a) * n + i];
        }
    }
    return DAL_STATUS_OK;
}

void dal__solve_force(dal_model *model, const dal__node *force, dal__node *x)
{
    const dal__equations *e = &model->equations;
    dal__node *zero = dal__model_nodes(model, e->m, dal__number(e->graph, 0.0));
    if (e->restricted)
        dal__restricted_solve(model, e->restricted, force, zero, x, NULL);
    else
        dal__solve_vector(model, e->n, e->W, force, x);
}

void dal__solve_mass_at_pi(dal_model *model, dal__node *U)
{
    const dal__equations *e = &model->equations;
    const int n = e->n, m = e->m;
    dal__factors mass = *e->mass;
    int *v = dal__model_allocate(model, (size_t)n, sizeof *v);
    dal__node *u = dal__model_nodes(model, n, 0), *x = dal__model_nodes(model, n * m, 0);
    const dal__node *from = e->restricted ? e->W : e->mass->matrix;
    mass.matrix = dal__model_nodes(model, n * n, 0);
    if (model->out_of_memory) return;
    for (int i = 0; i < n * n; i++) mass.matrix[i] = from[i];
    for (int i = 0; i < n; i++) {
        v[i] = e->v + i;
        u[i] = dal__symbol(e->graph, e->pi + i);
    }
    dal__substitute_all(e->graph, n * n, mass.matrix, v, n, u);
    if (e->restricted) { /* pivots are chosen where u is the v of the start */
        dal__restricted r;
        for (int i = 0; i < n; i++) e->value[e->pi + i] = e->value[e->v + i];
        const dal_status status = dal__restricted_factor(model, mass.matrix, &r);
        for (int i = 0; i < n; i++) e->value[e->pi + i] = 0.0;
        if (status == DAL_STATUS_OK) dal__restricted_directions(model, &r, U);
        return;
    }
    dal__factors_solve(model, &mass, DAL__SUMS_UNCHANGED, m, e->A, x);
    for (int i = 0; i < n; i++)
        for (int a = 0; a < m; a++) U[i * m + a] = x[a * n + i];
}

/* ---- F and h ---- */

/* What F costs, with the pivots that are checked. */
static int cost_of_F(dal_model *model)
{
    const dal__equations *e = &model->equations;
    dal__node *all = dal__model_nodes(model, e->n + 2 * e->pivots, 0);
    int count = e->n;
    for (int i = 0; all && i < e->n; i++) all[i] = e->F[i];
    for (int k = 0; all && k < e->pivots; k++) {
        if (!e->pivot[k].checked || !(e->pivot[k].divides & DAL__DIVIDES_MOTION)) continue;
        all[count++] = e->pivot[k].pivot;
        all[count++] = e->pivot[k].size;
    }
    return all ? dal__cost(e->graph, all, count) : INT_MAX;
}

static dal_status derive_by(dal_model *model, const dal__factors *mass, unsigned way, int *singular)
{
    dal__equations *e = &model->equations;
    dal__node *bottom = dal__model_nodes(model, e->m, 0);
    DAL_TRY(dal__bordered_factor(model, mass, way, &e->bordered, singular));
    if (model->out_of_memory) return DAL_STATUS_OK;
    dal__bordered_record_pivots(e, e->bordered, mass);
    for (int a = 0; a < e->m; a++) bottom[a] = dal__node_neg(e->graph, e->c[a]);
    dal__bordered_solve(model, e->bordered, DAL__SUMS_COLLECTED, e->b, bottom, e->F, e->h);
    return DAL_STATUS_OK;
}

/* The cheapest way; of many coordinates, WHOLE or REDUCED without a comparison. */
static dal_status derive_cheapest(dal_model *model, const dal__factors *mass, int *singular)
{
    enum { MAX_COMPARED = 16, REDUCED = DAL__SOLVED | DAL__COLLECTED };
    static const unsigned ways[] = {0,           DAL__COLLECTED, DAL__COLLECTED | DAL__PAIRED,
                                    DAL__SOLVED, REDUCED,        REDUCED | DAL__FORWARD};
    const dal__equations *e = &model->equations;
    unsigned best = 0, last = 0;
    int least = INT_MAX;
    if (e->n > MAX_COMPARED) {
        bool coupled = false; /* coordinates by W */
        for (int i = 0; i < e->n * e->n && !coupled; i++)
            coupled = i % (e->n + 1) && !dal__node_is_zero(e->graph, e->W[i]);
        const bool whole = coupled && e->mass_positive && !e->servo;
        const unsigned way = whole ? DAL__SOLVED | DAL__WHOLE : REDUCED;
        const dal_status status = derive_by(model, mass, way, singular);
        return status == DAL_STATUS_SINGULAR ? derive_by(model, mass, 0, singular) : status;
    }
    for (size_t k = 0; k < sizeof ways / sizeof *ways; k++) {
        const dal_status status = derive_by(model, mass, last = ways[k], singular);
        if (status != DAL_STATUS_OK && (status != DAL_STATUS_SINGULAR || k == 0)) return status;
        if (model->out_of_memory) return DAL_STATUS_OK;
        if (last & DAL__SOLVED && !dal__bordered_is_reduced(e->bordered)) break;
        const int cost = status == DAL_STATUS_OK ? cost_of_F(model) : INT_MAX;
        if (cost >= least) continue;
        least = cost;
        best = last;
    }
    return best == last ? DAL_STATUS_OK : derive_by(model, mass, best, singular);
}

static dal_status derive_restricted(dal_model *model)
{
    dal__equations *e = &model->equations;
    const dal__node none = dal__number(e->graph, 0.0);
    dal__node *bottom = dal__model_nodes(model, e->m, none);
    dal__restricted *r = e->restricted = dal__model_allocate(model, 1, sizeof *r);
    if (model->out_of_memory) return DAL_STATUS_OK;
    DAL_TRY(dal__restricted_factor(model, e->W, r));
    if (model->out_of_memory) return DAL_STATUS_OK;
    e->mass_positive = r->V.positive;
    dal__restricted_record_pivots(e, r);
    dal__restricted_solve(model, r, e->b, bottom, e->a, NULL);
    dal__restricted_directions(model, r, e->U);
    for (int a = 0; a < e->m; a++) bottom[a] = dal__node_neg(e->graph, e->c[a]);
    dal__restricted_solve(model, r, e->b, bottom, e->F, e->h);
    return DAL_STATUS_OK;
}

dal_status dal__motion_derive(dal_model *model, dal_error *error)
{
    dal__equations *e = &model->equations;
    int singular;
    dal_status status = dal__solve_mass(model);
    const bool fails = status == DAL_STATUS_SINGULAR, may_restrict = e->m > 0 && !e->servo;
    if (fails && !may_restrict) return dal__singular_mass(model, e->mass->singular, error);
    if (!fails) DAL_TRY(check_coupling(model, status, "the mass matrix", error));
    if (may_restrict && (fails || dal__mass_may_turn_singular(model))) {
        status = derive_restricted(model);
        if (status == DAL_STATUS_SINGULAR)
            return e->restricted->singular < 0
                       ? dal__singular_mass(model, e->restricted->V.singular, error)
                       : dal__dependent_constraints(model, e->restricted->singular, error);
        return check_coupling(model, status, "W on ker A", error);
    }
    status = derive_cheapest(model, e->mass, &singular);
    if (status == DAL_STATUS_SINGULAR) return dal__dependent_constraints(model, singular, error);
    return check_coupling(model, status, "A W^-1 A^T", error);
}

/* ---- derivatives ---- */

/* While something is differentiated, symbols from e->symbols on stand for F, h and w. */
enum { NAMED = 2 }; /* F and h, and w of the same size: 2 (n + m) symbols */

/* Symbols number 0 .. count - 1 from first on, as nodes. */
static dal__node *name(dal_model *model, int first, int count)
{
    dal__node *out = dal__model_nodes(model, count, 0);
    for (int i = 0; out && i < count; i++) out[i] = dal__symbol(model->equations.graph, first + i);
    return out;
}

bool dal__motion_is_symmetric(const dal__equations *e)
{
    return e->restricted || (e->bordered && !e->servo);
}

/* W x - A^T h = top, A x = bottom by the factors of F. */
static void solve_motion(dal_model *model, const dal__node *top, const dal__node *bottom,
                         dal__node *x, dal__node *h)
{
    const dal__equations *e = &model->equations;
    if (e->restricted)
        dal__restricted_solve(model, e->restricted, top, bottom, x, h);
    else
        dal__bordered_solve(model, e->bordered, DAL__SUMS_UNCHANGED, top, bottom, x, h);
}

/* The same of top = 0, for the rows of A from `first` on, by the factors of their A W^-1 A^T, which
 * has a band where constraints couple neighbours; bottom and l are of these rows. */
static dal_status solve_by_directions(dal_model *model, int first, const dal__node *bottom,
                                      dal__node *x, dal__node *l)
{
    const dal__equations *e = &model->equations;
    const int n = e->n, m = e->m, rows = m - first;
    dal__node *G = dal__model_nodes(model, rows * rows, dal__number(e->graph, 0.0));
    if (model->out_of_memory) return DAL_STATUS_OK;
    for (int k = 0; k < rows * rows; k++) {
        const dal__node *A = e->A + (first + k / rows) * n, *U = e->U + first + k % rows;
        G[k] = dal__add_strided_dot(e->graph, G[k], n, A, 1, U, m);
    }
    DAL_TRY(dal__solve_vector(model, rows, G, bottom, l));
    for (int i = 0; i < n; i++) x[i] = dal__dot(e->graph, rows, e->U + i * m + first, l);
    return DAL_STATUS_OK;
}

dal_status dal__motion_correct(dal_model *model, dal__node *x)
{
    const dal__equations *e = &model->equations;
    const dal__node zero = dal__number(e->graph, 0.0);
    dal__node *top = dal__model_nodes(model, e->n, zero), *D = dal__model_nodes(model, 2 * e->m, 0);
    if (model->out_of_memory) return DAL_STATUS_OK;
    for (int a = 0; a < e->m; a++) D[a] = dal__node_neg(e->graph, e->constraint[a]);
    if (!dal__motion_is_symmetric(e)) return solve_by_directions(model, 0, D, x, D + e->m);
    solve_motion(model, top, D, x, NULL);
    return DAL_STATUS_OK;
}

/* y = beta a + U l, of restricted motion, where A U = 1, and of vakonomic motion, without a. */
static void react_by_directions(const dal__equations *e, dal__node beta, const dal__node *l,
                                dal__node *y)
{
    for (int i = 0; i < e->n; i++)
        y[i] = dal__node_add(e->graph, dal__node_mul(e->graph, beta, e->a[i]),
                             dal__dot(e->graph, e->m, e->U + i * e->m, l));
}

dal_status dal__motion_enforce(dal_model *model, dal__node *out)
{
    const dal__equations *e = &model->equations;
    const int n = e->n, m = e->m;
    const dal__node *pi = name(model, e->pi, n + m + 1);
    dal__node *top = dal__model_nodes(model, n, 0), *bottom = dal__model_nodes(model, m, 0);
    if (model->out_of_memory) return DAL_STATUS_OK;
    for (int i = 0; i < n; i++) top[i] = dal__node_mul(e->graph, pi[n + m], e->b[i]);
    for (int a = 0; a < m; a++)
        bottom[a] = dal__node_add(e->graph, dal__dot(e->graph, n, e->A + a * n, pi), pi[n + a]);
    if (e->vakonomic) return solve_by_directions(model, 0, bottom, out, out + n);
    if (!e->restricted) {
        solve_motion(model, top, bottom, out, out + n);
        return DAL_STATUS_OK;
    }
    for (int a = 0; a < m; a++) out[n + a] = bottom[a];
    react_by_directions(e, pi[n + m], bottom, out);
    return DAL_STATUS_OK;
}

void dal__motion_react(dal_model *model, dal__node *y)
{
    const dal__equations *e = &model->equations;
    const int n = e->n, m = e->m;
    const dal__node *l = name(model, e->pi, m + 1);
    dal__node *top = dal__model_nodes(model, n, 0);
    if (model->out_of_memory) return;
    if (e->restricted || e->vakonomic) {
        react_by_directions(e, l[m], l, y);
        return;
    }
    for (int i = 0; i < n; i++) {
        top[i] = dal__node_mul(e->graph, l[m], e->b[i]);
        top[i] = dal__add_strided_dot(e->graph, top[i], m, e->B + i, n, l, 1);
    }
    dal__factors_solve(model, e->mass, DAL__SUMS_UNCHANGED, 1, top, y);
}

dal_status dal__motion_place(dal_model *model, dal__node *out)
{
    const dal__equations *e = &model->equations;
    const int first = e->m - e->holonomic;
    const dal__node *c = name(model, e->pi + first, e->holonomic);
    dal__node *top = dal__model_nodes(model, e->n, dal__number(e->graph, 0.0));
    if (e->U[0]) return solve_by_directions(model, first, c, out, out + e->n);
    solve_motion(model, top, c, out, out + e->n); /* first is 0 */
    return DAL_STATUS_OK;
}

/* What is differentiated: b - W F + A^T h [n] and -c - A F [m], F and h being symbols. */
static dal__node *residuals(dal_model *model)
{
    const dal__equations *e = &model->equations;
    const int n = e->n, m = e->m;
    dal__node *out = dal__model_nodes(model, n + m, 0);
    const dal__node *F = name(model, e->symbols, n), *h = name(model, e->symbols + n, m);
    if (model->out_of_memory) return NULL;
    for (int i = 0; i < n; i++) {
        out[i] = dal__node_sub(e->graph, e->b[i], dal__dot(e->graph, n, e->W + i * n, F));
        out[i] = dal__add_strided_dot(e->graph, out[i], m, e->A + i, n, h, 1);
    }
    for (int a = 0; a < m; a++) {
        dal__node sum = dal__node_add(e->graph, e->c[a], dal__dot(e->graph, n, e->A + a * n, F));
        out[n + a] = dal__node_neg(e->graph, sum);
    }
    return out;
}

/* Replaces the symbols of F, h and w [n + m; or NULL] by their nodes. */
static void insert(dal_model *model, int count, dal__node *nodes, const dal__node *w)
{
    const dal__equations *e = &model->equations;
    const int size = e->n + e->m, symbols = w ? NAMED * size : size;
    int *symbol = dal__model_allocate(model, (size_t)symbols, sizeof *symbol);
    dal__node *by = dal__model_nodes(model, symbols, 0);
    if (model->out_of_memory) return;
    for (int i = 0; i < symbols; i++) {
        symbol[i] = e->symbols + i;
        by[i] = i < e->n ? e->F[i] : i < size ? e->h[i - e->n] : w[i - size];
    }
    dal__substitute_all(e->graph, count, nodes, symbol, symbols, by);
}

/* q, then v. */
static int *state_symbols(dal_model *model)
{
    const dal__equations *e = &model->equations;
    int *symbol = dal__model_allocate(model, 2 * (size_t)e->n, sizeof *symbol);
    for (int i = 0; symbol && i < e->n; i++) {
        symbol[i] = e->q + i;
        symbol[e->n + i] = e->v + i;
    }
    return symbol;
}

bool dal__motion_jacobian(dal_model *model, dal__node *by_q, dal__node *by_v)
{
    enum { MAX_NODES = 250000 };
    const dal__equations *e = &model->equations;
    const int n = e->n, size = e->n + e->m, columns = 2 * n;
    const int *symbol = state_symbols(model), first = e->graph->count;
    const dal__node *residual = residuals(model);
    dal__node *row = dal__model_nodes(model, columns, 0), *x = dal__model_nodes(model, n, 0);
    dal__node *rhs = dal__model_nodes(model, columns * size, 0); /* column by column */
    if (model->out_of_memory) return false;
    for (int i = 0; i < size; i++) {
        dal__gradient(e->graph, residual[i], symbol, columns, row);
        for (int c = 0; c < columns; c++) rhs[c * size + i] = row[c];
    }
    insert(model, columns * size, rhs, NULL);
    for (int c = 0; c < columns; c++) {
        const dal__node *top = rhs + c * size;
        solve_motion(model, top, top + n, x, NULL);
        if (e->graph->count - first > MAX_NODES) return false;
        for (int i = 0; i < n; i++) *(c < n ? &by_q[i * n + c] : &by_v[i * n + c - n]) = x[i];
    }
    return true;
}

void dal__motion_adjoint(dal_model *model, dal__node *by_q, dal__node *by_v)
{
    const dal__equations *e = &model->equations;
    const int n = e->n, m = e->m, size = n + m;
    const int *symbol = state_symbols(model);
    const dal__node *residual = residuals(model), *w = name(model, e->symbols + size, size);
    const dal__node *pi = name(model, e->pi, n);
    dal__node *weight = dal__model_nodes(model, size, 0), *out = dal__model_nodes(model, 2 * n, 0);
    dal__node *zero = dal__model_nodes(model, m, dal__number(e->graph, 0.0));
    if (model->out_of_memory) return;
    solve_motion(model, pi, zero, weight, weight + n);
    for (int a = 0; a < m; a++) weight[n + a] = dal__node_neg(e->graph, weight[n + a]);
    dal__gradient(e->graph, dal__dot(e->graph, size, w, residual), symbol, 2 * n, out);
    insert(model, 2 * n, out, weight);
    for (int i = 0; i < n; i++) {
        by_q[i] = out[i];
        by_v[i] = out[n + i];
    }
}

/* ---- efforts ---- */

/* The columns M c, count of them, of M = P W^-1, which solves W x - B^T h = c, A x = 0. */
static void push_columns(dal_model *model, int count, const dal__node *column, dal__node *x)
{
    const dal__equations *e = &model->equations;
    dal__node *zero = dal__model_nodes(model, e->m, dal__number(e->graph, 0.0));
    for (int k = 0; k < count; k++)
        solve_motion(model, column + k * e->n, zero, x + k * e->n, NULL);
}

void dal__motion_effort(dal_model *model, dal_effort effort, dal__node *out)
{
    const dal__equations *e = &model->equations;
    const bool is_constraint = effort == DAL_EFFORT_CONSTRAINT;
    const int n = e->n, count = is_constraint ? n : e->controls;
    const dal__node *pi = name(model, e->pi, n);
    dal__node *unit = dal__model_nodes(model, n * n, dal__number(e->graph, 0.0));
    dal__node *x = dal__model_nodes(model, count * n, 0), *g = dal__model_nodes(model, count, 0);
    if (model->out_of_memory) return;
    for (int i = 0; i < n; i++) unit[i * n + i] = dal__number(e->graph, 1.0);
    for (int i = 0; i < n; i++) out[i] = dal__number(e->graph, 0.0);
    if (effort == DAL_EFFORT_MASS) {
        dal__factors_solve(model, e->mass, DAL__SUMS_UNCHANGED, 1, pi, out);
    } else if (is_constraint && !e->servo) { /* K = P W^-1 by Chetaev's rule, else M W M^T */
        push_columns(model, 1, pi, out);
    } else {
        push_columns(model, count, is_constraint ? unit : e->control, x);
        for (int k = 0; k < count; k++) g[k] = dal__dot(e->graph, n, x + k * n, pi);
        if (!is_constraint) model->equations.control_cost = g;
        for (int k = 0; k < count; k++) { /* K pi = sum_k x_k g_k, of unit columns x_k (W g)_k */
            const dal__node by = is_constraint ? dal__dot(e->graph, n, e->W + k * n, g) : g[k];
            for (int i = 0; i < n; i++)
                out[i] = dal__node_add(e->graph, out[i], dal__node_mul(e->graph, x[k * n + i], by));
        }
    }
    const dal__node half =
        dal__node_mul(e->graph, dal__number(e->graph, 0.5), dal__dot(e->graph, n, pi, out));
    dal__gradient(e->graph, half, e->symbol + e->q, n, out + n);
    dal__gradient(e->graph, half, e->symbol + e->v, n, out + 2 * n);
}
