/* bench.h - what the bench programs share, C or C++: the clock and the way they are called.
 *
 *     PROGRAM CONTENDER...      prints "NS v1 v2 ...": nanoseconds per step of one trajectory, and
 *                               the state reached
 *
 * A contender's work begins at the start and makes a fixed number of steps, so that what is timed
 * is also what is compared.  Time is processor time of this process, so that others on the
 * machine do less harm, and the least of five rounds; BENCH_MS is the length of a round in
 * milliseconds (20; 0 for a smoke run).  The process is fresh: bench/run.sh takes medians over
 * several, since the layout of memory alone can make one of them slow. */
#ifndef BENCH_H
#define BENCH_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define BENCH_H_STEP 0.01 /* h of every contender, except on the fluid */

enum { BENCH_ROUNDS = 5, BENCH_UNKNOWN = 77, BENCH_MAX_SIZE = 2048 };

/* One contender: work(self, end) makes `steps` steps of all trajectories and writes a state; it
 * returns 0, or else failed. */
typedef struct bench_contender {
    double steps; /* of one trajectory, times trajectories */
    int size;     /* of the state */
    int (*work)(void *self, double *end);
    void *self;
} bench_contender;

/* For qsort: numbers in rising order. */
static inline int bench_ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* In nanoseconds. */
static inline double bench_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

/* What reading the clock takes: on virtual machines as much as a short trajectory. */
static inline double bench_clock(void)
{
    double min = INFINITY;
    for (int i = 0; i < 1000; i++) {
        const double since = bench_now();
        min = fmin(min, bench_now() - since);
    }
    return min;
}

/* Nanoseconds of `repeats` calls of work, each after one of begin, unless it is NULL, that is not
 * counted, nor is the clock; negative: one failed. */
static inline double bench_time(const bench_contender *contender, int (*begin)(void *self),
                                long repeats, double *end)
{
    const double clock = begin ? bench_clock() : 0.0;
    double taken = 0.0, since = bench_now();
    for (long i = 0; i < repeats; i++) {
        if (begin) {
            taken += bench_now() - since - clock;
            if (begin(contender->self)) return -1.0;
            since = bench_now();
        }
        if (contender->work(contender->self, end)) return -1.0;
    }
    return taken + (bench_now() - since);
}

/* The state is the end of the first round.  begin brings the contender to its start where its work
 * does not do so. */
static inline int bench_measure_from(const bench_contender *contender, int (*begin)(void *self))
{
    static double end[BENCH_MAX_SIZE], later[BENCH_MAX_SIZE];
    const char *ms = getenv("BENCH_MS");
    const double wanted = 1e6 * (ms ? atof(ms) : 20.0);
    double best = INFINITY;
    if (bench_time(contender, begin, 1, end) < 0.0) return 1;
    const double once = bench_time(contender, begin, 1, later);
    const long repeats = 1 + (long)(wanted / once);
    for (int round = 0; round < BENCH_ROUNDS && once >= 0.0; round++) {
        const double taken = bench_time(contender, begin, repeats, later);
        if (taken < 0.0) return 1;
        best = fmin(best, taken / ((double)repeats * contender->steps));
    }
    printf("%.5g", best);
    for (int i = 0; i < contender->size; i++) printf(" %.17g", end[i]);
    putchar('\n');
    return once < 0.0;
}

static inline int bench_measure(const bench_contender *contender)
{
    return bench_measure_from(contender, NULL);
}

static inline int bench_unknown(int argc, char **argv)
{
    fprintf(stderr, "%s: no such contender:", argv[0]);
    for (int i = 1; i < argc; i++) fprintf(stderr, " %s", argv[i]);
    fputc('\n', stderr);
    return BENCH_UNKNOWN;
}

/* Whether the arguments are exactly the words of name. */
static inline int bench_is(int argc, char **argv, const char *name)
{
    char words[256] = "";
    for (int i = 1; i < argc; i++) {
        if (strlen(words) + strlen(argv[i]) + 2 > sizeof words) return 0;
        if (i > 1) strcat(words, " ");
        strcat(words, argv[i]);
    }
    return strcmp(words, name) == 0;
}

#endif
