/* columns.c - the columns of a run: their names, and which of them --columns selects. */
#include "columns.h"
#include "dalembert_program.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <fnmatch.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* The kinds of --columns; what belongs to none has a name only. */
/* clang-format off */
#define COLUMN_KIND_LIST(KIND) \
    KIND(Q, "q") \
    KIND(V, "v") \
    KIND(LIFT, "lift") \
    KIND(D, "D") \
    KIND(C, "C") \
    KIND(E, "E") \
    KIND(INVARIANTS, "invariants") \
    KIND(OBSERVED, "observed") \
    KIND(H, "h") \
    KIND(R, "R") \
    KIND(LAMBDA, "lambda") \
    KIND(SENSITIVITIES, "sensitivities")
/* clang-format on */

typedef enum column_kind {
#define KIND_CODE(code, word) COLUMNS_##code,
    COLUMN_KIND_LIST(KIND_CODE)
#undef KIND_CODE
        COLUMN_KINDS
} column_kind;

static const char *const kind_words[COLUMN_KINDS] = {
#define KIND_WORD(code, word) word,
    COLUMN_KIND_LIST(KIND_WORD)
#undef KIND_WORD
};

enum { NAME_SIZE = 256 };

static bool is_hidden(const char *name) { return name[0] == '|'; }

/* Value i is t, q, v, g or the lift, then the observables.  Formulas that are observed are the last
 * of the invariants, and h1.. are before R_x... */
static column_kind kind_of(const run_simulation *s, int i)
{
    const dal_system *system = s->system;
    const int n = system->n, observable = i - 1 - dal_run_dimension(s->run);
    const bool is_lifted = s->request.options.space == DAL_LIFTED;
    int number;
    if (i == 0) return COLUMN_KINDS;
    if (observable >= dal_run_observables(s->run)) return COLUMNS_SENSITIVITIES;
    if (i <= 2 * n) return i <= n ? COLUMNS_Q : COLUMNS_V;
    if (observable < 0) return is_lifted ? COLUMNS_LIFT : COLUMN_KINDS;
    switch (dal__run_observable_kind(s->run, observable, &number)) {
    case DAL__OBSERVE_D:
        return COLUMNS_D;
    case DAL__OBSERVE_E:
        return COLUMNS_E;
    case DAL__OBSERVE_LIFT:
        return COLUMNS_LIFT;
    case DAL__OBSERVE_INVARIANTS:
        return number < system->invariants - system->observed ? COLUMNS_INVARIANTS
                                                              : COLUMNS_OBSERVED;
    case DAL__OBSERVE_REACTIONS:
        return number < system->m ? COLUMNS_H : COLUMNS_R;
    case DAL__OBSERVE_MULTIPLIERS:
        return COLUMNS_LAMBDA;
    case DAL__OBSERVE_HOLONOMIC:
        return COLUMNS_C;
    default:
        return COLUMN_KINDS;
    }
}

/* dx/dk, dx'/dx'. */
static void name_derivatives(run_columns *c, const run_simulation *s, int first)
{
    char x[NAME_SIZE], by[NAME_SIZE], name[2 * NAME_SIZE + 4];
    const char *item = s->request.sensitivities;
    for (int k = 0; k < dal_sensitivity_count(s->sensitivity); k++) {
        item += strspn(item, ",");
        snprintf(by, sizeof by, "%.*s", (int)strcspn(item, ","), item);
        item += strcspn(item, ",");
        columns_rename(&s->request, by);
        for (int i = 0; i < c->derivatives; i++) {
            dal_run_component_name(s->run, i, x, sizeof x);
            columns_rename(&s->request, x);
            snprintf(name, sizeof name, "d%s/d%s", x, by);
            c->name[first + k * c->derivatives + i] = cli_strdup(name);
        }
    }
}

static void name_values(run_columns *c, const run_simulation *s)
{
    const dal_run *run = s->run;
    const int dimension = dal_run_dimension(run), values = 1 + dimension + dal_run_observables(run);
    char buffer[NAME_SIZE];
    c->derivatives = dal_sensitivity_is_lifted(s->sensitivity) ? dimension : 2 * s->system->n;
    c->values = values + dal_sensitivity_count(s->sensitivity) * c->derivatives;
    c->name = cli_calloc((size_t)c->values, sizeof *c->name);
    name_derivatives(c, s, values);
    for (int i = 0; i < values; i++) {
        const int k = i - 1, observable = k - dimension;
        const char *name = i == 0 ? "t"
                           : observable < 0
                               ? dal_run_component_name(run, k, buffer, NAME_SIZE)
                               : dal_run_observable_name(run, observable, buffer, NAME_SIZE);
        c->name[i] = cli_strdup(name ? name : "?");
    }
}

/* How an item selects: by the first of these that any column satisfies. */
typedef enum match { BY_NAME, BY_KIND, BY_PATTERN, MATCHES } match;

static bool is_match(const run_columns *c, const run_simulation *s, int i, const char *item,
                     match how)
{
    const column_kind kind = kind_of(s, i);
    if (how == BY_NAME) return strcmp(item, c->name[i]) == 0;
    if (how == BY_PATTERN) return fnmatch(item, c->name[i], 0) == 0;
    return kind < COLUMN_KINDS && strcmp(item, kind_words[kind]) == 0;
}

/* lambda, lambda1, .. of a method that has none. */
static int without_multipliers(const run_simulation *s, const char *item)
{
    char method[NAME_SIZE];
    if (s->system->properties & DAL_MASS_ON_KERNEL)
        return cli_fail(CLI_USAGE,
                        "--columns: no column '%s': where W is used on ker A alone, methods carry "
                        "no multipliers; F has h1..",
                        item);
    return cli_fail(CLI_USAGE,
                    "--columns: no column '%s': %s has no multipliers of its own, which are "
                    "lambda1..; F has h1..",
                    item, dal_method_name(&s->request.method, method, sizeof method));
}

