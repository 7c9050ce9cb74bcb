/* extension.h - the run of a directory, continued to a later end.
 *
 * Rows go on at the same distance, so that the result has the bytes of a run to that end from the
 * beginning.  manifest.json gets the new input, and keeps the one before as "extends": one write,
 * after which the checkpoint of either is a point of the run. */
#ifndef DAL_CLI_EXTENSION_H
#define DAL_CLI_EXTENSION_H

#include "recorder.h"
#include "run_directory.h"
#include "simulation.h"

/* What a command gives: the new end, --time or --steps, as texts; NULL: not given. */
typedef struct run_extension {
    const char *time, *steps;
} run_extension;

/* Their rows in a table of options. */
#define EXTENSION_OPTIONS(settings, member)                                                        \
    {"time", "T2", NULL, "extends the run to t = T2", CLI_TEXT(settings, member.time)},            \
    {                                                                                              \
        "steps", "N2", NULL, "extends it to N2 steps since the start; excludes --time",            \
            CLI_TEXT(settings, member.steps)                                                       \
    }

/* Both return CLI_DONE, or print and return an exit status. */

/* Makes the run of a request that was read from a directory, with its new end where one is given;
 * the run must be able to go on. */
int extension_create(run_directory *dir, run_simulation *simulation,
                     const run_extension *extension);
/* Replaces the input of the manifest, once the run is where its checkpoint says. */
int extension_commit(run_recorder *recorder);

/* For what has no rows at equal distances: gives a request the new end, *end being where it is,
 * unless what ends at `before` in a directory goes further already; and its list of times the end
 * of the run before, where that was after the last one. */
int extension_replace_end(run_request *request, const run_extension *extension,
                          const char *directory, double before, double *end);
int extension_extend_list(run_request *request, const run_simulation *before);

#endif
