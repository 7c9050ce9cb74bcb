/* help.h - what --help prints of a command, and its part of the reference of all commands. */
#ifndef DAL_CLI_HELP_H
#define DAL_CLI_HELP_H

#include "options.h"

/* The argument for which a command prints its part of the reference. */
#define CLI_HELP_MARKDOWN "--help=markdown"

/* Both print the synopsis, the options and the notes of a command and return the exit status: for a
 * terminal of 80 columns; and in Markdown, where it refers to the owner of options that are not its
 * own. */
int cli_print_help(const cli_command *command, const cli_option_set *sets, int count);
int cli_print_reference(const cli_command *command, const cli_option_set *sets, int count);

#endif
