/* decimal.c - doubles to 17 digits and decimal numbers to the nearest double, in every locale.
 *
 * Both are an integer of at most 64 bits times a power of ten, by 128 bits of that power (after
 * D. Lemire, Softw. Pract. Exper. 51 (2021) 1700, and U. Adams, OOPSLA 2019, 169): the product is
 * off by less than 4 units of its second word, which decides how it is rounded unless it is that
 * close to the middle of two results.  There, and for subnormal numbers and more than 19 digits,
 * the C library decides, which takes longer:
 *
 *     d1 d2 ... dk . dk+1 ... dn e x  =  d1 ... dn e (x - n + k)
 *
 * The second form has no decimal point, the only character of strtod that depends on the locale.
 * Two doubles and the point halfway between them have at most 767 digits, so of the digits after
 * that it matters only whether one is not 0: a last digit 1 represents them. */
#include "core/decimal.h"
#include "core/error.h"
#include "dalembert_program.h"
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- an integer times a power of ten ------------------------------------------------------- */

enum { FINE = 28, COARSE_LEAST = -13, COARSE = 26 };

/* The leading 128 bits of 10^b, exact, and of 10^(28 (a - 13)), truncated. */
static const uint64_t fine_power[FINE][2] = {
    {UINT64_C(0x8000000000000000), UINT64_C(0x0000000000000000)},
    {UINT64_C(0xa000000000000000), UINT64_C(0x0000000000000000)},
    {UINT64_C(0xc800000000000000), UINT64_C(0x0000000000000000)},
    {UINT64_C(0xfa00000000000000), UINT64_C(0x0000000000000000)},
    {UINT64_C(0x9c40000000000000), UINT64_C(0x0000000000000000)},
    {UINT64_C(0xc350000000000000), UINT64_C(0x0000000000000000)},
    {UINT64_C(0xf424000000000000), UINT64_C(0x0000000000000000)},
    {UINT64_C(0x9896800000000000), UINT64_C(0x0000000000000000)},
    {UINT64_C(0xbebc200000000000), UINT64_C(0x0000000000000000)},
    {UINT64_C(0xee6b280000000000), UINT64_C(0x0000000000000000)},
    {UINT64_C(0x9502f90000000000), UINT64_C(0x0000000000000000)},
    {UINT64_C(0xba43b74000000000), UINT64_C(0x0000000000000000)},
    {UINT64_C(0xe8d4a51000000000), UINT64_C(0x0000000000000000)},
    {UINT64_C(0x9184e72a00000000), UINT64_C(0x0000000000000000)},
    {UINT64_C(0xb5e620f480000000), UINT64_C(0x0000000000000000)},
    {UINT64_C(0xe35fa931a0000000), UINT64_C(0x0000000000000000)},
    {UINT64_C(0x8e1bc9bf04000000), UINT64_C(0x0000000000000000)},
    {UINT64_C(0xb1a2bc2ec5000000), UINT64_C(0x0000000000000000)},
    {UINT64_C(0xde0b6b3a76400000), UINT64_C(0x0000000000000000)},
    {UINT64_C(0x8ac7230489e80000), UINT64_C(0x0000000000000000)},
    {UINT64_C(0xad78ebc5ac620000), UINT64_C(0x0000000000000000)},
    {UINT64_C(0xd8d726b7177a8000), UINT64_C(0x0000000000000000)},
    {UINT64_C(0x878678326eac9000), UINT64_C(0x0000000000000000)},
    {UINT64_C(0xa968163f0a57b400), UINT64_C(0x0000000000000000)},
    {UINT64_C(0xd3c21bcecceda100), UINT64_C(0x0000000000000000)},
    {UINT64_C(0x84595161401484a0), UINT64_C(0x0000000000000000)},
    {UINT64_C(0xa56fa5b99019a5c8), UINT64_C(0x0000000000000000)},
    {UINT64_C(0xcecb8f27f4200f3a), UINT64_C(0x0000000000000000)}};
