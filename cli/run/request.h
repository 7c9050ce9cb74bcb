/* request.h - all that makes a run, as the command line or a manifest.json tells it. */
#ifndef DAL_CLI_REQUEST_H
#define DAL_CLI_REQUEST_H

#include "ui/cli.h"

/* What the run itself does not know; the library's options come behind.
 * name, value, default, help */
#define REQUEST_OPTION_LIST(X)                                                                     \
    X(integrator, "NAME", NULL, "rk4, gauss8+project, ...: see 'dalembert list integrators'")      \
    X(time, "T", NULL, "integrate from t = 0 to t = T")                                            \
    X(samples, "N", "100", "rows behind the first, at equal distances in t")                       \
    X(sampling, "linear|log|steps", "linear",                                                      \
      "rows at equal distances in t; in log t, on whole steps; in t, on whole steps")              \
    X(times, "LIST|FILE", NULL, "rows at these times alone; T is the last of them when not given") \
    X(statistics, "K", "1", "look at the observables after every K-th step, for the summary")      \
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
    long long times;  /* given ones in it */
    char *list;       /* those as a text */
    dal_options options;
    request_settings set, start;
    dal_method method;
    dal_model *model;
    const dal_system *system; /* may be set beforehand; nothing is loaded then */
    dal_run *run;
} run_request;

/* A request of which nothing is known; request_free it. */
run_request request_default(void);
void request_free(run_request *request);
/* Fills options[REQUEST_OPTIONS] with what --help says of them. */
void request_list_options(cli_option *options);
/* Whether an option takes one number. */
int request_option_is_number(int option);
/* The number of an option by its name, -1 for none. */
int request_find_option(const char *name);
/* Parses one option.  Returns CLI_DONE or prints and returns an exit status, as all below. */
int request_parse_option(run_request *request, int option, const char *text);
/* Parses a list of times, or the file that holds one; and a word of the list above.  Decides when
 * rows are taken, and checks that the time holds a step.  Times that are not equally distant are
 * kept in memory. */
enum { ROW_TIMES_MAX = 100000000 };
int request_parse_times(run_request *request, const char *given);
int request_parse_sampling(run_request *request, const char *word);
int request_set_row_times(run_request *request);
/* Why a time cannot be divided into such steps: there is none in it, or more than a double counts;
 * NULL where it can.  The second prints that of --step. */
enum { REQUEST_STEP_TEXT = 128 };
const char *request_step_error(double step, double time, char text[REQUEST_STEP_TEXT]);
int request_check_step(const run_request *request, double time);
/* Loads the system, chooses the space and makes the spec of the run. */
int request_make_spec(run_request *request, dal_run_spec *spec);
/* After the last option: checks that none is missing and makes the spec; the other also the run. */
int request_complete(run_request *request, dal_run_spec *spec);
int request_create_run(run_request *request);

#endif
