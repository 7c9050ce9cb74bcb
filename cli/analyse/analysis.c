/* analysis.c - arguments, outputs and distances of the commands that examine a system or a
 * motion. */
#include "analysis.h"
#include "io/output.h"

#include <math.h>
#include <stdlib.h>

enum { MAX_OPTIONS = 64 };

int analysis_read(int argc, char **argv, const analysis_command *command, run_request *request,
                  void *user)
{
    cli_option options[MAX_OPTIONS], all[REQUEST_OPTIONS];
    int number[MAX_OPTIONS] = {0}, count = command->own_count;
    request_list_options(all);
    if (command->adapt) command->adapt(all);
    for (int k = 0; k < count; k++) options[k] = command->own[k];
    for (int i = 0; i < REQUEST_OPTIONS; i++) {
        if (command->without >> i & 1) continue;
        number[count] = i;
        options[count++] = all[i];
    }
    cli_args args = cli_begin(argc, argv, options, count, command->notes);
    const char *value;
    for (int k; (k = cli_next(&args, &value)) != CLI_STOP;) {
        int status = CLI_DONE;
        if (k == CLI_PLAIN && request->system_name)
            status = cli_fail(CLI_USAGE, "%s: one SYSTEM only, not also '%s'", argv[0], value);
        else if (k == CLI_PLAIN)
            request->system_name = value;
        else
            status = k < command->own_count ? command->parse(user, k, value)
                                            : request_parse_option(request, number[k], value);
        if (status != CLI_DONE) cli_stop(&args, status);
    }
    if (args.status != CLI_GO_ON) return args.status;
    return request->system_name ? CLI_GO_ON : cli_fail(CLI_USAGE, "the SYSTEM is missing");
}

int analysis_open(analysis_output *output, const char *path, const char *name)
{
    *output = (analysis_output){0};
    if (!cli_is_directory(path)) {
        output->table = cli_strdup(path);
        return CLI_DONE;
    }
    output->directory = path;
    char *file = cli_format("%s.csv", name);
    output->table = cli_join(path, file);
    free(file);
    return cli_directory(path);
}

double analysis_distance(const double *a, const double *b, int count)
{
    double max = 0.0;
    for (int i = 0; i < count; i++) {
        const double gap = fabs(a[i] - b[i]) / fmax(1.0, fabs(b[i]));
        max = gap <= max ? max : isnan(gap) ? INFINITY : gap;
    }
    return max;
}