static const uint64_t coarse_power[COARSE][2] = {
    {UINT64_C(0xe1afa13afbd14d6d), UINT64_C(0x82189c09a3a1ec21)},
    {UINT64_C(0xe3e27a444d8d98b7), UINT64_C(0xfd1b1b2308169b25)},
    {UINT64_C(0xe61acf033d1a45df), UINT64_C(0x6fb92487298e33bd)},
    {UINT64_C(0xe858ad248f5c22c9), UINT64_C(0xd1b3400f8f9cff68)},
    {UINT64_C(0xea9c227723ee8bcb), UINT64_C(0x465e15a979c1cadc)},
    {UINT64_C(0xece53cec4a314ebd), UINT64_C(0xa4f8bf5635246428)},
    {UINT64_C(0xef340a98172aace4), UINT64_C(0x86fb897116c87c34)},
    {UINT64_C(0xf18899b1bc3f8ca1), UINT64_C(0xdc44e6c3cb279ac1)},
    {UINT64_C(0xf3e2f893dec3f126), UINT64_C(0x5a89dba3c3efccfa)},
    {UINT64_C(0xf64335bcf065d37d), UINT64_C(0x4d4617b5ff4a16d5)},
    {UINT64_C(0xf8a95fcf88747d94), UINT64_C(0x75a44c6397ce912a)},
    {UINT64_C(0xfb158592be068d2e), UINT64_C(0xeed6e2f0f0d56712)},
    {UINT64_C(0xfd87b5f28300ca0d), UINT64_C(0x8bca9d6e188853fc)},
    {UINT64_C(0x8000000000000000), UINT64_C(0x0000000000000000)},
    {UINT64_C(0x813f3978f8940984), UINT64_C(0x4000000000000000)},
    {UINT64_C(0x82818f1281ed449f), UINT64_C(0xbff8f10e7a8921a4)},
    {UINT64_C(0x83c7088e1aab65db), UINT64_C(0x792667c6da79e0fa)},
    {UINT64_C(0x850fadc09923329e), UINT64_C(0x03e2cf6bc604ddb0)},
    {UINT64_C(0x865b86925b9bc5c2), UINT64_C(0x0b8a2392ba45a9b2)},
    {UINT64_C(0x87aa9aff79042286), UINT64_C(0x90fb44d2f05d0842)},
    {UINT64_C(0x88fcf317f22241e2), UINT64_C(0x441fece3bdf81f03)},
    {UINT64_C(0x8a5296ffe33cc92f), UINT64_C(0x82bd6b70d99aaa6f)},
    {UINT64_C(0x8bab8eefb6409c1a), UINT64_C(0x1ad089b6c2f7548e)},
    {UINT64_C(0x8d07e33455637eb2), UINT64_C(0xdb0b487b6423e1e8)},
    {UINT64_C(0x8e679c2f5e44ff8f), UINT64_C(0x570f09eaa7ea7648)},
    {UINT64_C(0x8fcac257558ee4e6), UINT64_C(0x213a4f0aa5e8a7b1)}};

typedef struct scaled {
    uint64_t word[3]; /* high to low; the true number is less than 4 units of word[1] larger */
    int exponent;     /* of 2 */
    bool exact;
} scaled;

static int floor_quotient(int a, int b) { return a / b - (a % b < 0); }

/* a b = high, low. */
static uint64_t multiply(uint64_t a, uint64_t b, uint64_t *low)
{
    const uint64_t mask = UINT32_MAX, a0 = a & mask, a1 = a >> 32, b0 = b & mask, b1 = b >> 32;
    const uint64_t lowest = a0 * b0, cross = a1 * b0 + (lowest >> 32);
    const uint64_t middle = a0 * b1 + (cross & mask);
    *low = middle << 32 | (lowest & mask);
    return a1 * b1 + (cross >> 32) + (middle >> 32);
}

/* m x = word[3], high to low, of two words x. */
static void multiply_words(uint64_t m, const uint64_t x[2], uint64_t word[3])
{
    uint64_t carried;
    const uint64_t middle = multiply(m, x[1], &word[2]);
    word[0] = multiply(m, x[0], &carried);
    word[1] = carried + middle;
    word[0] += word[1] < middle;
}

/* The leading 128 bits of 10^k, -364 <= k < 364; returns whether they are all. */
static bool find_power(int k, uint64_t power[2])
{
    const int a = floor_quotient(k, FINE);
    const uint64_t *fine = fine_power[k - FINE * a], *coarse = coarse_power[a - COARSE_LEAST];
    uint64_t upper[3], lower[3];
    if (a == 0) {
        memcpy(power, fine, 2 * sizeof *power);
        return true;
    }
    multiply_words(fine[0], coarse, upper);
    multiply_words(fine[1], coarse, lower);
    /* upper 2^64 + lower, of four words */
    const uint64_t third = upper[2] + lower[1], carry = third < lower[1];
    const uint64_t second = upper[1] + lower[0], sum = second + carry;
    const uint64_t first = upper[0] + (second < lower[0]) + (sum < carry);
    const int shift = !(first >> 63);
    power[0] = shift ? first << 1 | sum >> 63 : first;
    power[1] = shift ? sum << 1 | third >> 63 : sum;
    return a == 1 && (shift ? third << 1 : third) == 0 && lower[2] == 0;
}

