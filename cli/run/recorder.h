/* recorder.h - observes a run: rows, statistics, progress and checkpoints. */
#ifndef DAL_CLI_RECORDER_H
#define DAL_CLI_RECORDER_H

#include "checkpoint.h"
#include "columns.h"
#include "dalembert_statistics.h"
#include "event_log.h"
#include "io/step_record.h"
#include "io/trajectory.h"
#include "native.h"
#include "request_data.h"
#include "run_directory.h"

#include <stdbool.h>

/* The words of --progress, "auto|json|off". */
typedef enum progress_mode { PROGRESS_AUTO, PROGRESS_JSON, PROGRESS_OFF } progress_mode;

/* The row of --progress in a table of options. */
#define PROGRESS_OPTION(settings)                                                                  \
    {                                                                                              \
        "progress", "auto|json|off", "auto",                                                       \
            "shows a line on a terminal, lines of JSON on stderr, or nothing",                     \
            .parse = cli_parse_word, .offset = offsetof(settings, progress)                        \
    }

/* What a run yields, beside its rows. */
typedef struct run_results {
    int observables;
    const char *const *names;   /* [observables] the columns', or NULL */
    dal_statistics *statistics; /* [observables] */
    dal_trend *trend;           /* [observables] when the run is finished or has failed */
    step_record record;         /* of the steps, where they are many more than rows */
    run_position position;
} run_results;

/* Of more observed steps than this for each row a record is kept. */
enum { RECORD_STEPS_A_ROW = 4 };

void run_results_begin(run_results *results, const dal_run *run);
/* Has an observer add the values and scales of observables.  Its user begins with the results. */
void run_results_observe(dal_observer *observer);
void run_results_free(run_results *results);

typedef struct run_recorder {
    run_results results;
    const run_simulation *simulation;
    run_directory *dir; /* NULL: rows go to a file or to stdout, and nothing else is written */
    trajectory_writer writer;
    int dimension;
    run_columns columns;
    double *values; /* [1 + dimension + observables] t, state, all observables */
    double *row;    /* the values that are columns */
    event_log events;
    dal_observer observer;
    record_steps steps;   /* the present ones, for the record */
    native_run native;    /* set by who opens it; all 0: interpreted */
    double interval;      /* seconds between checkpoints */
    double clock;         /* when the clock of steps and rows was started; */
    double saved;         /* when the last checkpoint was */
    double start_time;    /* t at which this process took the run up, */
    long long start_step; /* and its steps; */
    double seconds;       /* seconds in steps and rows since then */
    double shown;         /* when progress was last shown */
    progress_mode progress;
    void (*add_row)(void *user, const double *row /* [columns.count] */); /* a row, as it comes */
    void *row_user;
    bool (*stop)(void *user); /* whether to end the run; cli_interrupted by default */
    void *stop_user;
    bool no_line;    /* no line of progress: no terminal */
    bool shows_rows; /* on a terminal, where they would follow a line of progress */
    int failure;     /* exit status of a failure of the program's own, already printed */
} run_recorder;

/* Opens the writer: output is a file or "-"; in a directory trajectory.npy, with the run standing
 * where the checkpoint says.  Call recorder_close in any case,
 * which returns CLI_IO where what is open cannot be closed. */
int recorder_open(run_recorder *recorder, const run_simulation *simulation, run_directory *dir,
                  const char *output);
int recorder_close(run_recorder *recorder);
/* Integrates to the end.  Returns CLI_DONE; CLI_FAILED and the like with the reason in *error;
 * CLI_SIGNAL; or CLI_IO and the like after a message, *error then having none. */
int recorder_run(run_recorder *recorder, dal_error *error);
/* What it has observed, for checkpoints. */
observed_steps recorder_observed(run_recorder *recorder);
bool recorder_is_finished(const run_recorder *recorder);

#endif
