/* check.c - `dalembert check`: examines a system before a run. */
#include "analyse/check.h"
#include "io/json.h"
#include "ui/arguments.h"
#include "ui/commands.h"
#include "ui/screen.h"

#include <string.h>

static const cli_option options[] = {
    SCREEN_DETAILS_OPTION(check_settings),
    {"latex", NULL, NULL, "prints L, Q, D, F and H of the lift as LaTeX instead",
     CLI_FLAG(check_settings, latex)},
    {"mathml", NULL, NULL, "prints them as MathML instead", CLI_FLAG(check_settings, mathml)},
    JSON_OPTION(check_settings)};

static int check_command(int argc, char **argv)
{
    static const uint64_t taken = REQUEST_OPTION(set) | REQUEST_OPTION(start) |
                                  REQUEST_OPTION(from) | REQUEST_OPTION(mechanics) |
                                  REQUEST_OPTION(effort) | REQUEST_OPTION(gauge) |
                                  REQUEST_OPTION(system);
    check_settings s = {.simulation = simulation_default()};
    cli_option of_request[REQUEST_OPTIONS];
    memcpy(of_request, request_options, sizeof of_request);
    of_request[REQUEST_start].help = "sets a start value: x, x', e or g1; may be repeated";
    const cli_option_set sets[] = {CLI_OPTION_SET(options, &s),
                                   simulation_options(&s.simulation, of_request, ~taken)};
    int status = cli_read_arguments(&command_check, argc, argv, sets, 2);
    if (status == CLI_GO_ON) status = check_system(&s);
    simulation_free(&s.simulation);
    return status;
}

const cli_command command_check = {
    .name = "check",
    .synopsis = "dalembert check SYSTEM [OPTION]...",
    .about = "examines a system before a run: constraints, energy, derivatives",
    .notes =
        "Each line is one item: 'ok' or 'FAIL' where it can be right or wrong, 'not measured' "
        "where it has no value, and 'info' otherwise.  The command evaluates the system at its "
        "start and at random points about it, and does not rely on the properties that the system "
        "states.  It compares derivatives with central differences of order 8.  The exit status "
        "is 1 when an item failed or was not measured.\n"
        "\n"
        "--latex prints an align* of amsmath: the equations as the file has them, and the "
        "accelerations derived from them.  Long terms that occur several times are named s_1, "
        "s_2, ...  --mathml prints the same as an element of a web page.\n",
    .run = check_command,
};
