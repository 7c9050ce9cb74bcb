/* emit.c - programs as straight-line C over num: the arithmetic of the tape, written out.
 *
 * Every result is a constant x1, x2, ... of its own; parameters and hoisted nodes are
 * DAL_WORK(place), with their places in work. */
#include "expr/emit.h"
#include "expr/arithmetic.h"
#include "expr/table.h"
#include "expr/traversal.h"
#include <stdlib.h>
#include <string.h>

typedef struct writer {
    const dal__tapes *tapes;
    const dal__input_name *input;
    uint32_t *result; /* [workspace] the number of the result that a place holds */
    uint32_t results;
    dal__buffer *text;
} writer;

static const char *const expressions[] = {
#define EXPRESSION(code, expression) [DAL__##code] = #expression,
    DAL__UNARY_LIST(EXPRESSION) DAL__BINARY_LIST(EXPRESSION) DAL__TERNARY_LIST(EXPRESSION)
#undef EXPRESSION
};

static bool is_number(const dal__tapes *tapes, uint32_t place)
{
    return place >= (uint32_t)tapes->parameters &&
           place < (uint32_t)(tapes->parameters + tapes->numbers);
}

/* bare: a number may stay a double. */
static void write_operand(const writer *w, uint32_t place, bool bare)
{
    const dal__tapes *tapes = w->tapes;
    if (is_number(tapes, place)) {
        if (!bare) dal__buffer_append(w->text, "dal_num(");
        dal__buffer_number(w->text, tapes->number[place - (uint32_t)tapes->parameters]);
        if (!bare) dal__buffer_append(w->text, ")");
    } else if (place < tapes->first_input) {
        dal__buffer_print(w->text, "DAL_WORK(%u)", place);
    } else if (place < tapes->temporaries) {
        dal__buffer_append(w->text, w->input[place - tapes->first_input].text);
    } else {
        dal__buffer_print(w->text, "x%u", w->result[place]);
    }
}

static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || c == '_'; }

/* The expression of an operation with its operands in the places of the lone letters a, b, c. */
static void write_expression(const writer *w, const dal__instruction *i)
{
    if (i->op == DAL__TABLE) {
        const uint32_t table = i->b / DAL__TABLE_ORDERS, order = i->b % DAL__TABLE_ORDERS;
        dal__buffer_append(w->text, "dal_piecewise(");
        write_operand(w, i->a, false);
        dal__buffer_print(w->text, ", dal__table%u, %d, %u)", table, w->tapes->tables[table].knots,
                          order);
        return;
    }
    /* Operators take a double beside a num; functions, and two doubles, need a num. */
    const bool numbers = is_number(w->tapes, i->a) && is_number(w->tapes, i->b);
    const bool bare = !numbers && !strstr(expressions[i->op], "dal_") && i->op != DAL__NEG;
    const char *at = expressions[i->op];
    for (char before = ' '; *at; before = *at++) {
        const bool alone = !is_letter(before) && !is_letter(at[1]);
        if (alone && *at >= 'a' && *at <= 'c')
            write_operand(w, *at == 'a' ? i->a : *at == 'b' ? i->b : i->c, bare);
        else
            dal__buffer_append(w->text, *at == '*' && at[1] != ' ' ? "* " : (char[]){*at, '\0'});
    }
}

static void write_instruction(writer *w, const dal__instruction *i)
{
    if (i->op == DAL__SINCOS) {
        const uint32_t sine = ++w->results, cosine = ++w->results;
        dal__buffer_print(w->text, "    num x%u, x%u;\n    dal_sincos(", sine, cosine);
        write_operand(w, i->a, false);
        dal__buffer_print(w->text, ", &x%u, &x%u);\n", sine, cosine);
        w->result[i->d] = sine;
        w->result[i->b] = cosine;
        return;
    }
    dal__buffer_print(w->text, "    const num x%u = ", w->results + 1);
    write_expression(w, i);
    dal__buffer_append(w->text, ";\n");
    w->result[i->d] = ++w->results;
}

