/* own_integrator.c - an integrator outside the library: Heun's method, used by its address.
 *
 *     k1 = f(t, y),   k2 = f(t + h, y + h k1),   y1 = y + h/2 (k1 + k2)
 *
 * Needs the two installed headers and the library, nothing of its sources. */
#include <dalembert.h>
#include <dalembert_kernel.h>
#include <stdio.h>

DAL_INLINE dal_status step(dal_step *s)
{
    DAL_VECTOR(s, k1, DAL_DIM(s));
    DAL_VECTOR(s, k2, DAL_DIM(s));
    DAL_VECTOR(s, y, DAL_DIM(s));
    dal_field(s, s->t, s->y, k1);
    DAL_EACH(i, DAL_DIM(s)) y[i] = s->y[i] + s->h * k1[i];
    dal_field(s, s->t + s->h, y, k2);
    DAL_EACH(i, DAL_DIM(s)) y[i] = 0.5 * s->h * (k1[i] + k2[i]);
    return dal_update(s, s->h, y);
}

DAL_INTEGRATOR(heun, step, .name = "heun", .summary = "Heun's method", .reference = "Heun 1900",
               .order = 2, .stages = 2, .properties = DAL_EXPLICIT, .needs = DAL_NEEDS_FIELD);

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
