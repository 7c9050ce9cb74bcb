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

enum { BENCH_LANES = 8, BENCH_MAX_MOTION = 24 };

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

/* Prints the largest tolerance 10^(-k/4) that reaches an error, as all smaller ones down to 1e-16
 * do, and its error; or "-" and the smallest error.  error_of(self, tolerance): of a run, not
 * finite where one fails. */
static inline void bench_find(double (*error_of)(void *self, double tolerance), void *self,
                              double error)
{
    enum { DECADE = 4, FIRST = 2 * DECADE, LAST = 16 * DECADE };
    double reached = INFINITY, min = INFINITY, tolerance = 0.0;
    for (int k = LAST; k >= FIRST; k--) {
        const double tried = pow(10.0, -k / (double)DECADE), e = error_of(self, tried);
        if (e < min) min = e;
        if (!(e <= error)) break;
        reached = e;
        tolerance = tried;
    }
    if (tolerance > 0.0)
        printf("%.6g %.2g\n", tolerance, reached);
    else
        printf("- %.2g\n", min);
}

#endif
