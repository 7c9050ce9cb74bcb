/* main.c - the program `dalembert`: finds the command and gives it the arguments. */
#include "ui/cli.h"

#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

static const char *const names[] = {
#define X(name, synopsis, about) #name,
    COMMAND_LIST(X)
#undef X
};

/* What a lone option of the program itself asks for; -1 for none. */
static int own_option(const char *argument)
{
    static const char *const own[] = {"--help", "--version"};
    if (strcmp(argument, "--help") == 0 || strcmp(argument, "-h") == 0)
        cli_usage(stdout);
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
        cli_usage(stdout);
        return cli_close(stdout, "standard output");
    }
    int status = own_option(argv[1]);
    if (status != CLI_GO_ON) return status;
    const cli_command *found = cli_find(argv[1]);
    if (!found) return cli_unknown("command", argv[1], names, sizeof names / sizeof names[0]);
    return found->call(argc - 1, argv + 1);
}
