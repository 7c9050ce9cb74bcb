/* main.c - the program `dalembert`: finds the command and gives it the arguments. */
#include "cli.h"

#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

typedef struct command {
    const char *name, *synopsis, *about;
    int (*call)(int argc, char **argv);
} command;

static const command commands[] = {
#define X(name, synopsis, about) {#name, synopsis, about, command_##name},
    COMMAND_LIST(X)
#undef X
};

static const char *const names[] = {
#define X(name, synopsis, about) #name,
    COMMAND_LIST(X)
#undef X
};

enum { COMMANDS = sizeof commands / sizeof commands[0] };

static const command *find(const char *name)
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

static void print_usage(FILE *out)
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
    const command *found = find(name);
    fprintf(out, "usage: dalembert %s %s\n%s\n\noptions:\n", name, found ? found->synopsis : "",
            found ? found->about : "");
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
    const command *found = find(argv[1]);
    if (!found) return cli_unknown("command", argv[1], names, COMMANDS);
    return found->call(argc - 1, argv + 1);
}
