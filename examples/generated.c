/* generated.c - a program around a generated file, and nothing of the library at run time.
 *
 *     dalembert generate chaplygin-sleigh --integrator gauss4+project --prefix sleigh -o sleigh.c
 *     cc -O2 examples/generated.c -I. -lm -o generated
 *
 * Prints t, y1, y2, phi and D at t = 1, ..., 10. */
#include "sleigh.c"
#include <stdio.h>

int main(void)
{
    sleigh_state state;
    sleigh_parameters parameters = sleigh_defaults();
    double out[sleigh_OBSERVABLES];
    parameters.omega = 1.0;
    if (sleigh_start(&state, &parameters)) return 1;
    for (int row = 1; row <= 10; row++) {
        if (sleigh_advance(&state, 0.01, 100)) {
            fprintf(stderr, "generated: %s\n", sleigh_text(state.status[0]));
            return 1;
        }
        sleigh_observe(&state, out);
        printf("%.17g %.17g %.17g %.17g %.17g\n", sleigh_time(&state, 0), state.y[0], state.y[1],
               state.y[2], out[0]);
    }
    return 0;
}
