/* study_plan.c - from the text of a study to its cells.
 *
 * Keys beside `systems` are defaults for every system; a system may be a name or a mapping that
 * overrides them.  'dalembert study --help' lists the keys. */
#include "study.h"
#include "study_yaml.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What the keys are read into: an entry, the nodes that wait for its system, and what only the
 * whole study has. */
typedef struct draft {
    study_entry entry;
    yaml_node_t *integrators, *set, *start, *displace, *systems;
    const char *title;
} draft;

static const char *const start_words[] = {
#define X(code, word, space, about) word,
    STUDY_START_LIST(X)
#undef X
};

const char *study_start_word(int start) { return start_words[start]; }

/* ---- the keys ---- */

static int take_title(void *user, const study_text *text, yaml_node_t *value)
{
    draft *d = user;
    d->title = study_text_scalar(text, value, "title");
    return d->title ? CLI_DONE : CLI_USAGE;
}

static int take_system(void *user, const study_text *text, yaml_node_t *value)
{
    draft *d = user;
    d->entry.name = study_text_scalar(text, value, "system");
    return d->entry.name ? CLI_DONE : CLI_USAGE;
}

static int take_label(void *user, const study_text *text, yaml_node_t *value)
{
    draft *d = user;
    d->entry.label = study_text_scalar(text, value, "label");
    if (!d->entry.label) return CLI_USAGE;
    if (d->entry.label[0] && !strchr(d->entry.label, '/') && d->entry.label[0] != '.')
        return CLI_DONE;
    return study_text_fail(text, value, "label: '%s' cannot name a file", d->entry.label);
}

static int take_positive(const study_text *text, yaml_node_t *value, const char *what, double *x)
{
    int status = study_text_number(text, value, what, x);
    if (status != CLI_DONE || *x > 0.0) return status;
    return study_text_fail(text, value, "%s: %g is not positive", what, *x);
}

static int take_step(void *user, const study_text *text, yaml_node_t *value)
{
    study_entry *e = &((draft *)user)->entry;
    e->steps = study_text_count(value);
    if (e->steps < 1 || e->steps > STUDY_STEPS)
        return study_text_fail(text, value, "step: %d values, not 1..%d", e->steps, STUDY_STEPS);
    int status = CLI_DONE;
    for (int i = 0; i < e->steps && status == CLI_DONE; i++)
        status = take_positive(text, study_text_item(text, value, i), "step", &e->step[i]);
    return status;
}

static int take_time(void *user, const study_text *text, yaml_node_t *value)
{
    return take_positive(text, value, "time", &((draft *)user)->entry.time);
}

static int take_displacement(void *user, const study_text *text, yaml_node_t *value)
{
    return take_positive(text, value, "displacement", &((draft *)user)->entry.displacement);
}

static int take_samples(void *user, const study_text *text, yaml_node_t *value)
{
    char place[256];
    const char *given = study_text_scalar(text, value, "samples");
    if (!given) return CLI_USAGE;
    snprintf(place, sizeof place, "%s:%zu: samples", text->place, value->start_mark.line + 1);
    return cli_integer(place, given, 1, 1000000000, &((draft *)user)->entry.samples);
}

static int take_option(study_entry *e, const study_text *text, const yaml_node_pair_t *pair)
{
    dal_error error = {0};
    yaml_node_t *key = study_text_node(text, pair->key);
    yaml_node_t *value = study_text_node(text, pair->value);
    const char *name = study_text_scalar(text, key, "options");
    const char *word = name ? study_text_scalar(text, value, name) : NULL;
    if (!word) return CLI_USAGE;
    if (strcmp(name, "step") == 0 || strcmp(name, "space") == 0)
        return study_text_fail(text, key, "options: %s has a key of its own", name);
    if (dal_options_set(&e->options, name, word, &error) == DAL_OK) return CLI_DONE;
    return study_text_fail(text, key, "%s", error.message);
}

