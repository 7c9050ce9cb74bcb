/* job.h - all that makes a run, as the command line or a manifest.json tells it. */
#ifndef DAL_CLI_JOB_H
#define DAL_CLI_JOB_H

#include "ui/cli.h"

/* What the run itself does not know; the library's options come behind.
 * name, value, default, help */
#define JOB_OPTION_LIST(X)                                                                         \
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
#define X(name, value, initial, help) JOB_##name,
    JOB_OPTION_LIST(X)
#undef X
#define X(type, name, word, initial, least, greatest, words, help) JOB_##name,
        DAL_OPTION_LIST(X)
#undef X
            JOB_OPTIONS
};

typedef struct job_settings {
    dal_setting *item; /* with names of their own */
    int count;
} job_settings;

/* code, word */
#define JOB_SAMPLING_LIST(X) X(LINEAR, linear) X(LOG, log) X(STEPS, steps)

typedef enum job_sampling {
#define X(code, word) JOB_SAMPLING_##code,
    JOB_SAMPLING_LIST(X)
#undef X
} job_sampling;

typedef struct cli_job {
    const char *system;            /* a built-in name or a path; the caller's, as all texts here */
    const char *text[JOB_OPTIONS]; /* as given, the last one; NULL: not given */
    double time;
    long long samples, statistics;
    job_sampling sampling;
    double *row_time; /* [samples + 1]; NULL: at equal distances */
    long long times;  /* given ones in it */
    char *list;       /* those as a text */
    dal_options options;
    job_settings set, start;
    dal_method method;
    dal_model *model;
    const dal_system *made; /* may be set beforehand; nothing is loaded then */
    dal_run *run;
} cli_job;

/* A job of which nothing is known; job_free it. */
cli_job job_begin(void);
void job_free(cli_job *job);
/* Fills options[JOB_OPTIONS] with what --help says of them. */
void job_options(cli_option *options);
/* Whether an option takes one number. */
int job_is_number(int option);
/* The number of an option by its name, -1 for none. */
int job_find(const char *name);
/* Takes one option.  Returns CLI_DONE or prints and returns an exit status, as job_make. */
int job_take(cli_job *job, int option, const char *text);
/* Takes a list of times or the file that holds one, or a word above; settles when rows are taken,
 * and that the time holds a step.  Return as job_take.  Other than equally distant rows must fit
 * into memory. */
enum { SCHEDULE_MOST = 100000000 };
int job_take_times(cli_job *job, const char *given);
int job_take_sampling(cli_job *job, const char *word);
int job_schedule(cli_job *job);
/* What is wrong with a step where there is not one in a time, or more than a double counts; NULL:
 * nothing.  The same said of --step. */
enum { SCHEDULE_TEXT = 128 };
const char *schedule_fault(double step, double time, char text[SCHEDULE_TEXT]);
int job_check_step(const cli_job *job, double time);
/* Loads the system and makes the spec of its run; the space is settled here. */
int job_spec(cli_job *job, dal_run_spec *spec);
/* When all has been taken: sees that nothing is missing and makes the spec; and the run as well. */
int job_settle(cli_job *job, dal_run_spec *spec);
int job_make(cli_job *job);

#endif
