/* main.c - the program `dalembert`: runs a command. */
#include "dalembert.h"
#include "dalembert_program.h"
#include "ui/commands.h"
#include "ui/message.h"
#include "ui/options.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* A file opened while a standard stream is closed would take its number, and messages would mix
 * with rows.  The descriptors opened here are read-only: a write to a closed standard output still
 * fails. */
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
    /* A write beyond a limit on the size of files then fails as any other. */
    signal(SIGXFSZ, SIG_IGN);
    static const char *const options[] = {"--help", "--version"};
    static char help[] = "help";
    const char *first = argc > 1 ? argv[1] : "--help";
    if (strcmp(first, "--help") == 0 || strcmp(first, "-h") == 0)
        return command_help.run(1, (char *[]){help, NULL});
    if (strcmp(first, "--version") == 0) {
        puts("dalembert " DAL_VERSION);
        return cli_close(stdout, "standard output");
    }
    if (first[0] == '-') return cli_unknown("option", first, options, 2);
    const char *names[COMMANDS];
    for (int i = 0; i < COMMANDS; i++) {
        names[i] = cli_commands[i]->name;
        if (strcmp(names[i], first) == 0) return cli_commands[i]->run(argc - 1, argv + 1);
    }
    if (dal__nearest_name(first, names, COMMANDS))
        return cli_unknown("command", first, names, COMMANDS);
    return cli_fail(CLI_USAGE, "unknown command '%s'; 'dalembert help' lists the commands", first);
}
