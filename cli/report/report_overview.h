/* report_overview.h - the result of a study at the beginning of its page. */
#ifndef DAL_CLI_REPORT_OVERVIEW_H
#define DAL_CLI_REPORT_OVERVIEW_H

#include "io/csv_table.h"
#include "report_page.h"
#include "study/study_plan.h"
#include "study/study_sentences.h"

/* The study in a directory, with the results in its tables, and the names of its systems. */
typedef struct report_overview {
    study_plan plan;
    study_matrix matrix;            /* of all its methods and systems */
    char (*name)[STUDY_SHORT_NAME]; /* [columns of the matrix] */
} report_overview;

/* Reads the study; cells is its cells.csv.  Returns CLI_DONE, or prints and returns an exit status;
 * free it in any case. */
int report_overview_read(report_overview *overview, const char *directory, const csv_table *cells);
void report_overview_free(report_overview *overview);
/* The short name of a label; the label, where the study has no such system. */
const char *report_short_name(const report_overview *overview, const char *label);

/* The sentences of the screen, which methods to take, what to try next, and for D and E a table of
 * families of methods and systems. */
void report_overview_write(report *r, const report_overview *overview);

#endif
