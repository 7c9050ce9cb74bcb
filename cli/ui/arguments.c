/* arguments.c - reads arguments by the rows of options. */
#include "arguments.h"
#include "dalembert_program.h"
#include "help.h"
#include "memory.h"
#include "message.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_SETS = 4, MAX_NAMES = 64 };

typedef struct reader {
    const cli_option_set *sets;
    int set_count;
    int argc, next;
    char **argv;
    bool plain;               /* after -- */
    uint64_t given[MAX_SETS]; /* bit k: option k was given */
} reader;

/* Finds option NAME, or (length 0) the argument that is no option; false: there is none. */
static bool find(const reader *r, const char *name, size_t length, int *set, int *k)
{
    for (*set = 0; *set < r->set_count; ++*set)
        for (*k = 0; *k < r->sets[*set].count; ++*k) {
            const char *other = r->sets[*set].options[*k].name;
            if (r->sets[*set].without >> *k & 1) continue;
            if (other ? strlen(other) == length && memcmp(other, name, length) == 0 : length == 0)
                return true;
        }
    return false;
}

/* Skips the value of an unknown option: of one that is like an option with a value, or of any where
 * all arguments that are no options have been read. */
static void skip_value(reader *r, const char *meant)
{
    int set, k;
    if (r->next == r->argc || r->argv[r->next][0] == '-') return;
    if (find(r, meant ? meant : "", meant ? strlen(meant) : 0, &set, &k) &&
        (meant ? r->sets[set].options[k].value != NULL : r->given[set] >> k & 1))
        r->next++;
}

static int unknown_option(reader *r, const char *argument, size_t length)
{
    const char *names[MAX_NAMES];
    int count = 0;
    char *name = cli_strndup(argument, length);
    const char *bare = name + strspn(name, "-"), *present = cli_renamed_option(bare);
    for (int g = 0; g < r->set_count; g++)
        for (int k = 0; k < r->sets[g].count && count < MAX_NAMES - 1; k++)
            if (r->sets[g].options[k].name && !(r->sets[g].without >> k & 1))
                names[count++] = r->sets[g].options[k].name;
    names[count++] = "help";
    const char *nearest = dal__nearest_name(bare, names, count), *synonym = cli_synonym(bare);
    bool has_synonym = false;
    for (int k = 0; k < count; k++) has_synonym |= synonym && strcmp(names[k], synonym) == 0;
    if (has_synonym) nearest = synonym;
    if (present)
        cli_fail(CLI_USAGE, "%s: the option '%s' is called '--%s' now", r->argv[0], name, present);
    else if (strcmp(bare, "seed") == 0)
        cli_fail(CLI_USAGE,
                 "%s: unknown option '%s': it draws no random numbers, as 'ensemble' does",
                 r->argv[0], name);
    else if (nearest)
        cli_fail(CLI_USAGE, "%s: unknown option '%s'; did you mean '--%s'?", r->argv[0], name,
                 nearest);
    else
        cli_fail(CLI_USAGE, "%s: unknown option '%s'", r->argv[0], name);
    if (!argument[length]) skip_value(r, present ? present : nearest);
    free(name);
    return CLI_USAGE;
}

static int parse(reader *r, int set, int k, const char *text)
{
    const cli_option_set *g = &r->sets[set];
    r->given[set] |= UINT64_C(1) << k;
    if (g->texts) g->texts[k] = text;
    return g->options[k].parse(g->settings, &g->options[k], text);
}

static int read_option(reader *r, const char *argument)
{
    int set, k;
    const char *equals = strchr(argument, '=');
    const size_t length = equals ? (size_t)(equals - argument) : strlen(argument);
    if (length <= 2 || argument[1] != '-' || !find(r, argument + 2, length - 2, &set, &k))
        return unknown_option(r, argument, length);
    const cli_option *option = &r->sets[set].options[k];
    if (!option->value && equals) return cli_fail(CLI_USAGE, "--%s takes no value", option->name);
    if (!option->value || equals) return parse(r, set, k, equals ? equals + 1 : NULL);
    const char *text = r->next < r->argc ? r->argv[r->next++] : NULL;
    if (text && strncmp(text, "--", 2) != 0) return parse(r, set, k, text);
    if (strcmp(option->value, "off|on") == 0) { /* --consistent is --consistent on */
        if (text) r->next--;
        return parse(r, set, k, "on");
    }
    return cli_fail(CLI_USAGE, "--%s needs a value: --%s %s", option->name, option->name,
                    option->value);
}

