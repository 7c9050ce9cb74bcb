/* ensemble_directory.h - an ensemble in a directory, which can be resumed after any interruption.
 *
 *     DIR/manifest.json    the request, what varies, the machine, and whether it is done
 *     DIR/system.yaml      copy of the system file; absent for a built-in system
 *     DIR/members.npy      [members] status (0: done), t that was reached, what was drawn
 *     DIR/final.npy        [members] the states at the end, NaN of members that failed
 *     DIR/rows.npy         [times, members] the same at --times
 *     DIR/chunks           which chunks of members are done; or, of shards,
 *     DIR/chunks-K-of-N    the same of each of them
 *     DIR/messages/K       why members of chunk K failed, a line for each; absent where none did
 *     DIR/lock             empty; locked while a shard begins
 *     DIR/NAME.grown       of a larger ensemble: tables and chunks until they replace the others
 *
 * and, when all members are done, what ensemble_statistics.h makes of them. */
#ifndef DAL_CLI_ENSEMBLE_DIRECTORY_H
#define DAL_CLI_ENSEMBLE_DIRECTORY_H

#include "ensemble.h"
#include "io/document.h"
#include "io/npy_table.h"
#include "io/store.h"

/* member of ensemble_directory, file: those that say what was done, which a new ensemble removes;
 * and all. */
#define ENSEMBLE_RESULT_LIST(PATH)                                                                 \
    PATH(manifest, "manifest.json")                                                                \
    PATH(statistics, "statistics.csv")                                                             \
    PATH(covariance, "covariance.csv")                                                             \
    PATH(failures, "failures.csv")                                                                 \
    PATH(histograms, "histograms.csv")                                                             \
    PATH(cloud, "cloud.csv")
#define ENSEMBLE_FILE_LIST(PATH)                                                                   \
    ENSEMBLE_RESULT_LIST(PATH)                                                                     \
    PATH(system, "system.yaml")                                                                    \
    PATH(messages, "messages")
enum {
    ENSEMBLE_RESULTS = 0 ENSEMBLE_RESULT_LIST(STORE_ONE),
    ENSEMBLE_FILES = 0 ENSEMBLE_FILE_LIST(STORE_ONE)
};

/* The columns of members.npy before what was drawn. */
enum { MEMBER_STATUS, MEMBER_TIME, MEMBER_DRAWN };

typedef struct ensemble_directory {
    const char *path; /* the caller's */
    STORE_PATHS(ENSEMBLE_FILE_LIST);
    document *doc; /* manifest.json as it was read */
    npy_table members, final, rows;
    bool has_rows;
    long long member_count; /* in a row of the tables */
    store_marks marks;      /* of the chunks */
    int descriptor;         /* of the lock of the directory; -1: not held */
} ensemble_directory;

void ensemble_directory_open(ensemble_directory *dir, const char *path);
void ensemble_directory_close(ensemble_directory *dir);
/* Columns of members.npy. */
int ensemble_member_columns(const ensemble *e);
/* Memory for the rows of a chunk in any of the tables, zeroed; the caller frees it. */
double *ensemble_allocate_rows(const ensemble *e);
/* Whether a directory holds an ensemble. */
int ensemble_directory_find(const char *path, bool *is_there);

/* All below return CLI_DONE, or print and return an exit status. */

/* Begins a new ensemble, or a shard of one that is there.  What is there is overwritten with force
 * alone. */
int ensemble_directory_begin(ensemble_directory *dir, const ensemble *e, store_shard shard,
                             bool force);
/* Reads the ensemble of a directory, and completes it. */
int ensemble_directory_read(ensemble_directory *dir, ensemble *e);
/* The same without completing it. */
int ensemble_directory_read_request(ensemble_directory *dir, ensemble *e);
/* Opens the tables and the marks of a shard that was begun, for this process alone; of
 * STORE_ALL_SHARDS all that is there is read, and nothing marked. */
int ensemble_directory_attach(ensemble_directory *dir, const ensemble *e, store_shard shard);
/* The shards that were begun in a directory, allocated; one of count 0 where it is not divided. */
int ensemble_directory_shards(const ensemble_directory *dir, store_shard **shards, int *count);
/* Copies the rows and the messages of a chunk; rows: see ensemble_allocate_rows. */
int ensemble_directory_copy_chunk(const ensemble_directory *from, const ensemble_directory *to,
                                  const ensemble *e, int chunk, double *rows);
/* A larger ensemble in the directory of another: makes its tables beside the others; makes it the
 * ensemble of the directory, where done[chunks] is on the disk; and ends that, also after a process
 * that was killed, or removes what was not made one. */
int ensemble_directory_begin_growth(ensemble_directory *dir, const ensemble *e);
int ensemble_directory_commit_growth(ensemble_directory *dir, const ensemble *e,
                                     const unsigned char *done);
int ensemble_directory_end_growth(ensemble_directory *dir, const ensemble *e);
/* Waits until no other shard begins or ends, and keeps others waiting until dir is closed. */
int ensemble_directory_lock(ensemble_directory *dir);
/* Brings to the disk why members of a chunk failed; reads that, allocated, NULL where no file is
 * there. */
int ensemble_directory_write_messages(const ensemble_directory *dir, int chunk, const char *text);
int ensemble_directory_read_messages(const ensemble_directory *dir, int chunk, char **text);
/* Brings all rows to the disk, and then which chunks are done. */
int ensemble_directory_save(const ensemble_directory *dir);
int ensemble_directory_write_manifest(const ensemble_directory *dir, const ensemble *e,
                                      store_state state);

#endif
