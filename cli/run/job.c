/* job.c - from the options of a run to the run. */
#include "job.h"

#include <stdlib.h>
#include <string.h>

enum { SAMPLES_MOST = 1000000000, STATISTICS_MOST = 1000000000 };

/* One table of both kinds of option; words is NULL unless an option is one of several words. */
static const struct {
    const char *name, *value, *words, *initial, *help;
} table[JOB_OPTIONS] = {
#define X(name, value, initial, help) {#name, value, NULL, initial, help},
    JOB_OPTION_LIST(X)
#undef X
#define X(type, name, word, initial, least, greatest, words, help)                                 \
    {word, #type, words, #initial, help},
        DAL_OPTION_LIST(X)
#undef X
};

static int is_required(int option)
{
    return option == JOB_integrator || option == JOB_step || option == JOB_time;
}

/* What --help calls the value of an option. */
static const char *value_of(int option)
{
    switch (option) {
    case JOB_step:
        return "H";
    case JOB_solve_to:
        return "CHANGE";
    case JOB_tolerance:
        return "TOLERANCE";
    default:
        return strcmp(table[option].value, "int") == 0 ? "N" : table[option].value;
    }
}

void job_options(cli_option *options)
{
    for (int i = 0; i < JOB_OPTIONS; i++) {
        /* Of several words the first is the default. */
        const char *words = table[i].words;
        options[i] = (cli_option){table[i].name, words ? words : value_of(i), table[i].help,
                                  is_required(i) ? NULL
                                  : words        ? words
                                                 : table[i].initial};
    }
}

int job_is_number(int option)
{
    switch (option) {
    case JOB_integrator:
    case JOB_sampling:
    case JOB_times:
    case JOB_set:
    case JOB_start:
        return 0;
    default:
        return !table[option].words;
    }
}

int job_find(const char *name)
{
    for (int i = 0; i < JOB_OPTIONS; i++)
        if (strcmp(table[i].name, name) == 0) return i;
    return -1;
}

cli_job job_begin(void) { return (cli_job){.options = dal_options_default()}; }

static void free_settings(job_settings *settings)
{
    for (int i = 0; i < settings->count; i++) free((char *)settings->item[i].name);
    free(settings->item);
}

void job_free(cli_job *job)
{
    dal_run_free(job->run);
    dal_model_free(job->model);
    free_settings(&job->set);
    free_settings(&job->start);
    free(job->row_time);
    free(job->list);
    *job = job_begin();
}

/* The last value given to a name holds. */
static dal_setting *find_setting(job_settings *settings, const char *name)
{
    for (int i = 0; i < settings->count; i++)
        if (strcmp(settings->item[i].name, name) == 0) return &settings->item[i];
    return NULL;
}

static int add_setting(job_settings *settings, const char *what, const char *text)
{
    dal_setting given;
    int status = cli_setting(what, text, &given);
    if (status != CLI_DONE) return status;
    dal_setting *before = find_setting(settings, given.name);
    if (before) {
        before->value = given.value;
        free((char *)given.name);
        return CLI_DONE;
    }
    size_t count = (size_t)settings->count + 1;
    settings->item = cli_realloc(settings->item, count * sizeof *settings->item);
    settings->item[settings->count++] = given;
    return CLI_DONE;
}

int job_take(cli_job *job, int option, const char *text)
{
    dal_error error = {0};
    job->text[option] = text;
    switch (option) {
    case JOB_integrator:
        if (dal_method_parse(&job->method, text, &error) == DAL_OK) return CLI_DONE;
        return cli_error(CLI_USAGE, NULL, &error);
    case JOB_time:
        if (cli_number("--time", text, &job->time) != CLI_DONE) return CLI_USAGE;
        if (job->time > 0.0) return CLI_DONE;
        return cli_fail(CLI_USAGE, "--time: %s is not positive", text);
    case JOB_samples:
        return cli_integer("--samples", text, 1, SAMPLES_MOST, &job->samples);
    case JOB_sampling:
        return job_take_sampling(job, text);
    case JOB_times:
        return job_take_times(job, text);
    case JOB_statistics:
        return cli_integer("--statistics", text, 1, STATISTICS_MOST, &job->statistics);
    case JOB_set:
        return add_setting(&job->set, "--set", text);
    case JOB_start:
        return add_setting(&job->start, "--start", text);
    default:
        if (dal_options_set(&job->options, table[option].name, text, &error) == DAL_OK)
            return CLI_DONE;
        return cli_error(CLI_USAGE, NULL, &error);
    }
}

static void take_initial(cli_job *job, int option)
{
    if (job->text[option]) return;
    job_take(job, option, table[option].initial);
    job->text[option] = NULL;
}

static int check(cli_job *job)
{
    if (!job->system) return cli_fail(CLI_USAGE, "the SYSTEM is missing");
    for (int i = 0; i < JOB_OPTIONS; i++)
        if (is_required(i) && !job->text[i] && !(i == JOB_time && job->times > 0))
            return cli_fail(CLI_USAGE, "--%s is missing", table[i].name);
    if (!(job->options.step > 0.0))
        return cli_fail(CLI_USAGE, "--step: %s is not positive", job->text[JOB_step]);
    take_initial(job, JOB_samples);
    take_initial(job, JOB_statistics);
    return job_schedule(job);
}

int job_spec(cli_job *job, dal_run_spec *spec)
{
    int status = job->made ? CLI_DONE : cli_load(job->system, &job->model, &job->made);
    if (status != CLI_DONE) return status;
    /* Where the system or the method has no lift there is one space alone; only an explicit
     * --space=lifted is an error. */
    const int liftless =
        !job->made->call.adjoint || dal_method_needs(&job->method) & DAL_NEEDS_PARTS;
    if (!job->text[JOB_space] && liftless) job->options.space = DAL_PHYSICAL;
    *spec = (dal_run_spec){.system = job->made,
                           .method = job->method,
                           .options = job->options,
                           .parameters = job->set.item,
                           .parameter_count = job->set.count,
                           .start = job->start.item,
                           .start_count = job->start.count};
    return CLI_DONE;
}

int job_settle(cli_job *job, dal_run_spec *spec)
{
    const int status = check(job);
    return status == CLI_DONE ? job_spec(job, spec) : status;
}

int job_make(cli_job *job)
{
    dal_run_spec spec;
    const int status = job_settle(job, &spec);
    if (status != CLI_DONE) return status;
    dal_error error = {0};
    dal_status made = dal_run_create(&job->run, &spec, &error);
    if (made == DAL_OK) return CLI_DONE;
    job->run = NULL;
    return cli_error(cli_input_exit(made), job->system, &error);
}
