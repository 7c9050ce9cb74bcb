/* targets.c - how many drawn targets are reached by steering, rest to rest.
 *
 *     targets COUNT SYSTEM EFFORT [NAME]...     SYSTEM: a built-in name or a file
 *
 * Targets of the first two coordinates and of the third, an angle, are uniform in |x|, |y| <= 2 and
 * |phi| <= pi (seed 1), T = 2, by gauss8 with h = 0.02.  These and the coordinates NAME start at 0,
 * NAME end there; others are free at the end.  A target is reached from the straight line where the
 * first guess leads to it, in all where a further one does or the end of another motion is moved to
 * it.  Prints the targets that need these, progress after ten, and the counts; docs/steering.md has
 * what came out. */
#define _POSIX_C_SOURCE 200809L
#include "bench.h"
#include "core/vectors.h"
#include <dalembert.h>
#include <dalembert_steer.h>

enum { DRAWN = 3, MAX_ENDS = 16, PROGRESS = 10 };

/* Components of both ends. */
static dal_setting from[MAX_ENDS], to[MAX_ENDS];

static dal_status count_guesses(void *guesses, int guess, int iteration, double residual)
{
    (void)iteration;
    (void)residual;
    *(int *)guesses = guess + 1;
    return DAL_STATUS_OK;
}

static int fail(const dal_error *error)
{
    fprintf(stderr, "targets: %s\n", error->message);
    return 1;
}

static dal_status make(dal_model **model, dal_run_spec *spec, char **argv, dal_error *error)
{
    dal_status status = strchr(argv[2], '.') ? dal_model_read_file(model, argv[2], error)
                                             : dal_model_builtin(model, argv[2], error);
    spec->options = dal_options_default();
    spec->options.step = 0.02;
    spec->options.bare = true;
    for (int i = 0; i < DAL_EFFORT_COUNT && !status; i++)
        if (strcmp(dal_effort_name((dal_effort)i), argv[3]) == 0)
            status = dal_model_set_effort(*model, (dal_effort)i, error);
    if (!status) status = dal_model_system(*model, &spec->system, error);
    return status ? status : dal_method_parse(&spec->method, "gauss8", error);
}

/* Steers to count targets and prints what came out. */
static int steer_all(dal_model *model, const dal_run_spec *spec, int count, dal_error *error)
{
    static const double range[DRAWN] = {2.0, 2.0, 3.14159265358979323846};
    dal_steer_settings settings = dal_steer_settings_default();
    dal__random random = {1};
    int guesses = 0, straight = 0, reached = 0;
    const dal_steer_observer observer = {&guesses, NULL, count_guesses};
    const clock_t begin = clock();
    settings.rest = true;
    settings.target = to;
    settings.targets = spec->start_count;
    for (int k = 0; k < count; k++) {
        dal_steering *steering;
        for (int i = 0; i < DRAWN; i++) to[i].value = range[i] * dal__uniform(&random);
        if (dal_steer_create(&steering, model, spec, 2.0, &settings, &observer, error)) return 1;
        const bool is_reached = steering->extremal->status == DAL_STATUS_OK;
        reached += is_reached;
        straight += is_reached && guesses == 1;
        if (guesses != 1)
            printf("%d (%.3g, %.3g, %.3g): %sreached, %s\n", k + 1, to[0].value, to[1].value,
                   to[2].value, is_reached ? "" : "not ", guesses ? "guesses" : "an end moved");
        if ((k + 1) % PROGRESS == 0 || k + 1 == count)
            printf("%d targets: %d from the straight line, %d in all, %.0f ms each\n", k + 1,
                   straight, reached, 1e3 * (double)(clock() - begin) / CLOCKS_PER_SEC / (k + 1));
        fflush(stdout);
        dal_steer_free(steering);
    }
    return 0;
}

int main(int argc, char **argv)
{
    dal_error error = {.status = DAL_STATUS_OK};
    dal_run_spec spec = {.start = from};
    dal_model *model;
    if (argc < 4 || argc - 4 > MAX_ENDS - DRAWN) return 2;
    if (make(&model, &spec, argv, &error)) return fail(&error);
    for (int i = 0; i < DRAWN; i++) from[i].name = to[i].name = spec.system->coordinate[i];
    for (int i = 4; i < argc; i++) from[i - 4 + DRAWN].name = to[i - 4 + DRAWN].name = argv[i];
    spec.start_count = DRAWN + argc - 4;
    if (steer_all(model, &spec, atoi(argv[1]), &error)) return fail(&error);
    dal_model_free(model);
    return 0;
}
