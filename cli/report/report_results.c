/* report_results.c - NAME.json beside the table NAME.csv of a command: what it was made with. */
#include "report_results.h"

#include "io/file.h"
#include "io/json.h"
#include "report_system.h"
#include "run/system.h"
#include "ui/memory.h"

#include <stdlib.h>
#include <string.h>

static int read_settings(const report_results *results, const yaml_node_t *node,
                         request_settings *settings)
{
    document_pair pair;
    int status = document_check_mapping(&results->doc, node, "settings", "names and values");
    for (int i = 0; status == CLI_DONE && document_get_pair(&results->doc, node, i, &pair); i++) {
        const char *text = document_scalar(&results->doc, pair.value, pair.name);
        status = text ? request_parse_setting(settings, pair.name, pair.name, text) : CLI_USAGE;
    }
    return status;
}

/* Whether a text is the default of an option, which is the first of its words. */
static bool is_default(const cli_option *option, const char *text)
{
    const size_t length = option->initial ? strcspn(option->initial, "|") : 0;
    return length > 0 && strlen(text) == length && strncmp(option->initial, text, length) == 0;
}

/* Options at their defaults are not worth an item, except the space; those that this version does
 * not know are not of a run. */
static int read_member(report_results *results, const document_pair *member)
{
    run_request *request = &results->simulation.request;
    if (strcmp(member->name, "parameters") == 0)
        return read_settings(results, member->value, &request->set);
    if (strcmp(member->name, "start") == 0)
        return read_settings(results, member->value, &request->start);
    const int option = request_find_option(member->name);
    const char *text = document_scalar(&results->doc, member->value, member->name);
    if (!text) return CLI_USAGE;
    if (strcmp(member->name, "system") == 0) request->system_name = text;
    if (option < 0 || (option != REQUEST_space && is_default(&request_options[option], text)))
        return CLI_DONE;
    return request_parse_option(request, option, text);
}

/* The copy of its file, or a built-in system; of an unknown one the formulas are left out. */
static int read_model(report_results *results)
{
    const run_request *request = &results->simulation.request;
    dal_model **model = &results->simulation.model;
    if (file_exists(results->copy)) return cli_read(results->copy, model);
    return request->system_name && dal_builtin_text(request->system_name)
               ? cli_read(request->system_name, model)
               : CLI_DONE;
}

int results_read(report_results *results, const char *directory, const char *name)
{
    *results = (report_results){.place = cli_format("%s/%s.json", directory, name),
                                .copy = cli_format("%s/%s.yaml", directory, name),
                                .simulation = simulation_default()};
    if (!file_exists(results->place)) return CLI_DONE;
    int status = json_read(&results->doc, results->place, results->place);
    if (status != CLI_DONE) return status;
    results->root = document_node(&results->doc, 1);
    const yaml_node_t *request = document_value(&results->doc, results->root, "request");
    if (!request || request->type != YAML_MAPPING_NODE)
        return document_fail(&results->doc, results->root, "there is no request");
    document_pair member;
    for (int i = 0; status == CLI_DONE && document_get_pair(&results->doc, request, i, &member);
         i++)
        status = read_member(results, &member);
    return status == CLI_DONE ? read_model(results) : status;
}

void results_free(report_results *results)
{
    simulation_free(&results->simulation);
    yaml_document_delete(&results->doc.yaml);
    free(results->place);
    free(results->copy);
}

const char *results_text(const report_results *results, const char *mapping, const char *name)
{
    const yaml_node_t *node = results->root;
    if (mapping) node = document_value(&results->doc, node, mapping);
    return json_scalar(&results->doc, node, name);
}

const char *results_title(const report_results *results, const char *otherwise)
{
    const char *name = results->simulation.request.system_name;
    return report_model_title(results->simulation.model, name ? name : otherwise);
}

void results_begin_facts(FILE *page, const report_results *results)
{
    const run_request *request = &results->simulation.request;
    fputs(REPORT_FACTS, page);
    if (request->system_name) report_fact(page, "system", request->system_name);
    if (results->simulation.model) report_system(page, results->simulation.model, request);
    report_method(page, request);
}