static int take_options(void *user, const study_text *text, yaml_node_t *value)
{
    int status = CLI_DONE;
    if (value->type != YAML_MAPPING_NODE)
        return study_text_fail(text, value, "options: names and values are wanted");
    const yaml_node_pair_t *pair = value->data.mapping.pairs.start;
    for (; pair < value->data.mapping.pairs.top && status == CLI_DONE; pair++)
        status = take_option(&((draft *)user)->entry, text, pair);
    return status;
}

static int take_starts(void *user, const study_text *text, yaml_node_t *value)
{
    study_entry *e = &((draft *)user)->entry;
    e->starts = 0;
    for (int i = 0; i < study_text_count(value); i++) {
        const yaml_node_t *item = study_text_item(text, value, i);
        const char *word = study_text_scalar(text, item, "starts");
        if (!word) return CLI_USAGE;
        int start = 0;
        while (start < STUDY_STARTS && strcmp(start_words[start], word) != 0) start++;
        if (start == STUDY_STARTS)
            return study_text_fail(text, item, "starts: '%s' is not physical, surface or displaced",
                                   word);
        e->starts |= 1 << start;
    }
    return e->starts ? CLI_DONE : study_text_fail(text, value, "starts: the list is empty");
}

#define KEEP_NODE(name)                                                                            \
    static int take_##name(void *user, const study_text *text, yaml_node_t *value)                 \
    {                                                                                              \
        (void)text;                                                                                \
        ((draft *)user)->name = value;                                                             \
        return CLI_DONE;                                                                           \
    }
KEEP_NODE(integrators)
KEEP_NODE(set)
KEEP_NODE(start)
KEEP_NODE(displace)
KEEP_NODE(systems)

