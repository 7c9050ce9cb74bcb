/* steer_output.c - the directory of a search.
 *
 *     DIR/manifest.json, ...   the run of the cheapest motion: see run_directory.h
 *     DIR/inputs.csv           t and the inputs u1.., or accelerations a_x.., at each step
 *     DIR/controlled.yaml      the system with the forces C u of these inputs, of effort controls
 *     DIR/motion-2, ...        the same of the other motions
 *     DIR/best.csv             instead, where a search has failed: states of the nearest motion
 *     DIR/steer.json           what --json prints */
#include "steer_output.h"
#include "dalembert_program.h"
#include "io/file.h"
#include "io/file_output.h"
#include "run/request_command.h"
#include "run/run.h"
#include "run/system.h"
#include "steer_results.h"
#include "ui/memory.h"

#include <stdlib.h>
#include <string.h>

enum { NAME = 80 };

static const char inputs_file[] = "inputs.csv", system_file[] = "controlled.yaml",
                  best_file[] = "best.csv";

/* ---- tables -------------------------------------------------------------------------------- */

/* Writes t and values[] of each row: the inputs or, of another file, the state. */
static int write_table(const run_simulation *simulation, const dal_steering *s,
                       const char *directory, const char *file, const double *values)
{
    const bool is_state = file != inputs_file;
    const int columns = is_state ? s->dimension : s->inputs;
    const size_t count = (size_t)columns + 1;
    trajectory_writer table;
    char *path = cli_join(directory, file), **names = cli_calloc(count, sizeof *names + NAME);
    double *row = cli_calloc(count, sizeof *row);
    for (int i = 0; i <= columns; i++) {
        names[i] = (char *)(names + count) + i * NAME;
        if (i == 0)
            snprintf(names[i], NAME, "t");
        else if (is_state)
            dal_run_component_name(simulation->run, i - 1, names[i], NAME);
        else if (simulation->system->effort == DAL_EFFORT_CONTROLS)
            snprintf(names[i], NAME, "u%d", i);
        else
            snprintf(names[i], NAME, "a_%s", simulation->system->coordinate[i - 1]);
    }
    int status = writer_create(&table, path, names, columns + 1);
    for (long long k = 0; k < s->rows && status == CLI_DONE; k++) {
        row[0] = s->t[k];
        memcpy(row + 1, values + k * columns, (size_t)columns * sizeof *row);
        status = writer_append(&table, row);
    }
    const int closed = writer_close(&table);
    free(row);
    free(names);
    free(path);
    return status == CLI_DONE ? closed : status;
}

/* ---- the controlled system ------------------------------------------------------------------ */

/* Adds the forces C u to the text of a system. */
static void put_controls(FILE *out, const dal_model *model, const dal_system *system, int controls)
{
    const char *formula, *name;
    fputs("\n# The inputs that 'dalembert steer' found.\ntables:\n", out);
    for (int k = 1; k <= controls; k++)
        fprintf(out,
                "  u%d: {file: %s, at: t, value: u%d, interpolation: not-a-knot, "
                "extend: linear}\n",
                k, inputs_file, k);
    fputs("forces:\n", out);
    for (int i = 0; i < system->n; i++) {
        const char *between = NULL;
        for (int k = 0;
             (formula = dal_model_text(model, DAL_SECTION_CONTROLS, k, &name, NULL, NULL)) != NULL;
             k++) {
            if (strcmp(name, system->coordinate[i]) != 0) continue;
            if (!between) fprintf(out, "  \"%s\": \"", name);
            fprintf(out, "%s(%s)*u%d(t)", between ? between : "", formula,
                    dal__model_item(model, DAL_SECTION_CONTROLS, k));
            between = " + ";
        }
        if (between) fputs("\"\n", out);
    }
}

/* Writes the controlled system; where its file has forces or tables already, or names of the
 * inputs, a line says that there is none. */
