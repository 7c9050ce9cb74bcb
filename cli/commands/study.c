/* study.c - `dalembert study`: systems x integrators x steps x starts, in tables and files. */
#include "io/file.h"
#include "report/report_study.h"
#include "run/pool.h"
#include "run/run.h"
#include "study/study_directory.h"
#include "study/study_methods.h"
#include "study/study_plan.h"
#include "ui/arguments.h"
#include "ui/commands.h"
#include "ui/message.h"

#include <stdlib.h>
#include <string.h>

/* The study that is embedded in the program: bench/studies/canonical-drift.yaml. */
extern const char study_builtin_text[];

static const char builtin_name[] = "canonical-drift";
static const char default_directory[] = "dalembert-study";

typedef struct settings {
    const char *study, *output;
    long long threads;
    store_shard shard;
    bool show, tables, details, no_page;
    screen_format format;
    run_settings run;
} settings;

static const cli_option options[] = {
    {"output", "DIR", NULL, "writes the files there (dalembert-study)", CLI_TEXT(settings, output)},
    POOL_THREADS_OPTION(settings, "cells at a time; results do not depend on it"),
    STORE_SHARD_OPTION(settings,
                       "runs every N-th cell, from the K-th on; 'dalembert merge' joins shards"),
    {"details", NULL, NULL, "prints the matrices that a pipe gets on a terminal, too",
     CLI_FLAG(settings, details)},
    {"tables", NULL, NULL, "prints the tables, not a screenful", CLI_FLAG(settings, tables)},
    SCREEN_FORMAT_OPTION(settings),
    REPORT_NO_PAGE_OPTION(settings),
    {"show", NULL, NULL, "prints the study file itself and runs nothing", CLI_FLAG(settings, show)},
    {NULL, "STUDY.yaml", NULL, "a study file; by default the built-in study",
     CLI_TEXT(settings, study)},
};

static const char notes[] =
    "A study file is YAML.  Its keys belong to the study, to a system of it, or to both:\n"
#define KEY_HELP(name, scope, read, member, help) "  " #name " (" scope "): " help "\n"
    STUDY_KEY_LIST(KEY_HELP)
#undef KEY_HELP
        "\n"
        "Values are one number, a list, {from: 0, to: 1, count: 11} or {from: 0, to: 1, by: 0.1}.  "
        "For parameters and starts they may be {between: [0, 1]}: one random value for each of "
        "the seeds, a function of seed and name alone.  Velocities of a random start are projected "
        "to D = 0.  Every combination of values is a system of the study, called "
        "LABEL_name=value.\n"
        "\n"
        "expect: label, system or all; then integrator, all, or all+project; then quantity: a "
        "size or a trend, a list of them, bounds of its deviation {at most: 1e-9, at least: 0}, "
        "or a mapping of size:, trend:, max:, deviation:, final:, amplitude:, rate:, rate_low:, "
        "rate_high:, exponent:, confidence: with such bounds, and step:, tolerance: or start: for "
        "these alone; or a list of mappings.  D is the constraint with the largest max |D|; "
        "state is done, failed or refused.  The exit status is 1 when a result is not as "
        "expected.\n"
        "\n"
        "A terminal gets 24 lines: D and E of representative integrators for the first start and "
        "step of each system, with a mark of their growth; a pipe, or --details, 40.  DIR gets\n"
        "  study.yaml        the study itself; systems/ copies of system files\n"
        "  runs/NAME/        a directory per cell (system, integrator, start, step), as 'run' "
        "makes it,\n"
        "                    with rows after whole numbers of steps\n"
        "  manifest.json     machine and progress; of shards shard-K-of-N.json\n"
        "  tables.txt        a table per system, step and start\n"
        "  report/           the page, as 'dalembert report' makes it\n"
        "  cells.csv         a row per cell\n"
        "  quantities.csv    a row per cell and quantity: first, last, max |x|, max |x - first|, "
        "and\n"
        "                    the columns of summary.csv, of every step\n"
        "  expectations.csv  what was expected and what was found\n"
        "  series/LABEL.csv  maxima of the rows within each hundredth of the time\n"
        "\n"
        "All files except times, manifests and checkpoints have the same bytes in every run, "
        "resumed, or merged.\n"
        "\n"
        "'dalembert resume DIR' continues a study after an interruption; it does "
        "not repeat finished runs.  Shards may share one DIR; they print what their own cells show "
        "and "
        "write no tables: 'dalembert merge' makes them.  'mpirun dalembert-mpi "
        "STUDY.yaml --output DIR' runs a study on the processes of a cluster.\n"
        "\n"
        "A cell that fails has the message in its row and the study continues; the exit status is "
        "then 3, unless the study expects the failure.  A cell is refused, which is no failure, "
        "where the integrator needs what the system lacks.\n";

