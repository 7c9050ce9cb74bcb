/* document.c - nodes of a parsed YAML text, with messages that name their place. */
#include "document.h"
#include "dalembert.h"
#include "ui/memory.h"
#include "ui/options.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MESSAGE = 256, NAMES = 32 };

int document_fail(const document *doc, const yaml_node_t *node, const char *format, ...)
{
    char message[MESSAGE];
    va_list list;
    va_start(list, format);
    vsnprintf(message, sizeof message, format, list);
    va_end(list);
    return cli_fail(CLI_USAGE, "%s:%zu:%zu: %s", doc->place, node->start_mark.line + 1,
                    node->start_mark.column + 1, message);
}

int document_fail_unknown(const document *doc, const yaml_node_t *node, const char *what,
                          const char *name, const char *const *names, int count)
{
    const char *nearest = dal_nearest(name, names, count);
    if (!nearest) return document_fail(doc, node, "unknown %s '%s'", what, name);
    return document_fail(doc, node, "unknown %s '%s'; did you mean '%s'?", what, name, nearest);
}

static int parser_fail(const char *place, const yaml_parser_t *parser)
{
    /* Without memory for a node libyaml fails and names no error. */
    if (parser->error == YAML_MEMORY_ERROR || parser->error == YAML_NO_ERROR) cli_out_of_memory();
    return cli_fail(CLI_USAGE, "%s:%zu:%zu: %s", place, parser->problem_mark.line + 1,
                    parser->problem_mark.column + 1,
                    parser->problem ? parser->problem : "not YAML");
}

/* libyaml takes a time that grows like the square of the depth, so a scan comes first that ends
 * where that is too great.  What is no YAML is left to the parser itself. */
static int check_depth(const char *place, const char *bytes, size_t length)
{
    yaml_parser_t parser;
    yaml_event_t event;
    int depth = 0, more = 1, status = CLI_DONE;
    if (!yaml_parser_initialize(&parser)) cli_out_of_memory();
    yaml_parser_set_input_string(&parser, (const unsigned char *)bytes, length);
    while (more && yaml_parser_parse(&parser, &event)) {
        const yaml_event_type_t type = event.type;
        depth += type == YAML_SEQUENCE_START_EVENT || type == YAML_MAPPING_START_EVENT;
        depth -= type == YAML_SEQUENCE_END_EVENT || type == YAML_MAPPING_END_EVENT;
        if (depth > DOCUMENT_DEPTH)
            status =
                cli_fail(CLI_USAGE, "%s:%zu:%zu: deeper than %d levels", place,
                         event.start_mark.line + 1, event.start_mark.column + 1, DOCUMENT_DEPTH);
        more = status == CLI_DONE && type != YAML_STREAM_END_EVENT;
        yaml_event_delete(&event);
    }
    yaml_parser_delete(&parser);
    return status;
}

static int only_document(const char *place, yaml_parser_t *parser)
{
    yaml_document_t next;
    if (!yaml_parser_load(parser, &next)) return parser_fail(place, parser);
    const yaml_node_t *root = yaml_document_get_root_node(&next);
    int status = CLI_DONE;
    if (root) {
        document doc = {.place = place};
        status = document_fail(&doc, root, "a second document");
    }
    yaml_document_delete(&next);
    return status;
}

int document_parse(document *doc, const char *place, const char *bytes, size_t length)
{
    yaml_parser_t parser;
    doc->place = place;
    if (check_depth(place, bytes, length) != CLI_DONE) return CLI_USAGE;
    if (!yaml_parser_initialize(&parser)) cli_out_of_memory();
    yaml_parser_set_input_string(&parser, (const unsigned char *)bytes, length);
    if (!yaml_parser_load(&parser, &doc->yaml)) {
        int status = parser_fail(place, &parser);
        yaml_parser_delete(&parser);
        memset(&doc->yaml, 0, sizeof doc->yaml);
        return status;
    }
    int status = CLI_DONE;
    if (!yaml_document_get_root_node(&doc->yaml))
        status = cli_fail(CLI_USAGE, "%s: there is nothing in it", place);
    if (status == CLI_DONE) status = only_document(place, &parser);
    yaml_parser_delete(&parser);
    return status;
}

