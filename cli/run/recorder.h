/* recorder.h - a run on its way: rows, statistics, progress and checkpoints. */
#ifndef DAL_CLI_RECORDER_H
#define DAL_CLI_RECORDER_H

#include "io/trajectory_writer.h"
#include "request.h"
#include "run_directory.h"

/* How progress is told.  code, word */
#define PROGRESS_LIST(X) X(AUTO, auto) X(JSON, json) X(OFF, off)

typedef enum cli_progress_kind {
#define X(code, word) PROGRESS_##code,
    PROGRESS_LIST(X)
#undef X
} cli_progress_kind;

typedef struct run_recorder {
    const run_request *request;
    run_directory
        *dir; /* NULL: the rows go to a file or to stdout and nothing is kept beside them */
    trajectory_writer writer;
    int dimension, observables, columns;
    double *values;             /* [1 + dimension + observables] t, state, all observables */
    double *row;                /* [columns] the same without |p|, |pi|, |pi_e| */
    char **names;               /* [1 + dimension + observables] of values */
    int *column;                /* [columns] which of values a column is */
    dal_statistics *statistics; /* [observables] */
    dal_trend *trend;           /* [observables] when the run is finished or has failed */
    run_position position;
    dal_observer observer;
    double interval;       /* seconds between checkpoints */
    double since, saved;   /* when the present stretch of steps began; the last checkpoint */
    double begun;          /* t at which this process took the run up, */
    long long begun_steps; /* and its steps */
    double stretch;        /* seconds spent in steps and rows since */
    double told_progress;  /* when the last line of JSON was written */
    cli_progress_kind progress;
    int (*stop)(void *user); /* whether to end the run; cli_interrupted unless set */
    void *stop_user;
    int quiet; /* no line of progress: no terminal, or the rows themselves go to it */
    int told;  /* exit status of a failure of the program's own, already printed */
} run_recorder;

/* Opens the table: output is a file or "-"; with a dir, its trajectory.npy, going on where its
 * checkpoint says.  recorder_close it in any case. */
int recorder_open(run_recorder *recorder, const run_request *request, run_directory *dir,
                  const char *output);
void recorder_close(run_recorder *recorder);
/* Integrates to the end.  Returns CLI_DONE; CLI_FAILED and the like with the reason in *error;
 * CLI_SIGNAL; or CLI_IO and such that has been told, with no message in *error. */
int recorder_run(run_recorder *recorder, dal_error *error);
int recorder_is_finished(const run_recorder *recorder);
const char *recorder_observable_name(const run_recorder *recorder, int i);

/* Reads a word of the list above.  Returns CLI_DONE or prints and returns CLI_USAGE. */
int progress_parse(const char *text, cli_progress_kind *kind);
/* Tells how far the run has come, not too often; at the end in any case, where that is asked. */
void progress_show(run_recorder *recorder, double t, int at_the_end);

/* The summary: one table for the eye, or summary.csv. */
void summary_print(FILE *out, const run_recorder *recorder);
int summary_write(const run_recorder *recorder, const char *path);

#endif
