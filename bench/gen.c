/* gen.c - around a generated file with the prefix gen, which the compiler includes (-include).
 *
 *     gen.METHOD.SPACE.SYSTEM.LANES       a program each; LANES trajectories at once
 *
 * made by `dalembert generate bench/systems/SYSTEM.yaml`; see bench.mk. */
#include "bench.h"

enum { STEPS = 1000, SHOWN = 2 * gen_COORDINATES };

/* Lanes have states of their own: they begin with other velocities of the last coordinate, which no
 * constraint at the start sees. */
static int work(void *self, double *end)
{
    gen_state *state = self;
    if (gen_start(state, NULL)) return 1;
    for (int lane = 0; lane < gen_LANES; lane++)
        state->y[(SHOWN - 1) * gen_LANES + lane] += 1e-2 * lane;
    const int status = gen_advance(state, BENCH_H_STEP, STEPS);
    for (int i = 0; i < SHOWN; i++) end[i] = state->y[i * gen_LANES];
    return status;
}

int main(void)
{
    static gen_state state;
    const bench_contender contender = {(double)STEPS * gen_LANES, SHOWN, work, &state};
    return bench_measure(&contender);
}
