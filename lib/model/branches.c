/* branches.c - where the motion changes from one formula to another, and what jumps there.
 *
 * A comparison, abs, sign, floor, min, max or a table changes its branch where a function s of the
 * state passes through zero: s = a - b of a < b, s = a of abs(a), s = a - x_i of a table, for that
 * point x_i where its derivative jumps most.  With the branch of s > 0 taken
 * everywhere F is a smooth F+, with the other one F-.  Along the normal of s,
 *
 *     the k-th derivative of F+ - F- at s = 0 is the jump of the same derivative of F,
 *
 * or what has no bound there, found beside points of s = 0 near the start: F+ is taken on its side
 * alone, and F- on the other, so that sign(s) sqrt|s| does not jump, and its derivative does.  A
 * step across s = 0 of any method of fixed formulas leaves an error O(h^(k+1)) where derivative k
 * is the first that jumps: its order is k + 1.
 *
 * Derivatives are taken branch by branch, so a jump of D or of the momentum L_v, which needs an
 * impulse, is not in F. */
#include "core/vectors.h"
#include "dalembert_evaluator.h"
#include "expr/derivative.h"
#include "expr/simplify.h"
#include "expr/terms.h"
#include "expr/traversal.h"
#include "model/held.h"
#include "model/model.h"
#include "model/symbols.h"
#include "model/units.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { POINTS = 6, MAX_ITERATIONS = 30, MAX_SURFACES = 64 };
/* Values of F+ and F- that differ by less are equal to rounding. */
#define ROUNDING 1e-9

typedef struct surface {
    dal_model *model;
    dal__node s;       /* not fixed */
    dal__node *normal; /* [1 + 4n] derivatives of s by t, q, v */
    double *point;     /* [POINTS*symbols] of s = 0 */
    double *moved;     /* [2*symbols] one beside it, and the normal there, in units */
    double *unit;      /* [symbols] */
    int points;
} surface;

/* ---- what a node switches on ---- */

/* The knot of a table where its highest derivative jumps most; -1: nowhere. */
static int find_corner(const dal__tape_table *table)
{
    const bool bounded = isnan(dal__table_value(table, 0, INFINITY));
    double max = 0.0;
    int corner = -1;
    for (int k = bounded; k < table->knots - bounded; k++) {
        const double *below = dal__table_piece(table, k), *above = dal__table_piece(table, k + 1);
        const double jump = fabs(above[1 + table->degree] - below[1 + table->degree]);
        if (jump > max) max = jump, corner = k;
    }
    return corner;
}

/* A derivative of a table at a, continued from one side of the corner. */
static dal__node table_side(dal__graph *graph, int symbol, dal__node a, int sign)
{
    const dal__tape_table *table = &graph->tables[symbol / DAL__TABLE_ORDERS];
    const double *piece = dal__table_piece(table, find_corner(table) + (sign > 0));
    const dal__node d = dal__node_sub(graph, a, dal__number(graph, piece[0]));
    const int order = symbol % DAL__TABLE_ORDERS;
    dal__node sum = dal__number(graph, 0.0);
    for (int k = table->degree; k >= order; k--) {
        double c = piece[1 + k];
        for (int i = 0; i < order; i++) c *= k - i;
        sum = dal__node_add(graph, dal__node_mul(graph, sum, d), dal__number(graph, c));
    }
    return sum;
}

/* The s of a node, with its sign in *sign; 0 where it does not switch. */
static dal__node switch_of(dal__graph *graph, dal__node i, int *sign)
{
    const dal__record r = dal__inspect(graph, i);
    dal__node s = dal__switch_argument(graph, i);
    if (s == 0) return 0;
    if (r.op == DAL__FLOOR) s = dal__node_sub(graph, s, dal__number(graph, 1.0));
    if (r.op == DAL__TABLE) {
        const dal__tape_table *table = &graph->tables[r.symbol / DAL__TABLE_ORDERS];
        const int corner = find_corner(table);
        if (corner < 0) return 0;
        s = dal__node_sub(graph, s, dal__number(graph, dal__table_piece(table, corner + 1)[0]));
    }
    const dal__node opposite = dal__node_neg(graph, s);
    *sign = opposite < s ? -1 : 1;
    return *sign > 0 ? s : opposite;
}

