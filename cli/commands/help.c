/* help.c - the commands of the program, and what --help says. */
#include "ui/cli.h"

#include <string.h>

static const cli_command commands[] = {
#define X(name, synopsis, about) {#name, synopsis, about, command_##name},
    COMMAND_LIST(X)
#undef X
};

enum { COMMANDS = sizeof commands / sizeof commands[0] };

const cli_command *cli_find(const char *name)
{
    for (int i = 0; i < COMMANDS; i++)
        if (strcmp(commands[i].name, name) == 0) return &commands[i];
    return NULL;
}

static void print_exits(FILE *out)
{
    static const struct {
        int number;
        const char *text;
    } exits[] = {
#define X(code, number, text) {number, text},
        CLI_EXIT_LIST(X)
#undef X
    };
    fputs("\nexit status:\n", out);
    for (size_t i = 0; i < sizeof exits / sizeof exits[0]; i++)
        fprintf(out, "  %-4d %s\n", exits[i].number, exits[i].text);
}

void cli_usage(FILE *out)
{
    fputs("usage: dalembert COMMAND [ARGUMENT]...\n"
          "Geometric integrators for nonholonomic mechanics.\n\ncommands:\n",
          out);
    for (int i = 0; i < COMMANDS; i++)
        fprintf(out, "  %-8s %s\n", commands[i].name, commands[i].about);
    fputs("\n'dalembert COMMAND --help' tells about a command, 'dalembert --version' of\n"
          "the program.\n",
          out);
    print_exits(out);
}

/* Options in front, what they do behind, below a long one. */
static void print_option(FILE *out, const cli_option *option)
{
    enum { BEHIND = 26 };
    char text[512];
    int column = fprintf(out, option->value ? "  --%s %s" : "  --%s%s", option->name,
                         option->value ? option->value : "");
    if (column > BEHIND - 2) {
        fputc('\n', out);
        column = 0;
    }
    fprintf(out, "%*s", BEHIND - column, "");
    snprintf(text, sizeof text, option->initial ? "%s (%.*s)" : "%s", option->help,
             option->initial ? (int)strcspn(option->initial, "|") : 0, option->initial);
    cli_fold(out, text, BEHIND, BEHIND);
}

void cli_help(FILE *out, const char *name, const cli_option *options, int count, const char *notes)
{
    static const cli_option help = {"help", NULL, "print this", NULL};
    const cli_command *found = cli_find(name);
    if (found) {
        const int column = fprintf(out, "usage: dalembert %s ", name);
        cli_fold(out, found->synopsis, column, 17);
        fprintf(out, "%s\n", found->about);
    } else {
        fprintf(out, "usage: %s [OPTION]...\n", name);
    }
    fputs("\noptions:\n", out);
    for (int i = 0; i < count; i++) print_option(out, &options[i]);
    print_option(out, &help);
    if (!notes) return;
    fputc('\n', out);
    cli_fold_notes(out, notes);
}
