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

/* name, synopsis, what it does */
#define COMMAND_LIST(X)                                                                            \
    X(list, "[systems|integrators] [--markdown]", "what travels inside the program")               \
    X(check, "SYSTEM [OPTION]...", "what can be known of a system before a run")                   \
    X(run, "SYSTEM --integrator NAME --step H --time T [OPTION]...", "integrate one system")       \
    X(resume, "DIR [OPTION]...", "go on with a run or a study that was interrupted")               \
    X(study, "[STUDY.yaml] [OPTION]...", "systems x integrators x steps: tables of drift")         \
    X(merge, "DIR... --output DIR", "join the shards of a study")                                  \
    X(order, "SYSTEM [OPTION]...", "error against step and against work, for every integrator")    \
    X(section, "SYSTEM --on FORMULA --integrator NAME --step H --time T [OPTION]...",              \
      "where a motion crosses a surface")                                                          \
    X(lyapunov, "SYSTEM --integrator NAME --step H --time T [OPTION]...",                          \
      "Lyapunov exponents of a motion")                                                            \
    X(volume, "SYSTEM --integrator NAME --step H --time T [OPTION]...",                            \
      "at what rate the volume of the phase space changes")                                        \
    X(explain, "SYSTEM --integrator NAME --step H --time T [OPTION]...",                           \
      "what the drift of a run comes from")                                                        \
    X(generate, "SYSTEM --integrator NAME [OPTION]... -o FILE.c",                                  \
      "one C file that steps a system and needs nothing else")                                     \
    X(report, "DIR [OPTION]...", "a page of a run, a study or orders: trends, figures")

#define X(name, synopsis, about) int command_##name(int argc, char **argv);
COMMAND_LIST(X)
#undef X

typedef struct cli_command {
    const char *name, *synopsis, *about;
    int (*call)(int argc, char **argv);
} cli_command;

/* A command by its name, NULL for none; what the program says of itself. */
const cli_command *cli_find(const char *name);
void cli_usage(FILE *out);

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

/* ---- arguments ----------------------------------------------------------------------------- */

typedef struct cli_option {
    const char *name;  /* without its dashes */
    const char *value; /* what --help calls its value; NULL: a flag */
    const char *help;
    const char *initial; /* its default, up to a '|'; NULL: none to tell */
} cli_option;

/* A command's options are one list of X(name, value, initial, help), which gives their table and
 * the numbers of those that are its own. */
#define CLI_OPTION(name, value, initial, help) {#name, value, help, initial},
#define CLI_OWN(name, value, initial, help)    OWN_##name,

typedef struct cli_args {
    const cli_option *options;
    int count;
    const char *notes; /* further paragraphs of --help, or NULL */
    int argc, next, plain;
    char **argv;
    int status; /* CLI_GO_ON, or the exit status: help was printed or a message given */
} cli_args;

enum { CLI_GO_ON = -1, CLI_STOP = -2, CLI_PLAIN = -1 };

/* Reads the arguments of a command one by one:
 *     cli_args args = cli_begin(argc, argv, options, count, notes);
 *     for (int k; (k = cli_next(&args, &value)) != CLI_STOP;) switch (k) ...
 *     if (args.status != CLI_GO_ON) return args.status;
 * cli_next gives the index of an option and its value, or CLI_PLAIN and an argument that is no
 * option, or CLI_STOP.  --opt value and --opt=value; never an abbreviation; -- ends the options. */
cli_args cli_begin(int argc, char **argv, const cli_option *options, int count, const char *notes);
int cli_next(cli_args *args, const char **value);
/* Ends the reading with an exit status, as a caller does that has printed a message. */
void cli_stop(cli_args *args, int exit_status);
/* The usage and options of a command, as --help prints them. */
void cli_help(FILE *out, const char *command, const cli_option *options, int count,
              const char *notes);

/* A text from the present column on, in lines of at most 80, further ones at hanging; and the
 * paragraphs and items of notes. */
void cli_fold(FILE *out, const char *text, int column, int hanging);
void cli_fold_notes(FILE *out, const char *notes);

/* A finite number, or an integer (1e6 is one) in least..greatest.  what names it in the message,
 * "--time".  Return CLI_DONE or CLI_USAGE. */
int cli_number(const char *what, const char *text, double *number);
int cli_integer(const char *what, const char *text, long long least, long long greatest,
                long long *number);
/* The index of a text among words; -1 after the message that it is none of them. */
int cli_word(const char *what, const char *text, const char *const *words, int count);
/* Splits "NAME=VALUE" at its first '=': a setting whose name is allocated (free it).  An infinite
 * value is taken for the name e alone.  Returns CLI_DONE, CLI_USAGE or CLI_IO. */
int cli_setting(const char *what, const char *text, dal_setting *setting);

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
