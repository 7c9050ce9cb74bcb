/* error.h - how the library fills a caller's dal_error, and reads numbers. */
#ifndef DAL_ERROR_H
#define DAL_ERROR_H

#include "dalembert.h"

#if defined(__GNUC__)
#define DAL__PRINTF(f, a) __attribute__((format(printf, f, a)))
#else
#define DAL__PRINTF(f, a)
#endif

/* Fills *error (may be NULL) and returns status, so that a caller can write
 *     return dal__error(error, DAL_NAME, line, column, "unknown name '%s'", name); */
dal_status dal__error(dal_error *error, dal_status status, int line, int column, const char *format,
                      ...) DAL__PRINTF(5, 6);

/* "unknown WHAT 'NAME'; did you mean 'NEAREST'?" with the status DAL_NAME; see dal_nearest. */
dal_status dal__unknown(dal_error *error, int line, int column, const char *what, const char *name,
                        const char *const *names, int count);

/* Reads the longest decimal number [digits][.digits][e[+-]digits] at the start of text: how many
 * characters it has (0: none there) and its nearest double, infinite when it is too large.  The
 * same under every locale. */
size_t dal__read_decimal(const char *text, size_t length, double *value);

#define DAL_TRY(expression)                                                                        \
    do {                                                                                           \
        dal_status dal__s = (expression);                                                          \
        if (dal__s != DAL_OK) return dal__s;                                                       \
    } while (0)

#endif
