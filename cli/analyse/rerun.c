/* rerun.c - the request of a run's directory, for a command that runs it again. */
#include "rerun.h"
#include "dalembert_program.h"
#include "io/file.h"
#include "io/json.h"
#include "io/store.h"
#include "run/manifest.h"
#include "run/row_times.h"
#include "run/run_directory.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* A study has many runs in directories of their own, an ensemble has none. */
static int check_directory(const run_directory *dir)
{
    const yaml_node_t *root = dir->doc ? document_node(dir->doc, 1) : NULL;
    char *study = cli_join(dir->path, "study.yaml");
    const bool has_study = file_exists(study);
    free(study);
    if (has_study && !document_value(dir->doc, root, "input"))
        return cli_fail(CLI_USAGE, "'%s' holds a study: name one of its runs, '%s/runs/...'",
                        dir->path, dir->path);
    if (document_value(dir->doc, root, "ensemble"))
        return cli_fail(CLI_USAGE, "'%s' holds an ensemble, not a run", dir->path);
    if (dir->doc) return CLI_DONE;
    return cli_fail(CLI_USAGE, "'%s' holds no run: there is no '%s'", dir->path, dir->manifest);
}

/* Adds an option to the request and to the line. */
static int take(run_request *request, int option, const char *text, FILE *line)
{
    fprintf(line, " --%s %s", request_options[option].name, text);
    return request_give(request, option, cli_strdup(text));
}

/* Steps where the command counts the same ones; else the time. */
static int take_end(run_request *request, const run_request *held, uint64_t without, FILE *line)
{
    char text[32];
    const bool counts_steps = !(without & REQUEST_OPTION(steps)) && held->steps > 0 &&
                              request->options.step == held->options.step &&
                              request->from == held->from;
    if (request_has(request, REQUEST_time) || request_has(request, REQUEST_steps)) return CLI_DONE;
    if (counts_steps) return take(request, REQUEST_steps, held->text[REQUEST_steps], line);
    if (request_has(held, REQUEST_time))
        return take(request, REQUEST_time, held->text[REQUEST_time], line);
    const double end = held->steps > 0 ? step_end(held->from, held->options.step, held->steps)
                                       : held->listed[held->times - 1];
    snprintf(text, sizeof text, "%.15g", end);
    if (strtod(text, NULL) != end) snprintf(text, sizeof text, "%.17g", end);
    return take(request, REQUEST_time, text, line);
}

/* Settings that were given replace the ones of the run. */
static void take_settings(request_settings *settings, request_settings *held, const char *name,
                          FILE *line)
{
    const request_settings given = *settings;
    for (int i = 0; i < held->count; i++) {
        int k = 0;
        while (k < given.count && strcmp(given.item[k].name, held->item[i].name) != 0) k++;
        if (k == given.count)
            fprintf(line, " --%s %s=%.15g", name, held->item[i].name, held->item[i].value);
    }
    *settings = *held;
    *held = given;
    for (int i = 0; i < given.count; i++)
        request_add_setting(settings, given.item[i].name, given.item[i].value);
}

static int take_options(run_request *request, run_request *held, uint64_t without, FILE *line)
{
    int status = CLI_DONE;
    without |=
        REQUEST_OPTION(time) | REQUEST_OPTION(steps) | REQUEST_OPTION(set) | REQUEST_OPTION(start);
    for (int k = 0; k < REQUEST_system && status == CLI_DONE; k++)
        if (held->text[k] && !request_has(request, k) && !(without >> k & 1))
            status = take(request, k, held->text[k], line);
    take_settings(&request->set, &held->set, "set", line);
    take_settings(&request->start, &held->start, "start", line);
    return status;
}

static int take_request(run_request *request, run_request *held, uint64_t without,
                        const char *directory, char **text)
{
    size_t length;
    const dal_precision standard = dal_options_default().precision;
    if (without & REQUEST_OPTION(precision) && held->options.precision != standard)
        return cli_fail(CLI_USAGE, "'%s' holds a run with --precision %s, which is no option here",
                        directory, held->text[REQUEST_precision]);
    FILE *line = cli_memstream_open(text, &length);
    fprintf(line, "%s gives %s", directory, held->system_name);
    int status = take_options(request, held, without, line);
    if (status == CLI_DONE) status = take_end(request, held, without, line);
    cli_memstream_close(line);
    request->made[REQUEST_system] = cli_strdup(held->system_name);
    request->text[REQUEST_system] = request->system_name = request->made[REQUEST_system];
    return status;
}

static int complete_from(run_request *request, const char *directory, uint64_t without, char **line)
{
    run_directory dir;
    run_request held = request_default();
    char *bytes = NULL;
    run_directory_open(&dir, directory);
    int status =
        file_exists(dir.manifest) ? store_read_manifest(dir.manifest, &dir.doc, &bytes) : CLI_DONE;
    if (status == CLI_DONE) status = check_directory(&dir);
    if (status == CLI_DONE) status = manifest_read_input(&held, dir.doc, dir.system);
    if (status == CLI_DONE) status = take_request(request, &held, without, directory, line);
    free(bytes);
    request_free(&held);
    run_directory_close(&dir);
    return status;
}

static int take_run(const cli_option_set *set, int status)
{
    run_simulation *s = set->settings; /* of which the request is the first member */
    run_request *request = &s->request;
    struct stat info;
    char *line = NULL;
    const char *system = request->system_name;
    const bool is_directory = system && (strchr(system, '/') || !dal_builtin_text(system)) &&
                              stat(system, &info) == 0 && S_ISDIR(info.st_mode);
    if (is_directory) {
        const int taken = complete_from(request, system, set->without, &line);
        if (line && taken == CLI_DONE && status == CLI_DONE) cli_note("%s", line);
        free(line);
        if (taken != CLI_DONE) return taken;
    }
    return simulation_options(s, set->options, set->without).complete(set, status);
}

cli_option_set rerun_options(run_simulation *s, const cli_option *options, uint64_t without)
{
    cli_option_set set = simulation_options(s, options, without);
    set.complete = take_run;
    return set;
}
