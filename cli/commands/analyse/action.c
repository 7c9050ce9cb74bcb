/* action.c - `dalembert action`: the actions of the theory on a curve. */
#include "analyse/action.h"
#include "io/json.h"
#include "run/request.h"
#include "ui/arguments.h"
#include "ui/commands.h"
#include "ui/screen.h"

#include <float.h>

static const cli_option options[] = {
    {NULL, "CURVE.csv", CLI_REQUIRED,
     "rows of t and the coordinates; x', lambda_x, e, p_x, pi_x and pi_e where the file has them",
     CLI_TEXT(action_settings, curve)},
    {"methods", "LIST", "stormer-verlet,implicit-midpoint,gauss4,lobatto4",
     "the symplectic methods whose discrete actions are tried, with commas between them",
     CLI_TEXT(action_settings, methods)},
    {"perturb", "A", "0", "also evaluates a curve with A sin^4 on every coordinate, ends fixed",
     CLI_NUMBER(action_settings, perturb, -DBL_MAX, DBL_MAX)},
    JSON_OPTION(action_settings),
    SCREEN_DETAILS_OPTION(action_settings),
};

static int action(int argc, char **argv)
{
    action_settings s = {.simulation = simulation_default()};
    const cli_option_set sets[] = {
        simulation_options(&s.simulation, request_options, ~ACTION_OPTIONS),
        CLI_OPTION_SET(options, &s)};
    int status = cli_read_arguments(&command_action, argc, argv, sets, 2);
    if (status == CLI_GO_ON) status = action_evaluate(&s);
    simulation_free(&s.simulation);
    return status;
}

const cli_command command_action = {
    .name = "action",
    .synopsis = "dalembert action SYSTEM CURVE.csv [OPTION]...",
    .about = "evaluates the actions of the theory on a curve",
    .notes =
        "A curve is what 'run' writes, or any CSV file with columns t and the coordinates at times "
        "that ascend, at least 7 rows.  Cubic splines join the rows.  The command prints the "
        "actions (nh10), (nh11) and (nh23): the first one is 0 where the curve is a motion of the "
        "system and positive elsewhere.  The error of a value is its distance to the value with "
        "every second row: of a motion a value is as large as its error, and both shrink like h^4 "
        "with the distance h of the rows.\n"
        "\n"
        "What a file does not have is v = q', lambda = 0, p = pi = 0, e = 1, pi_e = 0.  Where it "
        "has velocities and rows at equal distances, each row is compared with one step of the "
        "methods from the row before.  The discrete action of a symplectic method is stationary, "
        "with fixed ends, where all rows are such steps; its value is given where e is constant.\n"
        "\n"
        "--perturb compares with a curve that is not a motion.\n",
    .run = action,
};
