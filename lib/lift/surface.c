/* surface.c - the surface of Dirac's constraints: formulas restricted to it, points of it.
 *
 * A constraint that is linear in a variable s and says s = f, f being short, removes s from every
 * formula on the surface.  What remains, c = 0, is solved by Newton's iteration at points drawn
 * about the start,
 *
 *     J dz = -c,    J = c_z in units of z
 *
 * whose convergence says whether the constraint is regular: where c = 0 implies c_z = 0 (as for
 * c = x^2) it is linear and ends with a gradient that is a tiny fraction of the gradient at the
 * beginning, or depends on the gradients of the other constraints. */
#include "lift/surface.h"
#include "core/error.h"
#include "expr/collect.h"
#include "expr/derivative.h"
#include "expr/simplify.h"
#include "expr/tape.h"
#include "expr/terms.h"
#include "expr/traversal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    MAX_ITERATIONS = 60,
    MAX_ATTEMPTS = 20,
    MAX_OPERATIONS = 20 /* of what a variable is replaced by */
};
/* Fractions of the terms, of the first gradient, and of a unit of a variable that count as 0. */
static const double of_observables = 1e-2;
static const double zero_fraction = 1e-9, gradient_fraction = 1e-4, converged_fraction = 1e-13;

static void draw(dal__surface *s, int k)
{
    const dal__theory *w = s->theory;
    double *point = s->raw + (size_t)k * (size_t)w->symbols;
    for (int i = 0; i < w->symbols; i++)
        point[i] =
            w->centre[i] + (i < w->parameters ? 0.0 : w->reach[i] * dal__uniform(&s->random));
    memcpy(s->point + (size_t)k * (size_t)w->symbols, point, (size_t)w->symbols * sizeof *point);
}

void dal__surface_begin(dal__surface *s, const dal__theory *theory, dal__pool *pool)
{
    const size_t variables = 2 * (size_t)theory->pairs;
    const size_t size = DAL__SURFACE_POINTS * (size_t)theory->symbols;
    *s = (dal__surface){.theory = theory, .pool = pool, .random = {2025}};
    s->symbol = dal__pool_allocate(pool, variables + 1, sizeof *s->symbol);
    s->by = dal__pool_nodes(pool, theory->graph, variables);
    s->constraint = dal__pool_nodes(pool, theory->graph, variables + 1);
    s->raw = dal__pool_allocate(pool, size, sizeof *s->raw);
    s->point = dal__pool_allocate(pool, size, sizeof *s->point);
    if (pool->out_of_memory) return;
    for (int k = 0; k < DAL__SURFACE_POINTS; k++) draw(s, k);
}

void dal__surface_restrict(const dal__surface *s, size_t count, dal__node *nodes)
{
    if (s->solved > 0 && count > 0)
        dal__substitute_all(s->theory->graph, (int)count, nodes, s->symbol, s->solved, s->by);
}

/* ---- values -------------------------------------------------------------------------------- */

/* Nodes to be evaluated at points. */
typedef struct program {
    dal__tapes *tapes;
    double *work;
} program;

static void close_program(program *p)
{
    dal__tapes_free(p->tapes);
    free(p->work);
    *p = (program){.tapes = NULL};
}

/* False where the graph is full or memory runs out. */
static bool open_program(const dal__surface *s, int count, const dal__node *nodes, program *p)
{
    const dal__theory *w = s->theory;
    *p = (program){.tapes = NULL};
    if (w->graph->status != DAL_STATUS_OK) return false;
    p->tapes = dal__tapes_create(w->graph, w->parameters, w->symbols - w->parameters);
    if (p->tapes && dal__tapes_add(p->tapes, nodes, count) == 0 &&
        dal__tapes_finish(p->tapes) == DAL_STATUS_OK)
        p->work = dal__numbers(1, p->tapes->workspace + 1);
    s->pool->out_of_memory |= !p->work;
    return p->work != NULL;
}

static void run_program(const dal__theory *w, const program *p, const double *point, double *out)
{
    const size_t parameters = (size_t)w->parameters;
    memcpy(p->work, point, parameters * sizeof *point);
    dal__tapes_prepare_x1(p->tapes, p->work);
    memcpy(p->work + p->tapes->first_input, point + parameters,
           ((size_t)w->symbols - parameters) * sizeof *point);
    dal__tape_run_x1(p->tapes, 0, p->work, out);
}

static double *point_of(const dal__surface *s, double *points, int k)
{
    return points + (size_t)k * (size_t)s->theory->symbols;
}

double dal__least_size(const double *value, size_t stride)
{
    double least = INFINITY;
    for (size_t k = 0; k < DAL__SURFACE_POINTS; k++)
        least = fmin(least, isfinite(value[k * stride]) ? fabs(value[k * stride]) : 0.0);
    return least;
}

bool dal__surface_values(const dal__surface *s, int count, const dal__node *nodes, double *out)
{
    program p;
    const bool is_open = open_program(s, count, nodes, &p);
    for (int i = 0; i < DAL__SURFACE_POINTS * count; i++) out[i] = NAN;
    for (int k = 0; is_open && k < DAL__SURFACE_POINTS; k++)
        run_program(s->theory, &p, point_of(s, s->point, k), out + (size_t)k * (size_t)count);
    close_program(&p);
    return is_open;
}

