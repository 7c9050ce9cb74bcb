/* report_pose.h - where the body of a run is at each of its rows.
 *
 * A system file says so under `picture`.  Of a system without one a point is shown: over the first
 * of the pairs (x, y), (x1, x2), (y1, y2) of which both are coordinates, or the first two
 * coordinates, or t and the only one. */
#ifndef DAL_CLI_REPORT_POSE_H
#define DAL_CLI_REPORT_POSE_H

#include "dalembert_evaluator.h"
#include "dalembert_program.h"
#include "io/trajectory.h"
#include "run/run_directory.h"
#include "run/simulation.h"

#include <stdbool.h>

typedef struct pose_reader {
    run_directory dir;
    run_simulation simulation;
    trajectory_reader rows;
    dal_evaluator *evaluator;
    double *q, *exact;   /* [n]; [2n] */
    bool is_open;        /* rows */
    bool has_poses;      /* there are rows, and they have q and v */
    dal_body body;       /* what is shown, */
    const char *axis[2]; /* over what, */
    int pair[2];       /* the two coordinates that a system without a picture has for it (-1: t), */
    bool is_plane;     /* and whether they have one scale */
    double small_time; /* for differences */
    double t, pose[DAL_PICTURE_COUNT], rate[DAL_PICTURE_COUNT]; /* rate: the change of the pose */
    bool has_exact; /* the run has an error: the exact solution begins at its start */
} pose_reader;

/* Opens the run in a directory.  Without has_poses there is nothing to show, which is no error.
 * Returns CLI_DONE, or prints and returns an exit status; close it in any case. */
int pose_open(pose_reader *p, const char *run);
/* Reads a row: 1, or 0 after the last one, or -1 after a failure and its message.  What a picture
 * does not define there is NaN. */
int pose_next(pose_reader *p);
/* The pose of another state q, v, which need not be a row's. */
void pose_of(pose_reader *p, double t, const double *q, const double *v, double *pose);
/* Takes another state in place of a row: t, the pose and its rate. */
void pose_set(pose_reader *p, double t, const double *q, const double *v);
/* The pose of the exact solution; false where it has none. */
bool pose_of_exact(pose_reader *p, double t, double *pose);
void pose_close(pose_reader *p);

#endif