/* m > 0 times 2^shift, at least 2^63; *exponent falls by shift. */
static uint64_t shift_up(uint64_t m, int *exponent)
{
    for (int shift = 32; shift > 0; shift /= 2) {
        if (m >> (64 - shift)) continue;
        m <<= shift;
        *exponent -= shift;
    }
    return m;
}

/* m 10^k, m at least 2^63. */
static scaled scale(uint64_t m, int k)
{
    scaled x = {.exponent = floor_quotient(217706 * k, 65536) - 127}; /* log2 10 */
    uint64_t power[2];
    x.exact = find_power(k, power);
    multiply_words(m, power, x.word);
    return x;
}

/* The nearest integer of x 2^-(shift + 128), 0 < shift < 64, into *n; false: it may be the next. */
static bool round_scaled(const scaled *x, int shift, uint64_t *n)
{
    const uint64_t half = UINT64_C(1) << (shift - 1), rest = x->word[0] & (2 * half - 1);
    const bool is_middle = rest == half && x->word[1] == 0 && x->word[2] == 0;
    *n = x->word[0] >> shift;
    *n += x->exact && is_middle ? *n & 1 : rest >= half;
    return x->exact || rest != half - 1 || x->word[1] < UINT64_MAX - 3;
}

/* ---- reading ------------------------------------------------------------------------------- */

enum { SHORT = 19 /* digits that 64 bits hold */, LEAST_POWER = -340, GREATEST_POWER = 310 };
enum { MAX_DIGITS = 770, MAX_EXPONENT = 100000000 };

static bool is_digit(char c) { return (unsigned char)(c - '0') < 10; }

/* digits[.digits] as an integer times 10^exponent. */
typedef struct mantissa {
    size_t length;  /* in the text, 0: there is no digit */
    uint64_t value; /* with SHORT digits at most */
    int count;      /* of digits from the first that is not 0, at most MAX_EXPONENT */
    long exponent;
} mantissa;

static mantissa read_mantissa(const char *text, size_t length)
{
    mantissa x = {.value = 0};
    size_t i = 0, point = 0;
    for (; i < length; i++) {
        const unsigned digit = (unsigned char)(text[i] - '0');
        if (digit < 10) {
            x.value = 10 * x.value + digit;
            x.count += x.count > 0 || digit > 0;
            x.exponent -= (long)point;
        } else if (text[i] == '.' && point == 0) {
            point = 1;
        } else {
            break;
        }
    }
    if (i > point) x.length = i;
    return x;
}

/* The exponent part at text[i], if it is complete; beyond MAX_EXPONENT its size does not matter.
 * Returns where it ends. */
static size_t read_exponent(long *exponent, const char *text, size_t i, size_t length)
{
    size_t j = i + 1;
    if (i >= length || (text[i] != 'e' && text[i] != 'E')) return i;
    bool negative = j < length && text[j] == '-';
    if (j < length && (text[j] == '-' || text[j] == '+')) j++;
    if (j >= length || !is_digit(text[j])) return i;
    long x = 0;
    for (; j < length && is_digit(text[j]); j++) {
        if (x < MAX_EXPONENT) x = 10 * x + (text[j] - '0');
    }
    *exponent += negative ? -x : x;
    return j;
}

/* The double nearest to n 10^k; false: not known, or not normal. */
static bool find_nearest(uint64_t n, long k, double *value)
{
    if (n == 0) *value = 0.0;
    if (n == 0) return true;
    if (k < LEAST_POWER || k > GREATEST_POWER) return false;
    int exponent = 0;
    n = shift_up(n, &exponent);
    const scaled x = scale(n, (int)k);
    const int top = (int)(x.word[0] >> 63); /* the product has 191 or 192 bits */
    exponent += x.exponent + 190 + top;
    if (exponent < DBL_MIN_EXP - 1 || exponent >= DBL_MAX_EXP - 1) return false;
    if (!round_scaled(&x, 10 + top, &n)) return false;
    /* The leading bit of n, 2^52 or 2^53, adds to the exponent. */
    n += (uint64_t)(exponent + DBL_MAX_EXP - 2) << (DBL_MANT_DIG - 1);
    memcpy(value, &n, sizeof n);
    return true;
}

