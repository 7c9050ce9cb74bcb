/* options.c - the options of a run by their names, and their defaults. */
#include "core/error.h"
#include "dalembert_program.h"
#include "dalembert_run.h"
#include <math.h>
#include <stdbool.h>
#include <string.h>

dal_options dal_options_default(void)
{
    return (dal_options){
#define OPTION(type, name, word, initial, min, max, value, help) .name = initial,
        DAL_OPTION_LIST(OPTION)
#undef OPTION
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

typedef struct option {
    const char *name, *value;
    double min, max;
    bool is_whole, is_choice;
} option;

static dal_status parse(const option *k, const char *text, double *value, dal_error *error)
{
    if (k->is_choice) {
        *value = choice(k->value, text);
        if (*value >= 0) return DAL_STATUS_OK;
        return dal__fail(error, DAL_STATUS_ARGUMENT, "option %s: '%.60s' is not one of %s", k->name,
                         text, k->value);
    }
    if (dal__parse_number(text, strlen(text), value) != DAL_STATUS_OK)
        return dal__fail(error, DAL_STATUS_SYNTAX, "option %s: '%.60s' is not a number", k->name,
                         text);
    const bool is_in_range = *value >= k->min && *value <= k->max;
    if (is_in_range && (!k->is_whole || *value == floor(*value))) return DAL_STATUS_OK;
    return dal__fail(error, DAL_STATUS_ARGUMENT, "option %s: %.60s is not %s from %g to %g",
                     k->name, text, k->is_whole ? "a whole number" : "a number", k->min, k->max);
}

/* of each type of options: is_whole, is_choice */
#define DAL__TYPE_double        false, false
#define DAL__TYPE_int           true, false
#define DAL__TYPE_bool          true, true
#define DAL__TYPE_dal_space     true, true
#define DAL__TYPE_dal_solver    true, true
#define DAL__TYPE_dal_sums      true, true
#define DAL__TYPE_dal_precision true, true

/* Sets option number i to a value in its range. */
static void set_option(dal_options *options, int i, double value)
{
    int number = 0;
#define OPTION(type, field, ...)                                                                   \
    if (number++ == i) options->field = (type)value;
    DAL_OPTION_LIST(OPTION)
#undef OPTION
}

dal_status dal_options_set(dal_options *options, const char *name, const char *text,
                           dal_error *error)
{
    static const option table[] = {
#define OPTION(type, field, word, initial, min, max, value, help)                                  \
    {word, value, min, max, DAL__TYPE_##type},
        DAL_OPTION_LIST(OPTION)
#undef OPTION
    };
    enum { COUNT = sizeof table / sizeof *table };
    const char *names[COUNT];
    DAL_REQUIRE(options, error);
    DAL_REQUIRE(name, error);
    DAL_REQUIRE(text, error);
    for (int i = 0; i < COUNT; i++) {
        double value = 0.0;
        names[i] = table[i].name;
        if (strcmp(name, names[i]) != 0) continue;
        DAL_TRY(parse(&table[i], text, &value, error));
        set_option(options, i, value);
        return DAL_STATUS_OK;
    }
    return dal__unknown(error, "option", name, names, COUNT);
}
