/* decimal.h - reads decimal numbers. */
#ifndef DAL_DECIMAL_H
#define DAL_DECIMAL_H

#include <stddef.h>

/* Reads the longest decimal number [digits][.digits][e[+-]digits] at the start of text: how many
 * characters it has (0: none there) and its nearest double, infinite when it is too large.  The
 * same under every locale. */
size_t dal__read_decimal(const char *text, size_t length, double *value);

#endif
