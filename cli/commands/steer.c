/* steer.c - `dalembert steer`: the cheapest motion from one state to another. */
#include "steer/steer.h"
#include "io/file.h"
#include "io/json.h"
#include "ui/arguments.h"
#include "ui/commands.h"

#include <string.h>

enum { MAX_STARTS = 10000, MAX_ITERATIONS = 100000 };
static const double max_seed = 0x1p53;

static const cli_option options[] = {
    {"to", "NAME=V,..", NULL,
     "the target: values of x, x' at the end, numbers or formulas of them: x=1,phi=pi/2; what it "
     "does not name is free there",
     .parse = steer_parse_target, .heading = "ends"},
    {"free", "NAMES", NULL, "x, x' of the start that are free; their values are the first guess",
     CLI_TEXT(steer_settings, free_starts)},
    {"rest", NULL, NULL, "velocities that are not given are 0, at both ends",
     CLI_FLAG(steer_settings, rest)},
    {"aim", NULL, NULL,
     "no force is used: finds velocities on D = 0 at the start that hit the target",
     CLI_FLAG(steer_settings, aim)},
    {"starts", "N", "1",
     "first guesses, each of which may lead to another motion: the straight line, then bent ones; "
     "8 more where none leads to the target",
     CLI_INTEGER(steer_settings, starts, 1, MAX_STARTS), .heading = "search"},
    {"seed", "S", "1", "draws the bent lines", CLI_INTEGER(steer_settings, seed, 0, max_seed)},
    {"max-iterations", "N", "200", "ends the search from a first guess after N iterations",
     CLI_INTEGER(steer_settings, iterations, 1, MAX_ITERATIONS)},
    {"output", "DIR", NULL, "writes a run of each motion, its inputs, and steer.json",
     CLI_ROW(cli_parse_output, steer_settings, output), .heading = "output"},
    {"force", NULL, NULL, "overwrites what the directory holds", CLI_FLAG(steer_settings, force)},
    SCREEN_FORMAT_OPTION(steer_settings),
    JSON_OPTION(steer_settings),
};

static int steer(int argc, char **argv)
{
    steer_settings s = {.simulation = simulation_default()};
    const cli_option_set sets[] = {
        CLI_OPTION_SET(options, &s),
        simulation_options(&s.simulation, request_options, STEER_WITHOUT)};
    int status = cli_read_arguments(&command_steer, argc, argv, sets, 2);
    if (status == CLI_GO_ON) status = steer_run(&s);
    request_free_settings(&s.target);
    simulation_free(&s.simulation);
    return status;
}

const cli_command command_steer = {
    .name = "steer",
    .synopsis = "dalembert steer SYSTEM --to NAME=V,.. [OPTION]...",
    .about = "finds the cheapest motion from one state to another",
    .notes =
        "A motion of the lift is an extremal of the cost S = int e/2 |u|^2 dt of steering the "
        "system, dv/dt = F + N u with N N^T = K: of the acceleration with --effort identity, of "
        "the "
        "force along what the constraints allow with constraint, of the columns that the system "
        "file names with controls.  The command finds the momenta at the start with which it "
        "ends at the target, so that jumps within the motion are at rounding and S has the order "
        "of the method.  Runge-Kutta and partitioned methods with fixed steps can be used.\n"
        "\n"
        "At first it says what can be reached: the growth vector of D, and how many of the 2n "
        "numbers of an end momenta can change; with controls by the brackets of their columns with "
        "the motion, which are not enough for every target to be reached.  A target off D = 0, "
        "which every motion keeps with the efforts constraint and controls, is refused with "
        "status 2.\n"
        "\n"
        "With --output DIR each motion becomes the directory of a run; inputs.csv has u at each "
        "step, and with controls controlled.yaml is the system with these forces, whose plain run "
        "repeats the motion.  Of vakonomic motion S is int L dt, and ends are in q.\n"
        "\n"
        "The motions are listed by S, the cheapest first.  distance is how far the end is from the "
        "target, in its units; residual is the largest jump within the motion, relative to the "
        "size of the components; "
        "conjugate counts the conjugate times, without which S is a minimum among near motions; "
        "condition is of the matrix of Newton's method.\n"
        "\n"
        "The exit status is 3 where no motion hits the target: then the nearest one is printed, "
        "and how far it is.  After an interruption the motions so far are printed.\n",
    .run = steer,
};
