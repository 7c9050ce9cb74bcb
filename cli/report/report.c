/* report.c - `dalembert report DIR`: a page with figures by gnuplot. */
#include "report.h"
#include "io/output.h"

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

/* What a directory is told by, and what makes its page. */
static const struct {
    const char *file;
    int (*write)(report *r);
} kinds[] = {
    {"cells.csv", report_study}, {"trajectory.npy", report_run}, {"order.csv", report_order}};

enum { KINDS = sizeof kinds / sizeof kinds[0] };

static int make_report(report *r)
{
    int kind = 0;
    while (kind < KINDS && !holds(r->directory, kinds[kind].file)) kind++;
    if (kind == KINDS && holds(r->directory, "study.yaml"))
        return cli_fail(CLI_USAGE,
                        "'%s' holds a study that is not finished: 'dalembert resume' goes on with "
                        "it, 'dalembert merge' joins shards",
                        r->directory);
    if (kind == KINDS)
        return cli_fail(CLI_USAGE,
                        "'%s' holds neither a study (cells.csv) nor a run (trajectory.npy) nor "
                        "orders (order.csv)",
                        r->directory);
    int status = report_open(r);
    if (status == CLI_DONE) status = kinds[kind].write(r);
    int closed = report_close(r);
    cli_progress_end();
    if (status == CLI_DONE) status = closed;
    if (status == CLI_DONE) printf("%s\n", r->page_path);
    free(r->place);
    free(r->page_path);
    return status == CLI_DONE ? cli_close(stdout, "standard output") : status;
}

/* name, value, default, help */
#define OWN_LIST(X) X(format, "svg|png", "svg", "what the figures are")

enum { OWN_LIST(CLI_OWN) OWN_OPTIONS };

static const cli_option options[] = {OWN_LIST(CLI_OPTION)};

static const char notes[] =
    "DIR is what 'dalembert study', 'dalembert run --output DIR' or 'dalembert order --output "
    "DIR'\n"
    "made.  DIR/report/index.html is one page with everything in it; the figures, and the gnuplot\n"
    "scripts that draw them, stand beside it.  Without gnuplot the page has no figures.\n";

static int take(report *r, int option, const char *value)
{
    if (option == OWN_format) {
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
    cli_args args = cli_begin(argc, argv, options, OWN_OPTIONS, notes);
    const char *value;
    for (int k; (k = cli_next(&args, &value)) != CLI_STOP;) {
        int status = take(&r, k, value);
        if (status != CLI_DONE) cli_stop(&args, status);
    }
    if (args.status != CLI_GO_ON) return args.status;
    return r.directory ? make_report(&r) : cli_fail(CLI_USAGE, "the DIR is missing");
}
