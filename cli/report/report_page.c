/* report_page.c - the page of a report: HTML that needs no other file and no network,
 * light or dark as its reader prefers, on wide screens and on narrow ones.  It is complete without
 * the script at its end, which adds what can be pressed. */
#include "report_page.h"
#include "dalembert.h"

#include "io/file.h"
#include "io/file_output.h"
#include "io/text.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/screen.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- texts --------------------------------------------------------------------------------- */

void report_text(FILE *page, const char *text)
{
    for (; *text; text++) {
        const char *entity = *text == '&'   ? "&amp;"
                             : *text == '<' ? "&lt;"
                             : *text == '>' ? "&gt;"
                             : *text == '"' ? "&quot;"
                                            : NULL;
        const unsigned char byte = (unsigned char)*text; /* from 0x80 on, of a longer character */
        const bool is_control = byte < 0x80 && text_is_control(byte);
        if (entity)
            fputs(entity, page);
        else
            fputc(is_control && !strchr(TEXT_LINES, *text) ? ' ' : *text, page);
    }
}

void report_element(FILE *page, const char *element, const char *text)
{
    fprintf(page, "<%s>", element);
    report_text(page, text);
    fprintf(page, "</%.*s>", (int)strcspn(element, " "), element);
}

void report_row(FILE *page, const char *name)
{
    fputs("<tr>", page);
    report_element(page, "th scope=\"row\"", name);
}

void report_number(FILE *page, const char *format, double x)
{
    char text[64] = "–";
    if (!isnan(x)) snprintf(text, sizeof text, format, x);
    report_element(page, "td", text);
}

const char *report_colour(screen_colour colour)
{
    static const char *const classes[SCREEN_COLOURS] = {
        [SCREEN_PLAIN] = "",        [SCREEN_ROUNDING] = "kept", [SCREEN_SMALL] = "small",
        [SCREEN_MEDIUM] = "medium", [SCREEN_LARGE] = "large",   [SCREEN_FAINT] = "off"};
    return classes[colour];
}

static void write_attribute(FILE *page, const char *name, const char *text)
{
    fprintf(page, " %s=\"", name);
    report_text(page, text);
    fputc('"', page);
}

void report_trend(FILE *page, const char *size, const char *trend, double x, const char *note)
{
    char number[SCREEN_NUMBER] = "";
    const bool has_words = size[0] || trend[0] || note[0];
    const bool has_trend = trend[0] && strcmp(trend, "none") != 0 && strcmp(size, "exact") != 0;
    /* A size that is stated has the colour of the screen; grey is for what is not stated. */
    const screen_colour colour = strcmp(trend, "failed") == 0 || strcmp(trend, "aborted") == 0
                                     ? SCREEN_LARGE
                                 : !size[0] && !trend[0]       ? SCREEN_FAINT
                                 : strcmp(size, "larger") != 0 ? SCREEN_ROUNDING
                                                               : screen_colour_of(x);
    if (!isnan(x)) screen_number(number, x, 2);
    fprintf(page, "<td class=\"trend %s\"", report_colour(colour));
    write_attribute(page, "data-size", size);
    write_attribute(page, "data-trend", trend);
    write_attribute(page, "data-value", number);
    fputc('>', page);
    if (number[0]) report_element(page, "b", number);
    if (!number[0] && !has_words) fputs("–", page);
    if (has_words) fputs("<small>", page);
    report_text(page, size);
    if (has_trend) fputs(size[0] ? ", " : "", page);
    if (has_trend) report_text(page, trend);
    if (note[0]) fputs("<br>", page);
    report_text(page, note);
    fputs(has_words ? "</small></td>" : "</td>", page);
}

void report_file(report *r, const char *name, const char *summary)
{
    char *path = cli_join(r->directory, name), line[512];
    FILE *file = fopen(path, "r");
    if (!file && errno == ENOMEM) cli_out_of_memory();
    if (!file) {
        if (errno != ENOENT) r->read = cli_io("read", path);
        free(path);
        return;
    }
    fputs("<details><summary>", r->page);
    report_text(r->page, summary);
    fputs("</summary>\n<pre tabindex=\"0\">", r->page);
    while (fgets(line, sizeof line, file)) report_text(r->page, line);
    fputs("</pre></details>\n", r->page);
    if (ferror(file)) r->read = cli_io("read", path);
    fclose(file);
    free(path);
}

/* ---- figures ------------------------------------------------------------------------------- */

/* Three bytes are four letters (RFC 4648). */
static void write_base64(FILE *page, const char *bytes, size_t length)
{
    static const char letters[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < length; i += 3) {
        unsigned word = 0;
        for (size_t k = 0; k < 3; k++)
            word = word << 8 | (i + k < length ? (unsigned char)bytes[i + k] : 0u);
        for (size_t k = 0; k < 4; k++)
            fputc(i + k <= length ? letters[word >> (18 - 6 * k) & 63u] : '=', page);
    }
}

void report_put_levels(json_writer *data, const char *name, const uint16_t *level, int count)
{
    FILE *page = json_put_name(data, name);
    char *bytes = cli_malloc(2 * (size_t)count + 1);
    for (int i = 0; i < count; i++) {
        bytes[2 * i] = (char)(level[i] & 0xff);
        bytes[2 * i + 1] = (char)(level[i] >> 8);
    }
    fputc('"', page);
    write_base64(page, bytes, 2 * (size_t)count);
    fputc('"', page);
    free(bytes);
}

