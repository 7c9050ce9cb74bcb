/* chart_library.h - the library that draws the charts of pages, uPlot, which is no part of the
 * program.
 *
 * It is three files of its package, in the first of these directories that has them:
 *
 *     $DALEMBERT_UPLOT                    alone, where it is set
 *     $XDG_DATA_HOME/dalembert/uplot      or ~/.local/share/dalembert/uplot
 *     /usr/local/share/dalembert/uplot
 *     /usr/share/dalembert/uplot */
#ifndef DAL_CLI_CHART_LIBRARY_H
#define DAL_CLI_CHART_LIBRARY_H

#define CHART_LIBRARY "uPlot 1.6.32"

typedef struct chart_library {
    char *script, *style, *licence; /* NULL: it is not installed */
} chart_library;

/* Reads it.  Returns CLI_DONE, also where there is none, or prints and returns an exit status; free
 * it in any case. */
int chart_library_read(chart_library *library);
void chart_library_free(chart_library *library);

#endif
