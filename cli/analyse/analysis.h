/* analysis.h - what the commands share that examine a system or a motion as a whole: check, order,
 * section, lyapunov, volume, explain. */
#ifndef DAL_CLI_ANALYSIS_H
#define DAL_CLI_ANALYSIS_H

#include "io/json.h"
#include "run/simulation.h"

#include <stdbool.h>
#include <stdio.h>

/* An output: a directory with NAME.csv in it, or a file. */
typedef struct analysis_output {
    const char *directory; /* NULL: a file, or stdout */
    char *table;           /* the path of the table */
} analysis_output;

/* --force of these commands. */
#define ANALYSIS_FORCE_OPTION(settings)                                                            \
    {                                                                                              \
        "force", NULL, NULL, "writes into a directory that holds other things",                    \
            CLI_FLAG(settings, force)                                                              \
    }

/* Without --force: whether an output, NULL where there is none, is no directory of other things.
 * Returns CLI_DONE, or prints and returns CLI_USAGE. */
int analysis_check_directory(const char *output);

/* Makes the directory.  Returns CLI_DONE or prints and returns an exit status; close it. */
int analysis_open(analysis_output *output, const char *path, const char *name);
/* A line says which directory was written, by a command with that exit status. */
void analysis_close(analysis_output *output, int exit_status);

/* Writes what the table in a directory was made with, for `report`: NAME.json with the members that
 * put writes, and NAME.yaml, the copy of a system that is no built-in one.  Returns CLI_DONE or
 * prints and returns CLI_IO. */
int analysis_describe(const analysis_output *output, const char *name,
                      const run_simulation *simulation,
                      void (*put)(json_writer *writer, const void *results), const void *results);

/* Whether stdout is free for JSON: --output, NULL where there is none, must not go there.  Returns
 * CLI_DONE, or prints and returns CLI_USAGE. */
int analysis_check_output(const char *output, bool json);

/* Calls add for each formula of a model with branches: what it is, and what they leave of the order
 * of a step across one of them.  model may be NULL. */
void analysis_list_branches(dal_model *model,
                            void (*add)(void *user, const char *what, const char *text),
                            void *user);

/* max |a_i - b_i| / max(u_i, |b_i|) in units u, NULL: 1; infinite where an entry is not a
 * number. */
double analysis_distance(const double *a, const double *b, const double *units, int count);

#endif
