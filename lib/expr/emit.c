/* emit.c - programs as straight-line C over num: the arithmetic of the tape, written out.
 *
 * Every result is a constant x1, x2, ... of its own; parameters and hoisted nodes are
 * DAL_WORK(place), with their places in work.  Between chunks a result is passed by the place that
 * it has among the temporaries in work: no other gets it before the last that reads it. */
#include "expr/emit.h"
#include "expr/arithmetic.h"
#include "expr/table.h"
#include "expr/traversal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct dal__tape_writer {
    const dal__tapes *tapes;
    const dal__tape *tape;
    const dal__input_name *input;
    int next, end;    /* the next instruction, and the end of the chunk */
    uint32_t *result; /* [workspace] the number of the result that a place holds; 0: of no result
                         of this chunk */
    uint32_t results;
    int *maker; /* [workspace] the last result that a place gets: 2 i, 2 i + 1 of instruction i */
    int *last;  /* [2 length] the instruction that reads a result last */
    int zeros;  /* outputs */
    dal__buffer *text;
} writer;

static const char *const expressions[] = {
#define EXPRESSION(code, expression) [DAL__##code] = #expression,
    DAL__OPERATION_LIST(EXPRESSION)
#undef EXPRESSION
};

static bool is_number(const dal__tapes *tapes, uint32_t place)
{
    return place >= (uint32_t)tapes->parameters &&
           place < (uint32_t)(tapes->parameters + tapes->numbers);
}

void dal__constant_write(const dal__tapes *tapes, uint32_t place, dal__number_form form,
                         dal__buffer *text)
{
    if (!is_number(tapes, place)) {
        dal__buffer_print(text, "DAL_WORK(%u)", place);
        return;
    }
    if (form == DAL__AS_NUM) dal__buffer_append(text, "dal_num(");
    dal__buffer_number(text, tapes->number[place - (uint32_t)tapes->parameters]);
    if (form == DAL__AS_NUM) dal__buffer_append(text, ")");
}

static void write_operand(const writer *w, uint32_t place, dal__number_form form)
{
    const dal__tapes *tapes = w->tapes;
    if (place < tapes->first_input) {
        dal__constant_write(tapes, place, form, w->text);
    } else if (place < tapes->temporaries) {
        dal__buffer_append(w->text, w->input[place - tapes->first_input].text);
    } else {
        dal__buffer_print(w->text, "x%u", w->result[place]);
    }
}

const char *dal__operation_expression(uint32_t op) { return expressions[op]; }

void dal__expression_write(const char *expression, dal__name_writer *write, const void *user,
                           dal__buffer *text)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789";
    for (const char *at = expression; *at;) {
        const size_t name = strspn(at, letters), length = name ? name : 1; /* a name or number */
        const char *end = name ? write(user, at, name) : NULL;
        if (!end) dal__buffer_append_bytes(text, at, length);
        if (*at == '*' && at[1] != ' ') dal__buffer_append(text, " ");
        at = end ? end : at + length;
    }
}

/* The operands of an instruction. */
typedef struct operands {
    const writer *w;
    uint32_t place[3];
    dal__number_form form;
} operands;

static const char *write_place(const void *user, const char *name, size_t length)
{
    const operands *o = user;
    if (length > 1 || *name < 'a' || *name > 'c') return NULL;
    write_operand(o->w, o->place[*name - 'a'], o->form);
    return name + 1;
}

static void write_expression(const writer *w, const dal__instruction *i)
{
    if (i->op == DAL__TABLE) {
        const uint32_t table = i->b / DAL__TABLE_ORDERS, order = i->b % DAL__TABLE_ORDERS;
        dal__buffer_append(w->text, "dal_piecewise(");
        write_operand(w, i->a, DAL__AS_NUM);
        dal__buffer_print(w->text, ", dal__knots%u, %d, %u)", table, w->tapes->tables[table].knots,
                          order);
        return;
    }
    /* Operators take a double beside a num; functions, and two doubles, need a num. */
    const bool numbers = is_number(w->tapes, i->a) && is_number(w->tapes, i->b);
    const bool may_be_double = !numbers && !strstr(expressions[i->op], "dal_") && i->op != DAL__NEG;
    const operands o = {w, {i->a, i->b, i->c}, may_be_double ? DAL__AS_DOUBLE : DAL__AS_NUM};
    dal__expression_write(expressions[i->op], write_place, &o, w->text);
}