dal_status dal__surface_clean(const dal__surface *s, int count, dal__node *nodes)
{
    dal__graph *graph = s->theory->graph;
    dal__surface_restrict(s, (size_t)count, nodes);
    dal__node *some = malloc(((size_t)count + 1) * sizeof *some);
    int found = 0;
    for (int i = 0; some && i < count; i++)
        if (dal__inspect(graph, nodes[i]).op != DAL__NUMBER) some[found++] = nodes[i];
    const size_t n = (size_t)found;
    dal__terms *terms = some ? dal__terms_create(graph, some, found) : NULL;
    const size_t memory = terms ? dal__terms_memory(terms) : 0;
    double *scale = dal__numbers(1, (DAL__SURFACE_POINTS + 2) * n + memory + 1);
    double *here = scale + n, *value = here + n;
    const bool has_memory = terms && scale;
    dal_status status = DAL_STATUS_OK;
    s->pool->out_of_memory |= !has_memory;
    if (has_memory) dal__terms_count_fixed(terms);
    for (int k = 0; has_memory && k < DAL__SURFACE_POINTS; k++) {
        /* Off the surface: on it small terms would be compared with themselves. */
        dal__terms_scales(terms, point_of(s, s->raw, k), value, here);
        for (size_t i = 0; i < n; i++)
            scale[i] = isnan(here[i]) ? INFINITY : fmax(scale[i], here[i]);
    }
    if (has_memory && found > 0) dal__surface_values(s, found, some, value);
    for (size_t i = 0, k = 0; has_memory && i < (size_t)count; i++) {
        if (dal__inspect(graph, nodes[i]).op == DAL__NUMBER) continue;
        double max = 0.0;
        for (size_t point = 0; point < DAL__SURFACE_POINTS; point++) {
            if (!isfinite(value[point * n + k])) status = DAL_STATUS_NOT_FINITE;
            max = fmax(max, fabs(value[point * n + k]));
        }
        if (max <= zero_fraction * scale[k++]) nodes[i] = dal__number(graph, 0.0);
    }
    free(some);
    free(scale);
    dal__terms_free(terms);
    return status;
}

/* ---- points -------------------------------------------------------------------------------- */

/* c = 0 in free variables, and memory of an iteration. */
typedef struct newton {
    const dal__surface *surface;
    program program;
    int rows, columns;
    const int *symbol;                   /* [columns] the free variables, */
    const double *unit;                  /* [columns] and in what they are moved */
    double *out;                         /* [rows*(1 + columns)] c, J */
    double *right, *step, *first, *work; /* [rows], [columns], [rows], of least squares */
} newton;

/* The length of each gradient in units of the variables, which J gets. */
static bool scale_gradients(const newton *w, double *length)
{
    double *J = w->out + w->rows;
    for (int a = 0; a < w->rows; a++) {
        length[a] = 0.0;
        for (int i = 0; i < w->columns; i++) {
            J[a * w->columns + i] *= w->unit[i];
            length[a] = fmax(length[a], fabs(J[a * w->columns + i]));
        }
    }
    return isfinite(dal__max_abs(w->out, (size_t)(w->rows * (1 + w->columns))));
}

static dal__surface_state move_to_surface(const newton *w, double *point)
{
    const dal__theory *theory = w->surface->theory;
    double change = INFINITY;
    for (int k = 0; k < MAX_ITERATIONS && change > converged_fraction; k++) {
        run_program(theory, &w->program, point, w->out);
        if (!scale_gradients(w, k == 0 ? w->first : w->right)) return DAL__SURFACE_EMPTY;
        for (int a = 0; a < w->rows; a++) w->right[a] = -w->out[a];
        dal__least_squares(w->rows, w->columns, w->out + w->rows, w->right, w->step, 1e-12, NULL,
                           w->work);
        change = dal__max_abs(w->step, (size_t)w->columns);
        for (int i = 0; i < w->columns; i++) point[w->symbol[i]] += w->unit[i] * w->step[i];
    }
    run_program(theory, &w->program, point, w->out);
    if (!scale_gradients(w, w->right) || !(change <= 1e3 * converged_fraction))
        return DAL__SURFACE_EMPTY;
    const double rest = dal__max_abs(w->out, (size_t)w->rows);
    for (int a = 0; a < w->rows; a++) {
        if (w->right[a] < gradient_fraction * w->first[a]) return DAL__SURFACE_IRREGULAR;
        for (int i = 0; i < w->columns; i++) w->out[w->rows + a * w->columns + i] /= w->right[a];
    }
    if (dal__least_squares(w->rows, w->columns, w->out + w->rows, NULL, NULL, gradient_fraction,
                           NULL, w->work) < w->rows)
        return DAL__SURFACE_IRREGULAR;
    return rest <= zero_fraction * dal__max_abs(w->first, (size_t)w->rows) ? DAL__SURFACE_REGULAR
                                                                           : DAL__SURFACE_EMPTY;
}

