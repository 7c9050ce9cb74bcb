/* plan.c - from nodes to the instructions of a program.
 *
 * Nodes are computed in the order of their indices.  One sweep down the indices finds what is used,
 * how often and where for the last time, and which products can be taken into a sum; one sweep up
 * writes the instructions and gives places in work to their results. */
#include "formula/plan.h"
#include <stdlib.h>
#include <string.h>

static bool allocate(dal__plan *plan)
{
    size_t count = (size_t)plan->last_node + 1;
    plan->constant = calloc(count, sizeof *plan->constant);
    plan->reached = calloc(count, sizeof *plan->reached);
    plan->place = malloc(count * sizeof *plan->place);
    plan->host = calloc(count, sizeof *plan->host);
    plan->last = calloc(count, sizeof *plan->last);
    plan->uses = calloc(count, sizeof *plan->uses);
    plan->free = malloc(count * sizeof *plan->free);
    return plan->constant && plan->reached && plan->place && plan->host && plan->last &&
           plan->uses && plan->free;
}

static bool is_constant(const dal__plan *plan, const dal__tapes *tapes, dal__view v)
{
    if (v.op == DAL__NUMBER) return true;
    if (v.op == DAL__SYMBOL) return v.symbol < tapes->parameters;
    return plan->constant[v.a] && (!v.b || plan->constant[v.b]);
}

dal_status dal__plan_create(dal__plan *plan, const dal__tapes *tapes)
{
    *plan = (dal__plan){.graph = tapes->graph, .last_node = dal__graph_count(tapes->graph)};
    if (!allocate(plan)) return DAL_MEMORY;
    for (dal__node i = 1; i <= plan->last_node; i++) {
        plan->constant[i] = is_constant(plan, tapes, dal__look(plan->graph, i));
        plan->place[i] = DAL__NOWHERE;
    }
    for (int p = 0; p < tapes->count; p++) {
        const dal__tape *tape = &tapes->tape[p];
        for (int k = 0; k < tape->outputs; k++) plan->reached[tape->output[k]] = 1;
    }
    if (plan->reached[0]) return DAL_ARGUMENT;
    for (dal__node i = plan->last_node; i > 0; i--) {
        dal__view v = dal__look(plan->graph, i);
        if (plan->reached[i]) plan->reached[v.a] = plan->reached[v.b] = 1;
    }
    return DAL_OK;
}

void dal__plan_free(dal__plan *plan)
{
    free(plan->constant);
    free(plan->reached);
    free(plan->place);
    free(plan->host);
    free(plan->last);
    free(plan->uses);
    free(plan->free);
}

/* ---- instructions ---- */

static dal__instruction plain(const dal__plan *plan, dal__node i, dal__view v)
{
    uint32_t b = v.b ? plan->place[v.b] : 0;
    return (dal__instruction){(uint32_t)v.op, plan->place[i], plan->place[v.a], b, 0};
}

dal_status dal__plan_hoisted(dal__plan *plan, dal__tapes *tapes)
{
    dal__tape *tape = &tapes->hoisted;
    size_t most = tapes->first_input + 1;
    tape->code = malloc(most * sizeof *tape->code);
    if (!tape->code) return DAL_MEMORY;
    for (dal__node i = 1; i <= plan->last_node; i++) {
        dal__view v = dal__look(plan->graph, i);
        if (!plan->reached[i] || !plan->constant[i] || !v.a) continue;
        tape->code[tape->length++] = plain(plan, i, v);
    }
    return DAL_OK;
}

/* Whether a node is computed by the program: neither constant nor an input. */
static bool is_computed(const dal__plan *plan, dal__node i, dal__view v)
{
    return plan->reached[i] && !plan->constant[i] && v.op != DAL__SYMBOL;
}

static dal__node largest_output(const dal__tape *tape)
{
    dal__node largest = 0;
    for (int k = 0; k < tape->outputs; k++) {
        if (tape->output[k] > largest) largest = tape->output[k];
    }
    return largest;
}

/* Fills reached and uses for one program; the number of instructions it needs at most. */
static int count_uses(dal__plan *plan, const dal__tape *tape, dal__node top)
{
    int computed = 0;
    memset(plan->reached, 0, (size_t)top + 1);
    memset(plan->uses, 0, ((size_t)top + 1) * sizeof *plan->uses);
    memset(plan->last, 0, ((size_t)top + 1) * sizeof *plan->last);
    memset(plan->host, 0, ((size_t)top + 1) * sizeof *plan->host);
    for (int k = 0; k < tape->outputs; k++) {
        dal__node f = tape->output[k];
        plan->reached[f] = 1;
        plan->last[f] = top + 1;
        plan->uses[f]++;
    }
    for (dal__node i = top; i > 0; i--) {
        dal__view v = dal__look(plan->graph, i);
        if (!is_computed(plan, i, v)) continue;
        computed++;
        plan->reached[v.a] = plan->reached[v.b] = 1;
        plan->uses[v.a]++;
        plan->uses[v.b]++;
    }
    return computed;
}

