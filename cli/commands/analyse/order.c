/* order.c - `dalembert order`: the error of many methods against step and against work. */
#include "analyse/order.h"
#include "analyse/analysis.h"
#include "io/file.h"
#include "io/json.h"
#include "report/report_order.h"
#include "run/pool.h"
#include "ui/arguments.h"
#include "ui/commands.h"
#include "ui/screen.h"

#include <string.h>

/* --steps or --tolerances. */
static int parse_levels(void *user, const cli_option *option, const char *text)
{
    order_settings *s = user;
    s->simulation.request.step_rule = REQUEST_STEP_UNUSED;
    return cli_parse_text(user, option, text);
}

static const cli_option options[] = {
    {"integrators", "LIST|all", NULL,
     "integrators, with modifiers or not: rk4,gauss4+project (all)",
     CLI_TEXT(order_settings, integrators)},
    {"steps", "H1,H2,..", NULL, "step sizes, falling, at most 8; replaces --step and --levels",
     .parse = parse_levels, .offset = offsetof(order_settings, steps)},
    {"tolerances", "E1,E2,..", NULL,
     "tolerances, falling, at most 8, instead of step sizes; --step is then the largest step (T)",
     .parse = parse_levels, .offset = offsetof(order_settings, tolerances)},
    {"levels", "K", "4", "number of step sizes, each half the one before it",
     CLI_INTEGER(order_settings, level_count, 2, DAL_ORDER_LEVELS)},
    POOL_THREADS_OPTION(order_settings, "runs at a time; results do not depend on it"),
    {"output", "DIR|FILE.csv", NULL, "writes the table as CSV; a directory gets a page, too",
     CLI_ROW(cli_parse_output, order_settings, output)},
    ANALYSIS_FORCE_OPTION(order_settings),
    SCREEN_FORMAT_OPTION(order_settings),
    JSON_OPTION(order_settings),
    SCREEN_DETAILS_OPTION(order_settings),
};

static int order(int argc, char **argv)
{
    order_settings s = {
        .simulation = simulation_default(), .integrators = "all", .threads = pool_threads()};
    cli_option of_request[REQUEST_OPTIONS];
    memcpy(of_request, request_options, sizeof of_request);
    of_request[REQUEST_step].initial = "0.1";
    of_request[REQUEST_time].initial = "10";
    const cli_option_set sets[] = {CLI_OPTION_SET(options, &s),
                                   simulation_options(&s.simulation, of_request, ORDER_WITHOUT)};
    int status = cli_read_arguments(&command_order, argc, argv, sets, 2);
    if (status == CLI_GO_ON) status = order_measure(&s);
    if (s.is_written && status != CLI_IO && cli_is_directory(s.output))
        status = report_after(s.output, status, report_order);
    simulation_free(&s.simulation);
    return status;
}

const cli_command command_order = {
    .name = "order",
    .synopsis = "dalembert order SYSTEM [OPTION]...",
    .about = "measures error against step and against work for many integrators",
    .notes =
        "--step is the largest step, --time the time of the errors; both come from the defaults of "
        "the system file where they are not given, or are 0.1 and 10.  The space is the lifted one "
        "where the method and the system have a lift, else (q,v).\n"
        "\n"
        "The error is the largest difference in q and v at T, relative to |x| or to the "
        "system's own unit of it, whichever is larger, from the "
        "exact solution where the system has one that begins at this start.  Otherwise the "
        "reference is gauss12, or dop853 where gauss12 does not converge, with half the smallest "
        "step; the table states its own error.  The order found is the slope between the last two "
        "of three steps whose errors exceed rounding and ten times the error of the reference, "
        "and lie below half the solution.  It is found only where the two slopes agree so well "
        "that the next term of the error changes it by 0.1 at most; where none is found the table "
        "says whether the steps are too coarse or the errors at rounding.  Methods that do not "
        "apply to the system are listed with the reason.  The exit "
        "status is 3 when a run failed.\n"
        "\n"
        "With --tolerances the adaptive methods are compared at each tolerance, which divides the "
        "step; the reference is taylor, or dop853 where the equations have no Taylor series, at a "
        "hundredth of the smallest, and the slope of the error is taken over the tolerance.  "
        "Without --step the step is T, or a part of it where T takes more substeps than a step may "
        "have, or a constraint turns too far in it.\n"
        "\n"
        "DIR gets order.csv, order.json (the request and the reference) and the page "
        "of 'dalembert report': error against step, evaluations of F and processor time.  Only the "
        "times differ between two runs of the command.\n",
    .run = order,
};
