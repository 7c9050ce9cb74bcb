/* parsed_study.c - the keys of a study file, one by one.
 *
 * Keys beside `systems` are defaults for every system; a system may be a name or a mapping that
 * overrides them.  'dalembert study --help' lists the keys. */
#include "parsed_study.h"
#include "dalembert.h"
#include "study_values.h"
#include "ui/message.h"
#include "ui/options.h"

#include <string.h>

static const char *const start_words[] = {
#define X(code, word, space, about) word,
    STUDY_START_LIST(X)
#undef X
};

const char *study_start_word(int start) { return start_words[start]; }

/* ---- texts and numbers ---- */

static int take_title(void *user, const document *doc, yaml_node_t *value)
{
    parsed_study *d = user;
    d->title = document_scalar(doc, value, "title");
    return d->title ? CLI_DONE : CLI_USAGE;
}

static int take_system(void *user, const document *doc, yaml_node_t *value)
{
    parsed_study *d = user;
    d->of_case.name = document_scalar(doc, value, "system");
    return d->of_case.name ? CLI_DONE : CLI_USAGE;
}

static int take_label(void *user, const document *doc, yaml_node_t *value)
{
    parsed_study *d = user;
    const char *label = d->of_case.group = document_scalar(doc, value, "label");
    if (!label) return CLI_USAGE;
    if (label[0] && !strchr(label, '/') && label[0] != '.') return CLI_DONE;
    return document_fail(doc, value, "label: '%s' cannot name a file", label);
}

static int take_positive(const document *doc, yaml_node_t *value, const char *what, double *x)
{
    int status = document_number(doc, value, what, x);
    if (status != CLI_DONE || *x > 0.0) return status;
    return document_fail(doc, value, "%s: %g is not positive", what, *x);
}

static int keep_steps(study_case *e, const document *doc, const yaml_node_t *node,
                      const study_values *values)
{
    if (values->is_drawn) return document_fail(doc, node, "step: it cannot be drawn");
    if (values->count > STUDY_STEPS)
        return document_fail(doc, node, "step: %d values, not 1..%d", values->count, STUDY_STEPS);
    e->steps = values->count;
    for (int i = 0; i < e->steps; i++) {
        e->step[i] = values->value[i];
        if (!(e->step[i] > 0.0))
            return document_fail(doc, node, "step: %g is not positive", e->step[i]);
        for (int k = 0; k < i; k++)
            if (e->step[k] == e->step[i])
                return document_fail(doc, node, "step: %g comes twice", e->step[i]);
    }
    return CLI_DONE;
}

static int take_step(void *user, const document *doc, yaml_node_t *value)
{
    study_values values;
    int status = study_values_read(&values, doc, value, "step");
    if (status == CLI_DONE)
        status = keep_steps(&((parsed_study *)user)->of_case, doc, value, &values);
    study_values_free(&values);
    return status;
}

static int take_time(void *user, const document *doc, yaml_node_t *value)
{
    return take_positive(doc, value, "time", &((parsed_study *)user)->of_case.time);
}

static int take_displacement(void *user, const document *doc, yaml_node_t *value)
{
    return take_positive(doc, value, "displacement", &((parsed_study *)user)->of_case.displacement);
}

static int take_integer(const document *doc, const yaml_node_t *value, const char *what,
                        long long *number)
{
    char place[256];
    const char *given = document_scalar(doc, value, what);
    if (!given) return CLI_USAGE;
    document_place(doc, value, what, place, sizeof place);
    return cli_integer(place, given, 1, 1000000000, number);
}

static int take_samples(void *user, const document *doc, yaml_node_t *value)
{
    return take_integer(doc, value, "samples", &((parsed_study *)user)->of_case.samples);
}

static int take_statistics(void *user, const document *doc, yaml_node_t *value)
{
    return take_integer(doc, value, "statistics", &((parsed_study *)user)->of_case.statistics);
}

/* ---- options of the runs ---- */

static const char *const option_words[STUDY_OPTIONS] = {
#define X(type, name, word, initial, least, greatest, value, help) word,
    DAL_OPTION_LIST(X)
#undef X
};