static int unknown_item(const run_columns *c, const run_simulation *s, const char *item)
{
    if (s->request.options.reactions && strncmp(item, "lambda", 6) == 0)
        return without_multipliers(s, item);
    const char **names = cli_calloc((size_t)c->values + COLUMN_KINDS, sizeof *names);
    int count = 0;
    for (int i = 0; i < c->values; i++)
        if (!is_hidden(c->name[i])) names[count++] = c->name[i];
    for (int k = 0; k < COLUMN_KINDS; k++) names[count++] = kind_words[k];
    const char *nearest = dal__nearest_name(item, names, count);
    const bool is_other = nearest && strcmp(nearest, item) != 0;
    cli_fail(CLI_USAGE, "--columns: the run has no column '%s'%s%s%s", item,
             is_other ? "; did you mean '" : "", is_other ? nearest : "", is_other ? "'?" : "");
    free(names);
    return CLI_USAGE;
}

static int select_item(const run_columns *c, const run_simulation *s, const char *item,
                       bool *selected)
{
    for (match how = BY_NAME; how < MATCHES; how++) {
        bool any = false;
        for (int i = 0; i < c->values; i++) {
            if (is_hidden(c->name[i]) || !is_match(c, s, i, item, how)) continue;
            selected[i] = any = true;
        }
        if (any) return CLI_DONE;
    }
    return unknown_item(c, s, item);
}

/* Whether an item is about reactions, which are observed on request only. */
static bool is_of_reactions(const dal_system *system, const char *item)
{
    char name[NAME_SIZE];
    for (int k = COLUMNS_H; k <= COLUMNS_LAMBDA; k++) {
        if (strcmp(item, kind_words[k]) == 0) return true;
        const char *begin = k == COLUMNS_R ? "R_" : kind_words[k];
        if (strncmp(item, begin, strlen(begin)) != 0) continue;
        for (int i = 0; i < (k == COLUMNS_R ? system->n : system->m); i++) {
            snprintf(name, sizeof name, k == COLUMNS_R ? "R_%s" : "%s%d",
                     k == COLUMNS_R ? system->coordinate[i] : begin, i + 1);
            if (fnmatch(item, name, 0) == 0) return true;
        }
    }
    return false;
}

bool columns_need_reactions(const dal_system *system, const char *list)
{
    bool found = false;
    for (const char *item = list, *end; item && !found; item = *end ? end + 1 : NULL) {
        end = item + strcspn(item, ",");
        char *text = cli_strndup(item, (size_t)(end - item));
        found = system->reactions && is_of_reactions(system, text);
        for (int i = 0; i < system->n && found; i++)
            found = strcmp(text, system->coordinate[i]) != 0;
        for (int i = 0; i < system->invariants && found; i++)
            found = strcmp(text, system->invariant[i]) != 0;
        free(text);
    }
    return found;
}

/* All that is wrong in the list is named. */
static int select_items(const run_columns *c, const run_simulation *s, bool *selected)
{
    int status = CLI_DONE;
    for (const char *item = s->request.columns, *end; item; item = *end ? end + 1 : NULL) {
        end = item + strcspn(item, ",");
        char *text = cli_strndup(item, (size_t)(end - item));
        const int found = select_item(c, s, text, selected);
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

/* vx may be a coordinate, an invariant or any other column.  A formula keeps its text. */
static int rename_all(run_columns *c, const run_simulation *s)
{
    for (int i = 0; i < c->values; i++) {
        if (kind_of(s, i) == COLUMNS_OBSERVED) continue;
        const bool is_velocity = strchr(c->name[i], '\'') != NULL;
        columns_rename(&s->request, c->name[i]);
        for (int k = 0; is_velocity && k < c->values; k++)
            if (k != i && strcmp(c->name[i], c->name[k]) == 0)
                return cli_fail(CLI_USAGE, "--names plain: %s' would be '%s', another column",
                                c->name[i] + 1, c->name[i]);
    }
    return CLI_DONE;
}

int columns_make(run_columns *columns, const run_simulation *s)
{
    *columns = (run_columns){0};
    name_values(columns, s);
    const size_t values = (size_t)columns->values;
    bool *selected = cli_calloc(values, sizeof *selected);
    columns->index = cli_calloc(values, sizeof *columns->index);
    const int status = select_items(columns, s, selected);
    for (int i = 0; i < columns->values; i++)
        if (i == 0 || (s->request.columns ? selected[i] : !is_hidden(columns->name[i])))
            columns->index[columns->count++] = i;
    free(selected);
    const int renamed = rename_all(columns, s);
    return status == CLI_DONE ? renamed : status;
}

void columns_free(run_columns *columns)
{
    for (int i = 0; columns->name && i < columns->values; i++) free(columns->name[i]);
    free(columns->name);
    free(columns->index);
    *columns = (run_columns){0};
}

static int find_axis(const char *name, const char *const *names, int count, int *axis)
{
    for (*axis = 0; *axis < count; ++*axis)
        if (strcmp(names[*axis], name) == 0) return CLI_DONE;
    return cli_unknown("column of --axes", name, names, count);
}

int columns_find_axes(const char *axes, const char *const *names, int count, int axis[2])
{
    const char *comma = strchr(axes, ',');
    if (!comma) return cli_fail(CLI_USAGE, "--axes: '%s' is not two columns, X,Y", axes);
    char *first = cli_strndup(axes, (size_t)(comma - axes));
    int status = find_axis(first, names, count, &axis[0]);
    if (status == CLI_DONE) status = find_axis(comma + 1, names, count, &axis[1]);
    free(first);
    return status;
}
