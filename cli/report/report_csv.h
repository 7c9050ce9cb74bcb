/* report_csv.h - CSV files in memory. */
#ifndef DAL_CLI_REPORT_CSV_H
#define DAL_CLI_REPORT_CSV_H

#include <stdbool.h>

/* cell[row * columns + column], row 0 being the heads. */
typedef struct report_csv {
    char *text, **cell;
    char *appended; /* texts of report_csv_append */
    int rows, columns;
} report_csv;

/* Reads a file of whole rows, with a head for each column and without control characters.  Returns
 * CLI_DONE; or prints, returns an exit status and leaves no rows; free it in any case. */
int report_csv_read(report_csv *csv, const char *path);
void report_csv_free(report_csv *csv);
/* Appends to each text under a head that under another one, after a space, where that is a positive
 * number. */
void report_csv_append(report_csv *csv, const char *head, const char *other);
/* Whether it has a column: CLI_DONE, or CLI_USAGE and a message. */
int report_csv_require(const report_csv *csv, const char *path, const char *head);
/* The cell of a row under a head; "" where there is none.  Its number, NaN for no text.  Whether it
 * is a text. */
const char *report_csv_get(const report_csv *csv, int row, const char *head);
double report_csv_number(const report_csv *csv, int row, const char *head);
bool report_csv_is(const report_csv *csv, int row, const char *head, const char *text);

enum { REPORT_WORDS = 512 };

/* Distinct texts, in the order in which they were added. */
typedef struct report_words {
    const char *word[REPORT_WORDS];
    int count;
} report_words;
void report_add_word(report_words *words, const char *text);

#endif
