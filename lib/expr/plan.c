/* plan.c - from nodes to the instructions of a program.
 *
 * Nodes are computed in the order of their indices.  One sweep down the indices finds what is used
 * and where for the last time; one sweep up writes the instructions and gives places in work to
 * their results. */
#include "expr/plan.h"
#include <stdlib.h>
#include <string.h>

static bool allocate(dal__plan *plan)
{
    size_t count = (size_t)plan->last_node + 1;
    plan->constant = calloc(count, sizeof *plan->constant);
    plan->reached = calloc(count, sizeof *plan->reached);
    plan->place = malloc(count * sizeof *plan->place);
    plan->last = calloc(count, sizeof *plan->last);
    plan->free = malloc(count * sizeof *plan->free);
    return plan->constant && plan->reached && plan->place && plan->last && plan->free;
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
    free(plan->last);
    free(plan->free);
}

/* ---- instructions ---- */

static uint32_t place_of(const dal__plan *plan, dal__node x) { return x ? plan->place[x] : 0; }

static dal__instruction instruction(const dal__plan *plan, dal__node i, dal__lowered l)
{
    return (dal__instruction){(uint32_t)l.op, plan->place[i], place_of(plan, l.a),
                              place_of(plan, l.b), place_of(plan, l.c)};
}

dal_status dal__plan_hoisted(dal__plan *plan, dal__tapes *tapes)
{
    dal__tape *tape = &tapes->hoisted;
    size_t most = tapes->first_input + 1;
    tape->code = malloc(most * sizeof *tape->code);
    if (!tape->code) return DAL_MEMORY;
    for (dal__node i = 1; i <= plan->last_node; i++) {
        dal__lowered l = dal__lower(plan->graph, i);
        if (!plan->reached[i] || !plan->constant[i] || !l.a) continue;
        tape->code[tape->length++] = instruction(plan, i, l);
    }
    return DAL_OK;
}

/* Whether a node is computed by the program: neither constant nor an input. */
static bool is_computed(const dal__plan *plan, dal__node i)
{
    return plan->reached[i] && !plan->constant[i] && dal__look(plan->graph, i).op != DAL__SYMBOL;
}

static dal__node largest_output(const dal__tape *tape)
{
    dal__node largest = 0;
    for (int k = 0; k < tape->outputs; k++) {
        if (tape->output[k] > largest) largest = tape->output[k];
    }
    return largest;
}

/* Fills reached and last for one program; the number of instructions it needs at most. */
static int find_lives(dal__plan *plan, const dal__tape *tape, dal__node top)
{
    int computed = 0;
    memset(plan->reached, 0, (size_t)top + 1);
    memset(plan->last, 0, ((size_t)top + 1) * sizeof *plan->last);
    for (int k = 0; k < tape->outputs; k++) {
        plan->reached[tape->output[k]] = 1;
        plan->last[tape->output[k]] = top + 1;
    }
    for (dal__node i = top; i > 0; i--) {
        if (!is_computed(plan, i)) continue;
        computed++;
        const dal__lowered l = dal__lower(plan->graph, i);
        const dal__node operand[] = {l.a, l.b, l.c};
        for (int k = 0; k < 3; k++) {
            plan->reached[operand[k]] = 1;
            if (!plan->last[operand[k]]) plan->last[operand[k]] = i;
        }
    }
    return computed;
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

/* sin or cos of the same argument as l, when the program wants both; else 0. */
static dal__node partner(const dal__plan *plan, dal__lowered l, dal__node top)
{
    dal__op other = l.op == DAL__SIN ? DAL__COS : DAL__SIN;
    if (l.op != DAL__SIN && l.op != DAL__COS) return 0;
    dal__node x = dal__find(plan->graph, other, l.a, 0);
    return x && x <= top && plan->reached[x] ? x : 0;
}

static void emit(dal__plan *plan, dal__tapes *tapes, dal__tape *tape, dal__node i, dal__node top)
{
    dal__lowered l = dal__lower(plan->graph, i);
    dal__node pair = partner(plan, l, top);
    dal__instruction code = instruction(plan, i, l);
    release(plan, tapes, l.a, i);
    release(plan, tapes, l.b, i);
    release(plan, tapes, l.c, i);
    code.d = plan->place[i] = take(plan, tapes);
    if (pair) {
        plan->place[pair] = take(plan, tapes);
        code.op = DAL__SINCOS;
        code.d = plan->place[l.op == DAL__SIN ? i : pair];
        code.b = plan->place[l.op == DAL__SIN ? pair : i];
    }
    tape->code[tape->length++] = code;
}

dal_status dal__plan_tape(dal__plan *plan, dal__tapes *tapes, dal__tape *tape)
{
    dal__node top = largest_output(tape);
    size_t most = (size_t)find_lives(plan, tape, top) + 1;
    tape->code = malloc(most * sizeof *tape->code);
    if (!tape->code) return DAL_MEMORY;
    plan->frees = plan->used = 0;
    for (dal__node i = 1; i <= top; i++) {
        if (!is_computed(plan, i)) continue;
        if (plan->place[i] == DAL__NOWHERE) {
            emit(plan, tapes, tape, i, top);
        } else { /* came with its partner, but others may have read the argument since */
            release(plan, tapes, dal__lower(plan->graph, i).a, i);
        }
    }
    for (int k = 0; k < tape->outputs; k++) tape->place[k] = plan->place[tape->output[k]];
    for (dal__node i = 1; i <= top; i++) {
        if (plan->place[i] >= tapes->temporaries) plan->place[i] = DAL__NOWHERE;
    }
    return DAL_OK;
}
