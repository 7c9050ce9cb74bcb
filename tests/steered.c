/* steered.c - see steered.h. */
#include "steered.h"

#include "fixtures.h"
#include <CUnit/CUnit.h>
#include <string.h>

const char steered_sleigh[] =
    "coordinates: [x, y, phi]\nparameters: {m: 1.3, I: 0.7}\n"
    "lagrangian: m/2*(x'^2 + y'^2) + I/2*phi'^2\nconstraints: [x'*sin(phi) - y'*cos(phi)]\n";

const char steered_unstable[] = "coordinates: [x]\naccelerations: {x: x - x'}\nstart: {x: 1}\n";

void steered_open(steered *s, const char *text, dal_effort effort, const char *method, double step)
{
    const dal_system *system;
    *s = (steered){.model = fixture_model(text), .settings = dal_steer_settings_default()};
    CU_ASSERT_EQUAL_FATAL(dal_model_set_effort(s->model, effort, &s->record), DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(dal_model_system(s->model, &system, &s->record), DAL_STATUS_OK);
    s->spec = fixture_spec(system, method, DAL_LIFTED, step);
    s->settings.rest = true;
}

void steered_close(steered *s)
{
    dal_steer_free(s->steering);
    dal_model_free(s->model);
}

dal_status steered_try(steered *s, double T, const dal_setting *target, int targets)
{
    dal_steer_free(s->steering);
    s->settings.target = target;
    s->settings.targets = targets;
    const dal_status status = dal_steer_create(&s->steering, s->model, &s->spec, T, &s->settings,
                                               s->observer, &s->record);
    s->best = s->steering ? s->steering->extremal : NULL;
    return status;
}

void steered_find(steered *s, double T, const dal_setting *target, int targets)
{
    const dal_status status = steered_try(s, T, target, targets);
    if (status != DAL_STATUS_OK) printf("\n  %s\n", s->record.message);
    CU_ASSERT_EQUAL_FATAL(status, DAL_STATUS_OK);
    CU_ASSERT_EQUAL_FATAL(s->steering->count > 0, true);
    CU_ASSERT_EQUAL(s->best->status, DAL_STATUS_OK);
    CU_ASSERT_STRING_EQUAL(s->best->message, "");
    CU_ASSERT(s->best->residual <= s->settings.tolerance);
    const double *z = s->best->z + (s->steering->rows - 1) * s->steering->dimension;
    for (int i = 0; i < targets; i++)
        for (int k = 0; k < s->steering->n; k++)
            if (strcmp(s->spec.system->coordinate[k], target[i].name) == 0)
                CU_ASSERT_DOUBLE_EQUAL(z[k], target[i].value, 1e-10);
}

double *steered_row(const steered *s, long long row)
{
    return s->best->z + row * s->steering->dimension;
}
