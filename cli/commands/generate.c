/* generate.c - `dalembert generate`: writes one C file that steps one system. */
#include "dalembert_codegen.h"
#include "io/file_output.h"
#include "run/simulation.h"
#include "ui/arguments.h"
#include "ui/commands.h"
#include "ui/message.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct settings {
    run_simulation simulation;
    const char *output, *prefix;
    long long lanes;
    enum { WITH_NONE, WITH_FIELD } with;
} settings;

static const cli_option options[] = {
    {"output", "FILE|-", "-", "writes there, or to standard output", CLI_TEXT(settings, output)},
    {"lanes", "W", "1", "steps 1, 2, 4, 8 or 16 systems at a time",
     CLI_INTEGER(settings, lanes, 1, 16)},
    {"prefix", "NAME", NULL, "public names begin with it (SYSTEM_INTEGRATOR)",
     CLI_TEXT(settings, prefix)},
    {"with", "none|field", "none", "adds functions of a point: F, its Jacobian, D and A, E",
     CLI_WORD(settings, with)},
};

/* The options of a run that a generated file needs. */
static const uint64_t taken =
    REQUEST_OPTION(integrator) | REQUEST_OPTION(from) | REQUEST_OPTION(space) |
    REQUEST_OPTION(solver) | REQUEST_OPTION(iterations) | REQUEST_OPTION(extend_energy) |
    REQUEST_OPTION(reactions) | REQUEST_OPTION(mechanics) | REQUEST_OPTION(effort) |
    REQUEST_OPTION(gauge) | REQUEST_OPTION(consistent) | REQUEST_OPTION(tolerance) |
    REQUEST_OPTION(set) | REQUEST_OPTION(start) | REQUEST_OPTION(system);

static int generate_text(settings *s)
{
    dal_run_spec spec;
    int status = simulation_make_spec(&s->simulation, &spec);
    if (status != CLI_DONE) return status;
    dal_error error = {0};
    char *text = NULL;
    const dal_generate_options options_of_file = {
        .lanes = (int)s->lanes, .prefix = s->prefix, .with_field = s->with == WITH_FIELD};
    dal_status made = dal_generate(&spec, &options_of_file, &text, &error);
    if (made != DAL_STATUS_OK)
        return cli_error(cli_input_exit(made), s->simulation.request.system_name, &error);
    if (strcmp(s->output, "-") != 0) {
        status = file_replace(s->output, text, strlen(text), FILE_SYNCED);
    } else {
        fputs(text, stdout);
        status = cli_close(stdout, "standard output");
    }
    free(text);
    return status;
}

static int generate(int argc, char **argv)
{
    settings s = {.simulation = simulation_default()};
    const cli_option_set sets[] = {
        CLI_OPTION_SET(options, &s),
        simulation_options(&s.simulation, request_options, ~taken),
    };
    int status = cli_read_arguments(&command_generate, argc, argv, sets, 2);
    if (status == CLI_GO_ON) status = generate_text(&s);
    simulation_free(&s.simulation);
    return status;
}

const cli_command command_generate = {
    .name = "generate",
    .synopsis = "dalembert generate SYSTEM [OPTION]... -o FILE.c",
    .about = "writes one C file that steps a system and needs nothing else",
    .notes = "The file is C11 and C++17, needs libm alone, and computes the same bits as "
             "'dalembert run'; its first comment says how to call it.  --set, --start and --from "
             "become its defaults, velocities that --consistent has moved, too; the step is given "
             "to each call.  With --tolerance each lane divides it by itself.\n",
    .run = generate,
};
