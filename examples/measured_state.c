/* measured_state.c - a generated file in a loop of control: in every cycle the measured state
 * replaces the one of the model, which then predicts what is when a command takes effect.
 *
 *     dalembert generate chaplygin-sleigh --integrator gauss4+project --prefix sleigh \
 *         --with field -o sleigh.c
 *     cc -O2 examples/measured_state.c -I. -lm -o measured_state
 *
 * Prints t, the prediction of y1, y2, phi for 0.2 later, and the acceleration to the left there. */
#include "sleigh.c"
#include <stdio.h>

/* What sensors would give: a sleigh in a circle, with q and v on D = 0. */
static void measure(double t, double *y)
{
    const double circle[] = {sin(t), 1.0 - cos(t), t, cos(t), sin(t), 1.0};
    memcpy(y, circle, sizeof circle);
}

int main(void)
{
    static sleigh_state state; /* 1 kB and no pointers: it may be anywhere */
    const sleigh_parameters parameters = sleigh_defaults();
    double F[sleigh_COORDINATES];
    for (int cycle = 1; cycle <= 10; cycle++) {
        /* A start begins the method again, its time at 0; then y is the measured state. */
        if (sleigh_start(&state, &parameters)) return 1;
        measure(cycle, state.y);
        const double *q = state.y, *v = state.y + sleigh_COORDINATES;
        if (sleigh_advance(&state, 0.01, 20) ||
            sleigh_field(&state, sleigh_time(&state, 0), q, v, F)) {
            fprintf(stderr, "measured_state: %s\n", sleigh_text(state.status[0]));
            return 1;
        }
        printf("%d %.17g %.17g %.17g %.17g\n", cycle, q[0], q[1], q[2],
               F[1] * cos(q[2]) - F[0] * sin(q[2]));
    }
    return 0;
}
