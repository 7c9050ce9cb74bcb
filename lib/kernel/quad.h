/* quad.h - numbers longer than double, for runs that show what the rounding of doubles does.
 *
 * A source over num compiled with DAL_NUM_QUAD computes in the longest numbers that the compiler
 * has and whose elementary functions are right to their last places: long double where it is longer
 * than the 64 binary digits of x87 (IEC 60559 binary128 on AArch64 and others, 113 digits), else
 * binary128 with the functions of glibc (x86-64), else long double, whatever it is.  They are
 * computed by software and some hundred times slower than doubles.
 *
 * What is a double in a source stays one: coefficients, sizes and times of steps, constants of
 * formulas, parameters.  A run in quad precision is so the same method on the same system, less the
 * rounding of its arithmetic. */
#ifndef DAL_KERNEL_QUAD_H
#define DAL_KERNEL_QUAD_H

#include <float.h>
#include <math.h>

#if LDBL_MANT_DIG <= 64 && defined __SIZEOF_FLOAT128__ && defined __GLIBC__
#define DAL_QUAD_DIGITS      113
#define DAL_QUAD_FUNCTION(f) f##f128
typedef __float128 dal_quad __attribute__((may_alias));
#else
#define DAL_QUAD_DIGITS      LDBL_MANT_DIG
#define DAL_QUAD_FUNCTION(f) f##l
typedef long double dal_quad __attribute__((may_alias));
#endif

/* The C library may keep the declarations of these to itself. */
#define DAL_DECLARE_QUAD(f)  dal_quad DAL_QUAD_FUNCTION(f)(dal_quad x);
#define DAL_DECLARE_QUAD2(f) dal_quad DAL_QUAD_FUNCTION(f)(dal_quad a, dal_quad b);
DAL_DECLARE_QUAD(fabs)
DAL_DECLARE_QUAD(sqrt)
DAL_DECLARE_QUAD(sin)
DAL_DECLARE_QUAD(cos)

/* The unit in the last place of 1, less that of a double. */
#if DAL_QUAD_DIGITS >= 113
#define DAL_QUAD_ULP_RATIO 0x1p-60
#elif DAL_QUAD_DIGITS > DBL_MANT_DIG
#define DAL_QUAD_ULP_RATIO 0x1p-11
#else
#define DAL_QUAD_ULP_RATIO 1.0
#endif

#endif