/* Node i, its operands replaced by their images, where its s has the sign given. */
static dal__node one_side(dal__graph *graph, dal__node i, const dal__node *image, int sign)
{
    const dal__record r = dal__inspect(graph, i);
    const dal__node a = image[r.a], b = image[r.b];
    switch ((dal__op)r.op) {
    case DAL__ABS:
        return sign > 0 ? a : dal__node_neg(graph, a);
    case DAL__SIGN:
        return dal__number(graph, sign);
    case DAL__FLOOR:
        return dal__number(graph, sign > 0 ? 1.0 : 0.0);
    case DAL__MIN:
        return sign > 0 ? b : a;
    case DAL__MAX:
        return sign > 0 ? a : b;
    case DAL__TABLE:
        return table_side(graph, r.symbol, a, sign);
    default:
        return dal__number(graph, sign > 0 ? 0.0 : 1.0);
    }
}

/* f with the branches of s > 0 (side 1) or of s < 0 (side -1). */
static dal__node smooth_side(dal__graph *graph, dal__node f, dal__node s, int side)
{
    uint8_t *mark = dal__reach(graph, f);
    dal__node *image = dal__per_node(graph, f, sizeof *image), result = 0;
    for (dal__node i = 1; mark && image && i <= f; i++) {
        int sign = 1;
        if (!mark[i]) continue;
        if (switch_of(graph, i, &sign) == s)
            image[i] = one_side(graph, i, image, side * sign);
        else
            image[i] = dal__rebuild(graph, i, image);
    }
    if (mark && image) result = image[f];
    free(mark);
    free(image);
    return result;
}

/* ---- points ---- */

/* The derivatives of s by t, q, v at a point in units; returns the size of the terms of s: from a
 * unit of each, and from the point itself. */
static double find_normal(const surface *f, const double *x, double *normal)
{
    const dal__equations *e = &f->model->equations;
    double size = 0.0;
    for (int i = 0; i < e->pi - e->t; i++) {
        const double unit = f->unit[e->t + i];
        normal[i] = dal__evaluate(e->graph, f->normal[i], x) * unit;
        size = fmax(size, fabs(normal[i]) * (1.0 + fabs(x[e->t + i] / unit)));
    }
    return size;
}

/* Newton's method along the normal, from the start moved irregularly. */
static bool find_point(const surface *f, int number, double *x)
{
    const dal__equations *e = &f->model->equations;
    const int symbols = e->pi - e->t;
    double *const normal = f->moved;
    for (int i = 0; i < e->symbols; i++) {
        x[i] = e->value[i];
        const double off = dal__golden_fraction(number * e->symbols + i + 1) - 0.5;
        if (i >= e->parameters) x[i] += f->unit[i] * off;
    }
    for (int k = 0; k < MAX_ITERATIONS; k++) {
        double s = dal__evaluate(e->graph, f->s, x);
        const double size = find_normal(f, x, normal);
        const double square = dal__dot_product(symbols, normal, normal);
        if (!isfinite(s / square)) return false;
        if (fabs(s) <= 1e-14 * size) return true;
        for (int i = 0; i < symbols; i++) x[e->t + i] -= s / square * normal[i] * f->unit[e->t + i];
    }
    return false;
}

static void find_points(surface *f)
{
    const dal__equations *e = &f->model->equations;
    f->points = 0;
    dal__gradient(e->graph, f->s, e->symbol + e->t, e->pi - e->t, f->normal);
    for (int k = 0; k < POINTS; k++)
        f->points += find_point(f, k, f->point + f->points * e->symbols);
}

/* ---- jumps ---- */

/* g at a point of the surface, moved along the normal: s changes by a fraction of its size. */
static double beside(const surface *f, dal__node g, const double *point, double fraction)
{
    const dal__equations *e = &f->model->equations;
    const int symbols = e->pi - e->t;
    double *x = f->moved, *normal = x + e->symbols;
    memcpy(x, point, (size_t)e->symbols * sizeof *x);
    const double size = find_normal(f, point, normal);
    const double square = dal__dot_product(symbols, normal, normal);
    for (int i = 0; i < symbols; i++)
        x[e->t + i] += fraction * size / square * normal[i] * f->unit[e->t + i];
    return dal__evaluate(e->graph, g, x);
}

