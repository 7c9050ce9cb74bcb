/* arguments.h - what public functions require of their arguments. */
#ifndef DAL_ARGUMENTS_H
#define DAL_ARGUMENTS_H

#include "core/error.h"
#include <stdbool.h>

/* The errors that an argument is NULL, or negative; they return DAL_ARGUMENT. */
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

/* Whether a point has coordinates and velocities. */
static inline bool dal__has_state(const dal_point *at) { return at && at->q && at->v; }

/* Checks that count settings are there and have names; what: how a message calls them, in the
 * plural. */
dal_status dal__check_settings(const dal_setting *settings, int count, const char *what,
                               dal_error *error);
/* Sets the values of all parameters: those of the system, and settings over them.  Errors: DAL_NAME
 * with the nearest name, not_finite where a value is not finite. */
dal_status dal__set_parameters(const dal_system *system, const dal_setting *settings, int count,
                               dal_status not_finite, double *value, dal_error *error);
/* Checks that a spec has a system and its settings; ignores the rest of it. */
dal_status dal__check_spec(const dal_run_spec *spec, dal_error *error);

#endif
