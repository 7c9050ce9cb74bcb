/* report_body.h - the outlines of bodies, as the path of a run and its motion show them.
 *
 * A body has a length of 2, heading along x.  Its shapes are lines and circles; each is narrowed
 * across x by the width, turned about a pivot by the steer, and then moves with the body. */
#ifndef DAL_CLI_REPORT_BODY_H
#define DAL_CLI_REPORT_BODY_H

#include "dalembert_program.h"

#include <stdbool.h>

enum { BODY_POINTS = 6 };

typedef struct body_shape {
    dal_body body;
    double pivot[2], turn; /* about the pivot by turn times the steer */
    bool is_narrowed;      /* y is multiplied by the width */
    double radius;         /* of a circle about the pivot; 0: it is a line */
    int count;
    double at[BODY_POINTS][2]; /* of the line, from the pivot */
} body_shape;

/* The shapes of a body, one after the other: the one after a shape, the first one for NULL; NULL
 * after the last. */
const body_shape *body_next(dal_body body, const body_shape *shape);
extern const char *const body_name[DAL_BODY_COUNT];

#endif
