/* error.h - how the library fills a caller's dal_error. */
#ifndef DAL_ERROR_H
#define DAL_ERROR_H

#include "dalembert.h"

#if defined(__GNUC__)
#define DAL__PRINTF(f, a) __attribute__((format(printf, f, a)))
#else
#define DAL__PRINTF(f, a)
#endif

/* Returns the status of a call that failed.  A compiler without the hint takes the code behind
 * several of these for cold and leaves it slow. */
#define DAL_TRY(expression)                                                                        \
    do {                                                                                           \
        dal_status dal__s = (expression);                                                          \
        if (__builtin_expect(dal__s != DAL_OK, 0)) return dal__s;                                  \
    } while (0)

/* Fills *error (may be NULL) and returns status, so that a caller can write
 *     return dal__fail(error, DAL_MEMORY, "no memory for a batch");
 * The error is about no text: its line and column are 0. */
#define dal__fail(error, status, ...) dal__fail_at(error, status, 0, 0, __VA_ARGS__)
/* The same for an error at a place of the user's text, where lines and columns begin with 1. */
dal_status dal__fail_at(dal_error *error, dal_status status, int line, int column,
                        const char *format, ...) DAL__PRINTF(5, 6);

/* "unknown WHAT 'NAME'; did you mean 'NEAREST'?" with the status DAL_NAME; see dal_nearest. */
#define dal__unknown(error, ...) dal__unknown_at(error, 0, 0, __VA_ARGS__)
dal_status dal__unknown_at(dal_error *error, int line, int column, const char *what,
                           const char *name, const char *const *names, int count);

#endif