static bool is_missing(const reader *r, int set, int k)
{
    const cli_option_set *g = &r->sets[set];
    return g->options[k].initial == CLI_REQUIRED && !((r->given[set] | g->without) >> k & 1);
}

typedef enum row_kind { ARGUMENTS, OPTIONS } row_kind;

/* Names the required rows of a kind that were not given.  The first message has the synopsis. */
static int report_missing(const reader *r, row_kind kind, const char *synopsis)
{
    int status = CLI_DONE;
    for (int g = 0; g < r->set_count; g++)
        for (int k = 0; k < r->sets[g].count; k++) {
            const cli_option *option = &r->sets[g].options[k];
            if (!is_missing(r, g, k) || (option->name != NULL) != (kind == OPTIONS)) continue;
            status = cli_fail(CLI_USAGE, "%s%s is missing%s%s", kind == OPTIONS ? "--" : "the ",
                              kind == OPTIONS ? option->name : option->value,
                              synopsis ? "; usage: " : "", synopsis ? synopsis : "");
            synopsis = NULL;
        }
    return status;
}

/* The first argument that is no option and was not given yet; where all were given, the last. */
static bool find_argument(const reader *r, int *set, int *k)
{
    bool is_found = false;
    for (int g = 0; g < r->set_count; g++)
        for (int i = 0; i < r->sets[g].count; i++) {
            if (r->sets[g].options[i].name || r->sets[g].without >> i & 1) continue;
            *set = g, *k = i;
            is_found = true;
            if (!(r->given[g] >> i & 1)) return true;
        }
    return is_found;
}

static int read_argument(reader *r, const char *argument)
{
    int set, k;
    if (!r->plain && strcmp(argument, "--") == 0) {
        r->plain = true;
        return CLI_DONE;
    }
    if (!r->plain && strcmp(argument, CLI_SHORT_OUTPUT) == 0 &&
        find(r, CLI_OUTPUT, strlen(CLI_OUTPUT), &set, &k))
        argument = "--" CLI_OUTPUT;
    if (!r->plain && argument[0] == '-' && argument[1]) return read_option(r, argument);
    if (find_argument(r, &set, &k)) return parse(r, set, k, argument);
    return cli_fail(CLI_USAGE, "%s: unexpected argument '%s'", r->argv[0], argument);
}

/* Everything that is wrong is named, not the first alone. */
int cli_read_arguments(const cli_command *command, int argc, char **argv,
                       const cli_option_set *sets, int count)
{
    reader r = {.sets = sets, .set_count = count, .argc = argc, .next = 1, .argv = argv};
    int status = CLI_DONE;
    for (int g = 0; g < count; g++)
        cli_set_defaults(sets[g].options, sets[g].count, sets[g].settings);
    while (r.next < argc) {
        const char *argument = argv[r.next++];
        const bool may_help = !r.plain && status == CLI_DONE;
        if (may_help && (strcmp(argument, "--help") == 0 || strcmp(argument, "-h") == 0))
            return cli_print_help(command, sets, count);
        if (may_help && strcmp(argument, CLI_HELP_MARKDOWN) == 0)
            return cli_print_reference(command, sets, count);
        const int read = read_argument(&r, argument);
        if (status == CLI_DONE) status = read;
    }
    const int argument = report_missing(&r, ARGUMENTS, command->synopsis);
    const int option = report_missing(&r, OPTIONS, argument == CLI_DONE ? command->synopsis : NULL);
    if (status == CLI_DONE) status = argument != CLI_DONE ? argument : option;
    for (int g = 0; g < count; g++) {
        const cli_option_set *set = &sets[g];
        const int completed = set->complete ? set->complete(set, status) : CLI_DONE;
        if (status == CLI_DONE) status = completed;
    }
    return status == CLI_DONE ? CLI_GO_ON : status;
}
