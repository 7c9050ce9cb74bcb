/* report.c - `dalembert report DIR`: a page with charts, and its figures for papers. */
#include "io/file.h"
#include "report/report_ensemble.h"
#include "report/report_order.h"
#include "report/report_run.h"
#include "report/report_section.h"
#include "report/report_study.h"
#include "steer/steer_page.h"
#include "ui/arguments.h"
#include "ui/commands.h"
#include "ui/message.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The file by which a directory is recognised, and what writes its page. */
static const struct {
    const char *file;
    int (*write)(report *r);
} kinds[] = {{"cells.csv", report_study},       {"steer.json", steer_write_page},
             {"trajectory.npy", report_run},    {"statistics.csv", report_ensemble},
             {"order.csv", report_order},       {"section.csv", report_section},
             {"lyapunov.csv", report_lyapunov}, {"volume.csv", report_volume}};

enum { KINDS = sizeof kinds / sizeof kinds[0] };

typedef struct report_settings {
    const char *directory;
    bool svg, pdf;
} report_settings;

static const cli_option options[] = {
    {"svg", NULL, NULL, "draws each figure by gnuplot, 3.4 inches wide, beside the page",
     CLI_FLAG(report_settings, svg)},
    {"pdf", NULL, NULL, "the same as PDF, with labels in a file NAME.tex for TeX",
     CLI_FLAG(report_settings, pdf)},
    {NULL, "DIR", CLI_REQUIRED,
     "what 'run', 'study', 'ensemble', 'order', 'section', 'lyapunov', 'volume' or 'steer' wrote "
     "with "
     "--output DIR",
     CLI_TEXT(report_settings, directory)},
};

static int write_report(report *r)
{
    int kind = 0;
    while (kind < KINDS && !file_is_in(r->directory, kinds[kind].file)) kind++;
    if (kind == KINDS && file_is_in(r->directory, "study.yaml"))
        return cli_fail(CLI_USAGE,
                        "'%s' holds a study that is not finished: 'dalembert resume' continues it, "
                        "'dalembert merge' merges shards",
                        r->directory);
    if (kind == KINDS && file_find_directory(r->directory) != CLI_DONE) return CLI_USAGE;
    if (kind == KINDS)
        return cli_fail(
            CLI_USAGE,
            "'%s' holds neither a study (cells.csv) nor a run (trajectory.npy) nor "
            "an ensemble (statistics.csv) nor orders (order.csv) nor a section (section.csv) nor "
            "exponents (lyapunov.csv) nor a volume (volume.csv)",
            r->directory);
    const int status = report_make(r, kinds[kind].write);
    if (status == CLI_DONE) printf("%s\n", r->page_path);
    free(r->place);
    free(r->page_path);
    return status == CLI_DONE ? cli_close(stdout, "standard output") : status;
}

static int run_report(int argc, char **argv)
{
    report_settings s = {0};
    const cli_option_set set = CLI_OPTION_SET(options, &s);
    const int status = cli_read_arguments(&command_report, argc, argv, &set, 1);
    if (status != CLI_GO_ON) return status;
    if (s.svg && s.pdf)
        return cli_fail(CLI_USAGE, "--svg and --pdf exclude each other: a figure has one script");
    report r = {.directory = s.directory, .paper = s.svg ? "svg" : s.pdf ? "pdf" : NULL};
    return write_report(&r);
}

const cli_command command_report = {
    .name = "report",
    .synopsis = "dalembert report DIR [OPTION]...",
    .about = "makes a page with charts of what another command wrote",
    .notes =
        "The command writes DIR/report/index.html, one page with everything in it.  Its charts are "
        "drawn by " CHART_LIBRARY ", which is put into the page where it is installed; otherwise "
        "the page has tables alone.  Each figure is beside the page as a gnuplot script with its "
        "data, NAME.gp.  A paper takes NAME.svg, or NAME.tex with NAME.pdf.\n",
    .run = run_report,
};
