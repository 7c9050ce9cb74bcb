/* analysis.c - arguments and outputs of the commands that look at a motion as a whole. */
#include "analysis.h"

#include <stdlib.h>
#include <string.h>

enum { OPTIONS_MOST = 64 };

/* What concerns rows alone. */
static const int of_rows[] = {JOB_samples, JOB_sampling, JOB_times, JOB_statistics};

static int holds(const int *list, int count, int x)
{
    for (int i = 0; i < count; i++)
        if (list[i] == x) return 1;
    return 0;
}

/* Its own options, then those of a job, whose numbers are in number. */
static int list_options(const analysis_command *c, cli_option *options, int *number)
{
    cli_option all[JOB_OPTIONS];
    int count = c->own_count;
    job_options(all);
    if (c->set_defaults) c->set_defaults(all);
    memcpy(options, c->own, (size_t)c->own_count * sizeof *options);
    for (int i = 0; i < JOB_OPTIONS; i++) {
        if (holds(of_rows, sizeof of_rows / sizeof of_rows[0], i)) continue;
        if (holds(c->without, c->without_count, i)) continue;
        number[count] = i;
        options[count++] = all[i];
    }
    return count;
}

static int take_system(cli_job *job, const char *command, const char *value)
{
    if (job->system)
        return cli_fail(CLI_USAGE, "%s: one SYSTEM only, not also '%s'", command, value);
    job->system = value;
    return CLI_DONE;
}

int analysis_read(int argc, char **argv, const analysis_command *command, cli_job *job, void *user)
{
    cli_option options[OPTIONS_MOST];
    int number[OPTIONS_MOST];
    const int count = list_options(command, options, number);
    cli_args args = cli_begin(argc, argv, options, count, command->notes);
    const char *value;
    for (int k; (k = cli_next(&args, &value)) != CLI_STOP;) {
        const int taken = k == CLI_PLAIN           ? take_system(job, argv[0], value)
                          : k < command->own_count ? command->take(user, k, value)
                                                   : job_take(job, number[k], value);
        if (taken != CLI_DONE) cli_stop(&args, taken);
    }
    if (args.status != CLI_GO_ON) return args.status;
    return job->system ? CLI_GO_ON : cli_fail(CLI_USAGE, "the SYSTEM is missing");
}

int analysis_open(analysis_place *place, const char *output, const char *name)
{
    char file[64];
    snprintf(file, sizeof file, "%s.csv", name);
    *place = (analysis_place){0};
    if (cli_is_directory(output)) {
        int status = cli_directory(output);
        if (status != CLI_DONE) return status;
        place->directory = output;
    }
    place->table = place->directory ? cli_join(output, file) : cli_strdup(output);
    return CLI_DONE;
}
