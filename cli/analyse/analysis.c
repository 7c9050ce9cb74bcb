/* analysis.c - outputs and distances of the commands that examine a system or a motion. */
#include "analysis.h"
#include "io/file.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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
    return cli_output_directory(path);
}

int analysis_check_output(const char *output, bool json)
{
    if (!json || !output || strcmp(output, "-") != 0) return CLI_DONE;
    return cli_fail(CLI_USAGE, "--json and --output - would both write to standard output");
}

const char *analysis_state(int status)
{
    return status == CLI_DONE ? "done" : status == CLI_SIGNAL ? "interrupted" : "failed";
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

void analysis_put_cells(FILE *out, const double *numbers, int count)
{
    for (int i = 0; i < count; i++) {
        fputc(',', out);
        cli_put_known(out, numbers[i]);
    }
}
