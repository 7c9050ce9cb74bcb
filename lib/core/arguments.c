/* arguments.c - what public functions require of their arguments: see dalembert.h, conventions. */
#include "core/arguments.h"
#include <math.h>
#include <string.h>

dal_status dal__missing(dal_error *error, const char *function, const char *argument)
{
    return dal__fail(error, DAL_ARGUMENT, "%s: %s is NULL", function, argument);
}

dal_status dal__negative(dal_error *error, const char *function, const char *argument,
                         long long value)
{
    return dal__fail(error, DAL_ARGUMENT, "%s: %s is negative: %lld", function, argument, value);
}

dal_status dal__check_settings(const dal_setting *settings, int count, const char *what,
                               dal_error *error)
{
    if (count < 0)
        return dal__fail(error, DAL_ARGUMENT, "the number of %s is negative: %d", what, count);
    if (count > 0 && !settings)
        return dal__fail(error, DAL_ARGUMENT, "the %s are NULL, their number is %d", what, count);
    for (int i = 0; i < count; i++)
        if (!settings[i].name)
            return dal__fail(error, DAL_ARGUMENT, "the name of number %d of the %s is NULL", i + 1,
                             what);
    return DAL_OK;
}

dal_status dal__set_parameters(const dal_system *s, const dal_setting *settings, int count,
                               dal_status not_finite, double *value, dal_error *error)
{
    const int names = s->parameter ? s->parameters : 0;
    for (int i = 0; i < s->parameters; i++) value[i] = s->value ? s->value[i] : 0.0;
    for (int k = 0; k < count; k++) {
        int i = 0;
        while (i < names && strcmp(s->parameter[i], settings[k].name) != 0) i++;
        if (i == names)
            return dal__unknown(error, "parameter", settings[k].name, s->parameter, names);
        if (!isfinite(settings[k].value))
            return dal__fail(error, not_finite, "parameter %s: %g is not a finite number",
                             settings[k].name, settings[k].value);
        value[i] = settings[k].value;
    }
    return DAL_OK;
}

dal_status dal__check_spec(const dal_run_spec *spec, dal_error *error)
{
    if (!spec) return dal__fail(error, DAL_ARGUMENT, "the spec of a run is NULL");
    if (!spec->system) return dal__fail(error, DAL_ARGUMENT, "a run needs a system");
    DAL_TRY(dal__check_settings(spec->parameters, spec->parameter_count, "parameters", error));
    return dal__check_settings(spec->start, spec->start_count, "start values", error);
}
