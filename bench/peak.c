/* peak.c - the most floating-point operations this processor does in a second, in one thread: fused
 * multiply-adds over the widest vectors, enough of them side by side to hide their latency.  Prints
 * nanoseconds per operation, a multiply-add being two. */
#define _POSIX_C_SOURCE 200809L
#include "bench.h"

enum { SIDE_BY_SIDE = 12, LANES = 8, REPEATS = 10000 };
typedef double lanes __attribute__((vector_size(8 * LANES)));

static int work(void *self, double *end)
{
    lanes x[SIDE_BY_SIDE], a, b;
    memcpy(&a, self, sizeof a);
    b = a + 1e-9;
    for (int j = 0; j < SIDE_BY_SIDE; j++) x[j] = a * j;
    for (int i = 0; i < REPEATS; i++)
        for (int j = 0; j < SIDE_BY_SIDE; j++) x[j] = x[j] * a + b;
    end[0] = 0.0;
    for (int j = 0; j < SIDE_BY_SIDE; j++)
        for (int lane = 0; lane < LANES; lane++) end[0] += x[j][lane];
    return 0;
}

int main(void)
{
    static double a[LANES] = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
    const bench_contender contender = {2.0 * REPEATS * SIDE_BY_SIDE * LANES, 0, work, a};
    return bench_measure(&contender);
}
