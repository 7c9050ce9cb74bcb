/* study_observe.c - formulas in the expectations of a study.
 *
 *     expect: {sleigh: {rk4: {"abs(h1) - 0.3*m": {final: {at most: 0}}}}}
 *
 * What is given where a quantity is named and is no name is a formula, unless the system has a
 * quantity of this name.  Cases of an item share their model, so all their runs observe it, as
 * `run --observe` does, and the quantity has the text of the formula as its name. */
#include "study_observe.h"

#include "io/text.h"
#include "run/system.h"
#include "study_expect.h"
#include "ui/memory.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* The formulas of an item, which begins with its first case. */
typedef struct observed_item {
    const study_plan *plan;
    int first, cases;
    cli_formula *formula;
    int count;
} observed_item;

static void add_formula(observed_item *g, const document_pair *quantity)
{
    const yaml_node_t *key = quantity->key;
    const yaml_scalar_style_t style = key->data.scalar.style;
    const bool is_quoted =
        style == YAML_SINGLE_QUOTED_SCALAR_STYLE || style == YAML_DOUBLE_QUOTED_SCALAR_STYLE;
    if (quantity->name[0] == '|' || text_is_name(quantity->name)) return;
    if (study_has_quantity(&g->plan->cases[g->first], quantity->name)) return;
    for (int i = 0; i < g->count; i++)
        if (strcmp(g->formula[i].text, quantity->name) == 0) return;
    g->formula = cli_realloc(g->formula, ((size_t)g->count + 1) * sizeof *g->formula);
    g->formula[g->count++] = (cli_formula){quantity->name, (int)key->start_mark.line + 1,
                                           (int)key->start_mark.column + 1 + is_quoted};
}

/* The formulas under a label, for any of its integrators. */
static int add_formulas(observed_item *g, const document_pair *label)
{
    const document *doc = g->plan->doc;
    document_pair method, quantity;
    bool is_meant = false;
    for (int i = 0; i < g->cases; i++)
        is_meant |= study_label_means(&g->plan->cases[g->first + i], label->name);
    if (!is_meant) return CLI_DONE;
    int status = document_check_mapping(doc, label->value, "expect", "integrators");
    for (int i = 0; status == CLI_DONE && document_get_pair(doc, label->value, i, &method); i++) {
        status = document_check_mapping(doc, method.value, "expect", "quantities");
        for (int k = 0; status == CLI_DONE && document_get_pair(doc, method.value, k, &quantity);
             k++)
            add_formula(g, &quantity);
    }
    return status;
}

/* Makes the system of an item again, with its formulas. */
static int make_item(study_plan *plan, const observed_item *g)
{
    size_t length;
    char *text;
    study_case *e = &plan->cases[g->first];
    const int status = cli_observe(study_case_system(e), &e->choices, plan->doc->place, g->formula,
                                   g->count, &e->model, &e->system);
    FILE *out = cli_memstream_open(&text, &length);
    for (int i = 0; i < g->count; i++) fprintf(out, "%s%s", i ? "; " : "", g->formula[i].text);
    cli_memstream_close(out);
    for (int i = 0; i < g->cases; i++) {
        e[i].model = e->model;
        e[i].system = e->system;
        e[i].observe = text;
    }
    return status;
}

int study_observe(study_plan *plan, yaml_node_t *node)
{
    document_pair label;
    int status = node ? document_check_mapping(plan->doc, node, "expect", "labels") : CLI_DONE;
    for (int first = 0, end; node && first < plan->case_count && status == CLI_DONE; first = end) {
        for (end = first + 1; end < plan->case_count && !plan->cases[end].is_first;) end++;
        observed_item g = {.plan = plan, .first = first, .cases = end - first};
        for (int i = 0; status == CLI_DONE && document_get_pair(plan->doc, node, i, &label); i++)
            status = add_formulas(&g, &label);
        if (status == CLI_DONE && g.count > 0) status = make_item(plan, &g);
        free(g.formula);
    }
    return status;
}
