/* study_expect.c - what a study states beforehand, read from its file.
 *
 *     expect:
 *       LABEL:                              a label, that of a group, a system, or all
 *         INTEGRATOR:                       as in the study, or all, or all+project and the like
 *           QUANTITY: rounding              a size, or a trend
 *           QUANTITY: [exact, none]         one of several
 *           QUANTITY: {at most: 1e-10}      its size: max |x| for D, error and momenta, else
 *                                           max |x - first|
 *           QUANTITY: {trend: linear, rate: {at least: -2e-3, at most: -1e-3}}
 *           QUANTITY: [{step: 0.1, ..}, {step: 0.05, start: surface, ..}]   of these cells alone
 *           state: failed                   of the run: done, failed, refused
 *
 * A quantity is one of quantities.csv, or D, the worst of the constraints.  What is said of
 * something the study does not contain is an error, and so is a size or a trend of E where no
 * system meant conserves it. */
#include "study_expect.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct reader {
    study_plan *plan;
    const document *doc;
    const char *label, *method;
    study_expectation expectation; /* the present one */
} reader;

static int add(reader *r, const yaml_node_t *node)
{
    study_plan *plan = r->plan;
    const size_t count = (size_t)plan->expectation_count + 1;
    plan->expectations = cli_realloc(plan->expectations, count * sizeof *plan->expectations);
    r->expectation.line = node->start_mark.line + 1;
    plan->expectations[plan->expectation_count++] = r->expectation;
    return CLI_DONE;
}

/* ---- words ---- */

/* The words for a value, and which bit of an expectation the first of them is. */
typedef struct words {
    const char *what;
    const char *const *word;
    int count, first;
} words;

#define WORD(code, word) word,
static const char *const trend_words[] = {DAL_SIZE_LIST(WORD) DAL_TREND_LIST(WORD)};
static const char *const state_words[] = {STUDY_STATE_LIST(WORD)};
#undef WORD

static const words any_words = {"size or trend", trend_words, DAL_SIZE_COUNT + DAL_TREND_COUNT, 0};
static const words of_size = {"size", trend_words, DAL_SIZE_COUNT, 0};
static const words of_trend = {"trend", trend_words + DAL_SIZE_COUNT, DAL_TREND_COUNT,
                               DAL_SIZE_COUNT};
static const words of_state = {"state", state_words, sizeof state_words / sizeof(char *), 0};

static int is_state(const study_expectation *x) { return strcmp(x->quantity, "state") == 0; }

static int refuse_word(reader *r, const yaml_node_t *node, const words *known, const char *word)
{
    static const char *const renamed[][2] = {
        {"bounded", "none"}, {"linear drift", "linear"}, {"not enough data", "undecided"}};
    for (size_t i = 0; i < sizeof renamed / sizeof renamed[0]; i++)
        if (strcmp(word, renamed[i][0]) == 0)
            return document_fail(r->doc, node, "expect: '%s' is now the trend '%s'", word,
                                 renamed[i][1]);
    return document_fail_unknown(r->doc, node, known->what, word, known->word, known->count);
}

/* Whether a system that is meant conserves E, at least on D = 0. */
static int is_conserved(const reader *r)
{
    for (int i = 0; i < r->plan->case_count; i++) {
        const study_case *e = &r->plan->cases[i];
        if (study_case_matches(e, r->label) && e->system->properties & (DAL_E_EXACT | DAL_E_ON_D))
            return 1;
    }
    return 0;
}

static int add_words(reader *r, yaml_node_t *node, const words *known)
{
    study_expectation *x = &r->expectation;
    x->words = 0;
    x->field = -1;
    if (strcmp(x->quantity, "E") == 0 && !is_conserved(r))
        return document_fail(r->doc, node,
                             "expect: E has neither size nor trend, since the motion of '%s' "
                             "does not conserve it",
                             r->label);
    for (int i = 0; i < document_count(node); i++) {
        const yaml_node_t *item = document_item(r->doc, node, i);
        const char *word = document_scalar(r->doc, item, known->what);
        if (!word) return CLI_USAGE;
        int k = 0;
        while (k < known->count && strcmp(known->word[k], word) != 0) k++;
        if (k == known->count) return refuse_word(r, item, known, word);
        x->words |= 1u << (known->first + k);
    }
    if (x->words == 0) return document_fail(r->doc, node, "expect: the list is empty");
    return add(r, node);
}

/* ---- bounds ---- */

static int take_most(void *user, const document *doc, yaml_node_t *value)
{
    return document_number(doc, value, "at most", &((reader *)user)->expectation.most);
}

static int take_least(void *user, const document *doc, yaml_node_t *value)
{
    return document_number(doc, value, "at least", &((reader *)user)->expectation.least);
}

