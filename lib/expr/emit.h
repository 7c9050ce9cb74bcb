/* emit.h - programs as straight-line C. */
#ifndef DAL_EXPR_EMIT_H
#define DAL_EXPR_EMIT_H

#include "core/buffer.h"
#include "expr/tape.h"
#include <stdbool.h>

typedef struct dal__input_name {
    char text[16];
} dal__input_name;

/* A program as C statements over num that set out[0], out[1], ...: its instructions one by one, so
 * that it computes the same bits.  Input number i is called input[i].text; parameters and hoisted
 * nodes are DAL_WORK(place), with their places in work.  A long program is written in chunks, each
 * the body of a function; num passed[passed] holds what one computes and a later one reads. */
typedef struct dal__tape_writer dal__tape_writer;
/* NULL: out of memory, noted in text. [alloc] */
dal__tape_writer *dal__tape_writer_create(const dal__tapes *tapes, int program,
                                          const dal__input_name *input, dal__buffer *text);
void dal__tape_writer_free(dal__tape_writer *writer);
/* Writes the next chunk, of this number of instructions at most; returns whether some remain. */
bool dal__tape_write_chunk(dal__tape_writer *writer, int instructions);
/* The numbers that chunks of a program pass. */
int dal__tapes_passed(const dal__tapes *tapes);

/* Writes, of what dal__tapes_prepare_x1 computes, what the programs with is_written[count] read. */
void dal__tapes_write_hoisted(const dal__tapes *tapes, const bool *is_written, dal__buffer *text);
/* Writes the data of the tables, as arrays that the statements name. */
void dal__tapes_write_tables(const dal__tapes *tapes, dal__buffer *text);

/* Whether a number is written as a num, or may stay a double beside one. */
typedef enum dal__number_form { DAL__AS_NUM, DAL__AS_DOUBLE } dal__number_form;
/* Writes what is constant along a run, by its place in work. */
void dal__constant_write(const dal__tapes *tapes, uint32_t place, dal__number_form form,
                         dal__buffer *text);
/* Writes what a name of an expression means, and returns the end of what it has read of it; NULL:
 * the name stays. */
typedef const char *dal__name_writer(const void *user, const char *name, size_t length);
/* Writes an expression as the preprocessor makes text of it, with its names as write has them. */
void dal__expression_write(const char *expression, dal__name_writer *write, const void *user,
                           dal__buffer *text);
/* The expression of an operation in a, b and c. */
const char *dal__operation_expression(uint32_t op);

/* The kinds of elementary functions that a tape calls. */
enum {
    DAL__CALLS_SIN = 1 << 0, /* or cos, alone */
    DAL__CALLS_SINCOS = 1 << 1,
    DAL__CALLS_BRANCHES = 1 << 2, /* what does not act smoothly */
    DAL__CALLS_LIBM = 1 << 3,
    DAL__CALLS_TABLES = 1 << 4
};
unsigned dal__tape_calls(const dal__tape *tape);

#endif
