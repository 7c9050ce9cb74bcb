/* commands.h - the commands of the program.
 *
 * Each gets the arguments after the name of the program and returns the exit status.  stdout
 * carries data, or, where it is a terminal, a screen for a person (screen.h); messages begin with
 * "dalembert: " and go to stderr.  The program never calls setlocale, so the C locale holds and a
 * number is read and written the same everywhere. */
#ifndef DAL_CLI_COMMANDS_H
#define DAL_CLI_COMMANDS_H

#include "options.h"

/* In the order of --help. */
#define COMMAND_LIST(COMMAND)                                                                      \
    COMMAND(list)                                                                                  \
    COMMAND(show)                                                                                  \
    COMMAND(new)                                                                                   \
    COMMAND(check)                                                                                 \
    COMMAND(run)                                                                                   \
    COMMAND(resume)                                                                                \
    COMMAND(study)                                                                                 \
    COMMAND(ensemble)                                                                              \
    COMMAND(merge)                                                                                 \
    COMMAND(order)                                                                                 \
    COMMAND(section)                                                                               \
    COMMAND(lyapunov)                                                                              \
    COMMAND(volume)                                                                                \
    COMMAND(invariants)                                                                            \
    COMMAND(action)                                                                                \
    COMMAND(dirac)                                                                                 \
    COMMAND(steer)                                                                                 \
    COMMAND(predict)                                                                               \
    COMMAND(explain)                                                                               \
    COMMAND(generate)                                                                              \
    COMMAND(report)                                                                                \
    COMMAND(pack)                                                                                  \
    COMMAND(help)

#define DECLARE_COMMAND(name) extern const cli_command command_##name;
COMMAND_LIST(DECLARE_COMMAND)
#undef DECLARE_COMMAND
#define COUNT_COMMAND(name) +1
enum { COMMANDS = COMMAND_LIST(COUNT_COMMAND) };
#undef COUNT_COMMAND
extern const cli_command *const cli_commands[COMMANDS];

#endif
