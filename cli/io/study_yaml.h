/* study_yaml.h - nodes of a parsed YAML text, with messages that name their place. */
#ifndef DAL_CLI_STUDY_YAML_H
#define DAL_CLI_STUDY_YAML_H

#include "ui/cli.h"

#include <yaml.h>

typedef struct study_text {
    const char *place;
    yaml_document_t document;
} study_text;

/* A key of a mapping and what takes its value. */
typedef struct study_key {
    const char *name;
    int (*take)(void *user, const study_text *text, yaml_node_t *value);
} study_key;

/* Lists and mappings within each other; more than any file has that the program reads. */
enum { STUDY_DEPTH = 32 };

/* Parses a text of one document.  All functions return CLI_DONE or print and return CLI_USAGE. */
int study_text_parse(study_text *text, const char *place, const char *bytes, size_t length);
/* "PLACE:line:column: message" about a node; returns CLI_USAGE. */
int study_text_fail(const study_text *text, const yaml_node_t *node, const char *format, ...)
    CLI_PRINTF(3, 4);
/* The same for a name that is not among count; tells the nearest. */
int study_unknown(const study_text *text, const yaml_node_t *node, const char *what,
                  const char *name, const char *const *names, int count);
/* "PLACE:line:column: WHAT" for messages of others about a node. */
void study_text_place(const study_text *text, const yaml_node_t *node, const char *what,
                      char *place, size_t size);
/* A node of the document by its number. */
yaml_node_t *study_text_node(const study_text *text, int number);
/* The text of a scalar, which lives as long as the document; NULL after a message. */
const char *study_text_scalar(const study_text *text, const yaml_node_t *node, const char *what);
int study_text_number(const study_text *text, const yaml_node_t *node, const char *what,
                      double *number);
/* Gives each value of a mapping to the key of its name; a key that is unknown or comes twice is an
 * error.  Keys without take are passed over. */
int study_text_mapping(const study_text *text, yaml_node_t *node, const char *what,
                       const study_key *keys, int count, void *user);
/* The items of a sequence, or the node itself as the only one. */
int study_text_count(const yaml_node_t *node);
yaml_node_t *study_text_item(const study_text *text, yaml_node_t *node, int i);

#endif