void dal__tape_write(const dal__tapes *tapes, int program, const dal__input_name *input,
                     dal__buffer *text)
{
    const dal__tape *tape = &tapes->tape[program];
    writer w = {tapes, input, calloc(tapes->workspace + 1, sizeof *w.result), 0, text};
    text->out_of_memory |= !w.result;
    if (!w.result) return;
    for (int i = 0; i < tape->length; i++) write_instruction(&w, &tape->code[i]);
    for (int k = 0; k < tape->outputs; k++) {
        dal__buffer_print(text, "    out[%d] = ", k);
        write_operand(&w, tape->place[k], false);
        dal__buffer_append(text, ";\n");
    }
    free(w.result);
}

/* Marks the places that an instruction reads. */
static void mark_operands(const dal__instruction *i, bool *is_read)
{
    is_read[i->a] = is_read[i->c] = true;
    if (i->op != DAL__TABLE) is_read[i->b] = true;
}

void dal__tapes_write_hoisted(const dal__tapes *tapes, const bool *is_written, dal__buffer *text)
{
    const writer w = {.tapes = tapes, .text = text};
    const dal__tape *hoisted = &tapes->hoisted;
    bool *is_read = calloc(tapes->workspace + 1, sizeof *is_read);
    text->out_of_memory |= !is_read;
    if (!is_read) return;
    for (int p = 0; p < tapes->count; p++) {
        const dal__tape *tape = &tapes->tape[p];
        for (int i = 0; is_written[p] && i < tape->length; i++)
            mark_operands(&tape->code[i], is_read);
        for (int k = 0; is_written[p] && k < tape->outputs; k++) is_read[tape->place[k]] = true;
    }
    for (int i = hoisted->length - 1; i >= 0; i--)
        if (is_read[hoisted->code[i].d]) mark_operands(&hoisted->code[i], is_read);
    for (int i = 0; i < hoisted->length; i++) {
        if (!is_read[hoisted->code[i].d]) continue;
        dal__buffer_print(text, "    DAL_WORK(%u) = ", hoisted->code[i].d);
        write_expression(&w, &hoisted->code[i]);
        dal__buffer_append(text, ";\n");
    }
    free(is_read);
}

/* Marks the tables that an instruction of the tape reads. */
static void note_tables(const dal__tape *tape, bool *used)
{
    for (int i = 0; i < tape->length; i++)
        if (tape->code[i].op == DAL__TABLE) used[tape->code[i].b / DAL__TABLE_ORDERS] = true;
}

void dal__tapes_write_tables(const dal__tapes *tapes, dal__buffer *text)
{
    bool *used = calloc((size_t)tapes->table_count + 1, sizeof *used);
    text->out_of_memory |= !used;
    if (!used) return;
    note_tables(&tapes->hoisted, used);
    for (int i = 0; i < tapes->count; i++) note_tables(&tapes->tape[i], used);
    for (int k = 0; k < tapes->table_count; k++) {
        const dal__table *table = &tapes->tables[k];
        const size_t size = dal__table_size(table->knots);
        if (!used[k]) continue;
        dal__buffer_print(text, "static const double dal__table%d[] DAL_UNUSED = {", k);
        for (size_t i = 0; i < size; i++) {
            dal__buffer_append(text, i % 8 ? ", " : i ? ",\n    " : "\n    ");
            dal__buffer_number(text, table->data[i]);
        }
        dal__buffer_append(text, "};\n");
    }
    free(used);
}

unsigned dal__tape_calls(const dal__tape *tape)
{
    unsigned calls = 0;
    for (int i = 0; i < tape->length; i++) {
        const uint32_t op = tape->code[i].op;
        if (op == DAL__SIN || op == DAL__COS)
            calls |= DAL__CALLS_SIN;
        else if (op == DAL__SINCOS)
            calls |= DAL__CALLS_SINCOS;
        else if (op >= DAL__SIGN && op <= DAL__IF)
            calls |= DAL__CALLS_BRANCHES;
        else if (op == DAL__TABLE)
            calls |= DAL__CALLS_TABLES;
        else if (op >= DAL__POW && op != DAL__SQRT && op <= DAL__ASINH)
            calls |= DAL__CALLS_LIBM;
    }
    return calls;
}
