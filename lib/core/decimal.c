/* decimal.c - decimal numbers to the nearest double, under every locale.
 *
 *     d1 d2 ... dk . dk+1 ... dn e x  =  d1 ... dn e (x - n + k)
 *
 * The second form has no decimal point, the only character of strtod that depends on the locale.
 * Two doubles and the point halfway between them have at most 767 digits, so of the digits after
 * these it matters only whether one is not 0: a last digit 1 replaces them. */
#include "core/decimal.h"
#include "core/error.h"
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

enum { MAX_DIGITS = 770, MAX_EXPONENT = 100000000 };

typedef struct digits {
    char text[MAX_DIGITS + 32];
    int count;      /* significant digits in text */
    long exponent;  /* of the last of them */
    bool any, lost; /* a digit was seen; one that is not 0 did not fit */
} digits;

static bool is_digit(char c) { return c >= '0' && c <= '9'; }

static size_t read_digits(digits *d, const char *text, size_t i, size_t length, bool behind_point)
{
    for (; i < length && is_digit(text[i]); i++) {
        const bool fits = d->count < MAX_DIGITS;
        d->any = true;
        if (fits && (d->count > 0 || text[i] != '0')) d->text[d->count++] = text[i];
        if (!fits) d->lost |= text[i] != '0';
        d->exponent += fits ? -(long)behind_point : !behind_point;
    }
    return i;
}

/* The exponent at text[i], if it is complete; beyond MAX_EXPONENT its size does not matter. */
static size_t read_exponent(digits *d, const char *text, size_t i, size_t length)
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
    d->exponent += negative ? -x : x;
    return j;
}

size_t dal__read_decimal(const char *text, size_t length, double *value)
{
    digits d = {.count = 0};
    if (length > MAX_EXPONENT) length = MAX_EXPONENT;
    size_t i = read_digits(&d, text, 0, length, false);
    if (i < length && text[i] == '.') i = read_digits(&d, text, i + 1, length, true);
    if (!d.any) return 0;
    i = read_exponent(&d, text, i, length);
    if (d.lost) d.text[d.count++] = '1', d.exponent--;
    if (d.count == 0) d.text[d.count++] = '0';
    snprintf(d.text + d.count, sizeof d.text - (size_t)d.count, "e%ld", d.exponent);
    *value = strtod(d.text, NULL);
    return i;
}

dal_status dal_parse_number(const char *text, size_t length, double *value)
{
    DAL_REQUIRE(text && value, NULL);
    const size_t sign = length > 0 && (text[0] == '+' || text[0] == '-');
    double size;
    const size_t read = dal__read_decimal(text + sign, length - sign, &size);
    if (read == 0 || read != length - sign) return DAL_SYNTAX;
    if (!isfinite(size)) return DAL_TOO_LARGE;
    *value = sign && text[0] == '-' ? -size : size;
    return DAL_OK;
}
