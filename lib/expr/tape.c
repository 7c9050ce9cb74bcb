/* tape.c - the programs of one system, and the layout of their block of numbers.
 *
 * Nodes are computed in the order of their indices.  One sweep down the indices finds what is used
 * and where for the last time; one sweep up writes the instructions and assigns places in work
 * to their results. */
#include "expr/tape.h"
#include "core/error.h"
#include "expr/traversal.h"
#include <stdlib.h>
#include <string.h>

dal__tapes *dal__tapes_create(const dal__graph *graph, int parameters, int inputs)
{
    dal__tapes *tapes = calloc(1, sizeof *tapes);
    if (!tapes) return NULL;
    tapes->graph = graph;
    tapes->tables = graph->tables;
    tapes->table_count = graph->table_count;
    tapes->parameters = parameters;
    tapes->inputs = inputs;
    return tapes;
}

static void tape_free(dal__tape *tape)
{
    free(tape->output);
    free(tape->place);
    free(tape->code);
    free(tape->held);
}

void dal__tapes_free(dal__tapes *tapes)
{
    if (!tapes) return;
    for (int i = 0; i < tapes->count; i++) tape_free(&tapes->tape[i]);
    tape_free(&tapes->hoisted);
    free(tapes->tape);
    free(tapes->number);
    free(tapes);
}

int dal__tapes_add(dal__tapes *tapes, const dal__node *outputs, int count)
{
    if (tapes->count == tapes->capacity) {
        const int capacity = tapes->capacity ? 2 * tapes->capacity : 16;
        dal__tape *more = realloc(tapes->tape, (size_t)capacity * sizeof *more);
        if (!more) return -1;
        tapes->tape = more;
        tapes->capacity = capacity;
    }
    dal__tape tape = {.outputs = count};
    size_t size = count > 0 ? (size_t)count : 1;
    tape.output = calloc(size, sizeof *tape.output);
    tape.place = calloc(size, sizeof *tape.place);
    if (!tape.output || !tape.place) return tape_free(&tape), -1;
    if (count > 0) memcpy(tape.output, outputs, size * sizeof *outputs);
    tapes->tape[tapes->count] = tape;
    return tapes->count++;
}

void dal__tapes_let_hold(dal__tapes *tapes, int i) { tapes->tape[i].may_hold = true; }

/* ---- a schedule ---- */

#define NOWHERE UINT32_MAX

/* What is known of a node; of node 0 nothing. */
typedef struct node_use {
    uint32_t place;  /* in work; NOWHERE while a temporary is not alive */
    dal__node last;  /* the node whose instruction reads this one last */
    uint32_t vacant; /* number k of a stack of places that temporaries have freed */
    bool constant;   /* depends on parameters alone */
    bool reached;    /* needed by any program; then, by the present one */
} node_use;

typedef struct schedule {
    const dal__graph *graph;
    dal__node last_node;
    node_use *use;          /* [last_node + 1] */
    size_t vacancies, used; /* temporaries: on that stack, and taken in all */
} schedule;

/* Starts from the outputs of all programs. [alloc] */
static dal_status begin_schedule(schedule *s, const dal__tapes *tapes)
{
    *s = (schedule){.graph = tapes->graph, .last_node = tapes->graph->count};
    node_use *use = s->use = calloc((size_t)s->last_node + 1, sizeof *use);
    if (!use) return DAL_STATUS_MEMORY;
    for (dal__node i = 1; i <= s->last_node; i++) {
        const dal__record r = dal__inspect(s->graph, i);
        const bool operands =
            use[r.a].constant && (!r.b || use[r.b].constant) && (!r.c || use[r.c].constant);
        use[i].constant = r.op == DAL__NUMBER   ? true
                          : r.op == DAL__SYMBOL ? r.symbol < tapes->parameters
                                                : operands;
        use[i].place = NOWHERE;
    }
    for (int p = 0; p < tapes->count; p++) {
        const dal__tape *tape = &tapes->tape[p];
        for (int k = 0; k < tape->outputs; k++) use[tape->output[k]].reached = true;
    }
    if (use[0].reached) return DAL_STATUS_ARGUMENT;
    for (dal__node i = s->last_node; i > 0; i--) {
        const dal__record r = dal__inspect(s->graph, i);
        if (use[i].reached) use[r.a].reached = use[r.b].reached = use[r.c].reached = true;
    }
    return DAL_STATUS_OK;
}

/* ---- instructions ---- */

static dal__instruction instruction(const schedule *s, dal__node i, dal__lowered l)
{
    const dal__record r = dal__inspect(s->graph, i);
    const uint32_t b = r.op == DAL__TABLE ? (uint32_t)r.symbol : s->use[l.b].place;
    return (dal__instruction){(uint32_t)l.op, s->use[i].place, s->use[l.a].place, b,
                              s->use[l.c].place};
}

