/* study_directory.h - a study in a directory, which can be resumed after any interruption.
 *
 *     DIR/study.yaml         the study itself; written last, so that with it all else is there
 *     DIR/systems/LABEL.yaml copies of system files
 *     DIR/runs/NAME/         a run each, as 'dalembert run --output' makes them
 *     DIR/manifest.json      what ran the study and how far it came, or, where shards were run,
 *     DIR/shard-K-of-N.json  the same of each of them
 *     DIR/tables.txt, cells.csv, quantities.csv, expectations.csv, series/LABEL.csv
 *                            when it is over or interrupted
 *     DIR/lock               empty; shards that begin at the same time take turns by it */
#ifndef DAL_CLI_STUDY_DIRECTORY_H
#define DAL_CLI_STUDY_DIRECTORY_H

#include "study.h"

#include <stddef.h>

#define STUDY_FILE_LIST(X)                                                                         \
    X(study, "study.yaml")                                                                         \
    X(systems, "systems")                                                                          \
    X(runs, "runs")                                                                                \
    X(series, "series")                                                                            \
    X(manifest, "manifest.json")                                                                   \
    X(tables, "tables.txt")                                                                        \
    X(cells, "cells.csv")                                                                          \
    X(quantities, "quantities.csv")                                                                \
    X(expectations, "expectations.csv")

/* Cells k, k + n, k + 2n, ... of n shards; count 0: all cells, STUDY_ALL_SHARDS: the cells of all
 * shards whose manifests are in the directory. */
enum { STUDY_ALL_SHARDS = -1 };

typedef struct study_shard {
    long long number, count;
} study_shard;

typedef struct study_directory {
    const char *directory; /* the caller's */
#define X(name, file) char *name;
    STUDY_FILE_LIST(X)
#undef X
    char *text; /* of study.yaml, as it was read */
    size_t length;
    study_shard shard; /* what of the study is run */
} study_directory;

/* The names of the files in a directory. */
void study_directory_open(study_directory *dir, const char *directory);
void study_directory_close(study_directory *dir);
int study_directory_has_study(const study_directory *dir);
/* Whether a whole study is there, and is over. */
int study_directory_is_finished(const study_directory *dir);

/* Makes the directory, the copies of system files and the description; a study that is there is
 * written over with force alone, and a shard joins it when it is the same.  The plan's cells then
 * have their place there, and those of other shards are elsewhere. */
int study_directory_begin(study_directory *dir, study_plan *plan, const char *text, size_t length,
                          study_shard shard, int force);
/* Reads the plan of the study that is there, or of those of its shards that are. */
int study_directory_read(study_directory *dir, study_plan *plan);

/* manifest.json, or those of the shards; state: running, interrupted, failed, unmet, done. */
int study_directory_write_manifest(const study_directory *dir, const study_plan *plan,
                                   const char *state);
/* When cells have been run, with the status this ended with: the tables to stdout and, of a whole
 * study, all files.  Returns the exit status of the program. */
int study_directory_finish(const study_directory *dir, const study_plan *plan, int status);

/* Calls visit for each shard that the directory tells of. */
typedef int shard_visitor(const study_directory *dir, study_shard shard, void *user);
int study_directory_each_shard(const study_directory *dir, shard_visitor *visit, void *user);
/* Where the manifest of a shard is, or of the whole; allocated. */
char *study_directory_manifest(const study_directory *dir, study_shard shard);
int study_shard_has(study_shard shard, int cell);

#endif
