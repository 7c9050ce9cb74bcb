/* test_elementary.c - sin and cos against MPFR to one unit in the last place; every function the
 * same bits at every width, whatever is in the neighbouring lanes. */
#include "elementary.h"

#include <CUnit/Basic.h>
#include <math.h>
#include <mpfr.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { POINTS = 4000, PRECISION = 160 };

static const double own_range = 1e7; /* beyond it libm is called */

/* Marsaglia's xorshift: the same points in every run. */
static uint64_t random_state;

static double uniform(double low, double high)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return low + (high - low) * ((double)(random_state >> 11) * 0x1p-53);
}

static double random_sign(double x) { return uniform(-1.0, 1.0) < 0.0 ? -x : x; }

static double log_uniform(double low, double high)
{
    return random_sign(exp2(uniform(log2(low), log2(high))));
}

/* ---- points ---- */

static double pick_subnormal(void) { return uniform(-1.0, 1.0) * 0x1p-1022; }
static double pick_small(void) { return log_uniform(1e-300, 1e-3); }
static double pick_octant(void) { return uniform(-0.7853981633974483, 0.7853981633974483); }
static double pick_few_turns(void) { return uniform(-40.0, 40.0); }
static double pick_own(void) { return uniform(-own_range, own_range); }
static double pick_huge(void) { return log_uniform(own_range, 1e308); }

static double pick_at_edge(void)
{
    double x = own_range;
    for (int k = (int)uniform(0.0, 5.0); k > 0; k--) x = nextafter(x, INFINITY);
    for (int k = (int)uniform(0.0, 5.0); k > 0; k--) x = nextafter(x, 0.0);
    return random_sign(x);
}

/* A double within three of a multiple n pi/4; n = 58 gives the nearest of all to a zero. */
static double pick_near_multiple(void)
{
    mpfr_t x;
    int n = (int)log_uniform(1.0, 12732395.0);
    mpfr_init2(x, PRECISION);
    mpfr_const_pi(x, MPFR_RNDN);
    mpfr_mul_si(x, x, uniform(0.0, 1.0) < 0.01 ? 58 : n, MPFR_RNDN);
    mpfr_div_ui(x, x, 4, MPFR_RNDN);
    double y = mpfr_get_d(x, MPFR_RNDN);
    for (int k = (int)uniform(0.0, 4.0); k > 0; k--) y = nextafter(y, 0.0);
    for (int k = (int)uniform(0.0, 4.0); k > 0; k--) y = nextafter(y, 2.0 * y);
    mpfr_clear(x);
    return y;
}

static const struct {
    const char *name;
    double (*pick)(void);
} ranges[] = {{"subnormal", pick_subnormal}, {"small", pick_small},
              {"octant", pick_octant},       {"a few turns", pick_few_turns},
              {"up to 1e7", pick_own},       {"1e7 to 1e308", pick_huge},
              {"around 1e7", pick_at_edge},  {"near multiples of pi/4", pick_near_multiple}};

enum { RANGES = sizeof ranges / sizeof ranges[0] };

static void fill(int range, double *x)
{
    random_state = UINT64_C(88172645463325252) + (uint64_t)range;
    for (int i = 0; i < POINTS; i++) x[i] = ranges[range].pick();
}

/* ---- accuracy ---- */

/* |value - exact| in units of the last place of a double next to exact. */
static double ulps(double value, mpfr_t exact)
{
    mpfr_t difference;
    mpfr_init2(difference, PRECISION);
    mpfr_sub_d(difference, exact, value, MPFR_RNDN);
    long exponent = mpfr_zero_p(exact) ? -1074 : (long)mpfr_get_exp(exact) - 53;
    if (exponent < -1074) exponent = -1074;
    mpfr_mul_2si(difference, difference, -exponent, MPFR_RNDN);
    double u = fabs(mpfr_get_d(difference, MPFR_RNDN));
    mpfr_clear(difference);
    return u;
}

typedef int reference(mpfr_t result, const mpfr_t x, mpfr_rnd_t rounding);

static void check_accuracy(enum function f, reference *exact)
{
    static double x[POINTS], y[POINTS];
    mpfr_t argument, value;
    mpfr_init2(argument, 53);
    mpfr_init2(value, PRECISION);
    for (int range = 0; range < RANGES; range++) {
        double max_error = 0.0;
        fill(range, x);
        apply_x1(f, x, x, y, POINTS);
        for (int i = 0; i < POINTS; i++) {
            mpfr_set_d(argument, x[i], MPFR_RNDN);
            exact(value, argument, MPFR_RNDN);
            max_error = fmax(max_error, ulps(y[i], value));
        }
        CU_ASSERT(max_error <= 1.0);
        if (!(max_error <= 1.0)) printf("\n    %s: %.3f ulp\n", ranges[range].name, max_error);
    }
    mpfr_clear(argument);
    mpfr_clear(value);
    mpfr_free_cache();
}

static void test_sin(void) { check_accuracy(F_sin, mpfr_sin); }
static void test_cos(void) { check_accuracy(F_cos, mpfr_cos); }

/* ---- bits ---- */

