/* new.c - `dalembert new`: a system file to begin with. */
#include "io/file.h"
#include "io/file_output.h"
#include "ui/arguments.h"
#include "ui/commands.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <stdlib.h>
#include <string.h>

extern const char system_template[]; /* template.yaml, embedded when the program is built */

typedef struct settings {
    const char *name;
} settings;

static const cli_option options[] = {
    {NULL, "NAME", CLI_REQUIRED, "the file without or with its .yaml", CLI_TEXT(settings, name)},
};

static int new_system(int argc, char **argv)
{
    settings s = {0};
    const cli_option_set set = CLI_OPTION_SET(options, &s);
    int status = cli_read_arguments(&command_new, argc, argv, &set, 1);
    if (status != CLI_GO_ON) return status;
    char *path = cli_format("%s%s", s.name, cli_ends_in(s.name, ".yaml") ? "" : ".yaml");
    status = file_create(path, system_template, strlen(system_template));
    if (status == CLI_DONE) cli_note("wrote '%s': dalembert run %s", path, path);
    free(path);
    return status;
}

const cli_command command_new = {
    .name = "new",
    .synopsis = "dalembert new NAME",
    .about = "writes NAME.yaml, a commented system to begin with",
    .notes = "The system runs as written.  A file that exists is never "
             "overwritten.\n",
    .run = new_system,
};
