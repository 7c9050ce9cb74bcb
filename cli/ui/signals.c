/* signals.c - SIGINT and SIGTERM as a flag, so that a run can end between two steps. */
#include "signals.h"

#include <signal.h>
#include <stdatomic.h>
#include <stddef.h>
#include <time.h>
#include <unistd.h>

/* Atomic, since the threads of a study read it. */
static atomic_int caught;
static atomic_llong first; /* when, in ms */

enum { SAME_REQUEST = 500 /* ms */, GRACE = 1 /* s */ };

/* timeout(1) and other launchers signal a program and then its group: that is one request.  A later
 * signal has the default action, so that a program that hangs can be killed. */
static void catch_signal(int number)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    const long long ms = 1000LL * now.tv_sec + now.tv_nsec / 1000000;
    if (!caught) {
        first = ms;
    } else if (ms - first > SAME_REQUEST) {
        signal(number, SIG_DFL);
        raise(number);
    }
    caught = 1;
    alarm(GRACE);
}

/* Interrupts a read or a write that waits for another process; repeated, since several may wait. */
static void end_wait(int number)
{
    (void)number;
    alarm(GRACE);
}

void cli_catch_signals(void)
{
    static const int numbers[] = {SIGINT, SIGTERM};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        struct sigaction action = {.sa_handler = catch_signal, .sa_flags = SA_RESTART};
        sigemptyset(&action.sa_mask);
        sigaction(numbers[i], &action, NULL);
    }
    struct sigaction action = {.sa_handler = end_wait};
    sigemptyset(&action.sa_mask);
    sigaction(SIGALRM, &action, NULL);
}

bool cli_interrupted(void) { return caught; }

static void continue_after(int number) { (void)number; }

/* A handler, since programs that are started would inherit that a signal is ignored. */
void cli_catch_broken_pipe(void)
{
    struct sigaction action = {.sa_handler = continue_after, .sa_flags = SA_RESTART};
    sigemptyset(&action.sa_mask);
    sigaction(SIGPIPE, &action, NULL);
}
