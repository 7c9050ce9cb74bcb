/* study_directory.h - a study in a directory, which can be resumed after any interruption.
 *
 *     DIR/study.yaml         the study itself; written last, when all else is there
 *     DIR/systems/LABEL.yaml copies of system files
 *     DIR/runs/NAME/         a run each, as 'dalembert run --output' makes them
 *     DIR/results/           the results of cells that keep no rows, see study_results.c
 *     DIR/predictions/       what is predicted of cells, in the same form
 *     DIR/manifest.json      what ran the study and how far it is; or, of shards,
 *     DIR/shard-K-of-N.json  the same of each of them
 *     DIR/tables.txt, cells.csv, quantities.csv, expectations.csv, series/LABEL.csv
 *                            at the end, or after an interruption
 *     DIR/report/            the page, by cli/report
 *     DIR/lock               empty; locked while a shard begins */
#ifndef DAL_CLI_STUDY_DIRECTORY_H
#define DAL_CLI_STUDY_DIRECTORY_H

#include "io/store.h"
#include "study_plan.h"

#include <stdbool.h>

/* member of study_directory, file */
#define STUDY_FILE_LIST(PATH)                                                                      \
    PATH(study, "study.yaml")                                                                      \
    PATH(systems, "systems")                                                                       \
    PATH(runs, "runs")                                                                             \
    PATH(results, "results")                                                                       \
    PATH(predictions, "predictions")                                                               \
    PATH(report, "report")                                                                         \
    PATH(series, "series")                                                                         \
    PATH(manifest, "manifest.json")                                                                \
    PATH(tables, "tables.txt")                                                                     \
    PATH(cells, "cells.csv")                                                                       \
    PATH(quantities, "quantities.csv")                                                             \
    PATH(expectations, "expectations.csv")
enum { STUDY_FILES = 0 STUDY_FILE_LIST(STORE_ONE) };

typedef struct study_directory {
    const char *path; /* the caller's */
    STORE_PATHS(STUDY_FILE_LIST);
    char *text; /* of study.yaml, as it was read */
    size_t length;
    store_shard shard; /* what of the study is run; STORE_ALL_SHARDS: those that are there */
    int writer;        /* which of several processes this is that run it, from 1; 0: the only one */
} study_directory;

/* How the cells of a study are run. */
typedef struct study_run_options {
    int threads;
    double interval; /* seconds between checkpoints of a run */
    native_mode native;
    bool shows_tables;   /* prints the tables, not the screen */
    bool shows_matrices; /* on a terminal, too, prints what a pipe gets */
    screen_format format;
} study_run_options;

/* Makes the names of the files in a directory. */
void study_directory_open(study_directory *dir, const char *path);
void study_directory_close(study_directory *dir);
bool study_directory_has_study(const study_directory *dir);
/* Whether a whole study is there and has ended. */
int study_directory_read_end(const study_directory *dir, bool *has_ended);

/* All below return CLI_DONE, or print and return an exit status. */

/* Creates the directory, the copies of system files and the manifest.  A study that is there is
 * written over with force alone; a shard of the same study joins it.  The cells of the plan then
 * have their place there. */
int study_directory_begin(study_directory *dir, study_plan *plan, const char *text, size_t length,
                          store_shard shard, bool force);
/* Whether each cell is of the whole study, or of a shard, that the directory holds, has[cells]. */
int study_directory_find_cells(const study_directory *dir, int cells, bool *has);
/* Reads the plan of the study, or of the shards of it that exist. */
int study_directory_read(study_directory *dir, study_plan *plan);
/* Reads the files of results in place of those before; NULL where no cell has any there. */
int study_directory_open_results(const study_directory *dir, study_plan *plan,
                                 struct study_results *results[STUDY_STORED]);
/* Brings what was added to them to the disk. */
int study_directory_save_results(const study_plan *plan);
/* Runs the cells, then finishes; and reads the study before. */
int study_directory_run(const study_directory *dir, study_plan *plan,
                        const study_run_options *options);
int study_resume(const char *path, const study_run_options *options);
/* After cells have been run with this status: prints the screen and writes, of a whole study,
 * all files. */
int study_directory_finish(const study_directory *dir, const study_plan *plan, int status);

#endif