/* Bit for bit, but that any NaN is as good as another. */
static int same_bits(const double *a, const double *b, int count)
{
    for (int i = 0; i < count; i++)
        if (memcmp(&a[i], &b[i], sizeof *a) != 0 && !(isnan(a[i]) && isnan(b[i]))) return 0;
    return 1;
}

/* Each lane of eight in turn is spoilt: the others may not notice. */
static void spoil(double *x)
{
    static const double bad[] = {NAN, INFINITY, -INFINITY, 1e300, -0.0, 1e7, 5e-324, 2e7};
    for (int i = 0; i < POINTS; i += 8) x[i + i / 8 % 8] = bad[i / 64 % 8];
}

static const struct {
    apply_function *apply;
    dal__instructions set;
} variants[] = {
#define X(name, variant, lanes, set) {name##_##variant, DAL__##set},
    DAL__VARIANT_LIST(X, apply)
#undef X
};
enum { VARIANTS = sizeof variants / sizeof variants[0] };

static void check_variants(enum function f, const double *a, const double *b)
{
    static double one[POINTS], wide[POINTS];
    apply_x1(f, a, b, one, POINTS);
    for (int v = 0; v < VARIANTS; v++) {
        if (!dal__machine_has(variants[v].set)) continue;
        variants[v].apply(f, a, b, wide, POINTS);
        CU_ASSERT(same_bits(one, wide, POINTS));
    }
}

static void test_variants(void)
{
    static double a[POINTS], b[POINTS];
    for (int f = 0; f < FUNCTIONS; f++)
        for (int range = 0; range < RANGES; range++) {
            fill(range, a);
            fill((range + 1) % RANGES, b);
            spoil(a);
            check_variants((enum function)f, a, b);
        }
}

static void test_together_or_apart(void)
{
    static double x[POINTS], apart[POINTS], together[POINTS];
    for (int range = 0; range < RANGES; range++) {
        fill(range, x);
        apply_x1(F_sin, x, x, apart, POINTS);
        apply_x1(F_sin_of_sincos, x, x, together, POINTS);
        CU_ASSERT(same_bits(apart, together, POINTS));
        apply_x1(F_cos, x, x, apart, POINTS);
        apply_x1(F_cos_of_sincos, x, x, together, POINTS);
        CU_ASSERT(same_bits(apart, together, POINTS));
    }
}

/* ---- the rest ---- */

static double value(enum function f, double a, double b)
{
    double x[8] = {a}, y[8] = {b}, out[8];
    apply_x1(f, x, y, out, 8);
    return out[0];
}

/* Valgrind's own fused multiply-add loses the sign of a zero; processors keep it. */
static int fma_keeps_sign(void)
{
    const volatile double zero = -0.0, one = 1.0;
    return signbit(fma(zero, one, zero)) != 0;
}

static void test_special(void)
{
    const double zero = value(F_sin, -0.0, 0.0);
    CU_ASSERT(zero == 0.0 && (signbit(zero) || !fma_keeps_sign()));
    CU_ASSERT(value(F_sin, 0.0, 0.0) == 0.0 && !signbit(value(F_sin, 0.0, 0.0)));
    CU_ASSERT(value(F_cos, -0.0, 0.0) == 1.0);
    CU_ASSERT(isnan(value(F_sin, INFINITY, 0.0)) && isnan(value(F_cos, -INFINITY, 0.0)));
    CU_ASSERT(isnan(value(F_sin, NAN, 0.0)) && isnan(value(F_cos, NAN, 0.0)));
    CU_ASSERT(value(F_sign, -3.5, 0.0) == -1.0 && value(F_sign, 5e-324, 0.0) == 1.0);
    CU_ASSERT(value(F_sign, -0.0, 0.0) == 0.0 && signbit(value(F_sign, -0.0, 0.0)));
    CU_ASSERT(isnan(value(F_sign, NAN, 0.0)));
}

static double libm(enum function f, double a, double b)
{
    switch (f) {
#define X(name)                                                                                    \
    case F_##name:                                                                                 \
        return name(a);
        UNARY_LIST(X)
#undef X
#define X(name)                                                                                    \
    case F_##name:                                                                                 \
        return name(a, b);
        BINARY_LIST(X)
#undef X
    default:
        return 0.0;
    }
}

static void test_rarer_functions_are_libm(void)
{
    static const double points[][2] = {{0.25, 3.0}, {-0.75, 2.0}, {0.9, -1.5}, {-1.0, -0.0}};
    for (int f = F_tan; f <= F_pow; f++)
        for (size_t i = 0; i < sizeof points / sizeof points[0]; i++) {
            double ours = value(f, points[i][0], points[i][1]);
            double theirs = libm(f, points[i][0], points[i][1]);
            CU_ASSERT(ours == theirs || (isnan(ours) && isnan(theirs)));
        }
}

void suite_elementary(void)
{
    CU_pSuite suite = CU_add_suite("elementary functions", NULL, NULL);
    CU_add_test(suite, "sin within one ulp of MPFR", test_sin);
    CU_add_test(suite, "cos within one ulp of MPFR", test_cos);
    CU_add_test(suite, "the same bits at every width", test_variants);
    CU_add_test(suite, "the same bits together or apart", test_together_or_apart);
    CU_add_test(suite, "zeros, infinities, NaN", test_special);
    CU_add_test(suite, "the rarer functions are libm's", test_rarer_functions_are_libm);
}
