/* test_decimal.c - decimal numbers, written and read, beside printf and strtod of the C library. */
#include "dalembert.h"
#include "dalembert_program.h"

#include <CUnit/Basic.h>
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool is_same(double x, double y) { return memcmp(&x, &y, sizeof x) == 0; }

/* strtod is right for every text in the locale of the tests, which is C. */
static void reads(const char *text)
{
    double value = NAN;
    const double right = strtod(text, NULL);
    const dal_status status = dal__parse_number(text, strlen(text), &value);
    const bool agrees = isinf(right) ? status == DAL_STATUS_TOO_LARGE
                                     : status == DAL_STATUS_OK && is_same(value, right);
    if (!agrees) printf("reads '%s' as %a, not %a\n", text, value, right);
    CU_ASSERT(agrees);
}

static void writes(double x)
{
    char text[DAL__NUMBER_SIZE], right[64];
    const int length = dal__format_number(text, x);
    snprintf(right, sizeof right, "%.17g", x);
    const bool agrees = strcmp(text, right) == 0 && (size_t)length == strlen(right);
    if (!agrees) printf("writes %a as '%s', not '%s'\n", x, text, right);
    CU_ASSERT(agrees);
    if (isfinite(x)) reads(right);
}

static uint64_t draw(uint64_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    return *state ^= *state << 17;
}

static void test_every_exponent(void)
{
    for (int e = -1074; e < 1024; e++) {
        const double x = ldexp(1.0, e);
        writes(x);
        writes(-nextafter(x, 0.0));
        writes(nextafter(x, INFINITY));
    }
}

static void test_powers_of_ten(void)
{
    char text[32];
    for (int k = -330; k <= 310; k++) {
        snprintf(text, sizeof text, "1e%d", k);
        reads(text);
        const double x = strtod(text, NULL);
        if (isinf(x)) continue;
        writes(x);
        writes(nextafter(x, 0.0));
        writes(nextafter(x, INFINITY));
        snprintf(text, sizeof text, "9999999999999999999e%d", k);
        reads(text);
    }
}

/* Of all doubles those nearest to the middle of two numbers of 17 digits, and such middles. */
static void test_middles_of_digits(void)
{
    writes(ldexp(5592117679628511.0, 164));
    writes(ldexp(6685530990800801.0, -866));
    writes(ldexp(6685530990800801.0, -867));
    for (int k = 1; k < 24; k++)
        for (double odd = 1.0; odd < 200.0; odd += 2.0) {
            writes(ldexp(odd, -k));
            writes(ldexp(odd * 2097151.0, -k - 10));
            writes(ldexp(9007199254740991.0 - odd, -k));
        }
}

/* The middle of two doubles, and what is next to it; with a negative exponent the power of ten is
 * not exact, and the C library decides. */
static void test_middles_of_doubles(void)
{
    reads("9007199254740993");
    reads("9007199254740993.00000000000000000000000000000000000000000000001");
    reads("9007199254740995");
    reads("45035996273704965e-1");
    reads("45035996273704975e-1");
    reads("4503599627370496499e-3");
    reads("4503599627370496501e-3");
    reads("11258999068426241.25");
    reads("1.7976931348623157e308");
    reads("1.7976931348623158e308");
    reads("1.7976931348623159e308");
    reads("179769313486231580793728971405303415079934132710037826936173778980444968292764750946649"
          "01797758720709633028641669288791094655554785194040263065748867150582068190890200070838"
          "36765124738105320416");
    reads("2.2250738585072011e-308");
    reads("2.2250738585072014e-308");
    reads("4.9406564584124654e-324");
    reads("2.4703282292062327e-324");
    reads("2.4703282292062328e-324");
    for (int i = 0; i < 400; i++) {
        char text[64];
        snprintf(text, sizeof text, "%lld.5", 4503599627370496LL + 1237LL * i);
        reads(text);
        snprintf(text, sizeof text, "%lld.25", 2251799813685248LL + 1237LL * i);
        reads(text);
    }
}

static void test_drawn_numbers(void)
{
    uint64_t state = UINT64_C(88172645463325252);
    for (int i = 0; i < 20000; i++) {
        char text[64];
        double x;
        uint64_t bits = draw(&state);
        memcpy(&x, &bits, sizeof x);
        if (!isfinite(x)) continue;
        writes(x);
        snprintf(text, sizeof text, "%.*g", (int)(draw(&state) % 25) + 1, x);
        reads(text);
        writes((double)(draw(&state) % 1000000) / 1e4);
        snprintf(text, sizeof text, "0.000%lldE-%d", (long long)(draw(&state) >> 20), i % 30);
        reads(text);
    }
}

