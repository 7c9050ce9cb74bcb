/* simulation.c - the system, the run and the rows of a request. */
#include "simulation.h"
#include "columns.h"
#include "io/text.h"
#include "row_times.h"
#include "system.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <stdlib.h>
#include <string.h>

/* The options that a system file may give. */
static const int default_options[] = {REQUEST_integrator, REQUEST_step, REQUEST_time};
enum { DEFAULTS = sizeof default_options / sizeof *default_options };

run_simulation simulation_default(void) { return (run_simulation){.request = request_default()}; }

void simulation_free(run_simulation *s)
{
    dal_run_free(s->run);
    dal_sensitivity_free(s->sensitivity);
    dal_model_free(s->model);
    free(s->row_time);
    request_free(&s->request);
    *s = (run_simulation){.run = NULL};
}

/* The system, with what is chosen and the formulas of --observe. */
static int load_system(run_simulation *s)
{
    const run_request *request = &s->request;
    const char *list = request->observe;
    cli_formula *formula = NULL;
    int count = 0;
    if (!list) return cli_load(request->system_name, &request->choices, &s->model, &s->system);
    for (const char *at = list, *end; at; at = *end ? end + 1 : NULL) {
        const size_t length = request_find_formula(&at, &end);
        formula = cli_realloc(formula, ((size_t)count + 1) * sizeof *formula);
        formula[count++] = (cli_formula){cli_strndup(at, length), 1, (int)(at - list) + 1};
    }
    const int status = cli_observe(request->system_name, &request->choices, "--observe", formula,
                                   count, &s->model, &s->system);
    for (int i = 0; i < count; i++) free((char *)formula[i].text);
    free(formula);
    return status;
}

/* Adds +project to a method that lets holonomic constraints drift, and says so; a method that
 * cannot be used is refused when the run is made. */
static void complete_method(run_simulation *s)
{
    bool added;
    dal_method_complete(&s->request.method, s->system, &s->request.options, &added, NULL);
    if (added)
        cli_note("holonomic constraints drift with this method: +project is added; --bare on "
                 "leaves it out");
}

/* Takes those that the command needs and does not have; a line says which. */
static int take_defaults(const cli_option_set *set, int status)
{
    run_simulation *s = set->settings; /* of which the request is the first member */
    run_request *request = &s->request;
    char taken[512] = "";
    if (!request->system_name) return CLI_DONE;
    int found = load_system(s);
    if (found != CLI_DONE) return found;
    for (int i = 0; i < DEFAULTS; i++) {
        const int k = default_options[i];
        const cli_option *option = &set->options[k];
        const char *text = cli_default(s->model, option->name, NULL, NULL);
        const size_t length = strlen(taken);
        if (set->without >> k & 1 || !request_lacks(request, k)) continue;
        if (!text && !option->initial)
            found = cli_fail(CLI_USAGE, "--%s is missing, and %s has no default for it",
                             option->name, request->system_name);
        if (!text) continue;
        snprintf(taken + length, sizeof taken - length, " --%s %s", option->name, text);
        const int parsed = request_give(request, k, cli_strdup(text));
        if (found == CLI_DONE) found = parsed;
    }
    if (taken[0] && found == CLI_DONE && status == CLI_DONE)
        cli_note("%s gives%s", request->system_name, taken);
    if (found == CLI_DONE && status == CLI_DONE) complete_method(s);
    /* A command that does not take --from goes from t = 0 forwards. */
    const bool is_forward = set->without & REQUEST_OPTION(from);
    const int forward = is_forward ? request_check_forward(request) : CLI_DONE;
    return found == CLI_DONE ? forward : found;
}

cli_option_set simulation_options(run_simulation *s, const cli_option *options, uint64_t without)
{
    return (cli_option_set){options, REQUEST_OPTIONS, s, s->request.text, without,
                            "run",   take_defaults};
}

