/* error.h - how the library fills a caller's dal_error, and what it requires of arguments. */
#ifndef DAL_ERROR_H
#define DAL_ERROR_H

#include "dalembert_status.h"
#include <stdbool.h>

enum { DAL__MAX_SHOWN = 63 /* letters of a name in a message; others are cut */ };

#if defined(__GNUC__)
#define DAL__PRINTF(f, a) __attribute__((format(printf, f, a)))
#else
#define DAL__PRINTF(f, a)
#endif

/* Returns the status of a call that failed.  A compiler without the hint takes the code after
 * several of these for cold and leaves it slow. */
#define DAL_TRY(expression)                                                                        \
    do {                                                                                           \
        dal_status dal__s = (expression);                                                          \
        if (__builtin_expect(dal__s != DAL_STATUS_OK, 0)) return dal__s;                           \
    } while (0)

/* Fills *error (may be NULL) and returns status, so that a caller can write
 *     return dal__fail(error, DAL_STATUS_MEMORY, "no memory for a batch");
 * The error is about no text: its line and column are 0. */
#define dal__fail(error, status, ...) dal__fail_at(error, status, 0, 0, __VA_ARGS__)
/* The same for an error at a place of the user's text, where lines and columns begin with 1. */
dal_status dal__fail_at(dal_error *error, dal_status status, int line, int column,
                        const char *format, ...) DAL__PRINTF(5, 6);
/* The error DAL_STATUS_MEMORY. */
dal_status dal__memory_error(dal_error *error);

/* "unknown WHAT 'NAME'; did you mean 'NEAREST'?" with the status DAL_STATUS_NAME; see
 * dal__nearest_name. */
#define dal__unknown(error, ...) dal__unknown_at(error, 0, 0, __VA_ARGS__)
dal_status dal__unknown_at(dal_error *error, int line, int column, const char *what,
                           const char *name, const char *const *names, int count);

/* ---- arguments of public functions ---- */

/* The errors that an argument is NULL, or negative; they return DAL_STATUS_ARGUMENT. */
dal_status dal__missing(dal_error *error, const char *function, const char *argument);
dal_status dal__negative(dal_error *error, const char *function, const char *argument,
                         long long value);

/* Where error is NULL, of several pointers: DAL_REQUIRE(a && b, NULL). */
#define DAL_REQUIRE(pointer, error)                                                                \
    do {                                                                                           \
        if (!(pointer)) return dal__missing(error, __func__, #pointer);                            \
    } while (0)
#define DAL_REQUIRE_COUNT(count, error)                                                            \
    do {                                                                                           \
        if ((count) < 0) return dal__negative(error, __func__, #count, count);                     \
    } while (0)

#endif
