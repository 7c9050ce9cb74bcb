/* arguments.h - the reading of arguments. */
#ifndef DAL_CLI_ARGUMENTS_H
#define DAL_CLI_ARGUMENTS_H

#include "options.h"

enum { CLI_GO_ON = -1 };

/* Stores the defaults of all sets and reads all arguments: --option value, --option=value, never
 * an abbreviation; -- ends the options.  Returns CLI_GO_ON, or an exit status after --help or a
 * message for each thing that is missing or wrong. */
int cli_read_arguments(const cli_command *command, int argc, char **argv,
                       const cli_option_set *sets, int count);

#endif
