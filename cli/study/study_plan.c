/* study_plan.c - from the keys of a study to its cases and cells.
 *
 * Keys beside `systems` are defaults for every system; a system may be a name or a mapping that
 * overrides them.  'dalembert study --help' lists the keys. */
#include "study_plan.h"

#include "io/file.h"
#include "io/text.h"
#include "run/request.h"
#include "run/row_times.h"
#include "run/system.h"
#include "study_expect.h"
#include "study_methods.h"
#include "study_observe.h"
#include "study_results.h"
#include "study_values.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/options.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* ---- the keys of a study file -------------------------------------------------------------- */

static int read_label(void *user, const document *doc, yaml_node_t *value, const document_key *key)
{
    parsed_study *p = user;
    const int status = document_read_text(user, doc, value, key);
    if (status != CLI_DONE) return status;
    const char *label = p->item.item_label;
    if (text_is_file_name(label)) return CLI_DONE;
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
        if (e->step[i] == 0.0) return document_fail(doc, node, "step: it must not be 0");
        for (int k = 0; k < i; k++)
            if (e->step[k] == e->step[i])
                return document_fail(doc, node, "step: %g comes twice", e->step[i]);
    }
    return CLI_DONE;
}

static int read_step(void *user, const document *doc, yaml_node_t *value, const document_key *key)
{
    study_values values;
    int status = study_values_read(&values, doc, value, key->name);
    if (status == CLI_DONE) status = set_steps(&((parsed_study *)user)->item, doc, value, &values);
    study_values_free(&values);
    return status;
}

static int set_tolerances(study_case *e, const document *doc, const yaml_node_t *node,
                          const study_values *values)
{
    if (values->is_drawn) return document_fail(doc, node, "tolerance: it must not be random");
    if (values->count > STUDY_TOLERANCES)
        return document_fail(doc, node, "tolerance: %d values, not 1..%d", values->count,
                             STUDY_TOLERANCES);
    const bool is_none = values->count == 1 && values->value[0] == 0.0;
    e->tolerances = is_none ? 0 : values->count;
    for (int i = 0; i < e->tolerances; i++) {
        e->tolerance[i] = values->value[i];
        if (!(e->tolerance[i] > 0.0 && e->tolerance[i] <= 1.0))
            return document_fail(doc, node, "tolerance: %g is not above 0 and at most 1",
                                 e->tolerance[i]);
        for (int k = 0; k < i; k++)
            if (e->tolerance[k] == e->tolerance[i])
                return document_fail(doc, node, "tolerance: %g comes twice", e->tolerance[i]);
    }
    return CLI_DONE;
}

static int read_tolerance(void *user, const document *doc, yaml_node_t *value,
                          const document_key *key)
{
    study_values values;
    int status = study_values_read(&values, doc, value, key->name);
    if (status == CLI_DONE)
        status = set_tolerances(&((parsed_study *)user)->item, doc, value, &values);
    study_values_free(&values);
    return status;
}

/* The key `time` or `steps`, which replaces the other one of the whole study. */
static int read_end(void *user, const document *doc, yaml_node_t *value, const document_key *key)
{
    study_case *e = &((parsed_study *)user)->item;
    const bool is_time = key->offset == offsetof(parsed_study, item.time);
    e->time = NAN;
    e->run_steps = 0;
    return is_time ? document_read_number(user, doc, value, key)
                   : document_read_count(user, doc, value, key);
}

