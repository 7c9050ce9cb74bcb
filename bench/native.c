/* native.c - what it costs to let a run step by compiled code: RK4 on system A, physical space.
 *
 *     native compile      nothing in the cache: generate, compile, load
 *     native load         from the cache
 *
 * Prints nanoseconds by the clock on the wall, the least of five, and the state after 1000 steps.
 */
#define _POSIX_C_SOURCE 200809L
#include "bench.h"
#include <dalembert.h>
#include <dalembert_codegen.h>
#include <dirent.h>
#include <sys/stat.h>
#include <unistd.h>

static char place[] = "/tmp/dalembert-bench-XXXXXX";

static double wall(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

/* Empties the cache, which is a folder of plain files. */
static void empty(void)
{
    DIR *folder = opendir(place);
    char path[4096];
    for (struct dirent *entry; folder && (entry = readdir(folder));) {
        snprintf(path, sizeof path, "%s/%s", place, entry->d_name);
        if (entry->d_name[0] != '.') unlink(path);
    }
    if (folder) closedir(folder);
}

/* Makes a run native; its time, or a negative number. */
static double once(const dal_run_spec *spec, double *end)
{
    dal_run *run;
    dal_error error = {0};
    const dal_native_options options = {.cache = place};
    double taken = -1.0;
    if (dal_run_create(&run, spec, &error) == DAL_STATUS_OK) {
        const double begin = wall();
        if (dal_run_native(run, &options, &error) == DAL_STATUS_OK) taken = wall() - begin;
        if (dal_run_advance(run, 1000, &error)) taken = -1.0;
        memcpy(end, dal_run_state(run), 6 * sizeof *end);
        dal_run_free(run);
    }
    if (taken < 0.0) fprintf(stderr, "native: %s\n", error.message);
    return taken;
}

static int measure(const dal_run_spec *spec, int compile)
{
    double best = INFINITY, end[6];
    if (!mkdtemp(place)) return 1;
    if (once(spec, end) < 0.0) return 1;
    for (int round = 0; round < BENCH_ROUNDS; round++) {
        if (compile) empty();
        best = fmin(best, once(spec, end));
    }
    empty();
    rmdir(place);
    printf("%.5g", best);
    for (int i = 0; i < 6; i++) printf(" %.17g", end[i]);
    putchar('\n');
    return best < 0.0;
}

int main(int argc, char **argv)
{
    dal_model *model;
    dal_run_spec spec = {.options = dal_options_default()};
    const int compile = bench_is(argc, argv, "compile");
    if (!compile && !bench_is(argc, argv, "load")) return bench_unknown(argc, argv);
    spec.options.space = DAL_PHYSICAL;
    spec.options.step = BENCH_H_STEP;
    if (dal_model_read_file(&model, "bench/systems/A.yaml", NULL) ||
        dal_model_system(model, &spec.system, NULL) || dal_method_parse(&spec.method, "rk4", NULL))
        return 1;
    return measure(&spec, compile);
}
