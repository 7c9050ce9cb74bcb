/* message.c - messages on stderr, and the exit statuses that go with them. */
#include "message.h"
#include "clock.h"
#include "dalembert_program.h"
#include "signals.h"
#include "wrap.h"

#include <errno.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { HANGING = 4 };
enum { MESSAGE_SIZE = 8192 }; /* more than the longest path */

int cli_exit(dal_status status)
{
    switch (status) {
    case DAL_STATUS_OK:
    case DAL_STATUS_STOPPED:
        return CLI_DONE;
    case DAL_STATUS_MEMORY:
    case DAL_STATUS_IO:
        return CLI_IO;
    case DAL_STATUS_INTERRUPTED:
        return CLI_SIGNAL;
    case DAL_STATUS_ARGUMENT:
    case DAL_STATUS_SYNTAX:
    case DAL_STATUS_NAME:
    case DAL_STATUS_MODEL:
    case DAL_STATUS_TOO_LARGE:
    case DAL_STATUS_INCONSISTENT:
    case DAL_STATUS_RANK:
    case DAL_STATUS_UNSUPPORTED:
        return CLI_USAGE;
    default:
        return CLI_FAILED;
    }
}

int cli_input_exit(dal_status status)
{
    return status == DAL_STATUS_OK || status == DAL_STATUS_MEMORY ? cli_exit(status) : CLI_USAGE;
}

/* ---- messages ------------------------------------------------------------------------------ */

static int progress_shown; /* columns of the line of progress now on the terminal */
static double progress_time;

void cli_progress_end(void)
{
    if (progress_shown) fprintf(stderr, "\r%*s\r", progress_shown, "");
    progress_shown = 0;
}

static int terminal_width(int descriptor)
{
    struct winsize size;
    const bool is_known = ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return is_known ? size.ws_col : 80;
}

int cli_width(void) { return terminal_width(STDERR_FILENO); }

int cli_output_width(void)
{
    const char *text = getenv("COLUMNS");
    const long columns = text ? strtol(text, NULL, 10) : 0;
    if (columns > 0 && columns < 10000) return (int)columns;
    return isatty(STDOUT_FILENO) ? terminal_width(STDOUT_FILENO) : 0;
}

/* The next line could not replace one that is longer than the terminal is wide. */
void cli_progress(const char *format, ...)
{
    char line[512];
    const double now = cli_seconds();
    if (!isatty(STDERR_FILENO) || (progress_shown && now - progress_time < 0.1)) return;
    const int before = progress_shown, width = cli_width() - 1;
    va_list list;
    va_start(list, format);
    vsnprintf(line, sizeof line, format, list);
    va_end(list);
    progress_shown = fprintf(stderr, "\r%.*s", width, line) - 1;
    if (before > progress_shown) fprintf(stderr, "%*s", before - progress_shown, "");
    progress_time = now;
}

/* Messages contain names and paths as the user gave them; without control characters a message is
 * one line and does not change the state of the terminal. */
static void make_plain(char *text)
{
    for (; *text; text++)
        if ((unsigned char)*text < ' ' || *text == 0x7f) *text = '?';
}

static void print_message(const char *format, va_list list)
{
    char message[MESSAGE_SIZE];
    const int length = vsnprintf(message, sizeof message, format, list);
    make_plain(message);
    cli_progress_end();
    /* Where both go to one place, the message follows the rows. */
    fflush(stdout);
    if (isatty(STDERR_FILENO) && length < MESSAGE_SIZE)
        cli_wrap_to(stderr, message, fprintf(stderr, "dalembert: "), HANGING, cli_width());
    else
        fprintf(stderr, "dalembert: %s%s\n", message, length < MESSAGE_SIZE ? "" : "...");
}

int cli_fail(int exit_status, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    print_message(format, list);
    va_end(list);
    return exit_status;
}

void cli_note(const char *format, ...)
{
    va_list list;
    va_start(list, format);
    print_message(format, list);
    va_end(list);
}

int cli_unknown(const char *what, const char *name, const char *const *names, int count)
{
    const char *nearest = dal__nearest_name(name, names, count);
    if (nearest)
        return cli_fail(CLI_USAGE, "unknown %s '%s'; did you mean '%s'?", what, name, nearest);
    return cli_fail(CLI_USAGE, "unknown %s '%s'", what, name);
}

int cli_error(int exit_status, const char *place, const dal_error *error)
{
    if (error->status == DAL_STATUS_MEMORY) exit_status = CLI_IO;
    if (!place) return cli_fail(exit_status, "%s", error->message);
    if (error->line <= 0) return cli_fail(exit_status, "%s: %s", place, error->message);
    return cli_fail(exit_status, "%s:%d:%d: %s", place, error->line, error->column, error->message);
}

int cli_io(const char *verb, const char *path)
{
    if (errno == ENOMEM) cli_out_of_memory();
    if (errno == EINTR && cli_interrupted()) return CLI_SIGNAL;
    /* A name that is too long for any disk is a wrong input. */
    return cli_fail(errno == ENAMETOOLONG ? CLI_USAGE : CLI_IO, "cannot %s '%s': %s", verb, path,
                    strerror(errno));
}

int cli_close(FILE *out, const char *path)
{
    /* A full disk may show only when the buffer is flushed, and a network one only at close. */
    bool failed = ferror(out) != 0;
    errno = failed ? EIO : 0;
    if (fflush(out) != 0) failed = true;
    int reason = errno;
    if (out != stdout && fclose(out) != 0 && !failed) {
        failed = true;
        reason = errno;
    }
    errno = reason;
    return failed ? cli_io("write", path) : CLI_DONE;
}

/* ---- the end without memory: standard streams and open files are flushed -------------------- */

/* A thread that the end of the program must not interrupt holds it to read; the one that ends the
 * program, to write. */
static pthread_rwlock_t exits = PTHREAD_RWLOCK_INITIALIZER;
static _Thread_local bool holds_exit;

void cli_hold_exit(void)
{
    pthread_rwlock_rdlock(&exits);
    holds_exit = true;
}

void cli_release_exit(void)
{
    holds_exit = false;
    pthread_rwlock_unlock(&exits);
}

/* Another thread that runs out of memory waits here while the first one ends the program. */
void cli_out_of_memory(void)
{
    if (holds_exit) cli_release_exit();
    pthread_rwlock_wrlock(&exits);
    exit(cli_fail(CLI_IO, "out of memory"));
}