static void write_instruction(writer *w, const dal__instruction *i)
{
    if (i->op == DAL__SINCOS) {
        const uint32_t sine = ++w->results, cosine = ++w->results;
        dal__buffer_print(w->text, "    num x%u, x%u;\n    dal_sincos(", sine, cosine);
        write_operand(w, i->a, DAL__AS_NUM);
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

/* ---- chunks ---- */

/* The operands of an instruction, as places. */
static int find_operands(const dal__instruction *i, uint32_t *place)
{
    int count = 0;
    place[count++] = i->a;
    place[count++] = i->c;
    if (i->op != DAL__TABLE && i->op != DAL__SINCOS) place[count++] = i->b;
    return count;
}

static void find_readers(writer *w)
{
    uint32_t place[3];
    for (int i = 0; i < w->tape->length; i++) {
        const dal__instruction *code = &w->tape->code[i];
        for (int k = find_operands(code, place); k-- > 0;)
            if (place[k] >= w->tapes->temporaries) w->last[w->maker[place[k]]] = i;
        w->maker[code->d] = 2 * i;
        if (code->op == DAL__SINCOS) w->maker[code->b] = 2 * i + 1;
    }
}

/* Reads the operands that earlier chunks have passed. */
static void write_passed_in(writer *w, const dal__instruction *i)
{
    uint32_t place[3];
    for (int k = find_operands(i, place); k-- > 0;) {
        if (place[k] < w->tapes->temporaries || w->result[place[k]] > 0) continue;
        w->result[place[k]] = ++w->results;
        dal__buffer_print(w->text, "    const num x%u = passed[%zu];\n", w->results,
                          place[k] - w->tapes->temporaries);
    }
}

/* Passes a result on where a later chunk reads it. */
static void write_passed_out(const writer *w, int result, uint32_t place)
{
    if (w->last[result] >= w->end)
        dal__buffer_print(w->text, "    passed[%zu] = x%u;\n", place - w->tapes->temporaries,
                          w->result[place]);
}

static bool is_zero_number(const dal__tapes *tapes, uint32_t place)
{
    if (!is_number(tapes, place)) return false;
    const double x = tapes->number[place - (uint32_t)tapes->parameters];
    return x == 0.0 && !signbit(x);
}

/* Outputs of a sparse matrix that are zero: from this number on a loop sets them. */
enum { MANY_ZEROS = 64 };

dal__tape_writer *dal__tape_writer_create(const dal__tapes *tapes, int program,
                                          const dal__input_name *input, dal__buffer *text)
{
    const dal__tape *tape = &tapes->tape[program];
    writer *w = calloc(1, sizeof *w);
    if (w) {
        *w = (writer){.tapes = tapes, .tape = tape, .input = input, .text = text};
        w->result = calloc(tapes->workspace + 1, sizeof *w->result);
        w->maker = calloc(tapes->workspace + 1, sizeof *w->maker);
        w->last = calloc(2 * (size_t)tape->length + 1, sizeof *w->last);
    }
    for (int k = 0; w && k < tape->outputs; k++) w->zeros += is_zero_number(tapes, tape->place[k]);
    if (w && w->result && w->maker && w->last) return find_readers(w), w;
    text->out_of_memory = true;
    return dal__tape_writer_free(w), NULL;
}

void dal__tape_writer_free(writer *w)
{
    if (!w) return;
    free(w->result);
    free(w->maker);
    free(w->last);
    free(w);
}

bool dal__tape_write_chunk(writer *w, int instructions)
{
    const dal__tape *tape = w->tape;
    const int first = w->next, rest = tape->length - first;
    w->end = first + (rest < instructions ? rest : instructions);
    memset(w->result, 0, w->tapes->workspace * sizeof *w->result);
    w->results = 0;
    if (w->zeros >= MANY_ZEROS && first == 0)
        dal__buffer_print(w->text, "    for (int i = 0; i < %d; i++) out[i] = dal_num(0.0);\n",
                          tape->outputs);
    for (; w->next < w->end; w->next++) {
        const dal__instruction *code = &tape->code[w->next];
        write_passed_in(w, code);
        write_instruction(w, code);
        write_passed_out(w, 2 * w->next, code->d);
        if (code->op == DAL__SINCOS) write_passed_out(w, 2 * w->next + 1, code->b);
    }
    const bool is_last = w->end == tape->length;
    for (int k = 0; k < tape->outputs; k++) {
        const uint32_t place = tape->place[k];
        const bool is_made = place >= w->tapes->temporaries;
        if (is_made ? w->maker[place] < 2 * first || w->maker[place] >= 2 * w->end : !is_last)
            continue;
        if (w->zeros >= MANY_ZEROS && is_zero_number(w->tapes, place)) continue;
        dal__buffer_print(w->text, "    out[%d] = ", k);
        write_operand(w, place, DAL__AS_NUM);
        dal__buffer_append(w->text, ";\n");
    }
    return !is_last;
}

int dal__tapes_passed(const dal__tapes *tapes)
{
    return (int)(tapes->workspace - tapes->temporaries);
}

/* ---- what is constant along a run ---- */

/* Marks the places that an instruction reads. */
static void mark_operands(const dal__instruction *i, bool *is_read)
{
    uint32_t place[3];
    for (int k = find_operands(i, place); k-- > 0;) is_read[place[k]] = true;
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
        const dal__tape_table *table = &tapes->tables[k];
        const size_t size = dal__table_size(table->knots);
        if (!used[k]) continue;
        dal__buffer_print(text, "static const double dal__knots%d[] DAL_UNUSED = {", k);
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