/* Moves the points to the implicit constraints.  Free are the variables that no constraint gives.
 * Observables are moved less, so that what is linear in momenta is solved for momenta and not by a
 * special place. */
static void find_points(dal__surface *s)
{
    const int rows = s->implicit, variables = 2 * s->theory->pairs;
    const size_t size = (size_t)variables * (size_t)(variables + 4) + 2 * (size_t)rows +
                        (size_t)rows * (size_t)(1 + variables);
    s->state = DAL__SURFACE_REGULAR;
    if (rows == 0) return;
    int *symbol = malloc((size_t)variables * sizeof *symbol);
    dal__node *nodes = malloc((size_t)(rows * (1 + variables)) * sizeof *nodes);
    double *block = dal__numbers(1, size);
    const bool has_memory = symbol && nodes && block;
    s->pool->out_of_memory |= !has_memory;
    if (has_memory) {
        newton w = {.surface = s, .rows = rows, .symbol = symbol, .unit = block};
        for (int i = 0; i < variables; i++) {
            const int variable = s->theory->variable[i];
            int k = 0;
            while (k < s->solved && s->symbol[k] != variable) k++;
            if (k < s->solved) continue;
            block[w.columns] =
                s->theory->reach[variable] * (i < s->theory->observables ? of_observables : 1.0);
            symbol[w.columns++] = variable;
        }
        w.right = block + variables, w.first = w.right + rows, w.step = w.first + rows;
        w.out = w.step + variables, w.work = w.out + rows * (1 + variables);
        for (int a = 0; a < rows; a++) {
            nodes[a] = s->constraint[a];
            dal__gradient(s->theory->graph, nodes[a], symbol, w.columns,
                          nodes + rows + a * w.columns);
        }
        const bool is_open = open_program(s, rows * (1 + w.columns), nodes, &w.program);
        for (int k = 0, attempt = 0; is_open && k < DAL__SURFACE_POINTS;) {
            double *point = point_of(s, s->point, k);
            if (attempt > 0) draw(s, k);
            memcpy(point, point_of(s, s->raw, k), (size_t)s->theory->symbols * sizeof *point);
            s->state = move_to_surface(&w, point);
            const bool tries_again = s->state == DAL__SURFACE_EMPTY && ++attempt < MAX_ATTEMPTS;
            if (tries_again) continue;
            if (s->state != DAL__SURFACE_REGULAR) break;
            attempt = 0;
            k++;
        }
        close_program(&w.program);
    }
    free(symbol);
    free(nodes);
    free(block);
}

/* ---- constraints --------------------------------------------------------------------------- */

/* A variable in which a constraint is linear, and its coefficient. */
typedef struct linear {
    int symbol;
    dal__node slope;
} linear;

/* The best variable to solve for: with the coefficient 1 or -1, momenta first; else of those that
 * are no observables the one whose coefficient is largest at the points.  Symbol -1: none. */
static void choose_variable(const dal__surface *s, dal__node constraint, linear *out)
{
    const dal__theory *w = s->theory;
    double best = 0.0, value[DAL__SURFACE_POINTS];
    *out = (linear){.symbol = -1};
    for (int i = 0; i < 2 * w->pairs; i++) {
        const int variable = (i + w->pairs) % (2 * w->pairs), symbol = w->variable[variable];
        dal__node slope;
        if (!dal__depends(w->graph, constraint, symbol, symbol + 1)) continue;
        dal__gradient(w->graph, constraint, &symbol, 1, &slope);
        if (dal__is_number(w->graph, slope, 1.0) || dal__is_number(w->graph, slope, -1.0)) {
            *out = (linear){symbol, slope};
            return;
        }
        if (variable < w->observables || dal__depends(w->graph, slope, symbol, symbol + 1))
            continue;
        dal__surface_values(s, 1, &slope, value);
        const double least = dal__least_size(value, 1);
        if (least > best) best = least, *out = (linear){symbol, slope};
    }
}

void dal__surface_add(dal__surface *s, dal__node constraint)
{
    const dal__theory *w = s->theory;
    linear by;
    choose_variable(s, constraint, &by);
    dal__node value = 0;
    if (by.symbol >= 0) {
        const dal__node zero = dal__number(w->graph, 0.0);
        value = dal__substitute(w->graph, constraint, &by.symbol, 1, &zero);
        value = dal__node_neg(w->graph, dal__node_div(w->graph, value, by.slope));
        value = dal__collect(w->graph, value);
    }
    if (value && dal__cost(w->graph, &value, 1) <= MAX_OPERATIONS) {
        dal__substitute_all(w->graph, s->solved, s->by, &by.symbol, 1, &value);
        dal__substitute_all(w->graph, s->implicit, s->constraint, &by.symbol, 1, &value);
        s->symbol[s->solved] = by.symbol;
        s->by[s->solved++] = value;
    } else {
        s->constraint[s->implicit++] = constraint; /* of more than variables none is regular */
    }
    find_points(s);
}
