/* study.c - `dalembert study`: systems x integrators x steps x starts, in tables and files. */
#include "study.h"
#include "file.h"
#include "pool.h"

#include <stdlib.h>
#include <string.h>

/* The study that travels inside the program: bench/studies/canonical-drift.yaml. */
extern const char study_builtin_text[];

static const char builtin_name[] = "canonical-drift";
static const char default_directory[] = "dalembert-study";

/* ---- options ---- */

typedef struct wishes {
    const char *study, *output;
    long long threads;
    int show;
    cli_native native;
} wishes;

#define OPTION_LIST(X)                                                                             \
    X(output, "DIR", "the files go there", default_directory)                                      \
    X(threads, "N", "cells at a time; the results do not depend on it",                            \
      "OMP_NUM_THREADS or one per processor")                                                      \
    X(native, "auto|on|off", "compile the steps, which changes no bit: when it pays", "auto")      \
    X(show, NULL, "print the study file itself and do nothing", NULL)

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
    "Without a file the built-in study is run.  A study file is YAML; its keys:\n"
#define X(name, scope, help) "  " #name " (" scope "): " help "\n"
    STUDY_KEY_LIST(X)
#undef X
        "\n"
        "Values are one number, a list, {from: 0, to: 1, count: 11}, {from: 0, to: 1, by: 0.1}, "
        "or,\n"
        "for parameters and starts, {between: [0, 1]}: drawn, once for each of the seeds, as a\n"
        "function of seed and name alone; where something of the start is drawn, its velocities\n"
        "are then brought onto D = 0.  Every combination of values is a system of the study, "
        "called\n"
        "LABEL_name=value...\n"
        "\n"
        "expect: label, or system, or all; then integrator, or all; then quantity: a verdict, a "
        "list\n"
        "of them, bounds of its size {at most: 1e-9, at least: 0}, or a mapping of verdict:, "
        "max:,\n"
        "deviation:, final:, amplitude:, rate:, rate_low:, rate_high:, exponent:, confidence: "
        "with\n"
        "such bounds.  D is the worst of the constraints; state is done, failed or refused.  "
        "Exit\n"
        "status 1 when something is not as expected.\n"
        "\n"
        "stdout gets a table per system, step and start; DIR gets\n"
        "  study.yaml        the study itself\n"
        "  tables.txt        the tables\n"
        "  cells.csv         a row per cell (system, integrator, start, step)\n"
        "  quantities.csv    a row per cell and observable: first, last, max |x|, max |x - "
        "first|,\n"
        "                    least-squares rate, distance from that line, verdict\n"
        "  expectations.csv  what was expected and what was found, where something was\n"
        "  series/LABEL.csv  for figures: maxima within each hundredth of the time\n"
        "All but processor times are the same bytes in every run, whatever the number of threads.\n"
        "\n"
        "A cell that fails is told in its row and the study goes on; the exit status is then 3.  "
        "A\n"
        "cell is refused, which is no failure, where the integrator needs what the system lacks.\n"
        "After an interruption (130) the files hold all cells that were finished.\n";

static int take(wishes *w, int option, const char *value)
{
    switch (option) {
    case OPTION_output:
        w->output = value;
        return CLI_DONE;
    case OPTION_threads:
        return cli_integer("--threads", value, 1, POOL_MOST, &w->threads);
    case OPTION_native:
        return native_read(value, &w->native);
    case OPTION_show:
        w->show = 1;
        return CLI_DONE;
    default:
        if (w->study) return cli_fail(CLI_USAGE, "more than one study: '%s'", value);
        w->study = value;
        return CLI_DONE;
    }
}

/* ---- the study ---- */

static int any_failed(const study_plan *plan)
{
    for (int i = 0; i < plan->cell_count; i++)
        if (plan->cells[i].state == STUDY_FAILED &&
            !study_failure_is_expected(plan, &plan->cells[i]))
            return 1;
    return 0;
}

