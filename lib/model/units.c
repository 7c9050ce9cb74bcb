/* units.c - the sizes of the symbols of a model near its start, as powers of two.
 *
 *     v_i   |v_i|, or that of equal energy: W_ii v_i^2 = max_j W_jj v_j^2, or S(L) at rest
 *     q_i   |q_i|, or the smallest at which S of L, a D or a force grows by a part
 *     t     |t|, or likewise              g_a   S(L)/S(D_a)
 *
 * S(f) is the size of the terms of f (expr/terms.h).  What begins at 0 and changes nothing has the
 * unit 1.  All change with the units of the user as the symbols do: points at distances of theirs
 * are the same in all units.  lib/analysis/scaled.c knows the motion, and has better ones. */
#include "model/units.h"
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

/* Whether the scale of a formula grows from s->scale by a part of it, with one symbol moved. */
static bool changes(const survey *s, int symbol, double by)
{
    static const double part = 0.25;
    const double held = s->x[symbol];
    bool found = false;
    s->x[symbol] += by;
    dal__terms_scales(s->terms, s->x, s->memory, s->moved);
    s->x[symbol] = held;
    for (int k = 0; k < s->formulas && !found; k++)
        found = s->scale[k] > 0.0 && s->moved[k] > (1.0 + part) * s->scale[k];
    return found;
}

/* The unit of a symbol that is 0: 2^k for the smallest k that changes a formula. */
static double find_change(const survey *s, int symbol)
{
    enum { MIN = -150, MAX = 150 };
    int low = MIN, high = MAX;
    if (!changes(s, symbol, ldexp(1.0, high))) return 1.0;
    while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        *(changes(s, symbol, ldexp(1.0, middle)) ? &high : &low) = middle;
    }
    return ldexp(1.0, high);
}

static void find_others(const survey *s)
{
    const dal__equations *e = s->e;
    for (int i = 0; i < e->n; i++) s->x[e->v + i] += s->unit[e->v + i];
    dal__terms_scales(s->terms, s->x, s->memory, s->scale);
    for (int i = e->t; i < e->q + e->n; i++) {
        s->unit[i] = dal__power_of_two(s->x[i]);
        if (s->unit[i] == 0.0) s->unit[i] = find_change(s, i);
    }
    for (int a = 0; a < e->multipliers; a++) {
        const double unit = dal__power_of_two(s->scale[0] / s->scale[1 + a]);
        s->unit[e->g + a] = unit > 0.0 ? unit : 1.0;
    }
}

dal_status dal__model_units(dal_model *model, double *unit)
{
    const dal__equations *e = &model->equations;
    const int n = e->n, m = e->m;
    survey s = {.e = e, .unit = unit, .formulas = 1 + m + n};
    for (int i = 0; i < e->symbols; i++) unit[i] = 1.0;
    s.x = dal__model_allocate(model, (size_t)e->symbols, sizeof *s.x);
    s.node = dal__model_nodes(model, s.formulas, e->lagrangian);
    s.scale = dal__model_allocate(model, 2 * (size_t)s.formulas, sizeof *s.scale);
    if (model->out_of_memory) return DAL_MEMORY;
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
        find_others(&s);
    }
    dal__terms_free(s.terms);
    model->out_of_memory |= !s.memory;
    return s.memory ? DAL_OK : DAL_MEMORY;
}
