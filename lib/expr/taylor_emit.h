/* taylor_emit.h - series programs as C. */
#ifndef DAL_EXPR_TAYLOR_EMIT_H
#define DAL_EXPR_TAYLOR_EMIT_H

#include "core/buffer.h"
#include "expr/taylor.h"

/* Which coefficients a text computes: number 0, or each one after it. */
typedef enum dal__coefficient { DAL__FIRST, DAL__NEXT } dal__coefficient;

/* Writes the program as C statements over num for order 0, or for an order k >= 1, with the same
 * bits.  Coefficient k < DAL_FIXED_TAYLOR_ORDER of series i is c[i][k], in
 * c[slots][DAL_FIXED_TAYLOR_ORDER + 1]; what is constant along a run is DAL_WORK(place), or a
 * number; tau is DAL_FIXED_UNIT_OF_TIME; the functions that are called are in kernel/series.h.
 * The inner sums of one lane are formed in packs, for which their operands are stored a second
 * time, from l on.  Steps with many sums keep interiors there, too.  l has the numbers of
 * dal__taylor_extra series.  The last column of c is for 0.  Coefficients beyond order 0 that no
 * later order needs are variables, and not in c. */
void dal__taylor_write(const dal__taylor *taylor, const dal__tapes *tapes, dal__coefficient which,
                       int lanes, dal__buffer *text);
/* How many series l has room for, each of order + 1 coefficients. */
int dal__taylor_extra(const dal__taylor *taylor, int lanes, int order);
/* Writes that coefficient of an output. */
void dal__taylor_write_output(const dal__taylor *taylor, const dal__tapes *tapes, int output,
                              dal__coefficient which, dal__buffer *text);

#endif