static const char no_charts[] =
    "<p>This page has tables and no charts: " CHART_LIBRARY ", which draws them, was not found. "
    "<code>docs/installation.md</code> says how to install it; <code>dalembert report DIR</code> "
    "makes the page again.</p>\n";

bool report_begin_figure(report *r, const char *title, const char *caption)
{
    const bool is_first = r->figures++ == 0;
    if (!r->charts.script) {
        fputs(is_first ? no_charts : "", r->page);
        return false;
    }
    if (is_first)
        fputs("<noscript>The charts need JavaScript; their data are beside this page, as "
              "gnuplot scripts.</noscript>\n",
              r->page);
    fputs("<figure><figcaption>", r->page);
    report_element(r->page, "strong", title);
    fputs(caption[0] ? " " : "", r->page);
    report_text(r->page, caption);
    fputs("</figcaption>", r->page);
    return true;
}

/* ---- the page ------------------------------------------------------------------------------ */

static int open_page(report *r)
{
    r->place = cli_join(r->directory, "report");
    int status = file_make_directory(r->place);
    if (status == CLI_DONE) status = chart_library_read(&r->charts);
    if (status != CLI_DONE) {
        chart_library_free(&r->charts);
        return status;
    }
    r->page_path = cli_join(r->place, "index.html");
    r->head = cli_memstream_open(&r->text[REPORT_HEAD], &r->length[REPORT_HEAD]);
    r->contents = cli_memstream_open(&r->text[REPORT_CONTENTS], &r->length[REPORT_CONTENTS]);
    r->page = cli_memstream_open(&r->text[REPORT_PAGE], &r->length[REPORT_PAGE]);
    fprintf(r->head,
            "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
            "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
            "<style>\n%s</style>\n",
            report_style);
    return CLI_DONE;
}

void report_title(report *r, const char *title)
{
    report_element(r->head, "title", title);
    report_element(r->page, "h1 id=\"top\"", title);
    fputc('\n', r->page);
}

static void add_contents(report *r, const char *id, const char *heading, const char *style)
{
    fprintf(r->contents, "<a href=\"#%s\"%s>", id, style);
    report_text(r->contents, heading);
    fputs("</a>\n", r->contents);
}

void report_heading(report *r, const char *id, const char *heading)
{
    add_contents(r, id, heading, "");
    fprintf(r->page, "<h2 id=\"%s\">", id);
    report_text(r->page, heading);
    fputs("</h2>\n", r->page);
}

void report_subheading(report *r, const char *id, const char *heading)
{
    add_contents(r, id, heading, " class=\"part\"");
}

static int close_page(report *r)
{
    const bool has_charts = r->figures > 0 && r->charts.script;
    if (!r->page) return CLI_DONE;
    fputs("<p class=\"faint\">Made by dalembert " DAL_VERSION ".", r->page);
    if (r->figures > 0)
        fputs(" Every figure is beside this page as the gnuplot script NAME.gp with its data; "
              "<code>dalembert report DIR --svg</code> or <code>--pdf</code> draws it for a paper.",
              r->page);
    if (r->figures > 0 && r->charts.script)
        fputs(" Charts by " CHART_LIBRARY ", whose licence is in the source of this page.",
              r->page);
    fputs("</p>\n", r->page);
    cli_memstream_close(r->head);
    cli_memstream_close(r->contents);
    cli_memstream_close(r->page);
    /* The contents are at the side of the page, or where it is narrow above it. */
    char *text;
    size_t length;
    FILE *page = cli_memstream_open(&text, &length);
    fputs(r->text[REPORT_HEAD], page);
    if (has_charts) fprintf(page, "<style>\n%s</style>\n", r->charts.style);
    fputs("</head><body>\n", page);
    if (r->length[REPORT_CONTENTS] > 0)
        fprintf(page,
                "<nav class=\"contents\" aria-label=\"Contents\" tabindex=\"0\">\n"
                "<a href=\"#top\">Top</a>\n%s</nav>\n",
                r->text[REPORT_CONTENTS]);
    fprintf(page, "<main>\n%s</main>\n", r->text[REPORT_PAGE]);
    if (has_charts)
        fprintf(page, "<script>\n/* " CHART_LIBRARY "\n\n%s*/\n%s</script>\n", r->charts.licence,
                r->charts.script);
    fprintf(page, "<script type=\"module\">\n%s</script>\n</body></html>\n", report_script);
    cli_memstream_close(page);
    const int status =
        r->read == CLI_DONE ? file_replace(r->page_path, text, length, FILE_UNSYNCED) : r->read;
    free(text);
    for (int i = 0; i < REPORT_TEXTS; i++) free(r->text[i]);
    chart_library_free(&r->charts);
    return status;
}

int report_make(report *r, int (*write)(report *r))
{
    int status = open_page(r);
    if (status == CLI_DONE) status = write(r);
    const int closed = close_page(r);
    cli_progress_end();
    return status == CLI_DONE ? closed : status;
}

int report_after(const char *directory, int status, int (*write)(report *r))
{
    report r = {.directory = directory};
    const int made = report_make(&r, write);
    free(r.place);
    free(r.page_path);
    return status == CLI_DONE ? made : status;
}
