/* interpreted.c - RK4 on Chaplygin's sleigh in the physical space: a run of the library, its field
 * evaluated from the formulas' tape, against a loop written by hand with libm's sin and cos.
 *
 * Prints one line, "interpreted-rk4 LIBRARY_NS HAND_NS", nanoseconds per step; both must reach the
 * same state after CHECKED steps, else the exit status is 1.  bench/run.sh takes medians of the
 * ratio over fresh processes. */
#define _POSIX_C_SOURCE 200809L
#include <dalembert.h>
#include <math.h>
#include <stdio.h>
#include <time.h>

enum { CHECKED = 1000, STEPS = 400000, ROUNDS = 5 };

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* y1'' = -u omega sin(phi), y2'' = u omega cos(phi), u = y1' cos(phi) + y2' sin(phi)   (nh32) */
static void field(const double *y, double *dy)
{
    const double s = sin(y[2]), c = cos(y[2]);
    const double k = (y[3] * c + y[4] * s) * y[5];
    dy[0] = y[3];
    dy[1] = y[4];
    dy[2] = y[5];
    dy[3] = -k * s;
    dy[4] = k * c;
    dy[5] = 0.0;
}

static void hand_step(double *y, double h)
{
    double k1[6], k2[6], k3[6], k4[6], z[6];
    field(y, k1);
    for (int i = 0; i < 6; i++) z[i] = y[i] + 0.5 * h * k1[i];
    field(z, k2);
    for (int i = 0; i < 6; i++) z[i] = y[i] + 0.5 * h * k2[i];
    field(z, k3);
    for (int i = 0; i < 6; i++) z[i] = y[i] + h * k3[i];
    field(z, k4);
    for (int i = 0; i < 6; i++) y[i] += h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
}

static double hand(double h, double *y, int steps)
{
    const double begin = now();
    for (int i = 0; i < steps; i++) hand_step(y, h);
    return (now() - begin) * 1e9 / steps;
}

static double library(dal_run *run, int steps)
{
    const double begin = now();
    if (dal_run_advance(run, steps, NULL) != DAL_OK) return NAN;
    return (now() - begin) * 1e9 / steps;
}

static dal_run *make_run(dal_model **model)
{
    dal_run_spec spec = {.options = dal_options_default()};
    dal_run *run = NULL;
    dal_error error = {0};
    spec.options.space = DAL_PHYSICAL;
    spec.options.step = 0.001;
    if (dal_model_builtin(model, "chaplygin-sleigh", &error) != DAL_OK ||
        dal_model_system(*model, &spec.system, &error) != DAL_OK ||
        dal_method_parse(&spec.method, "rk4", &error) != DAL_OK ||
        dal_run_create(&run, &spec, &error) != DAL_OK)
        fprintf(stderr, "%s\n", error.message);
    return run;
}

int main(void)
{
    dal_model *model = NULL;
    dal_run *run = make_run(&model);
    double y[6] = {0, 0, 0, 1, 0, 1}, a = INFINITY, b = INFINITY, distance = 0.0;
    if (!run) return 1;
    library(run, CHECKED);
    hand(0.001, y, CHECKED);
    for (int i = 0; i < 6; i++) distance = fmax(distance, fabs(y[i] - dal_run_state(run)[i]));
    for (int i = 0; i < ROUNDS; i++) {
        a = fmin(a, library(run, STEPS));
        b = fmin(b, hand(0.001, y, STEPS));
    }
    printf("interpreted-rk4 %.2f %.2f\n", a, b);
    if (!(distance < 1e-12)) fprintf(stderr, "the end states differ by %g\n", distance);
    dal_run_free(run);
    dal_model_free(model);
    return !(distance < 1e-12);
}
