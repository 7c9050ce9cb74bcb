/* study_expect.h - the expectations of a study, read from its file. */
#ifndef DAL_CLI_STUDY_EXPECT_H
#define DAL_CLI_STUDY_EXPECT_H

#include "study_data.h"

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

/* Reads `expect` into a plan with its cells; node may be NULL.  Returns CLI_DONE, or prints and
 * returns CLI_USAGE. */
int study_expect_read(study_plan *plan, yaml_node_t *node);
/* Whether a label means a case: its own, its item's, its system's, or all. */
bool study_label_means(const study_case *item, const char *label);
/* Whether the runs of a case have a quantity of this name. */
bool study_has_quantity(const study_case *item, const char *name);
/* Whether a quantity is one of lifted runs alone. */
bool study_is_of_lift(const char *name);
/* Whether an expectation is about a cell. */
bool study_expectation_covers(const study_expectation *x, const study_cell *cell);
/* Whether it is about the state of a run, not about a quantity. */
bool study_expects_state(const study_expectation *x);

#endif