/* The size of the terms of g at a point. */
static double size_of_terms(const surface *f, dal__node g, const double *point)
{
    dal__terms *terms = dal__terms_create(f->model->equations.graph, &g, 1);
    double *memory = terms ? dal__numbers(1, dal__terms_memory(terms)) : NULL, size = 0.0;
    if (memory) dal__terms_scales(terms, point, memory, &size);
    f->model->out_of_memory |= !memory;
    free(memory);
    dal__terms_free(terms);
    return isfinite(size) ? size : 0.0;
}

/* Whether F+ on its side of the surface and F- on the other do not meet there: their difference
 * does not vanish, or one of them grows without bound, as what is beside it comes nearer. */
static bool differ(const surface *f, dal__node above, dal__node below)
{
    static const double far = 1e-6, near = 1e-9, vanishing = 0.7, growing = 1.2;
    for (int k = 0; k < f->points; k++) {
        const double *point = f->point + k * f->model->equations.symbols;
        const double a1 = beside(f, above, point, far), b1 = beside(f, below, point, -far);
        const double a2 = beside(f, above, point, near), b2 = beside(f, below, point, -near);
        const double size = fabs(a2) + fabs(b2) + size_of_terms(f, above, point);
        const double zero = ROUNDING * size, gap = fabs(a2 - b2);
        if (gap > zero && gap > vanishing * fabs(a1 - b1)) return true;
        if (fabs(a2) > zero && fabs(a2) > growing * fabs(a1)) return true;
        if (fabs(b2) > zero && fabs(b2) > growing * fabs(b1)) return true;
    }
    return false;
}

/* The first derivative of g, of those below max, that jumps on the surface; max: none of them. */
static int first_jump(const surface *f, dal__node g, int max)
{
    const dal__equations *e = &f->model->equations;
    dal__node above = smooth_side(e->graph, g, f->s, 1);
    dal__node below = smooth_side(e->graph, g, f->s, -1);
    for (int k = 0; k < max; k++) {
        if (above == below) return max;
        if (differ(f, above, below)) return k;
        const int *symbols = e->symbol + e->t, count = e->pi - e->t;
        above = dal__tangent(e->graph, above, symbols, count, f->normal);
        below = dal__tangent(e->graph, below, symbols, count, f->normal);
    }
    return max;
}

/* Whether L, L_v or a D jumps. */
static bool needs_impulse(const surface *f)
{
    const dal__equations *e = &f->model->equations;
    if (!e->accelerations && first_jump(f, e->lagrangian, 1) == 0) return true;
    for (int i = 0; i < e->n && !e->accelerations; i++)
        if (first_jump(f, e->momentum[i], 1) == 0) return true;
    for (int a = 0; a < e->m; a++)
        if (first_jump(f, e->constraint[a], 1) == 0) return true;
    return false;
}

/* What jumps on one surface. */
static int jump_at(surface *f)
{
    const dal__equations *e = &f->model->equations;
    int jump = DAL_JUMP_NONE;
    find_points(f);
    if (f->points == 0) return DAL_JUMP_UNKNOWN;
    if (needs_impulse(f)) return DAL_JUMP_IMPULSE;
    for (int i = 0; i < e->n + e->multipliers && jump > 0; i++) {
        const int found = first_jump(f, e->F[i], jump);
        if (found < jump) jump = found;
    }
    return jump;
}

/* ---- formulas ---- */

/* The first jump of those on the surfaces of a formula; false: it has none. */
static bool examine(surface *f, dal__node formula, int *jump)
{
    dal__graph *graph = f->model->equations.graph;
    dal__node seen[MAX_SURFACES];
    uint8_t *mark = dal__reach(graph, formula);
    int count = 0;
    *jump = DAL_JUMP_UNKNOWN;
    for (dal__node i = 1; mark && i <= formula && count < MAX_SURFACES; i++) {
        int sign, k = 0;
        f->s = mark[i] ? switch_of(graph, i, &sign) : 0;
        while (k < count && seen[k] != f->s) k++;
        if (!f->s || k < count) continue;
        seen[count++] = f->s;
        const int found = jump_at(f);
        if (found < *jump) *jump = found;
    }
    free(mark);
    return count > 0;
}