/* The program of what is constant along a run, whose places are set. */
static dal_status schedule_hoisted(schedule *s, dal__tapes *tapes)
{
    dal__tape *tape = &tapes->hoisted;
    tape->code = malloc((tapes->first_input + 1) * sizeof *tape->code);
    if (!tape->code) return DAL_STATUS_MEMORY;
    for (dal__node i = 1; i <= s->last_node; i++) {
        dal__lowered l = dal__lower(s->graph, i);
        if (!s->use[i].reached || !s->use[i].constant || !l.a) continue;
        tape->code[tape->length++] = instruction(s, i, l);
    }
    return DAL_STATUS_OK;
}

/* Whether a node is computed by the program: neither constant nor an input. */
static bool is_computed(const schedule *s, dal__node i)
{
    return s->use[i].reached && !s->use[i].constant && dal__inspect(s->graph, i).op != DAL__SYMBOL;
}

/* Fills reached and last for one program; returns how many instructions it needs at most. */
static int find_lives(schedule *s, const dal__tape *tape, dal__node top)
{
    int computed = 0;
    for (dal__node i = 0; i <= top; i++) s->use[i].reached = false, s->use[i].last = 0;
    for (int k = 0; k < tape->outputs; k++) {
        s->use[tape->output[k]].reached = true;
        s->use[tape->output[k]].last = top + 1;
    }
    for (dal__node i = top; i > 0; i--) {
        if (!is_computed(s, i)) continue;
        computed++;
        const dal__lowered l = dal__lower(s->graph, i);
        const dal__node operand[] = {l.a, l.b, l.c};
        for (int k = 0; k < 3; k++) {
            s->use[operand[k]].reached = true;
            if (!s->use[operand[k]].last) s->use[operand[k]].last = i;
        }
    }
    return computed;
}

/* Instruction i of node `node`, which decides at its point. */
static dal__instruction held_instruction(const dal__tapes *tapes, dal__node node,
                                         dal__instruction i)
{
    enum { P, SIGN, MINUS_SIGN, BELOW, ABOVE };
    const dal__held_point point = tapes->point[node];
    if (point == 0) return i;
    const uint32_t number = (uint32_t)abs(point) - 1;
    const uint32_t p = (uint32_t)tapes->held + 1 + DAL__HELD_NUMBERS * number;
    const uint32_t sign = p + (point > 0 ? SIGN : MINUS_SIGN);
    const uint32_t below = p + (point > 0 ? BELOW : ABOVE);
    switch (i.op) {
    case DAL__ABS:
        return (dal__instruction){DAL__MUL, i.d, i.a, sign, 0};
    case DAL__SIGN:
        return (dal__instruction){DAL__MIN, i.d, sign, sign, 0};
    case DAL__FLOOR:
        return (dal__instruction){DAL__FLOOR, i.d, p, 0, 0};
    case DAL__MIN:
        return (dal__instruction){DAL__IF, i.d, below, i.a, i.b};
    case DAL__MAX:
        return (dal__instruction){DAL__IF, i.d, below, i.b, i.a};
    case DAL__TABLE:
        return (dal__instruction){DAL__PIECE, i.d, i.a, i.b, p};
    default: /* < and <=: they differ where no motion stays */
        return (dal__instruction){DAL__MIN, i.d, below, below, 0};
    }
}

/* Frees the place of a temporary that node i reads last. */
static void release(schedule *s, const dal__tapes *tapes, dal__node x, dal__node i)
{
    uint32_t place = s->use[x].place;
    if (!x || s->use[x].last != i || place == NOWHERE || place < tapes->temporaries) return;
    s->use[s->vacancies++].vacant = place;
    s->use[x].last = 0;
}

static uint32_t allocate_place(schedule *s, dal__tapes *tapes)
{
    if (s->vacancies > 0) return s->use[--s->vacancies].vacant;
    size_t place = tapes->temporaries + s->used++;
    if (place >= tapes->workspace) tapes->workspace = place + 1;
    return (uint32_t)place;
}

static void emit(schedule *s, dal__tapes *tapes, dal__tape *tape, dal__node i, dal__node top)
{
    dal__lowered l = dal__lower(s->graph, i);
    /* sin or cos of the same argument, when the program wants both; else 0 */
    dal__node pair = 0;
    if (l.op == DAL__SIN) pair = dal__find(s->graph, DAL__COS, l.a, 0);
    if (l.op == DAL__COS) pair = dal__find(s->graph, DAL__SIN, l.a, 0);
    if (pair > top || !s->use[pair].reached) pair = 0;
    dal__instruction code = instruction(s, i, l);
    release(s, tapes, l.a, i);
    release(s, tapes, l.b, i);
    release(s, tapes, l.c, i);
    code.d = s->use[i].place = allocate_place(s, tapes);
    if (pair) {
        s->use[pair].place = allocate_place(s, tapes);
        code.op = DAL__SINCOS;
        code.d = s->use[l.op == DAL__SIN ? i : pair].place;
        code.b = s->use[l.op == DAL__SIN ? pair : i].place;
    }
    if (tape->held) tape->held[tape->length] = held_instruction(tapes, i, code);
    tape->code[tape->length++] = code;
}

