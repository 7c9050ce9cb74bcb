/* columns.c - the columns of a run: their names, and which of them --columns selects. */
#include "columns.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <fnmatch.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* The groups of --columns; what belongs to none has a name only. */
#define COLUMN_GROUP_LIST(GROUP)                                                                   \
    GROUP(Q, "q")                                                                                  \
    GROUP(V, "v") GROUP(LIFT, "lift") GROUP(D, "D") GROUP(E, "E") GROUP(INVARIANTS, "invariants")

typedef enum column_group {
#define GROUP_CODE(code, word) COLUMNS_##code,
    COLUMN_GROUP_LIST(GROUP_CODE)
#undef GROUP_CODE
        COLUMN_GROUPS
} column_group;

static const char *const group_words[COLUMN_GROUPS] = {
#define GROUP_WORD(code, word) word,
    COLUMN_GROUP_LIST(GROUP_WORD)
#undef GROUP_WORD
};

enum { NAME_SIZE = 256 };

static bool is_hidden(const char *name) { return name[0] == '|'; }

/* Value i is t, q, v, g or the lift, then D1.., E, H and the norms, the invariants, error. */
static column_group group_of(const run_columns *c, const run_request *request, int i)
{
    const dal_system *system = request->system;
    const int n = system->n, observable = i - 1 - dal_run_dimension(request->run);
    const char *name = c->name[i];
    if (i == 0) return COLUMN_GROUPS;
    if (i <= 2 * n) return i <= n ? COLUMNS_Q : COLUMNS_V;
    if (observable < 0) return request->options.space == DAL_LIFTED ? COLUMNS_LIFT : COLUMN_GROUPS;
    if (system->constraints && observable < system->m) return COLUMNS_D;
    /* From behind: an invariant may be called E or H. */
    const bool has_error = system->exact && strcmp(c->name[c->values - 1], "error") == 0;
    const int invariants = system->invariant_values ? system->invariants : 0;
    if (i == c->values - 1 && has_error) return COLUMN_GROUPS;
    if (i >= c->values - has_error - invariants) return COLUMNS_INVARIANTS;
    return strcmp(name, "E") == 0 ? COLUMNS_E : COLUMNS_LIFT;
}

static void name_values(run_columns *c, const dal_run *run)
{
    const int dimension = dal_run_dimension(run);
    char buffer[NAME_SIZE];
    c->values = 1 + dimension + dal_run_observables(run);
    c->name = cli_calloc((size_t)c->values, sizeof *c->name);
    for (int i = 0; i < c->values; i++) {
        const int k = i - 1, observable = k - dimension;
        const char *name = i == 0 ? "t"
                           : observable < 0
                               ? dal_run_name(run, k, buffer, NAME_SIZE)
                               : dal_run_observable_name(run, observable, buffer, NAME_SIZE);
        c->name[i] = cli_strdup(name ? name : "?");
    }
}

/* How an item selects: by the first of these that any column satisfies. */
typedef enum match { BY_NAME, BY_GROUP, BY_PATTERN, MATCHES } match;

static bool is_match(const run_columns *c, const run_request *request, int i, const char *item,
                     match how)
{
    const column_group group = group_of(c, request, i);
    if (how == BY_NAME) return strcmp(item, c->name[i]) == 0;
    if (how == BY_PATTERN) return fnmatch(item, c->name[i], 0) == 0;
    return group < COLUMN_GROUPS && strcmp(item, group_words[group]) == 0;
}

static int unknown_item(const run_columns *c, const char *item)
{
    const char **names = cli_calloc((size_t)c->values + COLUMN_GROUPS, sizeof *names);
    int count = 0;
    for (int i = 0; i < c->values; i++)
        if (!is_hidden(c->name[i])) names[count++] = c->name[i];
    for (int k = 0; k < COLUMN_GROUPS; k++) names[count++] = group_words[k];
    const char *nearest = dal_nearest(item, names, count);
    const bool is_other = nearest && strcmp(nearest, item) != 0;
    cli_fail(CLI_USAGE, "--columns: the run has no column '%s'%s%s%s", item,
             is_other ? "; did you mean '" : "", is_other ? nearest : "", is_other ? "'?" : "");
    free(names);
    return CLI_USAGE;
}

static int select_item(const run_columns *c, const run_request *request, const char *item,
                       bool *selected)
{
    for (match how = BY_NAME; how < MATCHES; how++) {
        bool any = false;
        for (int i = 0; i < c->values; i++) {
            if (is_hidden(c->name[i]) || !is_match(c, request, i, item, how)) continue;
            selected[i] = any = true;
        }
        if (any) return CLI_DONE;
    }
    return unknown_item(c, item);
}

/* All that is wrong in the list is named. */
static int select_items(const run_columns *c, const run_request *request, bool *selected)
{
    int status = CLI_DONE;
    for (const char *item = request->columns, *end; item; item = *end ? end + 1 : NULL) {
        end = item + strcspn(item, ",");
        char *text = cli_strndup(item, (size_t)(end - item));
        const int found = select_item(c, request, text, selected);
        if (status == CLI_DONE) status = found;
        free(text);
    }
    return status;
}

void columns_rename(const run_request *request, char *name)
{
    const size_t length = strlen(name);
    if (request->names != REQUEST_NAMES_PLAIN || length < 2 || name[length - 1] != '\'') return;
    memmove(name + 1, name, length - 1);
    name[0] = 'v';
}

bool columns_is_velocity(const run_request *request, const char *name, const char *coordinate)
{
    const size_t length = strlen(coordinate);
    if (request->names == REQUEST_NAMES_PLAIN)
        return name[0] == 'v' && strcmp(name + 1, coordinate) == 0;
    return strncmp(name, coordinate, length) == 0 && strcmp(name + length, "'") == 0;
}

/* vx may be a coordinate, an invariant or any other column. */
static int rename_all(run_columns *c, const run_request *request)
{
    for (int i = 0; i < c->values; i++) {
        const bool is_velocity = strchr(c->name[i], '\'') != NULL;
        columns_rename(request, c->name[i]);
        for (int k = 0; is_velocity && k < c->values; k++)
            if (k != i && strcmp(c->name[i], c->name[k]) == 0)
                return cli_fail(CLI_USAGE, "--names plain: %s' would be '%s', another column",
                                c->name[i] + 1, c->name[i]);
    }
    return CLI_DONE;
}

int columns_make(run_columns *columns, const run_request *request)
{
    *columns = (run_columns){0};
    name_values(columns, request->run);
    const size_t values = (size_t)columns->values;
    bool *selected = cli_calloc(values, sizeof *selected);
    columns->index = cli_calloc(values, sizeof *columns->index);
    const int status = select_items(columns, request, selected);
    for (int i = 0; i < columns->values; i++)
        if (i == 0 || (request->columns ? selected[i] : !is_hidden(columns->name[i])))
            columns->index[columns->count++] = i;
    free(selected);
    const int renamed = rename_all(columns, request);
    return status == CLI_DONE ? renamed : status;
}

void columns_free(run_columns *columns)
{
    for (int i = 0; columns->name && i < columns->values; i++) free(columns->name[i]);
    free(columns->name);
    free(columns->index);
    *columns = (run_columns){0};
}
