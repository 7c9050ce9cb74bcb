/* error.h - how the library fills a caller's dal_error, and reads numbers. */
#ifndef DAL_ERROR_H
#define DAL_ERROR_H

#include "dalembert.h"
#include "kernel/try.h"

#if defined(__GNUC__)
#define DAL__PRINTF(f, a) __attribute__((format(printf, f, a)))
#else
#define DAL__PRINTF(f, a)
#endif

/* Fills *error (may be NULL) and returns status, so that a caller can write
 *     return dal__fail(error, DAL_MEMORY, "no memory for a batch");
 * The error is about no text: its line and column are 0. */
dal_status dal__fail(dal_error *error, dal_status status, const char *format, ...)
    DAL__PRINTF(3, 4);
/* The same for an error at a place of the user's text, where lines and columns begin with 1. */
dal_status dal__fail_at(dal_error *error, dal_status status, int line, int column,
                        const char *format, ...) DAL__PRINTF(5, 6);

/* "unknown WHAT 'NAME'; did you mean 'NEAREST'?" with the status DAL_NAME; see dal_nearest. */
dal_status dal__unknown(dal_error *error, const char *what, const char *name,
                        const char *const *names, int count);
dal_status dal__unknown_at(dal_error *error, int line, int column, const char *what,
                           const char *name, const char *const *names, int count);

/* Reads the longest decimal number [digits][.digits][e[+-]digits] at the start of text: how many
 * characters it has (0: none there) and its nearest double, infinite when it is too large.  The
 * same under every locale. */
size_t dal__read_decimal(const char *text, size_t length, double *value);

/* What public functions require of their arguments; they return DAL_ARGUMENT with these. */
dal_status dal__missing(dal_error *error, const char *function, const char *argument);
dal_status dal__negative(dal_error *error, const char *function, const char *argument,
                         long long value);

#define DAL_REQUIRE(pointer, error)                                                                \
    do {                                                                                           \
        if (!(pointer)) return dal__missing(error, __func__, #pointer);                            \
    } while (0)
#define DAL_REQUIRE_COUNT(count, error)                                                            \
    do {                                                                                           \
        if ((count) < 0) return dal__negative(error, __func__, #count, count);                     \
    } while (0)

/* Whether count settings are there and have names; what they are called, in the plural. */
dal_status dal__check_settings(const dal_setting *settings, int count, const char *what,
                               dal_error *error);
/* Whether a spec has a system and its settings; nothing else of it is looked at. */
dal_status dal__check_spec(const dal_run_spec *spec, dal_error *error);

#endif