/* Whether a text has a key at the beginning of a line. */
static bool has_key(const char *text, const char *key)
{
    const size_t length = strlen(key);
    for (; text; text = strchr(text, '\n')) {
        text += *text == '\n';
        if (strncmp(text, key, length) == 0) return true;
    }
    return false;
}

/* A finished study is written over where nobody named the directory: each is there by default. */
static int run_study(const settings *s, const char *text, size_t length)
{
    study_plan plan;
    study_directory dir;
    const study_run_options how = {.threads = (int)s->threads,
                                   .interval = s->run.interval,
                                   .native = s->run.native,
                                   .shows_tables = s->tables,
                                   .shows_matrices = s->details,
                                   .format = s->format};
    study_directory_open(&dir, s->output ? s->output : default_directory);
    int status = study_plan_read(&plan, s->study ? s->study : builtin_name, text, length, NULL);
    bool has_ended = false;
    if (status == CLI_DONE && !s->output) status = study_directory_read_end(&dir, &has_ended);
    const bool force = s->run.force || has_ended;
    if (status == CLI_DONE)
        status = study_directory_begin(&dir, &plan, text, length, s->shard, force);
    if (status == CLI_DONE) study_say_projected(&plan);
    if (status == CLI_DONE) status = study_directory_run(&dir, &plan, &how);
    study_plan_free(&plan);
    if (!s->no_page)
        status = report_after_study(dir.path, status, s->tables ? REPORT_UNNAMED : REPORT_NAMED);
    study_directory_close(&dir);
    return status;
}

static int study(int argc, char **argv)
{
    settings s = {.threads = pool_threads()};
    const cli_option_set sets[] = {
        CLI_OPTION_SET(options, &s),
        run_option_set(&s.run, RUN_OPTION(output) | RUN_OPTION(events) | RUN_OPTION(summary) |
                                   RUN_OPTION(details) | RUN_OPTION(format) | RUN_OPTION(progress)),
    };
    int status = cli_read_arguments(&command_study, argc, argv, sets, 2);
    if (status != CLI_GO_ON) return status;
    size_t length = strlen(study_builtin_text);
    char *own = s.study ? file_read(s.study, &length) : NULL;
    if (s.study && !own) return CLI_USAGE;
    const char *text = own ? own : study_builtin_text;
    if (own && has_key(text, "coordinates:") && !has_key(text, "systems:")) {
        free(own);
        return cli_fail(CLI_USAGE, "'%s' is a system, not a study: 'dalembert run %s' runs it",
                        s.study, s.study);
    }
    if (s.show) {
        fwrite(text, 1, length, stdout);
        status = cli_close(stdout, "standard output");
    } else {
        status = run_study(&s, text, length);
    }
    free(own);
    return status;
}

const cli_command command_study = {
    .name = "study",
    .synopsis = "dalembert study [STUDY.yaml] [OPTION]...",
    .about = "runs systems x integrators x steps and tabulates their drifts",
    .notes = notes,
    .run = study,
};
