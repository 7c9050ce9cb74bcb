/* study_expect.c - the expectations of a study, read from its file.
 *
 *     expect:
 *       LABEL:                              the label of a start, item or system, or all
 *         INTEGRATOR:                       as in the study, or all, or all+project and the like
 *           QUANTITY: rounding              a size, or a trend
 *           QUANTITY: [exact, none]         one of several
 *           QUANTITY: {at most: 1e-10}      its size: max |x| for D, error and momenta, else
 *                                           max |x - first|
 *           QUANTITY: {trend: linear, rate: {at least: -2e-3, at most: -1e-3}}
 *           QUANTITY: [{step: 0.1, ..}, {step: 0.05, start: surface, ..}]   of these cells alone
 *           state: failed                   of the run: done, failed, refused
 *
 * A quantity is one of quantities.csv, D, the constraint with the largest max |D|, or a formula,
 * see study_observe.c.  An expectation about something that the study does not contain is an error,
 * and so is a size or a trend of E where no system of the label conserves it. */
#include "study_expect.h"
#include "dalembert_program.h"
#include "study_methods.h"

#include "io/file.h"
#include "run/columns.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/screen.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { LABELS = 200 /* columns of a list of labels */ };

typedef struct expect_reader {
    study_plan *plan;
    const document *doc;
    study_expectation expectation; /* the present one */
} expect_reader;

static int add(expect_reader *r, const yaml_node_t *node)
{
    study_plan *plan = r->plan;
    const size_t count = (size_t)plan->expectation_count + 1;
    plan->expectations = cli_realloc(plan->expectations, count * sizeof *plan->expectations);
    r->expectation.line = node->start_mark.line + 1;
    plan->expectations[plan->expectation_count++] = r->expectation;
    return CLI_DONE;
}

/* ---- what an expectation is about ---- */

bool study_label_means(const study_case *e, const char *label)
{
    return strcmp(label, e->label) == 0 || strcmp(label, e->item_label) == 0 ||
           strcmp(label, e->name) == 0 || strcmp(label, "all") == 0 ||
           (e->variant && strcmp(label, e->variant) == 0);
}

/* Whether a name means a method of a case: its own, without the +project that the case adds or
 * with it, all, or all with exactly its modifiers. */
static bool is_method(const study_case *e, const dal_method *method, const char *name)
{
    char own[STUDY_NAME];
    dal_method_name(method, own, sizeof own);
    if (strncmp(name, "all+", 4) == 0) return strcmp(own + strcspn(own, "+"), name + 3) == 0;
    return strcmp(name, "all") == 0 || study_completes_to(e, name, method);
}

bool study_expectation_covers(const study_expectation *x, const study_cell *c)
{
    if (x->step > 0.0 && x->step != c->step) return false;
    if (x->tolerance > 0.0 && x->tolerance != c->tolerance) return false;
    if (x->start != STUDY_STARTS && x->start != c->start) return false;
    return study_label_means(c->of_case, x->label) && is_method(c->of_case, c->method, x->method);
}

bool study_expects_state(const study_expectation *x) { return strcmp(x->quantity, "state") == 0; }

/* D, D1, D2, ... */
static bool is_constraint(const char *quantity)
{
    return quantity[0] == 'D' && strspn(quantity + 1, "0123456789") == strlen(quantity + 1);
}

/* ---- words ---- */

/* The words for a value, and which bit of an expectation the first of them is. */
typedef struct word_list {
    const char *what;
    const char *const *word;
    int count, first;
} word_list;

#define WORD(code, word) word,
static const char *const trend_words[] = {DAL_SIZE_LIST(WORD) DAL_TREND_LIST(WORD)};
#undef WORD

static const word_list any_words = {"size or trend", trend_words, DAL_SIZE_COUNT + DAL_TREND_COUNT,
                                    0};
static const word_list of_state = {"state", study_state_words, STUDY_STATES, 0};
static const word_list of_value[] = {
    {"size", trend_words, DAL_SIZE_COUNT, 0},
    {"trend", trend_words + DAL_SIZE_COUNT, DAL_TREND_COUNT, DAL_SIZE_COUNT}};

/* A word of 0.2 is refused with its successor. */
static int check_word(const expect_reader *r, const yaml_node_t *item)
{
    static const char *const renamed[][2] = {
        {"bounded", "none"}, {"linear drift", "linear"}, {"not enough data", "undecided"}};
    const char *word = item->type == YAML_SCALAR_NODE ? (char *)item->data.scalar.value : "";
    for (size_t i = 0; i < sizeof renamed / sizeof renamed[0]; i++)
        if (strcmp(word, renamed[i][0]) == 0)
            return document_fail(r->doc, item, "expect: '%s' is now the trend '%s'", word,
                                 renamed[i][1]);
    return CLI_DONE;
}

/* Whether a system of the label conserves E, at least on D = 0. */
static bool is_energy_conserved(const expect_reader *r)
{
    for (int i = 0; i < r->plan->case_count; i++) {
        const study_case *e = &r->plan->cases[i];
        if (study_label_means(e, r->expectation.label) &&
            e->system->properties & (DAL_E_EXACT | DAL_E_ON_D))
            return true;
    }
    return false;
}

