/* study_plan.c - from the keys of a study to its cases and cells. */
#include "dalembert.h"
#include "io/document.h"
#include "parsed_study.h"
#include "run/request.h"
#include "run/row_times.h"
#include "run/system.h"
#include "study.h"
#include "study_expect.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- settings and methods ---- */

/* Momenta in units of the displacement: one value each. */
static int read_displace(study_case *e, const document *doc, yaml_node_t *node)
{
    if (!node) return CLI_DONE;
    if (node->type != YAML_MAPPING_NODE)
        return document_fail(doc, node, "displace: names and values are wanted");
    const yaml_node_pair_t *pair = node->data.mapping.pairs.start;
    size_t most = (size_t)(node->data.mapping.pairs.top - pair);
    e->displace = cli_calloc(most + 1, sizeof *e->displace);
    for (; pair < node->data.mapping.pairs.top; pair++) {
        dal_setting *s = &e->displace[e->displace_count++];
        yaml_node_t *key = document_node(doc, pair->key);
        s->name = document_scalar(doc, key, "displace");
        if (!s->name) return CLI_USAGE;
        yaml_node_t *value = document_node(doc, pair->value);
        int status = document_number(doc, value, "displace", &s->value);
        if (status != CLI_DONE) return status;
    }
    return CLI_DONE;
}

static int has_method(const study_case *e, const dal_method *method)
{
    char name[STUDY_NAME], other[STUDY_NAME];
    dal_method_name(method, name, sizeof name);
    for (int i = 0; i < e->method_count; i++)
        if (strcmp(name, dal_method_name(&e->methods[i], other, sizeof other)) == 0) return 1;
    return 0;
}

static int add_method(study_case *e, const document *doc, const yaml_node_t *node, const char *name)
{
    dal_error error = {0};
    size_t count = (size_t)e->method_count + 1;
    e->methods = cli_realloc(e->methods, count * sizeof *e->methods);
    if (dal_method_parse(&e->methods[e->method_count], name, &error) != DAL_OK)
        return document_fail(doc, node, "%s", error.message);
    if (!has_method(e, &e->methods[e->method_count])) e->method_count++;
    return CLI_DONE;
}

/* "all" and "all+project" stand for every integrator that is no modifier. */
static int add_methods(study_case *e, const document *doc, const yaml_node_t *node,
                       const char *name)
{
    char full[STUDY_NAME];
    int status = CLI_DONE;
    if (strncmp(name, "all", 3) != 0 || (name[3] != '\0' && name[3] != '+'))
        return add_method(e, doc, node, name);
    for (int i = 0; dal_integrator_at(i) && status == CLI_DONE; i++) {
        const dal_integrator *integrator = dal_integrator_at(i);
        if (integrator->properties & DAL_MODIFIER) continue;
        snprintf(full, sizeof full, "%s%s", integrator->name, name + 3);
        status = add_method(e, doc, node, full);
    }
    return status;
}

static int read_methods(study_case *e, const document *doc, yaml_node_t *node)
{
    int count = document_count(node), status = CLI_DONE;
    if (count == 0) return document_fail(doc, node, "integrators: the list is empty");
    for (int i = 0; i < count && status == CLI_DONE; i++) {
        const yaml_node_t *item = document_item(doc, node, i);
        const char *name = document_scalar(doc, item, "integrators");
        status = name ? add_methods(e, doc, item, name) : CLI_USAGE;
    }
    return status;
}

/* ---- cases ---- */

static int check_case(const document *doc, const yaml_node_t *node, const parsed_study *d)
{
    const study_case *e = &d->of_case;
    if (!e->name) return document_fail(doc, node, "the system is missing");
    if (!d->integrators)
        return document_fail(doc, node, "%s: the integrators are missing", e->name);
    if (e->steps == 0) return document_fail(doc, node, "%s: the step is missing", e->name);
    if (!(e->time > 0.0)) return document_fail(doc, node, "%s: the time is missing", e->name);
    for (int i = 0; i < e->steps; i++) {
        char said[STEP_ERROR_SIZE];
        const char *fault = step_error(e->step[i], e->time, said);
        if (fault) return document_fail(doc, node, "%s: step %s", e->name, fault);
    }
    return CLI_DONE;
}

static int unique_label(const study_plan *plan, const document *doc, const yaml_node_t *node,
                        const study_case *e)
{
    for (int i = 0; i < plan->case_count; i++)
        if (strcmp(plan->cases[i].label, e->label) == 0)
            return document_fail(doc, node, "two systems called '%s': give one a label", e->label);
    return CLI_DONE;
}

/* A path labels its case by the file's name without folders. */
static const char *plain_label(const study_case *e)
{
    const char *slash = strrchr(e->name, '/');
    return slash ? slash + 1 : e->name;
}