/* The formula of an entry: of a section whose entries have nodes of their own, in their order. */
static dal__node formula_of(const dal_model *model, const dal__entry *entry)
{
    const dal__equations *e = &model->equations;
    int number = 0;
    for (const dal__entry *other = model->entries; other < entry; other++)
        number += other->section == entry->section;
    if (entry->section == DAL_SECTION_LAGRANGIAN) return e->lagrangian;
    if (entry->section == DAL_SECTION_CONSTRAINTS) return e->constraint[number];
    if (entry->section == DAL_SECTION_HOLONOMIC) return e->position[number];
    if (entry->section == DAL_SECTION_EQUATIONS && e->implicit) return e->equation[number];
    if (entry->section == DAL_SECTION_FORCES || entry->section == DAL_SECTION_ACCELERATIONS)
        for (int i = 0; i < e->n; i++)
            if (strcmp(e->coordinate[i], entry->name) == 0) return e->force[i];
    return 0;
}

static void place_surface(surface *f, dal_model *model)
{
    const int symbols = model->equations.symbols;
    *f = (surface){.model = model};
    f->normal = calloc((size_t)symbols, sizeof *f->normal);
    f->point = calloc((size_t)((POINTS + 3) * symbols), sizeof *f->point);
    model->out_of_memory |= !f->normal || !f->point;
    if (model->out_of_memory) return;
    f->moved = f->point + POINTS * symbols;
    f->unit = f->moved + 2 * symbols;
    dal__model_units(model, f->unit);
}

static void free_surface(surface *f)
{
    free(f->normal);
    free(f->point);
}

dal_status dal_model_branches(dal_model *model, dal_branch *branch, int capacity, int *count)
{
    DAL_REQUIRE(model && model->made && count && (branch || capacity <= 0), NULL);
    const dal__equations *e = &model->equations;
    surface f;
    model->out_of_memory = false;
    place_surface(&f, model);
    *count = 0;
    for (int k = 0; k < model->count && !model->out_of_memory; k++) {
        const dal__entry *entry = &model->entries[k];
        const dal__node formula = formula_of(model, entry);
        int jump = DAL_JUMP_UNKNOWN;
        if (!formula || !dal__reaches(e->graph, formula, DAL__ROUGH)) continue;
        if (!examine(&f, formula, &jump) || (*count)++ >= capacity) continue;
        dal_branch *to = &branch[*count - 1];
        *to = (dal_branch){.jump = jump, .line = entry->line, .column = entry->column};
        dal__entry_title(model, entry, to->formula, sizeof to->formula);
    }
    free_surface(&f);
    return dal__model_conclude(model, DAL_STATUS_OK, NULL);
}

/* ---- motions that meet a jump ---- */

/* A node that switches where F or F_v jumps. */
typedef struct switching {
    dal__node node;
    const dal__entry *entry; /* the formula that contains it */
    double branch;           /* that it had last; NaN: none yet */
} switching;

struct dal_jumps {
    dal_model *model;
    int count, capacity;
    switching *item; /* [count] */
    double *x;       /* [symbols] the point */
    char title[128];
};

/* Whether F or F_v jumps on the surface; where no point of it is found, whether a node may. */
static bool jumps_in_tangent(surface *f, dal__op op)
{
    const dal__equations *e = &f->model->equations;
    const int components = e->n + e->multipliers;
    find_points(f);
    if (f->points == 0)
        return op != DAL__ABS && op != DAL__MIN && op != DAL__MAX && op != DAL__TABLE;
    if (needs_impulse(f)) return true;
    for (int i = 0; i < components; i++) {
        if (first_jump(f, e->F[i], 1) == 0) return true;
        for (int j = 0; j < e->n; j++) {
            dal__node slope;
            dal__gradient(e->graph, e->F[i], e->symbol + e->v + j, 1, &slope);
            if (first_jump(f, slope, 1) == 0) return true;
        }
    }
    return false;
}

/* The branch of a node at the point x: the sign of what it compares, or the number of its piece;
 * NaN between two branches. */
