/* study_fate.h - what becomes of D and E in the runs of a study, as the screen shows it. */
#ifndef DAL_CLI_STUDY_FATE_H
#define DAL_CLI_STUDY_FATE_H

#include "study_data.h"

#include <stdbool.h>

/* The quantities of the screen. */
typedef enum study_quantity { CONSTRAINT, ENERGY, ERROR, QUANTITIES } study_quantity;

/* What becomes of a quantity in a run that ought to keep it, and how sentences name it. */
#define FATE_LIST(FATE)                                                                            \
    FATE(AT_ROUNDING, "at rounding")                                                               \
    FATE(BOUNDED, "bounded")                                                                       \
    FATE(DRIFTING, "drift")                                                                        \
    FATE(UNDECIDED, "undecided")                                                                   \
    FATE(OFF_SURFACE, "off D = 0")                                                                 \
    FATE(ABORTED, "aborted")                                                                       \
    FATE(FAILED, "failed")                                                                         \
    FATE(REFUSED, "refused")

typedef enum fate {
#define FATE_CODE(code, text) code,
    FATE_LIST(FATE_CODE)
#undef FATE_CODE
        FATES
} fate;

/* The first start of a case. */
study_start study_first_start(const study_case *item);
/* NULL where the run has no such quantity, or the motion does not conserve it. */
const dal_trend *study_get_trend(const study_cell *cell, study_quantity quantity);
/* Off D = 0 a number is known of E, but neither size nor trend. */
bool study_is_stated(const dal_trend *trend);
bool study_is_at_rounding(const dal_trend *trend);
/* About one value in the end, however far from the first. */
bool study_is_bounded(const dal_trend *trend);
bool study_is_drifting(const dal_trend *trend);
/* FATES where there is nothing to keep, or the run is not finished. */
fate study_find_fate(const study_cell *cell, study_quantity quantity);

#endif
