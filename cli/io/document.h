/* document.h - nodes of a parsed YAML text, with messages that name their place. */
#ifndef DAL_CLI_DOCUMENT_H
#define DAL_CLI_DOCUMENT_H

#include "ui/message.h"

#include <stddef.h>
#include <yaml.h>

typedef struct document {
    const char *place;
    yaml_document_t yaml;
} document;

/* A key of a mapping and what takes its value. */
typedef struct document_key {
    const char *name;
    int (*take)(void *user, const document *doc, yaml_node_t *value);
} document_key;

/* Lists and mappings within each other; more than any file has that the program reads. */
enum { DOCUMENT_DEPTH = 32 };

/* Parses a text of one document.  All functions return CLI_DONE or print and return CLI_USAGE. */
int document_parse(document *doc, const char *place, const char *bytes, size_t length);
/* "PLACE:line:column: message" about a node; returns CLI_USAGE. */
int document_fail(const document *doc, const yaml_node_t *node, const char *format, ...)
    CLI_PRINTF(3, 4);
/* The same for a name that is not among count; tells the nearest. */
int document_fail_unknown(const document *doc, const yaml_node_t *node, const char *what,
                          const char *name, const char *const *names, int count);
/* "PLACE:line:column: WHAT" for messages of others about a node. */
void document_place(const document *doc, const yaml_node_t *node, const char *what, char *place,
                    size_t size);
/* A node of the document by its number. */
yaml_node_t *document_node(const document *doc, int number);
/* The text of a scalar, which lives as long as the document; NULL after a message. */
const char *document_scalar(const document *doc, const yaml_node_t *node, const char *what);
int document_number(const document *doc, const yaml_node_t *node, const char *what, double *number);
/* Gives each value of a mapping to the key of its name; a key that is unknown or comes twice is an
 * error.  Keys without take are passed over. */
int document_read_mapping(const document *doc, yaml_node_t *node, const char *what,
                          const document_key *keys, int count, void *user);
/* The items of a sequence, or the node itself as the only one. */
int document_count(const yaml_node_t *node);
yaml_node_t *document_item(const document *doc, yaml_node_t *node, int i);

#endif
