/* dirac.c - `dalembert dirac`: Dirac's procedure for the action of a system. */
#include "analyse/dirac.h"
#include "io/json.h"
#include "ui/arguments.h"
#include "ui/commands.h"
#include "ui/screen.h"

#include <string.h>

static const cli_option options[] = {
    {"latex", NULL, NULL, "prints an align* of LaTeX instead", CLI_FLAG(dirac_settings, latex)},
    JSON_OPTION(dirac_settings),
    SCREEN_DETAILS_OPTION(dirac_settings),
};

static int dirac(int argc, char **argv)
{
    static const uint64_t taken = REQUEST_OPTION(set) | REQUEST_OPTION(start) |
                                  REQUEST_OPTION(from) | REQUEST_OPTION(mechanics) |
                                  REQUEST_OPTION(effort) | REQUEST_OPTION(system);
    dirac_settings s = {.simulation = simulation_default()};
    cli_option of_request[REQUEST_OPTIONS];
    memcpy(of_request, request_options, sizeof of_request);
    of_request[REQUEST_start].help = "sets a start value: x, x', or g1; may be repeated";
    const cli_option_set sets[] = {CLI_OPTION_SET(options, &s),
                                   simulation_options(&s.simulation, of_request, ~taken)};
    int status = cli_read_arguments(&command_dirac, argc, argv, sets, 2);
    if (status == CLI_GO_ON) status = dirac_analyse(&s);
    simulation_free(&s.simulation);
    return status;
}

const cli_command command_dirac = {
    .name = "dirac",
    .synopsis = "dalembert dirac SYSTEM [OPTION]...",
    .about = "carries out Dirac's procedure for the action of a system",
    .notes =
        "The command begins with the first-order action of the lift with its effort, or of "
        "vakonomic motion: its Hamiltonian and its primary constraints.  Stage by stage it "
        "requires "
        "that every constraint is conserved on the surface of those found so far.  A condition "
        "fixes a multiplier, holds, or is a further constraint.  One that is a sum of squares, or "
        "a semidefinite quadratic form in momenta, is irregular, and is replaced by what vanishes "
        "where it does.\n"
        "\n"
        "At the end come the first-class and the second-class constraints, the multipliers, the "
        "gauge generator of each free one, and the Dirac brackets of q and v with each other and "
        "with their momenta.  Brackets are formulas with exact derivatives.  Points near the start "
        "decide what vanishes on the surface.\n"
        "\n"
        "On a terminal long formulas are shortened; a pipe, and --details, get all of them.  The "
        "exit status is 1 where a condition contradicts the others, or is irregular in another "
        "way.\n",
    .run = dirac,
};
