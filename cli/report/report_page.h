/* report_page.h - the page of a report.
 *
 *     DIR/report/index.html   the page, which needs no other file
 *     DIR/report/NAME.gp      a figure as a gnuplot script with its data
 *     DIR/report/NAME.svg     what it draws for a paper (or .pdf with .tex), where that is wanted
 *
 * Directories come from others: NAME is made of words of the program and of numbers, and no text of
 * a file becomes a part of HTML, JSON, a script or a file name as it is. */
#ifndef DAL_CLI_REPORT_PAGE_H
#define DAL_CLI_REPORT_PAGE_H

#include "io/chart_library.h"
#include "io/json.h"
#include "ui/screen_data.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

extern const char report_style[], report_script[]; /* *.css and *.js, embedded */

enum { REPORT_HEAD, REPORT_CONTENTS, REPORT_PAGE, REPORT_TEXTS };

typedef struct report report;
struct report {
    const char *directory; /* of the study or run */
    char *place;           /* DIR/report */
    const char *paper;     /* "svg" or "pdf": what gnuplot draws of each figure; or NULL */
    chart_library charts;
    FILE *page;               /* what is below the title, in memory until it is closed */
    FILE *head, *contents;    /* what is above it; the items of the contents */
    char *text[REPORT_TEXTS]; /* of those three when they are closed */
    size_t length[REPORT_TEXTS];
    char *page_path;
    int read;    /* the exit status of reading the files that are on the page */
    int figures; /* so far, on the page where there is the library of charts */
    /* What the page of a run says first, in place of sizes and trends, and its first figures, of
     * another command; or NULL. */
    void (*begin)(report *r);
    int (*draw)(report *r);
    void *user; /* for these two, or for what writes the page */
};

/* All that return an int return CLI_DONE, or print and return an exit status. */
/* Makes the page of r->directory, opened and closed; the caller frees r->place and r->page_path. */
int report_make(report *r, int (*write)(report *r));
/* The page of a directory after a command that wrote it and ended with this exit status.  Returns
 * that status, or the page's where the page failed. */
int report_after(const char *directory, int status, int (*write)(report *r));
/* Ends the head and begins the body with the title as its heading. */
void report_title(report *r, const char *title);
/* A section of the page under a heading, to which the contents lead by its id; the same for a
 * section of the last one, whose heading is the caller's. */
void report_heading(report *r, const char *id, const char *heading);
void report_subheading(report *r, const char *id, const char *heading);
/* A text with &, <, > and quotes escaped, and blanks for its control characters except tabs and
 * line ends; the same in an element. */
void report_text(FILE *page, const char *text);
void report_element(FILE *page, const char *element, const char *text);
/* Integers of 16 bits, little-endian, as a text of JSON in base64. */
void report_put_levels(json_writer *data, const char *name, const uint16_t *level, int count);
/* A table has its heads between REPORT_TABLE and REPORT_ROWS, then rows that begin with a name. */
#define REPORT_TABLE     "<div class=\"wide\" tabindex=\"0\"><table><thead><tr>"
#define REPORT_ROWS      "</tr></thead>\n<tbody>"
#define REPORT_TABLE_END "</tbody></table></div>\n"
void report_row(FILE *page, const char *name);
/* A cell of a table with a number; "–" for NaN. */
void report_number(FILE *page, const char *format, double x);
/* The class of an element that has a colour of the palette; "": none. */
const char *report_colour(screen_colour colour);
/* A cell of a table with a number x, and in words and colour the size and the trend that are stated
 * of it.  Without both it holds the number alone; without x (NaN) the words; note: beside them. */
void report_trend(FILE *page, const char *size, const char *trend, double x, const char *note);
/* A file of the directory, word for word, folded; nothing where there is none.  Without one that
 * cannot be read report_make fails. */
void report_file(report *r, const char *name, const char *summary);
/* Begins a figure, whose data the caller writes; false: the library of charts is not installed, and
 * the page says so once. */
bool report_begin_figure(report *r, const char *title, const char *caption);

#endif
