/* taylor.h - the Taylor coefficients of expressions along a motion, order by order.
 *
 *     inputs x = x_0 + x_1 s + x_2 s^2 + ..   ->   outputs f(x) = f_0 + f_1 s + f_2 s^2 + ..
 *
 * in s = t/tau.  The unit of time tau is a power of two: with one of the motion no coefficient
 * leaves the range of numbers, and none has other digits than with tau = 1.
 *
 * One recurrence per operation (recurrences.h) gives coefficient k of its result from coefficients
 * 0..k of its operands and 0..k-1 of itself.  A series program is made from tapes that are
 * finished: each result of a tape becomes a series, a slot, with a place of its own, since all its
 * coefficients are needed until the step ends; what is constant along a run stays in work.
 *
 *     memory[slots][stride]     coefficients, stride of them for each slot; inputs come first
 *
 * What a recurrence adds up over lower orders are inner sums of two slots (kernel/series.h).  All
 * sums of a program are in one list, each once.  For the sums of terms j a_j b_(k-j) there are
 * slots with coefficients j a_j.
 *
 * Order 0 computes with the operations of the tape: f_0 has the bits of the tape's outputs.  Sums
 * have one order, so single runs and lanes agree in every bit.
 *
 * A. Jorba, M. Zou, Experimental Mathematics 14 (2005) 99; F. Biscani, D. Izzo, MNRAS 504 (2021)
 * 2614. */
#ifndef DAL_EXPR_TAYLOR_H
#define DAL_EXPR_TAYLOR_H

#include "expr/recurrences.h"
#include "expr/tape.h"

/* An operation: of order 0 by op, as tapes have it, of others by recurrence, the same or one
 * of recurrences.h.  u: slot of its result; w: of a second series, the cosine of a sine;
 * reciprocal: of what its recurrence multiplies by, in order 0 alone; the latter are u where there
 * is none.  a, b, c: operands; sum[sums]: numbers of the inner sums, in the order of its list. */
typedef struct dal__taylor_operation {
    uint32_t op, recurrence, u, w, reciprocal, a, b, c;
    uint32_t sum[DAL__TAYLOR_SUMS];
    int sums;
    bool once; /* order 0 alone is needed */
} dal__taylor_operation;

/* sum_(j=1..k-1) a_j b_(k-j) of two slots. */
typedef struct dal__taylor_sum {
    uint32_t a, b;
    bool needed;   /* beyond order 0 */
    uint32_t next; /* 1 + number of an earlier sum with the same later slot; 0: none */
} dal__taylor_sum;

typedef struct dal__taylor {
    dal__taylor_operation *code; /* [length] */
    dal__taylor_sum *sum;        /* [sums] */
    uint32_t *output;            /* [outputs] operands */
    bool *kept;                  /* [slots] whether later orders need its coefficients beyond 0 */
    int length, sums, outputs, slots, inputs, coordinates;
    const char *refused; /* what has no Taylor series: "abs"; NULL: nothing */
} dal__taylor;

/* A program without outputs.  Inputs 1 + coordinates + i are the derivatives of 1 + i for
 * i < coordinates.  NULL: out of memory. [alloc] */
dal__taylor *dal__taylor_create(int inputs, int coordinates);
void dal__taylor_free(dal__taylor *taylor);
/* Adds the outputs of a finished tape, count of them with all orders and the others by their values
 * alone; places[inputs]: where the inputs are in work.  An operation without a recurrence that
 * one of those count needs leaves its name in refused.  Errors: DAL_STATUS_MEMORY. [alloc] */
dal_status dal__taylor_add(dal__taylor *taylor, const dal__tapes *tapes, int program, int count,
                           const uint32_t *places);

/* Coefficient k of all series, from the inputs' in[inputs] and from the lower ones in
 * memory; k < stride; unit: tau.  Coefficient k of outputs first.. first + count - 1.  All arrays
 * are interleaved by lanes. */
#define DAL__TAYLOR_RUN(name, variant, lanes, set)                                                 \
    void name##_##variant(const dal__taylor *taylor, double unit, int k, int stride,               \
                          const double *in, const double *work, double *memory);
#define DAL__TAYLOR_READ(name, variant, lanes, set)                                                \
    void name##_##variant(const dal__taylor *taylor, int first, int count, int k, int stride,      \
                          const double *work, const double *memory, double *out);
DAL__TAYLOR_RUN(dal__taylor_run, x1, 1, BASE)
DAL__TAYLOR_READ(dal__taylor_read, x1, 1, BASE)
DAL__VARIANT_LIST(DAL__TAYLOR_RUN, dal__taylor_run)
DAL__VARIANT_LIST(DAL__TAYLOR_READ, dal__taylor_read)

#endif
