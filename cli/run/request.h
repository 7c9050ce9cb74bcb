/* request.h - what a run is made from, as the command line or a manifest.json gives it. */
#ifndef DAL_CLI_REQUEST_H
#define DAL_CLI_REQUEST_H

#include "dalembert.h"
#include "ui/options.h"

#include <stdbool.h>

/* What the run itself does not know; the library's options come behind, then the SYSTEM. */
#define REQUEST_OPTION_LIST(OPTION)                                                                \
    OPTION(integrator)                                                                             \
    OPTION(time)                                                                                   \
    OPTION(from)                                                                                   \
    OPTION(steps)                                                                                  \
    OPTION(samples)                                                                                \
    OPTION(sampling)                                                                               \
    OPTION(times)                                                                                  \
    OPTION(statistics)                                                                             \
    OPTION(columns)                                                                                \
    OPTION(names)                                                                                  \
    OPTION(observe)                                                                                \
    OPTION(set)                                                                                    \
    OPTION(start)

enum {
#define NUMBER(name) REQUEST_##name,
    REQUEST_OPTION_LIST(NUMBER)
#undef NUMBER
#define NUMBER(type, name, word, initial, least, greatest, value, help) REQUEST_##name,
        DAL_OPTION_LIST(NUMBER)
#undef NUMBER
            REQUEST_system,
    REQUEST_OPTIONS
};
enum { REQUEST_DEFAULTS = 3 }; /* the options that a system file may give */

typedef struct request_settings {
    dal_setting *item; /* with names of their own */
    int count;
} request_settings;

/* The words of --sampling. */
typedef enum request_sampling {
    REQUEST_SAMPLING_LINEAR,
    REQUEST_SAMPLING_LOG,
    REQUEST_SAMPLING_STEPS
} request_sampling;

/* The words of --names. */
typedef enum request_names { REQUEST_NAMES_SYSTEM, REQUEST_NAMES_PLAIN } request_names;

typedef struct run_request {
    const char *system_name; /* a built-in name or a path; the caller's, as all texts here */
    const char *columns;     /* --columns; NULL: all */
    const char *observe;     /* --observe, formulas between semicolons; NULL: none */
    const char *text[REQUEST_OPTIONS]; /* as given, the last one; NULL: not given as a text */
    uint64_t typed;    /* set of options whose values below were given without a text */
    bool chooses_step; /* under a tolerance the step may be left out; set beforehand */
    double from, time;
    long long steps, samples, statistics; /* steps: 0: not given */
    request_sampling sampling;
    request_names names;
    double given_time; /* these two before they are made those of whole steps */
    long long given_samples;
    double *row_time;              /* [samples + 1]; NULL: at equal distances */
    long long times;               /* number of times that were given */
    char *list;                    /* those as a text */
    char *taken[REQUEST_DEFAULTS]; /* texts that came from the system file */
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
/* A set of options; those that concern rows only; those without which time begins at 0, is given
 * as such and increases. */
#define REQUEST_OPTION(name) (UINT64_C(1) << REQUEST_##name)
#define REQUEST_ROW_OPTIONS                                                                        \
    (REQUEST_OPTION(samples) | REQUEST_OPTION(sampling) | REQUEST_OPTION(times) |                  \
     REQUEST_OPTION(statistics) | REQUEST_OPTION(columns) | REQUEST_OPTION(names) |                \
     REQUEST_OPTION(observe) | REQUEST_OPTION(reactions))
/* All options; and as a group for a command, which may change their defaults and help in options,
 * and does not take some.  A command that has read its arguments has loaded the system. */
extern const cli_option request_options[REQUEST_OPTIONS];
cli_group request_group(run_request *request, const cli_option *options, uint64_t without);
/* Whether the step is positive and the end after the start, where they were given.  Returns
 * CLI_DONE, or prints and returns CLI_USAGE. */
int request_check_forward(const run_request *request);
/* Whether an option was given; and whether it has a number as its value. */
bool request_has(const run_request *request, int option);
bool request_option_is_number(int option);
/* Whether a column is a formula of --observe. */
bool request_observes(const run_request *request, const char *name);
/* The number of an option by its name, -1 for none. */
int request_find_option(const char *name);
/* Adds a setting to those of a parameter or a start, or replaces that of the same name. */
void request_add_setting(request_settings *settings, const char *name, double value);
void request_free_settings(request_settings *settings);

/* All below return CLI_DONE, or print and return an exit status. */

/* Parses the value of one option; request points to the text. */
int request_parse_option(run_request *request, int option, const char *text);
/* Parses the value of a setting, e = inf being the one infinite value, and adds it; what names it
 * in a message. */
int request_parse_setting(request_settings *settings, const char *what, const char *name,
                          const char *text);
/* Loads the system, chooses the space and makes the spec of the run. */
int request_make_spec(run_request *request, dal_run_spec *spec);
/* Under a tolerance a step that is missing becomes a hundredth of the time. */
enum { REQUEST_CHOSEN_STEPS = 100 };
void request_choose_step(run_request *request);
/* After the last option: checks that none is missing and makes the spec; and the run as well. */
int request_complete(run_request *request, dal_run_spec *spec);
int request_create_run(run_request *request);

#endif
