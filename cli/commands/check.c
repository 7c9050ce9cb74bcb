/* check.c - `dalembert check`: examines a system before a run. */
#include "analyse/check.h"
#include "ui/commands.h"
#include "ui/options.h"

#include <string.h>

static int check_command(int argc, char **argv)
{
    static const uint64_t taken =
        REQUEST_OPTION(set) | REQUEST_OPTION(start) | REQUEST_OPTION(system);
    run_request request = request_default();
    cli_option options[REQUEST_OPTIONS];
    memcpy(options, request_options, sizeof options);
    options[REQUEST_start].help = "sets a start value: x, x', e or g1; may be repeated";
    const cli_group group = request_group(&request, options, ~taken);
    int status = cli_read_arguments(&command_check, argc, argv, &group, 1);
    if (status == CLI_GO_ON) status = check_system(&request);
    request_free(&request);
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
        "is 1 when an item failed or was not measured.\n",
    .run = check_command,
};
