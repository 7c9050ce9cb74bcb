/* system.c - reads the system of a command. */
#include "system.h"
#include "dalembert_method.h"
#include "dalembert_program.h"
#include "io/file.h"
#include "io/file_output.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

bool cli_is_path(const char *system)
{
    struct stat status;
    if (strchr(system, '/') || cli_ends_in(system, ".yaml") || cli_ends_in(system, ".yml"))
        return true;
    return !dal_builtin_text(system) && stat(system, &status) == 0;
}

static int read_path(const char *path, dal_model **model)
{
    struct stat status;
    dal_error error = {0};
    /* A wrong path is a wrong input, no failure of a disk. */
    if (stat(path, &status) != 0)
        return cli_fail(CLI_USAGE, "cannot read '%s': %s", path, strerror(errno));
    if (S_ISDIR(status.st_mode))
        return cli_fail(CLI_USAGE, "cannot read '%s': it is a directory", path);
    const dal_status read = dal_model_read_file(model, path, &error);
    if (read == DAL_STATUS_OK) return CLI_DONE;
    return cli_error(read == DAL_STATUS_IO ? CLI_IO : cli_input_exit(read), path, &error);
}

int cli_builtins(const char *names[CLI_MAX_BUILTINS])
{
    int count = 0;
    while (count < CLI_MAX_BUILTINS && (names[count] = dal_builtin_name(count))) count++;
    return count;
}

static int read_builtin(const char *name, dal_model **model)
{
    const char *names[CLI_MAX_BUILTINS];
    dal_error error = {0};
    if (!dal_builtin_text(name)) {
        struct stat status;
        const int count = cli_builtins(names);
        char *path = cli_format("%s.yaml", name);
        const bool is_there = stat(path, &status) == 0;
        const int failed =
            is_there ? cli_fail(CLI_USAGE, "unknown system '%s'; there is '%s'", name, path)
            : dal__nearest_name(name, names, count)
                ? cli_unknown("system", name, names, count)
                : cli_fail(CLI_USAGE,
                           "unknown system '%s', and no such file; 'dalembert list systems' names "
                           "the systems",
                           name);
        free(path);
        return failed;
    }
    const dal_status read = dal_model_builtin(model, name, &error);
    return read == DAL_STATUS_OK ? CLI_DONE : cli_error(cli_input_exit(read), name, &error);
}

int cli_read(const char *system, dal_model **model)
{
    *model = NULL;
    return cli_is_path(system) ? read_path(system, model) : read_builtin(system, model);
}

int cli_copy_system(const char *system, const dal_model *model, const char *to, file_sync sync)
{
    size_t length;
    const char *source = dal_model_source(model, &length);
    return source ? file_replace(to, source, length, sync) : file_copy(system, to, sync);
}

int cli_keep_system(const char *system, const dal_model *model, const char *to, file_sync sync)
{
    return cli_is_path(system) ? cli_copy_system(system, model, to, sync) : file_remove(to);
}

const char *cli_default(const dal_model *model, const char *name, int *line, int *column)
{
    const char *text, *key;
    for (int i = 0;
         (text = dal_model_text(model, DAL_SECTION_DEFAULTS, i, &key, line, column)) != NULL; i++)
        if (strcmp(key, name) == 0) return text;
    return NULL;
}

static bool is_one_of(const char *const *names, int count, const char *name)
{
    for (int i = 0; i < count; i++)
        if (strcmp(names[i], name) == 0) return true;
    return false;
}

int cli_find_coordinate(const dal_system *system, const char *name)
{
    int i = system->n - 1;
    while (i >= 0 && strcmp(system->coordinate[i], name) != 0) i--;
    return i;
}

bool cli_has_name(const dal_system *system, const char *name)
{
    return cli_find_coordinate(system, name) >= 0 ||
           is_one_of(system->parameter, system->parameters, name) ||
           is_one_of(system->invariant, system->invariants, name);
}

