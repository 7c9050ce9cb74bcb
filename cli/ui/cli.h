/* cli.h - what the commands of the program share.
 *
 * A command is a function command_NAME(argc, argv), argv[0] being its own name; it returns the exit
 * status.  stdout carries data only; messages begin with "dalembert: " and go to stderr.  The
 * program never calls setlocale, so the C locale holds and a number is read and written the same
 * everywhere. */
#ifndef DAL_CLI_H
#define DAL_CLI_H

/* Before any header of the system: C11 alone has no fsync, sigaction or clock_gettime.  Hence this
 * header comes first in every file. */
#ifndef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200809L
#endif

#include "dalembert.h"

#include <stdarg.h>
#include <stdio.h>

/* ---- exit statuses ------------------------------------------------------------------------- */

#define CLI_EXIT_LIST(X)                                                                           \
    X(DONE, 0, "done")                                                                             \
    X(CHECK, 1, "a check failed")                                                                  \
    X(USAGE, 2, "usage or input error")                                                            \
    X(FAILED, 3, "the integration failed; the rows so far are kept")                               \
    X(IO, 4, "input or output failed, or memory ran out")                                          \
    X(SIGNAL, 130, "interrupted")

enum {
#define X(code, number, text) CLI_##code = number,
    CLI_EXIT_LIST(X)
#undef X
};

/* The exit status a library status leads to while a run goes; cli_input_exit while the input is
 * still being read and a run being made, where only memory is not the user's fault. */
int cli_exit(dal_status status);
int cli_input_exit(dal_status status);

/* ---- messages ------------------------------------------------------------------------------ */

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
/* "dalembert: cannot VERB 'PATH': strerror(errno)"; returns CLI_IO, or CLI_USAGE
 * where the path is too long.  Where a signal ended the wait
 * it prints nothing and returns CLI_SIGNAL. */
int cli_io(const char *verb, const char *path);

/* A line of progress that replaces the last one; nothing unless stderr is a terminal, and not more
 * than ten times a second.  cli_progress_end wipes it; every message above does so too. */
void cli_progress(const char *format, ...) CLI_PRINTF(1, 2);
void cli_progress_end(void);
/* Columns of the terminal on stderr, 80 where it does not say. */
int cli_width(void);

/* ---- memory -------------------------------------------------------------------------------- */

/* Without memory the program ends: a message, status 4; cli_io does so where that is the reason. */
_Noreturn void cli_out_of_memory(void);
/* Between these two calls a lack of memory in another thread does not end the program: files that
 * belong together are written as a whole, a compiler that was started ends.  cli_is_ending tells
 * whether another thread waits to end it. */
void cli_hold_exit(void);
void cli_release_exit(void);
int cli_is_ending(void);
/* Whether a function of the library returned DAL_OK; the program ends where it was DAL_MEMORY. */
int cli_is_ok(dal_status status);

/* As the functions of the C library, but they never return NULL, for no bytes either. */
void *cli_malloc(size_t size);
void *cli_calloc(size_t count, size_t size);
void *cli_realloc(void *memory, size_t size);
char *cli_strdup(const char *text);
char *cli_strndup(const char *text, size_t length);
/* getline of the C library: the length of the next line, below 0 at the end or after a failure. */
long long cli_getline(char **line, size_t *capacity, FILE *file);
/* What printf would print, allocated. */
char *cli_format(const char *format, ...) CLI_PRINTF(1, 2);
char *cli_format_list(const char *format, va_list list) CLI_PRINTF(1, 0);

/* A file whose text is in memory: *text, allocated, and its *length are complete when the file is
 * closed. */
FILE *cli_memstream_open(char **text, size_t *length);
void cli_memstream_close(FILE *out);

/* ---- systems ------------------------------------------------------------------------------- */

/* SYSTEM is a path when it holds '/' or ends in .yaml or .yml, or when no built-in system but a
 * file has that name. */
int cli_is_path(const char *system);
/* Reads SYSTEM and makes its system, owned by *model.  Returns CLI_DONE, or prints and returns an
 * exit status with *model NULL. */
int cli_load(const char *system, dal_model **model, const dal_system **made);
/* The same in two parts, between which something may be added to the model; cli_make frees it where
 * it fails, place being what the message names. */
int cli_read(const char *system, dal_model **model);
int cli_make(const char *place, dal_model **model, const dal_system **made);

/* ---- output -------------------------------------------------------------------------------- */

/* Closes (or, for stdout, flushes) a file that was written to.  Returns CLI_DONE or, when any write
 * of its life failed, prints and returns CLI_IO. */
int cli_close(FILE *out, const char *path);

/* ---- signals ------------------------------------------------------------------------------- */

/* From the first call on SIGINT and SIGTERM set a flag, and a second one kills.  A read or a write
 * that waits for another process, as at a pipe, fails with EINTR from a second after the first one
 * on. */
void cli_catch_signals(void);
int cli_interrupted(void);

/* Seconds of a clock that never goes back; and of this thread's processor time. */
double cli_seconds(void);
double cli_thread_seconds(void);

#endif