/* Schedules one program: temporaries occupy places until their last use; the workspace grows to
 * hold them. */
static dal_status schedule_tape(schedule *s, dal__tapes *tapes, dal__tape *tape)
{
    const dal__node top = dal__last_of(tape->output, tape->outputs);
    const size_t computed = (size_t)find_lives(s, tape, top) + 1;
    const bool may_hold = tape->may_hold && tapes->points > 0;
    tape->code = malloc(computed * sizeof *tape->code);
    tape->held = may_hold ? malloc(computed * sizeof *tape->held) : NULL;
    if (!tape->code || (may_hold && !tape->held)) return DAL_STATUS_MEMORY;
    s->vacancies = s->used = 0;
    for (dal__node i = 1; i <= top; i++) {
        if (!is_computed(s, i)) continue;
        if (s->use[i].place == NOWHERE)
            emit(s, tapes, tape, i, top);
        else /* came with its partner, but others may have read the argument since */
            release(s, tapes, dal__lower(s->graph, i).a, i);
    }
    for (int k = 0; k < tape->outputs; k++) tape->place[k] = s->use[tape->output[k]].place;
    for (dal__node i = 1; i <= top; i++)
        if (s->use[i].place >= tapes->temporaries) s->use[i].place = NOWHERE;
    return DAL_STATUS_OK;
}

/* ---- the layout ---- */

/* Assigns places to everything that is constant along a run, and to the inputs. */
static dal_status lay_out(dal__tapes *tapes, schedule *s)
{
    uint32_t place = (uint32_t)tapes->parameters;
    for (int pass = 0; pass < 2; pass++) { /* numbers, then what is hoisted */
        for (dal__node i = 1; i <= s->last_node; i++) {
            dal__record r = dal__inspect(tapes->graph, i);
            bool wanted = s->use[i].constant && s->use[i].reached && r.op != DAL__SYMBOL;
            if (!wanted || (r.op == DAL__NUMBER) != (pass == 0)) continue;
            if (pass == 0) tapes->number[tapes->numbers++] = r.value;
            s->use[i].place = place++;
        }
    }
    tapes->first_input = place;
    tapes->held = place + (size_t)tapes->inputs;
    tapes->temporaries =
        tapes->held + (tapes->points > 0 ? 1 + DAL__HELD_NUMBERS * (size_t)tapes->points : 0);
    for (dal__node i = 1; i <= s->last_node; i++) {
        dal__record r = dal__inspect(tapes->graph, i);
        if (r.op != DAL__SYMBOL || !s->use[i].reached) continue;
        if (r.symbol >= tapes->parameters + tapes->inputs) return DAL_STATUS_ARGUMENT;
        s->use[i].place = r.symbol < tapes->parameters
                              ? (uint32_t)r.symbol
                              : place + (uint32_t)(r.symbol - tapes->parameters);
    }
    return DAL_STATUS_OK;
}

static dal_status compile_all(dal__tapes *tapes, schedule *s)
{
    size_t numbers = 0;
    for (dal__node i = 1; i <= s->last_node; i++)
        numbers += dal__inspect(tapes->graph, i).op == DAL__NUMBER && s->use[i].reached;
    tapes->number = malloc((numbers + 1) * sizeof *tapes->number);
    if (!tapes->number) return DAL_STATUS_MEMORY;
    DAL_TRY(lay_out(tapes, s));
    tapes->workspace = tapes->temporaries;
    DAL_TRY(schedule_hoisted(s, tapes));
    for (int i = 0; i < tapes->count; i++) DAL_TRY(schedule_tape(s, tapes, &tapes->tape[i]));
    return DAL_STATUS_OK;
}

dal_status dal__tapes_finish(dal__tapes *tapes)
{
    DAL_TRY(tapes->graph->status);
    schedule s;
    dal_status status = begin_schedule(&s, tapes);
    if (status == DAL_STATUS_OK) status = compile_all(tapes, &s);
    free(s.use);
    return status;
}

int dal__tape_operations(const dal__tape *tape)
{
    enum { FUNCTION = 10 }; /* operations of an elementary function, about */
    int operations = tape->length;
    for (int i = 0; i < tape->length; i++) {
        const uint32_t op = tape->code[i].op;
        const bool function = op >= DAL__EXP && op <= DAL__ASINH;
        if (function || op == DAL__POW || op == DAL__SINCOS) operations += FUNCTION - 1;
    }
    return operations;
}
