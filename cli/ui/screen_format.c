/* screen_format.c - the tables of a screen as LaTeX, Markdown and CSV. */
#include "screen_format.h"

#include <stdlib.h>
#include <string.h>

/* ---- LaTeX --------------------------------------------------------------------------------- */

/* A text that LaTeX shows as it is. */
static void put_latex(FILE *out, const char *text)
{
    static const struct {
        char character;
        const char *latex;
    } special[] = {{'\\', "\\textbackslash{}"},
                   {'~', "\\textasciitilde{}"},
                   {'<', "$<$"},
                   {'^', "\\textasciicircum{}"},
                   {'|', "$|$"},
                   {'>', "$>$"}};
    for (; *text; text++) {
        const char *latex = NULL;
        for (size_t i = 0; i < sizeof special / sizeof *special; i++)
            if (special[i].character == *text) latex = special[i].latex;
        if (latex)
            fputs(latex, out);
        else
            fprintf(out, "%s%c", strchr("&%$#_{}", *text) ? "\\" : "", *text);
    }
}

static bool is_digit(char c) { return c >= '0' && c <= '9'; }

/* The length of a number at the beginning of a text, up to its exponent; 0: there is none. */
static size_t number_length(const char *text, size_t *mantissa)
{
    size_t n = *text == '-' || *text == '+';
    const size_t first = n;
    while (is_digit(text[n]) || text[n] == '.') n++;
    *mantissa = n;
    if (n == first || text[first] == '.') return 0;
    if (text[n] == 'e') {
        size_t k = n + 1 + (text[n + 1] == '-' || text[n + 1] == '+');
        if (!is_digit(text[k])) return 0;
        while (is_digit(text[k])) k++;
        n = k;
    }
    return text[n] && !strchr(" )/^~?", text[n]) ? 0 : n; /* the marks of a study */
}

/* A cell; a number in it has its exponent as a power of 10. */
static void put_latex_cell(FILE *out, const char *text)
{
    size_t mantissa;
    if (*text == '(') { /* (1e-8): not stated */
        fputc('(', out);
        text++;
    }
    const size_t length = number_length(text, &mantissa);
    if (length > 0) {
        const bool is_one = mantissa == 1 && *text == '1' && mantissa < length;
        fprintf(out, "$%.*s", is_one ? 0 : (int)mantissa, text);
        if (mantissa < length)
            fprintf(out, "%s10^{%d}", is_one ? "" : " \\cdot ", atoi(text + mantissa + 1));
        fputc('$', out);
    }
    put_latex(out, text + length);
}

static void write_latex(screen *s, const screen_table *t, const char *align)
{
    fputs("\\begin{tabular}{", s->out);
    for (int i = 0; i < t->columns; i++)
        fputc(screen_align_of(align, i) == 'r' ? 'r' : 'l', s->out);
    fputs("}\n  \\hline\n", s->out);
    for (int k = 0; k < t->cells; k++) {
        const int i = k % t->columns;
        if (i == 0 && t->heads > 0 && k == t->heads * t->columns) fputs("  \\hline\n", s->out);
        fputs(i == 0 ? "  " : " & ", s->out);
        put_latex_cell(s->out, t->cell[k].text);
        if (i == t->columns - 1) fputs(" \\\\\n", s->out);
    }
    fputs("  \\hline\n\\end{tabular}\n", s->out);
}

/* ---- Markdown ------------------------------------------------------------------------------ */

static void put_markdown(FILE *out, const char *text)
{
    for (; *text; text++) fprintf(out, "%s%c", strchr("|\\`*_<", *text) ? "\\" : "", *text);
}

/* Markdown and CSV have one row of headings: the headings of a column in one cell. */
static void put_heads(screen *s, const screen_table *t, int column,
                      void (*put)(FILE *out, const char *text))
{
    bool has_text = false;
    for (int row = 0; row < t->heads; row++) {
        const char *text = t->cell[row * t->columns + column].text;
        if (!*text) continue;
        if (has_text) fputc(' ', s->out);
        put(s->out, text);
        has_text = true;
    }
}

static void write_markdown(screen *s, const screen_table *t, const char *align)
{
    for (int i = 0; i < t->columns; i++) {
        fputs("| ", s->out);
        put_heads(s, t, i, put_markdown);
        fputs(i == t->columns - 1 ? " |\n" : " ", s->out);
    }
    for (int i = 0; i < t->columns; i++)
        fprintf(s->out, "|%s%s", screen_align_of(align, i) == 'r' ? "---:" : "---",
                i == t->columns - 1 ? "|\n" : "");
    for (int k = t->heads * t->columns; k < t->cells; k++) {
        fputs("| ", s->out);
        put_markdown(s->out, t->cell[k].text);
        fputs(k % t->columns == t->columns - 1 ? " |\n" : " ", s->out);
    }
    fputc('\n', s->out);
}

/* ---- CSV ----------------------------------------------------------------------------------- */

static void put_quoted(FILE *out, const char *text)
{
    for (; *text; text++) fprintf(out, *text == '"' ? "\"\"" : "%c", *text);
}

static void write_csv(screen *s, const screen_table *t)
{
    for (int i = 0; t->heads > 0 && i < t->columns; i++) {
        fputc('"', s->out);
        put_heads(s, t, i, put_quoted);
        fputs(i == t->columns - 1 ? "\"\n" : "\",", s->out);
    }
    for (int k = t->heads * t->columns; k < t->cells; k++) {
        const char *text = t->cell[k].text;
        size_t mantissa;
        const bool is_number = *text && number_length(text, &mantissa) == strlen(text);
        if (!is_number) fputc('"', s->out);
        put_quoted(s->out, text);
        if (!is_number) fputc('"', s->out);
        fputc(k % t->columns == t->columns - 1 ? '\n' : ',', s->out);
    }
}

/* ---- all ----------------------------------------------------------------------------------- */

void screen_format_sentence(screen *s, const char *text)
{
    if (s->format == SCREEN_LATEX) {
        fprintf(s->out, "%% %s\n", text);
    } else if (s->format == SCREEN_MARKDOWN) {
        put_markdown(s->out, text);
        fputs("\n\n", s->out);
    }
}

void screen_format_table(screen *s, const screen_table *t, const char *align)
{
    if (s->format == SCREEN_LATEX)
        write_latex(s, t, align);
    else if (s->format == SCREEN_MARKDOWN)
        write_markdown(s, t, align);
    else
        write_csv(s, t);
}
