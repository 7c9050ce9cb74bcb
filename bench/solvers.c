/* solvers.c - what the solver auto costs, against the better of the two that it chooses from.
 *
 *     solvers tape          formulas, interpreted
 *     solvers native        compiled steps; build/bench/cache is filled first
 *
 * For each of 60 cases (system, method, h) on the physical space: nanoseconds of a step with the
 * fixed point, with Newton's method and with auto, the three alternately, the least of ROUNDS; "-"
 * where a solver fails.  The last line has the ratios auto / better: how many are above LIMIT, the
 * median and the largest. */
#define _POSIX_C_SOURCE 200809L
#include "bench.h"
#include "model.h"
#include <dalembert.h>
#include <dalembert_codegen.h>

enum { STEPS = 400, ROUNDS = 7, SOLVERS = 3, CASES = 60 };

#define LIMIT 1.2

static const char *const solver_name[SOLVERS] = {"fixed-point", "newton", "auto"};

/* bench/systems/NAME.yaml or a built-in system; its parameter that makes it stiff. */
static const struct {
    const char *name;
    dal_setting parameter;
} systems[] = {{"A", {NULL, 0.0}},
               {"chaplygin-sleigh-friction", {"k", 30.0}},
               {"roller-racer", {NULL, 0.0}},
               {"falling-disk", {NULL, 0.0}},
               {"chaotic-oscillators", {NULL, 0.0}}};
static const char *const methods[] = {"implicit-midpoint", "gauss4", "gauss8", "gauss12"};
static const double steps[] = {0.02, 0.1, 0.5};

static int fail(const dal_error *error)
{
    fprintf(stderr, "solvers: %s\n", error->message);
    return 1;
}

/* Nanoseconds of a step from the start; infinite where one fails. */
static double time_run(dal_run *run, const double *start)
{
    if (dal_run_set_state(run, 0.0, start, NULL)) return INFINITY;
    const double begin = bench_now();
    if (dal_run_advance(run, STEPS, NULL)) return INFINITY;
    return (bench_now() - begin) / STEPS;
}

/* The ratio of a case, which is printed; 0: an error. */
static double measure(const dal_run_spec *spec, const char *method, int native, dal_error *error)
{
    dal_run *run[SOLVERS];
    double start[64], best[SOLVERS] = {INFINITY, INFINITY, INFINITY};
    const dal_native_options cache = {.cache = "build/bench/cache"};
    for (int i = 0; i < SOLVERS; i++) {
        dal_run_spec one = *spec;
        if (dal_options_set(&one.options, "solver", solver_name[i], error)) return 0.0;
        if (dal_run_create(&run[i], &one, error)) return 0.0;
        if (native && dal_run_native(run[i], &cache, error)) return 0.0;
    }
    memcpy(start, dal_run_state(run[0]), (size_t)dal_run_dimension(run[0]) * sizeof *start);
    for (int round = 0; round < ROUNDS; round++)
        for (int i = 0; i < SOLVERS; i++) best[i] = fmin(best[i], time_run(run[i], start));
    printf("%-26s %-18s %5g", spec->system->name, method, spec->options.step);
    for (int i = 0; i < SOLVERS; i++) {
        if (isfinite(best[i])) printf(" %9.0f", best[i]);
        if (!isfinite(best[i])) printf(" %9s", "-");
        dal_run_free(run[i]);
    }
    const double ratio = best[2] / fmin(best[0], best[1]);
    printf("  %6.2f\n", ratio);
    fflush(stdout);
    return ratio;
}

static void summarise(double *ratio, int count)
{
    int above = 0;
    qsort(ratio, (size_t)count, sizeof *ratio, bench_ascending);
    for (int i = 0; i < count; i++) above += !(ratio[i] <= LIMIT);
    printf("auto / better: %d of %d above %g, median %.2f, max %.2f\n", above, count, LIMIT,
           ratio[count / 2], ratio[count - 1]);
}

int main(int argc, char **argv)
{
    const int native = bench_is(argc, argv, "native");
    dal_error error = {0};
    double ratio[CASES];
    int count = 0;
    if (!native && !bench_is(argc, argv, "tape")) return bench_unknown(argc, argv);
    printf("%-26s %-18s %5s %9s %9s %9s  %6s\n", "system", "method", "h", "fixed", "newton", "auto",
           "ratio");
    for (int i = 0; i < CASES; i++) {
        const int method = i / 3 % 4, system = i / 12;
        dal_run_spec spec = {.system = bench_system(systems[system].name, &error),
                             .options = dal_options_default(),
                             .parameters = &systems[system].parameter,
                             .parameter_count = systems[system].parameter.name != NULL};
        spec.options.space = DAL_PHYSICAL;
        spec.options.step = steps[i % 3];
        if (!spec.system || dal_method_parse(&spec.method, methods[method], &error))
            return fail(&error);
        ratio[count] = measure(&spec, methods[method], native, &error);
        if (ratio[count++] == 0.0) return fail(&error);
    }
    summarise(ratio, count);
    return 0;
}
