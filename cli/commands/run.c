/* run.c - `dalembert run`: integrates one system and writes rows. */
#include "run/run.h"
#include "io/output.h"
#include "run/manifest.h"
#include "ui/commands.h"
#include "ui/message.h"
#include "ui/options.h"

static int run_in_directory(const run_request *request, const run_settings *settings)
{
    run_directory dir;
    run_directory_open(&dir, settings->output);
    int status = cli_directory(dir.path);
    const char *file =
        status == CLI_DONE && !settings->force ? run_directory_find_file(&dir) : NULL;
    if (file)
        status = cli_fail(CLI_USAGE,
                          "'%s' is there already: 'dalembert resume' continues a run, --force "
                          "overwrites it",
                          file);
    if (status == CLI_DONE) status = run_directory_lock(&dir, 1);
    if (status == CLI_DONE) status = manifest_begin(&dir, request);
    if (status == CLI_DONE) status = run_integrate(request, &dir, settings);
    run_directory_close(&dir);
    return status;
}

static int run(int argc, char **argv)
{
    run_request request = request_default();
    run_settings settings = {0};
    const cli_group groups[] = {request_group(&request, request_options, 0),
                                run_group(&settings, 0)};
    int status = cli_read_arguments(&command_run, argc, argv, groups, 2);
    if (status == CLI_GO_ON) {
        status = request_create_run(&request);
        if (status == CLI_DONE)
            status = cli_is_directory(settings.output) ? run_in_directory(&request, &settings)
                                                       : run_integrate(&request, NULL, &settings);
    }
    request_free(&request);
    return status;
}

const cli_command command_run = {
    .name = "run",
    .synopsis = "dalembert run SYSTEM --integrator NAME --step H --time T [OPTION]...",
    .about = "integrates one system",
    .notes =
        "Rows are CSV with 17 digits: t, the coordinates, the velocities, on the lifted space e, "
        "p_*, pi_*, pi_e, then D1.., E, H, the invariants and error; N+1 rows, from t = 0 to "
        "exactly T.  FILE.npy has the same as an array of numpy with the names of the columns.\n"
        "\n"
        "A directory gets manifest.json, system.yaml (where SYSTEM is a file), trajectory.npy, "
        "summary.csv and a checkpoint.  'dalembert resume DIR' continues the run after any "
        "interruption, kill -9 included, and the bytes are the same.\n"
        "\n"
        "The summary has, of every observable at every step: maximum, final value, amplitude of "
        "its oscillation, drift rate with its 95 % interval, exponent of growth; its size: exact, "
        "rounding or larger; and its trend: none, settles, random walk, linear, power law, "
        "exponential, growing oscillation, undecided or aborted, with a confidence.  E has "
        "neither size nor trend where the motion does not conserve it.\n",
    .run = run,
};
