/* args.c - reading of arguments, numbers and settings. */
#include "cli.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NAMES_MOST = 64 };

cli_args cli_begin(int argc, char **argv, const cli_option *options, int count, const char *notes)
{
    return (cli_args){.options = options,
                      .count = count,
                      .notes = notes,
                      .argc = argc,
                      .argv = argv,
                      .next = 1,
                      .status = CLI_GO_ON};
}

void cli_stop(cli_args *args, int exit_status) { args->status = exit_status; }

static int stop(cli_args *args, int exit_status)
{
    cli_stop(args, exit_status);
    return CLI_STOP;
}

static int help(cli_args *args)
{
    cli_help(stdout, args->argv[0], args->options, args->count, args->notes);
    return stop(args, cli_close(stdout, "standard output"));
}

static int unknown(cli_args *args, const char *argument, size_t length)
{
    const char *names[NAMES_MOST];
    int count = 0;
    for (int i = 0; i < args->count && count < NAMES_MOST - 1; i++)
        names[count++] = args->options[i].name;
    names[count++] = "help";
    char *name = cli_strndup(argument, length);
    const char *bare = name + strspn(name, "-");
    const char *nearest = dal_nearest(bare, names, count);
    int status = nearest ? cli_fail(CLI_USAGE, "%s: unknown option '%s'; did you mean '--%s'?",
                                    args->argv[0], name, nearest)
                         : cli_fail(CLI_USAGE, "%s: unknown option '%s'", args->argv[0], name);
    free(name);
    return stop(args, status);
}

/* The value of option k, behind its '=' or in the next argument. */
static int take(cli_args *args, int k, const char *equals, const char **value)
{
    const cli_option *option = &args->options[k];
    const char *name = option->name;
    if (!option->value) {
        if (equals) return stop(args, cli_fail(CLI_USAGE, "--%s takes no value", name));
        *value = NULL;
    } else if (equals) {
        *value = equals + 1;
    } else {
        const char *following = args->next < args->argc ? args->argv[args->next] : NULL;
        if (!following || strncmp(following, "--", 2) == 0)
            return stop(args, cli_fail(CLI_USAGE, "--%s needs a value: --%s %s", name, name,
                                       option->value));
        *value = following;
        args->next++;
    }
    return k;
}

static int is_plain(const cli_args *args, const char *argument)
{
    return args->plain || argument[0] != '-' || argument[1] == '\0';
}

int cli_next(cli_args *args, const char **value)
{
    if (args->status != CLI_GO_ON || args->next >= args->argc) return CLI_STOP;
    const char *argument = args->argv[args->next++];
    if (!args->plain && strcmp(argument, "--") == 0) {
        args->plain = 1;
        return cli_next(args, value);
    }
    if (is_plain(args, argument)) {
        *value = argument;
        return CLI_PLAIN;
    }
    if (strcmp(argument, "--help") == 0 || strcmp(argument, "-h") == 0) return help(args);
    const char *equals = strchr(argument, '=');
    size_t length = equals ? (size_t)(equals - argument) : strlen(argument);
    for (int k = 0; length > 2 && argument[1] == '-' && k < args->count; k++) {
        const char *name = args->options[k].name;
        if (strlen(name) == length - 2 && memcmp(name, argument + 2, length - 2) == 0)
            return take(args, k, equals, value);
    }
    return unknown(args, argument, length);
}

/* ---- numbers ------------------------------------------------------------------------------- */

int cli_number(const char *what, const char *text, double *number)
{
    dal_status read = dal_parse_number(text, strlen(text), number);
    if (read == DAL_TOO_LARGE) return cli_fail(CLI_USAGE, "%s: '%s' is too large", what, text);
    if (read != DAL_OK) return cli_fail(CLI_USAGE, "%s: '%s' is not a number", what, text);
    return CLI_DONE;
}

int cli_integer(const char *what, const char *text, long long least, long long greatest,
                long long *number)
{
    double x;
    if (cli_number(what, text, &x) != CLI_DONE) return CLI_USAGE;
    if (x != floor(x)) return cli_fail(CLI_USAGE, "%s: %s is not an integer", what, text);
    if (!(x >= (double)least && x <= (double)greatest))
        return cli_fail(CLI_USAGE, "%s: %s is not in %lld..%lld", what, text, least, greatest);
    *number = (long long)x;
    return CLI_DONE;
}

int cli_word(const char *what, const char *text, const char *const *words, int count)
{
    char list[256];
    int length = 0;
    for (int i = 0; i < count; i++) {
        if (strcmp(words[i], text) == 0) return i;
        const char *separator = i == 0 ? "" : i == count - 1 ? " or " : ", ";
        length +=
            snprintf(list + length, sizeof list - (size_t)length, "%s%s", separator, words[i]);
    }
    cli_fail(CLI_USAGE, "%s: '%s' is not %s", what, text, list);
    return -1;
}

static int is_infinity(const char *text)
{
    return strcmp(text, "inf") == 0 || strcmp(text, "+inf") == 0 || strcmp(text, "infinity") == 0;
}

int cli_setting(const char *what, const char *text, dal_setting *setting)
{
    const char *equals = strchr(text, '=');
    if (!equals || equals == text)
        return cli_fail(CLI_USAGE, "%s: '%s' is not NAME=VALUE", what, text);
    char *name = cli_strndup(text, (size_t)(equals - text));
    int status = CLI_DONE;
    if (strcmp(name, "e") == 0 && is_infinity(equals + 1))
        setting->value = INFINITY;
    else
        status = cli_number(text, equals + 1, &setting->value);
    if (status == CLI_DONE)
        setting->name = name;
    else
        free(name);
    return status;
}
