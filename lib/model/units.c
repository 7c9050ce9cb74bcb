/* units.c - the sizes of the symbols of a model near its start, as powers of two.
 *
 * For points at which formulas are compared:
 *
 *     v_i   |v_i|, or the one of equal energy: W_ii v_i^2 = max_j W_jj v_j^2, or S(L) at rest
 *     q_i   |q_i|, or the smallest at which S of L, a D or a force grows by a quarter
 *     t     |t|, or likewise              g_a   S(L)/S(D_a)
 *
 * S(f) is the size of the terms of f (expr/terms.h).  What begins at 0 and changes nothing has the
 * unit 1.  All change with the units of the user as the symbols do: points at distances of theirs
 * are the same in all units.
 *
 * For runs, where the motion is known (core/sizes.h):
 *
 *     l_i = r_i max_j l'_j/r_j        l' the lengths of the motion, r_i = sqrt(W_11/W_ii)
 *     u_i = l_i/tau                   g_a, D_a, E: as above, S(L)/S(D_a), S(D_a), S(L)
 *
 * So coordinates of equal inertia have equal units, whatever they do near the start; l'_i is taken
 * of coordinates without inertia, and of given accelerations. */
#include "model/units.h"
#include "core/settings.h"
#include "core/sizes.h"
#include "core/solved.h"
#include "core/vectors.h"
#include "expr/terms.h"
#include "expr/traversal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct survey {
    const dal__equations *e;
    double *unit, *x;  /* [symbols] */
    dal__node *node;   /* [formulas]: L, D_a, Q_i */
    dal__terms *terms; /* of these */
    int formulas;
    double *scale, *moved, *memory; /* [formulas]: scales at x and beside it; of terms */
} survey;

/* Equal energies, of v that are 0 at the start. */
static void find_speeds(const survey *s)
{
    const dal__equations *e = s->e;
    double energy = 0.0;
    for (int i = 0; i < e->n; i++) {
        const double mass = fabs(dal__evaluate(e->graph, e->W[i * e->n + i], s->x));
        s->unit[e->v + i] = dal__power_of_two(s->x[e->v + i]);
        s->scale[i] = isfinite(mass) ? mass : 0.0;
        energy = fmax(energy, s->scale[i] * pow(s->unit[e->v + i], 2.0));
    }
    if (energy == 0.0) energy = s->scale[e->n];
    for (int i = 0; i < e->n; i++) {
        double *const unit = &s->unit[e->v + i];
        if (*unit == 0.0 && s->scale[i] > 0.0)
            *unit = dal__power_of_two(sqrt(energy / s->scale[i]));
        if (*unit == 0.0) *unit = 1.0;
    }
}

/* Whether the scale of a formula grows from s->scale by that fraction, with one symbol moved. */
static bool changes(const survey *s, int symbol, double by)
{
    static const double fraction = 0.25;
    const double held = s->x[symbol];
    bool found = false;
    s->x[symbol] += by;
    dal__terms_scales(s->terms, s->x, s->memory, s->moved);
    s->x[symbol] = held;
    for (int k = 0; k < s->formulas && !found; k++)
        found = s->scale[k] > 0.0 && s->moved[k] > (1.0 + fraction) * s->scale[k];
    return found;
}

/* The unit of a symbol that is 0: 2^k for the smallest k that changes a formula, 1 where none does.
 * The search begins at *guess, such a k of another symbol, which becomes this one's. */
static double find_change(const survey *s, int symbol, int *guess)
{
    enum { MIN = -150, MAX = 150 };
    int low = *guess, high = *guess;
    const bool changed = changes(s, symbol, ldexp(1.0, *guess));
    for (int step = 1; low == high; step *= 2) {
        if (!changed && high == MAX) return 1.0;
        if (changed) low = low - step > MIN ? low - step : MIN;
        if (!changed) high = high + step < MAX ? high + step : MAX;
        if (changed && low > MIN && changes(s, symbol, ldexp(1.0, low))) high = low;
        if (!changed && !changes(s, symbol, ldexp(1.0, high))) low = high;
    }
    while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        *(changes(s, symbol, ldexp(1.0, middle)) ? &high : &low) = middle;
    }
    *guess = high;
    return ldexp(1.0, high);
}

/* The units of t and q. */
static void find_others(const survey *s)
{
    const dal__equations *e = s->e;
    int guess = 0;
    for (int i = e->t; i < e->q + e->n; i++) {
        s->unit[i] = dal__power_of_two(s->x[i]);
        if (s->unit[i] == 0.0) s->unit[i] = find_change(s, i, &guess);
    }
}

/* levels[m + 1]: the units of D_a and of E, instead of the units of t and q; or NULL. */
static void find_symbols(dal_model *model, double *unit, double *levels)
{
    const dal__equations *e = &model->equations;
    const int n = e->n, m = e->m;
    survey s = {.e = e, .unit = unit, .formulas = 1 + m + n};
    for (int i = 0; i < e->symbols; i++) unit[i] = 1.0;
    s.x = dal__model_allocate(model, (size_t)e->symbols, sizeof *s.x);
    s.node = dal__model_nodes(model, s.formulas, e->lagrangian);
    s.scale = dal__model_allocate(model, 2 * (size_t)s.formulas, sizeof *s.scale);
    if (model->out_of_memory) return;
    memcpy(s.x, e->value, (size_t)e->symbols * sizeof *s.x);
    for (int a = 0; a < m; a++) s.node[1 + a] = e->constraint[a];
    for (int i = 0; i < n; i++) s.node[1 + m + i] = e->force[i];
    s.terms = dal__terms_create(e->graph, s.node, s.formulas);
    if (s.terms)
        s.memory = dal__model_allocate(model, dal__terms_memory(s.terms), sizeof *s.memory);
    if (s.memory) {
        dal__terms_scales(s.terms, s.x, s.memory, s.scale);
        s.scale[n] = s.scale[0];
        find_speeds(&s);
        s.moved = s.scale + s.formulas;
        for (int i = 0; i < n; i++) s.x[e->v + i] += unit[e->v + i];
        dal__terms_scales(s.terms, s.x, s.memory, s.scale);
        if (!levels) find_others(&s);
        for (int a = 0; a < e->multipliers; a++) {
            const double size = dal__power_of_two(s.scale[0] / s.scale[1 + a]);
            unit[e->g + a] = size > 0.0 ? size : 1.0;
        }
        for (int a = 0; levels && a <= m; a++) {
            const double level = dal__near_power_of_two(s.scale[a < m ? 1 + a : 0]);
            levels[a] = level > 0.0 ? level : 1.0;
        }
    }
    dal__terms_free(s.terms);
    model->out_of_memory |= !s.memory;
}