static int read_option(study_case *e, const document *doc, const document_pair *pair)
{
#define WORD(code, name) name,
    static const char *const efforts[] = {DAL_EFFORT_LIST(WORD)};
#undef WORD
    dal_error error = {0};
    const char *name = pair->name, *word = document_scalar(doc, pair->value, name);
    if (!word) return CLI_USAGE;
    if (strcmp(name, "step") == 0 || strcmp(name, "space") == 0 || strcmp(name, "mechanics") == 0)
        return document_fail(doc, pair->key, "options: %s has a key of its own", name);
    if (cli_renamed_option(name))
        return document_fail(doc, pair->key, "options: %s is called %s now", name,
                             cli_renamed_option(name));
    if (cli_renamed_value(name, word))
        return document_fail(doc, pair->key, "options: %s: %s is called %s now", name, word,
                             cli_renamed_value(name, word));
    const bool is_effort = strcmp(name, "effort") == 0, is_gauge = strcmp(name, "gauge") == 0;
    const int effort =
        is_effort ? document_word(doc, pair->value, name, efforts, DAL_EFFORT_COUNT) : 0;
    if (effort < 0) return CLI_USAGE;
    if (is_effort) e->choices.effort = (dal_effort)effort;
    if (is_gauge) e->choices.gauge = word;
    if (!is_effort && !is_gauge &&
        dal_options_set(&e->options, name, word, &error) != DAL_STATUS_OK)
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

static int read_rows(void *user, const document *doc, yaml_node_t *value, const document_key *key)
{
    static const char *const words[] = {"kept", "none"};
    const int word = document_word(doc, value, key->name, words, 2);
    *(study_rows *)((char *)user + key->offset) = word == 1 ? STUDY_ROWS_NONE : STUDY_ROWS_KEPT;
    return word < 0 ? CLI_USAGE : CLI_DONE;
}

static int read_flag(void *user, const document *doc, yaml_node_t *value, const document_key *key)
{
    static const char *const words[] = {"off", "on"};
    const int word = document_word(doc, value, key->name, words, 2);
    *(bool *)((char *)user + key->offset) = word == 1;
    return word < 0 ? CLI_USAGE : CLI_DONE;
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

static bool gives_two_ends(const document *doc, const yaml_node_t *node)
{
    return document_value(doc, node, "time") && document_value(doc, node, "steps");
}

static int read_study(parsed_study *parsed, const document *doc, yaml_node_t *node)
{
    if (node->type == YAML_MAPPING_NODE && gives_two_ends(doc, node))
        return document_fail(doc, node, "steps exclude time");
    return document_read_mapping(doc, node, "a study", keys, KEY_system, parsed);
}

static int read_system(parsed_study *parsed, const document *doc, yaml_node_t *node)
{
    if (node->type != YAML_MAPPING_NODE)
        return document_read_text(parsed, doc, node, &keys[KEY_system]);
    if (gives_two_ends(doc, node)) return document_fail(doc, node, "steps exclude time");
    return document_read_mapping(doc, node, "a system", keys + KEY_integrators,
                                 KEYS - KEY_integrators, parsed);
}

/* ---- settings and methods ---- */

/* What is read of one item of 'systems': some cases. */
typedef struct item_reader {
    study_plan *plan;
    const document *doc;
    yaml_node_t *node; /* of the system */
    parsed_study parsed;
    bool chooses_step; /* none is given: it is chosen */
    study_variants *variants;
    study_case *item; /* the present case */
} item_reader;

/* Momenta in units of the displacement: one value each. */
static int read_displacement(study_case *e, const document *doc, const yaml_node_t *node)
{
    document_pair pair;
    double value;
    int status = document_check_mapping(doc, node, "displace", "names and values");
    for (int i = 0; status == CLI_DONE && document_get_pair(doc, node, i, &pair); i++) {
        status = document_number(doc, pair.value, "displace", &value);
        if (status == CLI_DONE) request_add_setting(&e->displace, pair.name, value);
    }
    return status;
}

/* ---- systems ---- */

char *study_plan_copy_path(const char *directory, const study_case *e)
{
    return cli_format("%s/%s.yaml", directory, e->label);
}

/* A relative path begins at the study file.  In the directory of a study a system with a copy was a
 * file, wherever the program is started. */
static int load_system(const item_reader *g, study_case *e)
{
    const char *names[CLI_MAX_BUILTINS], *copies = g->plan->copies;
    char *copy = copies ? study_plan_copy_path(copies, e) : NULL;
    const char *place = g->doc->place, *slash = e->name[0] == '/' ? NULL : strrchr(place, '/');
    const int folder = slash ? (int)(slash - place) + 1 : 0;
    char *path = copies ? NULL : cli_format("%.*s%s", folder, place, e->name);
    const bool is_path =
        cli_is_path(e->name) || (path && !dal_builtin_text(e->name) && file_exists(path));
    e->copy = copy && (is_path || file_exists(copy)) ? copy : NULL;
    e->path = is_path ? path : NULL;
    if (!e->copy) free(copy);
    if (!e->path) free(path);
    if (e->path && !file_exists(e->path) && file_exists(e->name))
        return document_fail(g->doc, g->node,
                             "there is no '%s': paths are relative to the study file, not to the "
                             "working directory, which has '%s'",
                             e->path, e->name);
    if (e->copy || is_path || dal_builtin_text(e->name))
        return cli_load(study_case_system(e), &e->choices, &e->model, &e->system);
    return document_fail_unknown(g->doc, g->node, "system", e->name, names, cli_builtins(names));
}

/* Checks that the system knows the names; what else may be wrong with values is for the cells. */
static int check_names(const item_reader *g, const yaml_node_t *node, const char *what,
                       const request_settings *start)
{
    dal_run *run;
    dal_error error = {0};
    const study_case *e = g->item;
    dal_run_spec spec = {.system = e->system,
                         .method = e->methods[0],
                         .options = dal_options_default(),
                         .parameters = e->set.item,
                         .parameter_count = e->set.count,
                         .start = start->item,
                         .start_count = start->count};
    if (!node) return CLI_DONE;
    if (!e->system->call.adjoint) spec.options.space = DAL_PHYSICAL;
    const dal_status created = dal_run_create(&run, &spec, &error);
    if (cli_is_ok(created)) dal_run_free(run);
    if (created != DAL_STATUS_NAME) return CLI_DONE;
    return document_fail(g->doc, node, "%s: %s", what, error.message);
}

static bool is_adaptive(const dal_method *method)
{
    return (dal_method_properties(method) & DAL_ADAPTIVE) != 0;
}

/* Under a tolerance a step may be missing, as in a run, where all methods have one. */
static int check_chosen_step(const item_reader *g, const study_case *e)
{
    char name[STUDY_NAME];
    for (int i = 0; g->chooses_step && i < e->method_count; i++)
        if (!is_adaptive(&e->methods[i]))
            return document_fail(g->doc, g->node,
                                 "%s: the step is missing, and %s takes no tolerance", e->name,
                                 dal_method_name(&e->methods[i], name, sizeof name));
    return CLI_DONE;
}

/* The first case of an item reads what the others share. */
static int read_first_case(const item_reader *g, study_case *e)
{
    const parsed_study *p = &g->parsed;
    int status = study_read_methods(e, g->doc, p->integrators);
    e->method_steps = cli_calloc((size_t)e->method_count + 1, sizeof *e->method_steps);
    if (status == CLI_DONE) status = check_chosen_step(g, e);
    if (status == CLI_DONE) status = load_system(g, e);
    if (status == CLI_DONE) study_complete_methods(e);
    if (status == CLI_DONE) status = check_names(g, p->set, "set", &(request_settings){0});
    if (status == CLI_DONE) status = check_names(g, p->start, "start", &e->start);
    if (status == CLI_DONE) status = check_names(g, p->displace, "displace", &e->displace);
    return status;
}

/* ---- cases ---- */

static void choose_step(item_reader *g)
{
    study_case *e = &g->parsed.item;
    g->chooses_step =
        e->steps == 0 && !isnan(e->time) && (e->tolerances > 0 || e->options.tolerance > 0.0);
    if (!g->chooses_step) return;
    e->step[0] = (e->time - e->from) / REQUEST_CHOSEN_STEPS;
    e->steps = 1;
}

static int check_case(const item_reader *g)
{
    const document *doc = g->doc;
    const yaml_node_t *node = g->node;
    const study_case *e = &g->parsed.item;
    if (!e->name) return document_fail(doc, node, "the system is missing");
    if (!g->parsed.integrators)
        return document_fail(doc, node, "%s: the integrators are missing", e->name);
    if (e->steps == 0) return document_fail(doc, node, "%s: the step is missing", e->name);
    if (e->tolerances > 0 && e->option[REQUEST_tolerance])
        return document_fail(doc, node, "%s: the tolerance is given as a key and among the options",
                             e->name);
    if (isnan(e->time) && e->run_steps == 0)
        return document_fail(doc, node, "%s: the time is missing", e->name);
    for (int i = 0; i < e->steps; i++) {
        char text[STEP_ERROR_SIZE];
        const double end = study_case_end(e, e->step[i]);
        if (!(copysign(1.0, e->step[i]) * (end - e->from) > 0.0))
            return document_fail(doc, node, "%s: a step of %g does not lead from t = %g to t = %g",
                                 e->name, e->step[i], e->from, end);
        const char *error = step_error(e->step[i], e->from, end, text);
        if (error) return document_fail(doc, node, "%s: step %s", e->name, error);
    }
    const double min = dal_min_tolerance(&e->options);
    for (int i = -1; i < e->tolerances; i++) {
        const double tolerance = i < 0 ? e->options.tolerance : e->tolerance[i];
        if (tolerance > 0.0 && tolerance < min)
            return document_fail(doc, node,
                                 "%s: tolerance: %g is below %.2g, the smallest in this precision",
                                 e->name, tolerance, min);
    }
    return CLI_DONE;
}

static int add_case(item_reader *g, int i, const study_case *first)
{
    study_plan *plan = g->plan;
    study_case *e = g->item = &plan->cases[plan->case_count];
    yaml_node_t *displace = g->parsed.displace;
    int status = CLI_DONE;
    *e = g->parsed.item;
    e->is_first = i == 0;
    study_variants_apply(g->variants, i, e);
    for (int k = 0; k < plan->case_count; k++)
        if (strcmp(plan->cases[k].label, e->label) == 0)
            status = document_fail(g->doc, g->node, "two systems called '%s': give one a label",
                                   e->label);
    plan->case_count++;
    if (status == CLI_DONE && displace) status = read_displacement(e, g->doc, displace);
    if (status != CLI_DONE) return status;
    if (i == 0) {
        status = read_first_case(g, e);
    } else {
        e->model = first->model;
        e->system = first->system;
        e->copy = first->copy;
        e->path = first->path;
        e->methods = first->methods;
        e->method_count = first->method_count;
        e->method_steps = first->method_steps;
    }
    return status == CLI_DONE ? study_variants_project_start(g->variants, e) : status;
}

/* The cases of one mechanics, number i of a list, or of the system file's. */
static int add_cases(item_reader *g, int i)
{
#define WORD(code, name) name,
    static const char *const words[] = {DAL_MECHANICS_LIST(WORD)};
#undef WORD
    study_plan *plan = g->plan;
    study_case *e = &g->parsed.item;
    yaml_node_t *list = g->parsed.mechanics;
    int count = 0;
    e->variant = NULL;
    if (list) {
        const int k = document_word(g->doc, document_item(g->doc, list, i), "mechanics", words,
                                    DAL_MECHANICS_COUNT);
        if (k < 0) return CLI_USAGE;
        e->choices.mechanics = (dal_mechanics)k;
        e->option[REQUEST_mechanics] = words[k];
        if (document_count(list) > 1) e->variant = cli_format("%s_%s", e->item_label, words[k]);
    }
    int status = study_variants_read(&g->variants, g->doc, &g->parsed, &count);
    const int first = plan->case_count;
    if (status == CLI_DONE)
        plan->cases = cli_realloc(plan->cases, (size_t)(first + count) * sizeof *plan->cases);
    for (int k = 0; k < count && status == CLI_DONE; k++)
        status = add_case(g, k, &plan->cases[first]);
    if (plan->case_count == first) free(e->variant);
    study_variants_free(g->variants);
    return status;
}

/* A path labels its case by the file's name without folders. */
static int add_item(study_plan *plan, yaml_node_t *node, const parsed_study *base)
{
    item_reader g = {.plan = plan, .doc = plan->doc, .node = node, .parsed = *base};
    study_case *e = &g.parsed.item;
    int status = read_system(&g.parsed, g.doc, node);
    choose_step(&g);
    if (status == CLI_DONE) status = check_case(&g);
    if (status != CLI_DONE) return status;
    const char *slash = strrchr(e->name, '/');
    if (!e->item_label) e->item_label = slash ? slash + 1 : e->name;
    if (text_find_control(e->name, "") >= 0)
        return document_fail(plan->doc, node, "system: '%s' has control characters", e->name);
    if (e->item_label[0] == '.')
        return document_fail(plan->doc, node, "system: '%s' cannot name a file: give it a label",
                             e->name);
    yaml_node_t *mechanics = g.parsed.mechanics;
    const int variants = mechanics ? document_count(mechanics) : 1;
    if (variants == 0) return document_fail(plan->doc, mechanics, "mechanics: the list is empty");
    for (int i = 0; i < variants && status == CLI_DONE; i++) status = add_cases(&g, i);
    return status;
}

static int read_systems(study_plan *plan, const yaml_node_t *root, const parsed_study *base)
{
    int count = base->systems ? document_count(base->systems) : 0, status = CLI_DONE;
    if (count == 0) return document_fail(plan->doc, root, "the systems are missing");
    for (int i = 0; i < count && status == CLI_DONE; i++)
        status = add_item(plan, document_item(plan->doc, base->systems, i), base);
    return status;
}

/* The integrators that the screen shows, each of them run somewhere. */
static int read_representatives(study_plan *plan, yaml_node_t *node)
{
    const document *doc = plan->doc;
    const int count = node ? document_count(node) : 0;
    if (count > STUDY_REPRESENTATIVES)
        return document_fail(doc, node, "representatives: %d are more than %d", count,
                             STUDY_REPRESENTATIVES);
    for (int i = 0; i < count; i++) {
        const yaml_node_t *item = document_item(doc, node, i);
        const char *name = document_scalar(doc, item, "representatives");
        dal_method *method = &plan->representative[plan->representatives++];
        dal_error error = {0};
        if (!name) return CLI_USAGE;
        if (dal_method_parse(method, name, &error) != DAL_STATUS_OK)
            return document_fail(doc, item, "%s", error.message);
        if (!study_find_method(plan, name, method))
            return document_fail(doc, item, "representatives: '%s' is not run in this study", name);
    }
    return CLI_DONE;
}

/* ---- cells ---- */

/* Every cell has a directory of its own, whose name must fit.  The starts change fastest, then
 * tolerances. */
static int add_cells(study_plan *plan, study_case *e)
{
    enum { MAX_NAME = 255 };
    const int tolerances = e->tolerances > 0 ? e->tolerances : 1;
    const int per_step = tolerances * STUDY_STARTS, per_method = e->steps * per_step;
    const int max = e->method_count * per_method;
    const size_t capacity = (size_t)plan->cell_count + (size_t)max;
    plan->cells = cli_realloc(plan->cells, capacity * sizeof *plan->cells);
    e->first_cell = plan->cell_count;
    plan->has_tolerances |= e->tolerances > 0;
    plan->has_predictions |= e->predict;
    for (int i = 0; i < max; i++) {
        study_cell cell = {.of_case = e,
                           .method = &e->methods[i / per_method],
                           .step = e->step[i % per_method / per_step],
                           .start = i % STUDY_STARTS};
        const int level = i % per_step / STUDY_STARTS;
        if (!(e->starts & 1 << cell.start)) continue;
        if (e->tolerances > 0 && is_adaptive(cell.method))
            cell.tolerance = e->tolerance[level];
        else if (level > 0)
            continue;
        cell.name = study_cell_name(&cell);
        plan->cells[plan->cell_count++] = cell;
        if (strlen(cell.name) > MAX_NAME)
            return cli_fail(CLI_USAGE,
                            "%s: '%.60s...' is too long a name for a directory: %zu bytes, not at "
                            "most %d; a short label helps",
                            plan->doc->place, cell.name, strlen(cell.name), (int)MAX_NAME);
    }
    e->cells = plan->cell_count - e->first_cell;
    return CLI_DONE;
}

void study_plan_add_steps(study_plan *plan)
{
    for (int i = 0; i < plan->case_count; i++)
        for (int k = 0; k < plan->cases[i].method_count; k++)
            for (int space = 0; space < 2; space++) plan->cases[i].method_steps[k][space] = 0.0;
    for (int i = 0; i < plan->cell_count; i++) {
        const study_cell *c = &plan->cells[i];
        if (!c->other_shard) *study_cell_method_steps(c) += study_cell_length(c);
    }
}

/* ---- the plan ---- */

int study_plan_read(study_plan *plan, const char *place, const char *bytes, size_t length,
                    const char *copies)
{
    document *doc = cli_calloc(1, sizeof *doc);
    parsed_study base = {.item = {.time = NAN,
                                  .samples = 400,
                                  .statistics = 1,
                                  .options = dal_options_default(),
                                  .displacement = 1e-8,
                                  .starts = (1 << STUDY_STARTS) - 1}};
    *plan = (study_plan){.doc = doc, .copies = copies};
    int status = document_parse(doc, place, bytes, length);
    if (status != CLI_DONE) return status;
    yaml_node_t *root = yaml_document_get_root_node(&doc->yaml);
    status = read_study(&base, doc, root);
    plan->title = base.title ? base.title : "A study";
    if (status == CLI_DONE) status = read_systems(plan, root, &base);
    if (status == CLI_DONE) status = study_observe(plan, base.expect);
    if (status == CLI_DONE) status = read_representatives(plan, base.representatives);
    for (int i = 0; i < plan->case_count && status == CLI_DONE; i++)
        status = add_cells(plan, &plan->cases[i]);
    return status == CLI_DONE ? study_expect_read(plan, base.expect) : status;
}

void study_plan_free(study_plan *plan)
{
    for (int i = 0; i < plan->cell_count; i++) {
        study_cell_free(&plan->cells[i]);
        free(plan->cells[i].name);
    }
    for (int i = 0; i < plan->case_count; i++) {
        study_case *e = &plan->cases[i];
        if (e->is_first) {
            dal_model_free(e->model);
            free(e->copy);
            free(e->path);
            free(e->observe);
            free(e->variant);
            free(e->methods);
            free(e->method_steps);
        }
        free(e->label);
        request_free_settings(&e->set);
        request_free_settings(&e->start);
        request_free_settings(&e->displace);
    }
    for (int i = 0; i < STUDY_STORED; i++) study_results_free(plan->results[i]);
    free(plan->key);
    if (plan->doc) yaml_document_delete(&plan->doc->yaml);
    free(plan->doc);
    free(plan->cases);
    free(plan->cells);
    free(plan->expectations);
    *plan = (study_plan){0};
}
