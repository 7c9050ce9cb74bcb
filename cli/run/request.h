/* request.h - what a run is made from, as the command line or a manifest.json gives it. */
#ifndef DAL_CLI_REQUEST_H
#define DAL_CLI_REQUEST_H

#include "ui/cli.h"

/* The options that the library has not; those of the library come behind.
 * name, value, default, help */
#define REQUEST_OPTION_LIST(X)                                                                     \
    X(integrator, "NAME", NULL, "rk4, gauss8+project, ...: see 'dalembert list integrators'")      \
    X(time, "T", NULL, "integrate from t = 0 to t = T")                                            \
    X(samples, "N", "100", "rows behind the first, at equal distances in t")                       \
    X(sampling, "linear|log|steps", "linear",                                                      \
      "rows at equal distances in t; in log t, on whole steps; in t, on whole steps")              \
    X(times, "LIST|FILE", NULL, "rows at these times alone; T is the last of them when not given") \
    X(statistics, "K", "1", "observe after every K-th step, for the summary")                      \
    X(set, "PARAMETER=V", NULL, "give a parameter another value; may be repeated")                 \
    X(start, "NAME=V", NULL, "start x, x', e, p_x, pi_x, ... at V; may be repeated; e=inf")

enum {
#define X(name, value, initial, help) REQUEST_##name,
    REQUEST_OPTION_LIST(X)
#undef X
#define X(type, name, word, initial, least, greatest, value, help) REQUEST_##name,
        DAL_OPTION_LIST(X)
#undef X
            REQUEST_OPTIONS
};

typedef struct request_settings {
    dal_setting *item; /* with names of their own */
    int count;
} request_settings;

/* code, word */
#define REQUEST_SAMPLING_LIST(X) X(LINEAR, linear) X(LOG, log) X(STEPS, steps)

typedef enum request_sampling {
#define X(code, word) REQUEST_SAMPLING_##code,
    REQUEST_SAMPLING_LIST(X)
#undef X
} request_sampling;

typedef struct run_request {
    const char *system_name; /* a built-in name or a path; the caller's, as all texts here */
    const char *text[REQUEST_OPTIONS]; /* as given, the last one; NULL: not given */
    double time;
    long long samples, statistics;
    request_sampling sampling;
    double *row_time; /* [samples + 1]; NULL: at equal distances */
    long long times;  /* number of times that were given */
    char *list;       /* those as a text */
    dal_options options;
    request_settings set, start;
    dal_method method;
    dal_model *model;
    const dal_system *system; /* may be set beforehand; nothing is loaded then */
    dal_run *run;
} run_request;

/* An empty request; release it with request_free. */
run_request request_default(void);
void request_free(run_request *request);
/* Fills options[REQUEST_OPTIONS] with what --help prints of them. */
void request_list_options(cli_option *options);
/* Whether an option has a number as its value. */
int request_option_is_number(int option);
/* The number of an option by its name, -1 for none. */
int request_find_option(const char *name);
/* Adds a setting to those of a parameter or a start, or replaces that of the same name. */
void request_add_setting(request_settings *settings, const char *name, double value);

/* All below return CLI_DONE, or print and return an exit status. */

/* Parses the value of one option; request points to the text. */
int request_parse_option(run_request *request, int option, const char *text);
/* Loads the system, chooses the space and makes the spec of the run. */
int request_make_spec(run_request *request, dal_run_spec *spec);
/* After the last option: checks that none is missing and makes the spec; and the run as well. */
int request_complete(run_request *request, dal_run_spec *spec);
int request_create_run(run_request *request);

#endif
