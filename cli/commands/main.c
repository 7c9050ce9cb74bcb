/* main.c - the program `dalembert`: finds the command and gives it the arguments. */
#include "dalembert.h"
#include "ui/commands.h"
#include "ui/message.h"
#include "ui/options.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const cli_command *const commands[] = {
#define ADDRESS(name) &command_##name,
    COMMAND_LIST(ADDRESS)
#undef ADDRESS
};

enum { COMMANDS = sizeof commands / sizeof *commands };

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

static void print_usage(FILE *out)
{
    fputs("usage: dalembert COMMAND [ARGUMENT]...\n"
          "Geometric integrators for nonholonomic mechanics.\n\ncommands:\n",
          out);
    for (int i = 0; i < COMMANDS; i++)
        fprintf(out, "  %-8s %s\n", commands[i]->name, commands[i]->about);
    fputs("\n'dalembert COMMAND --help' describes a command.\n", out);
    print_exits(out);
}

/* What a lone option of the program itself asks for; -1 for none. */
static int own_option(const char *argument)
{
    static const char *const own[] = {"--help", "--version"};
    if (strcmp(argument, "--help") == 0 || strcmp(argument, "-h") == 0)
        print_usage(stdout);
    else if (strcmp(argument, "--version") == 0)
        puts("dalembert " DAL_VERSION);
    else
        return argument[0] == '-' ? cli_unknown("option", argument, own, 2) : CLI_GO_ON;
    return cli_close(stdout, "standard output");
}

/* A file opened while a standard stream is closed would take its number, and messages would end
 * up among the rows.  What is opened here cannot be written to, so that a closed standard output
 * is a failing write as before. */
static void occupy_standard_streams(void)
{
    int descriptor;
    do descriptor = open("/dev/null", O_RDONLY);
    while (descriptor >= 0 && descriptor <= STDERR_FILENO);
    if (descriptor >= 0) close(descriptor);
}

int main(int argc, char **argv)
{
    occupy_standard_streams();
    /* A limit on the size of files is then a failing write like any other. */
    signal(SIGXFSZ, SIG_IGN);
    if (argc < 2) {
        print_usage(stdout);
        return cli_close(stdout, "standard output");
    }
    int status = own_option(argv[1]);
    if (status != CLI_GO_ON) return status;
    const char *names[COMMANDS];
    for (int i = 0; i < COMMANDS; i++) {
        names[i] = commands[i]->name;
        if (strcmp(names[i], argv[1]) == 0) return commands[i]->run(argc - 1, argv + 1);
    }
    return cli_unknown("command", argv[1], names, COMMANDS);
}
