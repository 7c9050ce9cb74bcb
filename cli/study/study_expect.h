/* study_expect.h - the expectations of a study, from its file. */
#ifndef DAL_CLI_STUDY_EXPECT_H
#define DAL_CLI_STUDY_EXPECT_H

#include "study_plan.h"

#include <stdbool.h>

/* What bounds may be set to: name, member of dal_trend. */
#define STUDY_FIELD_LIST(FIELD)                                                                    \
    FIELD(max, max_abs)                                                                            \
    FIELD(deviation, deviation)                                                                    \
    FIELD(final, last)                                                                             \
    FIELD(amplitude, amplitude)                                                                    \
    FIELD(rate, rate)                                                                              \
    FIELD(rate_low, rate_low)                                                                      \
    FIELD(rate_high, rate_high)                                                                    \
    FIELD(exponent, exponent)                                                                      \
    FIELD(confidence, confidence)

enum {
#define FIELD_NUMBER(name, member) STUDY_FIELD_##name,
    STUDY_FIELD_LIST(FIELD_NUMBER)
#undef FIELD_NUMBER
        STUDY_FIELDS
};

/* One of some words, or a number within bounds. */
typedef struct study_expectation {
    const char *label, *method, *quantity; /* as they are written */
    double step;                           /* of these cells alone; 0: of all */
    int start;                             /* of these cells alone; -1: of all */
    size_t line;
    unsigned words;  /* bit k: size k, bit DAL_SIZE_COUNT + k: trend k, any of which will do; of
                        the quantity "state" bit k: state k; 0: bounds */
    int field;       /* STUDY_FIELD_x that has bounds, -1: none */
    double min, max; /* infinite where there is no bound */
} study_expectation;

/* Reads `expect` into a plan with its cells; node may be NULL.  Returns CLI_DONE, or prints and
 * returns CLI_USAGE. */
int study_expect_read(study_plan *plan, yaml_node_t *node);

/* Whether an expectation is about a cell. */
bool study_expectation_covers(const study_expectation *expectation, const study_cell *cell);
bool study_expectation_is_state(const study_expectation *expectation);

#endif
