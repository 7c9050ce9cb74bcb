/* variants.c - what each variant of the interpreter gains (Makefile, VARIANTS).
 *
 *     variants VARIANT METHOD SPACE SYSTEM [COUNT]     SYSTEM: a built-in name
 *
 * Steps a batch of COUNT trajectories (64) with one variant alone; COUNT 1 is a single run.  Prints
 * the nanoseconds of a step of one trajectory and the state of the first, which is the same with
 * all variants. */
#define _POSIX_C_SOURCE 200809L
#include "bench.h"
#include "run/batch.h"

enum { STEPS = 200 };

typedef struct contender {
    dal_run_spec spec;
    dal_batch *batch;
} contender;

static int work(void *self, double *end)
{
    contender *j = self;
    double state[BENCH_MAX_SIZE];
    if (dal_batch_advance(j->batch, STEPS)) return 1;
    dal_batch_state(j->batch, 0, state);
    memcpy(end, state, 2 * (size_t)j->spec.system->n * sizeof *end);
    return 0;
}

static int variant_of(const char *name)
{
    static const char *const names[] = {"x1",
#define NAME(prefix, variant, ...) #variant,
                                        DAL__VARIANT_LIST(NAME, )};
    int i = 0;
    while (i < DAL__VARIANTS && strcmp(names[i], name) != 0) i++;
    return i;
}

static int make(contender *j, char **argv, int count, dal_error *error)
{
    static dal_model *model;
    const int variant = variant_of(argv[1]);
    j->spec.options = dal_options_default();
    j->spec.options.step = BENCH_H_STEP / 10.0; /* no run ends early */
    return variant == DAL__VARIANTS || dal_model_builtin(&model, argv[4], error) ||
           dal_model_system(model, &j->spec.system, error) ||
           dal_method_parse(&j->spec.method, argv[2], error) ||
           dal_options_set(&j->spec.options, "space", argv[3], error) ||
           dal__batch_of_variant(&j->batch, &j->spec, count, 0, (dal__variant)variant, error);
}

int main(int argc, char **argv)
{
    static contender j;
    dal_error error = {0};
    const int count = argc > 5 ? atoi(argv[5]) : 64;
    if (argc < 5 || count < 1) return bench_unknown(argc, argv);
    if (make(&j, argv, count, &error)) {
        fprintf(stderr, "variants: %s\n", error.message);
        return 1;
    }
    const bench_contender measured = {(double)STEPS * count, 2 * j.spec.system->n, work, &j};
    return bench_measure(&measured);
}