yaml_node_t *document_node(const document *doc, int number)
{
    return yaml_document_get_node((yaml_document_t *)&doc->yaml, number);
}

const char *document_scalar(const document *doc, const yaml_node_t *node, const char *what)
{
    if (node->type != YAML_SCALAR_NODE) {
        document_fail(doc, node, "%s: a single value is wanted", what);
        return NULL;
    }
    const char *value = (const char *)node->data.scalar.value;
    if (strlen(value) == node->data.scalar.length) return value;
    document_fail(doc, node, "%s: a NUL in the text", what);
    return NULL;
}

void document_place(const document *doc, const yaml_node_t *node, const char *what, char *place,
                    size_t size)
{
    snprintf(place, size, "%s:%zu:%zu: %s", doc->place, node->start_mark.line + 1,
             node->start_mark.column + 1, what);
}

int document_number(const document *doc, const yaml_node_t *node, const char *what, double *number)
{
    char place[MESSAGE];
    const char *value = document_scalar(doc, node, what);
    if (!value) return CLI_USAGE;
    document_place(doc, node, what, place, sizeof place);
    return cli_number(place, value, number);
}

static int came_before(const document *doc, const yaml_node_pair_t *first,
                       const yaml_node_pair_t *pair, const char *name)
{
    for (; first < pair; first++) {
        const yaml_node_t *key = document_node(doc, first->key);
        if (strcmp((const char *)key->data.scalar.value, name) == 0) return 1;
    }
    return 0;
}

static int unknown_key(const document *doc, const yaml_node_t *node, const char *name,
                       const document_key *keys, int count)
{
    const char *names[NAMES];
    if (count > NAMES) count = NAMES;
    for (int i = 0; i < count; i++) names[i] = keys[i].name;
    return document_fail_unknown(doc, node, "key", name, names, count);
}

static int take_pair(const document *doc, const yaml_node_pair_t *pair, const document_key *keys,
                     int count, void *user)
{
    const yaml_node_t *key = document_node(doc, pair->key);
    const char *name = (const char *)key->data.scalar.value;
    for (int i = 0; i < count; i++) {
        if (strcmp(keys[i].name, name) != 0) continue;
        return keys[i].take ? keys[i].take(user, doc, document_node(doc, pair->value)) : CLI_DONE;
    }
    return unknown_key(doc, key, name, keys, count);
}

int document_read_mapping(const document *doc, yaml_node_t *node, const char *what,
                          const document_key *keys, int count, void *user)
{
    if (node->type != YAML_MAPPING_NODE)
        return document_fail(doc, node, "%s: keys and values are wanted", what);
    const yaml_node_pair_t *first = node->data.mapping.pairs.start;
    for (const yaml_node_pair_t *pair = first; pair < node->data.mapping.pairs.top; pair++) {
        const yaml_node_t *key = document_node(doc, pair->key);
        const char *name = document_scalar(doc, key, what);
        if (!name) return CLI_USAGE;
        if (came_before(doc, first, pair, name))
            return document_fail(doc, key, "the key '%s' comes twice", name);
        int status = take_pair(doc, pair, keys, count, user);
        if (status != CLI_DONE) return status;
    }
    return CLI_DONE;
}

int document_count(const yaml_node_t *node)
{
    if (node->type != YAML_SEQUENCE_NODE) return 1;
    return (int)(node->data.sequence.items.top - node->data.sequence.items.start);
}

yaml_node_t *document_item(const document *doc, yaml_node_t *node, int i)
{
    if (node->type != YAML_SEQUENCE_NODE) return node;
    return document_node(doc, node->data.sequence.items.start[i]);
}
