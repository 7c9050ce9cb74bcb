/* options.h - commands, and their options as rows of tables. */
#ifndef DAL_CLI_OPTIONS_H
#define DAL_CLI_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef struct cli_option cli_option;

/* Stores a text, given for an option, in the settings.  Returns CLI_DONE, or prints and returns an
 * exit status. */
typedef int cli_parser(void *settings, const cli_option *option, const char *text);

struct cli_option {
    const char *name;  /* without its dashes; NULL: an argument that is no option */
    const char *value; /* what --help calls its value, or its words: "auto|on|off"; NULL: a flag */
    const char *initial; /* its default, up to a '|'; NULL: none; CLI_REQUIRED: it must be given */
    const char *help;
    cli_parser *parse;
    size_t offset;   /* in the settings, of what the parsers below store */
    double min, max; /* of a number */
    /* Where --help lists it and the rows after it; NULL: as the row before it, or "options". */
    const char *heading;
};

extern const char CLI_REQUIRED[];

/* The one option with a short form. */
#define CLI_OUTPUT       "output"
#define CLI_SHORT_OUTPUT "-o"

/* Each stores one type: const char *, bool, double, long long, int or an enumeration. */
cli_parser cli_parse_text, cli_parse_flag, cli_parse_number, cli_parse_integer, cli_parse_word;

/* The end of a row: which parser stores which member of the settings, and the range of a number. */
#define CLI_ROW(parser, settings, member) .parse = parser, .offset = offsetof(settings, member)
#define CLI_TEXT(settings, member)        CLI_ROW(cli_parse_text, settings, member)
#define CLI_FLAG(settings, member)        CLI_ROW(cli_parse_flag, settings, member)
#define CLI_WORD(settings, member)        CLI_ROW(cli_parse_word, settings, member)
#define CLI_NUMBER(settings, member, least, greatest)                                              \
    CLI_ROW(cli_parse_number, settings, member), .min = least, .max = greatest
#define CLI_INTEGER(settings, member, least, greatest)                                             \
    CLI_ROW(cli_parse_integer, settings, member), .min = least, .max = greatest

/* Options that fill one struct. */
typedef struct cli_option_set cli_option_set;
struct cli_option_set {
    const cli_option *options;
    int count;
    void *settings;
    const char **texts; /* [count] receives what was given; or NULL */
    uint64_t without;   /* bit k: the command does not take option k */
    const char *owner;  /* the command whose reference describes them; NULL: each one's own */
    /* Completes the settings when all arguments have been read, with that exit status; or NULL.
     * Returns CLI_DONE, or prints and returns an exit status. */
    int (*complete)(const cli_option_set *set, int status);
};

/* The rows of a command that fill its settings. */
#define CLI_OPTION_SET(rows, target)                                                               \
    (cli_option_set) { .options = rows, .count = sizeof rows / sizeof *rows, .settings = target }

typedef struct cli_command {
    const char *name, *synopsis, *about;
    const char *notes; /* further paragraphs of --help */
    int (*run)(int argc, char **argv);
} cli_command;

/* Stores the defaults; those that are none for a parser are a mistake of the program. */
void cli_set_defaults(const cli_option *options, int count, void *settings);
/* The name here of an option that other programs call otherwise: step for dt; or NULL. */
const char *cli_synonym(const char *name);
/* The present name of an option that was renamed, and of a value of an option; or NULL. */
const char *cli_renamed_option(const char *name);
const char *cli_renamed_value(const char *option, const char *text);

/* A finite number, or an integer (1e6 is one) in min..max.  what names it in the message, "--time".
 * Return CLI_DONE or CLI_USAGE. */
int cli_number(const char *what, const char *text, double *number);
int cli_integer(const char *what, const char *text, long long min, long long max,
                long long *number);

#endif
