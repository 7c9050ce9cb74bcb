/* dalembert_status.h - statuses and errors.
 *
 * A part of dalembert.h, which has the conventions. */
#ifndef DALEMBERT_STATUS_H
#define DALEMBERT_STATUS_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- statuses ------------------------------------------------------------------------------ */

/* All statuses: STATUS(code, text). */
#define DAL_STATUS_LIST(STATUS)                                                                    \
    STATUS(OK, "done")                                                                             \
    STATUS(MEMORY, "out of memory")                                                                \
    STATUS(ARGUMENT, "argument out of range")                                                      \
    STATUS(SYNTAX, "syntax error")                                                                 \
    STATUS(NAME, "unknown name")                                                                   \
    STATUS(MODEL, "the model cannot be used")                                                      \
    STATUS(TOO_LARGE, "too large")                                                                 \
    STATUS(INCONSISTENT, "a constraint is violated")                                               \
    STATUS(RANK, "the constraints are rank-deficient")                                             \
    STATUS(UNSUPPORTED, "the integrator needs what the system lacks")                              \
    STATUS(SINGULAR, "a constraint became singular")                                               \
    STATUS(SINGULAR_MASS, "the mass matrix became singular")                                       \
    STATUS(NOT_FINITE, "a value is not finite")                                                    \
    STATUS(NOT_CONVERGED, "the implicit equations did not converge")                               \
    STATUS(GAUGE, "the gauge variable e reached zero")                                             \
    STATUS(IO, "input or output failed")                                                           \
    STATUS(INTERRUPTED, "interrupted")                                                             \
    STATUS(EVENT, "an event cannot be passed")                                                     \
    STATUS(STOPPED, "stopped by an event")

/* The result of a function: DAL_STATUS_OK, which is 0, or the kind of failure. */
typedef enum dal_status {
#define CODE(code, text) DAL_STATUS_##code,
    DAL_STATUS_LIST(CODE)
#undef CODE
        DAL_STATUS_COUNT
} dal_status;

/* The name of a status in tables and in Python, "DAL_SINGULAR" of DAL_STATUS_SINGULAR; "DAL_?" for
 * other numbers. */
const char *dal_status_name(dal_status status);
/* The text of a status, "a constraint became singular". */
const char *dal_status_text(dal_status status);

enum { DAL_MESSAGE_SIZE = 320 /* bytes of a message, with its NUL */ };
/* The caller's own record of a failure. */
typedef struct dal_error {
    dal_status status;              /* what the function returned */
    int line, column;               /* place in the text that was read, from 1; 0: none */
    char message[DAL_MESSAGE_SIZE]; /* names the object and the value; no newline */
} dal_error;

#ifdef __cplusplus
}
#endif
#endif