const char *study_option_word(int option) { return option_words[option]; }

static int take_option(study_case *e, const document *doc, const yaml_node_pair_t *pair)
{
    dal_error error = {0};
    dal_options options = dal_options_default();
    yaml_node_t *key = document_node(doc, pair->key);
    yaml_node_t *value = document_node(doc, pair->value);
    const char *name = document_scalar(doc, key, "options");
    const char *word = name ? document_scalar(doc, value, name) : NULL;
    if (!word) return CLI_USAGE;
    if (strcmp(name, "step") == 0 || strcmp(name, "space") == 0)
        return document_fail(doc, key, "options: %s has a key of its own", name);
    if (cli_renamed_option(name))
        return document_fail(doc, key, "options: %s is called %s now", name,
                             cli_renamed_option(name));
    if (dal_options_set(&options, name, word, &error) != DAL_OK)
        return document_fail(doc, key, "%s", error.message);
    for (int i = 0; i < STUDY_OPTIONS; i++)
        if (strcmp(option_words[i], name) == 0) e->option[i] = word;
    return CLI_DONE;
}

static int take_options(void *user, const document *doc, yaml_node_t *value)
{
    int status = CLI_DONE;
    if (value->type != YAML_MAPPING_NODE)
        return document_fail(doc, value, "options: names and values are wanted");
    const yaml_node_pair_t *pair = value->data.mapping.pairs.start;
    for (; pair < value->data.mapping.pairs.top && status == CLI_DONE; pair++)
        status = take_option(&((parsed_study *)user)->of_case, doc, pair);
    return status;
}

/* ---- starts ---- */

static int take_starts(void *user, const document *doc, yaml_node_t *value)
{
    study_case *e = &((parsed_study *)user)->of_case;
    e->starts = 0;
    for (int i = 0; i < document_count(value); i++) {
        const yaml_node_t *item = document_item(doc, value, i);
        const char *word = document_scalar(doc, item, "starts");
        if (!word) return CLI_USAGE;
        int start = 0;
        while (start < STUDY_STARTS && strcmp(start_words[start], word) != 0) start++;
        if (start == STUDY_STARTS)
            return document_fail(doc, item, "starts: '%s' is not physical, surface or displaced",
                                 word);
        e->starts |= 1 << start;
    }
    return e->starts ? CLI_DONE : document_fail(doc, value, "starts: the list is empty");
}

/* ---- what waits for the system ---- */

#define KEEP_NODE(name)                                                                            \
    static int take_##name(void *user, const document *doc, yaml_node_t *value)                    \
    {                                                                                              \
        (void)doc;                                                                                 \
        ((parsed_study *)user)->name = value;                                                      \
        return CLI_DONE;                                                                           \
    }
KEEP_NODE(integrators)
KEEP_NODE(set)
KEEP_NODE(start)
KEEP_NODE(displace)
KEEP_NODE(seeds)
KEEP_NODE(systems)
KEEP_NODE(expect)

static const document_key keys[] = {
#define X(name, scope, help) {#name, take_##name},
    STUDY_KEY_LIST(X)
#undef X
};

/* The list begins with the keys of the whole study, then those of both, then those of a system. */
enum {
#define X(name, scope, help) KEY_##name,
    STUDY_KEY_LIST(X)
#undef X
        KEYS,
    FIRST_OF_SYSTEM = KEY_integrators,
    KEYS_OF_STUDY = KEY_system,
    KEYS_OF_SYSTEM = KEYS - FIRST_OF_SYSTEM
};

int parsed_study_read_study(parsed_study *parsed, const document *doc, yaml_node_t *node)
{
    return document_read_mapping(doc, node, "a study", keys, KEYS_OF_STUDY, parsed);
}

int parsed_study_read_system(parsed_study *parsed, const document *doc, yaml_node_t *node)
{
    if (node->type != YAML_MAPPING_NODE) return take_system(parsed, doc, node);
    return document_read_mapping(doc, node, "a system", keys + FIRST_OF_SYSTEM, KEYS_OF_SYSTEM,
                                 parsed);
}
