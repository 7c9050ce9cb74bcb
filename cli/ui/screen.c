/* screen.c - what a person reads on a terminal: at most 24 lines of at most 80 columns. */
#include "screen.h"
#include "memory.h"
#include "screen_format.h"
#include "wrap.h"

#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { GAP = 2 /* between columns */, LEAST_TEXT = 20 };

static bool is_ignored;

bool screen_has_reader(void) { return !is_ignored && isatty(STDOUT_FILENO); }

void screen_ignore_terminal(void) { is_ignored = true; }

FILE *screen_terminal(void)
{
    if (screen_has_reader()) return stdout;
    return isatty(STDERR_FILENO) ? stderr : NULL;
}

bool screen_is_in_colour(FILE *to)
{
    const char *no_colour = getenv("NO_COLOR"), *terminal = getenv("TERM");
    return isatty(fileno(to)) && !(no_colour && no_colour[0]) &&
           !(terminal && strcmp(terminal, "dumb") == 0);
}

int screen_check_format(screen_format format, const char *option, bool is_given)
{
    if (format == SCREEN_TEXT || !is_given) return CLI_DONE;
    return cli_fail(CLI_USAGE, "--format excludes %s", option);
}

bool screen_is_wanted(screen_format format, bool has_other_form)
{
    return format != SCREEN_TEXT || (!has_other_form && screen_has_reader());
}

/* ---- a screen ------------------------------------------------------------------------------ */

void screen_open(screen *s, FILE *to, screen_format format)
{
    enum { ANY_WIDTH = 1 << 15 };
    const int width = to == stderr ? cli_width() : cli_output_width();
    *s = (screen){.to = to, .format = format};
    s->in_colour = format == SCREEN_TEXT && screen_is_in_colour(to);
    s->width = format != SCREEN_TEXT                 ? ANY_WIDTH
               : width > 0 && width < SCREEN_COLUMNS ? width
                                                     : SCREEN_COLUMNS;
    s->out = cli_memstream_open(&s->text, &s->length);
}

int screen_close(screen *s, const char *more)
{
    cli_memstream_close(s->out);
    cli_progress_end();
    int lines = 0;
    const char *cut = s->text; /* after all lines but the one that says how many more there are */
    for (const char *line = s->text; *line; lines++) {
        if (lines == SCREEN_LINES - 1) cut = line;
        line = strchr(line, '\n') + 1;
    }
    const bool is_cut = more && lines > SCREEN_LINES && s->format == SCREEN_TEXT;
    fwrite(s->text, 1, is_cut ? (size_t)(cut - s->text) : s->length, s->to);
    if (is_cut) fprintf(s->to, "... and %d more lines (%s)\n", lines - SCREEN_LINES + 1, more);
    free(s->text);
    return s->to == stdout ? cli_close(stdout, "standard output") : CLI_DONE;
}

int screen_limit(const screen *s, int rows) { return s->format == SCREEN_TEXT ? rows : INT_MAX; }

void screen_say(screen *s, int hanging, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    char *text = cli_format_list(format, list);
    va_end(list);
    const int indent = (int)strspn(text, " ");
    if (s->format != SCREEN_TEXT) {
        screen_format_sentence(s, text + indent);
    } else {
        fprintf(s->out, "%*s", indent, "");
        cli_wrap_to(s->out, text + indent, indent, hanging, s->width);
    }
    free(text);
}

void screen_say_command(screen *s, const char *head, const char *command)
{
    enum { INDENT = 2 };
    if (s->format != SCREEN_TEXT) return;
    int column = fprintf(s->out, "%s", head);
    if (column + GAP + (int)strlen(command) <= s->width) {
        column += fprintf(s->out, "%*s", GAP, "");
    } else {
        fprintf(s->out, "\n%*s", INDENT, "");
        column = INDENT;
    }
    while (*command) {
        const char *end = strstr(command + 1, " -");
        const int length = end ? (int)(end - command) : (int)strlen(command);
        /* Room is left for the backslash. */
        if (column + length + (end ? 2 : 0) > s->width && column > 2 * INDENT) {
            column = fprintf(s->out, " \\\n%*s", 2 * INDENT, "") - 3;
            command++;
            continue;
        }
        column += fprintf(s->out, "%.*s", length, command);
        command += length;
    }
    fputc('\n', s->out);
}

