/* explain.c - `dalembert explain`: the error sources of the drift of a run. */
#include "analyse/explain.h"
#include "io/file.h"
#include "io/json.h"
#include "ui/commands.h"
#include "ui/options.h"

static const cli_option options[] = {
    {"quad-steps", "N", "10000", "runs the first N steps in quad precision too; 0: none",
     CLI_INTEGER(explain_settings, quad_steps, 0, EXPLAIN_MAX_STEPS)},
    {"output", "FILE.csv|-", NULL, "writes a CSV file, or CSV to standard output",
     CLI_ROW(cli_parse_output, explain_settings, output)},
    JSON_OPTION(explain_settings),
    NATIVE_OPTION(explain_settings),
};

static int explain(int argc, char **argv)
{
    explain_settings s = {.request = request_default()};
    const cli_group groups[] = {CLI_GROUP(options, &s),
                                request_group(&s.request, request_options, EXPLAIN_WITHOUT)};
    s.request.chooses_step = true;
    int status = cli_read_arguments(&command_explain, argc, argv, groups, 2);
    if (status == CLI_GO_ON) status = explain_run(&s);
    request_free(&s.request);
    return status;
}

const cli_command command_explain = {
    .name = "explain",
    .synopsis = "dalembert explain SYSTEM [OPTION]...",
    .about = "finds the error sources of the drift of a run",
    .notes =
        "Runs the system again in several ways that differ in one thing each: half the step, a "
        "looser tolerance of the solver, further iterations of it, plain sums, quad precision "
        "(113 binary digits, where the machine has them), with and without projection, and by "
        "taylor, which shows what the exact motion changes.  For the "
        "drift of every observable the command states how much is truncation, rounding of "
        "coefficients, the solver and rounding, what a projection changes, and how that was "
        "found; '?' marks what these runs do not distinguish.\n"
        "\n"
        "The shares of the first four add up to 1 where rates are compared.  They hold for the "
        "first --quad-steps steps, since quad precision is a hundred times slower.  With "
        "--tolerance, --step may be left out: it is a hundredth of the time.\n",
    .run = explain,
};