static int add_bounds(reader *r, int field, yaml_node_t *node, const document_key *keys, int count)
{
    r->expectation.field = field;
    r->expectation.words = 0;
    r->expectation.least = -INFINITY;
    r->expectation.most = INFINITY;
    int status = document_read_mapping(r->doc, node, "bounds", keys, count, r);
    if (status != CLI_DONE) return status;
    if (isinf(r->expectation.least) && isinf(r->expectation.most))
        return document_fail(r->doc, node, "bounds: 'at most' or 'at least' is wanted");
    return add(r, node);
}

static int add_bound(reader *r, int field, yaml_node_t *node)
{
    static const document_key keys[] = {{"at most", take_most}, {"at least", take_least}};
    return add_bounds(r, field, node, keys, 2);
}

#define TAKE_FIELD(name, member)                                                                   \
    static int take_##name(void *user, const document *doc, yaml_node_t *value)                    \
    {                                                                                              \
        (void)doc;                                                                                 \
        return add_bound(user, STUDY_FIELD_##name, value);                                         \
    }
STUDY_FIELD_LIST(TAKE_FIELD)
#undef TAKE_FIELD

static int take_size(void *user, const document *doc, yaml_node_t *value)
{
    (void)doc;
    return add_words(user, value, &of_size);
}

static int take_trend(void *user, const document *doc, yaml_node_t *value)
{
    (void)doc;
    return add_words(user, value, &of_trend);
}

/* ---- which cells ---- */

static yaml_node_t *value_of(const document *doc, const yaml_node_t *node, const char *name)
{
    const yaml_node_pair_t *pair = node->data.mapping.pairs.start;
    for (; pair < node->data.mapping.pairs.top; pair++) {
        const yaml_node_t *key = document_node(doc, pair->key);
        if (key->type == YAML_SCALAR_NODE &&
            strcmp((const char *)key->data.scalar.value, name) == 0)
            return document_node(doc, pair->value);
    }
    return NULL;
}

static int take_step(void *user, const document *doc, yaml_node_t *value)
{
    return document_number(doc, value, "step", &((reader *)user)->expectation.step);
}

static int take_start(void *user, const document *doc, yaml_node_t *value)
{
    const char *known[STUDY_STARTS], *word = document_scalar(doc, value, "start");
    int start = 0;
    if (!word) return CLI_USAGE;
    for (int i = 0; i < STUDY_STARTS; i++) known[i] = study_start_word(i);
    while (start < STUDY_STARTS && strcmp(known[start], word) != 0) start++;
    ((reader *)user)->expectation.start = start;
    return start < STUDY_STARTS
               ? CLI_DONE
               : document_fail_unknown(doc, value, "start", word, known, STUDY_STARTS);
}

static int contains(const reader *r)
{
    const study_expectation *x = &r->expectation;
    for (int i = 0; i < r->plan->cell_count; i++)
        if (study_expectation_covers(x, &r->plan->cells[i])) return 1;
    return 0;
}

/* These two are taken before the others, which they hold for, wherever they stand. */
static int take_cells(reader *r, yaml_node_t *node)
{
    const struct {
        const char *name;
        int (*take)(void *user, const document *doc, yaml_node_t *value);
    } which[] = {{"step", take_step}, {"start", take_start}};
    for (size_t i = 0; i < sizeof which / sizeof which[0]; i++) {
        yaml_node_t *value = value_of(r->doc, node, which[i].name);
        const int status = value ? which[i].take(r, r->doc, value) : CLI_DONE;
        if (status != CLI_DONE) return status;
    }
    if (contains(r)) return CLI_DONE;
    return document_fail(r->doc, node, "expect: the study has no such step and start");
}

/* The size that the tables show. */
static int size_field(const char *quantity)
{
    const int is_size = quantity[0] == '|' || strcmp(quantity, "error") == 0;
    return is_size || study_is_constraint(quantity) ? STUDY_FIELD_max : STUDY_FIELD_deviation;
}

/* Bounds of the size stand beside the cells they hold for; all else has keys of its own. */
static int add_size(reader *r, yaml_node_t *node)
{
    static const document_key keys[] = {
        {"at most", take_most}, {"at least", take_least}, {"step", NULL}, {"start", NULL}};
    return add_bounds(r, size_field(r->expectation.quantity), node, keys,
                      sizeof keys / sizeof keys[0]);
}

static int add_mapping(reader *r, yaml_node_t *node)
{
    static const document_key keys[] = {{"size", take_size},
                                        {"trend", take_trend},
                                        {"step", NULL},
                                        {"start", NULL},
#define X(name, member) {#name, take_##name},
                                        STUDY_FIELD_LIST(X)
#undef X
    };
    yaml_node_t *old = value_of(r->doc, node, "verdict");
    if (is_state(&r->expectation)) return document_fail(r->doc, node, "state: words are wanted");
    if (old) return document_fail(r->doc, old, "expect: 'verdict' is now 'size' and 'trend'");
    const int status = take_cells(r, node);
    if (status != CLI_DONE) return status;
    if (value_of(r->doc, node, "at most") || value_of(r->doc, node, "at least"))
        return add_size(r, node);
    return document_read_mapping(r->doc, node, "expect", keys, sizeof keys / sizeof keys[0], r);
}

/* ---- what the study contains ---- */

static const char *const lifted_names[] = {"H", "|p|", "|pi|", "|pi_e|"};

static int has_quantity(const study_case *e, const char *name)
{
    const dal_system *s = e->system;
    const int lifted = s->call.adjoint && e->starts & ~(1 << STUDY_PHYSICAL);
    if (strcmp(name, "state") == 0) return 1;
    if (strcmp(name, "E") == 0) return s->energy != NULL;
    if (strcmp(name, "error") == 0) return s->exact != NULL;
    if (study_is_constraint(name)) return s->constraints && atoi(name + 1) <= s->m && s->m > 0;
    for (size_t i = 0; lifted && i < sizeof lifted_names / sizeof(char *); i++)
        if (strcmp(lifted_names[i], name) == 0) return 1;
    for (int i = 0; i < s->invariants; i++)
        if (strcmp(s->invariant[i], name) == 0) return 1;
    return 0;
}

static int check_label(const reader *r, const yaml_node_t *node)
{
    const study_plan *plan = r->plan;
    const char **names = cli_calloc((size_t)plan->case_count + 1, sizeof *names);
    int found = 0;
    for (int i = 0; i < plan->case_count; i++) {
        names[i] = plan->cases[i].label;
        found |= study_case_matches(&plan->cases[i], r->label);
    }
    int status = found ? CLI_DONE
                       : document_fail_unknown(r->doc, node, "label of this study", r->label, names,
                                               plan->case_count);
    free(names);
    return status;
}

static int check_method(const reader *r, const yaml_node_t *node)
{
    for (int i = 0; i < r->plan->case_count; i++) {
        const study_case *e = &r->plan->cases[i];
        for (int k = 0; study_case_matches(e, r->label) && k < e->method_count; k++)
            if (study_method_matches(&e->methods[k], r->method)) return CLI_DONE;
    }
    return document_fail(r->doc, node, "expect: '%s' is not run with '%s' in this study", r->label,
                         r->method);
}

static int check_quantity(const reader *r, const yaml_node_t *node, const char *name)
{
    for (int i = 0; i < r->plan->case_count; i++) {
        const study_case *e = &r->plan->cases[i];
        if (study_case_matches(e, r->label) && has_quantity(e, name)) return CLI_DONE;
    }
    return document_fail(r->doc, node, "expect: '%s' has no quantity '%s' in this study", r->label,
                         name);
}

/* ---- the levels of the mapping ---- */

typedef int taker(reader *r, const yaml_node_t *key, const char *name, yaml_node_t *value);

static int each_pair(reader *r, yaml_node_t *node, const char *what, taker *take)
{
    int status = CLI_DONE;
    if (node->type != YAML_MAPPING_NODE)
        return document_fail(r->doc, node, "expect: %s are wanted", what);
    yaml_node_pair_t *pair = node->data.mapping.pairs.start;
    for (; pair < node->data.mapping.pairs.top && status == CLI_DONE; pair++) {
        const yaml_node_t *key = document_node(r->doc, pair->key);
        const char *name = document_scalar(r->doc, key, "expect");
        if (!name) return CLI_USAGE;
        status = take(r, key, name, document_node(r->doc, pair->value));
    }
    return status;
}

/* A word, a list of words, a mapping, or a list of mappings. */
static int take_one(reader *r, const char *name, yaml_node_t *value)
{
    r->expectation =
        (study_expectation){.label = r->label, .method = r->method, .quantity = name, .start = -1};
    if (value->type == YAML_MAPPING_NODE) return add_mapping(r, value);
    return add_words(r, value, is_state(&r->expectation) ? &of_state : &any_words);
}

static int take_quantity(reader *r, const yaml_node_t *key, const char *name, yaml_node_t *value)
{
    int status = check_quantity(r, key, name);
    const int count = document_count(value);
    const int is_list = value->type == YAML_SEQUENCE_NODE && count > 0 &&
                        document_item(r->doc, value, 0)->type == YAML_MAPPING_NODE;
    if (status == CLI_DONE && !is_list) return take_one(r, name, value);
    for (int i = 0; i < count && status == CLI_DONE; i++)
        status = take_one(r, name, document_item(r->doc, value, i));
    return status;
}

static int take_method(reader *r, const yaml_node_t *key, const char *name, yaml_node_t *value)
{
    r->method = name;
    int status = check_method(r, key);
    return status == CLI_DONE ? each_pair(r, value, "quantities", take_quantity) : status;
}

static int take_label(reader *r, const yaml_node_t *key, const char *name, yaml_node_t *value)
{
    r->label = name;
    int status = check_label(r, key);
    return status == CLI_DONE ? each_pair(r, value, "integrators", take_method) : status;
}

int study_expect_read(study_plan *plan, const document *doc, yaml_node_t *node)
{
    reader r = {.plan = plan, .doc = doc};
    return node ? each_pair(&r, node, "labels", take_label) : CLI_DONE;
}