/* Whether the system knows the names; what else may be wrong with their values is for the cells. */
static int check_names(const document *doc, const yaml_node_t *node, const char *what,
                       const study_case *e, const dal_setting *start, int count)
{
    dal_run *run;
    dal_error error = {0};
    dal_run_spec spec = {.system = e->system,
                         .method = e->methods[0],
                         .options = dal_options_default(),
                         .parameters = e->set,
                         .parameter_count = e->set_count,
                         .start = start,
                         .start_count = count};
    if (!node) return CLI_DONE;
    if (!e->system->call.adjoint) spec.options.space = DAL_PHYSICAL;
    dal_status made = dal_run_create(&run, &spec, &error);
    if (cli_is_ok(made)) dal_run_free(run);
    return made == DAL_NAME ? document_fail(doc, node, "%s: %s", what, error.message) : CLI_DONE;
}

char *study_system_copy(const char *directory, const study_case *e)
{
    return cli_format("%s/%s.yaml", directory, e->label);
}

/* A name that is neither a path nor a system is told with its place. */
static int check_system(const document *doc, const yaml_node_t *node, const char *name)
{
    enum { MOST = 256 };
    const char *names[MOST];
    int count = 0;
    if (cli_is_path(name) || dal_builtin_text(name)) return CLI_DONE;
    while (count < MOST && (names[count] = dal_builtin_name(count))) count++;
    return document_fail_unknown(doc, node, "system", name, names, count);
}

/* Where a directory keeps copies, what has one was a file, wherever the program is started now. */
static int find_copy(const study_plan *plan, study_case *e)
{
    if (!plan->copies) return CLI_DONE;
    e->copy = study_system_copy(plan->copies, e);
    if (access(e->copy, F_OK) == 0 || cli_is_path(e->name)) return CLI_DONE;
    free(e->copy);
    e->copy = NULL;
    return CLI_DONE;
}

static int load_system(const study_plan *plan, const document *doc, const yaml_node_t *node,
                       study_case *e)
{
    int status = find_copy(plan, e);
    if (status == CLI_DONE && !e->copy) status = check_system(doc, node, e->name);
    if (status != CLI_DONE) return status;
    return cli_load(e->copy ? e->copy : e->name, &e->model, &e->system);
}

/* ---- groups ---- */

typedef struct group {
    study_plan *plan;
    const document *doc;
    yaml_node_t *node; /* of the system */
    parsed_study parsed;
    study_variants *variants;
} group;

/* What the first of a group reads, the others share. */
static int load_first(group *g, study_case *e)
{
    int status = read_methods(e, g->doc, g->parsed.integrators);
    return status == CLI_DONE ? load_system(g->plan, g->doc, g->node, e) : status;
}

static void share(study_case *e, const study_case *first)
{
    e->model = first->model;
    e->system = first->system;
    e->copy = first->copy;
    e->methods = first->methods;
    e->method_count = first->method_count;
}

static int check_all_names(const group *g, const study_case *e)
{
    const parsed_study *d = &g->parsed;
    int status = check_names(g->doc, d->set, "set", e, NULL, 0);
    if (status == CLI_DONE)
        status = check_names(g->doc, d->start, "start", e, e->start, e->start_count);
    if (status == CLI_DONE)
        status = check_names(g->doc, d->displace, "displace", e, e->displace, e->displace_count);
    return status;
}

static int add_variant(group *g, int i, const study_case *first)
{
    study_plan *plan = g->plan;
    study_case *e = &plan->cases[plan->case_count];
    *e = g->parsed.of_case;
    e->is_first = i == 0;
    study_variants_apply(g->variants, i, e);
    int status = unique_label(plan, g->doc, g->node, e);
    plan->case_count++;
    if (status == CLI_DONE) status = read_displace(e, g->doc, g->parsed.displace);
    if (status != CLI_DONE) return status;
    if (i == 0)
        status = load_first(g, e);
    else
        share(e, first);
    if (status == CLI_DONE && i == 0) status = check_all_names(g, e);
    return status == CLI_DONE ? study_variants_project_start(g->variants, e) : status;
}

static int add_variants(group *g, int count)
{
    study_plan *plan = g->plan;
    const int before = plan->case_count;
    const size_t room = (size_t)before + (size_t)count;
    plan->cases = cli_realloc(plan->cases, room * sizeof *plan->cases);
    int status = CLI_DONE;
    for (int i = 0; i < count && status == CLI_DONE; i++)
        status = add_variant(g, i, &plan->cases[before]);
    return status;
}

