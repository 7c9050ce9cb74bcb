/* options.c - reads arguments by the rows of options. */
#include "options.h"
#include "dalembert.h"
#include "help.h"
#include "memory.h"
#include "message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char CLI_REQUIRED[] = "";

/* ---- renamed words ------------------------------------------------------------------------- */

const char *cli_renamed_option(const char *name)
{
    static const char *const renamed[][2] = {{"solve-to", "solver-tolerance"},
                                             {"extra-sweeps", "extra-iterations"},
                                             {"long-steps", "quad-steps"}};
    for (size_t i = 0; i < sizeof renamed / sizeof *renamed; i++)
        if (strcmp(name, renamed[i][0]) == 0) return renamed[i][1];
    return NULL;
}

const char *cli_synonym(const char *name)
{
    static const char *const synonyms[][2] = {
        {"dt", "step"},           {"h", "step"},       {"stepsize", "step"}, {"step-size", "step"},
        {"method", "integrator"}, {"i", "integrator"}, {"tmax", "time"},     {"t-max", "time"},
        {"tend", "time"},         {"t", "time"},       {"tol", "tolerance"}, {"rtol", "tolerance"},
        {"atol", "tolerance"},    {"params", "set"},   {"param", "set"},     {"out", "output"}};
    for (size_t i = 0; i < sizeof synonyms / sizeof *synonyms; i++)
        if (strcmp(name, synonyms[i][0]) == 0) return synonyms[i][1];
    return NULL;
}
const char *cli_renamed_value(const char *option, const char *text)
{
    const bool is_long = strcmp(option, "precision") == 0 && strcmp(text, "long") == 0;
    return is_long ? "quad" : NULL;
}

/* ---- parsers ------------------------------------------------------------------------------- */

int cli_number(const char *what, const char *text, double *number)
{
    dal_status read = dal_parse_number(text, strlen(text), number);
    if (read == DAL_TOO_LARGE) return cli_fail(CLI_USAGE, "%s: '%s' is too large", what, text);
    if (read != DAL_OK) return cli_fail(CLI_USAGE, "%s: '%s' is not a number", what, text);
    return CLI_DONE;
}

int cli_integer(const char *what, const char *text, long long min, long long max, long long *number)
{
    double x;
    if (cli_number(what, text, &x) != CLI_DONE) return CLI_USAGE;
    if (x != floor(x)) return cli_fail(CLI_USAGE, "%s: %s is not an integer", what, text);
    if (!(x >= (double)min && x <= (double)max))
        return cli_fail(CLI_USAGE, "%s: %s is not in %lld..%lld", what, text, min, max);
    *number = (long long)x;
    return CLI_DONE;
}

enum { WHAT = 64 };

/* What messages call an option. */
static const char *option_title(const cli_option *option, char title[WHAT])
{
    snprintf(title, WHAT, "%s%s", option->name ? "--" : "",
             option->name ? option->name : option->value);
    return title;
}

static void *field(void *settings, const cli_option *option)
{
    return (char *)settings + option->offset;
}

int cli_parse_text(void *settings, const cli_option *option, const char *text)
{
    const char **stored = field(settings, option);
    if (!option->name && *stored)
        return cli_fail(CLI_USAGE, "only one %s, not also '%s'", option->value, text);
    *stored = text;
    return CLI_DONE;
}

int cli_parse_flag(void *settings, const cli_option *option, const char *text)
{
    (void)text;
    *(bool *)field(settings, option) = true;
    return CLI_DONE;
}

int cli_parse_number(void *settings, const cli_option *option, const char *text)
{
    char title[WHAT];
    double x;
    const int status = cli_number(option_title(option, title), text, &x);
    if (status != CLI_DONE) return status;
    if (!(x >= option->min && x <= option->max))
        return cli_fail(CLI_USAGE, "%s: %s is not from %g to %g", title, text, option->min,
                        option->max);
    *(double *)field(settings, option) = x;
    return CLI_DONE;
}

int cli_parse_integer(void *settings, const cli_option *option, const char *text)
{
    char title[WHAT];
    return cli_integer(option_title(option, title), text, (long long)option->min,
                       (long long)option->max, field(settings, option));
}

int cli_parse_word(void *settings, const cli_option *option, const char *text)
{
    char title[WHAT];
    const size_t given = strlen(text);
    const char *word = option->value;
    for (int i = 0;; i++, word++) {
        const size_t length = strcspn(word, "|");
        if (length == given && memcmp(word, text, length) == 0) {
            *(int *)field(settings, option) = i;
            return CLI_DONE;
        }
        word += length;
        if (!*word) break;
    }
    return cli_fail(CLI_USAGE, "%s: '%s' is not one of %s", option_title(option, title), text,
                    option->value);
}

/* ---- defaults ------------------------------------------------------------------------------ */

void cli_set_defaults(const cli_option *options, int count, void *settings)
{
    for (const cli_option *option = options; option < options + count; option++) {
        const char *text = option->initial;
        char word[64];
        if (!text || text == CLI_REQUIRED) continue;
        /* Of several words the first. */
        if (strchr(text, '|')) {
            snprintf(word, sizeof word, "%.*s", (int)strcspn(text, "|"), text);
            text = word;
        }
        option->parse(settings, option, text);
    }
}

/* ---- reading ------------------------------------------------------------------------------- */

enum { MAX_GROUPS = 4, MAX_NAMES = 64 };

typedef struct reader {
    const cli_group *groups;
    int group_count;
    int argc, next;
    char **argv;
    bool plain;                 /* behind -- */
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
    const char *nearest = dal_nearest(bare, names, count), *synonym = cli_synonym(bare);
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

/* Names what is required and was not given: options, or arguments that are none.  The first message
 * has the synopsis. */
static int report_missing(const reader *r, bool of_options, const char *synopsis)
{
    int status = CLI_DONE;
    for (int g = 0; g < r->group_count; g++)
        for (int k = 0; k < r->groups[g].count; k++) {
            const cli_option *option = &r->groups[g].options[k];
            if (!is_missing(r, g, k) || (option->name != NULL) != of_options) continue;
            status = cli_fail(CLI_USAGE, "%s%s is missing%s%s", of_options ? "--" : "the ",
                              of_options ? option->name : option->value,
                              synopsis ? "; usage: " : "", synopsis ? synopsis : "");
            synopsis = NULL;
        }
    return status;
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
    if (find(r, "", 0, &group, &k)) return parse(r, group, k, argument);
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
    const int argument = report_missing(&r, false, command->synopsis);
    const int option = report_missing(&r, true, argument == CLI_DONE ? command->synopsis : NULL);
    if (status == CLI_DONE) status = argument != CLI_DONE ? argument : option;
    for (int g = 0; g < count; g++) {
        const cli_group *group = &groups[g];
        const int completed = group->complete ? group->complete(group, status) : CLI_DONE;
        if (status == CLI_DONE) status = completed;
    }
    return status == CLI_DONE ? CLI_GO_ON : status;
}
