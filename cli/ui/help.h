/* help.h - what --help prints of a command, and its part of the reference of all commands. */
#ifndef DAL_CLI_HELP_H
#define DAL_CLI_HELP_H

#include "options.h"

#include <stdbool.h>

/* code, word: --help, --help=WORD */
#define CLI_HELP_FORMAT_LIST(FORMAT)                                                               \
    FORMAT(TEXT, "text")                                                                           \
    FORMAT(MARKDOWN, "markdown")                                                                   \
    FORMAT(MAN, "man")

typedef enum cli_help_format {
#define FORMAT_CODE(code, word) CLI_HELP_##code,
    CLI_HELP_FORMAT_LIST(FORMAT_CODE)
#undef FORMAT_CODE
} cli_help_format;

/* Whether an argument is -h, --help or --help=FORMAT. */
bool cli_is_help(const char *argument, cli_help_format *format);
/* Prints the synopsis, the options and the notes of a command.  In the reference it refers to the
 * owner of options that are not its own.  Returns the exit status. */
int cli_print_help(const cli_command *command, const cli_group *groups, int count,
                   cli_help_format format);
/* Prints the list of the exit statuses. */
void cli_print_exits(cli_help_format format);

#endif
