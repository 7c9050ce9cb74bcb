/* report.c - `dalembert report DIR`: a page with figures by gnuplot. */
#include "io/file.h"
#include "report/report_ensemble.h"
#include "report/report_order.h"
#include "report/report_run.h"
#include "report/report_section.h"
#include "report/report_study.h"
#include "ui/arguments.h"
#include "ui/commands.h"
#include "ui/message.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The file by which a directory is recognised, and what writes its page. */
static const struct {
    const char *file;
    int (*write)(report *r);
} kinds[] = {{"cells.csv", report_study},
             {"trajectory.npy", report_run},
             {"statistics.csv", report_ensemble},
             {"order.csv", report_order},
             {"section.csv", report_section}};

enum { KINDS = sizeof kinds / sizeof kinds[0] };

static bool has_file(const char *directory, const char *name)
{
    char *path = cli_join(directory, name);
    const bool found = access(path, F_OK) == 0;
    free(path);
    return found;
}

static int parse_format(void *user, const cli_option *option, const char *text)
{
    if (strcmp(text, "svg") != 0 && strcmp(text, "png") != 0)
        return cli_fail(CLI_USAGE, "--format: '%s' is not svg or png", text);
    return cli_parse_text(user, option, text);
}

static const cli_option options[] = {
    {"format", "svg|png", "svg", "format of the figures", .parse = parse_format,
     .offset = offsetof(report, format)},
    {NULL, "DIR", CLI_REQUIRED,
     "what 'study', 'run', 'ensemble', 'order' or 'section' wrote with --output DIR",
     CLI_TEXT(report, directory)},
};

static int write_report(report *r)
{
    int kind = 0;
    while (kind < KINDS && !has_file(r->directory, kinds[kind].file)) kind++;
    if (kind == KINDS && has_file(r->directory, "study.yaml"))
        return cli_fail(CLI_USAGE,
                        "'%s' holds a study that is not finished: 'dalembert resume' continues it, "
                        "'dalembert merge' merges shards",
                        r->directory);
    if (kind == KINDS && file_find_directory(r->directory) != CLI_DONE) return CLI_USAGE;
    if (kind == KINDS)
        return cli_fail(
            CLI_USAGE,
            "'%s' holds neither a study (cells.csv) nor a run (trajectory.npy) nor "
            "an ensemble (statistics.csv) nor orders (order.csv) nor a section (section.csv)",
            r->directory);
    const int status = report_make(r, kinds[kind].write);
    if (status == CLI_DONE) printf("%s\n", r->page_path);
    free(r->place);
    free(r->page_path);
    return status == CLI_DONE ? cli_close(stdout, "standard output") : status;
}

static int run_report(int argc, char **argv)
{
    report r = {0};
    const cli_group group = CLI_GROUP(options, &r);
    const int status = cli_read_arguments(&command_report, argc, argv, &group, 1);
    return status == CLI_GO_ON ? write_report(&r) : status;
}

const cli_command command_report = {
    .name = "report",
    .synopsis = "dalembert report DIR [OPTION]...",
    .about = "makes a page with figures of a run, a study, an ensemble, orders or a section",
    .notes = "The command writes DIR/report/index.html, one page with everything in it; the "
             "figures, and the gnuplot scripts that draw them, are beside it.  Without gnuplot "
             "the page "
             "has no figures.\n",
    .run = run_report,
};
