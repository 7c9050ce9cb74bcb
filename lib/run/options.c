/* options.c - the options of a run, all from the one table DAL_OPTION_LIST. */
#include "core/error.h"
#include "kernel/quad.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

dal_options dal_options_default(void)
{
    return (dal_options){
#define OPTION(type, name, word, initial, min, max, value, help) .name = initial,
        DAL_OPTION_LIST(OPTION)
#undef OPTION
    };
}

double dal_min_tolerance(const dal_options *options)
{
    const double ulps = 0x1p-12;
    if (!options) return NAN;
    return ulps * DBL_EPSILON * (options->precision == DAL_QUAD ? DAL_QUAD_ULP_RATIO : 1.0);
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
    size_t offset;
} option;

static dal_status parse(const option *k, const char *text, double *value, dal_error *error)
{
    if (k->is_choice) {
        *value = choice(k->value, text);
        if (*value >= 0) return DAL_OK;
        return dal__fail(error, DAL_ARGUMENT, "option %s: '%.60s' is not one of %s", k->name, text,
                         k->value);
    }
    if (dal_parse_number(text, strlen(text), value) != DAL_OK)
        return dal__fail(error, DAL_SYNTAX, "option %s: '%.60s' is not a number", k->name, text);
    const bool is_in_range = *value >= k->min && *value <= k->max;
    if (is_in_range && (!k->is_whole || *value == floor(*value))) return DAL_OK;
    return dal__fail(error, DAL_ARGUMENT, "option %s: %.60s is not %s from %g to %g", k->name, text,
                     k->is_whole ? "a whole number" : "a number", k->min, k->max);
}

/* of each type of options: is_whole, is_choice */
#define DAL__TYPE_double     false, false
#define DAL__TYPE_int        true, false
#define DAL__TYPE_dal_choice true, true

dal_status dal_options_set(dal_options *options, const char *name, const char *text,
                           dal_error *error)
{
    static const option table[] = {
#define OPTION(type, field, word, initial, min, max, value, help)                                  \
    {word, value, min, max, DAL__TYPE_##type, offsetof(dal_options, field)},
        DAL_OPTION_LIST(OPTION)
#undef OPTION
    };
    enum { COUNT = sizeof table / sizeof *table };
    const char *names[COUNT];
    DAL_REQUIRE(options, error);
    DAL_REQUIRE(name, error);
    DAL_REQUIRE(text, error);
    for (int i = 0; i < COUNT; i++) {
        const option *k = &table[i];
        void *field = (char *)options + k->offset;
        double value = 0.0;
        names[i] = k->name;
        if (strcmp(name, k->name) != 0) continue;
        DAL_TRY(parse(k, text, &value, error));
        if (k->is_whole)
            *(int *)field = (int)value;
        else
            *(double *)field = value;
        return DAL_OK;
    }
    return dal__unknown(error, "option", name, names, COUNT);
}
