/* table.c - tables of texts on standard output. */
#include "table.h"
#include "memory.h"
#include "wrap.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LEAST_TEXT = 40 /* columns */ };

void cli_table_append(cli_table *t, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    char *row = cli_format_list(format, list), *cell = row;
    va_end(list);
    for (t->columns = 0; cell; t->columns++) {
        char *end = strchr(cell, '\t');
        if (end) *end++ = '\0';
        if (t->cells == t->capacity) {
            t->capacity = t->capacity ? 2 * t->capacity : 64;
            t->cell = cli_realloc(t->cell, (size_t)t->capacity * sizeof *t->cell);
        }
        t->cell[t->cells++] = cli_strdup(cell);
        cell = end;
    }
    free(row);
}

/* Of each column the longest cell. */
static void measure(const cli_table *t, int widths[CLI_TABLE_COLUMNS])
{
    memset(widths, 0, CLI_TABLE_COLUMNS * sizeof *widths);
    for (int k = 0; k < t->cells; k++) {
        const int width = cli_columns(t->cell[k]), i = k % t->columns;
        if (width > widths[i]) widths[i] = width;
    }
}

static void print_rule(int length)
{
    while (length-- > 0) putchar('-');
}

void cli_table_print_markdown(const cli_table *t)
{
    int widths[CLI_TABLE_COLUMNS];
    measure(t, widths);
    for (int k = 0; k < t->cells; k++) {
        const int i = k % t->columns;
        printf("| %s%*s %s", t->cell[k], widths[i] - cli_columns(t->cell[k]), "",
               i == t->columns - 1 ? "|\n" : "");
        if (k != t->columns - 1) continue;
        for (int j = 0; j < t->columns; j++) {
            putchar('|');
            print_rule(widths[j] + 2);
        }
        puts("|");
    }
}

/* The first columns side by side; the others in lines of their own, below. */
static void print_row(const cli_table *t, char **cell, const int *widths, int side_by_side)
{
    char rest[1024] = "";
    size_t n = 0;
    const int last = side_by_side - 1;
    for (int i = 0; i < last; i++)
        printf("%s%*s", cell[i], widths[i] - cli_columns(cell[i]) + 2, "");
    puts(cell[last]);
    for (int i = last + 1; i < t->columns && n < sizeof rest; i++)
        n += (size_t)snprintf(rest + n, sizeof rest - n, "%s%s", n > 0 ? "; " : "    ", cell[i]);
    if (n > 0) cli_wrap(stdout, rest, 0, 4);
}

static void print_rules(const int *widths, int columns)
{
    for (int i = 0; i < columns; i++) {
        print_rule(widths[i]);
        fputs(i == columns - 1 ? "\n" : "  ", stdout);
    }
}

void cli_table_print_long(const cli_table *t, int width)
{
    int widths[CLI_TABLE_COLUMNS];
    measure(t, widths);
    int side_by_side = 1, used = widths[0] + 2;
    while (side_by_side < t->columns && (width == 0 || used + widths[side_by_side] <= width))
        used += widths[side_by_side++] + 2;
    print_row(t, t->cell, widths, side_by_side);
    print_rules(widths, side_by_side);
    for (int k = t->columns; k < t->cells; k += t->columns)
        print_row(t, t->cell + k, widths, side_by_side);
}

void cli_table_print_short(const cli_table *t, int width)
{
    int widths[CLI_TABLE_COLUMNS], shown[CLI_TABLE_COLUMNS], rules[CLI_TABLE_COLUMNS];
    int count = 0, used = 0;
    measure(t, widths);
    for (int i = 0; i < t->text; i++) {
        if (i > 0 && used + widths[i] + 2 + LEAST_TEXT > width) continue;
        used += widths[i] + 2;
        rules[count] = widths[i];
        shown[count++] = i;
    }
    const int room = width > used ? width - used : 1;
    rules[count] = room < widths[t->text] ? room : widths[t->text];
    for (int k = 0; k < t->cells; k += t->columns) {
        if (k == t->columns) print_rules(rules, count + 1);
        for (int i = 0; i < count; i++) {
            const char *cell = t->cell[k + shown[i]];
            printf("%s%*s", cell, rules[i] - cli_columns(cell) + 2, "");
        }
        cli_wrap_to(stdout, t->cell[k + t->text], used, used, width);
    }
}

void cli_table_free(cli_table *t)
{
    for (int k = 0; k < t->cells; k++) free(t->cell[k]);
    free(t->cell);
}
