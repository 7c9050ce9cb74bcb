/* document.c - nodes of a parsed YAML text, with messages that name their place. */
#include "document.h"
#include "dalembert_program.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/options.h"

#include "text.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MESSAGE = 256, NAMES = 32, MAX_COUNT = 1000000000 };

int document_fail(const document *doc, const yaml_node_t *node, const char *format, ...)
{
    char message[MESSAGE];
    va_list list;
    if (!doc->place) return CLI_USAGE;
    va_start(list, format);
    vsnprintf(message, sizeof message, format, list);
    va_end(list);
    return cli_fail(CLI_USAGE, "%s:%zu:%zu: %s", doc->place, node->start_mark.line + 1,
                    node->start_mark.column + 1, message);
}

int document_fail_unknown(const document *doc, const yaml_node_t *node, const char *what,
                          const char *name, const char *const *names, int count)
{
    const char *nearest = dal__nearest_name(name, names, count);
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
    const long control = text_find_control(value, TEXT_LINES);
    if (strlen(value) < node->data.scalar.length)
        document_fail(doc, node, "%s: a NUL in the text", what);
    else if (control >= 0)
        document_fail(doc, node, "%s: the control character U+%04lX in the text", what,
                      (unsigned long)control);
    else
        return value;
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

/* "PLACE:line:column: WHAT" for messages of others about a node. */
static const char *name_place(const document *doc, const yaml_node_t *node, const char *what,
                              char place[MESSAGE])
{
    snprintf(place, MESSAGE, "%s:%zu:%zu: %s", doc->place, node->start_mark.line + 1,
             node->start_mark.column + 1, what);
    return place;
}

int document_number(const document *doc, const yaml_node_t *node, const char *what, double *number)
{
    char place[MESSAGE];
    const char *value = document_scalar(doc, node, what);
    if (!value) return CLI_USAGE;
    return cli_number(name_place(doc, node, what, place), value, number);
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
    return cli_integer(name_place(doc, value, key->name, place), text, 1, MAX_COUNT,
                       (void *)((char *)user + key->offset));
}

int document_read_node(void *user, const document *doc, yaml_node_t *value, const document_key *key)
{
    (void)doc;
    *(yaml_node_t **)(void *)((char *)user + key->offset) = value;
    return CLI_DONE;
}

bool document_get_pair(const document *doc, const yaml_node_t *node, int i, document_pair *pair)
{
    const yaml_node_pair_t *found = node->data.mapping.pairs.start + i;
    if (found >= node->data.mapping.pairs.top) return false;
    yaml_node_t *key = document_node(doc, found->key);
    *pair = (document_pair){(char *)key->data.scalar.value, key, document_node(doc, found->value)};
    return true;
}

int document_check_mapping(const document *doc, const yaml_node_t *node, const char *what,
                           const char *contents)
{
    document_pair pair;
    if (node->type != YAML_MAPPING_NODE)
        return document_fail(doc, node, "%s: %s are required", what, contents);
    for (int i = 0; document_get_pair(doc, node, i, &pair); i++) {
        if (!document_scalar(doc, pair.key, what)) return CLI_USAGE;
        document_pair before;
        for (int k = 0; k < i && document_get_pair(doc, node, k, &before); k++)
            if (strcmp(before.name, pair.name) == 0)
                return document_fail(doc, pair.key, "the key '%s' comes twice", pair.name);
    }
    return CLI_DONE;
}

yaml_node_t *document_value(const document *doc, const yaml_node_t *node, const char *name)
{
    document_pair pair;
    if (!node || node->type != YAML_MAPPING_NODE) return NULL;
    for (int i = 0; document_get_pair(doc, node, i, &pair); i++)
        if (pair.key->type == YAML_SCALAR_NODE && strcmp(pair.name, name) == 0) return pair.value;
    return NULL;
}

static int read_pair(const document *doc, const document_pair *pair, const document_key *keys,
                     int count, void *user)
{
    const char *names[NAMES];
    for (int i = 0; i < count; i++)
        if (strcmp(keys[i].name, pair->name) == 0)
            return keys[i].read ? keys[i].read(user, doc, pair->value, &keys[i]) : CLI_DONE;
    if (count > NAMES) count = NAMES;
    for (int i = 0; i < count; i++) names[i] = keys[i].name;
    return document_fail_unknown(doc, pair->key, "key", pair->name, names, count);
}

int document_read_mapping(const document *doc, const yaml_node_t *node, const char *what,
                          const document_key *keys, int count, void *user)
{
    int status = document_check_mapping(doc, node, what, "keys and values");
    document_pair pair;
    for (int i = 0; status == CLI_DONE && document_get_pair(doc, node, i, &pair); i++) {
        status = read_pair(doc, &pair, keys, count, user);
    }
    return status;
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
