/* help.c - prints commands and their options, from their rows. */
#include "help.h"
#include "message.h"
#include "wrap.h"

#include <stdbool.h>
#include <string.h>

/* ---- options ------------------------------------------------------------------------------- */

/* Options are listed in this order. */
typedef enum option_kind { ARGUMENT, REQUIRED, OPTIONAL } option_kind;

static option_kind kind_of(const cli_option *option)
{
    if (!option->name) return ARGUMENT;
    return option->initial == CLI_REQUIRED ? REQUIRED : OPTIONAL;
}

typedef void option_printer(const char *name, const char *help);

/* Gives an option as "--samples N", and what it does with its default in brackets. */
static void describe_option(const cli_option *option, option_printer *print)
{
    const char *initial = option->initial == CLI_REQUIRED ? NULL : option->initial;
    const char *value = option->name && option->value ? option->value : "";
    char name[128], help[512];
    snprintf(name, sizeof name, "%s%s%s%s", option->name ? "--" : "",
             option->name ? option->name : option->value, *value ? " " : "", value);
    const bool has_short = option->name && strcmp(option->name, CLI_OUTPUT) == 0;
    snprintf(help, sizeof help, initial ? "%s%s (%.*s)" : "%s%s", option->help,
             has_short ? "; also " CLI_SHORT_OUTPUT : "", initial ? (int)strcspn(initial, "|") : 0,
             initial);
    print(name, help);
}

/* Describes the options of a kind in a set. */
static void describe_set(const cli_option_set *set, option_kind kind, option_printer *print)
{
    for (int k = 0; k < set->count; k++)
        if (!(set->without >> k & 1) && kind_of(&set->options[k]) == kind)
            describe_option(&set->options[k], print);
}

/* ---- for a terminal ------------------------------------------------------------------------ */

/* What it does is on the next line where the option is long. */
static void print_text(const char *name, const char *help)
{
    enum { HELP_COLUMN = 26 };
    int column = printf("  %s", name);
    if (column > HELP_COLUMN - 2) {
        putchar('\n');
        column = 0;
    }
    printf("%*s", HELP_COLUMN - column, "");
    cli_wrap(stdout, help, HELP_COLUMN, HELP_COLUMN);
}

/* Prints the options of a kind in a set below their headings; present is the last, or NULL. */
static void print_set(const cli_option_set *g, option_kind kind, const char **present)
{
    const bool is_first = !*present || strcmp(*present, "options") == 0;
    const char *heading = is_first ? "options" : "other options";
    for (int k = 0; k < g->count; k++) {
        const cli_option *option = &g->options[k];
        if (option->heading) heading = option->heading;
        if (g->without >> k & 1 || kind_of(option) != kind) continue;
        if (!*present || strcmp(*present, heading) != 0) printf("\n%s:\n", heading);
        *present = heading;
        describe_option(option, print_text);
    }
}

int cli_print_help(const cli_command *command, const cli_option_set *sets, int count)
{
    static const cli_option help = {.name = "help", .help = "print this"};
    const char *heading = NULL;
    cli_wrap(stdout, command->synopsis, printf("usage: "), 17);
    puts(command->about);
    puts("\narguments:");
    for (int g = 0; g < count; g++) describe_set(&sets[g], ARGUMENT, print_text);
    for (option_kind kind = REQUIRED; kind <= OPTIONAL; kind++)
        for (int g = 0; g < count; g++) print_set(&sets[g], kind, &heading);
    if (!heading) puts("\noptions:");
    describe_option(&help, print_text);
    if (command->notes) {
        putchar('\n');
        cli_wrap_notes(stdout, command->notes);
    }
    return cli_close(stdout, "standard output");
}

/* ---- Markdown ------------------------------------------------------------------------------ */

/* A text on one line, what has a meaning in Markdown escaped. */
static void put_escaped(const char *text, const char *end)
{
    for (const char *begin = text; text < end; text++) {
        const bool is_space = *text == ' ' || *text == '\n';
        if (is_space && text > begin && (text[-1] == ' ' || text[-1] == '\n')) continue;
        if (strchr("\\`*_<>[]|", *text)) putchar('\\');
        putchar(is_space ? ' ' : *text);
    }
    putchar('\n');
}

static void print_item(const char *name, const char *help)
{
    printf("- `%s`: ", name);
    put_escaped(help, help + strlen(help));
}

/* Blank lines separate paragraphs, line breaks items. */
static void print_notes(const char *notes)
{
    bool follows_item = false;
    while (*notes) {
        cli_paragraph p;
        notes = cli_next_paragraph(notes, &p);
        if (p.text == p.end) continue;
        if (!p.is_item || !follows_item) putchar('\n');
        if (p.name_length > 0)
            printf("- `%.*s`: ", p.name_length, p.name);
        else
            fputs(p.is_item ? "- " : "", stdout);
        put_escaped(p.text, p.end);
        follows_item = p.is_item;
    }
}

static bool is_own(const cli_command *command, const cli_option_set *set)
{
    return !set->owner || strcmp(set->owner, command->name) == 0;
}

static void refer_to_owner(const cli_option_set *set)
{
    const char *separator = ": ";
    printf("\nAs for [%s](#%s)", set->owner, set->owner);
    for (int k = 0; k < set->count; k++) {
        if (set->without >> k & 1 || !set->options[k].name) continue;
        printf("%s`--%s`", separator, set->options[k].name);
        separator = ", ";
    }
    puts(".");
}

int cli_print_reference(const cli_command *command, const cli_option_set *sets, int count)
{
    printf("## %s\n\n    %s\n\n", command->name, command->synopsis);
    /* "lists the commands" becomes "Lists the commands." */
    printf("%c%s.\n\n", command->about[0] - 'a' + 'A', command->about + 1);
    for (option_kind kind = ARGUMENT; kind <= OPTIONAL; kind++)
        for (int g = 0; g < count; g++)
            if (is_own(command, &sets[g])) describe_set(&sets[g], kind, print_item);
    for (int g = 0; g < count; g++)
        if (!is_own(command, &sets[g])) refer_to_owner(&sets[g]);
    if (command->notes) print_notes(command->notes);
    putchar('\n');
    return cli_close(stdout, "standard output");
}