/* The digits of text[length] times 10^exponent. */
static double find_by_library(const char *text, size_t length, long exponent)
{
    char digits[MAX_DIGITS + 32];
    int count = 0;
    bool lost = false; /* a digit that is not 0 did not fit */
    for (size_t i = 0; i < length; i++) {
        if (text[i] == '.' || (count == 0 && text[i] == '0')) continue;
        if (count < MAX_DIGITS) {
            digits[count++] = text[i];
        } else {
            lost |= text[i] != '0';
            exponent++;
        }
    }
    if (lost) digits[count++] = '1', exponent--;
    snprintf(digits + count, sizeof digits - (size_t)count, "e%ld", exponent);
    return strtod(digits, NULL);
}

size_t dal__read_decimal(const char *text, size_t length, double *value)
{
    if (length > MAX_EXPONENT) length = MAX_EXPONENT;
    mantissa x = read_mantissa(text, length);
    if (x.length == 0) return 0;
    const size_t end = read_exponent(&x.exponent, text, x.length, length);
    if (x.count > SHORT || !find_nearest(x.value, x.exponent, value))
        *value = find_by_library(text, x.length, x.exponent);
    return end;
}

dal_status dal__parse_number(const char *text, size_t length, double *value)
{
    DAL_REQUIRE(text && value, NULL);
    const size_t sign = length > 0 && (text[0] == '+' || text[0] == '-');
    double size;
    const size_t read = dal__read_decimal(text + sign, length - sign, &size);
    if (read == 0 || read != length - sign) return DAL_STATUS_SYNTAX;
    if (!isfinite(size)) return DAL_STATUS_TOO_LARGE;
    *value = sign && text[0] == '-' ? -size : size;
    return DAL_STATUS_OK;
}

/* ---- writing ------------------------------------------------------------------------------- */

enum { DIGITS = 17 };

/* x = m 2^exponent for x > 0, m at least 2^63. */
static uint64_t normalise(double x, int *exponent)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    const int biased = (int)(bits >> (DBL_MANT_DIG - 1));
    const uint64_t leading = UINT64_C(1) << (DBL_MANT_DIG - 1), m = bits & (leading - 1);
    *exponent = (biased > 0 ? biased : 1) - DBL_MAX_EXP - DBL_MANT_DIG + 2;
    return shift_up(biased > 0 ? m | leading : m, exponent);
}

/* The 17 digits of x > 0 as an integer, x ~ n 10^(*exponent - 16).  They are always known: y is
 * right to 2^-68, and where it is not exact, no x 10^k is within 2^-65 of the middle of two such
 * integers (the nearest, 5592117679628511 2^164 10^-49, is 3.7e-20 from one: by continued
 * fractions for each exponent). */
static uint64_t find_digits(double x, int *exponent)
{
    const uint64_t limit = UINT64_C(100000000000000000); /* 10^17 */
    int binary;
    uint64_t n, m = normalise(x, &binary);
    int ten = floor_quotient(78913 * (binary + 63), 262144); /* log10 2; right, or 1 too small */
    scaled y = scale(m, DIGITS - 1 - ten);
    if (y.word[0] >> (-(y.exponent + binary) - 128) >= limit) y = scale(m, DIGITS - 1 - ++ten);
    round_scaled(&y, -(y.exponent + binary) - 128, &n);
    *exponent = ten + (n == limit);
    return n == limit ? limit / 10 : n;
}

/* The 17 digits of n, in two halves that a processor divides at the same time. */
static void write_digits(char *digit, uint64_t n)
{
    uint32_t high = (uint32_t)(n / 100000000), low = (uint32_t)(n % 100000000);
    for (int i = 7; i >= 0; i--, high /= 10, low /= 10) {
        digit[i + 1] = (char)('0' + high % 10);
        digit[i + 9] = (char)('0' + low % 10);
    }
    digit[0] = (char)('0' + high);
}

static char *put_exponent(char *at, int exponent)
{
    const int size = abs(exponent);
    *at++ = 'e';
    *at++ = exponent < 0 ? '-' : '+';
    if (size >= 100) *at++ = (char)('0' + size / 100);
    *at++ = (char)('0' + size / 10 % 10);
    *at++ = (char)('0' + size % 10);
    return at;
}

