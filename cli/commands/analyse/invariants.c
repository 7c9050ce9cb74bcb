/* invariants.c - `dalembert invariants`: finds invariants and invariant measures of a motion. */
#include "analyse/invariants.h"
#include "io/json.h"
#include "ui/arguments.h"
#include "ui/commands.h"
#include "ui/screen.h"

#include <string.h>

static const cli_option options[] = {
    {"degree", "K", "2", "the highest degree of the products that an invariant adds up",
     CLI_INTEGER(invariants_settings, degree, 1, 8)},
    {"with", "FORMULAS", NULL, "further factors of the products: \"x, cos(2*phi), 1/hypot(x, y)\"",
     CLI_TEXT(invariants_settings, with)},
    {"measure", NULL, NULL, "finds an invariant measure of the coordinates, too",
     CLI_FLAG(invariants_settings, measure)},
    JSON_OPTION(invariants_settings),
    SCREEN_DETAILS_OPTION(invariants_settings),
};

static int invariants(int argc, char **argv)
{
    static const uint64_t taken =
        REQUEST_OPTION(set) | REQUEST_OPTION(start) | REQUEST_OPTION(from) | REQUEST_OPTION(system);
    invariants_settings s = {.simulation = simulation_default()};
    cli_option of_request[REQUEST_OPTIONS];
    memcpy(of_request, request_options, sizeof of_request);
    of_request[REQUEST_start].help = "sets a start value: x, x', or g1; may be repeated";
    const cli_option_set sets[] = {CLI_OPTION_SET(options, &s),
                                   simulation_options(&s.simulation, of_request, ~taken)};
    int status = cli_read_arguments(&command_invariants, argc, argv, sets, 2);
    if (status == CLI_GO_ON) status = invariants_find(&s);
    simulation_free(&s.simulation);
    return status;
}

const cli_command command_invariants = {
    .name = "invariants",
    .synopsis = "dalembert invariants SYSTEM [OPTION]...",
    .about = "finds what a motion conserves, from its formulas",
    .notes =
        "The command searches for sums of products of factors that the motion conserves on D = 0.  "
        "The factors are the coordinates that the equations of motion contain, cosines and sines "
        "of the angles that they contain, the velocities, and the formulas of --with.  At random "
        "points of D = 0 near the start, such sums have the rate 0 where they are in the null "
        "space of the rates of all products.  Singular values say which these are; the command "
        "prints the largest one that counts as 0 and the smallest one that does not.\n"
        "\n"
        "Each invariant is written in the simplest products, with whole numbers and powers of "
        "parameters where that is possible, and confirmed as it is written: 'exact' to the digits "
        "of quad precision, or 'to rounding' to the digits of doubles; with 'any parameters', or "
        "with 'these parameters' alone.  An invariant is 'new' where it does not depend on E, on "
        "the invariants of the system and on those before it, 'known' where it depends on E and "
        "on the system's, and 'dependent' where it depends on those before it.\n"
        "\n"
        "A pipe gets an 'invariants:' block for a system file.  With --measure the command "
        "searches "
        "for a density rho of the coordinates too, so that rho dq dv on D = 0 is an invariant "
        "measure: rho, its inverse, its square, its inverse square, its root or its fourth power "
        "is a sum of products.  The exit status is 1 when no invariant is found.\n",
    .run = invariants,
};
