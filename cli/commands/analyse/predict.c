/* predict.c - `dalembert predict`: the drift of a run, before it. */
#include "analyse/predict.h"
#include "io/file.h"
#include "io/json.h"
#include "ui/arguments.h"
#include "ui/commands.h"
#include "ui/memory.h"

#include <string.h>

enum { MAX_ROWS = 1000000, MAX_PIECES = 1000000, MAX_QUAD = 1000000000 };

static const cli_option options[] = {
    {"pieces", "M", "0",
     "takes M pieces of that length for the random walk of chaotic motion; 500 say it to 10 %",
     CLI_INTEGER(predict_settings, pieces, 0, MAX_PIECES)},
    {"samples", "N", "200", "rows of the curve after the first, at equal distances in t",
     CLI_INTEGER(predict_settings, samples, 1, MAX_ROWS)},
    {"quad-steps", "N", "200000",
     "takes single steps in quad precision, up to N of them, where rounding hides what they "
     "change; each takes tens of times as long",
     CLI_INTEGER(predict_settings, quad_steps, 0, MAX_QUAD)},
    {"output", "FILE.csv|-", NULL, "writes the curves as CSV",
     CLI_ROW(cli_parse_output, predict_settings, output)},
    SCREEN_FORMAT_OPTION(predict_settings),
    JSON_OPTION(predict_settings),
    SCREEN_DETAILS_OPTION(predict_settings),
};

/* The first item of a list is the option of the request, whose settings begin with it. */
static int parse_list(void *user, int option, const char *text, const char **list)
{
    run_request *request = user;
    *list = text;
    const int status = request_give(request, option, cli_strndup(text, strcspn(text, ",")));
    request->text[option] = text;
    return status;
}

static int parse_integrators(void *user, const cli_option *option, const char *text)
{
    (void)option;
    return parse_list(user, REQUEST_integrator, text, &((predict_settings *)user)->integrators);
}

static int parse_steps(void *user, const cli_option *option, const char *text)
{
    (void)option;
    return parse_list(user, REQUEST_step, text, &((predict_settings *)user)->steps);
}

static int predict(int argc, char **argv)
{
    predict_settings s = {.simulation = simulation_default()};
    cli_option of_request[REQUEST_OPTIONS];
    memcpy(of_request, request_options, sizeof of_request);
    of_request[REQUEST_integrator].value = "A,B,..";
    of_request[REQUEST_integrator].help = "the methods: rk4,gauss4+project; see 'dalembert list'";
    of_request[REQUEST_integrator].parse = parse_integrators;
    of_request[REQUEST_step].value = "H1,H2,..";
    of_request[REQUEST_step].help = "the step sizes h";
    of_request[REQUEST_step].parse = parse_steps;
    const cli_option_set sets[] = {CLI_OPTION_SET(options, &s),
                                   simulation_options(&s.simulation, of_request, PREDICT_WITHOUT)};
    int status = cli_read_arguments(&command_predict, argc, argv, sets, 2);
    if (status == CLI_GO_ON) status = predict_run(&s);
    simulation_free(&s.simulation);
    return status;
}

const cli_command command_predict = {
    .name = "predict",
    .synopsis = "dalembert predict SYSTEM [OPTION]...",
    .about = "predicts the drift of D, E and invariants before a run",
    .notes =
        "Single steps of each method begin on the exact motion; what they change of D, E and the "
        "invariants, and what D off 0 changes of the others, adds up to the change along a run.  "
        "The table has the change at the end, the largest one, and the mean rate with its "
        "interval: '0 by reversibility' where the method preserves a reversal that maps the exact "
        "motion to itself, '0 within X' where the interval contains 0.  A quantity that the exact "
        "motion changes has no prediction.\n"
        "\n"
        "Where a method leaves D = 0 the curve ends when that may have moved the motion too far; "
        "a line says when; another one says to which time what oscillates is in phase with a run, "
        "whose rate and size are right after it, too.  A method or a motion that cannot be "
        "predicted is listed with the reason: multipliers or accelerations that pass from step to "
        "step, a tolerance, p or pi that are not 0, events, vakonomic motion, holonomic "
        "constraints, attractors.  The exit status is 2 where nothing can be predicted.  After an "
        "interruption the curves so far are printed.\n"
        "\n"
        "All methods and steps share one exact motion; its polynomials are kept in 256 MB, and "
        "after these each has its own.  A prediction takes at most as long as the exact motion and "
        "twice the run, if its steps are not in quad precision.\n"
        "\n"
        "With --pieces the exact motion goes on for M times the time.  Rates are means over the "
        "pieces, and s^2 of the random walk, the growth of the variance of a change per unit of "
        "t, follows from the variances over whole and over half pieces.\n",
    .run = predict,
};
