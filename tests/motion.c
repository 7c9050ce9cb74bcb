/* motion.c - see motion.h. */
#include "motion.h"

#include <CUnit/Basic.h>
#include <math.h>

motion motion_open(const char *name, dal_space space, double step, motion_settings parameters,
                   motion_settings start)
{
    motion z = {.b = reference_builtin(name)};
    dal_run_spec spec = {.system = z.b.system,
                         .options = dal_options_default(),
                         .parameters = parameters.item,
                         .parameter_count = parameters.count,
                         .start = start.item,
                         .start_count = start.count};
    spec.options.step = step;
    spec.options.space = space;
    for (int i = 0; i < parameters.count; i++)
        reference_set(&z.b, parameters.item[i].name, parameters.item[i].value);
    CU_ASSERT_FATAL(dal_method_parse(&spec.method, "gauss8", NULL) == DAL_STATUS_OK);
    CU_ASSERT_FATAL(dal_run_create(&z.run, &spec, NULL) == DAL_STATUS_OK);
    z.step = step;
    z.n = z.b.system->n;
    z.x = dal_run_state(z.run);
    return z;
}

motion motion_default(const char *name, double step)
{
    return motion_open(name, DAL_PHYSICAL, step, (motion_settings){0}, (motion_settings){0});
}

void motion_advance(motion *z, double time)
{
    double left = time - dal_run_time(z->run);
    CU_ASSERT_FATAL(dal_run_advance(z->run, llround(left / z->step), NULL) == DAL_STATUS_OK);
    CU_ASSERT(fabs(dal_run_time(z->run) - time) <= 1e-13 * (1.0 + time));
    z->x = dal_run_state(z->run);
}

void motion_close(motion *z)
{
    dal_run_free(z->run);
    reference_free(&z->b);
}

static double value_of(const motion *z, dal_callback *call, int i)
{
    double out[REFERENCE_OUT];
    CU_ASSERT(reference_call(&z->b, call, dal_run_time(z->run), z->x, z->x + z->n, out) ==
              DAL_STATUS_OK);
    return out[i];
}

void motion_field(const motion *z, double *F)
{
    reference_call(&z->b, z->b.system->call.field, dal_run_time(z->run), z->x, z->x + z->n, F);
}

double motion_invariant(const motion *z, int i)
{
    return value_of(z, z->b.system->invariant_values, i);
}

double motion_energy(const motion *z) { return value_of(z, z->b.system->energy, 0); }
