/* quad.h - numbers longer than double, for runs that show what the rounding of doubles does.
 *
 * A source over num compiled with DAL_LONG computes in the longest numbers that the compiler has
 * and whose elementary functions are right to their last places: long double where it is longer
 * than the 64 binary digits of x87 (IEC 60559 binary128 on AArch64 and others, 113 digits), else
 * binary128 with the functions of glibc (x86-64), else long double, whatever it is.  They are
 * computed by software and some hundred times slower than doubles.
 *
 * What is a double in a source stays one: coefficients, sizes and times of steps, constants of
 * formulas, parameters.  A run in long numbers is so the same method on the same system, less the
 * rounding of its arithmetic. */
#ifndef DAL_KERNEL_QUAD_H
#define DAL_KERNEL_QUAD_H

#include <float.h>
#include <math.h>

#if LDBL_MANT_DIG <= 64 && defined __SIZEOF_FLOAT128__ && defined __GLIBC__
#define DAL_LONG_DIGITS 113
#define DAL_IN_LONG(f)  f##f128
typedef __float128 dal_long __attribute__((may_alias));
#else
#define DAL_LONG_DIGITS LDBL_MANT_DIG
#define DAL_IN_LONG(f)  f##l
typedef long double dal_long __attribute__((may_alias));
#endif

/* The C library may keep the declarations of these to itself. */
#define DAL_DECLARE_LONG(f)  dal_long DAL_IN_LONG(f)(dal_long x);
#define DAL_DECLARE_LONG2(f) dal_long DAL_IN_LONG(f)(dal_long a, dal_long b);
DAL_DECLARE_LONG(fabs)
DAL_DECLARE_LONG(sqrt)
DAL_DECLARE_LONG(sin)
DAL_DECLARE_LONG(cos)

/* The unit in the last place of 1, less that of a double. */
#if DAL_LONG_DIGITS >= 113
#define DAL_LONG_FINER 0x1p-60
#elif DAL_LONG_DIGITS > DBL_MANT_DIG
#define DAL_LONG_FINER 0x1p-11
#else
#define DAL_LONG_FINER 1.0
#endif

#endif
