/* request.c - what a run is made from: its options, parsed and checked. */
#include "request.h"
#include "ui/memory.h"
#include "ui/message.h"

#include "row_times.h"
#include "system.h"
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

int request_parse_named(request_settings *settings, const cli_option *option, const char *text)
{
    const char *equals = strchr(text, '=');
    if (!equals || equals == text)
        return cli_fail(CLI_USAGE, "--%s: '%s' is not NAME=VALUE", option->name, text);
    char *name = cli_strndup(text, (size_t)(equals - text));
    int before = 0;
    while (before < settings->count && strcmp(settings->item[before].name, name) != 0) before++;
    const int status = before < settings->count
                           ? cli_fail(CLI_USAGE, "--%s: %s is given twice", option->name, name)
                           : request_parse_setting(settings, text, name, equals + 1);
    free(name);
    return status;
}

static int parse_setting(void *user, const cli_option *option, const char *text)
{
    return request_parse_named((void *)((char *)user + option->offset), option, text);
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
     "columns beside t: names, q, v, lift, D, E, invariants, observed, h, R, lambda, "
     "sensitivities, "
     "patterns: x,x',D,p_*",
     .parse = cli_parse_text, .offset = FIELD(columns)},
    {"sensitivities", "LIST", NULL,
     "adds columns of derivatives of q and v by these parameters and start values: k,m,x'",
     .parse = cli_parse_text, .offset = FIELD(sensitivities)},
    {"names", "system|plain", "system", "names of columns; plain: vx for x', for pandas and Julia",
     .parse = cli_parse_word, .offset = FIELD(names)},
    {"observe", "FORMULAS", NULL,
     "observes formulas as invariants, with semicolons between them: \"abs(h1) - 0.3*m; x^2\"",
     .parse = cli_parse_text, .offset = FIELD(observe)},
    {"mechanics", "system|lagrange-dalembert|vakonomic", "system",
     "the mechanics of L and D; system: the one that the system file names",
     .parse = cli_parse_word, .offset = FIELD(choices.mechanics), .heading = "mechanics and lift"},
    {"effort", "identity|mass|constraint|controls", "identity",
     "K of the lift, H = pi.K pi/(2e) + pi.F + p.v + mu_e pi_e; controls: of the system file",
     .parse = cli_parse_word, .offset = FIELD(choices.effort)},
    {"gauge", "TEXT", NULL,
     "e and mu_e of the lift in place of the system's: \"e = 1, mu_e = 0.1*cos(t)\"",
     .parse = cli_parse_text, .offset = FIELD(choices.gauge)},
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

/* Under a tolerance, where neither rows nor the end count steps, a step may be chosen. */
static bool needs_step(const run_request *request)
{
    if (request->step_rule != REQUEST_STEP_CHOSEN) return request->step_rule == REQUEST_STEP_NEEDED;
    return !(request->options.tolerance > 0.0) || request_has(request, REQUEST_steps) ||
           request->sampling != REQUEST_SAMPLING_LINEAR;
}

bool request_lacks(const run_request *request, int option)
{
    if (request_has(request, option)) return false;
    if (option == REQUEST_step) return needs_step(request);
    return option != REQUEST_time ||
           !(request_has(request, REQUEST_times) || request_has(request, REQUEST_steps));
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
    request_free_settings(&request->set);
    request_free_settings(&request->start);
    free(request->listed);
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
    const int status = isinf(value) ? CLI_DONE : cli_constant(what, text, &value);
    if (status == CLI_DONE) request_add_setting(settings, name, value);
    return status;
}
