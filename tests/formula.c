/* formula.c - formulas for tests. */
#include "formula.h"

#include <CUnit/CUnit.h>
#include <stdio.h>
#include <stdlib.h>

static const char *const names[SYMBOLS] = {"a", "b", "x", "y", "z", "x'", "y'", "z'"};

dal__node formula_resolve(void *user, const char *name, size_t length, bool prime, dal_error *error)
{
    for (int i = 0; i < SYMBOLS; i++) {
        bool same = length == 1 && name[0] == names[i][0] && prime == (names[i][1] != '\0');
        if (same) return dal__symbol(user, i);
    }
    error->status = DAL_STATUS_NAME;
    snprintf(error->message, sizeof error->message, "no such name: %.*s%s",
             (int)(length < 60 ? length : 60), name, prime ? "'" : "");
    return 0;
}

dal__node formula_resolve_index(void *user, const char *name, size_t length, bool prime,
                                dal_error *error)
{
    const bool is_index = length == 2 && name[1] == '1';
    return formula_resolve(user, name, is_index ? 1 : length, prime, error);
}

dal__graph *formula_graph(void)
{
    dal__graph *graph = dal__graph_create(PARAMETERS);
    return graph;
}

dal_status formula_parse(dal__graph *graph, const char *text, dal__node *node, dal_error *error)
{
    const dal__names meaning = {.resolve = formula_resolve, .user = graph};
    return dal__parse(graph, text, strlen(text), &meaning, node, error);
}

dal__node formula_node(dal__graph *graph, const char *text)
{
    dal__node node = 0;
    dal_error error = {.status = DAL_STATUS_OK};
    dal_status status = formula_parse(graph, text, &node, &error);
    CU_ASSERT_EQUAL(status, DAL_STATUS_OK);
    if (status != DAL_STATUS_OK) fprintf(stderr, "%s: %s\n", text, error.message);
    return node;
}

double *formula_work(size_t doubles)
{
    size_t lane = 8 * sizeof(double);
    return aligned_alloc(lane, (doubles * sizeof(double) / lane + 1) * lane);
}
