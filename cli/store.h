/* store.h - a run that lives in a directory and can be gone on with after any interruption.
 *
 *     DIR/run.yaml      what was asked for
 *     DIR/manifest.json the same with what ran it, and how far it came
 *     DIR/system.yaml   copy of the system file; absent for a built-in system
 *     DIR/trajectory.npy     the rows: see npy.c
 *     DIR/checkpoint    where the run stands: see checkpoint.c
 *     DIR/checkpoint.before  where it stood the time before
 *     DIR/summary.csv   when it is over: quantity, measure, value
 *
 * Every file but trajectory.npy is replaced as a whole, so each is old or new and never half of
 * either; what that one holds beyond the checkpoint is cut off before the run goes on. */
#ifndef DAL_CLI_STORE_H
#define DAL_CLI_STORE_H

#include "cli.h"
#include "job.h"
#include "table.h"

#define STORE_FILE_LIST(X)                                                                         \
    X(settings, "run.yaml")                                                                        \
    X(manifest, "manifest.json")                                                                   \
    X(system, "system.yaml")                                                                       \
    X(rows, "trajectory.npy")                                                                      \
    X(checkpoint, "checkpoint")                                                                    \
    X(before, "checkpoint.before")                                                                 \
    X(fresh, "checkpoint.new")                                                                     \
    X(summary, "summary.csv")

typedef struct cli_store {
    const char *directory; /* the caller's */
#define X(name, file) char *name;
    STORE_FILE_LIST(X)
#undef X
    char *text;           /* of run.yaml, where the texts of a job read from it live */
    uint64_t fingerprint; /* of run.yaml and of the system */
    int descriptor;       /* of trajectory.npy, locked; -1 before, and when a table has taken it */
} cli_store;

/* How far a run has come. */
typedef struct cli_mark {
    long long row;  /* the first row not in trajectory.npy, */
    table_sum sum;  /* and the sum of those in it */
    double seconds; /* spent in steps */
} cli_mark;

/* The names of the files in a directory.  All functions return CLI_DONE or print and return an
 * exit status. */
int store_open(cli_store *store, const char *directory);
void store_close(cli_store *store);
/* A file in the directory that a new run would write over, or NULL. */
const char *store_holds(const cli_store *store);
/* Opens trajectory.npy, made if need be, for this process alone: CLI_USAGE when another has it. */
int store_lock(cli_store *store);
/* Describes a new run; what an older one left is removed. */
int store_describe(cli_store *store, const cli_job *job);
/* Reads the description into a new job. */
int store_read(cli_store *store, cli_job *job);
/* Writes the checkpoint; and reads it into run and statistics[count], or the one before where it is
 * damaged or the rows are not those it tells of.  Without one *mark is the beginning. */
int store_save(const cli_store *store, const cli_mark *mark, const dal_run *run,
               const dal_statistics *statistics, int count);
int store_load(const cli_store *store, const cli_table *table, cli_mark *mark, dal_run *run,
               dal_statistics *statistics, int count);

#endif
