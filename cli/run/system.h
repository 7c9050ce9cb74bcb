/* system.h - reads the system of a command. */
#ifndef DAL_CLI_SYSTEM_H
#define DAL_CLI_SYSTEM_H

#include "dalembert_model.h"
#include "io/file.h"

#include <stdbool.h>

/* Whether SYSTEM is a path: it has a '/', ends in .yaml or .yml, or names a file and no built-in
 * system. */
bool cli_is_path(const char *system);
/* What is chosen of a system beside its file. */
typedef struct cli_choices {
    dal_effort effort;
    dal_mechanics mechanics;
    const char *gauge; /* NULL: the file's */
} cli_choices;
/* Reads SYSTEM and makes its system with these choices, owned by *model.  Returns CLI_DONE, or
 * prints and returns an exit status with *model NULL. */
int cli_load(const char *system, const cli_choices *choices, dal_model **model,
             const dal_system **made);
/* The same in parts, between which something may be added to the model; cli_choose frees it on
 * failure. */
int cli_read(const char *system, dal_model **model);
int cli_choose(dal_model **model, const cli_choices *choices);
/* A formula that runs observe, and its place in a file or an option. */
typedef struct cli_formula {
    const char *text;
    int line, column;
} cli_formula;
/* Reads SYSTEM and makes its system with these choices and formulas[count] that runs observe; place
 * is what a message about one of them names.  A model that is not NULL is replaced, and then no
 * warnings are printed.  Returns as cli_load does. */
int cli_observe(const char *system, const cli_choices *choices, const char *place,
                const cli_formula *formulas, int count, dal_model **model, const dal_system **made);
/* Writes a copy of a system file, with the files of its tables in it; where model is not NULL, as
 * it was read.  Returns CLI_DONE, or prints and returns CLI_IO. */
int cli_copy_system(const char *system, const dal_model *model, const char *to, file_sync sync);
/* The same for a directory of results: of a built-in system there is no copy, and an earlier one is
 * removed. */
int cli_keep_system(const char *system, const dal_model *model, const char *to, file_sync sync);
/* The value of a formula of numbers and functions, as pi/2; what names it in a message.  Returns
 * CLI_DONE or CLI_USAGE. */
int cli_constant(const char *what, const char *text, double *value);
/* The default for a run that a system file gives under a name, and where; NULL: none. */
const char *cli_default(const dal_model *model, const char *name, int *line, int *column);
/* The number of a coordinate, or -1; whether a coordinate, parameter or invariant has that name. */
int cli_find_coordinate(const dal_system *system, const char *name);
bool cli_has_name(const dal_system *system, const char *name);
/* The names of the built-in systems; returns how many. */
enum { CLI_MAX_BUILTINS = 256 };
int cli_builtins(const char *names[CLI_MAX_BUILTINS]);

#endif