static int write_controlled(const run_simulation *simulation, const char *directory, int controls)
{
    const char *system = simulation->request.system_name;
    char *text, *path = cli_join(directory, system_file);
    size_t length;
    dal_model *made = NULL;
    const dal_system *checked;
    dal_error error = {0};
    const char *source = cli_is_path(system) ? dal_model_source(simulation->model, &length)
                                             : dal_builtin_text(system);
    FILE *out = cli_memstream_open(&text, &length);
    fputs(source ? source : "", out);
    put_controls(out, simulation->model, simulation->system, controls);
    cli_memstream_close(out);
    int status = file_replace(path, text, length, FILE_UNSYNCED);
    if (status == CLI_DONE) {
        dal_status read = dal_model_read_file(&made, path, &error);
        if (read == DAL_STATUS_OK) read = dal_model_system(made, &checked, &error);
        if (read == DAL_STATUS_MEMORY) cli_out_of_memory();
        if (read != DAL_STATUS_OK) {
            cli_note("no %s: %s", system_file, error.message);
            status = file_remove(path);
        }
    }
    dal_model_free(made);
    free(text);
    free(path);
    return status;
}

/* ---- runs ---------------------------------------------------------------------------------- */

/* Makes the directory of a motion, without what another search has left there. */
static int open_directory(const char *path)
{
    static const char *const files[] = {inputs_file, system_file, best_file};
    run_directory dir;
    int status = file_make_directory(path);
    run_directory_open(&dir, path);
    for (int i = 0; i < RUN_FILES && status == CLI_DONE; i++) status = file_remove(dir.file[i]);
    run_directory_close(&dir);
    for (size_t i = 0; i < sizeof files / sizeof *files && status == CLI_DONE; i++) {
        char *file = cli_join(path, files[i]);
        status = file_remove(file);
        free(file);
    }
    return status;
}

/* Runs the system from the start of a motion, in a directory; *again: see steer_write. */
static int write_motion(const steer_results *r, const double *z, const double *u,
                        const char *directory, char **again)
{
    const dal_steering *s = r->steering;
    run_simulation simulation = r->set->simulation;
    run_request *request = &simulation.request;
    char name[NAME];
    const bool has_controls = s->inputs > 0 && simulation.system->effort == DAL_EFFORT_CONTROLS;
    const run_settings settings = {
        .output = directory, .interval = 5.0, .force = true, .has_no_screen = true};
    request->start = (request_settings){NULL, 0};
    simulation.run = NULL;
    for (int i = 0; i < s->dimension; i++) {
        dal_run_component_name(r->set->simulation.run, i, name, sizeof name);
        request_add_setting(&request->start, name, z[i]);
    }
    int status = simulation_create(&simulation);
    if (status == CLI_DONE) status = open_directory(directory);
    if (status == CLI_DONE) status = run_in_directory(&simulation, &settings);
    if (status == CLI_DONE && s->inputs > 0)
        status = write_table(&simulation, s, directory, inputs_file, u);
    if (status == CLI_DONE && has_controls)
        status = write_controlled(&simulation, directory, s->inputs);
    char *path = cli_join(directory, system_file);
    if (status == CLI_DONE && has_controls && file_exists(path)) {
        while (request->start.count > 2 * s->n)
            free((char *)request->start.item[--request->start.count].name);
        *again = request_format_command(request, "run", path,
                                        (unsigned)(REQUEST_OPTION(effort) | REQUEST_OPTION(gauge)));
    }
    free(path);
    request_free_settings(&request->start);
    dal_run_free(simulation.run);
    return status;
}

int steer_write(const steer_results *r, char **again)
{
    const dal_steering *s = r->steering;
    const char *output = r->set->output;
    *again = NULL;
    int status = r->status == CLI_DONE ? CLI_DONE : open_directory(output);
    if (r->status != CLI_DONE && status == CLI_DONE && s->count > 0)
        status = write_table(&r->set->simulation, s, output, best_file, s->extremal->z);
    for (int k = 0; k < s->count && r->status == CLI_DONE && status == CLI_DONE; k++) {
        const dal_extremal *e = &s->extremal[k];
        char *unused = NULL,
             *path = k == 0 ? cli_strdup(output) : cli_format("%s/motion-%d", output, k + 1);
        if (e->status == DAL_STATUS_OK)
            status = write_motion(r, e->z, e->u, path, k == 0 ? again : &unused);
        free(unused);
        free(path);
    }
    if (status != CLI_DONE) return status;
    char *text, *path = cli_join(output, "steer.json");
    size_t length;
    FILE *out = cli_memstream_open(&text, &length);
    steer_put_json(out, r);
    cli_memstream_close(out);
    status = file_replace(path, text, length, FILE_UNSYNCED);
    free(text);
    free(path);
    return status;
}
