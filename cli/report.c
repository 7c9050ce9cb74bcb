/* report.c - `dalembert report DIR`: a page with figures by gnuplot. */
#include "report.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static int holds(const char *directory, const char *name)
{
    struct stat status;
    char *path = cli_join(directory, name);
    int found = path && stat(path, &status) == 0;
    free(path);
    return found;
}

static int make_report(report *r)
{
    const char *place = r->directory;
    int study = holds(place, "cells.csv");
    if (!study && !holds(place, "trajectory.npy") && !holds(place, "rows.csv"))
        return cli_fail(CLI_USAGE,
                        "'%s' holds neither a study (cells.csv) nor a run (trajectory.npy)", place);
    int status = report_open(r);
    if (status == CLI_DONE) status = study ? report_study(r) : report_run(r);
    int closed = report_close(r);
    cli_progress_end();
    if (status == CLI_DONE) status = closed;
    if (status == CLI_DONE) printf("%s\n", r->page_path);
    free(r->place);
    free(r->page_path);
    return status == CLI_DONE ? cli_close(stdout, "standard output") : status;
}

#define OPTION_LIST(X) X(format, "svg|png", "what the figures are", "svg")

enum {
#define X(name, value, help, initial) OPTION_##name,
    OPTION_LIST(X)
#undef X
        OPTIONS
};

static const cli_option options[] = {
#define X(name, value, help, initial) {#name, value, help, initial},
    OPTION_LIST(X)
#undef X
};

static const char notes[] =
    "DIR is what 'dalembert study' or 'dalembert run --output DIR' made.  DIR/report/index.html "
    "is\n"
    "one page with everything in it; the figures, and the gnuplot scripts that draw them, stand\n"
    "beside it.  Without gnuplot the page has no figures.\n";

static int take(report *r, int option, const char *value)
{
    if (option == OPTION_format) {
        r->format = value;
        if (strcmp(value, "svg") == 0 || strcmp(value, "png") == 0) return CLI_DONE;
        return cli_fail(CLI_USAGE, "--format: '%s' is neither svg nor png", value);
    }
    if (r->directory) return cli_fail(CLI_USAGE, "more than one DIR: '%s'", value);
    r->directory = value;
    return CLI_DONE;
}

int command_report(int argc, char **argv)
{
    report r = {.format = "svg"};
    cli_args args = cli_begin(argc, argv, options, OPTIONS, notes);
    const char *value;
    for (int k; (k = cli_next(&args, &value)) != CLI_STOP;) {
        int status = take(&r, k, value);
        if (status != CLI_DONE) cli_stop(&args, status);
    }
    if (args.status != CLI_GO_ON) return args.status;
    return r.directory ? make_report(&r) : cli_fail(CLI_USAGE, "the DIR is missing");
}
