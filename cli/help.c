/* help.c - the commands of the program, and what --help says. */
#include "cli.h"

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
    fputs(
        "\n'dalembert COMMAND --help' tells about a command, 'dalembert --version' the version.\n",
        out);
    print_exits(out);
}

void cli_help(FILE *out, const char *name, const cli_option *options, int count, const char *notes)
{
    const cli_command *found = cli_find(name);
    if (found)
        fprintf(out, "usage: dalembert %s %s\n%s\n", name, found->synopsis, found->about);
    else
        fprintf(out, "usage: %s [OPTION]...\n", name);
    fputs("\noptions:\n", out);
    for (int i = 0; i < count; i++) {
        char left[64];
        snprintf(left, sizeof left, "--%s%s%s", options[i].name, options[i].value ? " " : "",
                 options[i].value ? options[i].value : "");
        fprintf(out, "  %-36s %s", left, options[i].help);
        const char *initial = options[i].initial;
        if (initial) fprintf(out, " (%.*s)", (int)strcspn(initial, "|"), initial);
        fputc('\n', out);
    }
    fprintf(out, "  %-36s %s\n", "--help", "print this");
    if (notes) fprintf(out, "\n%s", notes);
}
