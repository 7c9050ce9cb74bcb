/* arguments.c - reads arguments by the rows of options. */
#include "arguments.h"
#include "dalembert_program.h"
#include "help.h"
#include "memory.h"
#include "message.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_GROUPS = 4, MAX_NAMES = 64 };

typedef struct reader {
    const cli_group *groups;
    int group_count;
    int argc, next;
    char **argv;
    bool plain;                 /* after -- */
    uint64_t given[MAX_GROUPS]; /* bit k: option k was given */
} reader;

/* Finds option NAME, or (length 0) the argument that is no option; false: there is none. */
static bool find(const reader *r, const char *name, size_t length, int *group, int *k)
{
    for (*group = 0; *group < r->group_count; ++*group)
        for (*k = 0; *k < r->groups[*group].count; ++*k) {
            const char *other = r->groups[*group].options[*k].name;
            if (r->groups[*group].without >> *k & 1) continue;
            if (other ? strlen(other) == length && memcmp(other, name, length) == 0 : length == 0)
                return true;
        }
    return false;
}

/* Skips the value of an unknown option: of one that is like an option with a value, or of any where
 * all arguments that are no options have been read. */
static void skip_value(reader *r, const char *meant)
{
    int group, k;
    if (r->next == r->argc || r->argv[r->next][0] == '-') return;
    if (find(r, meant ? meant : "", meant ? strlen(meant) : 0, &group, &k) &&
        (meant ? r->groups[group].options[k].value != NULL : r->given[group] >> k & 1))
        r->next++;
}

static int unknown_option(reader *r, const char *argument, size_t length)
{
    const char *names[MAX_NAMES];
    int count = 0;
    char *name = cli_strndup(argument, length);
    const char *bare = name + strspn(name, "-"), *present = cli_renamed_option(bare);
    for (int g = 0; g < r->group_count; g++)
        for (int k = 0; k < r->groups[g].count && count < MAX_NAMES - 1; k++)
            if (r->groups[g].options[k].name && !(r->groups[g].without >> k & 1))
                names[count++] = r->groups[g].options[k].name;
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

static int parse(reader *r, int group, int k, const char *text)
{
    const cli_group *g = &r->groups[group];
    r->given[group] |= UINT64_C(1) << k;
    if (g->texts) g->texts[k] = text;
    return g->options[k].parse(g->settings, &g->options[k], text);
}

static int read_option(reader *r, const char *argument)
{
    int group, k;
    const char *equals = strchr(argument, '=');
    const size_t length = equals ? (size_t)(equals - argument) : strlen(argument);
    if (length <= 2 || argument[1] != '-' || !find(r, argument + 2, length - 2, &group, &k))
        return unknown_option(r, argument, length);
    const cli_option *option = &r->groups[group].options[k];
    if (!option->value && equals) return cli_fail(CLI_USAGE, "--%s takes no value", option->name);
    if (!option->value || equals) return parse(r, group, k, equals ? equals + 1 : NULL);
    const char *text = r->next < r->argc ? r->argv[r->next++] : NULL;
    if (text && strncmp(text, "--", 2) != 0) return parse(r, group, k, text);
    if (strcmp(option->value, "off|on") == 0) { /* --consistent is --consistent on */
        if (text) r->next--;
        return parse(r, group, k, "on");
    }
    return cli_fail(CLI_USAGE, "--%s needs a value: --%s %s", option->name, option->name,
                    option->value);
}

static bool is_missing(const reader *r, int group, int k)
{
    const cli_group *g = &r->groups[group];
    return g->options[k].initial == CLI_REQUIRED && !((r->given[group] | g->without) >> k & 1);
}

typedef enum row_kind { ARGUMENTS, OPTIONS } row_kind;

/* Names the required rows of a kind that were not given.  The first message has the synopsis. */
static int report_missing(const reader *r, row_kind kind, const char *synopsis)
{
    int status = CLI_DONE;
    for (int g = 0; g < r->group_count; g++)
        for (int k = 0; k < r->groups[g].count; k++) {
            const cli_option *option = &r->groups[g].options[k];
            if (!is_missing(r, g, k) || (option->name != NULL) != (kind == OPTIONS)) continue;
            status = cli_fail(CLI_USAGE, "%s%s is missing%s%s", kind == OPTIONS ? "--" : "the ",
                              kind == OPTIONS ? option->name : option->value,
                              synopsis ? "; usage: " : "", synopsis ? synopsis : "");
            synopsis = NULL;
        }
    return status;
}

/* The first argument that is no option and was not given yet; where all were given, the last. */
static bool find_argument(const reader *r, int *group, int *k)
{
    bool is_found = false;
    for (int g = 0; g < r->group_count; g++)
        for (int i = 0; i < r->groups[g].count; i++) {
            if (r->groups[g].options[i].name || r->groups[g].without >> i & 1) continue;
            *group = g, *k = i;
            is_found = true;
            if (!(r->given[g] >> i & 1)) return true;
        }
    return is_found;
}

static int read_argument(reader *r, const char *argument)
{
    int group, k;
    if (!r->plain && strcmp(argument, "--") == 0) {
        r->plain = true;
        return CLI_DONE;
    }
    if (!r->plain && strcmp(argument, CLI_SHORT_OUTPUT) == 0 &&
        find(r, CLI_OUTPUT, strlen(CLI_OUTPUT), &group, &k))
        argument = "--" CLI_OUTPUT;
    if (!r->plain && argument[0] == '-' && argument[1]) return read_option(r, argument);
    if (find_argument(r, &group, &k)) return parse(r, group, k, argument);
    return cli_fail(CLI_USAGE, "%s: unexpected argument '%s'", r->argv[0], argument);
}

/* Everything that is wrong is named, not the first alone. */
int cli_read_arguments(const cli_command *command, int argc, char **argv, const cli_group *groups,
                       int count)
{
    reader r = {.groups = groups, .group_count = count, .argc = argc, .next = 1, .argv = argv};
    int status = CLI_DONE;
    for (int g = 0; g < count; g++)
        cli_set_defaults(groups[g].options, groups[g].count, groups[g].settings);
    while (r.next < argc) {
        const char *argument = argv[r.next++];
        const bool may_help = !r.plain && status == CLI_DONE;
        if (may_help && (strcmp(argument, "--help") == 0 || strcmp(argument, "-h") == 0))
            return cli_print_help(command, groups, count);
        if (may_help && strcmp(argument, CLI_HELP_MARKDOWN) == 0)
            return cli_print_reference(command, groups, count);
        const int read = read_argument(&r, argument);
        if (status == CLI_DONE) status = read;
    }
    const int argument = report_missing(&r, ARGUMENTS, command->synopsis);
    const int option = report_missing(&r, OPTIONS, argument == CLI_DONE ? command->synopsis : NULL);
    if (status == CLI_DONE) status = argument != CLI_DONE ? argument : option;
    for (int g = 0; g < count; g++) {
        const cli_group *group = &groups[g];
        const int completed = group->complete ? group->complete(group, status) : CLI_DONE;
        if (status == CLI_DONE) status = completed;
    }
    return status == CLI_DONE ? CLI_GO_ON : status;
}
