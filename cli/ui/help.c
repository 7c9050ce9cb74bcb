/* help.c - prints commands and their options, from their rows, for a terminal, as Markdown or as a
 * part of a manual page. */
#include "help.h"
#include "message.h"
#include "wrap.h"

#include <string.h>

bool cli_is_help(const char *argument, cli_help_format *format)
{
    static const char *const words[] = {
#define FORMAT_WORD(code, word) "--help=" word,
        CLI_HELP_FORMAT_LIST(FORMAT_WORD)
#undef FORMAT_WORD
    };
    *format = CLI_HELP_TEXT;
    if (strcmp(argument, "-h") == 0 || strcmp(argument, "--help") == 0) return true;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(argument, words[i]) == 0) {
            *format = (cli_help_format)i;
            return true;
        }
    return false;
}

/* ---- texts --------------------------------------------------------------------------------- */

/* A text on one line, what has a meaning in the format escaped. */
static void put_escaped(const char *text, int length, cli_help_format format)
{
    for (int i = 0; i < length; i++) {
        const char c = text[i] == '\n' ? ' ' : text[i];
        if (c == ' ' && i > 0 && (text[i - 1] == ' ' || text[i - 1] == '\n')) continue;
        if (format == CLI_HELP_MARKDOWN && strchr("\\`*_<>[]|", c)) putchar('\\');
        if (format == CLI_HELP_MAN && (c == '\\' || c == '\'' || (c == '.' && i == 0)))
            fputs(c == '\\' ? "\\e" : c == '\'' ? "\\(aq" : "\\&.", stdout);
        else
            fputs(format == CLI_HELP_MAN && c == '-' ? "\\-" : (char[]){c, '\0'}, stdout);
    }
}

/* The text begins with a small letter. */
static void put_sentence(const char *text, cli_help_format format)
{
    putchar(*text - 'a' + 'A');
    put_escaped(text + 1, (int)strlen(text + 1), format);
    puts(".");
}

static void begin_item(const char *name, int length, cli_help_format format)
{
    if (format == CLI_HELP_MARKDOWN) {
        printf("- `%.*s`: ", length, name);
    } else {
        fputs(".TP\n.B \"", stdout);
        put_escaped(name, length, format);
        puts("\"");
    }
}

/* Paragraphs stand apart, items below each other. */
static void print_notes(const char *notes, cli_help_format format)
{
    bool follows_item = false;
    while (*notes) {
        cli_paragraph p;
        notes = cli_next_paragraph(notes, &p);
        if (p.text == p.end) continue;
        if (!p.is_item)
            puts(format == CLI_HELP_MARKDOWN ? "" : ".PP");
        else if (!follows_item && format == CLI_HELP_MARKDOWN)
            putchar('\n');
        if (p.name_length > 0)
            begin_item(p.name, p.name_length, format);
        else if (p.is_item)
            fputs(format == CLI_HELP_MARKDOWN ? "- " : ".IP \\(bu 2\n", stdout);
        put_escaped(p.text, (int)(p.end - p.text), format);
        putchar('\n');
        follows_item = p.is_item;
    }
}

/* ---- options ------------------------------------------------------------------------------- */

/* "--samples N" */
static int format_option(char *text, size_t size, const cli_option *option)
{
    const char *value = option->name && option->value ? option->value : "";
    return snprintf(text, size, "%s%s%s%s", option->name ? "--" : "",
                    option->name ? option->name : option->value, *value ? " " : "", value);
}

/* The option, then what it does and its default; on the next line where the option is long. */
static void print_option(const cli_option *option, cli_help_format format)
{
    enum { HELP_COLUMN = 26 };
    const char *initial = option->initial == CLI_REQUIRED ? NULL : option->initial;
    char name[128], help[512];
    const int length = format_option(name, sizeof name, option);
    snprintf(help, sizeof help, initial ? "%s (%.*s)" : "%s", option->help,
             initial ? (int)strcspn(initial, "|") : 0, initial);
    if (format != CLI_HELP_TEXT) {
        begin_item(name, length, format);
        put_escaped(help, (int)strlen(help), format);
        putchar('\n');
        return;
    }
    const bool is_long = length > HELP_COLUMN - 4;
    printf("  %s%s%*s", name, is_long ? "\n" : "", is_long ? HELP_COLUMN : HELP_COLUMN - length - 2,
           "");
    cli_wrap(stdout, help, HELP_COLUMN, HELP_COLUMN);
}

/* Options are listed in this order. */
typedef enum option_kind { ARGUMENT, REQUIRED, OPTIONAL } option_kind;