static double branch_of(const dal_jumps *jumps, dal__node i)
{
    dal__graph *graph = jumps->model->equations.graph;
    const dal__record r = dal__inspect(graph, i);
    const double a = dal__evaluate(graph, r.a, jumps->x);
    if (r.op == DAL__FLOOR) return floor(a);
    if (r.op == DAL__TABLE) {
        const dal__tape_table *table = &graph->tables[r.symbol / DAL__TABLE_ORDERS];
        int piece = 0;
        while (piece < table->knots && a > dal__table_piece(table, piece + 1)[0]) piece++;
        return piece;
    }
    const bool is_unary = r.op == DAL__ABS || r.op == DAL__SIGN;
    const double s = is_unary ? a : a - dal__evaluate(graph, r.b, jumps->x);
    return s > 0.0 ? 1.0 : s < 0.0 ? -1.0 : NAN;
}

/* Adds the nodes of a formula that switch at a jump. */
static void add_switches(dal_jumps *jumps, surface *f, const dal__entry *entry, dal__node formula)
{
    dal__graph *graph = f->model->equations.graph;
    uint8_t *mark = dal__reach(graph, formula);
    for (dal__node i = 1; mark && i <= formula; i++) {
        int sign;
        f->s = mark[i] ? switch_of(graph, i, &sign) : 0;
        if (!f->s || !jumps_in_tangent(f, (dal__op)dal__inspect(graph, i).op)) continue;
        if (jumps->count == jumps->capacity) {
            const int capacity = 2 * jumps->capacity + 8;
            switching *item = realloc(jumps->item, (size_t)capacity * sizeof *item);
            f->model->out_of_memory |= !item;
            if (!item) break;
            jumps->item = item;
            jumps->capacity = capacity;
        }
        jumps->item[jumps->count++] = (switching){i, entry, NAN};
    }
    free(mark);
}

dal_status dal_jumps_create(dal_jumps **jumps, dal_model *model)
{
    DAL_REQUIRE(jumps && model && model->made, NULL);
    const dal__equations *e = &model->equations;
    surface f;
    *jumps = calloc(1, sizeof **jumps);
    if (!*jumps) return DAL_STATUS_MEMORY;
    (*jumps)->model = model;
    (*jumps)->x = calloc((size_t)e->symbols, sizeof(double));
    model->out_of_memory = !(*jumps)->x;
    place_surface(&f, model);
    for (int k = 0; k < model->count && !model->out_of_memory; k++) {
        const dal__node formula = formula_of(model, &model->entries[k]);
        if (formula && dal__reaches(e->graph, formula, DAL__ROUGH))
            add_switches(*jumps, &f, &model->entries[k], formula);
    }
    free_surface(&f);
    const dal_status status = dal__model_conclude(model, DAL_STATUS_OK, NULL);
    if (status == DAL_STATUS_OK) return DAL_STATUS_OK;
    dal_jumps_free(*jumps);
    *jumps = NULL;
    return status;
}

void dal_jumps_free(dal_jumps *jumps)
{
    if (!jumps) return;
    free(jumps->item);
    free(jumps->x);
    free(jumps);
}

int dal_jumps_count(const dal_jumps *jumps) { return jumps ? jumps->count : 0; }

const char *dal_jumps_passed(dal_jumps *jumps, const dal_run *run)
{
    const char *passed = NULL;
    if (!jumps || !run) return NULL;
    const dal__equations *e = &jumps->model->equations;
    const double *state = dal_run_state(run);
    memcpy(jumps->x, dal_run_parameters(run), (size_t)e->parameters * sizeof(double));
    jumps->x[e->t] = dal_run_time(run);
    memcpy(jumps->x + e->q, state, (size_t)e->n * sizeof(double));
    memcpy(jumps->x + e->v, state + e->n, (size_t)e->n * sizeof(double));
    for (switching *s = jumps->item; s < jumps->item + jumps->count; s++) {
        const double branch = branch_of(jumps, s->node), before = s->branch;
        if (isnan(branch)) continue;
        s->branch = branch;
        if (passed || isnan(before) || branch == before) continue;
        dal__entry_title(jumps->model, s->entry, jumps->title, sizeof jumps->title);
        passed = jumps->title;
    }
    return passed;
}
