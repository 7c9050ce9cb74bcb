/* raise_signal.c - a signal at a given place of a program, whatever its speed, for one that is
 * started with LD_PRELOAD.
 *
 * Call RAISE_AT of rename (the first is 1) raises the signal number RAISE when it is done.  The
 * program ends the writing of each checkpoint and manifest by that call. */
#include <fcntl.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

static atomic_int calls;
static int number, place;

static int number_of(const char *name)
{
    const char *text = getenv(name);
    return text ? (int)strtol(text, NULL, 10) : 0;
}

__attribute__((constructor)) static void begin(void)
{
    number = number_of("RAISE");
    place = number_of("RAISE_AT");
    unsetenv("LD_PRELOAD"); /* what the program starts gets no signal */
}

int rename(const char *from, const char *to)
{
    const int result = renameat(AT_FDCWD, from, AT_FDCWD, to);
    if (++calls == place) raise(number);
    return result;
}
