/* request.c - what a run is made from: its options, parsed and checked. */
#include "request.h"
#include "columns.h"
#include "system.h"
#include "ui/memory.h"
#include "ui/message.h"

#include "row_times.h"
#include "ui/options.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static const double max_count = 1e9, max_steps = 0x1p53;

/* ---- the options --------------------------------------------------------------------------- */

static int parse_method(void *user, const cli_option *option, const char *text)
{
    run_request *request = user;
    dal_error error = {0};
    (void)option;
    if (dal_method_parse(&request->method, text, &error) == DAL_STATUS_OK) return CLI_DONE;
    return cli_error(CLI_USAGE, NULL, &error);
}

static int parse_time(void *user, const cli_option *option, const char *text)
{
    run_request *request = user;
    (void)option;
    return cli_number("--time", text, &request->time);
}

static int parse_run_option(void *user, const cli_option *option, const char *text)
{
    run_request *request = user;
    dal_error error = {0};
    const char *present = cli_renamed_value(option->name, text);
    if (present)
        return cli_fail(CLI_USAGE, "--%s: '%s' is called '%s' now", option->name, text, present);
    if (dal_options_set(&request->options, option->name, text, &error) == DAL_STATUS_OK)
        return CLI_DONE;
    /* "option step: ..." of the library is "--step: ..." of the program. */
    static const char begin[] = "option ";
    if (strncmp(error.message, begin, sizeof begin - 1) != 0)
        return cli_error(CLI_USAGE, NULL, &error);
    return cli_fail(CLI_USAGE, "--%s", error.message + sizeof begin - 1);
}

static int parse_setting(void *user, const cli_option *option, const char *text)
{
    const char *equals = strchr(text, '=');
    if (!equals || equals == text)
        return cli_fail(CLI_USAGE, "--%s: '%s' is not NAME=VALUE", option->name, text);
    request_settings *settings = (void *)((char *)user + option->offset);
    char *name = cli_strndup(text, (size_t)(equals - text));
    int before = 0;
    while (before < settings->count && strcmp(settings->item[before].name, name) != 0) before++;
    const int status = before < settings->count
                           ? cli_fail(CLI_USAGE, "--%s: %s is given twice", option->name, name)
                           : request_parse_setting(settings, text, name, equals + 1);
    free(name);
    return status;
}

#define FIELD(name) offsetof(run_request, name)
/* The default of each type; of a choice, its words. */
#define DEFAULT_double(initial, value)        #initial
#define DEFAULT_int(initial, value)           #initial
#define DEFAULT_bool(initial, value)          value
#define DEFAULT_dal_space(initial, value)     value
#define DEFAULT_dal_solver(initial, value)    value
#define DEFAULT_dal_sums(initial, value)      value
#define DEFAULT_dal_precision(initial, value) value