void screen_say_items(screen *s, const char *const *items, int count, int lines, const char *more)
{
    enum { INDENT = 2, SPACES = 3 };
    int column = 0, line = 1;
    if (s->format != SCREEN_TEXT) {
        char *sentence = screen_list_names(items, count, INT_MAX / 2);
        screen_format_sentence(s, sentence);
        free(sentence);
        return;
    }
    const int width = s->width - (int)strlen(more) - (int)sizeof "   ... and 999 more ()";
    for (int i = 0; i < count; i++) {
        const int length = (int)strlen(items[i]);
        if (line == lines && i < count - 1 && column + SPACES + length > width) {
            fprintf(s->out, "%*s... and %d more%s%s%s", SPACES, "", count - i, *more ? " (" : "",
                    more, *more ? ")" : "");
            break;
        }
        if (column > 0 && column + SPACES + length > s->width) {
            fputc('\n', s->out);
            column = 0;
            line++;
        }
        column += fprintf(s->out, "%*s%s", column > 0 ? SPACES : INDENT, "", items[i]);
    }
    fputc('\n', s->out);
}

int screen_count_lines(screen *s)
{
    int lines = 0;
    fflush(s->out);
    for (const char *text = s->text; (text = strchr(text, '\n')); text++) lines++;
    return lines;
}

void screen_skip(screen *s)
{
    if (s->format == SCREEN_TEXT) fputc('\n', s->out);
}

char *screen_list_names(const char *const *names, int count, int columns)
{
    enum { MORE = sizeof ", ... and 999 more" };
    char *text;
    size_t length;
    int used = 0, i = 0;
    FILE *out = cli_memstream_open(&text, &length);
    for (; i < count; i++) {
        const int needed = (int)strlen(names[i]) + (i > 0 ? 2 : 0);
        if (i > 0 && used + needed + (i < count - 1 ? MORE : 0) > columns) break;
        used += fprintf(out, "%s%s", i > 0 ? ", " : "", names[i]);
    }
    if (i < count) fprintf(out, ", ... and %d more", count - i);
    cli_memstream_close(out);
    return text;
}

/* ---- tables -------------------------------------------------------------------------------- */

void screen_add_cell(screen_table *t, screen_colour colour, const char *format, ...)
{
    if (t->cells == t->capacity) {
        t->capacity = t->capacity ? 2 * t->capacity : 64;
        t->cell = cli_realloc(t->cell, (size_t)t->capacity * sizeof *t->cell);
    }
    va_list list;
    va_start(list, format);
    t->cell[t->cells++] = (screen_cell){cli_format_list(format, list), colour};
    va_end(list);
}

void screen_free_table(screen_table *t)
{
    for (int i = 0; i < t->cells; i++) free(t->cell[i].text);
    free(t->cell);
}