void dal__model_units(dal_model *model, double *unit) { find_symbols(model, unit, NULL); }

/* ---- units of runs ---- */

/* ratio[n]: sqrt(W_jj/W_ii), a power of two, with j the first coordinate that has an inertia; 0 for
 * those that have none.  1/2 and 1 give the same. */
static void find_ratios(const dal__equations *e, double *ratio)
{
    static const double off_centre = 1.4;
    double first = 0.0;
    for (int i = 0; i < e->n; i++) {
        const double mass = fabs(dal__evaluate(e->graph, e->W[i * e->n + i], e->value));
        int exponent;
        ratio[i] = 0.0;
        if (e->accelerations || !(mass > 0.0) || !isfinite(mass)) continue;
        if (first == 0.0) first = mass;
        frexp(off_centre * (first / mass), &exponent);
        ratio[i] = ldexp(1.0, (exponent - (exponent & 1)) / 2);
    }
}

/* The step gives the unit of time of a free motion. */
static double default_step(const dal_model *model)
{
    const dal__entry *entry;
    double step = 0.0;
    for (int k = 0; (entry = dal__model_entry(model, DAL_SECTION_DEFAULTS, k)) != NULL; k++)
        if (strcmp(entry->name, "step") == 0)
            dal__parse_number(entry->text, strlen(entry->text), &step);
    return step;
}

/* x[2n + multipliers + 1]: the default start, with velocities solved from D = 0 where they can be;
 * memory[dal__solve_size]. */
static bool find_start(const dal_system *s, double *x, double *work, double *memory)
{
    const size_t nw = (size_t)(s->n + s->multipliers);
    const dal_point at = {.work = work};
    if (s->prepare && s->prepare(s, &at, NULL) != DAL_STATUS_OK) return false;
    if (s->start(s, &at, x) != DAL_STATUS_OK) return false;
    if (s->solved_coordinates + s->solved_velocities == 0) return true;
    double *const guess = memory + dal__solve_size(s);
    const size_t bytes = ((size_t)s->n + nw) * sizeof *x;
    memcpy(guess, x, bytes);
    if (dal__solve_start(s, 0.0, x, work, memory, NULL) != DAL_STATUS_OK) memcpy(x, guess, bytes);
    return true;
}

static void find_lengths(const dal__sizes *sizes, const double *ratio, double *units)
{
    const int n = sizes->system->n;
    double length = 0.0;
    for (int i = 0; i < n; i++)
        if (ratio[i] > 0.0) length = fmax(length, sizes->length[i] / ratio[i]);
    for (int i = 0; i < n; i++) {
        units[i] = ratio[i] > 0.0 ? length * ratio[i] : sizes->length[i];
        units[n + i] = units[i] / sizes->time;
    }
}

void dal__system_units(dal_model *model, const dal_system *system, double *units)
{
    const dal__equations *e = &model->equations;
    const int n = e->n, nw = n + e->multipliers, symbols = e->symbols;
    const size_t numbers = (size_t)(symbols + n + (2 * n + e->multipliers + 1)) +
                           system->workspace + dal__sizes_memory(system) + dal__solve_size(system) +
                           (size_t)(n + nw);
    double *unit = calloc(numbers, sizeof *unit);
    model->out_of_memory |= !unit;
    if (model->out_of_memory) return;
    double *ratio = unit + symbols, *x = ratio + n, *work = x + 2 * n + e->multipliers + 1;
    double *memory = work + system->workspace;
    memcpy(work, system->value, (size_t)system->parameters * sizeof *work);
    find_symbols(model, unit, units + n + nw);
    find_ratios(e, ratio);
    if (find_start(system, x, work, memory)) {
        dal__sizes sizes = {.system = system, .work = work, .step = default_step(model), .x = x};
        dal__find_sizes(&sizes, memory);
        find_lengths(&sizes, ratio, units);
    }
    for (int a = 0; a < e->multipliers; a++) units[2 * n + a] = unit[e->g + a];
    free(unit);
}

dal_status dal__start_values(dal_model *model, const dal_setting *parameters, int parameter_count,
                             double **value, dal_error *error)
{
    const dal__equations *e = &model->equations;
    *value = dal__model_allocate(model, (size_t)e->symbols, sizeof **value);
    if (!*value) return dal__memory_error(error);
    memcpy(*value, e->value, (size_t)e->symbols * sizeof **value);
    return dal__set_parameters(&model->system, parameters, parameter_count, DAL_STATUS_NOT_FINITE,
                               *value, error);
}

const double *dal__complete_units(dal_model *model, const double *units)
{
    const size_t count = 1 + (size_t)model->equations.n;
    double *ones = units ? NULL : dal__model_allocate(model, count, sizeof *ones);
    for (size_t i = 0; ones && i < count; i++) ones[i] = 1.0;
    return units ? units : ones;
}
