/* table.h - tables of texts on standard output. */
#ifndef DAL_CLI_TABLE_H
#define DAL_CLI_TABLE_H

#include "message.h"

enum { CLI_TABLE_COLUMNS = 8 };

/* The first row has the headings.  Begin with {.text = column}; free it. */
typedef struct cli_table {
    int text; /* the column of free text, which a short table wraps */
    int columns, cells, capacity;
    char **cell;
} cli_table;

/* Adds a row of cells between tabs. */
void cli_table_append(cli_table *table, const char *format, ...) CLI_PRINTF(2, 3);
void cli_table_print_markdown(const cli_table *table);
/* Prints all columns: side by side those that fit a width, the others below; 0: any width. */
void cli_table_print_long(const cli_table *table, int width);
/* Prints the text, and of the columns before it those that leave it room. */
void cli_table_print_short(const cli_table *table, int width);
void cli_table_free(cli_table *table);

#endif
