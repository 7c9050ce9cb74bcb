/* study.c - `dalembert study`: systems x integrators x steps x starts, in tables and files. */
#include "study.h"
#include "io/file.h"
#include "run/pool.h"
#include "run/run.h"
#include "study_directory.h"

#include <stdlib.h>
#include <string.h>

/* The study that travels inside the program: bench/studies/canonical-drift.yaml. */
extern const char study_builtin_text[];

static const char builtin_name[] = "canonical-drift";
static const char default_directory[] = "dalembert-study";

/* ---- options ---- */

typedef struct settings {
    const char *study, *output;
    long long threads;
    double interval;
    study_shard shard;
    int show, force;
    native_mode native;
} settings;

/* name, value, default, help */
#define OWN_LIST(X)                                                                                \
    X(output, "DIR", default_directory, "the files go there")                                      \
    X(threads, "N", "OMP_NUM_THREADS or one per processor",                                        \
      "cells at a time; the results do not depend on it")                                          \
    X(checkpoint, "SECONDS", "5", "a run can be resumed from at most so long ago")                 \
    X(shard, "K/N", NULL, "every N-th cell from the K-th on; 'dalembert merge' joins the shards")  \
    X(native, "auto|on|off", "auto", "compile the steps, which changes no bit: when it pays")      \
    X(force, NULL, NULL, "write over what the directory holds")                                    \
    X(show, NULL, NULL, "print the study file itself and do nothing")

enum { OWN_LIST(CLI_OWN) OWN_OPTIONS };

static const cli_option options[] = {OWN_LIST(CLI_OPTION)};

static const char notes[] =
    "Without a file the built-in study is run.  A study file is YAML; its keys:\n"
#define X(name, scope, help) "  " #name " (" scope "): " help "\n"
    STUDY_KEY_LIST(X)
#undef X
        "\n"
        "Values are one number, a list, {from: 0, to: 1, count: 11}, {from: 0, to: 1, by: 0.1},\n"
        "or, for parameters and starts, {between: [0, 1]}: drawn, once for each of the seeds,\n"
        "as a function of seed and name alone; where something of the start is drawn, its\n"
        "velocities are then brought onto D = 0.  Every combination of values is a system of\n"
        "the study, called LABEL_name=value.\n"
        "\n"
        "expect: label, system or all; then integrator, all, or all+project; then quantity: a\n"
        "size or a trend, a list of them, bounds of its deviation {at most: 1e-9, at least: 0}, "
        "or\n"
        "a mapping of size:, trend:, max:, deviation:, final:, amplitude:, rate:, rate_low:,\n"
        "rate_high:, exponent:, confidence: with such bounds, and step: or start: for those\n"
        "cells alone; or a list of mappings.  D is the worst of the constraints; state is done,\n"
        "failed or refused.  Exit status 1 when something is not as expected.\n"
        "\n"
        "stdout gets a table per system, step and start; DIR gets\n"
        "  study.yaml        the study itself; systems/ copies of system files\n"
        "  runs/NAME/        a directory per cell (system, integrator, start, step), as 'run' "
        "makes it,\n"
        "                    with rows after whole numbers of steps\n"
        "  manifest.json     what ran the study, and how far it came; of shards shard-K-of-N.json\n"
        "  tables.txt        the tables\n"
        "  cells.csv         a row per cell\n"
        "  quantities.csv    a row per cell and quantity: first, last, max |x|, max |x - first|, "
        "and\n"
        "                    the columns of summary.csv, from a look at every step\n"
        "  expectations.csv  what was expected and what was found, where something was\n"
        "  series/LABEL.csv  for figures: maxima of the rows within each hundredth of the time\n"
        "\n"
        "All but times, manifests and checkpoints are the same bytes in every run, whatever the\n"
        "number of threads, interrupted and resumed, in shards and merged.\n"
        "\n"
        "'dalembert resume DIR' goes on with a study that was interrupted, kill -9 included;\n"
        "what is finished is not run again.  Shards may share one DIR; they print tables of\n"
        "their own cells and leave none behind: 'dalembert merge' makes these.\n"
        "\n"
        "A cell that fails is told in its row and the study goes on; the exit status is then 3,\n"
        "unless the study expects it.  A cell is refused, which is no failure, where the\n"
        "integrator needs what the system lacks.\n";

