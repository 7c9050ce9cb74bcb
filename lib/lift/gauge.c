/* gauge.c - multipliers and gauge generators.
 *
 * A free multiplier mu_f belongs to a primary first-class phi^f = dH/dmu_f.  Its gauge generator is
 *
 *     G = sum_k (-1)^k alpha^(K-k) chi_k,   chi_0 = phi^f,   chi_(k+1) = {chi_k, H} + d chi_k/dt,
 *
 * where chi_(K+1) and its gradient vanish on the surface (then dG/dt = alpha^(K+1) phi^f, which
 * a change of mu_f by alpha^(K+1) compensates).
 *
 * L. Castellani, Ann. Phys. 143 (1982) 357, DOI 10.1016/0003-4916(82)90031-8. */
#include "lift/gauge.h"
#include "core/error.h"
#include "expr/collect.h"
#include "expr/derivative.h"
#include "expr/simplify.h"

/* The generator of a free multiplier, from chi_0, chi_1, ..; none where they do not end. */
static dal_status find_generator(dal__classes *k, dal__chain *c, dal__node H, int multiplier)
{
    const dal__theory *w = c->theory;
    const size_t size = 2 * (size_t)w->pairs;
    const int mu = w->mu + multiplier;
    dal__node chi[DAL__GENERATOR_ORDERS + 1], by_time;
    dal__node *f = dal__pool_nodes(c->pool, w->graph, size);
    dal__node *g = dal__pool_nodes(c->pool, w->graph, size);
    dal__node *change = dal__pool_nodes(c->pool, w->graph, size);
    if (c->pool->out_of_memory) return DAL_STATUS_OK;
    k->free_multipliers++;
    dal__gradient(w->graph, H, &mu, 1, &chi[0]);
    dal__phase_gradient(w, H, g);
    size_t zeros = 0; /* of the gradient of the last */
    int count = 0;
    while (zeros < size) {
        if (++count == DAL__GENERATOR_ORDERS) return DAL_STATUS_OK;
        dal__phase_gradient(w, chi[count - 1], f);
        dal__gradient(w->graph, chi[count - 1], &w->t, 1, &by_time);
        chi[count] = dal__node_add(w->graph, dal__bracket(w, f, g), by_time);
        dal__phase_gradient(w, chi[count], f);
        DAL_TRY(dal__surface_clean(&c->surface, (int)size, f));
        for (zeros = 0; zeros < size && dal__node_is_zero(w->graph, f[zeros]);) zeros++;
    }
    dal__node G = dal__number(w->graph, 0.0);
    for (int i = 0; i < count; i++) {
        dal__node form = dal__collect(w->graph, chi[i]);
        const dal__node alpha = dal__symbol(w->graph, w->alpha + count - 1 - i);
        if (i % 2) form = dal__node_neg(w->graph, form);
        G = dal__node_add(w->graph, G, dal__node_mul(w->graph, alpha, form));
    }
    dal__phase_gradient(w, G, f);
    for (int i = 0; i < w->pairs; i++) {
        change[i] = f[w->pairs + i];
        change[w->pairs + i] = dal__node_neg(w->graph, f[i]);
    }
    k->directions += count;
    k->generator[k->generators++] = (dal__generator){
        .multiplier = multiplier, .derivatives = count - 1, .G = G, .change = change};
    return dal__surface_clean(&c->surface, (int)size, change);
}

dal_status dal__gauge_find(dal__classes *k, dal__chain *c)
{
    const dal__theory *w = c->theory;
    const size_t primaries = (size_t)w->primaries;
    dal__node *symbol = dal__pool_nodes(c->pool, w->graph, primaries);
    k->value = dal__pool_nodes(c->pool, w->graph, primaries);
    k->generator = dal__pool_allocate(c->pool, primaries + 1, sizeof *k->generator);
    if (c->pool->out_of_memory) return DAL_STATUS_OK;
    for (int b = 0; b < w->primaries; b++) symbol[b] = dal__symbol(w->graph, w->mu + b);
    dal__node H = w->H;
    for (int b = 0; b < w->primaries; b++) {
        k->value[b] = dal__reduction_value(&c->conservation, w->graph, b, 0, symbol);
        H = dal__node_add(w->graph, H, dal__node_mul(w->graph, k->value[b], w->primary[b]));
    }
    k->on_surface = H;
    DAL_TRY(dal__surface_clean(&c->surface, 1, &k->on_surface));
    for (int f = 0; f < w->primaries; f++)
        if (c->conservation.row[f] < 0) DAL_TRY(find_generator(k, c, H, f));
    return DAL_STATUS_OK;
}
