/* request.c - what a run is made from: its options, parsed and checked. */
#include "request.h"

#include "row_times.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_COUNT = 1000000000 };

/* What --help says of the default of each type; of a choice, its words. */
#define DEFAULT_double(initial, value)     #initial
#define DEFAULT_int(initial, value)        #initial
#define DEFAULT_dal_choice(initial, value) value

/* One table of both kinds of option. */
static const struct {
    const char *name, *value, *initial, *help;
} table[REQUEST_OPTIONS] = {
#define X(name, value, initial, help) {#name, value, initial, help},
    REQUEST_OPTION_LIST(X)
#undef X
#define X(type, name, word, initial, least, greatest, value, help)                                 \
    {word, value, DEFAULT_##type(initial, value), help},
        DAL_OPTION_LIST(X)
#undef X
};

static int is_required(int option)
{
    return option == REQUEST_integrator || option == REQUEST_step || option == REQUEST_time;
}

void request_list_options(cli_option *options)
{
    for (int i = 0; i < REQUEST_OPTIONS; i++)
        options[i] = (cli_option){table[i].name, table[i].value, table[i].help,
                                  is_required(i) ? NULL : table[i].initial};
}

int request_option_is_number(int option)
{
    switch (option) {
    case REQUEST_integrator:
    case REQUEST_sampling:
    case REQUEST_times:
    case REQUEST_set:
    case REQUEST_start:
        return 0;
    default:
        return !strchr(table[option].value, '|');
    }
}

int request_find_option(const char *name)
{
    for (int i = 0; i < REQUEST_OPTIONS; i++)
        if (strcmp(table[i].name, name) == 0) return i;
    return -1;
}

run_request request_default(void) { return (run_request){.options = dal_options_default()}; }

static void free_settings(request_settings *settings)
{
    for (int i = 0; i < settings->count; i++) free((char *)settings->item[i].name);
    free(settings->item);
}

void request_free(run_request *request)
{
    dal_run_free(request->run);
    dal_model_free(request->model);
    free_settings(&request->set);
    free_settings(&request->start);
    free(request->row_time);
    free(request->list);
    *request = request_default();
}

void request_add_setting(request_settings *settings, const char *name, double value)
{
    for (int i = 0; i < settings->count; i++)
        if (strcmp(settings->item[i].name, name) == 0) {
            settings->item[i].value = value;
            return;
        }
    size_t count = (size_t)settings->count + 1;
    settings->item = cli_realloc(settings->item, count * sizeof *settings->item);
    settings->item[settings->count++] = (dal_setting){cli_strdup(name), value};
}

static int parse_setting(request_settings *settings, const char *what, const char *text)
{
    dal_setting given;
    const int status = cli_setting(what, text, &given);
    if (status != CLI_DONE) return status;
    request_add_setting(settings, given.name, given.value);
    free((char *)given.name);
    return CLI_DONE;
}

int request_parse_option(run_request *request, int option, const char *text)
{
    dal_error error = {0};
    request->text[option] = text;
    switch (option) {
    case REQUEST_integrator:
        if (dal_method_parse(&request->method, text, &error) == DAL_OK) return CLI_DONE;
        return cli_error(CLI_USAGE, NULL, &error);
    case REQUEST_time:
        if (cli_number("--time", text, &request->time) != CLI_DONE) return CLI_USAGE;
        if (request->time > 0.0) return CLI_DONE;
        return cli_fail(CLI_USAGE, "--time: %s is not positive", text);
    case REQUEST_samples:
        return cli_integer("--samples", text, 1, MAX_COUNT, &request->samples);
    case REQUEST_sampling:
        return row_times_parse_sampling(request, text);
    case REQUEST_times:
        return row_times_parse(request, text);
    case REQUEST_statistics:
        return cli_integer("--statistics", text, 1, MAX_COUNT, &request->statistics);
    case REQUEST_set:
        return parse_setting(&request->set, "--set", text);
    case REQUEST_start:
        return parse_setting(&request->start, "--start", text);
    default:
        if (dal_options_set(&request->options, table[option].name, text, &error) == DAL_OK)
            return CLI_DONE;
        return cli_error(CLI_USAGE, NULL, &error);
    }
}

static void set_default(run_request *request, int option)
{
    if (request->text[option]) return;
    request_parse_option(request, option, table[option].initial);
    request->text[option] = NULL;
}

int request_make_spec(run_request *request, dal_run_spec *spec)
{
    int status = request->system
                     ? CLI_DONE
                     : cli_load(request->system_name, &request->model, &request->system);
    if (status != CLI_DONE) return status;
    /* Where the system or the method has no lift there is one space alone; only an explicit
     * --space=lifted is an error. */
    const int has_lift =
        request->system->call.adjoint && !(dal_method_needs(&request->method) & DAL_NEEDS_BLOCKS);
    if (!request->text[REQUEST_space] && !has_lift) request->options.space = DAL_PHYSICAL;
    *spec = (dal_run_spec){.system = request->system,
                           .method = request->method,
                           .options = request->options,
                           .parameters = request->set.item,
                           .parameter_count = request->set.count,
                           .start = request->start.item,
                           .start_count = request->start.count};
    return CLI_DONE;
}

int request_complete(run_request *request, dal_run_spec *spec)
{
    if (!request->system_name) return cli_fail(CLI_USAGE, "the SYSTEM is missing");
    for (int i = 0; i < REQUEST_OPTIONS; i++)
        if (is_required(i) && !request->text[i] && !(i == REQUEST_time && request->times > 0))
            return cli_fail(CLI_USAGE, "--%s is missing", table[i].name);
    if (!(request->options.step > 0.0))
        return cli_fail(CLI_USAGE, "--step: %s is not positive", request->text[REQUEST_step]);
    set_default(request, REQUEST_samples);
    set_default(request, REQUEST_statistics);
    const int status = row_times_fill(request);
    return status == CLI_DONE ? request_make_spec(request, spec) : status;
}

int request_create_run(run_request *request)
{
    dal_run_spec spec;
    dal_error error = {0};
    const int status = request_complete(request, &spec);
    if (status != CLI_DONE) return status;
    const dal_status made = dal_run_create(&request->run, &spec, &error);
    if (made == DAL_OK) return CLI_DONE;
    request->run = NULL;
    return cli_error(cli_input_exit(made), request->system_name, &error);
}
