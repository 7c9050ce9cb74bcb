/* report_page.c - the page of a report: HTML that needs no other file, no network and no script,
 * light or dark as its reader likes, on wide screens and on narrow ones. */
#include "io/output.h"
#include "report.h"

#include "io/file.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- texts ---- */

void report_text(FILE *page, const char *text)
{
    for (; *text; text++) {
        if (*text == '&')
            fputs("&amp;", page);
        else if (*text == '<')
            fputs("&lt;", page);
        else if (*text == '>')
            fputs("&gt;", page);
        else if (*text == '"')
            fputs("&quot;", page);
        else
            fputc(*text, page);
    }
}

void report_element(FILE *page, const char *element, const char *text)
{
    fprintf(page, "<%s>", element);
    report_text(page, text);
    fprintf(page, "</%.*s>", (int)strcspn(element, " "), element);
}

void report_number(FILE *page, const char *format, double x)
{
    char text[64] = "–";
    if (!isnan(x)) snprintf(text, sizeof text, format, x);
    fprintf(page, "<td>%s</td>", text);
}

void report_paragraph(FILE *page, const char *text)
{
    report_element(page, "p", text);
    fputc('\n', page);
}

/* The colour of a cell: a trend that grows is never that of no trend, whatever its size. */
static const char *class_of(const char *size, const char *trend)
{
    static const char *const off[] = {"", "failed", "aborted", "undecided"};
    static const char *const stays[] = {"none", "settles"};
    for (size_t i = 0; i < sizeof off / sizeof off[0]; i++)
        if (strcmp(trend, off[i]) == 0) return "off";
    for (size_t i = 0; i < sizeof stays / sizeof stays[0]; i++)
        if (strcmp(trend, stays[i]) == 0) return strcmp(size, "larger") == 0 ? "bounded" : "kept";
    return strcmp(size, "larger") == 0 ? "drift" : "small";
}

void report_trend(FILE *page, const char *size, const char *trend, const char *number)
{
    const int is_exact = strcmp(size, "exact") == 0;
    fprintf(page, "<td class=\"trend %s\">", class_of(size, trend));
    if (size[0] && !is_exact) fprintf(page, "%s<br>", size);
    fputs(is_exact ? "exact" : trend, page);
    if (!trend[0] && !number[0]) fputs("–", page);
    if (number[0]) fprintf(page, "%s<small>%s</small>", trend[0] ? "<br>" : "", number);
    fputs("</td>", page);
}

void report_file(report *r, const char *name, const char *summary)
{
    char *path = cli_join(r->directory, name);
    FILE *file = fopen(path, "r");
    free(path);
    if (!file && errno == ENOMEM) cli_out_of_memory();
    if (!file) return;
    char line[512];
    fputs("<details><summary>", r->page);
    report_text(r->page, summary);
    fputs("</summary>\n<pre tabindex=\"0\">", r->page);
    while (fgets(line, sizeof line, file)) report_text(r->page, line);
    fputs("</pre></details>\n", r->page);
    fclose(file);
}

/* ---- figures ---- */

/* Three bytes are four letters (RFC 4648). */
static void put_base64(FILE *page, const unsigned char *bytes, size_t length)
{
    static const char letters[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < length; i += 3) {
        unsigned word = 0;
        for (size_t k = 0; k < 3; k++) word = word << 8 | (i + k < length ? bytes[i + k] : 0u);
        for (size_t k = 0; k < 4; k++)
            fputc(i + k <= length ? letters[word >> (18 - 6 * k) & 63u] : '=', page);
    }
}

int report_embed(report *r, const char *name, const char *alt, const char *caption)
{
    char file[PLOT_NAME + 8];
    size_t length = 0;
    snprintf(file, sizeof file, "%s.%s", name, r->format);
    char *path = cli_join(r->place, file);
    char *text = file_read(path, &length);
    int status = CLI_IO;
    if (text) {
        fprintf(r->page, "<figure><img alt=\"");
        report_text(r->page, alt);
        fprintf(r->page, "\" src=\"data:image/%s;base64,",
                strcmp(r->format, "svg") == 0 ? "svg+xml" : r->format);
        put_base64(r->page, (const unsigned char *)text, length);
        fputs("\">", r->page);
        if (caption[0]) fprintf(r->page, "<figcaption>%s</figcaption>", caption);
        fputs("</figure>\n", r->page);
        r->figures++;
        status = CLI_DONE;
    }
    free(text);
    free(path);
    return status;
}

