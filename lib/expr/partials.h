/* partials.h - the partial derivatives of each operation, for nodes (derivative.c) and for numbers
 * (terms.c).
 *
 * k dy/da and k dy/db of y = a op b.  What includes this defines SUM, DIFFERENCE, PRODUCT, RATIO,
 * MINUS, SQUARE, NUMBER, POWER and OF (an operation of one operand) over nodes or numbers, and
 *
 *     DIRECTION(x, r)     x/r, or 0 where r is 0
 *     ROOT(c, sign, x)    sqrt(c + sign x^2)
 *     TABLE_SLOPE(x)      the next derivative of the table y at x
 *
 * The derivative of abs is sign, and sign has the derivative 0. */
#ifndef DAL_EXPR_PARTIALS_H
#define DAL_EXPR_PARTIALS_H

#define DAL__PARTIAL_LIST(OF_BOTH, OF_ONE)                                                         \
    OF_BOTH(ADD, k, k)                                                                             \
    OF_BOTH(SUB, k, MINUS(k))                                                                      \
    OF_BOTH(MUL, PRODUCT(k, b), PRODUCT(k, a))                                                     \
    OF_BOTH(DIV, RATIO(k, b), MINUS(RATIO(PRODUCT(k, y), b)))                                      \
    OF_BOTH(POW, PRODUCT(k, PRODUCT(b, POWER(a, DIFFERENCE(b, NUMBER(1.0))))),                     \
            PRODUCT(k, PRODUCT(y, OF(LOG, a))))                                                    \
    OF_BOTH(ATAN2, RATIO(PRODUCT(k, b), SUM(SQUARE(a), SQUARE(b))),                                \
            MINUS(RATIO(PRODUCT(k, a), SUM(SQUARE(a), SQUARE(b)))))                                \
    OF_BOTH(HYPOT, PRODUCT(k, DIRECTION(a, y)), PRODUCT(k, DIRECTION(b, y)))                       \
    OF_ONE(TABLE, PRODUCT(k, TABLE_SLOPE(a)))                                                      \
    OF_ONE(NEG, MINUS(k))                                                                          \
    OF_ONE(SQRT, RATIO(k, PRODUCT(NUMBER(2.0), y)))                                                \
    OF_ONE(EXP, PRODUCT(k, y))                                                                     \
    OF_ONE(LOG, RATIO(k, a))                                                                       \
    OF_ONE(SIN, PRODUCT(k, OF(COS, a)))                                                            \
    OF_ONE(COS, MINUS(PRODUCT(k, OF(SIN, a))))                                                     \
    OF_ONE(TAN, PRODUCT(k, SUM(NUMBER(1.0), SQUARE(y))))                                           \
    OF_ONE(ASIN, RATIO(k, ROOT(1.0, -1.0, a)))                                                     \
    OF_ONE(ACOS, MINUS(RATIO(k, ROOT(1.0, -1.0, a))))                                              \
    OF_ONE(ATAN, RATIO(k, SUM(NUMBER(1.0), SQUARE(a))))                                            \
    OF_ONE(SINH, PRODUCT(k, OF(COSH, a)))                                                          \
    OF_ONE(COSH, PRODUCT(k, OF(SINH, a)))                                                          \
    OF_ONE(TANH, PRODUCT(k, DIFFERENCE(NUMBER(1.0), SQUARE(y))))                                   \
    OF_ONE(ASINH, RATIO(k, ROOT(1.0, 1.0, a)))                                                     \
    OF_ONE(ABS, PRODUCT(k, OF(SIGN, a)))

#endif
