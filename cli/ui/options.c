/* options.c - what is given for options: the parsers of values, and defaults. */
#include "options.h"
#include "dalembert_program.h"
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
    dal_status read = dal__parse_number(text, strlen(text), number);
    if (read == DAL_STATUS_TOO_LARGE)
        return cli_fail(CLI_USAGE, "%s: '%s' is too large", what, text);
    if (read != DAL_STATUS_OK) return cli_fail(CLI_USAGE, "%s: '%s' is not a number", what, text);
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
