/* signals.c - SIGINT and SIGTERM as a flag, so that a run can end between two steps. */
#include "cli.h"

#include <signal.h>
#include <stdatomic.h>

/* Atomic because the threads of a study ask for it, too. */
static atomic_int caught;

/* The second signal finds the default action: a program that hangs can still be killed. */
static void note(int number)
{
    caught = 1;
    signal(number, SIG_DFL);
}

void cli_catch_signals(void)
{
    static const int numbers[] = {SIGINT, SIGTERM};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        struct sigaction action = {.sa_handler = note, .sa_flags = SA_RESTART};
        sigemptyset(&action.sa_mask);
        sigaction(numbers[i], &action, NULL);
    }
}

int cli_interrupted(void) { return caught; }
