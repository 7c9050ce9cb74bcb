/* number.c - decimal text to double, the same under every locale. */
#include "error.h"
#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LONGEST = 300 };

static size_t digits(const char *text, size_t length, size_t at)
{
    while (at < length && text[at] >= '0' && text[at] <= '9') at++;
    return at;
}

/* Where the exponent that begins at `at` ends; `at` itself if there is none. */
static size_t exponent(const char *text, size_t length, size_t at)
{
    if (at >= length || (text[at] != 'e' && text[at] != 'E')) return at;
    size_t first = at + 1;
    if (first < length && (text[first] == '+' || text[first] == '-')) first++;
    const size_t end = digits(text, length, first);
    return end > first ? end : at;
}

/* Whether text is one decimal number; *point is the place of its point, or length. */
static int is_decimal(const char *text, size_t length, size_t *point)
{
    const size_t sign = length > 0 && (text[0] == '+' || text[0] == '-');
    const size_t whole = digits(text, length, sign);
    size_t at = whole, count = whole - sign;
    *point = length;
    if (at < length && text[at] == '.') {
        *point = at;
        at = digits(text, length, whole + 1);
        count += at - whole - 1;
    }
    return count > 0 && exponent(text, length, at) == length;
}

dal_status dal_parse_number(const char *text, size_t length, double *value)
{
    char buffer[LONGEST + 16];
    size_t point;
    if (!is_decimal(text, length, &point)) return DAL_SYNTAX;
    /* strtod wants the locale's own point, which may be several bytes long. */
    const char *local = localeconv()->decimal_point;
    const size_t width = strlen(local), skip = point < length;
    if (length > LONGEST || width > 15) return DAL_TOO_LARGE;
    memcpy(buffer, text, point);
    if (skip) memcpy(buffer + point, local, width);
    const size_t tail = point + skip * width;
    memcpy(buffer + tail, text + point + skip, length - point - skip);
    buffer[tail + length - point - skip] = '\0';
    *value = strtod(buffer, NULL);
    return isfinite(*value) ? DAL_OK : DAL_TOO_LARGE;
}
