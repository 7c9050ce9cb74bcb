/* decimal.c - decimal numbers to the nearest double, under every locale.
 *
 *     d1 d2 ... dk . dk+1 ... dn e x  =  d1 ... dn e (x - n + k)
 *
 * The second form has no decimal point, the one thing strtod looks up in the locale.  Two doubles
 * and the point halfway between them have at most 767 digits, so of the digits behind that only
 * matters whether one is not 0: a last digit 1 says so. */
#include "error.h"
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST_DIGITS = 770, FARTHEST = 100000000 };

typedef struct digits {
    char text[MOST_DIGITS + 32];
    int kept;       /* significant digits in text */
    long exponent;  /* of the last of them */
    bool any, lost; /* a digit was seen; one that is not 0 did not fit */
} digits;

static bool is_digit(char c) { return c >= '0' && c <= '9'; }

static void take(digits *d, char c, bool behind_point)
{
    d->any = true;
    if (d->kept < MOST_DIGITS) {
        if (d->kept > 0 || c != '0') d->text[d->kept++] = c;
        d->exponent -= behind_point;
        return;
    }
    d->lost |= c != '0';
    d->exponent += !behind_point;
}

static size_t take_all(digits *d, const char *text, size_t i, size_t length, bool behind_point)
{
    while (i < length && is_digit(text[i])) take(d, text[i++], behind_point);
    return i;
}

/* The exponent part at text[i], if there is a whole one; beyond FARTHEST its size is all the same.
 */
static size_t take_exponent(digits *d, const char *text, size_t i, size_t length)
{
    size_t j = i + 1;
    if (i >= length || (text[i] != 'e' && text[i] != 'E')) return i;
    bool negative = j < length && text[j] == '-';
    if (j < length && (text[j] == '-' || text[j] == '+')) j++;
    if (j >= length || !is_digit(text[j])) return i;
    long x = 0;
    for (; j < length && is_digit(text[j]); j++) {
        if (x < FARTHEST) x = 10 * x + (text[j] - '0');
    }
    d->exponent += negative ? -x : x;
    return j;
}

size_t dal__read_decimal(const char *text, size_t length, double *value)
{
    digits d = {.kept = 0};
    if (length > FARTHEST) length = FARTHEST;
    size_t i = take_all(&d, text, 0, length, false);
    if (i < length && text[i] == '.') i = take_all(&d, text, i + 1, length, true);
    if (!d.any) return 0;
    i = take_exponent(&d, text, i, length);
    if (d.lost) d.text[d.kept++] = '1', d.exponent--;
    if (d.kept == 0) d.text[d.kept++] = '0';
    snprintf(d.text + d.kept, sizeof d.text - (size_t)d.kept, "e%ld", d.exponent);
    *value = strtod(d.text, NULL);
    return i;
}

dal_status dal_parse_number(const char *text, size_t length, double *value)
{
    DAL_REQUIRE(text, NULL);
    DAL_REQUIRE(value, NULL);
    const size_t sign = length > 0 && (text[0] == '+' || text[0] == '-');
    double size;
    const size_t read = dal__read_decimal(text + sign, length - sign, &size);
    if (read == 0 || read != length - sign) return DAL_SYNTAX;
    if (!isfinite(size)) return DAL_TOO_LARGE;
    *value = sign && text[0] == '-' ? -size : size;
    return DAL_OK;
}
