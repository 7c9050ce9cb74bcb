/* study_expect.h - the expectations of a study, read from its file and compared with results. */
#ifndef DAL_CLI_STUDY_EXPECT_H
#define DAL_CLI_STUDY_EXPECT_H

#include "study_plan.h"

#include <stdbool.h>
#include <stdio.h>

/* Reads `expect` into a plan with its cells; node may be NULL.  Returns CLI_DONE, or prints and
 * returns CLI_USAGE. */
int study_expect_read(study_plan *plan, yaml_node_t *node);
/* How many expectations are not met. */
int study_count_unmet(const study_plan *plan);
/* Whether an expectation is that this cell fails. */
bool study_failure_is_expected(const study_plan *plan, const study_cell *cell);
/* The unmet ones and their number; nothing where nothing is expected. */
void study_print_expectations(FILE *out, const study_plan *plan);
/* Writes all of them to a file, or removes it where there are none.  Returns CLI_DONE or prints and
 * returns CLI_IO. */
int study_write_expectations(const study_plan *plan, const char *path);

#endif
