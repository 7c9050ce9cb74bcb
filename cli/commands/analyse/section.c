/* section.c - `dalembert section`: where a motion crosses a surface. */
#include "analyse/section.h"
#include "analyse/analysis.h"
#include "analyse/rerun.h"
#include "io/file.h"
#include "io/json.h"
#include "report/report_section.h"
#include "ui/arguments.h"
#include "ui/commands.h"
#include "ui/screen.h"

#include <math.h>

static const cli_option options[] = {
    {"on", "FORMULA[=VALUE]", CLI_REQUIRED, "the surface: x - 1, y*x' = 0.5, sin(3*t)",
     CLI_TEXT(section_settings, on)},
    {"direction", "down|both|up", "both", "crossings from above it to below, all, or from below",
     CLI_WORD(section_settings, direction)},
    {"transient", "T0", "0", "leaves out the crossings before this time; less than --time",
     CLI_NUMBER(section_settings, transient, -INFINITY, INFINITY)},
    {"axes", "X,Y", NULL,
     "columns of the figure (the last coordinate that varies, with its velocity)",
     CLI_TEXT(section_settings, axes)},
    NATIVE_OPTION(section_settings),
    {"output", "DIR|FILE|-", "-", "where rows go: .csv, .npy, a directory with a page, or stdout",
     CLI_ROW(cli_parse_output, section_settings, output)},
    ANALYSIS_FORCE_OPTION(section_settings),
    JSON_OPTION(section_settings),
    SCREEN_DETAILS_OPTION(section_settings),
};

static int section(int argc, char **argv)
{
    section_settings s = {.simulation = simulation_default()};
    s.simulation.request.step_rule = REQUEST_STEP_CHOSEN;
    const cli_option_set sets[] = {CLI_OPTION_SET(options, &s),
                                   rerun_options(&s.simulation, request_options, SECTION_WITHOUT)};
    int status = cli_read_arguments(&command_section, argc, argv, sets, 2);
    s.direction--; /* -1, 0 or 1 */
    s.is_screen = screen_has_reader() && !s.json && !s.details;
    if (status == CLI_GO_ON) status = section_find(&s);
    if ((status == CLI_DONE || status == CLI_SIGNAL) && cli_is_directory(s.output))
        status = report_after(s.output, status, report_section);
    simulation_free(&s.simulation);
    return status;
}

const cli_command command_section = {
    .name = "section",
    .synopsis = "dalembert section SYSTEM|DIR --on FORMULA [OPTION]...",
    .about = "finds where a motion crosses a surface",
    .notes =
        "The formula may name "
        "coordinates, velocities, parameters, what the system file defines under let, and t.\n"
        "\n"
        "A crossing lies where the formula changes its sign within a step.  A step of another "
        "size of the same method, from the beginning of that step, or under a tolerance a "
        "polynomial, meets it to rounding, so that 'dalembert run' has the same trajectory.  "
        "A step is searched in up to 1024 intervals, shorter ones where the formula varies faster; "
        "where that is not enough, the command says how many steps may hide crossings.  "
        "A touch is no crossing and is counted apart; a start on the surface is none.  "
        "With --tolerance, --step may be left out: it is a hundredth of the time.\n"
        "\n"
        "Rows are CSV with 17 digits: crossing (from 1), t, direction (1 or -1), then the "
        "state as in "
        "'dalembert run'.  A directory gets section.csv, section.json (the request) and "
        "the page of 'dalembert report'.\n"
        "\n"
        "The first DIR is a directory that 'run --output DIR' wrote.  System, method, step, end, "
        "parameters, start and the further options of the run are taken from it, where no others "
        "are "
        "given; a line says which.\n",
    .run = section,
};
