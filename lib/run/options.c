/* options.c - the options of a run, all from the one table DAL_OPTION_LIST. */
#include "core/arguments.h"
#include <math.h>
#include <string.h>

dal_options dal_options_default(void)
{
    return (dal_options){
#define X(type, name, word, initial, least, greatest, words, help) .name = initial,
        DAL_OPTION_LIST(X)
#undef X
    };
}

/* The place of text among words separated by '|', -1: not there. */
static int choice(const char *words, const char *text)
{
    const size_t length = strlen(text);
    for (int i = 0;; i++) {
        const size_t word = strcspn(words, "|");
        if (word == length && memcmp(words, text, length) == 0) return i;
        if (words[word] == '\0') return -1;
        words += word + 1;
    }
}

static dal_status number(const char *name, const char *text, double *value, dal_error *error)
{
    if (dal_parse_number(text, strlen(text), value) == DAL_OK) return DAL_OK;
    return dal__fail(error, DAL_SYNTAX, "option %s: '%.60s' is not a number", name, text);
}

typedef struct option {
    const char *name, *words;
    double least, greatest;
    int whole;
} option;

static dal_status parse(const option *k, const char *text, double *value, dal_error *error)
{
    if (k->words) {
        const int i = choice(k->words, text);
        if (i < 0)
            return dal__fail(error, DAL_ARGUMENT, "option %s: '%.60s' is not one of %s", k->name,
                             text, k->words);
        *value = i;
        return DAL_OK;
    }
    DAL_TRY(number(k->name, text, value, error));
    const int good = *value >= k->least && *value <= k->greatest;
    if (good && (!k->whole || *value == floor(*value))) return DAL_OK;
    return dal__fail(error, DAL_ARGUMENT, "option %s: %.60s is not %s from %g to %g", k->name, text,
                     k->whole ? "a whole number" : "a number", k->least, k->greatest);
}

#define DAL__WHOLE_int    1
#define DAL__WHOLE_double 0

dal_status dal_options_set(dal_options *options, const char *name, const char *text,
                           dal_error *error)
{
    static const option table[] = {
#define X(type, name, word, initial, least, greatest, words, help)                                 \
    {word, words, least, greatest, DAL__WHOLE_##type},
        DAL_OPTION_LIST(X)
#undef X
    };
    enum { COUNT = sizeof table / sizeof *table };
    DAL_REQUIRE(options, error);
    DAL_REQUIRE(name, error);
    DAL_REQUIRE(text, error);
    const char *names[COUNT];
    double value = 0.0;
    for (int i = 0; i < COUNT; i++) names[i] = table[i].name;
#define X(type, field, word, initial, least, greatest, words, help)                                \
    if (strcmp(name, word) == 0) {                                                                 \
        const option k = {word, words, least, greatest, DAL__WHOLE_##type};                        \
        DAL_TRY(parse(&k, text, &value, error));                                                   \
        options->field = (type)value;                                                              \
        return DAL_OK;                                                                             \
    }
    DAL_OPTION_LIST(X)
#undef X
    return dal__unknown(error, "option", name, names, COUNT);
}