/* The digits digit[count] with a point after the first `whole`, which may be more or below 1. */
static char *put_digits(char *at, const char *digit, int count, int whole)
{
    if (whole <= 0) {
        memcpy(at, "0.000", 5);
        at += 2 - whole;
        memcpy(at, digit, (size_t)count);
        return at + count;
    }
    const int before = whole < count ? whole : count;
    memcpy(at, digit, (size_t)before);
    memset(at + before, '0', (size_t)(whole - before));
    at += whole;
    if (count <= whole) return at;
    *at++ = '.';
    memcpy(at, digit + whole, (size_t)(count - whole));
    return at + count - whole;
}

static int put_word(char *text, const char *word)
{
    strcpy(text, word);
    return (int)strlen(word);
}

int dal__format_number(char *text, double x)
{
    int exponent, count = DIGITS;
    char digit[DIGITS], *at = text;
    if (!text) return 0;
    if (isnan(x)) return put_word(text, "nan");
    if (signbit(x)) *at++ = '-';
    if (isinf(x)) return (int)(at - text) + put_word(at, "inf");
    if (x == 0.0) return (int)(at - text) + put_word(at, "0");
    write_digits(digit, find_digits(fabs(x), &exponent));
    while (digit[count - 1] == '0') count--;
    if (exponent >= -4 && exponent < DIGITS) {
        at = put_digits(at, digit, count, exponent + 1);
    } else {
        at = put_digits(at, digit, count, 1);
        at = put_exponent(at, exponent);
    }
    *at = '\0';
    return (int)(at - text);
}

/* ---- numbers as decimals ------------------------------------------------------------------- */

/* n 10^k - x for an n that has x > 0 as its nearest double.  The power of ten is the sum of two
 * doubles, right to 2^-98; n is exact. */
static double find_rest(double x, double n, int k)
{
    double power = 1.0, rest = 0.0;
    for (int i = abs(k); i > 0; i--) {
        const double high = 10.0 * power, low = fma(10.0, power, -high) + 10.0 * rest;
        power = high + low;
        rest = low - (power - high);
    }
    const double difference =
        k < 0 ? (fma(-x, power, n) - x * rest) / power : fma(n, power, -x) + n * rest;
    return isfinite(difference) ? difference : 0.0;
}

dal__decimal dal__as_decimal(double x)
{
    const uint64_t unit = 100; /* of the last of 15 digits */
    int exponent;
    double value;
    if (!(fabs(x) >= DBL_MIN && isfinite(x))) return (dal__decimal){x, 0.0};
    uint64_t n = (find_digits(fabs(x), &exponent) + unit / 2) / unit;
    int k = exponent - DBL_DIG + 1;
    if (!find_nearest(n, k, &value) || value != fabs(x)) return (dal__decimal){x, 0.0};
    for (; n % 10 == 0; k++) n /= 10;
    return (dal__decimal){x, copysign(1.0, x) * find_rest(fabs(x), (double)n, k)};
}

/* The sum, with its rest below the last digit of its value. */
static dal__decimal add_decimals(dal__decimal a, dal__decimal b)
{
    const double sum = a.value + b.value, added = sum - a.value;
    const double rest = (a.value - (sum - added)) + (b.value - added) + (a.rest + b.rest);
    return (dal__decimal){sum + rest, rest - ((sum + rest) - sum)};
}

dal__decimal dal__decimal_difference(double a, double b)
{
    const dal__decimal x = dal__as_decimal(a), y = dal__as_decimal(b);
    return add_decimals(x, (dal__decimal){-y.value, -y.rest});
}

dal__decimal dal__decimal_multiple(double x, double factor)
{
    const dal__decimal one = dal__as_decimal(x);
    const double high = one.value * factor;
    return add_decimals((dal__decimal){high, fma(one.value, factor, -high)},
                        (dal__decimal){one.rest * factor, 0.0});
}

double dal__add_share(double from, dal__decimal length, double count, double whole)
{
    const double high = length.value * count,
                 low = fma(length.value, count, -high) + length.rest * count;
    const double share = high / whole, rest = (fma(-share, whole, high) + low) / whole;
    return add_decimals(dal__as_decimal(from), (dal__decimal){share, rest}).value;
}
