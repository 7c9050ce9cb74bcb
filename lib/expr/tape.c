/* tape.c - the programs of one system, and the layout of their block of numbers. */
#include "expr/schedule.h"
#include <stdlib.h>
#include <string.h>

dal__tapes *dal__tapes_create(const dal__graph *graph, int parameters, int inputs)
{
    dal__tapes *tapes = calloc(1, sizeof *tapes);
    if (!tapes) return NULL;
    tapes->graph = graph;
    tapes->parameters = parameters;
    tapes->inputs = inputs;
    return tapes;
}

static void tape_free(dal__tape *tape)
{
    free(tape->output);
    free(tape->place);
    free(tape->code);
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

/* Assigns places to everything that is constant along a run, and to the inputs. */
static dal_status lay_out(dal__tapes *tapes, dal__schedule *s)
{
    uint32_t place = (uint32_t)tapes->parameters;
    for (int pass = 0; pass < 2; pass++) { /* numbers, then what is hoisted */
        for (dal__node i = 1; i <= s->last_node; i++) {
            dal__record r = dal__inspect(tapes->graph, i);
            bool wanted = s->constant[i] && s->reached[i] && r.op != DAL__SYMBOL;
            if (!wanted || (r.op == DAL__NUMBER) != (pass == 0)) continue;
            if (pass == 0) tapes->number[tapes->numbers++] = r.value;
            s->place[i] = place++;
        }
    }
    tapes->first_input = place;
    tapes->temporaries = place + (size_t)tapes->inputs;
    for (dal__node i = 1; i <= s->last_node; i++) {
        dal__record r = dal__inspect(tapes->graph, i);
        if (r.op != DAL__SYMBOL || !s->reached[i]) continue;
        if (r.symbol >= tapes->parameters + tapes->inputs) return DAL_ARGUMENT;
        s->place[i] = r.symbol < tapes->parameters
                          ? (uint32_t)r.symbol
                          : place + (uint32_t)(r.symbol - tapes->parameters);
    }
    return DAL_OK;
}

static dal_status compile_all(dal__tapes *tapes, dal__schedule *s)
{
    size_t numbers = 0;
    for (dal__node i = 1; i <= s->last_node; i++)
        numbers += dal__inspect(tapes->graph, i).op == DAL__NUMBER && s->reached[i];
    tapes->number = malloc((numbers + 1) * sizeof *tapes->number);
    if (!tapes->number) return DAL_MEMORY;
    DAL_TRY(lay_out(tapes, s));
    tapes->workspace = tapes->temporaries;
    DAL_TRY(dal__schedule_hoisted(s, tapes));
    for (int i = 0; i < tapes->count; i++) DAL_TRY(dal__schedule_tape(s, tapes, &tapes->tape[i]));
    return DAL_OK;
}

dal_status dal__tapes_finish(dal__tapes *tapes)
{
    DAL_TRY(tapes->graph->status);
    dal__schedule s;
    dal_status status = dal__schedule_create(&s, tapes);
    if (status == DAL_OK) status = compile_all(tapes, &s);
    dal__schedule_free(&s);
    return status;
}
