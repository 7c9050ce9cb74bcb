/* document.h - nodes of a parsed YAML text, with messages that name their place. */
#ifndef DAL_CLI_DOCUMENT_H
#define DAL_CLI_DOCUMENT_H

#include "ui/message.h"

#include <stdbool.h>
#include <stddef.h>
#include <yaml.h>

typedef struct document {
    const char *place; /* for messages; NULL: without them */
    yaml_document_t yaml;
} document;

/* Lists and mappings within each other; more than any file has that the program reads. */
enum { DOCUMENT_DEPTH = 32 };

/* Parses a text of one document.  All functions that return int return CLI_DONE, or print and
 * return CLI_USAGE. */
int document_parse(document *doc, const char *place, const char *bytes, size_t length);
/* Prints "PLACE:line:column: message" about a node. */
int document_fail(const document *doc, const yaml_node_t *node, const char *format, ...)
    CLI_PRINTF(3, 4);
/* The same for a name that is not among count; suggests the nearest. */
int document_fail_unknown(const document *doc, const yaml_node_t *node, const char *what,
                          const char *name, const char *const *names, int count);
/* A node of the document by its number. */
yaml_node_t *document_node(const document *doc, int number);
/* The number of a scalar among words; -1 after a message with the nearest of them. */
int document_word(const document *doc, const yaml_node_t *node, const char *what,
                  const char *const *words, int count);
/* The text of a scalar, which lives as long as the document; NULL after a message, also where it
 * has control characters other than tabs and line ends. */
const char *document_scalar(const document *doc, const yaml_node_t *node, const char *what);
int document_number(const document *doc, const yaml_node_t *node, const char *what, double *number);

/* ---- mappings ---- */

/* A key of a mapping and what reads its value, NULL: nothing does.  A function below reads into the
 * member of *user at offset: const char *, double, double, long long, yaml_node_t *. */
typedef struct document_key document_key;
typedef int document_reader(void *user, const document *doc, yaml_node_t *value,
                            const document_key *key);
struct document_key {
    const char *name;
    document_reader *read;
    size_t offset;
};
int document_read_text(void *user, const document *doc, yaml_node_t *value,
                       const document_key *key);
int document_read_number(void *user, const document *doc, yaml_node_t *value,
                         const document_key *key);
int document_read_positive(void *user, const document *doc, yaml_node_t *value,
                           const document_key *key);
int document_read_count(void *user, const document *doc, yaml_node_t *value,
                        const document_key *key);
int document_read_node(void *user, const document *doc, yaml_node_t *value,
                       const document_key *key);

/* Reads the values of a mapping; a key that is unknown or comes twice is an error. */
int document_read_mapping(const document *doc, const yaml_node_t *node, const char *what,
                          const document_key *keys, int count, void *user);
/* Pair i of a mapping; false: there are no more. */
typedef struct document_pair {
    const char *name;
    yaml_node_t *key, *value;
} document_pair;
bool document_get_pair(const document *doc, const yaml_node_t *node, int i, document_pair *pair);
/* Checks before that that node is a mapping and its keys are texts, none of which comes twice;
 * where it is none the message is "WHAT: CONTENTS are required". */
int document_check_mapping(const document *doc, const yaml_node_t *node, const char *what,
                           const char *contents);
/* The value of a key; NULL where the mapping has none of that name, or there is no mapping. */
yaml_node_t *document_value(const document *doc, const yaml_node_t *node, const char *name);

/* ---- lists ---- */

/* The items of a sequence, or the node itself as the only one. */
int document_count(const yaml_node_t *node);
yaml_node_t *document_item(const document *doc, yaml_node_t *node, int i);

#endif
