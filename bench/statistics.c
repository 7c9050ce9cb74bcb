/* statistics.c - what it costs to evaluate every observable at every step, with compiled steps.
 *
 *     statistics METHOD SPACE SYSTEM         SYSTEM: a built-in name
 *
 * A run is repeated, observed and bare alternately.  Prints the median ratio of the times of two
 * that follow each other, so that a change of the processor's speed counts on both sides, and the
 * state reached; with BENCH_NS in the environment also the least nanoseconds of a step, bare and
 * observed. */
#define _POSIX_C_SOURCE 200809L
#include "bench.h"
#include <dalembert.h>
#include <dalembert_analysis.h>
#include <dalembert_codegen.h>

enum { PAIRS = 41, MAX_OBSERVABLES = 64, MIN_STEPS = 2048 };

typedef struct contender {
    dal_run_spec spec;
    dal_run *run;
    dal_statistics statistics[MAX_OBSERVABLES];
    int observables;
    double *start; /* [numbers] the persistent state there */
    size_t numbers;
} contender;

static dal_status observe(void *user, dal_run *run, int count, const double *t,
                          const double *values, size_t stride)
{
    contender *j = user;
    (void)run;
    dal_statistics_add_many(j->statistics, j->observables, count, t, values, stride);
    return DAL_STATUS_OK;
}

/* The time of a step of a run, in ns; negative where it failed. */
static double time_step(contender *j, long long steps, int observed)
{
    const dal_observer observer = {.user = j, .values = observed ? observe : NULL, .every = 1};
    if (dal_run_restore(j->run, j->start, j->numbers, NULL) != DAL_STATUS_OK) return -1.0;
    dal_statistics_start(j->statistics, j->observables);
    const double begin = bench_now();
    const dal_status status =
        dal_run_sample(j->run, (double)steps * j->spec.options.step, 1, 0, &observer, NULL);
    return status == DAL_STATUS_OK ? (bench_now() - begin) / (double)steps : -1.0;
}

static int measure(contender *j)
{
    const char *ms = getenv("BENCH_MS");
    double min[2] = {INFINITY, INFINITY}, ratio[PAIRS];
    const double one = time_step(j, MIN_STEPS, 1);
    if (!(one > 0.0)) return 1;
    const long long steps = MIN_STEPS + (long long)(1e6 * (ms ? atof(ms) : 20.0) / one);
    for (int i = 0; i < PAIRS; i++) {
        double time[2];
        for (int k = 0; k < 2; k++) {
            time[k] = time_step(j, steps, k);
            if (time[k] < 0.0) return 1;
            min[k] = fmin(min[k], time[k]);
        }
        ratio[i] = time[1] / time[0];
    }
    qsort(ratio, PAIRS, sizeof *ratio, bench_ascending);
    printf("%.5g", ratio[PAIRS / 2]);
    if (getenv("BENCH_NS")) printf(" (%.5g, %.5g)", min[0], min[1]);
    for (int i = 0; i < 2 * j->spec.system->n; i++) printf(" %.17g", dal_run_state(j->run)[i]);
    putchar('\n');
    return 0;
}

static int make(contender *j, char **argv, const char *cache, dal_error *error)
{
    static dal_model *model;
    const dal_native_options native = {.cache = cache};
    j->spec.options = dal_options_default();
    j->spec.options.step = BENCH_H_STEP;
    if (dal_model_builtin(&model, argv[3], error) ||
        dal_model_system(model, &j->spec.system, error) ||
        dal_method_parse(&j->spec.method, argv[1], error) ||
        dal_options_set(&j->spec.options, "space", argv[2], error) ||
        dal_run_create(&j->run, &j->spec, error) || dal_run_native(j->run, &native, error) ||
        dal_run_native_observables(j->run, &native, error))
        return 1;
    j->observables = dal_run_observables(j->run);
    const double *const saved = dal_run_save(j->run, &j->numbers);
    if (!(j->start = malloc(j->numbers * sizeof *saved))) return 1;
    memcpy(j->start, saved, j->numbers * sizeof *saved);
    return j->observables > MAX_OBSERVABLES;
}

int main(int argc, char **argv)
{
    static contender j;
    dal_error error = {0};
    char cache[4096];
    if (argc != 4) return bench_unknown(argc, argv);
    snprintf(cache, sizeof cache, "%s.cache", argv[0]); /* beside the program, made once */
    const int failed = make(&j, argv, cache, &error) || measure(&j);
    if (failed) fprintf(stderr, "statistics: %s\n", error.message);
    return failed;
}
