/* prediction.c - why a drift cannot be predicted. */
#include "dynamics/prediction.h"
#include "core/error.h"
#include "core/settings.h"

dal_status dal__predict_refuse(const dal__prediction_work *w, const char *reason)
{
    char method[256];
    return dal__fail(w->error, DAL_STATUS_UNSUPPORTED, "no drift of %s can be predicted: %s",
                     dal_method_name(&w->spec.method, method, sizeof method), reason);
}

dal_status dal__predict_check_method(const dal__prediction_work *w)
{
    const unsigned properties = dal_method_properties(&w->spec.method);
    if (w->spec.options.tolerance != 0.0)
        return dal__predict_refuse(w, "a tolerance makes steps that depend on those before");
    if (properties & DAL_PERSISTENT_MULTIPLIER)
        return dal__predict_refuse(
            w, "its multipliers pass from step to step, and steps begun on the exact "
               "motion have none");
    if (properties & DAL_PERSISTENT_ACCELERATION)
        return dal__predict_refuse(w, "its accelerations pass from step to step");
    if (properties & DAL_PRESERVES_D_MIDPOINT && !(properties & DAL_PRESERVES_D))
        return dal__predict_refuse(w, "it has D = 0 at midpoints alone, and turns D into -D");
    if (w->spec.options.precision != DAL_DOUBLE)
        return dal__predict_refuse(w, "runs in quad precision are not predicted");
    if (w->spec.system->properties & DAL_VAKONOMIC)
        return dal__predict_refuse(w, "the motion is vakonomic");
    if (w->spec.system->holonomic > 0)
        return dal__predict_refuse(w, "the system has holonomic constraints");
    return dal__refuse_events(w->spec.system, "predictions", w->error);
}
