/* message.h - exit statuses, messages on stderr, the line of progress, the end without
 * memory. */
#ifndef DAL_CLI_MESSAGE_H
#define DAL_CLI_MESSAGE_H

#include "dalembert_status.h"

#include <stdio.h>

/* code, number, text of --help */
#define CLI_EXIT_LIST(EXIT)                                                                        \
    EXIT(DONE, 0, "done")                                                                          \
    EXIT(CHECK, 1, "a check failed")                                                               \
    EXIT(USAGE, 2, "usage or input error")                                                         \
    EXIT(FAILED, 3, "the integration failed; the rows so far are kept")                            \
    EXIT(IO, 4, "input or output failed, or memory ran out")                                       \
    EXIT(SIGNAL, 130, "interrupted")

enum {
#define EXIT_CODE(code, number, text) CLI_##code = number,
    CLI_EXIT_LIST(EXIT_CODE)
#undef EXIT_CODE
};

/* The exit status of a library status during a run; cli_input_exit: while the input is read and a
 * run is created, where every error but a lack of memory is the user's. */
int cli_exit(dal_status status);
int cli_input_exit(dal_status status);

#if defined(__GNUC__)
#define CLI_PRINTF(f, a) __attribute__((format(printf, f, a)))
#else
#define CLI_PRINTF(f, a)
#endif

/* Prints "dalembert: MESSAGE" and returns exit_status, so that a caller can write
 *     return cli_fail(CLI_USAGE, "unknown table '%s'", name); */
int cli_fail(int exit_status, const char *format, ...) CLI_PRINTF(2, 3);
/* The same where nothing has failed. */
void cli_note(const char *format, ...) CLI_PRINTF(1, 2);
/* "dalembert: unknown WHAT 'NAME'; did you mean 'NEAREST'?"; returns CLI_USAGE. */
int cli_unknown(const char *what, const char *name, const char *const *names, int count);
/* "dalembert: PLACE:line:column: message"; place may be NULL and line 0.  Returns exit_status, or
 * CLI_IO where memory ran out. */
int cli_error(int exit_status, const char *place, const dal_error *error);
/* "dalembert: cannot VERB 'PATH': strerror(errno)"; returns CLI_IO, or CLI_USAGE where the path is
 * too long.  Where a signal ended the wait it prints nothing and returns CLI_SIGNAL. */
int cli_io(const char *verb, const char *path);

/* Ends the program with a message and status 4. */
_Noreturn void cli_out_of_memory(void);
/* Between these two calls a lack of memory in another thread does not end the program, so that
 * files that belong together are complete. */
void cli_hold_exit(void);
void cli_release_exit(void);

/* Closes (or, for stdout, flushes) a file that was written to.  Returns CLI_DONE or, when any write
 * of its life failed, prints and returns CLI_IO. */
int cli_close(FILE *out, const char *path);

/* Prints a line of progress over the last one: on a terminal only, and at most ten times a second.
 * cli_progress_end removes it; so does every message. */
void cli_progress(const char *format, ...) CLI_PRINTF(1, 2);
void cli_progress_end(void);
/* Columns of the terminal on stderr; 80 where they are not known. */
int cli_width(void);
/* Columns that standard output is to fit into: COLUMNS of the environment, or the terminal's;
 * 0: it is neither. */
int cli_output_width(void);

#endif
