/* help.c - `dalembert help`: the commands, one of them, or a reference of all. */
#include "ui/help.h"
#include "ui/commands.h"
#include "ui/message.h"
#include "ui/options.h"

#include <stdio.h>
#include <string.h>

static const cli_command *const commands[] = {
#define ADDRESS(name) &command_##name,
    COMMAND_LIST(ADDRESS)
#undef ADDRESS
};

enum { COMMANDS = sizeof commands / sizeof *commands };

typedef struct settings {
    const char *command;
    bool markdown, man;
} settings;

static const cli_option options[] = {
    {"markdown", NULL, NULL, "prints the reference of all commands, or of one, as Markdown",
     CLI_FLAG(settings, markdown)},
    {"man", NULL, NULL, "the same as a part of a manual page", CLI_FLAG(settings, man)},
    {NULL, "COMMAND", NULL, "describes this command; without it, all are listed",
     CLI_TEXT(settings, command)},
};

static int print_usage(void)
{
    puts("usage: dalembert COMMAND [ARGUMENT]...\n"
         "Geometric integrators for nonholonomic mechanics.\n\ncommands:");
    for (int i = 0; i < COMMANDS; i++) printf("  %-8s %s\n", commands[i]->name, commands[i]->about);
    puts("\n'dalembert COMMAND --help' describes a command.\n");
    cli_print_exits(CLI_HELP_TEXT);
    return cli_close(stdout, "standard output");
}

/* The options of a command are known to the command alone, which prints them. */
static int print_command(const cli_command *command, cli_help_format format)
{
    static char arguments[][24] = {
#define ARGUMENT(code, word) "--help=" word,
        CLI_HELP_FORMAT_LIST(ARGUMENT)
#undef ARGUMENT
    };
    char name[24];
    snprintf(name, sizeof name, "%s", command->name);
    return command->run(2, (char *[]){name, arguments[format], NULL});
}

static int print_reference(cli_help_format format)
{
    int status = CLI_DONE;
    if (format == CLI_HELP_MAN) puts(".SH COMMANDS");
    for (int i = 0; i < COMMANDS && status == CLI_DONE; i++)
        status = print_command(commands[i], format);
    cli_print_exits(format);
    const int closed = cli_close(stdout, "standard output");
    return status == CLI_DONE ? closed : status;
}

static int help(int argc, char **argv)
{
    settings s = {0};
    const cli_group group = CLI_GROUP(options, &s);
    const int status = cli_read_arguments(&command_help, argc, argv, &group, 1);
    if (status != CLI_GO_ON) return status;
    const cli_help_format format = s.markdown ? CLI_HELP_MARKDOWN
                                   : s.man    ? CLI_HELP_MAN
                                              : CLI_HELP_TEXT;
    if (!s.command) return format == CLI_HELP_TEXT ? print_usage() : print_reference(format);
    const char *names[COMMANDS];
    for (int i = 0; i < COMMANDS; i++) {
        names[i] = commands[i]->name;
        if (strcmp(names[i], s.command) == 0) return print_command(commands[i], format);
    }
    return cli_unknown("command", s.command, names, COMMANDS);
}

const cli_command command_help = {
    .name = "help",
    .synopsis = "dalembert help [COMMAND] [OPTION]...",
    .about = "lists the commands, or describes one",
    .run = help,
};
