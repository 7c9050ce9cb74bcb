/* run.c - `dalembert run`: integrates one system and writes rows. */
#include "run/run.h"
#include "analyse/invariants.h"
#include "io/file.h"
#include "run/simulation.h"
#include "ui/arguments.h"
#include "ui/commands.h"
#include "ui/message.h"

#include <string.h>

static int check_format(const run_settings *s)
{
    const char *output = s->text[RUN_output];
    if (s->format != SCREEN_TEXT && output && strcmp(output, "-") == 0)
        return cli_fail(CLI_USAGE, "--format: standard output has the rows");
    return screen_check_format(s->format, "--details", s->details);
}

/* Which invariants a run observes. */
typedef struct invariants_option {
    enum { INVARIANTS_GIVEN, INVARIANTS_AUTO } of;
} invariants_option;

static const cli_option options[] = {
    {"invariants", "given|auto", "given",
     "auto: observes what the motion conserves and the file does not have, as by 'dalembert "
     "invariants'",
     CLI_WORD(invariants_option, of)},
};

static int run(int argc, char **argv)
{
    invariants_option invariants = {INVARIANTS_GIVEN};
    run_simulation simulation = simulation_default();
    run_settings settings = {0};
    simulation.request.step_rule = REQUEST_STEP_CHOSEN;
    const cli_option_set sets[] = {simulation_options(&simulation, request_options, 0),
                                   run_option_set(&settings, 0),
                                   CLI_OPTION_SET(options, &invariants)};
    int status = cli_read_arguments(&command_run, argc, argv, sets, 3);
    if (status == CLI_GO_ON && check_format(&settings) != CLI_DONE) status = CLI_USAGE;
    if (status == CLI_GO_ON) {
        status = invariants.of == INVARIANTS_AUTO ? invariants_observe(&simulation) : CLI_DONE;
        if (status == CLI_DONE) status = simulation_create(&simulation);
        if (status == CLI_DONE)
            status = cli_is_directory(settings.output)
                         ? run_in_directory(&simulation, &settings)
                         : run_integrate(&simulation, NULL, &settings);
    }
    simulation_free(&simulation);
    return status;
}

const cli_command command_run = {
    .name = "run",
    .synopsis = "dalembert run SYSTEM [OPTION]...",
    .about = "integrates one system",
    .notes =
        "The integrator, the step and the time come from the defaults of the system file where "
        "they "
        "are not given; a line on standard error says so.\n"
        "\n"
        "On a terminal the program prints a screen instead of rows: the state at the end, a line "
        "in "
        "words for each quantity, and what to try next.  --output - prints the rows there, too, "
        "--details the table of the summary.\n"
        "\n"
        "Rows are CSV with 17 digits: t, the coordinates, the velocities, the multipliers g1.. of "
        "a vakonomic system, on the lifted space e, p_*, pi_*, pi_e, then D1.., E, H, the "
        "invariants and error; N+1 rows, from t = 0 to exactly T.  Where a row falls between two "
        "steps, a shorter step, or under a tolerance a polynomial, gives the row and does not "
        "affect the trajectory.  FILE.npy has the same as an array of numpy with the names of the "
        "columns.\n"
        "\n"
        "A directory gets\n"
        "  manifest.json   the options of the run, version, machine and progress\n"
        "  system.yaml     a copy of the system file, where SYSTEM is one\n"
        "  trajectory.npy  the rows; it can be read during the run\n"
        "  checkpoint      the state of the run; checkpoint.before is the one before it\n"
        "  summary.csv     when the run is over, a line for each observable\n"
        "\n"
        "'dalembert resume DIR' continues the run after any interruption, kill -9 included, and "
        "the bytes are the same.\n"
        "\n"
        "The summary has, of every observable x at every step: first and final value, maximum of "
        "|x| and of |x - first|, amplitude of its oscillation, drift rate of this run with its "
        "95 % interval, exponent of growth, size and trend, with a confidence.  The size is exact "
        "(it never changed), rounding (what the roundings of all steps explain) or larger.  The "
        "trend is\n"
        "  none                 it stays about one value\n"
        "  settles              it changes once and then stays about one value\n"
        "  random walk          it grows like the square root of t\n"
        "  linear               it grows like t\n"
        "  power law            it grows like another power of t\n"
        "  exponential          it grows exponentially\n"
        "  growing oscillation  it oscillates, and its amplitude grows\n"
        "  undecided            several of these, or none, explain the values\n"
        "  aborted              a value was not finite, or the run ended early\n"
        "\n"
        "The last two have no confidence.  The rate of what settles is the rate after the change.  "
        "The interval of a rate says nothing of a longer run: --details prints, for what is "
        "linear, the rate -+ 49 times the range of the rates of its quarters, which is the bend "
        "continued to 50 times the time.\n"
        "\n"
        "E has neither size nor trend where the motion does not conserve it.\n"
        "\n"
        "With --tolerance H is the largest step, a hundredth of the time where it is left out.\n"
        "\n"
        "Compiled steps are cached in $XDG_CACHE_HOME/dalembert or ~/.cache/dalembert, which may "
        "be removed at any time.  Where compiling fails, a line says so and the steps are "
        "interpreted.  Steps with --precision quad are always interpreted.  With quad precision, "
        "coefficients, constants, parameters, times and all output stay doubles.\n",
    .run = run,
};
