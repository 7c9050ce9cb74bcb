/* run_directory.h - a run that lives in a directory and can be gone on with after any interruption.
 *
 *     DIR/manifest.json what was asked for, what ran it, and how far it came
 *     DIR/system.yaml   copy of the system file; absent for a built-in system
 *     DIR/trajectory.npy     the rows: see npy.c
 *     DIR/checkpoint    where the run stands: see checkpoint.c
 *     DIR/checkpoint.before  where it stood the time before
 *     DIR/summary.csv   when it is over: quantity, measure, value
 *
 * Every file but trajectory.npy is replaced as a whole, so each is old or new and never half of
 * either; what that one holds beyond the checkpoint is cut off before the run goes on. */
#ifndef DAL_CLI_RUN_DIRECTORY_H
#define DAL_CLI_RUN_DIRECTORY_H

#include "dalembert_analysis.h"
#include "io/document.h"
#include "io/trajectory_writer.h"
#include "request.h"
#include "ui/cli.h"

#define RUN_FILE_LIST(X)                                                                           \
    X(manifest, "manifest.json")                                                                   \
    X(system, "system.yaml")                                                                       \
    X(rows, "trajectory.npy")                                                                      \
    X(checkpoint, "checkpoint")                                                                    \
    X(before, "checkpoint.before")                                                                 \
    X(fresh, "checkpoint.new")                                                                     \
    X(summary, "summary.csv")

typedef struct run_directory {
    const char *path; /* the caller's */
#define X(name, file) char *name;
    RUN_FILE_LIST(X)
#undef X
    document *doc;        /* manifest.json as it was read, where the texts of its request live */
    char *input;          /* what was asked for, as it stands in manifest.json */
    uint64_t fingerprint; /* of that and of the system */
    int sync;             /* whether to wait until what is written is on the disk */
    int descriptor;       /* of trajectory.npy, locked; -1 before, and when a table has taken it */
} run_directory;

/* How far a run has come. */
typedef struct run_position {
    long long row;  /* the first row not in trajectory.npy, */
    row_sum sum;    /* and the sum of those in it */
    double seconds; /* spent in steps and rows */
} run_position;

/* The names of the files in a directory. */
void run_directory_open(run_directory *dir, const char *directory);
void run_directory_close(run_directory *dir);
/* A file in the directory that a new run would write over, or NULL. */
const char *run_directory_find_file(const run_directory *dir);
/* Opens trajectory.npy for this process alone: CLI_USAGE when another has it.  It is made for a new
 * run; any other has it already: CLI_USAGE where it is lost. */
int run_directory_lock(run_directory *dir, int is_new);
/* Describes a new run; what an older one left is removed. */
int run_directory_begin(run_directory *dir, const run_request *request);
/* Reads the description into a new request, whose texts live as long as the dir. */
int run_directory_read(run_directory *dir, run_request *request);
/* Whether a run is described there. */
int run_directory_has_run(const run_directory *dir);
/* Whether the request that was read there and another are one: CLI_USAGE and a message when not. */
int run_directory_compare(const run_directory *dir, const run_request *held,
                          const run_request *request);
/* manifest.json; state: running, done, failed, interrupted; why: a message, or "". */
int manifest_write(const run_directory *dir, const run_request *request,
                   const run_position *position, const char *state, const char *why);
/* Whether a manifest says that its run is done or has failed. */
int manifest_has_ended(const char *path);
/* ", "machine": {...}" for it. */
void manifest_put_machine(FILE *out);
/* Writes the checkpoint; and reads it into run and statistics[count], or the one before where it is
 * damaged or the rows are not those it tells of.  Without one *position is the beginning. */
int checkpoint_save(const run_directory *dir, const run_position *position, const dal_run *run,
                    const dal_statistics *statistics, int count);
int checkpoint_load(const run_directory *dir, const trajectory_writer *writer,
                    run_position *position, dal_run *run, dal_statistics *statistics, int count);

#endif