static const study_key keys[] = {
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

/* ---- settings and methods ---- */

static int read_settings(const study_text *text, yaml_node_t *node, const char *what,
                         dal_setting **list, int *count)
{
    if (!node) return CLI_DONE;
    if (node->type != YAML_MAPPING_NODE)
        return study_text_fail(text, node, "%s: names and values are wanted", what);
    const yaml_node_pair_t *pair = node->data.mapping.pairs.start;
    size_t most = (size_t)(node->data.mapping.pairs.top - pair);
    *list = calloc(most + 1, sizeof **list);
    if (!*list) return cli_fail(CLI_IO, "out of memory");
    for (; pair < node->data.mapping.pairs.top; pair++) {
        dal_setting *s = &(*list)[(*count)++];
        s->name = study_text_scalar(text, study_text_node(text, pair->key), what);
        if (!s->name) return CLI_USAGE;
        int status = study_text_number(text, study_text_node(text, pair->value), what, &s->value);
        if (status != CLI_DONE) return status;
    }
    return CLI_DONE;
}

static int add_method(study_entry *e, const study_text *text, const yaml_node_t *node,
                      const char *name)
{
    dal_error error = {0};
    size_t count = (size_t)e->method_count + 1;
    dal_method *methods = realloc(e->methods, count * sizeof *methods);
    if (!methods) return cli_fail(CLI_IO, "out of memory");
    e->methods = methods;
    if (dal_method_parse(&methods[e->method_count], name, &error) != DAL_OK)
        return study_text_fail(text, node, "%s", error.message);
    e->method_count++;
    return CLI_DONE;
}

/* "all" and "all+project" stand for every integrator that is no modifier. */
static int add_methods(study_entry *e, const study_text *text, const yaml_node_t *node,
                       const char *name)
{
    char full[STUDY_NAME];
    int status = CLI_DONE;
    if (strncmp(name, "all", 3) != 0 || (name[3] != '\0' && name[3] != '+'))
        return add_method(e, text, node, name);
    for (int i = 0; dal_integrator_at(i) && status == CLI_DONE; i++) {
        const dal_integrator *integrator = dal_integrator_at(i);
        if (integrator->claims & DAL_MODIFIER) continue;
        snprintf(full, sizeof full, "%s%s", integrator->name, name + 3);
        status = add_method(e, text, node, full);
    }
    return status;
}

static int read_methods(study_entry *e, const study_text *text, yaml_node_t *node)
{
    int count = study_text_count(node), status = CLI_DONE;
    if (count == 0) return study_text_fail(text, node, "integrators: the list is empty");
    for (int i = 0; i < count && status == CLI_DONE; i++) {
        const yaml_node_t *item = study_text_item(text, node, i);
        const char *name = study_text_scalar(text, item, "integrators");
        status = name ? add_methods(e, text, item, name) : CLI_USAGE;
    }
    return status;
}

/* ---- entries ---- */

static int check_entry(const study_text *text, const yaml_node_t *node, const draft *d)
{
    const study_entry *e = &d->entry;
    if (!e->name) return study_text_fail(text, node, "the system is missing");
    if (!d->integrators)
        return study_text_fail(text, node, "%s: the integrators are missing", e->name);
    if (e->steps == 0) return study_text_fail(text, node, "%s: the step is missing", e->name);
    if (!(e->time > 0.0)) return study_text_fail(text, node, "%s: the time is missing", e->name);
    for (int i = 0; i < e->steps; i++)
        if (e->step[i] > e->time)
            return study_text_fail(text, node, "%s: step %g is larger than the time %g", e->name,
                                   e->step[i], e->time);
    return CLI_DONE;
}

static int unique_label(const study_plan *plan, const study_text *text, const yaml_node_t *node,
                        const study_entry *e)
{
    for (int i = 0; i < plan->entry_count; i++)
        if (strcmp(plan->entries[i].label, e->label) == 0)
            return study_text_fail(text, node, "two systems called '%s': give one a label",
                                   e->label);
    return CLI_DONE;
}

/* A path labels its entry by the file's name without folders and ending. */
static const char *plain_label(const study_entry *e)
{
    const char *slash = strrchr(e->name, '/');
    return slash ? slash + 1 : e->name;
}

/* Whether the system knows the names; what else may be wrong with their values is for the cells. */
static int check_names(const study_text *text, const yaml_node_t *node, const char *what,
                       const study_entry *e, const dal_setting *start, int count)
{
    dal_run *run;
    dal_error error = {0};
    dal_run_spec spec = {.system = e->system,
                         .method = e->methods[0],
                         .options = e->options,
                         .parameters = e->set,
                         .parameter_count = e->set_count,
                         .start = start,
                         .start_count = count};
    if (!node) return CLI_DONE;
    if (!e->system->call.adjoint) spec.options.space = DAL_PHYSICAL;
    dal_status made = dal_run_create(&run, &spec, &error);
    if (made == DAL_OK) dal_run_free(run);
    return made == DAL_NAME ? study_text_fail(text, node, "%s: %s", what, error.message) : CLI_DONE;
}

static int load_entry(study_entry *e, const study_text *text, const draft *d)
{
    int status = cli_load(e->name, &e->model, &e->system);
    if (status == CLI_DONE) status = check_names(text, d->set, "set", e, NULL, 0);
    if (status == CLI_DONE)
        status = check_names(text, d->start, "start", e, e->start, e->start_count);
    if (status == CLI_DONE)
        status = check_names(text, d->displace, "displace", e, e->displace, e->displace_count);
    return status;
}

static int add_entry(study_plan *plan, const study_text *text, yaml_node_t *node, const draft *base)
{
    draft d = *base;
    int status =
        node->type == YAML_MAPPING_NODE
            ? study_text_mapping(text, node, "a system", keys + FIRST_OF_SYSTEM, KEYS_OF_SYSTEM, &d)
            : take_system(&d, text, node);
    if (status == CLI_DONE) status = check_entry(text, node, &d);
    if (status != CLI_DONE) return status;
    study_entry *e = &plan->entries[plan->entry_count];
    *e = d.entry;
    if (!e->label) e->label = plain_label(e);
    status = unique_label(plan, text, node, e);
    plan->entry_count++;
    if (status == CLI_DONE) status = read_methods(e, text, d.integrators);
    if (status == CLI_DONE) status = read_settings(text, d.set, "set", &e->set, &e->set_count);
    if (status == CLI_DONE)
        status = read_settings(text, d.start, "start", &e->start, &e->start_count);
    if (status == CLI_DONE)
        status = read_settings(text, d.displace, "displace", &e->displace, &e->displace_count);
    return status == CLI_DONE ? load_entry(e, text, &d) : status;
}

/* ---- the whole ---- */

static int read_systems(study_plan *plan, const study_text *text, const yaml_node_t *root,
                        const draft *base)
{
    int count = base->systems ? study_text_count(base->systems) : 0, status = CLI_DONE;
    if (count == 0) return study_text_fail(text, root, "the systems are missing");
    plan->entries = calloc((size_t)count, sizeof *plan->entries);
    if (!plan->entries) return cli_fail(CLI_IO, "out of memory");
    for (int i = 0; i < count && status == CLI_DONE; i++)
        status = add_entry(plan, text, study_text_item(text, base->systems, i), base);
    return status;
}

static study_cell *lay_out_starts(study_cell cell, study_cell *place)
{
    for (cell.start = 0; cell.start < STUDY_STARTS; cell.start++)
        if (cell.entry->starts & 1 << cell.start) *place++ = cell;
    return place;
}

static void lay_out(const study_entry *e, study_cell *place)
{
    for (int m = 0; m < e->method_count; m++)
        for (int h = 0; h < e->steps; h++)
            place = lay_out_starts(
                (study_cell){.entry = e, .method = &e->methods[m], .step = e->step[h]}, place);
}

static int make_cells(study_plan *plan)
{
    for (int i = 0; i < plan->entry_count; i++) {
        study_entry *e = &plan->entries[i];
        int starts = 0;
        for (int start = 0; start < STUDY_STARTS; start++) starts += (e->starts >> start) & 1;
        e->first_cell = plan->cell_count;
        e->cells = e->method_count * e->steps * starts;
        plan->cell_count += e->cells;
    }
    plan->cells = calloc((size_t)plan->cell_count + 1, sizeof *plan->cells);
    if (!plan->cells) return cli_fail(CLI_IO, "out of memory");
    for (int i = 0; i < plan->entry_count; i++)
        lay_out(&plan->entries[i], plan->cells + plan->entries[i].first_cell);
    return CLI_DONE;
}

int study_plan_read(study_plan *plan, const char *place, const char *bytes, size_t length)
{
    study_text *text = calloc(1, sizeof *text);
    draft base = {.entry = {.samples = 400,
                            .options = dal_options_default(),
                            .displacement = 1e-8,
                            .starts = (1 << STUDY_STARTS) - 1}};
    *plan = (study_plan){.place = place, .document = text};
    if (!text) return cli_fail(CLI_IO, "out of memory");
    int status = study_text_parse(text, place, bytes, length);
    if (status != CLI_DONE) return status;
    yaml_node_t *root = yaml_document_get_root_node(&text->document);
    status = study_text_mapping(text, root, "a study", keys, KEYS_OF_STUDY, &base);
    plan->title = base.title ? base.title : place;
    if (status == CLI_DONE) status = read_systems(plan, text, root, &base);
    return status == CLI_DONE ? make_cells(plan) : status;
}

void study_plan_free(study_plan *plan)
{
    for (int i = 0; i < plan->cell_count && plan->cells; i++) study_cell_free(&plan->cells[i]);
    for (int i = 0; i < plan->entry_count; i++) {
        study_entry *e = &plan->entries[i];
        dal_model_free(e->model);
        free(e->methods);
        free(e->set);
        free(e->start);
        free(e->displace);
    }
    if (plan->document) yaml_document_delete(&((study_text *)plan->document)->document);
    free(plan->document);
    free(plan->entries);
    free(plan->cells);
    *plan = (study_plan){0};
}
