/* study_expect.h - what a study states beforehand of its own results. */
#ifndef DAL_CLI_STUDY_EXPECT_H
#define DAL_CLI_STUDY_EXPECT_H

#include "dalembert.h"
#include "io/document.h"
#include "study.h"

#include <stddef.h>

/* What bounds may be set to: name, member of dal_trend. */
#define STUDY_FIELD_LIST(X)                                                                        \
    X(max, max_abs)                                                                                \
    X(deviation, deviation)                                                                        \
    X(final, last)                                                                                 \
    X(amplitude, amplitude)                                                                        \
    X(rate, rate)                                                                                  \
    X(rate_low, rate_low)                                                                          \
    X(rate_high, rate_high)                                                                        \
    X(exponent, exponent)                                                                          \
    X(confidence, confidence)

enum {
#define X(name, member) STUDY_FIELD_##name,
    STUDY_FIELD_LIST(X)
#undef X
        STUDY_FIELDS
};

/* One thing that is asked: one of some words, or a number within bounds. */
struct study_expectation {
    const char *label, *method, *quantity; /* as they are written */
    double step;                           /* of this alone; 0: of all */
    int start;                             /* of this alone; -1: of all */
    size_t line;
    unsigned words;     /* bit k: size k, bit DAL_SIZE_COUNT + k: trend k, any of which will do; of
                           the quantity "state" bit k: state k; 0: bounds */
    int field;          /* STUDY_FIELD_x that has bounds, -1: none */
    double least, most; /* infinite where there is no bound */
};

/* Reads `expect`, node being NULL where there is none; the cases are complete.  Returns CLI_DONE
 * or prints and returns an exit status. */
int study_expect_read(study_plan *plan, const document *doc, yaml_node_t *node);

/* Whether a case is meant by a label: its own, its group's, its system's, or all; and a method
 * by its name, or all, or all with modifiers: those with just these. */
int study_case_matches(const study_case *item, const char *label);
int study_method_matches(const dal_method *method, const char *name);
/* Whether something is said of a cell. */
int study_expectation_covers(const study_expectation *expectation, const study_cell *cell);
/* D, D1, D2, ... */
int study_is_constraint(const char *quantity);

#endif
