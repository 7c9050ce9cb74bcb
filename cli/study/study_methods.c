/* study_methods.c - the integrators of a case, by their names in a study file. */
#include "study_methods.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <stdlib.h>
#include <string.h>

static bool has_method(const study_case *e, const dal_method *method)
{
    char name[STUDY_NAME], other[STUDY_NAME];
    dal_method_name(method, name, sizeof name);
    for (int i = 0; i < e->method_count; i++)
        if (strcmp(name, dal_method_name(&e->methods[i], other, sizeof other)) == 0) return true;
    return false;
}

bool study_completes_to(const study_case *e, const char *name, const dal_method *method)
{
    char own[STUDY_NAME], other[STUDY_NAME];
    dal_method named;
    if (strcmp(name, dal_method_name(method, own, sizeof own)) == 0) return true;
    if (e->system->holonomic == 0 || dal_method_parse(&named, name, NULL) != DAL_STATUS_OK)
        return false;
    dal_method_complete(&named, e->system, &e->options, NULL, NULL);
    return strcmp(own, dal_method_name(&named, other, sizeof other)) == 0;
}

bool study_find_method(const study_plan *plan, const char *name, dal_method *method)
{
    const study_case *const end = plan->cases + plan->case_count;
    for (const study_case *e = plan->cases; e < end; e++)
        if (has_method(e, method)) return true;
    for (const study_case *e = plan->cases; e < end; e++)
        for (int k = 0; k < e->method_count; k++) {
            if (!study_completes_to(e, name, &e->methods[k])) continue;
            *method = e->methods[k];
            return true;
        }
    return false;
}

void study_complete_methods(study_case *e)
{
    const int count = e->method_count;
    e->method_count = 0;
    for (int i = 0; i < count; i++) {
        dal_method method = e->methods[i];
        bool added = false;
        dal_method_complete(&method, e->system, &e->options, &added, NULL);
        e->is_projected |= added;
        if (!has_method(e, &method)) e->methods[e->method_count++] = method;
    }
}

void study_say_projected(const study_plan *plan)
{
    for (const study_case *e = plan->cases; e < plan->cases + plan->case_count; e++)
        if (e->is_projected && e->is_first)
            cli_note("%s: holonomic constraints drift with methods of F: +project is added to "
                     "them; 'options: {bare: on}' leaves it out",
                     e->item_label);
}

static int add_method(study_case *e, const document *doc, const yaml_node_t *node, const char *name)
{
    dal_error error = {0};
    size_t count = (size_t)e->method_count + 1;
    e->methods = cli_realloc(e->methods, count * sizeof *e->methods);
    if (dal_method_parse(&e->methods[e->method_count], name, &error) != DAL_STATUS_OK)
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

int study_read_methods(study_case *e, const document *doc, yaml_node_t *node)
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
