/* raise_signal.c - a signal at a given place of a program, whatever its speed, for one that is
 * started with LD_PRELOAD.
 *
 * Call RAISE_AT of rename (the first is 1) raises the signal number RAISE when it is done.  The
 * program ends the writing of each checkpoint and manifest by that call.  Where RAISE_WRITE is set
 * it is call RAISE_AT of pwrite, when half of the bytes are written. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* syscall */
#endif
#include <fcntl.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/syscall.h>
#include <unistd.h>

static atomic_int calls;
static int number, place, counts_writes;

static int number_of(const char *name)
{
    const char *text = getenv(name);
    return text ? (int)strtol(text, NULL, 10) : 0;
}

__attribute__((constructor)) static void begin(void)
{
    number = number_of("RAISE");
    place = number_of("RAISE_AT");
    counts_writes = number_of("RAISE_WRITE");
    unsetenv("LD_PRELOAD"); /* what the program starts gets no signal */
}

int rename(const char *from, const char *to)
{
    const int result = renameat(AT_FDCWD, from, AT_FDCWD, to);
    if (!counts_writes && ++calls == place) raise(number);
    return result;
}

#ifdef SYS_pwrite64
static ssize_t write_at(int descriptor, const void *bytes, size_t length, off_t at)
{
    if (counts_writes && ++calls == place) {
        syscall(SYS_pwrite64, descriptor, bytes, length / 2, at);
        raise(number);
    }
    return syscall(SYS_pwrite64, descriptor, bytes, length, at);
}

ssize_t pwrite(int descriptor, const void *bytes, size_t length, off_t at)
{
    return write_at(descriptor, bytes, length, at);
}

ssize_t pwrite64(int descriptor, const void *bytes, size_t length, off_t at)
{
    return write_at(descriptor, bytes, length, at);
}
#endif
