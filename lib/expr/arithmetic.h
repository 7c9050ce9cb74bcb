/* arithmetic.h - what each operation computes from a (and b), over num.
 *
 * The one list behind constant folding, dal__evaluate and the tapes, so that they agree in every
 * bit.  The library is compiled without contraction: what is fused stands in DAL__FUSED_LIST, and
 * which sums are is decided by dal__lower. */
#ifndef DAL_EXPR_ARITHMETIC_H
#define DAL_EXPR_ARITHMETIC_H

#include "kernel/elementary.h"

#define DAL__UNARY_LIST(X)                                                                         \
    X(NEG, -a)                                                                                     \
    X(SQRT, dal_sqrt(a))                                                                           \
    X(EXP, dal_exp(a))                                                                             \
    X(LOG, dal_log(a))                                                                             \
    X(SIN, dal_sin(a))                                                                             \
    X(COS, dal_cos(a))                                                                             \
    X(TAN, dal_tan(a))                                                                             \
    X(ASIN, dal_asin(a))                                                                           \
    X(ACOS, dal_acos(a))                                                                           \
    X(ATAN, dal_atan(a))                                                                           \
    X(SINH, dal_sinh(a))                                                                           \
    X(COSH, dal_cosh(a))                                                                           \
    X(TANH, dal_tanh(a))                                                                           \
    X(ASINH, dal_asinh(a))                                                                         \
    X(ABS, dal_abs(a))                                                                             \
    X(SIGN, dal_sign(a))

#define DAL__BINARY_LIST(X)                                                                        \
    X(ADD, a + b)                                                                                  \
    X(SUB, a - b)                                                                                  \
    X(MUL, a *b)                                                                                   \
    X(DIV, a / b)                                                                                  \
    X(POW, dal_pow(a, b))                                                                          \
    X(ATAN2, dal_atan2(a, b))

/* A sum that takes a product into itself: one rounding. */
#define DAL__FUSED_LIST(X)                                                                         \
    X(MUL_ADD, dal_fma(a, b, c))                                                                   \
    X(MUL_SUB, dal_fma(a, b, -c))                                                                  \
    X(SUB_MUL, dal_fma(-a, b, c))

#endif
