/* report_cells.h - the cells of a study, and the quantities that its tables and figures show. */
#ifndef DAL_CLI_REPORT_CELLS_H
#define DAL_CLI_REPORT_CELLS_H

#include "dalembert_model.h"
#include "io/csv_table.h"
#include "report_page.h"
#include "study/study_data.h"

#include <stdbool.h>

typedef struct study_page {
    report *r;
    csv_table cells; /* cells.csv */
    csv_words labels, methods, representatives;
    char *title[CSV_WORDS];            /* of the system of each label, or the label */
    const char *short_name[CSV_WORDS]; /* of each label, as the screen has it */
} study_page;

/* Reads a table of cells or orders, in which a step and its tolerance become one text under "step":
 * "0.1 1e-6"; otherwise as csv_table_read. */
int read_steps(csv_table *csv, const char *path);
/* Such a text on the page: "h = 0.1", or "h = 0.1, tolerance 1e-06"; its tolerance, 0 for none. */
const char *step_title(char title[STUDY_DIVISION], const char *step);
double step_tolerance(const char *step);

/* The text of a cell under a head of cells.csv; whether it is another one. */
const char *get_cell(const study_page *s, int row, const char *head);
bool is_cell(const study_page *s, int row, const char *head, const char *text);
/* The label of a row names files of the study, and its run a directory of it: an exit status. */
int check_cell_names(const study_page *s, const char *path, int row);

/* The system of a label: the copy of its file, which is under the first label that has it, or a
 * built-in one; *model is NULL where there is neither. */
int read_label_model(const study_page *s, const char *label, dal_model **model);

/* What tables and figures are about: its column in series/LABEL.csv, those in cells.csv, of which
 * the first is empty where a system lacks it; the texts of its figures; and the title of its table,
 * NULL where there is none. */
typedef enum cell_start { ON_SURFACE, DISPLACED } cell_start; /* p = pi = 0 */
typedef struct quantity {
    const char *column, *value, *size, *trend, *name, *title, *ylabel, *heading;
    cell_start start; /* of the runs that it is shown of */
} quantity;

enum { REPORT_QUANTITIES = 5 };
extern const quantity quantities[REPORT_QUANTITIES];

/* Whether a cell starts as a quantity is shown. */
bool is_shown(const study_page *s, int row, const quantity *t);
/* The row of a cell that starts so, without p and pi rather than on p = pi = 0; 0: none has
 * numbers. */
int find_cell(const study_page *s, const char *label, const char *method, const char *step,
              cell_start start);

#endif