static bool can_join(const dal__plan *plan, dal__node x)
{
    return x && plan->uses[x] == 1 && !plan->constant[x] &&
           dal__look(plan->graph, x).op == DAL__MUL;
}

/* Fills host and last. */
static void find_lives(dal__plan *plan, dal__node top)
{
    for (dal__node i = top; i > 0; i--) {
        dal__view v = dal__look(plan->graph, i);
        if (!is_computed(plan, i, v)) continue;
        if (v.op == DAL__ADD || v.op == DAL__SUB) {
            if (can_join(plan, v.a)) {
                plan->host[v.a] = i;
            } else if (can_join(plan, v.b)) {
                plan->host[v.b] = i;
            }
        }
        dal__node at = plan->host[i] ? plan->host[i] : i;
        if (plan->last[v.a] < at) plan->last[v.a] = at;
        if (plan->last[v.b] < at) plan->last[v.b] = at;
    }
}

/* Gives back the place of a temporary that node i reads last. */
static void release(dal__plan *plan, const dal__tapes *tapes, dal__node x, dal__node i)
{
    uint32_t place = plan->place[x];
    if (!x || plan->last[x] != i || place == DAL__NOWHERE || place < tapes->temporaries) return;
    plan->free[plan->frees++] = place;
    plan->last[x] = 0;
}

static uint32_t take(dal__plan *plan, dal__tapes *tapes)
{
    if (plan->frees > 0) return plan->free[--plan->frees];
    size_t place = tapes->temporaries + plan->used++;
    if (place >= tapes->workspace) tapes->workspace = place + 1;
    return (uint32_t)place;
}

/* The sum or difference i of a product that was taken into it and something else. */
static dal__instruction joined(const dal__plan *plan, dal__node i, dal__view v)
{
    bool first = plan->host[v.a] == i;
    dal__view product = dal__look(plan->graph, first ? v.a : v.b);
    uint32_t op = v.op == DAL__ADD ? DAL__MUL_ADD : first ? DAL__MUL_SUB : DAL__SUB_MUL;
    return (dal__instruction){op, 0, plan->place[product.a], plan->place[product.b],
                              plan->place[first ? v.b : v.a]};
}

/* sin or cos of the same argument as v, when the program wants both; else 0. */
static dal__node partner(const dal__plan *plan, dal__view v, dal__node top)
{
    dal__op other = v.op == DAL__SIN ? DAL__COS : DAL__SIN;
    if (v.op != DAL__SIN && v.op != DAL__COS) return 0;
    dal__node x = dal__find(plan->graph, other, v.a, 0);
    return x && x <= top && plan->reached[x] ? x : 0;
}

static void emit(dal__plan *plan, dal__tapes *tapes, dal__tape *tape, dal__node i, dal__node top)
{
    dal__view v = dal__look(plan->graph, i);
    dal__node pair = partner(plan, v, top);
    bool join = plan->host[v.a] == i || (v.b && plan->host[v.b] == i);
    dal__instruction code = join ? joined(plan, i, v) : plain(plan, i, v);
    if (join) {
        dal__view product = dal__look(plan->graph, plan->host[v.a] == i ? v.a : v.b);
        release(plan, tapes, product.a, i);
        release(plan, tapes, product.b, i);
    }
    release(plan, tapes, v.a, i);
    release(plan, tapes, v.b, i);
    code.d = plan->place[i] = take(plan, tapes);
    if (pair) {
        plan->place[pair] = take(plan, tapes);
        code.op = DAL__SINCOS;
        code.d = plan->place[v.op == DAL__SIN ? i : pair];
        code.b = plan->place[v.op == DAL__SIN ? pair : i];
    }
    tape->code[tape->length++] = code;
}

dal_status dal__plan_tape(dal__plan *plan, dal__tapes *tapes, dal__tape *tape)
{
    dal__node top = largest_output(tape);
    size_t most = (size_t)count_uses(plan, tape, top) + 1;
    tape->code = malloc(most * sizeof *tape->code);
    if (!tape->code) return DAL_MEMORY;
    find_lives(plan, top);
    plan->frees = plan->used = 0;
    for (dal__node i = 1; i <= top; i++) {
        dal__view v = dal__look(plan->graph, i);
        if (!is_computed(plan, i, v) || plan->host[i]) continue;
        if (plan->place[i] == DAL__NOWHERE) {
            emit(plan, tapes, tape, i, top);
        } else { /* came with its partner, but others may have read the argument since */
            release(plan, tapes, v.a, i);
        }
    }
    for (int k = 0; k < tape->outputs; k++) tape->place[k] = plan->place[tape->output[k]];
    for (dal__node i = 1; i <= top; i++) {
        if (plan->place[i] >= tapes->temporaries) plan->place[i] = DAL__NOWHERE;
    }
    return DAL_OK;
}
