/* parsed_study.c - the keys of a study file, one by one.
 *
 * Keys beside `systems` are defaults for every system; a system may be a name or a mapping that
 * overrides them.  'dalembert study --help' lists the keys. */
#include "parsed_study.h"

#include "study_values.h"
#include "ui/message.h"
#include "ui/options.h"

#include <string.h>

static int read_label(void *user, const document *doc, yaml_node_t *value, const document_key *key)
{
    parsed_study *p = user;
    const int status = document_read_text(user, doc, value, key);
    if (status != CLI_DONE) return status;
    const char *label = p->item.group;
    if (label[0] && !strchr(label, '/') && label[0] != '.') return CLI_DONE;
    return document_fail(doc, value, "label: '%s' cannot name a file", label);
}

static int set_steps(study_case *e, const document *doc, const yaml_node_t *node,
                     const study_values *values)
{
    if (values->is_drawn) return document_fail(doc, node, "step: it must not be random");
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

static int read_steps(void *user, const document *doc, yaml_node_t *value, const document_key *key)
{
    study_values values;
    int status = study_values_read(&values, doc, value, key->name);
    if (status == CLI_DONE) status = set_steps(&((parsed_study *)user)->item, doc, value, &values);
    study_values_free(&values);
    return status;
}

static int read_option(study_case *e, const document *doc, const document_pair *pair)
{
    dal_error error = {0};
    const char *name = pair->name, *word = document_scalar(doc, pair->value, name);
    if (!word) return CLI_USAGE;
    if (strcmp(name, "step") == 0 || strcmp(name, "space") == 0)
        return document_fail(doc, pair->key, "options: %s has a key of its own", name);
    if (cli_renamed_option(name))
        return document_fail(doc, pair->key, "options: %s is called %s now", name,
                             cli_renamed_option(name));
    if (cli_renamed_value(name, word))
        return document_fail(doc, pair->key, "options: %s: %s is called %s now", name, word,
                             cli_renamed_value(name, word));
    if (dal_options_set(&e->options, name, word, &error) != DAL_OK)
        return document_fail(doc, pair->key, "%s", error.message);
    e->option[request_find_option(name)] = word;
    return CLI_DONE;
}

static int read_options(void *user, const document *doc, yaml_node_t *value,
                        const document_key *key)
{
    parsed_study *p = user;
    document_pair pair;
    int status = document_check_mapping(doc, value, key->name, "names and values");
    for (int i = 0; status == CLI_DONE && document_get_pair(doc, value, i, &pair); i++)
        status = read_option(&p->item, doc, &pair);
    return status;
}

static int read_starts(void *user, const document *doc, yaml_node_t *value, const document_key *key)
{
    (void)key;
    study_case *e = &((parsed_study *)user)->item;
    e->starts = 0;
    for (int i = 0; i < document_count(value); i++) {
        const int start = document_word(doc, document_item(doc, value, i), "start",
                                        study_start_words, STUDY_STARTS);
        if (start < 0) return CLI_USAGE;
        e->starts |= 1 << start;
    }
    return e->starts ? CLI_DONE : document_fail(doc, value, "starts: the list is empty");
}

#define KEY(name, scope, read, member, help) {#name, read, offsetof(parsed_study, member)},
static const document_key keys[] = {STUDY_KEY_LIST(KEY)};
#undef KEY

/* The places of keys in their list. */
enum {
#define KEY_NUMBER(name, scope, read, member, help) KEY_##name,
    STUDY_KEY_LIST(KEY_NUMBER)
#undef KEY_NUMBER
        KEYS
};

int parsed_study_read(parsed_study *parsed, const document *doc, yaml_node_t *node)
{
    return document_read_mapping(doc, node, "a study", keys, KEY_system, parsed);
}

int parsed_study_read_system(parsed_study *parsed, const document *doc, yaml_node_t *node)
{
    if (node->type != YAML_MAPPING_NODE)
        return document_read_text(parsed, doc, node, &keys[KEY_system]);
    return document_read_mapping(doc, node, "a system", keys + KEY_integrators,
                                 KEYS - KEY_integrators, parsed);
}
