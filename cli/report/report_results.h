/* report_results.h - NAME.json beside the table NAME.csv of a command: what it was made with. */
#ifndef DAL_CLI_REPORT_RESULTS_H
#define DAL_CLI_REPORT_RESULTS_H

#include "io/document.h"
#include "report_page.h"
#include "run/simulation.h"

typedef struct report_results {
    char *place; /* of NAME.json, */
    document doc;
    const yaml_node_t *root;   /* NULL: there is none */
    char *copy;                /* NAME.yaml */
    run_simulation simulation; /* with the model where its file is known */
} report_results;

/* Reads DIR/NAME.json, which may be missing.  Returns CLI_DONE, or prints and returns an exit
 * status; free it in any case. */
int results_read(report_results *results, const char *directory, const char *name);
void results_free(report_results *results);
/* The text of a member of the object, or of a mapping in it; "" where there is none or null. */
const char *results_text(const report_results *results, const char *mapping, const char *name);
/* The title of the system, or its name, or another text. */
const char *results_title(const report_results *results, const char *otherwise);
/* The beginning of the page: what moves, and how; the caller ends the list with its own items. */
void results_begin_facts(FILE *page, const report_results *results);

#endif