static int add_words(expect_reader *r, yaml_node_t *node, const word_list *known)
{
    study_expectation *x = &r->expectation;
    x->words = 0;
    x->field = -1;
    if (strcmp(x->quantity, "E") == 0 && !is_energy_conserved(r))
        return document_fail(r->doc, node,
                             "expect: E has neither size nor trend, since the motion of '%s' does "
                             "not conserve it",
                             x->label);
    for (int i = 0; i < document_count(node); i++) {
        const yaml_node_t *item = document_item(r->doc, node, i);
        if (check_word(r, item) != CLI_DONE) return CLI_USAGE;
        const int k = document_word(r->doc, item, known->what, known->word, known->count);
        if (k < 0) return CLI_USAGE;
        x->words |= 1u << (known->first + k);
    }
    if (x->words == 0) return document_fail(r->doc, node, "expect: the list is empty");
    return add(r, node);
}

static int read_words(void *user, const document *doc, yaml_node_t *value, const document_key *key)
{
    (void)doc;
    return add_words(user, value, &of_value[key->offset]);
}

/* ---- bounds ---- */

/* Bounds of a field have the first two keys alone. */
static const document_key bound_keys[] = {
    {"at most", document_read_number, offsetof(expect_reader, expectation.max)},
    {"at least", document_read_number, offsetof(expect_reader, expectation.min)},
    {.name = "step"},
    {.name = "tolerance"},
    {.name = "start"}};

static int add_bounds(expect_reader *r, int field, yaml_node_t *node, int keys)
{
    study_expectation *x = &r->expectation;
    x->field = field;
    x->words = 0;
    x->min = -INFINITY;
    x->max = INFINITY;
    int status = document_read_mapping(r->doc, node, "bounds", bound_keys, keys, r);
    if (status != CLI_DONE) return status;
    if (isinf(x->min) && isinf(x->max))
        return document_fail(r->doc, node, "bounds: 'at most' or 'at least' is required");
    return add(r, node);
}

static int read_field(void *user, const document *doc, yaml_node_t *value, const document_key *key)
{
    (void)doc;
    return add_bounds(user, (int)key->offset, value, 2);
}

/* ---- mappings ---- */

/* step, tolerance and start hold for the other keys, wherever they stand, and are read before
 * them. */
static int read_cells(expect_reader *r, yaml_node_t *node)
{
    static const document_key number_keys[] = {
        {"step", document_read_number, offsetof(expect_reader, expectation.step)},
        {"tolerance", document_read_number, offsetof(expect_reader, expectation.tolerance)}};
    yaml_node_t *start = document_value(r->doc, node, "start");
    study_expectation *x = &r->expectation;
    for (int i = 0; i < 2; i++) {
        yaml_node_t *number = document_value(r->doc, node, number_keys[i].name);
        if (number && document_read_number(r, r->doc, number, &number_keys[i]) != CLI_DONE)
            return CLI_USAGE;
    }
    if (start) {
        const int word = document_word(r->doc, start, "start", study_start_words, STUDY_STARTS);
        if (word < 0) return CLI_USAGE;
        x->start = (study_start)word;
    }
    for (int i = 0; i < r->plan->cell_count; i++)
        if (study_expectation_covers(x, &r->plan->cells[i])) return CLI_DONE;
    return document_fail(r->doc, node, "expect: the study has no such step%s and start",
                         r->plan->has_tolerances ? ", tolerance" : "");
}

static int add_mapping(expect_reader *r, yaml_node_t *node)
{
    static const document_key keys[] = {{"size", read_words, 0},    {"trend", read_words, 1},
                                        {.name = "step"},           {.name = "tolerance"},
                                        {.name = "start"},
#define FIELD_KEY(name, member) {#name, read_field, STUDY_FIELD_##name},
                                        STUDY_FIELD_LIST(FIELD_KEY)
#undef FIELD_KEY
    };
    const char *quantity = r->expectation.quantity;
    if (study_expects_state(&r->expectation))
        return document_fail(r->doc, node, "state: words are required");
    const yaml_node_t *old = document_value(r->doc, node, "verdict");
    if (old) return document_fail(r->doc, old, "expect: 'verdict' is now 'size' and 'trend'");
    const int status = read_cells(r, node);
    if (status != CLI_DONE) return status;
    if (!document_value(r->doc, node, "at most") && !document_value(r->doc, node, "at least"))
        return document_read_mapping(r->doc, node, "expect", keys, sizeof keys / sizeof keys[0], r);
    /* Bounds beside the cells are of the size that the tables show. */
    const bool is_max =
        quantity[0] == '|' || strcmp(quantity, "error") == 0 || is_constraint(quantity);
    return add_bounds(r, is_max ? STUDY_FIELD_max : STUDY_FIELD_deviation, node, 5);
}

/* ---- what the study contains ---- */

