/* explain.c - `dalembert explain`: the error sources of the drift of a run. */
#include "analyse/explain.h"
#include "analyse/rerun.h"
#include "io/file.h"
#include "io/json.h"
#include "ui/arguments.h"
#include "ui/commands.h"

static const cli_option options[] = {
    {"quad-steps", "N", "10000", "runs the first N steps in quad precision too; 0: none",
     CLI_INTEGER(explain_settings, quad_steps, 0, EXPLAIN_MAX_STEPS)},
    {"output", "FILE.csv|-", NULL, "writes a CSV file, or CSV to standard output",
     CLI_ROW(cli_parse_output, explain_settings, output)},
    {"details", NULL, NULL, "prints the runs that are compared, and how each share was found",
     CLI_FLAG(explain_settings, details)},
    SCREEN_FORMAT_OPTION(explain_settings),
    JSON_OPTION(explain_settings),
    NATIVE_OPTION(explain_settings),
};

static int explain(int argc, char **argv)
{
    explain_settings s = {.simulation = simulation_default()};
    const cli_option_set sets[] = {CLI_OPTION_SET(options, &s),
                                   rerun_options(&s.simulation, request_options, EXPLAIN_WITHOUT)};
    s.simulation.request.step_rule = REQUEST_STEP_CHOSEN;
    int status = cli_read_arguments(&command_explain, argc, argv, sets, 2);
    if (status == CLI_GO_ON) status = explain_run(&s);
    simulation_free(&s.simulation);
    return status;
}

const cli_command command_explain = {
    .name = "explain",
    .synopsis = "dalembert explain SYSTEM|DIR [OPTION]...",
    .about = "finds the error sources of the drift of a run",
    .notes =
        "Runs the system again in several ways that differ in one thing each: half the step, a "
        "looser tolerance of the solver, further iterations of it, plain sums, quad precision "
        "(113 binary digits, where the machine has them), with and without projection; and "
        "computes the exact motion by dop853 in units of the system's own.  For every observable "
        "that changes the command says in a sentence what it does and by which sources:\n"
        "\n"
        "  motion         what the exact motion changes; nothing where it conserves the quantity\n"
        "  truncation     falls as the order of the method says when the step is halved\n"
        "  branches       truncation in steps across branches (abs, if, ...), which falls less\n"
        "  coefficients   of the method, which are doubles\n"
        "  solver         equations that are not solved to rounding\n"
        "  rounding       vanishes in quad precision\n"
        "\n"
        "Each share is a percentage of their sum, and they add up to 100; '-' is none, '?' is what "
        "these runs do not distinguish.  The last column of the table is what a projection leaves "
        "of the drift.  --details prints the runs and how each share was found.\n"
        "\n"
        "The shares hold for the first --quad-steps steps, since quad precision is a hundred times "
        "slower.  With --tolerance, --step may be left out: it is a hundredth of the time.\n"
        "\n"
        "DIR is a directory that 'run --output DIR' wrote.  System, method, step, end, parameters, "
        "start and the further options of the run are taken from it, where no others are given; a "
        "line says which.\n",
    .run = explain,
};