static void print_tables(FILE *out, const study_plan *plan)
{
    fprintf(out, "%s\n", plan->title);
    for (int i = 0; i < plan->entry_count; i++) study_print_entry(out, plan, &plan->entries[i]);
    study_print_note(out);
    study_print_expectations(out, plan);
}

static int keep_tables(const char *directory, const study_plan *plan)
{
    char *path = cli_join(directory, "tables.txt");
    FILE *file = path ? fopen(path, "w") : NULL;
    int status = file ? CLI_DONE : path ? cli_io("write", path) : cli_fail(CLI_IO, "out of memory");
    if (file) {
        print_tables(file, plan);
        status = cli_close(file, path);
    }
    free(path);
    return status;
}

static int keep_expectations(const char *directory, const study_plan *plan)
{
    char *path = cli_join(directory, "expectations.csv");
    int status = path ? study_keep_expectations(plan, path) : cli_fail(CLI_IO, "out of memory");
    free(path);
    return status;
}

static int tell_tables(const char *directory, const study_plan *plan)
{
    int kept = keep_tables(directory, plan);
    if (kept == CLI_DONE) kept = keep_expectations(directory, plan);
    print_tables(stdout, plan);
    int told = cli_close(stdout, "standard output");
    return kept != CLI_DONE ? kept : told;
}

static int copy_study(const char *directory, const char *text, size_t length)
{
    char *path = cli_join(directory, "study.yaml");
    if (!path) return cli_fail(CLI_IO, "out of memory");
    int status = file_replace(path, text, length);
    free(path);
    return status;
}

static int run_plan(study_plan *plan, const wishes *w, const char *text, size_t length)
{
    study_output *output = NULL;
    int status = study_output_open(&output, w->output);
    if (status == CLI_DONE) status = copy_study(w->output, text, length);
    if (status == CLI_DONE) {
        cli_catch_signals();
        status = study_pool_run(plan, (int)w->threads);
    }
    for (int i = 0; i < plan->cell_count && (status == CLI_DONE || status == CLI_SIGNAL); i++)
        if (plan->cells[i].state != STUDY_WAITING &&
            study_output_cell(output, plan, &plan->cells[i]) != CLI_DONE)
            status = CLI_IO;
    int closed = study_output_close(output);
    if (status != CLI_DONE && status != CLI_SIGNAL) return status;
    int told = tell_tables(w->output, plan);
    if (status == CLI_SIGNAL)
        return cli_fail(status, "interrupted; finished cells are in '%s'", w->output);
    if (told != CLI_DONE || closed != CLI_DONE) return CLI_IO;
    if (any_failed(plan)) return CLI_FAILED;
    return study_judge(plan) > 0 ? CLI_CHECK : CLI_DONE;
}

static int run_study(const wishes *w)
{
    study_plan plan = {0};
    char *own = NULL;
    const char *text = study_builtin_text;
    size_t length = strlen(study_builtin_text);
    if (w->study) {
        text = own = file_read(w->study, &length);
        if (!own) return CLI_USAGE;
    }
    int status = CLI_DONE;
    if (w->show)
        fwrite(text, 1, length, stdout);
    else
        status = study_plan_read(&plan, w->study ? w->study : builtin_name, text, length, NULL);
    for (int i = 0; i < plan.entry_count; i++) plan.entries[i].native = w->native;
    if (status == CLI_DONE && !w->show) status = run_plan(&plan, w, text, length);
    if (w->show) status = cli_close(stdout, "standard output");
    study_plan_free(&plan);
    free(own);
    return status;
}

int command_study(int argc, char **argv)
{
    wishes w = {.output = default_directory, .threads = pool_threads()};
    cli_args args = cli_begin(argc, argv, options, OPTIONS, notes);
    const char *value;
    for (int k; (k = cli_next(&args, &value)) != CLI_STOP;) {
        int status = take(&w, k, value);
        if (status != CLI_DONE) cli_stop(&args, status);
    }
    return args.status == CLI_GO_ON ? run_study(&w) : args.status;
}
