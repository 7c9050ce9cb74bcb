/* arithmetic.h - what each operation computes from a, b and c, over num.
 *
 * The one list used by constant folding, dal__evaluate and the tapes, so that they agree in every
 * bit.  The library is compiled without contraction: fused operations are the last three,
 * and dal__lower chooses the sums that use them. */
#ifndef DAL_EXPR_ARITHMETIC_H
#define DAL_EXPR_ARITHMETIC_H

#include "kernel/elementary.h"

#define DAL__OPERATION_LIST(OP)                                                                    \
    OP(NEG, -a)                                                                                    \
    OP(SQRT, dal_sqrt(a))                                                                          \
    OP(EXP, dal_exp(a))                                                                            \
    OP(LOG, dal_log(a))                                                                            \
    OP(SIN, dal_sin(a))                                                                            \
    OP(COS, dal_cos(a))                                                                            \
    OP(TAN, dal_tan(a))                                                                            \
    OP(ASIN, dal_asin(a))                                                                          \
    OP(ACOS, dal_acos(a))                                                                          \
    OP(ATAN, dal_atan(a))                                                                          \
    OP(SINH, dal_sinh(a))                                                                          \
    OP(COSH, dal_cosh(a))                                                                          \
    OP(TANH, dal_tanh(a))                                                                          \
    OP(ASINH, dal_asinh(a))                                                                        \
    OP(ABS, dal_abs(a))                                                                            \
    OP(SIGN, dal_sign(a))                                                                          \
    OP(FLOOR, dal_floor(a))                                                                        \
    OP(ADD, a + b)                                                                                 \
    OP(SUB, a - b)                                                                                 \
    OP(MUL, a *b)                                                                                  \
    OP(DIV, a / b)                                                                                 \
    OP(POW, dal_pow(a, b))                                                                         \
    OP(ATAN2, dal_atan2(a, b))                                                                     \
    OP(MIN, dal_minimum(a, b))                                                                     \
    OP(MAX, dal_maximum(a, b))                                                                     \
    OP(HYPOT, dal_hypot(a, b))                                                                     \
    OP(LESS, dal_truth(dal_less(a, b)))                                                            \
    OP(LESS_EQUAL, dal_truth(dal_less_equal(a, b)))                                                \
    OP(EQUAL, dal_truth(dal_equal(a, b)))                                                          \
    /* a choice; and a sum and a product, with one rounding */                                     \
    OP(IF, dal_if(a, b, c))                                                                        \
    OP(MUL_ADD, dal_fma(a, b, c))                                                                  \
    OP(MUL_SUB, dal_fma(a, b, -c))                                                                 \
    OP(SUB_MUL, dal_fma(-a, b, c))

#endif
