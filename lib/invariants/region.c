/* region.c - about the start of a motion, in its own units. */
#include "invariants/region.h"
#include "core/vectors.h"
#include "model/model.h"
#include <stdlib.h>
#include <string.h>

dal_status dal__region_find(const dal__equations *e, const dal_run_spec *spec, double distance,
                            double *centre, double *reach, dal_error *error)
{
    const int state = 2 * e->n + e->multipliers;
    dal_scaled *scaled = NULL;
    dal_evaluator *evaluator = NULL;
    double *start = dal__numbers(1, (size_t)state + 1);
    dal_status status = start ? dal_scaled_create(&scaled, spec, error) : dal__memory_error(error);
    if (status == DAL_STATUS_OK)
        status = dal_evaluator_create(&evaluator, spec->system, spec->parameters,
                                      spec->parameter_count, error);
    if (status == DAL_STATUS_OK)
        status = dal_evaluator_start_at(evaluator, spec->start_time, spec->start, spec->start_count,
                                        start, error);
    for (int i = 0; status == DAL_STATUS_OK && i < e->parameters; i++) {
        centre[i] = e->value[i];
        for (int k = 0; k < spec->parameter_count; k++)
            if (strcmp(spec->parameters[k].name, e->parameter[i]) == 0)
                centre[i] = spec->parameters[k].value;
    }
    for (int i = -1; status == DAL_STATUS_OK && i < state; i++) {
        const int symbol = i < 0          ? e->t
                           : i < e->n     ? e->q + i
                           : i < 2 * e->n ? e->v + i - e->n
                                          : e->g + i - 2 * e->n;
        centre[symbol] = i < 0 ? spec->start_time : start[i];
        reach[symbol] = distance * dal_scaled_units(scaled)[1 + i];
    }
    free(start);
    dal_evaluator_free(evaluator);
    dal_scaled_free(scaled);
    return status;
}
