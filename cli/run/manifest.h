/* manifest.h - manifest.json: the request of a run, what ran it, and how far it is. */
#ifndef DAL_CLI_MANIFEST_H
#define DAL_CLI_MANIFEST_H

#include "io/json.h"
#include "request.h"
#include "run_directory.h"

#include <stdbool.h>

/* All functions but three return CLI_DONE, or print and return CLI_USAGE or CLI_IO. */

/* Writes the manifest of a new run and the copy of its system, and removes the files of an older
 * run. */
int manifest_begin(run_directory *dir, const run_simulation *simulation);
/* Reads the request into a new one, which points to texts of dir. */
int manifest_read(run_directory *dir, run_request *request);
/* Replaces the input by a request that extends it, and writes how far the run is. */
int manifest_extend(run_directory *dir, const run_simulation *simulation,
                    const run_position *position);
/* Compares the request that was read with another one: CLI_USAGE where they differ. */
int manifest_compare(const run_directory *dir, const run_request *held, const run_request *request);
/* Writes how far the run is; message: why, or "". */
int manifest_write(const run_directory *dir, const run_simulation *simulation,
                   const run_position *position, store_state state, const char *message);
/* "input" of a request, allocated, as it is one level deep in a manifest; and read from one,
 * the copy being the path of its system where that is a file. */
char *manifest_input(const run_request *request);
int manifest_read_input(run_request *request, const document *doc, const char *copy);
/* Whether a manifest states that its run is done or has failed. */
int manifest_read_end(const char *path, bool *has_ended);
/* Writes the member "machine". */
void manifest_put_machine(json_writer *writer);

#endif
