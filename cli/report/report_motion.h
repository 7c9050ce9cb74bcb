/* report_motion.h - the motion of a run: where its body is at equal intervals of time.
 *
 * The page has it as JSON, with each number of the pose as 16-bit integers between its least and
 * its largest value, little-endian, in base64; report.js plays it.  See docs/formats.md. */
#ifndef DAL_CLI_REPORT_MOTION_H
#define DAL_CLI_REPORT_MOTION_H

#include "dalembert_program.h"
#include "io/json.h"

#include <stdbool.h>

/* Frames of a motion on the page of a study, of which there may be many, and on a run's page; two
 * of five numbers a frame are at most 40 and 300 kB, and as much beside it. */
enum { MOTION_STUDY_FRAMES = 1500, MOTION_RUN_FRAMES = 6000 };

typedef struct motion {
    dal_body body;
    char axis[2][64];
    char method[128];
    char part[64];           /* of the run: "the last 512 steps"; "": all of it */
    double step, start, end; /* 0: it is no run's; the times of the first and the last frame */
    bool is_plane;           /* the axes have one scale */
    bool is_smooth;          /* the path may be drawn through the frames; otherwise they are rows */
    int frames;              /* 0: there is nothing to show */
    double *t;               /* [frames] of the states that the frames show */
    double (*pose)[DAL_PICTURE_COUNT];
} motion;

/* Reads the run in a directory, the last of its steps where its rows are too far apart and these
 * are kept; and, unless exact is NULL, the exact solution beside it, while it is known.  Returns
 * CLI_DONE, or prints and returns an exit status; free both in any case. */
int motion_read(motion *m, motion *exact, const char *run, int max_frames);
void motion_free(motion *m);
/* The larger side of the path. */
double motion_extent(const motion *m);
/* Writes it as a JSON object. */
void motion_write(json_writer *data, const motion *m);

#endif
