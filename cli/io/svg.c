/* svg.c - figures of gnuplot for pages.
 *
 * gnuplot repeats the attributes of each group and of each text, and defines its marks in every
 * figure.  What is common moves to the group around all; groups without content, marks without use
 * and attributes that are the defaults of SVG go, which is half of a figure. */
#include "svg.h"

#include "file.h"
#include "file_output.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* What is black in a figure without background is light where the reader likes the dark. */
static const char style[] =
    "<style>@media (prefers-color-scheme: dark) {\n"
    "[stroke='black'], [stroke='rgb(  0,   0,   0)'] { stroke: #e4e4e4; }\n"
    "[fill='black'], [fill='rgb(  0,   0,   0)'] { fill: #e4e4e4; }\n"
    "[color='black'], [color='rgb(  0,   0,   0)'] { color: #e4e4e4; } }</style>\n";

#define GROUP "<g fill=\"none\" color=\"black\" stroke=\"currentColor\""
#define ENDS  " stroke-linecap=\"butt\" stroke-linejoin=\"miter\""

/* What gnuplot writes, and what replaces it; the first is the group around all. */
static const struct {
    const char *from, *to;
} shorter[] = {
    {"<g id=\"gnuplot_canvas\">", "<g id=\"gnuplot_canvas\" fill=\"none\" color=\"black\" "
                                  "stroke=\"currentColor\" font-family=\"sans-serif\">"},
    {GROUP " stroke-width=\"1.00\"" ENDS, "<g"},
    {GROUP, "<g"},
    {ENDS, ""},
    {" font-family=\"sans\"", ""},
    {" class=\"gridline\"", ""},
    {"  text-anchor", " text-anchor"},
    {"'  d='", "' d='"},
    {"  '/>", "'/>"},
};

static bool begins(const char *line, const char *text)
{
    return strncmp(line, text, strlen(text)) == 0;
}

/* Writes a line with the shorter texts and without blanks at its ends. */
static void write_line(FILE *out, const char *line)
{
    enum { COUNT = sizeof shorter / sizeof shorter[0] };
    size_t length = strcspn(line, "\n");
    while (length > 0 && (line[length - 1] == ' ' || line[length - 1] == '\t')) length--;
    for (size_t i = 0; i < length; i++) {
        size_t k = 0;
        while (k < COUNT && !begins(line + i, shorter[k].from)) k++;
        if (k == COUNT) {
            fputc(line[i], out);
        } else {
            fputs(shorter[k].to, out);
            i += strlen(shorter[k].from) - 1;
        }
    }
    fputc('\n', out);
}

static const char *next_line(const char *line)
{
    line += strcspn(line, "\n");
    return line + strspn(line, "\n\t ");
}

/* The line after the one that has a text. */
static const char *line_after(const char *line, const char *text)
{
    const char *found = strstr(line, text);
    return found ? next_line(found) : line;
}

static void write_tidy(FILE *out, const char *svg, const char *axes)
{
    const char *line = svg;
    while (*line) {
        const char *next = next_line(line);
        if (begins(line, "<title>Gnuplot")) {
            fputs(style, out);
            fprintf(out, "<metadata>%.*s</metadata>\n", (int)strcspn(axes, "\n"), axes);
            next = line_after(line, "</desc>");
        } else if (begins(line, "<defs>") && !strstr(line_after(line, "</defs>"), "<use ")) {
            next = line_after(line, "</defs>");
        } else if (begins(line, "<g ") && begins(next, "</g>")) {
            next = next_line(next);
        } else if (!begins(line, "<rect x=\"0\" y=\"0\"")) { /* a ground without colour */
            write_line(out, line);
        }
        line = next;
    }
}

int svg_tidy(const char *path, const char *axes)
{
    size_t length;
    char *svg = file_read(path, &length), *text;
    if (!svg) return CLI_IO;
    FILE *out = cli_memstream_open(&text, &length);
    write_tidy(out, svg, axes);
    cli_memstream_close(out);
    const int status = file_replace(path, text, length, 0);
    free(text);
    free(svg);
    return status;
}

void svg_write_url(FILE *out, const char *svg)
{
    bool in_tag = false;
    fputs("data:image/svg+xml,", out);
    for (; *svg; svg++) {
        if (*svg == '<' || *svg == '>') in_tag = *svg == '<';
        if (*svg == '\'' && in_tag)
            fputc('"', out); /* gnuplot has both quotes around attributes */
        else if (strchr("%#&'", *svg))
            fprintf(out, "%%%02X", (unsigned char)*svg);
        else
            fputc(*svg == '\n' ? ' ' : *svg, out);
    }
}
