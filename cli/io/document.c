/* document.c - nodes of a parsed YAML text, with messages that name their place. */
#include "document.h"
#include "dalembert.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/options.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MESSAGE = 256, NAMES = 32, MAX_COUNT = 1000000000 };

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
        status = cli_fail(CLI_USAGE, "%s: it is empty", place);
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
        document_fail(doc, node, "%s: a single value is required", what);
        return NULL;
    }
    const char *value = (const char *)node->data.scalar.value;
    if (strlen(value) == node->data.scalar.length) return value;
    document_fail(doc, node, "%s: a NUL in the text", what);
    return NULL;
}

int document_word(const document *doc, const yaml_node_t *node, const char *what,
                  const char *const *words, int count)
{
    const char *text = document_scalar(doc, node, what);
    for (int i = 0; text && i < count; i++)
        if (strcmp(words[i], text) == 0) return i;
    if (text) document_fail_unknown(doc, node, what, text, words, count);
    return -1;
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

/* ---- mappings ------------------------------------------------------------------------------ */

int document_read_text(void *user, const document *doc, yaml_node_t *value, const document_key *key)
{
    const char **text = (void *)((char *)user + key->offset);
    *text = document_scalar(doc, value, key->name);
    return *text ? CLI_DONE : CLI_USAGE;
}

int document_read_number(void *user, const document *doc, yaml_node_t *value,
                         const document_key *key)
{
    return document_number(doc, value, key->name, (double *)(void *)((char *)user + key->offset));
}

int document_read_positive(void *user, const document *doc, yaml_node_t *value,
                           const document_key *key)
{
    const double *x = (void *)((char *)user + key->offset);
    const int status = document_read_number(user, doc, value, key);
    if (status != CLI_DONE || *x > 0.0) return status;
    return document_fail(doc, value, "%s: %g is not positive", key->name, *x);
}

int document_read_count(void *user, const document *doc, yaml_node_t *value,
                        const document_key *key)
{
    char place[MESSAGE];
    const char *text = document_scalar(doc, value, key->name);
    if (!text) return CLI_USAGE;
    document_place(doc, value, key->name, place, sizeof place);
    return cli_integer(place, text, 1, MAX_COUNT, (void *)((char *)user + key->offset));
}

int document_read_node(void *user, const document *doc, yaml_node_t *value, const document_key *key)
{
    (void)doc;
    *(yaml_node_t **)(void *)((char *)user + key->offset) = value;
    return CLI_DONE;
}

static const yaml_node_pair_t *find_pair(const document *doc, const yaml_node_t *node,
                                         const char *name)
{
    const yaml_node_pair_t *pair = node->data.mapping.pairs.start;
    for (; pair < node->data.mapping.pairs.top; pair++) {
        const yaml_node_t *key = document_node(doc, pair->key);
        if (key->type == YAML_SCALAR_NODE &&
            strcmp((const char *)key->data.scalar.value, name) == 0)
            return pair;
    }
    return NULL;
}

yaml_node_t *document_value(const document *doc, const yaml_node_t *node, const char *name)
{
    const yaml_node_pair_t *pair = find_pair(doc, node, name);
    return pair ? document_node(doc, pair->value) : NULL;
}

int document_each_pair(const document *doc, const yaml_node_t *node, const char *what,
                       const char *contents, document_visitor *visit, void *user)
{
    int status = CLI_DONE;
    if (node->type != YAML_MAPPING_NODE)
        return document_fail(doc, node, "%s: %s are required", what, contents);
    const yaml_node_pair_t *pair = node->data.mapping.pairs.start;
    for (; pair < node->data.mapping.pairs.top && status == CLI_DONE; pair++) {
        const yaml_node_t *key = document_node(doc, pair->key);
        const char *name = document_scalar(doc, key, what);
        if (!name) return CLI_USAGE;
        status = visit(user, key, name, document_node(doc, pair->value));
    }
    return status;
}

typedef struct mapping_reader {
    const document *doc;
    const yaml_node_t *node;
    const document_key *keys;
    int count;
    void *user;
} mapping_reader;

static int read_pair(void *user, const yaml_node_t *key, const char *name, yaml_node_t *value)
{
    const mapping_reader *r = user;
    const char *names[NAMES];
    if (document_node(r->doc, find_pair(r->doc, r->node, name)->key) != key)
        return document_fail(r->doc, key, "the key '%s' comes twice", name);
    for (int i = 0; i < r->count; i++) {
        const document_key *k = &r->keys[i];
        if (strcmp(k->name, name) == 0)
            return k->read ? k->read(r->user, r->doc, value, k) : CLI_DONE;
    }
    const int count = r->count < NAMES ? r->count : NAMES;
    for (int i = 0; i < count; i++) names[i] = r->keys[i].name;
    return document_fail_unknown(r->doc, key, "key", name, names, count);
}

int document_read_mapping(const document *doc, const yaml_node_t *node, const char *what,
                          const document_key *keys, int count, void *user)
{
    mapping_reader reader = {doc, node, keys, count, user};
    return document_each_pair(doc, node, what, "keys and values", read_pair, &reader);
}

/* ---- lists --------------------------------------------------------------------------------- */

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
