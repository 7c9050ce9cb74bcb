/* schedule.c - from nodes to the instructions of a program.
 *
 * Nodes are computed in the order of their indices.  One sweep down the indices finds what is used
 * and where for the last time; one sweep up writes the instructions and assigns places in work
 * to their results. */
#include "expr/schedule.h"
#include "expr/traversal.h"
#include <stdlib.h>
#include <string.h>

dal_status dal__schedule_create(dal__schedule *s, const dal__tapes *tapes)
{
    *s = (dal__schedule){.graph = tapes->graph, .last_node = tapes->graph->count};
    const size_t count = (size_t)s->last_node + 1;
    s->constant = calloc(count, sizeof *s->constant);
    s->reached = calloc(count, sizeof *s->reached);
    s->place = malloc(count * sizeof *s->place);
    s->last = calloc(count, sizeof *s->last);
    s->free = malloc(count * sizeof *s->free);
    if (!s->constant || !s->reached || !s->place || !s->last || !s->free) return DAL_MEMORY;
    for (dal__node i = 1; i <= s->last_node; i++) {
        const dal__record r = dal__inspect(s->graph, i);
        const bool operands = s->constant[r.a] && (!r.b || s->constant[r.b]);
        s->constant[i] = r.op == DAL__NUMBER   ? true
                         : r.op == DAL__SYMBOL ? r.symbol < tapes->parameters
                                               : operands;
        s->place[i] = DAL__NOWHERE;
    }
    for (int p = 0; p < tapes->count; p++) {
        const dal__tape *tape = &tapes->tape[p];
        for (int k = 0; k < tape->outputs; k++) s->reached[tape->output[k]] = 1;
    }
    if (s->reached[0]) return DAL_ARGUMENT;
    for (dal__node i = s->last_node; i > 0; i--) {
        const dal__record r = dal__inspect(s->graph, i);
        if (s->reached[i]) s->reached[r.a] = s->reached[r.b] = 1;
    }
    return DAL_OK;
}

void dal__schedule_free(dal__schedule *s)
{
    free(s->constant);
    free(s->reached);
    free(s->place);
    free(s->last);
    free(s->free);
}

/* ---- instructions ---- */

static uint32_t place_of(const dal__schedule *s, dal__node x) { return x ? s->place[x] : 0; }

static dal__instruction instruction(const dal__schedule *s, dal__node i, dal__lowered l)
{
    return (dal__instruction){(uint32_t)l.op, s->place[i], place_of(s, l.a), place_of(s, l.b),
                              place_of(s, l.c)};
}

dal_status dal__schedule_hoisted(dal__schedule *s, dal__tapes *tapes)
{
    dal__tape *tape = &tapes->hoisted;
    tape->code = malloc((tapes->first_input + 1) * sizeof *tape->code);
    if (!tape->code) return DAL_MEMORY;
    for (dal__node i = 1; i <= s->last_node; i++) {
        dal__lowered l = dal__lower(s->graph, i);
        if (!s->reached[i] || !s->constant[i] || !l.a) continue;
        tape->code[tape->length++] = instruction(s, i, l);
    }
    return DAL_OK;
}

/* Whether a node is computed by the program: neither constant nor an input. */
static bool is_computed(const dal__schedule *s, dal__node i)
{
    return s->reached[i] && !s->constant[i] && dal__inspect(s->graph, i).op != DAL__SYMBOL;
}

/* Fills reached and last for one program; returns how many instructions it needs at most. */
static int find_lives(dal__schedule *s, const dal__tape *tape, dal__node top)
{
    int computed = 0;
    memset(s->reached, 0, (size_t)top + 1);
    memset(s->last, 0, ((size_t)top + 1) * sizeof *s->last);
    for (int k = 0; k < tape->outputs; k++) {
        s->reached[tape->output[k]] = 1;
        s->last[tape->output[k]] = top + 1;
    }
    for (dal__node i = top; i > 0; i--) {
        if (!is_computed(s, i)) continue;
        computed++;
        const dal__lowered l = dal__lower(s->graph, i);
        const dal__node operand[] = {l.a, l.b, l.c};
        for (int k = 0; k < 3; k++) {
            s->reached[operand[k]] = 1;
            if (!s->last[operand[k]]) s->last[operand[k]] = i;
        }
    }
    return computed;
}

/* Frees the place of a temporary that node i reads last. */
static void release(dal__schedule *s, const dal__tapes *tapes, dal__node x, dal__node i)
{
    uint32_t place = s->place[x];
    if (!x || s->last[x] != i || place == DAL__NOWHERE || place < tapes->temporaries) return;
    s->free[s->frees++] = place;
    s->last[x] = 0;
}

static uint32_t allocate_place(dal__schedule *s, dal__tapes *tapes)
{
    if (s->frees > 0) return s->free[--s->frees];
    size_t place = tapes->temporaries + s->used++;
    if (place >= tapes->workspace) tapes->workspace = place + 1;
    return (uint32_t)place;
}

static void emit(dal__schedule *s, dal__tapes *tapes, dal__tape *tape, dal__node i, dal__node top)
{
    dal__lowered l = dal__lower(s->graph, i);
    /* sin or cos of the same argument, when the program wants both; else 0 */
    dal__node pair = 0;
    if (l.op == DAL__SIN) pair = dal__find(s->graph, DAL__COS, l.a, 0);
    if (l.op == DAL__COS) pair = dal__find(s->graph, DAL__SIN, l.a, 0);
    if (pair > top || !s->reached[pair]) pair = 0;
    dal__instruction code = instruction(s, i, l);
    release(s, tapes, l.a, i);
    release(s, tapes, l.b, i);
    release(s, tapes, l.c, i);
    code.d = s->place[i] = allocate_place(s, tapes);
    if (pair) {
        s->place[pair] = allocate_place(s, tapes);
        code.op = DAL__SINCOS;
        code.d = s->place[l.op == DAL__SIN ? i : pair];
        code.b = s->place[l.op == DAL__SIN ? pair : i];
    }
    tape->code[tape->length++] = code;
}

dal_status dal__schedule_tape(dal__schedule *s, dal__tapes *tapes, dal__tape *tape)
{
    dal__node top = 0;
    for (int k = 0; k < tape->outputs; k++)
        if (tape->output[k] > top) top = tape->output[k];
    tape->code = malloc(((size_t)find_lives(s, tape, top) + 1) * sizeof *tape->code);
    if (!tape->code) return DAL_MEMORY;
    s->frees = s->used = 0;
    for (dal__node i = 1; i <= top; i++) {
        if (!is_computed(s, i)) continue;
        if (s->place[i] == DAL__NOWHERE)
            emit(s, tapes, tape, i, top);
        else /* came with its partner, but others may have read the argument since */
            release(s, tapes, dal__lower(s->graph, i).a, i);
    }
    for (int k = 0; k < tape->outputs; k++) tape->place[k] = s->place[tape->output[k]];
    for (dal__node i = 1; i <= top; i++)
        if (s->place[i] >= tapes->temporaries) s->place[i] = DAL__NOWHERE;
    return DAL_OK;
}
