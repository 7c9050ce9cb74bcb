/* isokinetic_fluid.c - a fluid of 256 soft spheres at constant kinetic energy, 768 coordinates; the
 * system is in isokinetic_fluid.h.
 *
 *     cc isokinetic_fluid.c $(pkg-config --cflags --libs dalembert) -lm -o isokinetic_fluid
 *
 * The implicit midpoint rule preserves D, which is quadratic, and the total momentum, which is
 * linear.  Prints the errors of D/K and of the momentum, and how far a run continued from a
 * checkpoint differs; fails if the first two are not at rounding level or the third is not 0. */
#include "isokinetic_fluid.h"
#include <stdio.h>

enum { STEPS = 50 };

static double momentum(const double *v)
{
    double max = 0.0;
    for (int a = 0; a < 3; a++) {
        double sum = 0.0;
        for (int i = 0; i < FLUID_SPHERES; i++) sum += v[a * FLUID_SPHERES + i];
        max = fmax(max, fabs(sum));
    }
    return max;
}

/* Puts `other` into the state of `run` and advances both: the max norm of their difference. */
static dal_status compare(dal_run *run, dal_run *other, double *difference, dal_error *error)
{
    size_t count;
    const double *memory = dal_run_save(run, &count), *a = dal_run_state(run),
                 *b = dal_run_state(other);
    dal_status status = dal_run_restore(other, memory, count, error);
    if (status == DAL_STATUS_OK) status = dal_run_advance(run, STEPS, error);
    if (status == DAL_STATUS_OK) status = dal_run_advance(other, STEPS, error);
    *difference = 0.0;
    for (int i = 0; i < 2 * FLUID_N; i++) *difference = fmax(*difference, fabs(a[i] - b[i]));
    return status;
}

int main(void)
{
    dal_run_spec spec = {.system = &fluid_system, .options = dal_options_default()};
    spec.options.space = DAL_PHYSICAL;
    spec.options.step = 0.002;
    dal_run *run, *other;
    dal_error error;
    double seen[2], difference; /* D, E */
    if (dal_method_parse(&spec.method, "implicit-midpoint", &error) ||
        dal_run_create(&run, &spec, &error) || dal_run_create(&other, &spec, &error) ||
        dal_run_advance(run, STEPS, &error) || compare(run, other, &difference, &error) ||
        dal_run_observe(run, seen)) {
        fprintf(stderr, "isokinetic_fluid: %s\n", error.message);
        return 1;
    }
    const double D = fabs(seen[0]) / dal_run_parameters(run)[FLUID_KINETIC];
    const double P = momentum(dal_run_state(run) + FLUID_N);
    printf("D/K %.1e  momentum %.1e  checkpoint %g\n", D, P, difference);
    dal_run_free(run);
    dal_run_free(other);
    return !(D < 1e-13 && P < 1e-11 && difference == 0.0);
}
