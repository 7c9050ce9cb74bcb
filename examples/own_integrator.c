/* own_integrator.c - an integrator outside the library, used by its address.
 *
 * Needs the two installed headers and the library, nothing of its sources. */
#include <dalembert.h>
#include <stdio.h>

#include "heun.c"

int main(void)
{
    dal_model *model;
    dal_run *run;
    dal_error error;
    dal_run_spec spec = {.method = {{&dal_integrator_heun}}, .options = dal_options_default()};
    if (dal_model_builtin(&model, "chaplygin-sleigh", &error) ||
        dal_model_system(model, &spec.system, &error) || dal_run_create(&run, &spec, &error) ||
        dal_run_advance(run, 100, &error)) {
        fprintf(stderr, "own_integrator: %s\n", error.message);
        return 1;
    }
    const double *q = dal_run_state(run);
    printf("%.17g %.17g %.17g %.17g\n", dal_run_time(run), q[0], q[1], q[2]);
    dal_run_free(run);
    dal_model_free(model);
    return 0;
}