dal_run_spec simulation_spec(const run_simulation *s)
{
    const run_request *request = &s->request;
    return (dal_run_spec){.system = s->system,
                          .parameters = request->set.item,
                          .parameter_count = request->set.count,
                          .start = request->start.item,
                          .start_count = request->start.count,
                          .start_time = request->from};
}

int simulation_make_spec(run_simulation *s, dal_run_spec *spec)
{
    run_request *request = &s->request;
    if (!s->system) { /* else the method is complete: see take_defaults */
        const int status = load_system(s);
        if (status != CLI_DONE) return status;
        dal_method_complete(&request->method, s->system, &request->options, NULL, NULL);
    }
    const double min = dal_min_tolerance(&request->options);
    if (request->options.tolerance > 0.0 && request->options.tolerance < min)
        return cli_fail(CLI_USAGE, "--tolerance: %g is below %.2g, the smallest in this precision",
                        request->options.tolerance, min);
    /* Where the system or the method has no lift there is one space alone; only an explicit
     * --space=lifted is an error. */
    const bool has_lift =
        s->system->call.adjoint && !(dal_method_needs(&request->method) & DAL_NEEDS_BLOCKS);
    if (!request_has(request, REQUEST_space) && !has_lift) request->options.space = DAL_PHYSICAL;
    if (columns_need_reactions(s->system, request->columns)) request->options.reactions = true;
    *spec = simulation_spec(s);
    spec->method = request->method;
    spec->options = request->options;
    return CLI_DONE;
}

int simulation_complete(run_simulation *s, dal_run_spec *spec)
{
    run_request *request = &s->request;
    const bool has_time = request_has(request, REQUEST_time);
    if (!request->system_name) return cli_fail(CLI_USAGE, "the SYSTEM is missing");
    for (int i = 0; i < DEFAULTS; i++)
        if (request_lacks(request, default_options[i]))
            return cli_fail(CLI_USAGE, "--%s is missing", request_options[default_options[i]].name);
    if (!request_has(request, REQUEST_step)) {
        const double end = has_time ? request->time : request->listed[request->times - 1];
        request->options.step = (end - request->from) / REQUEST_CHOSEN_STEPS;
    }
    if (request->options.step == 0.0 && !request_has(request, REQUEST_step))
        return cli_fail(CLI_USAGE, "--%s: the run ends where it begins, at t = %.15g",
                        has_time ? "time" : "times", request->from);
    if (request->options.step == 0.0) return cli_fail(CLI_USAGE, "--step: it must not be 0");
    const int status = row_times_fill(s);
    return status == CLI_DONE ? simulation_make_spec(s, spec) : status;
}

/* The columns of --sensitivities. */
static int create_sensitivity(run_simulation *s, const dal_run_spec *spec)
{
    char *text = cli_strdup(s->request.sensitivities);
    const char **names;
    dal_error error = {0};
    const int count = text_split(text, &names);
    int status = count > 0 ? CLI_DONE : cli_fail(CLI_USAGE, "--sensitivities: the list is empty");
    if (status == CLI_DONE) {
        const dal_status made =
            dal_sensitivity_create(&s->sensitivity, s->model, spec, names, count, &error);
        if (made != DAL_STATUS_OK)
            status = cli_fail(cli_input_exit(made), "--sensitivities: %s", error.message);
    }
    free(names);
    free(text);
    return status;
}

int simulation_create(run_simulation *s)
{
    dal_run_spec spec;
    dal_error error = {0};
    run_columns columns;
    const int status = simulation_complete(s, &spec);
    if (status != CLI_DONE) return status;
    const dal_status made = dal_run_create(&s->run, &spec, &error);
    if (made != DAL_STATUS_OK) {
        s->run = NULL;
        return cli_error(cli_input_exit(made), s->request.system_name, &error);
    }
    if (s->request.sensitivities) {
        const int created = create_sensitivity(s, &spec);
        if (created != CLI_DONE) return created;
    }
    /* --columns is checked before any file is made. */
    const int selected = columns_make(&columns, s);
    columns_free(&columns);
    return selected;
}