/* One row; the last of the columns that are shown leaves no blanks at the end of the line. */
static void put_row(const screen *s, const screen_table *t, const screen_cell *row,
                    const int *widths, int shown, const char *align, int indent)
{
    static const char *const codes[SCREEN_COLOURS] = {
        [SCREEN_ROUNDING] = "32", [SCREEN_SMALL] = "33", [SCREEN_MEDIUM] = "38;5;208",
        [SCREEN_LARGE] = "31",    [SCREEN_FAINT] = "2",
    };
    const int gap = t->gap ? t->gap : GAP;
    int column = fprintf(s->out, "%*s", indent, ""), blanks = 0;
    for (int i = 0; i < shown; i++) {
        const int spaces = widths[i] - cli_columns(row[i].text);
        const bool is_right = screen_align_of(align, i) == 'r';
        if (screen_align_of(align, i) == 'w' && row[i].text[0]) {
            if (column + blanks + LEAST_TEXT > s->width) { /* on the next line */
                fputc('\n', s->out);
                column = 0;
                blanks = indent + 2 * GAP;
            }
            column += fprintf(s->out, "%*s", blanks, "");
            cli_wrap_to(s->out, row[i].text, column, column, s->width);
            return;
        }
        if (row[i].text[0]) {
            fprintf(s->out, "%*s", blanks + (is_right ? spaces : 0), "");
            const char *code = s->in_colour ? codes[row[i].colour] : NULL;
            if (code) fprintf(s->out, "\033[%sm", code);
            fputs(row[i].text, s->out);
            if (code) fputs("\033[0m", s->out);
            column += blanks + widths[i];
            blanks = gap + (is_right ? 0 : spaces);
            column -= is_right ? 0 : spaces;
        } else {
            blanks += widths[i] + gap;
        }
    }
    fputc('\n', s->out);
}

int screen_add_table(screen *s, const screen_table *t, const char *align, int indent)
{
    if (s->format != SCREEN_TEXT) {
        screen_format_table(s, t, align);
        return 0;
    }
    int *widths = cli_calloc((size_t)t->columns + 1, sizeof *widths);
    for (int k = 0; k < t->cells; k++) {
        const int width = cli_columns(t->cell[k].text), i = k % t->columns;
        if (width > widths[i]) widths[i] = width;
    }
    int shown = 0, used = indent;
    for (; shown < t->columns; shown++) {
        const bool is_wrapped = screen_align_of(align, shown) == 'w';
        if (shown > 0 && !is_wrapped && used + widths[shown] > s->width) break;
        used += widths[shown] + (t->gap ? t->gap : GAP);
    }
    for (int k = 0; k < t->cells; k += t->columns)
        put_row(s, t, t->cell + k, widths, shown, align, indent);
    free(widths);
    return t->columns - shown;
}

/* ---- numbers ------------------------------------------------------------------------------- */

const char *screen_number(char text[SCREEN_NUMBER], double x, int digits)
{
    const double size = fabs(x);
    if (!isfinite(x)) {
        snprintf(text, SCREEN_NUMBER, isnan(x) ? "?" : x > 0.0 ? "inf" : "-inf");
    } else if (size >= pow(10.0, digits) && size < 1e6) {
        snprintf(text, SCREEN_NUMBER, "%.0f", x);
    } else if (size == 0.0 || (size >= 1e-3 && size < 1e6)) {
        snprintf(text, SCREEN_NUMBER, "%.*g", digits, x);
    } else {
        snprintf(text, SCREEN_NUMBER, "%.*e", digits - 1, x);
        char *e = strchr(text, 'e'), *from = e + 2, *to = e + (e[1] == '-' ? 2 : 1);
        while (*from == '0' && from[1]) from++;
        memmove(to, from, strlen(from) + 1);
    }
    return text;
}

const char *screen_count(char text[SCREEN_NUMBER], long long count)
{
    char digits[SCREEN_NUMBER];
    const int length = snprintf(digits, sizeof digits, "%lld", count);
    int n = 0;
    for (int i = 0; i < length && n < SCREEN_NUMBER - 2; i++) {
        text[n++] = digits[i];
        if (i < length - 1 && (length - 1 - i) % 3 == 0 && digits[i] != '-') text[n++] = ',';
    }
    text[n] = '\0';
    return text;
}

const char *screen_seconds(char text[SCREEN_NUMBER], double seconds)
{
    const bool is_long = seconds >= 120.0;
    screen_number(text, is_long ? seconds / 60.0 : seconds, 2);
    strcat(text, is_long ? " min" : " s");
    return text;
}

screen_colour screen_colour_of(double size)
{
    static const double small = 1e-9, medium = 1e-4;
    return size < small ? SCREEN_SMALL : size < medium ? SCREEN_MEDIUM : SCREEN_LARGE;
}