static int add_group(study_plan *plan, const document *doc, yaml_node_t *node,
                     const parsed_study *base)
{
    group g = {.plan = plan, .doc = doc, .node = node, .parsed = *base};
    int count = 0, status = parsed_study_read_system(&g.parsed, doc, node);
    if (status == CLI_DONE) status = check_case(doc, node, &g.parsed);
    if (status != CLI_DONE) return status;
    if (!g.parsed.of_case.group) g.parsed.of_case.group = plain_label(&g.parsed.of_case);
    status = study_variants_read(&g.variants, doc, &g.parsed, &count);
    if (status == CLI_DONE) status = add_variants(&g, count);
    study_variants_free(g.variants);
    return status;
}

/* ---- the whole ---- */

static int read_systems(study_plan *plan, const document *doc, const yaml_node_t *root,
                        const parsed_study *base)
{
    int count = base->systems ? document_count(base->systems) : 0, status = CLI_DONE;
    if (count == 0) return document_fail(doc, root, "the systems are missing");
    for (int i = 0; i < count && status == CLI_DONE; i++)
        status = add_group(plan, doc, document_item(doc, base->systems, i), base);
    return status;
}

static study_cell *lay_out_starts(study_cell cell, study_cell *place)
{
    for (cell.start = 0; cell.start < STUDY_STARTS; cell.start++)
        if (cell.of_case->starts & 1 << cell.start) *place++ = cell;
    return place;
}

static void lay_out(const study_case *e, study_cell *place)
{
    for (int m = 0; m < e->method_count; m++)
        for (int h = 0; h < e->steps; h++)
            place = lay_out_starts(
                (study_cell){.of_case = e, .method = &e->methods[m], .step = e->step[h]}, place);
}

/* Every cell has a directory of its own, whose name must fit. */
static int check_cell_names(const study_plan *plan)
{
    enum { MOST = 255 };
    int status = CLI_DONE;
    for (int i = 0; i < plan->cell_count && status == CLI_DONE; i++) {
        char *name = study_cell_name(&plan->cells[i]);
        const size_t length = strlen(name);
        if (length > MOST)
            status = cli_fail(CLI_USAGE,
                              "%s: '%.60s...' is too long a name for a directory: %zu bytes, not "
                              "at most %d; a short label helps",
                              plan->place, name, length, (int)MOST);
        free(name);
    }
    return status;
}

static int make_cells(study_plan *plan)
{
    for (int i = 0; i < plan->case_count; i++) {
        study_case *e = &plan->cases[i];
        int starts = 0;
        for (int start = 0; start < STUDY_STARTS; start++) starts += (e->starts >> start) & 1;
        e->first_cell = plan->cell_count;
        e->cells = e->method_count * e->steps * starts;
        plan->cell_count += e->cells;
    }
    plan->cells = cli_calloc((size_t)plan->cell_count + 1, sizeof *plan->cells);
    for (int i = 0; i < plan->case_count; i++)
        lay_out(&plan->cases[i], plan->cells + plan->cases[i].first_cell);
    return check_cell_names(plan);
}

int study_plan_read(study_plan *plan, const char *place, const char *bytes, size_t length,
                    const char *copies)
{
    document *doc = cli_calloc(1, sizeof *doc);
    parsed_study base = {.of_case = {.samples = 400,
                                     .statistics = 1,
                                     .displacement = 1e-8,
                                     .starts = (1 << STUDY_STARTS) - 1}};
    *plan = (study_plan){.place = place, .document = doc, .copies = copies};
    int status = document_parse(doc, place, bytes, length);
    if (status != CLI_DONE) return status;
    yaml_node_t *root = yaml_document_get_root_node(&doc->yaml);
    status = parsed_study_read_study(&base, doc, root);
    plan->title = base.title ? base.title : "A study";
    if (status == CLI_DONE) status = read_systems(plan, doc, root, &base);
    if (status == CLI_DONE) status = make_cells(plan);
    return status == CLI_DONE ? study_expect_read(plan, doc, base.expect) : status;
}

static void free_case(study_case *e)
{
    if (e->is_first) {
        dal_model_free(e->model);
        free(e->copy);
        free(e->methods);
    }
    free(e->label);
    free(e->names);
    free(e->set);
    free(e->start);
    free(e->displace);
}

void study_plan_free(study_plan *plan)
{
    for (int i = 0; i < plan->cell_count && plan->cells; i++) study_cell_free(&plan->cells[i]);
    for (int i = 0; i < plan->case_count; i++) free_case(&plan->cases[i]);
    if (plan->document) yaml_document_delete(&((document *)plan->document)->yaml);
    free(plan->document);
    free(plan->cases);
    free(plan->cells);
    free(plan->expectations);
    *plan = (study_plan){0};
}
