/* analysis.c - outputs and distances of the commands that examine a system or a motion. */
#include "analysis.h"
#include "dalembert_evaluator.h"
#include "io/file.h"
#include "io/file_output.h"
#include "run/system.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int analysis_check_directory(const char *output)
{
    return output && cli_is_directory(output) ? file_check_directory(output) : CLI_DONE;
}

int analysis_open(analysis_output *output, const char *path, const char *name)
{
    *output = (analysis_output){0};
    if (!cli_is_directory(path)) {
        output->table = cli_strdup(path);
        return CLI_DONE;
    }
    output->directory = path;
    char *file = cli_format("%s.csv", name);
    output->table = cli_join(path, file);
    free(file);
    return file_make_directory(path);
}

void analysis_close(analysis_output *output, int exit_status)
{
    if (output->directory) file_report_directory(output->directory, exit_status);
    free(output->table);
}

int analysis_describe(const analysis_output *output, const char *name,
                      const run_simulation *simulation,
                      void (*put)(json_writer *writer, const void *results), const void *results)
{
    char *text, *json = cli_format("%s/%s.json", output->directory, name);
    char *copy = cli_format("%s/%s.yaml", output->directory, name);
    size_t length;
    json_writer w = json_begin_results_in(cli_memstream_open(&text, &length), name);
    put(&w, results);
    json_end_results(&w);
    cli_memstream_close(w.out);
    int status = file_replace(json, text, length, FILE_UNSYNCED);
    if (status == CLI_DONE)
        status = cli_keep_system(simulation->request.system_name, simulation->model, copy,
                                 FILE_UNSYNCED);
    free(text);
    free(json);
    free(copy);
    return status;
}

int analysis_check_output(const char *output, bool json)
{
    if (!json || !output || strcmp(output, "-") != 0) return CLI_DONE;
    return cli_fail(CLI_USAGE, "--json and --output - would both write to standard output");
}

/* What a branch leaves of the order, into text[size]. */
static void describe_branch(const dal_branch *b, char *text, size_t size)
{
    if (b->jump == DAL_JUMP_IMPULSE)
        snprintf(text, size, "L_v or D jumps: F lacks the impulse of it");
    else if (b->jump == DAL_JUMP_UNKNOWN)
        snprintf(text, size, "none changes near the start");
    else if (b->jump == DAL_JUMP_NONE)
        snprintf(text, size, "F and three derivatives are continuous");
    else
        snprintf(text, size, "F%.*s jumps: order %d across it", b->jump, "'''", b->jump + 1);
}

void analysis_list_branches(dal_model *model,
                            void (*add)(void *user, const char *what, const char *text), void *user)
{
    enum { MAX_BRANCHES = 16 };
    dal_branch branch[MAX_BRANCHES];
    int count = 0;
    if (!model || dal_model_branches(model, branch, MAX_BRANCHES, &count) != DAL_STATUS_OK) return;
    for (const dal_branch *b = branch; b < branch + count && b < branch + MAX_BRANCHES; b++) {
        char what[64], text[64];
        snprintf(what, sizeof what, "branches, %.50s", b->formula);
        describe_branch(b, text, sizeof text);
        add(user, what, text);
    }
}

double analysis_distance(const double *a, const double *b, const double *units, int count)
{
    double max = 0.0;
    for (int i = 0; i < count; i++) {
        const double gap = fabs(a[i] - b[i]) / fmax(units ? units[i] : 1.0, fabs(b[i]));
        max = gap <= max ? max : isnan(gap) ? INFINITY : gap;
    }
    return max;
}
