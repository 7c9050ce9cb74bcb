/* chain.c - the constraints of Dirac's procedure, stage by stage.
 *
 * In each stage the conservation of every constraint phi_a on the surface,
 *
 *     sum_b mu_b {phi_a, phi_b} + {phi_a, H_0} + d phi_a/dt = 0,     b primary,
 *
 * is brought to echelon form.  A row with a pivot fixes mu_b; the right side of another one must
 * vanish.  Where it does not vanish on the surface it is a further constraint, or a contradiction.
 *
 * P. A. M. Dirac, Can. J. Math. 2 (1950) 129, DOI 10.4153/CJM-1950-012-1. */
#include "lift/chain.h"
#include "core/error.h"
#include "expr/collect.h"
#include "expr/derivative.h"
#include "expr/simplify.h"
#include "expr/traversal.h"
#include "lift/irregular.h"

dal__node dal__bracket(const dal__theory *w, const dal__node *f, const dal__node *g)
{
    const dal__node zero = dal__number(w->graph, 0.0);
    dal__node sum = zero;
    for (int i = 0, N = w->pairs; i < N; i++) {
        if (f[i] != zero && g[N + i] != zero)
            sum = dal__node_add(w->graph, sum, dal__node_mul(w->graph, f[i], g[N + i]));
        if (f[N + i] != zero && g[i] != zero)
            sum = dal__node_sub(w->graph, sum, dal__node_mul(w->graph, f[N + i], g[i]));
    }
    return sum;
}

dal__node dal__bracket_with(const dal__theory *w, const dal__node *f, int variable)
{
    return variable < w->pairs ? dal__node_neg(w->graph, f[w->pairs + variable])
                               : f[variable - w->pairs];
}

void dal__phase_gradient(const dal__theory *w, dal__node f, dal__node *gradient)
{
    dal__gradient(w->graph, f, w->variable, 2 * w->pairs, gradient);
}

/* Adds phi; *ended where it leaves no regular surface. */
static void append_constraint(dal__chain *c, dal__node phi, int source, bool *ended)
{
    const dal__theory *w = c->theory;
    *ended = c->count == c->capacity || dal__theory_is_lost(w, c->pool);
    if (*ended) return;
    dal__chain_constraint *added = &c->constraint[c->count];
    *added = (dal__chain_constraint){.phi = phi, .stage = c->stage, .source = source};
    added->gradient = dal__pool_nodes(c->pool, w->graph, 2 * (size_t)w->pairs);
    if (!added->gradient) return;
    dal__phase_gradient(w, phi, added->gradient);
    dal__node restricted = phi;
    dal__surface_restrict(&c->surface, 1, &restricted);
    dal__surface_add(&c->surface, restricted);
    *ended = c->surface.state != DAL__SURFACE_REGULAR;
    c->count++;
}

/* f without its sign, fixed factors and denominators: what vanishes where f does. */
static dal__node strip_factors(dal__graph *graph, dal__node f)
{
    for (;;) {
        const dal__record r = dal__inspect(graph, f);
        if (r.op == DAL__NEG || r.op == DAL__DIV)
            f = r.a;
        else if (r.op == DAL__MUL && dal__inspect(graph, r.a).fixed)
            f = r.b;
        else if (r.op == DAL__MUL && dal__inspect(graph, r.b).fixed)
            f = r.a;
        else
            return f;
    }
}

/* f without the terms that vanish on the surface. */
static dal_status drop_zeros(const dal__chain *c, dal__node *f)
{
    enum { MAX_TERMS = 128 };
    dal__graph *graph = c->theory->graph;
    dal__node waiting[MAX_TERMS + 2] = {*f}, term[MAX_TERMS];
    int waits = 1, terms = 0;
    bool is_minus[MAX_TERMS + 2] = {false}, sign[MAX_TERMS];
    while (waits > 0) {
        const dal__record r = dal__inspect(graph, waiting[--waits]);
        const bool minus = is_minus[waits], is_sum = r.op == DAL__ADD || r.op == DAL__SUB;
        if (waits + terms + 2 > MAX_TERMS) return DAL_STATUS_OK;
        if (is_sum || r.op == DAL__NEG) {
            is_minus[waits] = minus != (r.op == DAL__NEG);
            waiting[waits++] = r.a;
            is_minus[waits] = minus != (r.op == DAL__SUB);
            if (is_sum) waiting[waits++] = r.b;
        } else {
            sign[terms] = minus;
            term[terms++] = waiting[waits];
        }
    }
    if (terms < 2) return DAL_STATUS_OK;
    dal__node kept = dal__number(graph, 0.0);
    bool has_dropped = false;
    DAL_TRY(dal__surface_clean(&c->surface, terms, term));
    for (int i = 0; i < terms; i++) {
        has_dropped |= dal__node_is_zero(graph, term[i]);
        kept = sign[i] ? dal__node_sub(graph, kept, term[i]) : dal__node_add(graph, kept, term[i]);
    }
    if (has_dropped) *f = kept;
    return DAL_STATUS_OK;
}

