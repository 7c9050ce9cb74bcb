/* study_compare.h - the expectations of a study compared with its results. */
#ifndef DAL_CLI_STUDY_COMPARE_H
#define DAL_CLI_STUDY_COMPARE_H

#include "study_data.h"

#include <stdbool.h>
#include <stdio.h>

/* How many expectations are not met. */
int study_count_unmet(const study_plan *plan);
/* Whether an expectation is that this cell fails. */
bool study_failure_is_expected(const study_plan *plan, const study_cell *cell);

/* An expectation and a run that it is compared with. */
typedef struct study_comparison {
    const struct study_expectation *expectation;
    const study_cell *cell; /* NULL: no run has the quantity */
    bool is_met;
} study_comparison;
typedef struct study_comparisons {
    study_comparison *item; /* [count]; free it */
    int count, unmet;
    int failed, aborted; /* unmet, since the run failed or a value was not finite */
    int refused;         /* runs that are not compared, since the system refuses the method */
} study_comparisons;
/* All comparisons, in the order of the file. */
study_comparisons study_compare(const study_plan *plan);
/* "Expectations: 3 of 5 are met; 1 failed, 2 refused." */
void study_print_met(FILE *out, const study_comparisons *comparisons);
/* A line about one, without its end, allocated:
 *     LABEL METHOD START h = STEP QUANTITY: expected X, found Y (line N) */
char *study_comparison_text(const study_comparison *comparison);
/* The number of those that are met, and lines about the others; nothing where nothing is expected.
 */
void study_print_expectations(FILE *out, const study_plan *plan);
/* Writes all of them to a file, or removes it where there are none.  Returns CLI_DONE or prints and
 * returns CLI_IO. */
int study_write_expectations(const study_plan *plan, const char *path);

#endif
