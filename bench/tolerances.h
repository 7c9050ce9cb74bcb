/* tolerances.h - the motions of the bench of time to an error, C or C++: their references, and the
 * largest tolerance that reaches an error.
 *
 * A reference is a file, build/bench/reference.SYSTEM, that tolerances.c writes: the number of
 * components of (q, v), the time, and of each lane the state at the start and at that time.  An
 * error is |y - reference| / |reference| in the Euclidean norm of (q, v), the largest of all
 * lanes. */
#ifndef BENCH_TOLERANCES_H
#define BENCH_TOLERANCES_H

#include "bench.h"

enum { BENCH_LANES = 8, BENCH_MAX_MOTION = 16 };

typedef double bench_states[BENCH_LANES][BENCH_MAX_MOTION];

typedef struct bench_reference {
    int size;
    double time;
    bench_states start, end;
} bench_reference;

/* Returns 0, or else there is none that can be read. */
static inline int bench_read_reference(bench_reference *r, const char *system)
{
    char path[128];
    snprintf(path, sizeof path, "build/bench/reference.%.64s", system);
    FILE *file = fopen(path, "r");
    int read = file ? fscanf(file, "%d %lf", &r->size, &r->time) : 0;
    if (read < 2 || r->size > BENCH_MAX_MOTION) r->size = 0;
    for (int lane = 0; lane < BENCH_LANES; lane++) {
        for (int i = 0; i < r->size; i++) read += fscanf(file, "%lf", &r->start[lane][i]);
        for (int i = 0; i < r->size; i++) read += fscanf(file, "%lf", &r->end[lane][i]);
    }
    if (file) fclose(file);
    const int failed = r->size == 0 || read != 2 + 2 * BENCH_LANES * r->size;
    if (failed) fprintf(stderr, "%s: no reference, see make bench-tolerances\n", path);
    return failed;
}

static inline double bench_distance(const double *y, const double *reference, int size)
{
    double difference = 0.0, norm = 0.0;
    for (int i = 0; i < size; i++) {
        difference += (y[i] - reference[i]) * (y[i] - reference[i]);
        norm += reference[i] * reference[i];
    }
    return sqrt(difference / norm);
}

/* The error of the first lanes. */
static inline double bench_error(const bench_reference *r, bench_states end, int lanes)
{
    double error = 0.0;
    for (int lane = 0; lane < lanes; lane++) {
        const double e = bench_distance(end[lane], r->end[lane], r->size);
        if (!(e <= error)) error = e;
    }
    return error;
}

/* Tolerances to try: 10^(-k/20) to three digits. */
static inline double bench_tolerance(int k)
{
    char text[32];
    snprintf(text, sizeof text, "%.3g", pow(10.0, -k / 20.0));
    return strtod(text, NULL);
}

/* Prints the largest tolerance whose error is at most `error`, by decades and then by bisection,
 * and the error reached; or "-" and the smallest error.  error_of(self, tolerance): of a run, not
 * finite where one fails. */
static inline void bench_find(double (*error_of)(void *self, double tolerance), void *self,
                              double error)
{
    enum { DECADE = 20, FIRST = 2 * DECADE, LAST = 18 * DECADE };
    double reached = INFINITY, min = INFINITY;
    int fails = FIRST - DECADE, holds = FIRST;
    for (; holds <= LAST; fails = holds, holds += DECADE) {
        reached = error_of(self, bench_tolerance(holds));
        if (reached < min) min = reached;
        if (reached <= error) break;
    }
    if (holds > LAST) {
        printf("- %.2g\n", min);
        return;
    }
    while (holds - fails > 1) {
        const int middle = (holds + fails) / 2;
        const double e = error_of(self, bench_tolerance(middle));
        if (e <= error) reached = e;
        *(e <= error ? &holds : &fails) = middle;
    }
    printf("%.3g %.2g\n", bench_tolerance(holds), reached);
}

#endif
