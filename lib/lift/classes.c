/* classes.c - first and second class, Dirac brackets, gauge generators.
 *
 * Second-class constraints psi_i are chosen one pair after the other, by elimination in the
 * antisymmetric matrix {phi_a, phi_b} at a point of the surface, until no bracket remains.  With
 * u_i {psi_i, psi_j} = {A, psi_j},
 *
 *     {A, B}_D = {A, B} - u_i {psi_i, B},       phi - u_i psi_i is first class for A = phi. */
#include "lift/classes.h"
#include "core/error.h"
#include "core/vectors.h"
#include "expr/simplify.h"
#include "lift/pairs.h"
#include <stdlib.h>

/* Forms and brackets, by the u of every first-class constraint and of the observables: right sides
 * of one system of equations. */
static dal_status find_brackets(dal__classes *k, dal__chain *c)
{
    const dal__theory *w = c->theory;
    const int columns = 2 * k->observables;
    dal__reduction r;
    dal__reduction_begin(&r, &c->surface, k->second, k->second, c->count + k->observables);
    if (dal__theory_is_lost(w, c->pool)) return DAL_STATUS_OK;
    for (int j = 0; j < k->second; j++) {
        const dal__node *psi = c->constraint[k->second_class[j]].gradient;
        dal__node *entry = r.entry + (size_t)j * (size_t)r.width;
        for (int i = 0; i < k->second; i++)
            entry[i] = dal__bracket(w, c->constraint[k->second_class[i]].gradient, psi);
        for (int a = 0; a < c->count; a++)
            if (k->is_first[a])
                entry[k->second + a] = dal__bracket(w, psi, c->constraint[a].gradient);
        for (int i = 0; i < k->observables; i++)
            entry[k->second + c->count + i] = dal__bracket_with(w, psi, i);
    }
    DAL_TRY(dal__reduction_solve(&r, &c->surface));
    if (dal__theory_is_lost(w, c->pool)) return DAL_STATUS_OK;
    for (int a = 0; a < c->count; a++) {
        k->form[a] = c->constraint[a].phi;
        for (int i = 0; k->is_first[a] && i < k->second; i++) {
            const dal__node u = dal__reduction_value(&r, w->graph, i, a, NULL);
            const dal__node psi = c->constraint[k->second_class[i]].phi;
            k->form[a] = dal__node_sub(w->graph, k->form[a], dal__node_mul(w->graph, u, psi));
        }
    }
    for (int ij = 0; ij < k->observables * columns; ij++) {
        const int i = ij / columns, j = ij % columns;
        const int B = j < k->observables ? j : w->pairs + j - k->observables;
        dal__node sum = dal__number(w->graph, B == w->pairs + i ? 1.0 : 0.0);
        for (int l = 0; l < k->second; l++) {
            const dal__node *psi = c->constraint[k->second_class[l]].gradient;
            const dal__node with = dal__bracket_with(w, psi, B);
            if (dal__node_is_zero(w->graph, with)) continue;
            const dal__node u = dal__reduction_value(&r, w->graph, l, c->count + i, NULL);
            sum = dal__node_sub(w->graph, sum, dal__node_mul(w->graph, u, with));
        }
        k->bracket[ij] = sum;
    }
    return dal__surface_clean(&c->surface, k->observables * columns, k->bracket);
}

dal_status dal__classes_find(dal__classes *k, dal__chain *c)
{
    const dal__theory *w = c->theory;
    const size_t n = (size_t)c->count, size = n * n, o = (size_t)w->observables;
    *k = (dal__classes){.observables = w->observables};
    k->second_class = dal__pool_allocate(c->pool, n + 1, sizeof *k->second_class);
    k->is_first = dal__pool_allocate(c->pool, n + 1, sizeof *k->is_first);
    k->form = dal__pool_nodes(c->pool, w->graph, n);
    k->bracket = dal__pool_nodes(c->pool, w->graph, 2 * o * o);
    bool *is_symbol = dal__pool_allocate(c->pool, 2 * n + 1, sizeof *is_symbol);
    bool *is_second = is_symbol + n;
    dal__node *bracket = malloc((size + 1) * sizeof *bracket);
    double *value = dal__numbers(DAL__SURFACE_POINTS + 1, size + 1);
    c->pool->out_of_memory |= !bracket || !value;
    bool is_known = !c->pool->out_of_memory;
    dal_status status = DAL_STATUS_OK;
    for (size_t i = 0; is_known && i < size; i++)
        bracket[i] = dal__bracket(w, c->constraint[i / n].gradient, c->constraint[i % n].gradient);
    if (is_known) status = dal__surface_clean(&c->surface, (int)size, bracket);
    is_known = is_known && status == DAL_STATUS_OK &&
               dal__surface_values(&c->surface, (int)size, bracket, value);
    for (size_t i = 0; is_known && i < n; i++)
        is_symbol[i] = dal__inspect(w->graph, c->constraint[i].phi).op == DAL__SYMBOL;
    if (is_known) /* at the first point */
        dal__choose_pairs((int)n, value, value + DAL__SURFACE_POINTS * size, is_symbol, is_second);
    for (size_t i = 0; is_known && i < n; i++) {
        k->is_first[i] = !is_second[i];
        if (is_second[i]) k->second_class[k->second++] = (int)i;
    }
    free(bracket);
    free(value);
    return is_known ? find_brackets(k, c) : status;
}