int cli_constant(const char *what, const char *text, double *value)
{
    const dal_system *system;
    if (dal__parse_number(text, strlen(text), value) != DAL_STATUS_SYNTAX)
        return cli_number(what, text, value);
    dal_model *model = dal_model_create(NULL); /* whose parameters are formulas of numbers */
    if (!model) cli_out_of_memory();
    dal_status status = dal_model_add(model, DAL_SECTION_PARAMETERS, "value", text, 0, 0, NULL);
    if (status == DAL_STATUS_OK)
        status = dal_model_add(model, DAL_SECTION_COORDINATES, NULL, "q", 0, 0, NULL);
    if (status == DAL_STATUS_OK)
        status = dal_model_add(model, DAL_SECTION_LAGRANGIAN, NULL, "q'^2/2", 0, 0, NULL);
    if (status == DAL_STATUS_OK) status = dal_model_system(model, &system, NULL);
    if (status == DAL_STATUS_OK) *value = system->value[0];
    dal_model_free(model);
    if (status == DAL_STATUS_MEMORY) cli_out_of_memory();
    return status == DAL_STATUS_OK && isfinite(*value) ? CLI_DONE : cli_number(what, text, value);
}

static void print_warnings(const char *place, const dal_model *model)
{
    const char *text;
    int line, column;
    for (int i = 0; (text = dal_model_warning(model, i, &line, &column)) != NULL; i++)
        cli_note("%s:%d:%d: warning: %s", place, line, column, text);
}

static const char gauge_place[] = "--gauge";

/* Frees a model that cannot be used. */
static int refuse(dal_model **model, const dal_system **made, dal_status reason, const char *place,
                  const dal_error *error)
{
    dal_model_free(*model);
    *model = NULL;
    *made = NULL;
    return cli_error(cli_input_exit(reason), place, error);
}

int cli_choose(dal_model **model, const cli_choices *choices)
{
    dal_error error = {0};
    const dal_system *made;
    dal_model_set_effort(*model, choices->effort, NULL);
    dal_model_set_mechanics(*model, choices->mechanics, NULL);
    const dal_status status =
        choices->gauge ? dal_model_set_gauge(*model, choices->gauge, &error) : DAL_STATUS_OK;
    return status == DAL_STATUS_OK ? CLI_DONE : refuse(model, &made, status, gauge_place, &error);
}

/* Makes the system of a model; an error of a formula that it observes, or of a gauge that was
 * chosen, names another place. */
static int make_system(const char *system, const cli_choices *choices, const char *formulas,
                       dal_model **model, const dal_system **made)
{
    static const char prefix[] = "observed: ";
    const size_t length = sizeof prefix - 1;
    dal_error error = {0};
    dal_method method;
    int line, column;
    dal_status make = dal_model_system(*model, made, &error);
    const char *integrator = cli_default(*model, "integrator", &line, &column);
    if (make == DAL_STATUS_OK && integrator) {
        make = dal_method_parse(&method, integrator, &error);
        error.line = line;
        error.column = column;
    }
    if (make == DAL_STATUS_OK) return CLI_DONE;
    if (choices->gauge && strncmp(error.message, "gauge ", strlen("gauge ")) == 0)
        return refuse(model, made, make, gauge_place, &error);
    const bool is_formula = strncmp(error.message, prefix, length) == 0;
    if (is_formula)
        memmove(error.message, error.message + length, strlen(error.message + length) + 1);
    return refuse(model, made, make, is_formula ? formulas : system, &error);
}

int cli_load(const char *system, const cli_choices *choices, dal_model **model,
             const dal_system **made)
{
    int status = cli_read(system, model);
    if (status == CLI_DONE) status = cli_choose(model, choices);
    if (status == CLI_DONE) status = make_system(system, choices, system, model, made);
    if (status == CLI_DONE) print_warnings(system, *model);
    return status;
}

int cli_observe(const char *system, const cli_choices *choices, const char *place,
                const cli_formula *formulas, int count, dal_model **model, const dal_system **made)
{
    dal_error error = {0};
    const bool is_known = *model != NULL;
    dal_model_free(*model);
    int status = cli_read(system, model);
    if (status == CLI_DONE) status = cli_choose(model, choices);
    if (status != CLI_DONE) return status;
    for (int i = 0; i < count; i++) {
        const cli_formula *f = &formulas[i];
        const dal_status added = dal_model_observe(*model, f->text, f->line, f->column, &error);
        if (added != DAL_STATUS_OK) return refuse(model, made, added, place, &error);
    }
    status = make_system(system, choices, place, model, made);
    if (status == CLI_DONE && !is_known) print_warnings(system, *model);
    return status;
}
