/* show.c - `dalembert show`: the file of a built-in system. */
#include "io/file_output.h"
#include "run/system.h"
#include "ui/arguments.h"
#include "ui/commands.h"
#include "ui/message.h"

#include <stdio.h>
#include <string.h>

typedef struct settings {
    const char *system, *output;
} settings;

static const cli_option options[] = {
    {"output", "FILE|-", "-", "writes a new file, or to standard output",
     CLI_TEXT(settings, output)},
    {NULL, "SYSTEM", CLI_REQUIRED, "a built-in system", CLI_TEXT(settings, system)},
};

static int show(int argc, char **argv)
{
    settings s = {0};
    const cli_option_set set = CLI_OPTION_SET(options, &s);
    const int status = cli_read_arguments(&command_show, argc, argv, &set, 1);
    if (status != CLI_GO_ON) return status;
    const char *text = dal_builtin_text(s.system), *names[CLI_MAX_BUILTINS];
    if (!text) return cli_unknown("system", s.system, names, cli_builtins(names));
    if (strcmp(s.output, "-") != 0) return file_create(s.output, text, strlen(text));
    fputs(text, stdout);
    return cli_close(stdout, "standard output");
}

const cli_command command_show = {
    .name = "show",
    .synopsis = "dalembert show SYSTEM [-o FILE.yaml]",
    .about = "prints the file of a built-in system",
    .notes = "The file is a system like any other: dalembert run FILE.yaml.  One that exists is "
             "never overwritten.\n",
    .run = show,
};