static void test_what_is_no_ordinary_number(void)
{
    char text[DAL__NUMBER_SIZE];
    writes(0.0);
    writes(-0.0);
    writes(INFINITY);
    writes(-INFINITY);
    CU_ASSERT(dal__format_number(text, -NAN) == 3);
    CU_ASSERT_STRING_EQUAL(text, "nan");
    CU_ASSERT(dal__format_number(text, -DBL_MIN) == 24);
    CU_ASSERT_STRING_EQUAL(text, "-2.2250738585072014e-308");
}

static void test_texts_that_are_no_numbers(void)
{
    const char *const texts[] = {"", ".", "e5", "1.2.3", "1e", "1e+", "--1", "1 ", "0x1", "nan"};
    double value = 5.0;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        CU_ASSERT(dal__parse_number(texts[i], strlen(texts[i]), &value) == DAL_STATUS_SYNTAX);
    CU_ASSERT(value == 5.0);
    CU_ASSERT(dal__parse_number("1e309", 5, &value) == DAL_STATUS_TOO_LARGE);
    reads("5.");
    reads(".5");
    reads("-000.00000e-99999999999999999999");
    reads("0000000000000000000000000000.00000000000000000000000000000000000012345e40");
}

static double decimal(int digits, int exponent)
{
    char text[64];
    snprintf(text, sizeof text, "%de-%d", digits, exponent);
    return strtod(text, NULL);
}

/* Rows at a distance of d 10^-e, from 0 on and up to 0: the doubles nearest to the decimal numbers,
 * however many rows there are. */
static void rows_are_decimal(int d, int e, int count)
{
    const dal__decimal length = dal__decimal_difference(decimal(d * count, e), 0.0);
    const dal__decimal multiple = dal__decimal_multiple(decimal(d, e), count);
    bool agrees = true;
    for (int k = 0; k < 10; k++)
        agrees &= dal__add_share(0.0, length, k, count) == decimal(d * k, e) &&
                  dal__add_share(0.0, multiple, k, count) == decimal(d * k, e) &&
                  dal__add_share(-length.value, length, k, count) == -decimal(d * (count - k), e);
    CU_ASSERT(agrees);
}

static void test_rows_at_decimal_times(void)
{
    for (int e = 1; e < 25; e += 3)
        for (int d = 1; d < 40; d += 2) {
            rows_are_decimal(d, e, 10);
            rows_are_decimal(d, e, 300);
            rows_are_decimal(d, e, 700);
        }
}

/* What 15 digits do not read as is itself, to the bit. */
static void test_numbers_as_decimals(void)
{
    const double third = 1.0 / 3.0, pi = acos(-1.0);
    CU_ASSERT(dal__as_decimal(third).rest == 0.0 && dal__as_decimal(-pi).rest == 0.0);
    CU_ASSERT(dal__as_decimal(0.5).rest == 0.0 && dal__as_decimal(1e22).rest == 0.0);
    /* 0.1 = 3602879701896397 2^-55 - 0.2 2^-55 */
    CU_ASSERT(fabs(dal__as_decimal(0.1).rest / 0x1p-55 + 0.2) < 1e-15);
    CU_ASSERT(isnan(dal__as_decimal(NAN).value) && isinf(dal__as_decimal(INFINITY).value));
    CU_ASSERT(dal__as_decimal(4e-320).value == 4e-320);
    for (int k = 0; k < 100; k++)
        CU_ASSERT(dal__add_share(0.0, dal__decimal_difference(pi, 0.0), k, 100) ==
                  dal__add_share(0.0, dal__decimal_difference(4.0 * pi, 0.0), k, 400));
}

void suite_decimal(void);
void suite_decimal(void)
{
    CU_pSuite suite = CU_add_suite("decimal numbers", NULL, NULL);
    CU_add_test(suite, "doubles of every exponent", test_every_exponent);
    CU_add_test(suite, "powers of ten", test_powers_of_ten);
    CU_add_test(suite, "near the middle of two numbers of 17 digits", test_middles_of_digits);
    CU_add_test(suite, "near the middle of two doubles", test_middles_of_doubles);
    CU_add_test(suite, "drawn numbers", test_drawn_numbers);
    CU_add_test(suite, "rows at decimal times", test_rows_at_decimal_times);
    CU_add_test(suite, "numbers as decimals", test_numbers_as_decimals);
    CU_add_test(suite, "zero, infinity, NaN", test_what_is_no_ordinary_number);
    CU_add_test(suite, "texts that are no numbers", test_texts_that_are_no_numbers);
}
