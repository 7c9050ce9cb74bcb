/* quad.h - quad precision, for runs that show the effect of rounding to double.
 *
 * A source over num compiled with DAL_NUM_QUAD computes in binary128 (113 binary digits): long
 * double where that is binary128 (AArch64 and others), else __float128 with the functions of glibc
 * (x86-64).  Where neither exists it uses long double, and runs in quad precision are
 * refused.  The arithmetic is done by software, about a hundred times slower than in double.
 *
 * Coefficients, step sizes, times, constants of formulas and parameters stay doubles.  So a run in
 * quad precision is the same method on the same system without the rounding of its arithmetic. */
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

/* The C library may hide these declarations. */
#define DAL_DECLARE_QUAD(f)  dal_quad DAL_QUAD_FUNCTION(f)(dal_quad x);
#define DAL_DECLARE_QUAD2(f) dal_quad DAL_QUAD_FUNCTION(f)(dal_quad a, dal_quad b);
DAL_DECLARE_QUAD(fabs)
DAL_DECLARE_QUAD(sqrt)
DAL_DECLARE_QUAD(sin)
DAL_DECLARE_QUAD(cos)

/* The unit in the last place of 1, in units of a double's. */
#if DAL_QUAD_DIGITS >= 113
#define DAL_QUAD_ULP_RATIO 0x1p-60
#elif DAL_QUAD_DIGITS > DBL_MANT_DIG
#define DAL_QUAD_ULP_RATIO 0x1p-11
#else
#define DAL_QUAD_ULP_RATIO 1.0
#endif

#endif
