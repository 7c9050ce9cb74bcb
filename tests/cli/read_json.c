/* read_json.c - shows how the program reads JSON, for a comparison with another reader.
 *
 * On stdin there are documents, each after its length and a line end.  For each a line is printed:
 * "refused", or the document with the bytes of its texts in hexadecimal digits. */
#include "io/json.h"
#include "ui/memory.h"

#include <stdlib.h>

static void show(const document *doc, yaml_node_t *node);

static void show_pairs(const document *doc, const yaml_node_t *node)
{
    const yaml_node_pair_t *pair = node->data.mapping.pairs.start;
    putchar('{');
    for (; pair < node->data.mapping.pairs.top; pair++) {
        show(doc, document_node(doc, pair->key));
        putchar(':');
        show(doc, document_node(doc, pair->value));
        putchar(',');
    }
    putchar('}');
}

static void show(const document *doc, yaml_node_t *node)
{
    if (node->type == YAML_MAPPING_NODE) {
        show_pairs(doc, node);
    } else if (node->type == YAML_SEQUENCE_NODE) {
        putchar('[');
        for (int i = 0; i < document_count(node); i++) {
            show(doc, document_item(doc, node, i));
            putchar(',');
        }
        putchar(']');
    } else if (node->data.scalar.style == YAML_PLAIN_SCALAR_STYLE) {
        printf("%s", node->data.scalar.value);
    } else {
        putchar('"');
        for (size_t i = 0; i < node->data.scalar.length; i++)
            printf("%02x", node->data.scalar.value[i]);
        putchar('"');
    }
}

int main(void)
{
    size_t length;
    while (scanf("%zu%*c", &length) == 1) {
        document doc = {0};
        char *bytes = cli_calloc(length + 1, 1);
        if (fread(bytes, 1, length, stdin) == length &&
            json_parse(&doc, "stdin", bytes, length) == CLI_DONE)
            show(&doc, yaml_document_get_root_node(&doc.yaml));
        else
            fputs("refused", stdout);
        putchar('\n');
        yaml_document_delete(&doc.yaml);
        free(bytes);
    }
    return 0;
}
