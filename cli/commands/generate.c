/* generate.c - `dalembert generate`: one C file that steps one system, needing nothing else. */
#include "dalembert_codegen.h"
#include "io/file.h"
#include "run/request.h"
#include "ui/cli.h"

#include <stdlib.h>
#include <string.h>

/* name, value, default, help */
#define OWN_LIST(X)                                                                                \
    X(output, "FILE|-", "-", "write there, or to stdout; also -o")                                 \
    X(lanes, "W", "1", "step 1, 2, 4, 8 or 16 systems at a time")                                  \
    X(prefix, "NAME", NULL, "what public names begin with (SYSTEM_INTEGRATOR)")

/* The options of a request that a generated file has a use for. */
#define TAKEN_LIST(X)                                                                              \
    X(integrator) X(space) X(solver) X(iterations) X(extend_energy) X(set) X(start)

enum {
    OWN_LIST(CLI_OWN)
#define X(name) TAKEN_##name,
        TAKEN_LIST(X)
#undef X
            OPTIONS,
    TAKEN_FIRST = TAKEN_integrator
};

static const int taken[] = {
#define X(name) REQUEST_##name,
    TAKEN_LIST(X)
#undef X
};

static const char notes[] =
    "SYSTEM is a built-in name or the path of a system file.  The file is C11 and C++17, needs "
    "libm\n"
    "alone, and computes the same bits as 'dalembert run'; its first comment says how to call it.\n"
    "--set and --start become its defaults; the step is given to each call.\n";

typedef struct generate_wishes {
    const char *output, *prefix;
    long long lanes;
} generate_wishes;

static void list_options(cli_option *options)
{
    static const cli_option own[] = {OWN_LIST(CLI_OPTION)};
    cli_option all[REQUEST_OPTIONS];
    request_list_options(all);
    memcpy(options, own, sizeof own);
    for (int i = TAKEN_FIRST; i < OPTIONS; i++) options[i] = all[taken[i - TAKEN_FIRST]];
}

static int write_text(const char *text, const char *output)
{
    if (strcmp(output, "-") != 0) return file_replace(output, text, strlen(text), 1);
    fputs(text, stdout);
    return cli_close(stdout, "standard output");
}

static int generate(run_request *request, const generate_wishes *wishes)
{
    if (!request->system_name) return cli_fail(CLI_USAGE, "generate: the SYSTEM is missing");
    if (!request->text[REQUEST_integrator])
        return cli_fail(CLI_USAGE, "generate: --integrator is missing");
    dal_run_spec spec;
    int status = request_make_spec(request, &spec);
    if (status != CLI_DONE) return status;
    dal_error error = {0};
    char *text = NULL;
    dal_status made = dal_generate(&spec, (int)wishes->lanes, wishes->prefix, &text, &error);
    if (made != DAL_OK) return cli_error(cli_input_exit(made), request->system_name, &error);
    status = write_text(text, wishes->output);
    free(text);
    return status;
}

static int take(run_request *request, generate_wishes *wishes, int option, const char *value)
{
    switch (option) {
    case CLI_PLAIN:
        if (request->system_name)
            return cli_fail(CLI_USAGE, "generate: one SYSTEM only, not also '%s'", value);
        request->system_name = value;
        return CLI_DONE;
    case OWN_output:
        wishes->output = value;
        return CLI_DONE;
    case OWN_prefix:
        wishes->prefix = value;
        return CLI_DONE;
    case OWN_lanes:
        return cli_integer("--lanes", value, 1, 16, &wishes->lanes);
    default:
        return request_parse_option(request, taken[option - TAKEN_FIRST], value);
    }
}

int command_generate(int argc, char **argv)
{
    static char output[] = "--output"; /* what the usual -o stands for */
    cli_option options[OPTIONS];
    list_options(options);
    for (int i = 1; i < argc; i++)
        if (strcmp(argv[i], "-o") == 0) argv[i] = output;
    cli_args args = cli_begin(argc, argv, options, OPTIONS, notes);
    run_request request = request_default();
    generate_wishes wishes = {.output = "-", .lanes = 1};
    const char *value;
    for (int k; (k = cli_next(&args, &value)) != CLI_STOP;) {
        int status = take(&request, &wishes, k, value);
        if (status != CLI_DONE) cli_stop(&args, status);
    }
    int status = args.status;
    if (status == CLI_GO_ON) status = generate(&request, &wishes);
    request_free(&request);
    return status;
}
