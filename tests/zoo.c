/* zoo.c - see zoo.h. */
#include "zoo.h"

#include <CUnit/Basic.h>
#include <math.h>

zoo zoo_open(const char *name, dal_space space, double step, zoo_settings parameters,
             zoo_settings start)
{
    zoo z = {.b = body_builtin(name)};
    dal_run_spec spec = {.system = z.b.system,
                         .options = dal_options_default(),
                         .parameters = parameters.item,
                         .parameter_count = parameters.count,
                         .start = start.item,
                         .start_count = start.count};
    spec.options.step = step;
    spec.options.space = space;
    for (int i = 0; i < parameters.count; i++)
        body_set(&z.b, parameters.item[i].name, parameters.item[i].value);
    CU_ASSERT_FATAL(dal_method_parse(&spec.method, "gauss8", NULL) == DAL_OK);
    CU_ASSERT_FATAL(dal_run_create(&z.run, &spec, NULL) == DAL_OK);
    z.step = step;
    z.n = z.b.system->n;
    z.x = dal_run_state(z.run);
    return z;
}

zoo zoo_default(const char *name, double step)
{
    return zoo_open(name, DAL_PHYSICAL, step, (zoo_settings){0}, (zoo_settings){0});
}

void zoo_go(zoo *z, double time)
{
    double left = time - dal_run_time(z->run);
    CU_ASSERT_FATAL(dal_run_advance(z->run, llround(left / z->step), NULL) == DAL_OK);
    CU_ASSERT(fabs(dal_run_time(z->run) - time) <= 1e-13 * (1.0 + time));
    z->x = dal_run_state(z->run);
}

void zoo_close(zoo *z)
{
    dal_run_free(z->run);
    body_free(&z->b);
}

static double ask(const zoo *z, dal_callback *call, int i)
{
    double out[BODY_OUT];
    CU_ASSERT(body_call(&z->b, call, dal_run_time(z->run), z->x, z->x + z->n, out) == DAL_OK);
    return out[i];
}

void zoo_field(const zoo *z, double *F)
{
    body_call(&z->b, z->b.system->call.field, dal_run_time(z->run), z->x, z->x + z->n, F);
}

double zoo_invariant(const zoo *z, int i) { return ask(z, z->b.system->invariant_values, i); }

double zoo_energy(const zoo *z) { return ask(z, z->b.system->energy, 0); }
