/* fail_call.c - calls of the system that fail, for a program that is started with LD_PRELOAD.
 *
 * Call FAIL_AT (the first is 1) of those below fails with EIO; how many there were is written to
 * FAIL_LOG.  A stream that is opened counts twice: at the second number it is opened, but cannot be
 * read, or holds no bytes that are written to it.  Programs that this one starts have a working
 * system.  With FAIL_TERMINAL standard output is a terminal, as far as the program knows. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* RTLD_NEXT, fopencookie */
#endif
#define FAIL_DEPTH 8 /* whoever writes a file does so through some functions */
#include "fail_place.h"
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

static atomic_long calls;
static long first;
static int is_on;

/* The C library's function of a name, as a pointer of its type. */
#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

__attribute__((constructor)) static void begin(void)
{
    const char *text = getenv("FAIL_AT");
    first = text ? strtol(text, NULL, 10) : 0;
    unsetenv("LD_PRELOAD");
    fail_places_begin();
    is_on = 1;
}

__attribute__((destructor)) static void end(void)
{
    const char *path = getenv("FAIL_LOG");
    is_on = 0;
    FILE *log = path ? REAL(fopen)(path, "w") : NULL;
    if (!log) return;
    fprintf(log, "%ld\n", (long)calls);
    fail_places_print(log);
    REAL(fclose)(log);
}

static int fails(void)
{
    if (!is_on || is_noting) return 0;
    const long call = ++calls;
    if (first == 0) fail_places_note(call);
    if (call != first) return 0;
    errno = EIO;
    return 1;
}

/* A function of the C library with the same arguments that may fail instead. */
#define CALL(type, name, bad, parameters, arguments)                                               \
    type name parameters { return fails() ? (bad) : REAL(name) arguments; }

CALL(ssize_t, read, -1, (int d, void *bytes, size_t n), (d, bytes, n))
CALL(ssize_t, write, -1, (int d, const void *bytes, size_t n), (d, bytes, n))
CALL(ssize_t, pread, -1, (int d, void *bytes, size_t n, off_t at), (d, bytes, n, at))
CALL(ssize_t, pwrite, -1, (int d, const void *bytes, size_t n, off_t at), (d, bytes, n, at))
CALL(int, ftruncate, -1, (int d, off_t n), (d, n))
CALL(int, truncate, -1, (const char *path, off_t n), (path, n))
CALL(int, fsync, -1, (int d), (d))
CALL(int, fdatasync, -1, (int d), (d))
CALL(int, rename, -1, (const char *from, const char *to), (from, to))
CALL(int, unlink, -1, (const char *path), (path))
CALL(int, rmdir, -1, (const char *path), (path))
CALL(int, mkdir, -1, (const char *path, mode_t mode), (path, mode))
CALL(DIR *, opendir, NULL, (const char *path), (path))
CALL(int, fseeko, -1, (FILE * file, off_t at, int from), (file, at, from))
CALL(int, fflush, EOF, (FILE * file), (file))
CALL(pid_t, fork, -1, (void), ())

int open(const char *path, int flags, ...)
{
    va_list arguments;
    va_start(arguments, flags);
    const mode_t mode = flags & O_CREAT ? va_arg(arguments, mode_t) : 0;
    va_end(arguments);
    return fails() ? -1 : REAL(open)(path, flags, mode);
}

int isatty(int d) { return d == STDOUT_FILENO && getenv("FAIL_TERMINAL") ? 1 : REAL(isatty)(d); }

/* The file is closed all the same. */
int close(int d)
{
    const int is_bad = fails(), result = REAL(close)(d);
    if (is_bad) errno = EIO;
    return is_bad ? -1 : result;
}

int fclose(FILE *file)
{
    const int is_bad = fails(), result = REAL(fclose)(file);
    if (is_bad) errno = EIO;
    return is_bad ? EOF : result;
}

/* The process has ended all the same. */
pid_t waitpid(pid_t process, int *state, int options)
{
    const int is_bad = fails();
    const pid_t result = REAL(waitpid)(process, state, options);
    if (is_bad) errno = EIO;
    return is_bad ? -1 : result;
}

static ssize_t no_bytes(void *cookie, char *bytes, size_t n)
{
    (void)cookie, (void)bytes, (void)n;
    errno = EIO;
    return -1;
}

static ssize_t no_room(void *cookie, const char *bytes, size_t n)
{
    (void)cookie, (void)bytes, (void)n;
    errno = EIO;
    return 0;
}

static FILE *broken_stream(const char *mode)
{
    return fopencookie(NULL, mode, (cookie_io_functions_t){.read = no_bytes, .write = no_room});
}

FILE *fopen(const char *path, const char *mode)
{
    if (fails()) return NULL;
    FILE *file = REAL(fopen)(path, mode);
    if (!file || !fails()) return file;
    REAL(fclose)(file);
    return broken_stream(mode);
}

FILE *fdopen(int d, const char *mode)
{
    if (fails()) return NULL;
    if (!fails()) return REAL(fdopen)(d, mode);
    REAL(close)(d);
    return broken_stream(mode);
}