bool study_is_of_lift(const char *name)
{
    static const char *const lifted_names[] = {"H", "|p|", "|pi|", "|pi_e|"};
    for (size_t i = 0; i < sizeof lifted_names / sizeof(char *); i++)
        if (strcmp(lifted_names[i], name) == 0) return true;
    return false;
}

bool study_has_quantity(const study_case *e, const char *name)
{
    const dal_system *s = e->system;
    const bool is_lifted = s->call.adjoint && e->starts & ~(1 << STUDY_PHYSICAL);
    if (strcmp(name, "state") == 0) return true;
    if (strcmp(name, "E") == 0) return s->energy != NULL;
    if (strcmp(name, "error") == 0) return s->exact != NULL;
    if (is_constraint(name)) return s->constraints && atoi(name + 1) <= s->m && s->m > 0;
    if (is_lifted && study_is_of_lift(name)) return true;
    for (int i = 0; i < s->invariants; i++)
        if (strcmp(s->invariant[i], name) == 0) return true;
    return e->options.reactions && columns_need_reactions(s, name);
}

/* Whether a system of the label is run with a method, or has a quantity; NULL: any. */
static bool is_in_study(const expect_reader *r, const char *method, const char *quantity)
{
    for (int i = 0; i < r->plan->case_count; i++) {
        const study_case *e = &r->plan->cases[i];
        if (!study_label_means(e, r->expectation.label)) continue;
        if (quantity && !study_has_quantity(e, quantity)) continue;
        for (int k = 0; k < e->method_count; k++)
            if (!method || is_method(e, &e->methods[k], method)) return true;
    }
    return false;
}

static int refuse_label(const expect_reader *r, const yaml_node_t *node, const char *label)
{
    const study_plan *plan = r->plan;
    const char **names = cli_calloc((size_t)plan->case_count, sizeof *names);
    for (int i = 0; i < plan->case_count; i++) names[i] = plan->cases[i].label;
    const size_t length = strlen(label);
    const char *hint = dal__nearest_name(label, names, plan->case_count);
    for (int i = 0; i < plan->case_count; i++)
        if (strncmp(names[i], label, length) == 0 && names[i][length] == '.') hint = names[i];
    char *labels = screen_list_names(names, plan->case_count, LABELS);
    const int status =
        document_fail(r->doc, node, "unknown label of this study '%s'; %s '%s'%s", label,
                      hint ? "did you mean" : "there is", hint ? hint : labels, hint ? "?" : "");
    free(labels);
    free(names);
    return status;
}

/* ---- the levels of the mapping ---- */

/* A word, a list of words, a mapping, or a list of mappings. */
static int read_quantity(expect_reader *r, const document_pair *pair)
{
    yaml_node_t *value = pair->value;
    study_expectation *x = &r->expectation;
    const int count = document_count(value);
    const bool is_list = value->type == YAML_SEQUENCE_NODE && count > 0 &&
                         document_item(r->doc, value, 0)->type == YAML_MAPPING_NODE;
    int status = CLI_DONE;
    if (!is_in_study(r, NULL, pair->name))
        return document_fail(r->doc, pair->key, "expect: '%s' has no quantity '%s' in this study",
                             x->label, pair->name);
    for (int i = 0; i < (is_list ? count : 1) && status == CLI_DONE; i++) {
        yaml_node_t *item = is_list ? document_item(r->doc, value, i) : value;
        *x = (study_expectation){
            .label = x->label, .method = x->method, .quantity = pair->name, .start = STUDY_STARTS};
        if (item->type == YAML_MAPPING_NODE)
            status = add_mapping(r, item);
        else
            status = add_words(r, item, study_expects_state(x) ? &of_state : &any_words);
    }
    return status;
}

static int read_method(expect_reader *r, const document_pair *method)
{
    document_pair pair;
    r->expectation.method = method->name;
    if (!is_in_study(r, method->name, NULL))
        return document_fail(r->doc, method->key, "expect: '%s' is not run with '%s' in this study",
                             r->expectation.label, method->name);
    int status = document_check_mapping(r->doc, method->value, "expect", "quantities");
    for (int i = 0; status == CLI_DONE && document_get_pair(r->doc, method->value, i, &pair); i++)
        status = read_quantity(r, &pair);
    return status;
}

static int read_label(expect_reader *r, const document_pair *label)
{
    document_pair pair;
    r->expectation.label = label->name;
    if (!is_in_study(r, NULL, NULL)) return refuse_label(r, label->key, label->name);
    int status = document_check_mapping(r->doc, label->value, "expect", "integrators");
    for (int i = 0; status == CLI_DONE && document_get_pair(r->doc, label->value, i, &pair); i++)
        status = read_method(r, &pair);
    return status;
}

int study_expect_read(study_plan *plan, yaml_node_t *node)
{
    expect_reader r = {.plan = plan, .doc = plan->doc};
    document_pair pair;
    int status = node ? document_check_mapping(plan->doc, node, "expect", "labels") : CLI_DONE;
    for (int i = 0; node && status == CLI_DONE && document_get_pair(plan->doc, node, i, &pair); i++)
        status = read_label(&r, &pair);
    return status;
}
