/* study_fate.c - what becomes of D and E in the runs of a study, as the screen shows it. */
#include "study_fate.h"

study_start study_first_start(const study_case *e)
{
    study_start start = 0;
    while (!(e->starts >> start & 1)) start++;
    return start;
}

const dal_trend *study_get_trend(const study_cell *c, study_quantity quantity)
{
    const dal_trend *trend = quantity == CONSTRAINT ? study_cell_constraint(c)
                             : quantity == ENERGY   ? study_cell_trend(c, "E")
                                                    : study_cell_trend(c, "error");
    return trend && trend->conservation != DAL_NOT_CONSERVED ? trend : NULL;
}

bool study_is_stated(const dal_trend *trend) { return trend->conservation == DAL_CONSERVED; }

bool study_is_at_rounding(const dal_trend *trend)
{
    return trend->size != DAL_SIZE_LARGER && trend->trend != DAL_TREND_ABORTED;
}

bool study_is_bounded(const dal_trend *trend)
{
    return trend->trend == DAL_TREND_NONE || trend->trend == DAL_TREND_SETTLES ||
           (trend->size == DAL_SIZE_EXACT && trend->trend != DAL_TREND_ABORTED);
}

bool study_is_drifting(const dal_trend *trend)
{
    return !study_is_bounded(trend) && trend->trend != DAL_TREND_UNDECIDED &&
           trend->trend != DAL_TREND_ABORTED;
}

fate study_find_fate(const study_cell *c, study_quantity quantity)
{
    const dal_system *s = c->of_case->system;
    const bool is_conserved = /* at least on D = 0 */
        quantity == CONSTRAINT
            ? s->m > 0
            : quantity == ENERGY && s->energy && s->properties & (DAL_E_EXACT | DAL_E_ON_D);
    if (!is_conserved || c->state == STUDY_WAITING) return FATES;
    if (c->state != STUDY_FINISHED) return c->state == STUDY_FAILED ? FAILED : REFUSED;
    const dal_trend *trend = study_get_trend(c, quantity);
    if (!trend) return FATES;
    if (trend->trend == DAL_TREND_ABORTED) return ABORTED;
    if (!study_is_stated(trend)) return OFF_SURFACE;
    if (study_is_at_rounding(trend)) return AT_ROUNDING;
    if (study_is_bounded(trend)) return BOUNDED;
    return study_is_drifting(trend) ? DRIFTING : UNDECIDED;
}
