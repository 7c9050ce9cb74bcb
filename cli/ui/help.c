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

/* What stands before a paragraph; before and behind the name of an item; before one without. */
static const struct {
    const char *paragraph, *item, *item_end, *bullet;
} marks[] = {[CLI_HELP_TEXT] = {"", "", "", ""},
             [CLI_HELP_MARKDOWN] = {"\n", "- `", "`: ", "- "},
             [CLI_HELP_MAN] = {".PP\n", ".TP\n.B \"", "\"\n", ".IP \\(bu 2\n"}};

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

static void print_item(const char *name, int name_length, const char *text, int length,
                       cli_help_format format)
{
    fputs(name_length > 0 ? marks[format].item : marks[format].bullet, stdout);
    if (format == CLI_HELP_MARKDOWN)
        printf("%.*s", name_length, name);
    else
        put_escaped(name, name_length, format);
    if (name_length > 0) fputs(marks[format].item_end, stdout);
    put_escaped(text, length, format);
    putchar('\n');
}

/* Paragraphs stand apart, items below each other. */
static void print_notes(const char *notes, cli_help_format format)
{
    bool follows_item = false;
    while (*notes) {
        cli_paragraph p;
        notes = cli_next_paragraph(notes, &p);
        const int length = (int)(p.end - p.text);
        if (length == 0) continue;
        if (!p.is_item || (!follows_item && format == CLI_HELP_MARKDOWN))
            fputs(marks[format].paragraph, stdout);
        if (p.is_item)
            print_item(p.name, p.name_length, p.text, length, format);
        else {
            put_escaped(p.text, length, format);
            putchar('\n');
        }
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
        print_item(name, length, help, (int)strlen(help), format);
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
    fputs(marks[format].paragraph, stdout);
    printf(is_markdown ? "As for [%s](#%s)" : "As for %s", g->owner, g->owner);
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
        printf("## %s\n\n    %s\n", command->name, command->synopsis);
    } else {
        printf(".SS %s\n", command->name);
        put_escaped(command->synopsis, (int)strlen(command->synopsis), format);
        putchar('\n');
    }
    /* "lists the commands" becomes "Lists the commands." */
    printf("%s%c", marks[format].paragraph, command->about[0] - 'a' + 'A');
    put_escaped(command->about + 1, (int)strlen(command->about + 1), format);
    puts(".");
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
