/* elementary.h - the elementary functions at each width, as functions of arrays for the tests. */
#ifndef ELEMENTARY_TEST_H
#define ELEMENTARY_TEST_H

#include "core/machine.h"

#define UNARY_LIST(X)                                                                              \
    X(sin) X(cos) X(tan) X(asin) X(acos) X(atan) X(sinh) X(cosh) X(tanh) X(asinh) X(exp) X(log)
#define BINARY_LIST(X) X(atan2) X(pow)

enum function {
#define X(f) F_##f,
    UNARY_LIST(X) BINARY_LIST(X)
#undef X
        F_sign,
    F_sin_of_sincos,
    F_cos_of_sincos,
    FUNCTIONS
};

/* out[i] = f(a[i], b[i]) for count values, a multiple of 8. */
typedef void apply_function(enum function f, const double *a, const double *b, double *out,
                            int count);
/* For a single number and for every group of lanes. */
apply_function apply_x1;
#define DECLARE(name, variant, lanes, set) apply_function name##_##variant;
DAL__VARIANT_LIST(DECLARE, apply)
#undef DECLARE

#endif
