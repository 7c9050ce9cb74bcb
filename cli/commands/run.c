/* run.c - `dalembert run`: integrates one system and writes rows. */
#include "run/run.h"
#include "io/output.h"
#include "run/manifest.h"

#include <string.h>

static const char notes[] =
    "SYSTEM is a built-in name ('dalembert list systems') or the path of a system file.\n"
    "\n"
    "Rows are CSV with 17 digits: t, the coordinates, the velocities, on the lifted space e, p_*,\n"
    "pi_*, pi_e, then D1.., E, H, the invariants and error; N+1 rows, from t = 0 to exactly T.\n"
    "FILE.npy holds the same as an array of numpy with the names of the columns.\n"
    "A directory gets manifest.json, system.yaml (when SYSTEM is a file), trajectory.npy,\n"
    "summary.csv and a checkpoint.  'dalembert resume DIR' resumes the run after any "
    "interruption,\n"
    "kill -9 included, and ends in the same bytes.\n"
    "\n"
    "The summary has, of every observable at every step: maximum, final value, amplitude of its\n"
    "oscillation, drift rate with its 95 % interval, exponent of growth; its size: exact, "
    "rounding\n"
    "or larger; and its trend: none, settles, random walk, linear, power law, exponential, "
    "growing\n"
    "oscillation, undecided or aborted, with a confidence.  E has neither size nor trend where "
    "the\n"
    "motion does not conserve it.\n";

static int run_in_directory(const run_request *request, const run_settings *settings)
{
    run_directory dir;
    run_directory_open(&dir, settings->output);
    int status = cli_directory(dir.path);
    const char *file =
        status == CLI_DONE && !settings->force ? run_directory_find_file(&dir) : NULL;
    if (file)
        status = cli_fail(CLI_USAGE,
                          "'%s' is there already: 'dalembert resume' resumes a run, --force "
                          "writes over it",
                          file);
    if (status == CLI_DONE) status = run_directory_lock(&dir, 1);
    if (status == CLI_DONE) status = manifest_begin(&dir, request);
    if (status == CLI_DONE) status = run_integrate(request, &dir, settings);
    run_directory_close(&dir);
    return status;
}

static int parse_argument(run_request *request, run_settings *settings, int option,
                          const char *value)
{
    if (option >= REQUEST_OPTIONS) return run_parse_setting(settings, option, value);
    if (option != CLI_PLAIN) return request_parse_option(request, option, value);
    if (request->system_name)
        return cli_fail(CLI_USAGE, "run: one SYSTEM only, not also '%s'", value);
    request->system_name = value;
    return CLI_DONE;
}

int command_run(int argc, char **argv)
{
    cli_option options[RUN_OPTIONS];
    request_list_options(options);
    memcpy(options + REQUEST_OPTIONS, run_options, sizeof run_options);
    cli_args args = cli_begin(argc, argv, options, RUN_OPTIONS, notes);
    run_request request = request_default();
    run_settings settings = run_settings_default();
    const char *value;
    for (int k; (k = cli_next(&args, &value)) != CLI_STOP;) {
        const int parsed = parse_argument(&request, &settings, k, value);
        if (parsed != CLI_DONE) cli_stop(&args, parsed);
    }
    int status = args.status == CLI_GO_ON ? request_create_run(&request) : args.status;
    if (args.status == CLI_GO_ON && status == CLI_DONE)
        status = cli_is_directory(settings.output) ? run_in_directory(&request, &settings)
                                                   : run_integrate(&request, NULL, &settings);
    request_free(&request);
    return status;
}