/* Adds what the condition f = 0, which the surface does not have, requires. */
static dal_status require(dal__chain *c, dal__node f, int source, dal_dirac_outcome *outcome)
{
    const dal__theory *w = c->theory;
    dal__graph *graph = w->graph;
    int count = 0, i = 0;
    bool ended = false;
    while (i < 2 * w->pairs && !dal__depends(graph, f, w->variable[i], w->variable[i] + 1)) i++;
    if (i == 2 * w->pairs) {
        *outcome = DAL_DIRAC_CONTRADICTS;
        return DAL_STATUS_OK;
    }
    dal__node *regular = dal__pool_nodes(c->pool, graph, 2 * (size_t)c->theory->pairs);
    if (!regular) return DAL_STATUS_OK;
    f = strip_factors(graph, f);
    DAL_TRY(drop_zeros(c, &f));
    dal__regular_functions(&c->surface, f, regular, &count);
    if (count == 0) {
        f = dal__collect(graph, f);
        DAL_TRY(drop_zeros(c, &f));
        dal__regular_functions(&c->surface, f, regular, &count);
    }
    *outcome = count > 0 ? DAL_DIRAC_IRREGULAR : DAL_DIRAC_ADDS;
    if (count == 0) regular[count++] = f;
    for (i = 0; i < count && !ended; i++) {
        DAL_TRY(dal__surface_clean(&c->surface, 1, &regular[i]));
        regular[i] = dal__collect(graph, regular[i]);
        if (!dal__node_is_zero(graph, regular[i]))
            append_constraint(c, strip_factors(graph, regular[i]), source, &ended);
    }
    if (ended) *outcome = DAL_DIRAC_STOPS;
    return DAL_STATUS_OK;
}

/* What row a of the conservation requires. */
static dal_status conclude(dal__chain *c, int a)
{
    const dal__theory *w = c->theory;
    const dal__reduction *r = &c->conservation;
    dal_dirac_step step = {.stage = c->stage, .constraint = a, .multiplier = r->pivot[a]};
    dal__node condition = r->entry[(size_t)a * (size_t)r->width + (size_t)r->columns];
    step.outcome = step.multiplier >= 0 ? DAL_DIRAC_FIXES : DAL_DIRAC_HOLDS;
    step.first = c->count;
    if (step.multiplier >= 0) {
        dal__node *mu = dal__pool_nodes(c->pool, w->graph, (size_t)w->primaries);
        for (int b = 0; mu && b < w->primaries; b++) mu[b] = dal__symbol(w->graph, w->mu + b);
        if (!mu) return DAL_STATUS_OK;
        condition = dal__reduction_value(r, w->graph, step.multiplier, 0, mu);
    } else {
        DAL_TRY(dal__surface_clean(&c->surface, 1, &condition)); /* it has become smaller */
        const dal__node given = condition;
        condition = dal__collect(w->graph, given);
        DAL_TRY(drop_zeros(c, &condition));
        if (!dal__node_is_zero(w->graph, given)) DAL_TRY(require(c, given, a, &step.outcome));
    }
    step.count = c->count - step.first;
    dal__chain_constraint *phi = &c->constraint[a];
    const bool is_new = !phi->is_known || step.outcome != phi->last;
    if (is_new && (!phi->is_known || step.outcome != DAL_DIRAC_HOLDS)) {
        if (c->steps == c->step_capacity) return DAL_STATUS_TOO_LARGE;
        c->condition[c->steps] = condition;
        c->step[c->steps++] = step;
    }
    phi->is_known = true;
    phi->last = step.outcome;
    c->has_ended = step.outcome >= DAL_DIRAC_CONTRADICTS;
    return DAL_STATUS_OK;
}

dal_status dal__chain_run(dal__chain *c, const dal__theory *w, dal__pool *pool)
{
    *c = (dal__chain){.theory = w, .pool = pool, .capacity = 2 * w->pairs + 1};
    /* Of more constraints than variables the last one is not regular, and ends the chain. */
    dal__surface_begin(&c->surface, w, pool);
    c->H_gradient = dal__pool_nodes(pool, w->graph, 2 * (size_t)w->pairs);
    c->constraint = dal__pool_allocate(pool, (size_t)c->capacity, sizeof *c->constraint);
    c->step_capacity = DAL_DIRAC_OUTCOME_COUNT * c->capacity;
    c->step = dal__pool_allocate(pool, (size_t)c->step_capacity, sizeof *c->step);
    c->condition = dal__pool_nodes(pool, w->graph, (size_t)c->step_capacity);
    if (pool->out_of_memory) return DAL_STATUS_OK;
    dal__phase_gradient(w, w->H, c->H_gradient);
    for (int b = 0; b < w->primaries; b++) append_constraint(c, w->primary[b], -1, &c->has_ended);
    while (!c->is_complete && !c->has_ended && !dal__theory_is_lost(w, pool)) {
        const int before = c->count;
        dal__reduction *r = &c->conservation;
        c->stage++;
        dal__reduction_begin(r, &c->surface, before, w->primaries, 1);
        if (dal__theory_is_lost(w, pool)) return DAL_STATUS_OK;
        for (int a = 0; a < before; a++) {
            const dal__chain_constraint *phi = &c->constraint[a];
            dal__node *entry = r->entry + (size_t)a * (size_t)r->width, by_time;
            for (int b = 0; b < w->primaries; b++)
                entry[b] = dal__bracket(w, phi->gradient, c->constraint[b].gradient);
            dal__gradient(w->graph, phi->phi, &w->t, 1, &by_time);
            entry[w->primaries] =
                dal__node_add(w->graph, dal__bracket(w, phi->gradient, c->H_gradient), by_time);
        }
        DAL_TRY(dal__reduction_solve(r, &c->surface));
        for (int a = 0; a < before && !c->has_ended; a++) DAL_TRY(conclude(c, a));
        c->is_complete = !c->has_ended && c->count == before;
    }
    return DAL_STATUS_OK;
}
