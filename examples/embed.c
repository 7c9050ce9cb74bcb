/* embed.c - a stepper inside another program: Chaplygin's sleigh by gauss4 with projection.
 *
 *     cc embed.c $(pkg-config --cflags --libs dalembert) -o embed
 *
 * Prints t, q, v and the constraint D ten times on the way to t = 10. */
#include <dalembert.h>
#include <stdio.h>

static int fail(const dal_error *error)
{
    fprintf(stderr, "embed: %s: %s\n", dal_status_text(error->status), error->message);
    return 1;
}

int main(void)
{
    dal_model *model;
    dal_run *run;
    dal_error error;
    double seen[16]; /* the sleigh has fewer observables; D is the first */
    dal_run_spec spec = {.options = dal_options_default()};
    spec.options.step = 0.01;

    if (dal_model_builtin(&model, "chaplygin-sleigh", &error)) return fail(&error);
    if (dal_model_system(model, &spec.system, &error)) return fail(&error);
    if (dal_method_parse(&spec.method, "gauss4+project", &error)) return fail(&error);
    if (dal_run_create(&run, &spec, &error)) return fail(&error);

    for (int row = 0; row < 10; row++) {
        if (dal_run_advance(run, 100, &error)) return fail(&error);
        dal_run_observe(run, seen);
        printf("%.17g", dal_run_time(run));
        for (int i = 0; i < 2 * spec.system->n; i++) printf(" %.17g", dal_run_state(run)[i]);
        printf(" %.3g\n", seen[0]);
    }
    dal_run_free(run);
    dal_model_free(model);
    return 0;
}
