/* settings.c - what callers give a run: parameters, start values and a system (see dalembert.h,
 * conventions). */
#include "core/settings.h"
#include "core/error.h"
#include "dalembert_program.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

dal_status dal__check_settings(const dal_setting *settings, int count, const char *what,
                               dal_error *error)
{
    if (count < 0)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "the number of %s is negative: %d", what,
                         count);
    if (count > 0 && !settings)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "the %s are NULL, their number is %d", what,
                         count);
    for (int i = 0; i < count; i++)
        if (!settings[i].name)
            return dal__fail(error, DAL_STATUS_ARGUMENT, "the name of number %d of the %s is NULL",
                             i + 1, what);
    return DAL_STATUS_OK;
}

dal_status dal__find_parameter(const dal_system *s, const char *name, int *number, dal_error *error)
{
    const int names = s->parameter ? s->parameters : 0;
    for (int i = 0; i < names; i++) {
        *number = i;
        if (strcmp(s->parameter[i], name) == 0) return DAL_STATUS_OK;
    }
    if (names == 0 || dal__nearest_name(name, s->parameter, names))
        return dal__unknown(error, "parameter", name, s->parameter, names);
    char list[160] = "";
    size_t n = 0;
    for (int i = 0; i < names && n + DAL__MAX_SHOWN + 6 < sizeof list; i++)
        n += (size_t)snprintf(list + n, sizeof list - n, "%s%.*s", i > 0 ? ", " : "",
                              DAL__MAX_SHOWN, s->parameter[i]);
    return dal__fail(error, DAL_STATUS_NAME, "unknown parameter '%.*s'; there is %s",
                     DAL__MAX_SHOWN, name, list);
}

const char *dal__name_constraint(int m, int holonomic, int a, char *name, size_t size)
{
    const int first = m - holonomic;
    if (a < first)
        snprintf(name, size, "constraint %d", a + 1);
    else
        snprintf(name, size, "holonomic constraint %d", a - first + 1);
    return name;
}

const char *dal__mass_words(const dal_system *s)
{
    return s->properties & DAL_MASS_ON_KERNEL
               ? "the mass matrix, on the velocities that the constraints allow,"
               : "the mass matrix";
}

dal_status dal__set_parameters(const dal_system *s, const dal_setting *settings, int count,
                               dal_status not_finite, double *value, dal_error *error)
{
    for (int i = 0; i < s->parameters; i++) value[i] = s->value ? s->value[i] : 0.0;
    for (int k = 0; k < count; k++) {
        int i;
        DAL_TRY(dal__find_parameter(s, settings[k].name, &i, error));
        if (!isfinite(settings[k].value))
            return dal__fail(error, not_finite, "parameter %s: %g is not a finite number",
                             settings[k].name, settings[k].value);
        value[i] = settings[k].value;
    }
    return DAL_STATUS_OK;
}

dal_status dal__check_spec(const dal_run_spec *spec, dal_error *error)
{
    if (!spec) return dal__fail(error, DAL_STATUS_ARGUMENT, "the spec of a run is NULL");
    if (!spec->system) return dal__fail(error, DAL_STATUS_ARGUMENT, "a run needs a system");
    DAL_TRY(dal__check_settings(spec->parameters, spec->parameter_count, "parameters", error));
    return dal__check_settings(spec->start, spec->start_count, "start values", error);
}

dal_status dal__refuse_events(const dal_system *system, const char *what, dal_error *error)
{
    if (system->events == 0) return DAL_STATUS_OK;
    return dal__fail(error, DAL_STATUS_UNSUPPORTED, "%.80s has events: %s would pass over them",
                     system->name ? system->name : "the system", what);
}