const cli_option request_options[REQUEST_OPTIONS] = {
    {"integrator", "NAME", NULL,
     "the method: rk4, gauss8+project, ...; see 'dalembert list integrators'",
     .parse = parse_method, .heading = "method and time"},
    {"time", "T", NULL, "integrates from t = T0 to t = T", .parse = parse_time},
    {"from", "T0", "0", "the time of the start", .parse = cli_parse_number, .offset = FIELD(from),
     .min = -DBL_MAX, .max = DBL_MAX},
    {"steps", "N", NULL, "ends after N steps, at T = T0 + N h; excludes --time",
     .parse = cli_parse_integer, .offset = FIELD(steps), .min = 1, .max = max_steps},
    {"samples", "N", "100", "rows after the first, at equal distances in t",
     .parse = cli_parse_integer, .offset = FIELD(samples), .min = 1, .max = max_count,
     .heading = "rows and observables"},
    {"sampling", "linear|log|steps", "linear",
     "rows at equal distances in t, in log t, or in t; the last two after whole steps",
     .parse = cli_parse_word, .offset = FIELD(sampling)},
    {"times", "LIST|FILE", NULL, "rows at these times only; T is the last of them by default",
     .parse = row_times_parse},
    {"statistics", "K", "1", "the summary observes every K-th step", .parse = cli_parse_integer,
     .offset = FIELD(statistics), .min = 1, .max = max_count},
    {"columns", "LIST", NULL,
     "columns beside t: names, q, v, lift, D, E, invariants, observed, h, R, lambda, patterns: "
     "x,x',D,p_*",
     .parse = cli_parse_text, .offset = FIELD(columns)},
    {"names", "system|plain", "system", "names of columns; plain: vx for x', for pandas and Julia",
     .parse = cli_parse_word, .offset = FIELD(names)},
    {"observe", "FORMULAS", NULL,
     "observes formulas as invariants, with semicolons between them: \"abs(h1) - 0.3*m; x^2\"",
     .parse = cli_parse_text, .offset = FIELD(observe)},
    {"set", "PARAMETER=V", NULL, "sets a parameter; may be repeated", .parse = parse_setting,
     .offset = FIELD(set), .heading = "parameters and start"},
    {"start", "NAME=V", NULL,
     "sets a start value: x, x', e (or e=inf), p_x, pi_x, ...; may be repeated",
     .parse = parse_setting, .offset = FIELD(start)},
#define ROW(type, name, word, initial, least, greatest, value, help)                               \
    {word,                                                                                         \
     value,                                                                                        \
     REQUEST_##name - REQUEST_step ? DEFAULT_##type(initial, value) : NULL,                        \
     help,                                                                                         \
     .parse = parse_run_option,                                                                    \
     .heading = REQUEST_##name == REQUEST_step ? "steps and implicit equations" : NULL},
    DAL_OPTION_LIST(ROW)
#undef ROW
        {NULL, "SYSTEM", CLI_REQUIRED,
         "a built-in system ('dalembert list systems') or the path of a file",
         .parse = cli_parse_text, .offset = FIELD(system_name)}};

/* The options that a system file may give. */
static const int default_options[] = {REQUEST_integrator, REQUEST_step, REQUEST_time};

/* Whether the run ends at a time that follows from other options. */
static bool gives_end(const run_request *request)
{
    return request_has(request, REQUEST_times) || request_has(request, REQUEST_steps);
}

static bool needs_no_step(const run_request *request)
{
    if (request->step_rule != REQUEST_STEP_CHOSEN) return request->step_rule == REQUEST_STEP_UNUSED;
    return request->options.tolerance > 0.0 && !request_has(request, REQUEST_steps) &&
           request->sampling == REQUEST_SAMPLING_LINEAR;
}

int request_check_forward(const run_request *request)
{
    if (request_has(request, REQUEST_step) && !(request->options.step > 0.0))
        return cli_fail(CLI_USAGE, "--step: %g is not positive", request->options.step);
    if (request_has(request, REQUEST_time) && !(request->time > request->from))
        return request->from == 0.0
                   ? cli_fail(CLI_USAGE, "--time: %g is not positive", request->time)
                   : cli_fail(CLI_USAGE, "--time: %g does not come after --from %g", request->time,
                              request->from);
    return CLI_DONE;
}

/* The system, with the formulas of --observe. */
static int load_system(run_request *request)
{
    const char *list = request->observe;
    cli_formula *formula = NULL;
    int count = 0;
    if (!list) return cli_load(request->system_name, &request->model, &request->system);
    for (const char *at = list, *end; at; at = *end ? end + 1 : NULL) {
        const size_t length = request_find_formula(&at, &end);
        formula = cli_realloc(formula, ((size_t)count + 1) * sizeof *formula);
        formula[count++] = (cli_formula){cli_strndup(at, length), 1, (int)(at - list) + 1};
    }
    const int status = cli_observe(request->system_name, "--observe", formula, count,
                                   &request->model, &request->system);
    for (int i = 0; i < count; i++) free((char *)formula[i].text);
    free(formula);
    return status;
}

/* Takes those that the command needs and does not have; a line says which. */
static int take_defaults(const cli_group *group, int status)
{
    run_request *request = group->settings;
    char taken[512] = "";
    if (!request->system_name) return CLI_DONE;
    int found = load_system(request);
    if (found != CLI_DONE) return found;
    for (size_t i = 0; i < sizeof default_options / sizeof *default_options; i++) {
        const int k = default_options[i];
        const cli_option *option = &group->options[k];
        const char *text = cli_default(request->model, option->name, NULL, NULL);
        const size_t length = strlen(taken);
        if (group->without >> k & 1 || request_has(request, k)) continue;
        if (k == REQUEST_time && gives_end(request)) continue;
        if (k == REQUEST_step && needs_no_step(request)) continue;
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
    /* A command that does not take --from goes from t = 0 forwards. */
    const bool is_forward = group->without & REQUEST_OPTION(from);
    const int forward = is_forward ? request_check_forward(request) : CLI_DONE;
    return found == CLI_DONE ? forward : found;
}

cli_group request_group(run_request *request, const cli_option *options, uint64_t without)
{
    return (cli_group){options, REQUEST_OPTIONS, request,      request->text,
                       without, "run",           take_defaults};
}

int request_parse_option(run_request *request, int option, const char *text)
{
    request->text[option] = text;
    return request_options[option].parse(request, &request_options[option], text);
}

int request_give(run_request *request, int option, char *text)
{
    free(request->made[option]);
    request->made[option] = text;
    return request_parse_option(request, option, text);
}

bool request_option_is_number(int option)
{
    const cli_option *o = &request_options[option];
    return o->parse == parse_time || o->parse == cli_parse_integer ||
           o->parse == cli_parse_number || (o->parse == parse_run_option && !strchr(o->value, '|'));
}

int request_find_option(const char *name)
{
    for (int i = 0; i < REQUEST_system; i++)
        if (strcmp(request_options[i].name, name) == 0) return i;
    return -1;
}

/* ---- the request --------------------------------------------------------------------------- */

run_request request_default(void)
{
    run_request request = {.options = dal_options_default()};
    cli_set_defaults(request_options, REQUEST_OPTIONS, &request);
    return request;
}

void request_free(run_request *request)
{
    dal_run_free(request->run);
    dal_model_free(request->model);
    request_free_settings(&request->set);
    request_free_settings(&request->start);
    free(request->row_time);
    for (int i = 0; i < REQUEST_OPTIONS; i++) free(request->made[i]);
    *request = (run_request){0};
}

int request_parse_setting(request_settings *settings, const char *what, const char *name,
                          const char *text)
{
    static const char *const infinities[] = {"inf", "+inf", "infinity"};
    double value = 0.0;
    for (size_t i = 0; strcmp(name, "e") == 0 && i < sizeof infinities / sizeof *infinities; i++)
        if (strcmp(text, infinities[i]) == 0) value = INFINITY;
    const int status = isinf(value) ? CLI_DONE : cli_number(what, text, &value);
    if (status == CLI_DONE) request_add_setting(settings, name, value);
    return status;
}

int request_make_spec(run_request *request, dal_run_spec *spec)
{
    const int status = request->system ? CLI_DONE : load_system(request);
    if (status != CLI_DONE) return status;
    const double min = dal_min_tolerance(&request->options);
    if (request->options.tolerance > 0.0 && request->options.tolerance < min)
        return cli_fail(CLI_USAGE, "--tolerance: %g is below %.2g, the smallest in this precision",
                        request->options.tolerance, min);
    /* Where the system or the method has no lift there is one space alone; only an explicit
     * --space=lifted is an error. */
    const int has_lift =
        request->system->call.adjoint && !(dal_method_needs(&request->method) & DAL_NEEDS_BLOCKS);
    if (!request_has(request, REQUEST_space) && !has_lift) request->options.space = DAL_PHYSICAL;
    if (columns_need_reactions(request->system, request->columns)) request->options.reactions = 1;
    *spec = (dal_run_spec){.system = request->system,
                           .method = request->method,
                           .options = request->options,
                           .parameters = request->set.item,
                           .parameter_count = request->set.count,
                           .start = request->start.item,
                           .start_count = request->start.count,
                           .start_time = request->from};
    return CLI_DONE;
}

int request_complete(run_request *request, dal_run_spec *spec)
{
    if (!request->system_name) return cli_fail(CLI_USAGE, "the SYSTEM is missing");
    if (!request_has(request, REQUEST_integrator))
        return cli_fail(CLI_USAGE, "--integrator is missing");
    const bool has_step = request_has(request, REQUEST_step);
    const bool has_time = request_has(request, REQUEST_time);
    if (!has_step && !needs_no_step(request)) return cli_fail(CLI_USAGE, "--step is missing");
    if (!has_time && !gives_end(request)) return cli_fail(CLI_USAGE, "--time is missing");
    if (!has_step) {
        const double end = has_time ? request->time : request->row_time[request->times - 1];
        request->options.step = (end - request->from) / REQUEST_CHOSEN_STEPS;
    }
    if (request->options.step == 0.0 && !has_step)
        return cli_fail(CLI_USAGE, "--%s: the run ends where it begins, at t = %.15g",
                        has_time ? "time" : "times", request->from);
    if (request->options.step == 0.0) return cli_fail(CLI_USAGE, "--step: it must not be 0");
    const int status = row_times_fill(request);
    return status == CLI_DONE ? request_make_spec(request, spec) : status;
}

int request_create_run(run_request *request)
{
    dal_run_spec spec;
    dal_error error = {0};
    run_columns columns;
    const int status = request_complete(request, &spec);
    if (status != CLI_DONE) return status;
    const dal_status made = dal_run_create(&request->run, &spec, &error);
    if (made != DAL_STATUS_OK) {
        request->run = NULL;
        return cli_error(cli_input_exit(made), request->system_name, &error);
    }
    /* --columns is checked before any file is made. */
    const int selected = columns_make(&columns, request);
    columns_free(&columns);
    return selected;
}
