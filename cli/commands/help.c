/* help.c - `dalembert help`: the commands, one of them, or a reference of all. */
#include "ui/help.h"
#include "ui/arguments.h"
#include "ui/commands.h"
#include "ui/message.h"

#include <stdio.h>
#include <string.h>

const cli_command *const cli_commands[COMMANDS] = {
#define ADDRESS(name) &command_##name,
    COMMAND_LIST(ADDRESS)
#undef ADDRESS
};

typedef struct settings {
    const char *command;
    bool markdown;
} settings;

static const cli_option options[] = {
    {"markdown", NULL, NULL, "prints the reference of all commands, or of one, as Markdown",
     CLI_FLAG(settings, markdown)},
    {NULL, "COMMAND", NULL, "describes this command; without it, all are listed",
     CLI_TEXT(settings, command)},
};

static void print_exits(const char *format)
{
#define PRINT_EXIT(code, number, text) printf(format, number, text);
    CLI_EXIT_LIST(PRINT_EXIT)
#undef PRINT_EXIT
}

static int print_usage(void)
{
    puts("usage: dalembert COMMAND [ARGUMENT]...\n"
         "Geometric integrators for nonholonomic mechanics.\n\ncommands:");
    for (int i = 0; i < COMMANDS; i++)
        printf("  %-8s %s\n", cli_commands[i]->name, cli_commands[i]->about);
    puts("\n'dalembert COMMAND --help' describes a command.\n\nexit status:");
    print_exits("  %-4d %s\n");
    return cli_close(stdout, "standard output");
}

/* The options of a command are known to the command alone, which prints them. */
static char text_help[] = "--help", markdown_help[] = CLI_HELP_MARKDOWN;
static int print_command(const cli_command *command, char *help_option)
{
    char name[24];
    snprintf(name, sizeof name, "%s", command->name);
    return command->run(2, (char *[]){name, help_option, NULL});
}

static int print_reference(void)
{
    int status = CLI_DONE;
    for (int i = 0; i < COMMANDS && status == CLI_DONE; i++)
        status = print_command(cli_commands[i], markdown_help);
    if (status != CLI_DONE) return status;
    puts("## Exit status\n");
    print_exits("- `%d`: %s\n");
    return cli_close(stdout, "standard output");
}

static int help(int argc, char **argv)
{
    settings s = {0};
    const cli_option_set set = CLI_OPTION_SET(options, &s);
    const int status = cli_read_arguments(&command_help, argc, argv, &set, 1);
    if (status != CLI_GO_ON) return status;
    if (!s.command) return s.markdown ? print_reference() : print_usage();
    const char *names[COMMANDS];
    for (int i = 0; i < COMMANDS; i++) {
        names[i] = cli_commands[i]->name;
        if (strcmp(names[i], s.command) == 0)
            return print_command(cli_commands[i], s.markdown ? markdown_help : text_help);
    }
    return cli_unknown("command", s.command, names, COMMANDS);
}

const cli_command command_help = {
    .name = "help",
    .synopsis = "dalembert help [COMMAND] [OPTION]...",
    .about = "lists the commands, or describes one",
    .run = help,
};
