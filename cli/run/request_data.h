/* request_data.h - what a run is made from, as a command line or a manifest.json gives it, and the
 * simulation that is made from it. */
#ifndef DAL_CLI_REQUEST_DATA_H
#define DAL_CLI_REQUEST_DATA_H

#include "dalembert_model.h"
#include "dalembert_program.h"
#include "dalembert_run.h"
#include "dalembert_sensitivity.h"
#include "system.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What the run itself does not know; the library's options come next, then the SYSTEM. */
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
    OPTION(sensitivities)                                                                          \
    OPTION(names)                                                                                  \
    OPTION(observe)                                                                                \
    OPTION(mechanics)                                                                              \
    OPTION(effort)                                                                                 \
    OPTION(gauge)                                                                                  \
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

/* Whether a command needs --step: always, not under a tolerance where neither rows nor the end
 * count steps, or never. */
typedef enum request_step {
    REQUEST_STEP_NEEDED,
    REQUEST_STEP_CHOSEN,
    REQUEST_STEP_UNUSED
} request_step;
enum { REQUEST_CHOSEN_STEPS = 100 }; /* a chosen step is this fraction of the time */

typedef struct run_request {
    const char *system_name;   /* a built-in name or a path; the caller's, as all texts here */
    const char *columns;       /* --columns; NULL: all */
    const char *sensitivities; /* --sensitivities, names between commas; NULL: none */
    const char *observe;       /* --observe, formulas between semicolons; NULL: none */
    cli_choices choices;       /* --mechanics, --effort, --gauge */
    const char *text[REQUEST_OPTIONS]; /* as given, the last one; NULL: not given */
    char *made[REQUEST_OPTIONS];       /* of these texts those that the request owns, or NULL */
    request_step step_rule;            /* set beforehand */
    double from, time;
    long long steps, samples, statistics; /* steps: 0: not given */
    request_sampling sampling;
    request_names names;
    double *listed;  /* [times] of --times */
    long long times; /* 0: no list */
    dal_options options;
    request_settings set, start;
    dal_method method;
} run_request;

typedef struct run_simulation {
    run_request request;
    dal_model *model;
    const dal_system *system; /* may be set beforehand; nothing is loaded then */
    dal_run *run;
    dal_sensitivity *sensitivity; /* beside the run; NULL: none */
    double end;                   /* where the run ends, and */
    dal__decimal length;          /* which is as far from the start, */
    long long samples;            /* its rows after the first, */
    double *row_time;             /* [samples + 1]; NULL: at equal distances */
} run_simulation;

/* A set of options; those that concern rows only; those without which time begins at 0, is given
 * as such and increases. */
#define REQUEST_OPTION(name) (UINT64_C(1) << REQUEST_##name)
#define REQUEST_ROW_OPTIONS                                                                        \
    (REQUEST_OPTION(samples) | REQUEST_OPTION(sampling) | REQUEST_OPTION(times) |                  \
     REQUEST_OPTION(statistics) | REQUEST_OPTION(columns) | REQUEST_OPTION(names) |                \
     REQUEST_OPTION(observe) | REQUEST_OPTION(sensitivities) | REQUEST_OPTION(reactions))
/* Whether an option was given. */
bool request_has(const run_request *request, int option);
/* Whether a column is a formula of --observe. */
bool request_observes(const run_request *request, const char *name);
/* The length of the formula that begins a list of --observe, without the blanks around it; the next
 * one is after *end. */
size_t request_find_formula(const char **list, const char **end);
/* Adds a setting of a parameter or a start, or replaces the one with the same name. */
void request_add_setting(request_settings *settings, const char *name, double value);
void request_free_settings(request_settings *settings);

#endif
