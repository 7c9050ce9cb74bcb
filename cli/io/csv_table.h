/* csv_table.h - CSV files in memory. */
#ifndef DAL_CLI_CSV_TABLE_H
#define DAL_CLI_CSV_TABLE_H

#include <stdbool.h>

/* cell[row * columns + column], row 0 being the heads. */
typedef struct csv_table {
    char *text, **cell;
    char *appended; /* texts of csv_table_append */
    int rows, columns;
} csv_table;

/* Reads a file of whole rows, with a head for each column and without control characters.  Returns
 * CLI_DONE; or prints, returns an exit status and leaves no rows; free it in any case. */
int csv_table_read(csv_table *csv, const char *path);
void csv_table_free(csv_table *csv);
/* Appends to each text under a head that under another one, after a space, where that is a positive
 * number. */
void csv_table_append(csv_table *csv, const char *head, const char *other);
/* Whether it has a column: CLI_DONE, or CLI_USAGE and a message. */
int csv_table_require(const csv_table *csv, const char *path, const char *head);
/* The cell of a row under a head; "" where there is none.  Its number, NaN for no text.  Whether it
 * is a text. */
const char *csv_table_get(const csv_table *csv, int row, const char *head);
double csv_table_number(const csv_table *csv, int row, const char *head);
bool csv_table_is(const csv_table *csv, int row, const char *head, const char *text);

enum { CSV_WORDS = 512 };

/* Distinct texts, in the order in which they were added. */
typedef struct csv_words {
    const char *word[CSV_WORDS];
    int count;
} csv_words;
void csv_add_word(csv_words *words, const char *text);

#endif
