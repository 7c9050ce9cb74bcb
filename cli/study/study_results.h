/* study_results.h - the results of cells that keep no rows, in a few files of the study.
 *
 *     DIR/results/WRITER   a header, then a record for each cell, in the order of their ends
 *
 * Every process that runs cells of a study writes a file of its own and reads all files: WRITER
 * is `all`, `K-of-N` of a shard, or `writer-R` with MPI.  A record that was not written to its end,
 * because the process was killed, is left out, and its cell is run again. */
#ifndef DAL_CLI_STUDY_RESULTS_H
#define DAL_CLI_STUDY_RESULTS_H

#include "study_data.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct study_results study_results;

/* Reads the results in a directory, which may be absent, of cells with these keys, key[cells];
 * writer names the file of this process.  What the files hold of other cells stays there, unused.
 * Returns CLI_DONE, or prints and returns CLI_USAGE or CLI_IO; call study_results_free in any
 * case. */
int study_results_open(study_results **results, const char *directory, const char *writer,
                       const uint64_t *key, int cells);
void study_results_free(study_results *results);
/* Whether there is a result of a cell. */
bool study_results_has(const study_results *results, int cell);
/* Gives a cell, which has as many observables and place for their trends, its result; false where
 * there is none. */
bool study_results_get(const study_results *results, int number, study_cell *cell);

/* Adds the result of cell `number`; brings what was added to the disk when `interval` seconds have
 * passed since that was last done.  Threads may call it at the same time.  Returns CLI_DONE, or
 * prints and returns CLI_USAGE where another process writes the file, or CLI_IO. */
int study_results_add(study_results *results, int number, const study_cell *cell, double interval);
/* Adds the result that other files of the study have of a cell. */
int study_results_copy(study_results *results, const study_results *other, int number);
/* Brings everything to the disk.  Returns CLI_DONE, or prints and returns CLI_IO. */
int study_results_save(study_results *results);

#endif
