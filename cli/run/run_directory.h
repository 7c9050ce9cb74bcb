/* run_directory.h - the directory of a run, which can be resumed after any interruption.
 *
 *     DIR/manifest.json      the request, the machine, and how far the run is: see manifest.c
 *     DIR/system.yaml        copy of the system file; absent for a built-in system
 *     DIR/trajectory.npy     the rows: see trajectory.c
 *     DIR/events.csv         the events, of a system that has any: see event_log.h
 *     DIR/checkpoint         the state of the run: see checkpoint.c
 *     DIR/checkpoint.before  the checkpoint before that one
 *     DIR/summary.csv        at the end: one row per observable
 *
 * Every file but trajectory.npy is replaced as a whole, so each is old or new and never half of
 * either.  Rows of trajectory.npy after the checkpoint are cut off before the run is resumed. */
#ifndef DAL_CLI_RUN_DIRECTORY_H
#define DAL_CLI_RUN_DIRECTORY_H

#include "io/document.h"
#include "io/store.h"
#include "io/trajectory.h"

#include <stdbool.h>

/* member of run_directory, file */
#define RUN_FILE_LIST(PATH)                                                                        \
    PATH(manifest, "manifest.json")                                                                \
    PATH(system, "system.yaml")                                                                    \
    PATH(rows, "trajectory.npy")                                                                   \
    PATH(events, "events.csv")                                                                     \
    PATH(checkpoint, "checkpoint")                                                                 \
    PATH(before, "checkpoint.before")                                                              \
    PATH(fresh, "checkpoint.new")                                                                  \
    PATH(summary, "summary.csv")
enum { RUN_FILES = 0 RUN_FILE_LIST(STORE_ONE) };

typedef struct run_directory {
    const char *path; /* the caller's */
    STORE_PATHS(RUN_FILE_LIST);
    document *doc; /* manifest.json as it was read; the request points to its texts */
    char *input;   /* the request as it is in manifest.json */
    char *earlier; /* the request before it was extended, or NULL */
    uint64_t fingerprint, earlier_fingerprint; /* of either and of the system */
    bool extends;   /* the request is to replace the one of manifest.json: see extension.h */
    file_sync sync; /* whether to wait until what is written is on the disk */
    int descriptor; /* of trajectory.npy, locked; -1 before, and after a writer has taken it */
} run_directory;

/* How far a run has come. */
typedef struct run_position {
    long long row;  /* the number of rows in trajectory.npy, */
    row_sum sum;    /* and their sum */
    double seconds; /* spent in steps and rows */
} run_position;

/* Makes the names of the files in a directory. */
void run_directory_open(run_directory *dir, const char *path);
void run_directory_close(run_directory *dir);
/* A file in the directory that a new run would write over, or NULL. */
const char *run_directory_find_file(const run_directory *dir);
bool run_directory_has_run(const run_directory *dir);
typedef enum run_files { RUN_EXISTING, RUN_NEW } run_files;

/* Opens trajectory.npy for this process alone, creating it for a new run.  Returns CLI_DONE, or
 * prints and returns CLI_USAGE where another process has it or a run has lost it, or CLI_IO. */
int run_directory_lock(run_directory *dir, run_files files);

#endif