static option_kind kind_of(const cli_option *option)
{
    if (!option->name) return ARGUMENT;
    return option->initial == CLI_REQUIRED ? REQUIRED : OPTIONAL;
}

/* The reference describes an option where its owner stands. */
static bool is_elsewhere(const cli_command *command, const cli_group *group, cli_help_format format)
{
    return format != CLI_HELP_TEXT && group->owner && strcmp(group->owner, command->name) != 0;
}

/* Prints the title before the first of a kind; returns it while there is none. */
static const char *print_options(const char *title, const cli_command *command,
                                 const cli_group *groups, int count, option_kind kind,
                                 cli_help_format format)
{
    for (const cli_group *g = groups; g < groups + count; g++)
        for (int k = 0; k < g->count && !is_elsewhere(command, g, format); k++) {
            if (g->without >> k & 1 || kind_of(&g->options[k]) != kind) continue;
            fputs(title, stdout);
            print_option(&g->options[k], format);
            title = "";
        }
    return title;
}

/* "As for run: --step, --set." */
static void refer_to_owner(const cli_command *command, const cli_group *g, cli_help_format format)
{
    const bool is_markdown = format == CLI_HELP_MARKDOWN;
    const char *separator = ": ";
    if (!is_elsewhere(command, g, format)) return;
    printf(is_markdown ? "\nAs for [%s](#%s)" : ".PP\nAs for %s", g->owner, g->owner);
    for (int k = 0; k < g->count; k++) {
        const char *name = g->options[k].name;
        if (!name || g->without >> k & 1) continue;
        printf(is_markdown ? "%s`--" : "%s\\-\\-", separator);
        put_escaped(name, (int)strlen(name), format);
        fputs(is_markdown ? "`" : "", stdout);
        separator = ", ";
    }
    puts(".");
}

/* ---- a command ----------------------------------------------------------------------------- */

static void print_reference(const cli_command *command, const cli_group *groups, int count,
                            cli_help_format format)
{
    if (format == CLI_HELP_MARKDOWN) {
        printf("## %s\n\n    %s\n\n", command->name, command->synopsis);
    } else {
        printf(".SS %s\n", command->name);
        put_escaped(command->synopsis, (int)strlen(command->synopsis), format);
        puts("\n.PP");
    }
    put_sentence(command->about, format);
    const char *title = format == CLI_HELP_MARKDOWN ? "\n" : "";
    for (option_kind kind = ARGUMENT; kind <= OPTIONAL; kind++)
        title = print_options(title, command, groups, count, kind, format);
    for (int g = 0; g < count; g++) refer_to_owner(command, &groups[g], format);
    if (command->notes) print_notes(command->notes, format);
    if (format == CLI_HELP_MARKDOWN) putchar('\n');
}

int cli_print_help(const cli_command *command, const cli_group *groups, int count,
                   cli_help_format format)
{
    static const cli_option help = {.name = "help", .help = "print this"};
    if (format != CLI_HELP_TEXT) {
        print_reference(command, groups, count, format);
        return cli_close(stdout, "standard output");
    }
    cli_wrap(stdout, command->synopsis, printf("usage: "), 17);
    printf("%s\n", command->about);
    print_options("\narguments:\n", command, groups, count, ARGUMENT, format);
    puts("\noptions:");
    print_options("", command, groups, count, REQUIRED, format);
    print_options("", command, groups, count, OPTIONAL, format);
    print_option(&help, format);
    if (command->notes) {
        putchar('\n');
        cli_wrap_notes(stdout, command->notes);
    }
    return cli_close(stdout, "standard output");
}

void cli_print_exits(cli_help_format format)
{
    static const struct {
        int number;
        const char *text;
    } exits[] = {
#define EXIT_ROW(code, number, text) {number, text},
        CLI_EXIT_LIST(EXIT_ROW)
#undef EXIT_ROW
    };
    static const char *const headings[] = {[CLI_HELP_TEXT] = "exit status:",
                                           [CLI_HELP_MARKDOWN] = "## Exit status\n",
                                           [CLI_HELP_MAN] = ".SH EXIT STATUS"};
    static const char *const rows[] = {[CLI_HELP_TEXT] = "  %-4d %s\n",
                                       [CLI_HELP_MARKDOWN] = "- `%d`: %s\n",
                                       [CLI_HELP_MAN] = ".TP\n.B %d\n%s\n"};
    puts(headings[format]);
    for (size_t i = 0; i < sizeof exits / sizeof *exits; i++)
        printf(rows[format], exits[i].number, exits[i].text);
}