static int take_shard(settings *w, const char *text)
{
    const char *slash = strchr(text, '/');
    char number[32];
    if (!slash || (size_t)(slash - text) >= sizeof number)
        return cli_fail(CLI_USAGE, "--shard: '%s' is not K/N", text);
    snprintf(number, sizeof number, "%.*s", (int)(slash - text), text);
    int status = cli_integer("--shard", slash + 1, 1, 1000000, &w->shard.count);
    if (status != CLI_DONE) return status;
    return cli_integer("--shard", number, 1, w->shard.count, &w->shard.number);
}

static int take(settings *w, int option, const char *value)
{
    switch (option) {
    case OWN_output:
        w->output = value;
        return CLI_DONE;
    case OWN_threads:
        return cli_integer("--threads", value, 1, POOL_MAX_THREADS, &w->threads);
    case OWN_checkpoint:
        return run_parse_interval(value, &w->interval);
    case OWN_shard:
        return take_shard(w, value);
    case OWN_native:
        return native_parse(value, &w->native);
    case OWN_force:
        w->force = 1;
        return CLI_DONE;
    case OWN_show:
        w->show = 1;
        return CLI_DONE;
    default:
        if (w->study) return cli_fail(CLI_USAGE, "more than one study: '%s'", value);
        w->study = value;
        return CLI_DONE;
    }
}

/* ---- running ---- */

static int run_cells(study_plan *plan, const study_directory *dir, const study_run_options *how)
{
    cli_catch_signals();
    plan->interval = how->interval;
    for (int i = 0; i < plan->case_count; i++) plan->cases[i].native = how->native;
    return study_directory_finish(dir, plan, study_pool_run(plan, how->threads));
}

/* A study that is over is written over where nobody named the directory: each is so by default. */
static int begin(const settings *w, study_directory *dir, study_plan *plan, const char *text,
                 size_t length)
{
    study_directory_open(dir, w->output ? w->output : default_directory);
    const int force = w->force || (!w->output && study_directory_is_finished(dir));
    return study_directory_begin(dir, plan, text, length, w->shard, force);
}

static int run_text(const settings *w, const char *text, size_t length)
{
    study_plan plan = {0};
    study_directory dir = {0};
    const study_run_options how = {(int)w->threads, w->interval, w->native};
    const char *name = w->study ? w->study : builtin_name;
    int status = study_plan_read(&plan, name, text, length, NULL);
    if (status == CLI_DONE) status = begin(w, &dir, &plan, text, length);
    if (status == CLI_DONE) status = run_cells(&plan, &dir, &how);
    study_plan_free(&plan);
    study_directory_close(&dir);
    return status;
}

static int run_study(const settings *w)
{
    size_t length = strlen(study_builtin_text);
    char *own = w->study ? file_read(w->study, &length) : NULL;
    if (w->study && !own) return CLI_USAGE;
    const char *text = own ? own : study_builtin_text;
    int status = CLI_DONE;
    if (w->show) {
        fwrite(text, 1, length, stdout);
        status = cli_close(stdout, "standard output");
    } else {
        status = run_text(w, text, length);
    }
    free(own);
    return status;
}

int command_study(int argc, char **argv)
{
    settings w = {.threads = pool_threads(), .interval = run_settings_default().interval};
    cli_args args = cli_begin(argc, argv, options, OWN_OPTIONS, notes);
    const char *value;
    for (int k; (k = cli_next(&args, &value)) != CLI_STOP;) {
        int status = take(&w, k, value);
        if (status != CLI_DONE) cli_stop(&args, status);
    }
    return args.status == CLI_GO_ON ? run_study(&w) : args.status;
}

/* ---- going on ---- */

int study_resume(const char *directory, const study_run_options *how)
{
    study_plan plan = {0};
    study_directory dir = {0};
    study_directory_open(&dir, directory);
    int status = study_directory_read(&dir, &plan);
    if (status == CLI_DONE) status = run_cells(&plan, &dir, how);
    study_plan_free(&plan);
    study_directory_close(&dir);
    return status;
}