/* ---- the page ---- */

static const char head[] =
    "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
    "<style>\n"
    ":root { color-scheme: light dark; --ink: #1d1d20; --paper: #ffffff; --faint: #5a5a63;\n"
    "  --line: #d4d4da; --kept: #d3eed9; --bounded: #faefc2; --drift: #f9d2c6; --off: #e3e3e8; }\n"
    "@media (prefers-color-scheme: dark) { :root { --ink: #e6e6e8; --paper: #161618;\n"
    "  --faint: #a9a9b2; --line: #3c3c42; --kept: #17452a; --bounded: #4a410e;\n"
    "  --drift: #5e2517; --off: #3a3a40; } }\n"
    "body { font: 16px/1.5 system-ui, sans-serif; max-width: 78rem; margin: 0 auto;\n"
    "  padding: 1rem; color: var(--ink); background: var(--paper); }\n"
    "h1, h2, h3 { line-height: 1.25; overflow-wrap: anywhere; } h2 { margin-top: 2.5rem; }\n"
    "p, figcaption { max-width: 48rem; } figcaption, .faint { color: var(--faint); }\n"
    "figcaption { font-size: 0.85rem; } small { font-size: 0.85em; }\n"
    ".figures { display: grid; gap: 1rem 1.5rem;\n"
    "  grid-template-columns: repeat(auto-fill, minmax(min(22rem, 100%), 1fr)); }\n"
    "figure { margin: 0; } img { width: 100%; height: auto; }\n"
    ".wide { overflow-x: auto; }\n"
    "table { border-collapse: collapse; font-size: 0.8rem; line-height: 1.25; }\n"
    "th, td { padding: 0.2rem 0.5rem; text-align: center; border: 1px solid var(--line); }\n"
    "td { white-space: nowrap; } thead th { vertical-align: bottom; min-width: 4.5rem; }\n"
    "th { font-weight: 600; overflow-wrap: anywhere; }\n"
    "tbody th { text-align: left; overflow-wrap: normal; position: sticky; left: 0;\n"
    "  background: var(--paper); }\n"
    ".kept, .small { background: var(--kept); } .small { font-weight: 600; }\n"
    ".bounded { background: var(--bounded); } .off { background: var(--off); }\n"
    ".drift { background: var(--drift); font-weight: 600; }\n"
    "ul.key { list-style: none; padding: 0; max-width: 48rem; }\n"
    ".key li { padding: 0.1rem 0.5rem; border: 1px solid var(--line); }\n"
    "a { color: inherit; }\n"
    "pre { font-size: 0.75rem; line-height: 1.35; overflow-x: auto; }\n"
    "details { margin: 1rem 0; } summary { cursor: pointer; }\n"
    "</style>\n";

int report_open(report *r)
{
    r->place = cli_join(r->directory, "report");
    int status = cli_directory(r->place);
    if (status != CLI_DONE) return status;
    r->page_path = cli_join(r->place, "index.html");
    r->page = fopen(r->page_path, "w");
    if (!r->page) return cli_io("write", r->page_path);
    fputs(head, r->page);
    return CLI_DONE;
}

void report_title(report *r, const char *title)
{
    report_element(r->page, "title", title);
    fputs("</head><body>\n", r->page);
    report_element(r->page, "h1", title);
    fputc('\n', r->page);
}

int report_close(report *r)
{
    if (!r->page) return CLI_DONE;
    fputs("<p class=\"faint\">Made by dalembert " DAL_VERSION ".", r->page);
    if (r->figures > 0)
        fprintf(r->page,
                " Every figure stands beside this page, as NAME.%s and as the gnuplot script "
                "NAME.gp with its data.",
                r->format);
    fputs("</p>\n</body></html>\n", r->page);
    return cli_close(r->page, r->page_path);
}
