/* constraint_rows.h - values of constraints at a point and their derivatives, a row for each. */
#ifndef DAL_CORE_CONSTRAINT_ROWS_H
#define DAL_CORE_CONSTRAINT_ROWS_H

#include "core/error.h"
#include "dalembert_system.h"
#include <stdbool.h>

/* Some of the constraints of a system at a point; the caller places the numbers.  D, A and B may
 * have more rows and columns than the constraints: these are for equations of the caller. */
typedef struct dal__constraint_rows {
    const dal_system *system;
    dal_point at;
    bool of_coordinates; /* g and g_q in place of D and A */
    int first, count;    /* which of the m constraints */
    int rows;            /* of D, A and B, at least count */
    double *D, *A, *B;   /* [rows], [rows*n], [n*rows]: W^-1 A^T */
    double *out;         /* [m + 2*m*n] */
} dal__constraint_rows;

/* Evaluates D, A and B by `callback`, the system's constraint or projection; nothing where m is 0.
 * Errors, which name the place: as of the callbacks. */
dal_status dal__evaluate_rows(dal__constraint_rows *c, dal_callback *callback, const char *place,
                              dal_error *error);

#endif
