/* symbols.c - the names of a model, what a name means in a formula, and the parsing of one formula.
 * Names are distinct, and none is a function or another column of the output. */
#include "model/symbols.h"
#include "expr/lexer.h"
#include "expr/operations.h"
#include "expr/parser.h"
#include "expr/traversal.h"
#include "model/functions.h"
#include <stdio.h>
#include <string.h>

int dal__index_of(const char *name, size_t length, const char *const *names, int count)
{
    for (int i = 0; i < count; i++)
        if (strncmp(names[i], name, length) == 0 && names[i][length] == 0) return i;
    return -1;
}

dal_status dal__find_word(const char *word, int line, int column, const char *what,
                          const char *const *words, int count, int *i, dal_error *error)
{
    *i = dal__index_of(word, strlen(word), words, count);
    return *i >= 0 ? DAL_STATUS_OK : dal__unknown_at(error, line, column, what, word, words, count);
}

/* ---- clashes ---- */

#define NAME(code, arity, name) name,
static const char *const formula_words[] = {"t", "e", "pi", DAL__OP_LIST(NAME)};
#undef NAME
enum { WORD_E = 1, FORMULA_WORDS = sizeof formula_words / sizeof *formula_words };

/* D1, g12: the letter and a number without leading zeros. */
static bool is_numbered(const char *name, char letter)
{
    if (name[0] != letter || name[1] < '1' || name[1] > '9') return false;
    return strspn(name + 1, "0123456789") == strlen(name + 1);
}

/* A column that is no coordinate, velocity or invariant. */
static bool is_column(const dal__equations *e, const char *name)
{
    static const char *const fixed[] = {"E", "H", "error", "pi_e"};
    if (dal__index_of(name, strlen(name), fixed, 4) >= 0 || is_numbered(name, 'D')) return true;
    if (e->holonomic > 0 && is_numbered(name, 'C')) return true;
    if (e->vakonomic && is_numbered(name, 'g')) return true;
    const size_t prefix = strncmp(name, "p_", 2) == 0 ? 2 : strncmp(name, "pi_", 3) == 0 ? 3 : 0;
    return prefix > 0 &&
           dal__index_of(name + prefix, strlen(name + prefix), e->coordinate, e->n) >= 0;
}

typedef struct kind {
    dal_section section;
    const char *what;
    bool column; /* shown as a column of the output */
} kind;

static const kind kinds[] = {
    {DAL_SECTION_SIZES, "size", false},           {DAL_SECTION_COORDINATES, "coordinate", true},
    {DAL_SECTION_PARAMETERS, "parameter", false}, {DAL_SECTION_LET, "let", false},
    {DAL_SECTION_TABLES, "table", false},         {DAL_SECTION_FUNCTIONS, "function", false},
    {DAL_SECTION_INVARIANTS, "invariant", true},
};
enum { KINDS = sizeof kinds / sizeof *kinds };

static const char *entry_name(const dal__entry *entry)
{
    return entry->name ? entry->name : entry->text;
}

/* Whether two entries define one name; a function's name ends at its bracket. */
static bool same_name(const dal__entry *a, const dal__entry *b)
{
    const char *x = entry_name(a), *y = entry_name(b);
    if (*x != *y) return false;
    const size_t length = dal__name_length(x, strlen(x));
    return dal__name_length(y, strlen(y)) == length && memcmp(x, y, length) == 0;
}

static dal_status check_clash(dal_model *model, int k, const dal__entry *entry, dal_error *error)
{
    char name[128];
    const char *whole = entry_name(entry);
    snprintf(name, sizeof name, "%.*s", (int)dal__name_length(whole, strlen(whole)), whole);
    const bool hides = dal__hides_function(name) && kinds[k].section != DAL_SECTION_INVARIANTS;
    if (hides)
        dal__model_warn(model, entry,
                        dal__model_print(model, "%s '%s' hides the function of this name",
                                         kinds[k].what, name));
    for (int i = 0; i < FORMULA_WORDS && !dal__hides_function(name); i++)
        if (formula_words[i] && strcmp(formula_words[i], name) == 0)
            return dal__fail_at(error, DAL_STATUS_NAME, DAL__AT_NAME(entry),
                                "%s '%.80s': this name is reserved in formulas", kinds[k].what,
                                name);
    if (kinds[k].column && is_column(&model->equations, name))
        return dal__fail_at(error, DAL_STATUS_NAME, DAL__AT_NAME(entry),
                            "%s '%.80s': this name is reserved for a column of the output",
                            kinds[k].what, name);
    const bool by_bracket = kinds[k].section == DAL_SECTION_FUNCTIONS; /* V(r) and V(x) clash */
    for (int j = 0; j < k + by_bracket; j++) {
        /* An invariant may have the name of a parameter or a let: only columns must differ. */
        if (kinds[k].section == DAL_SECTION_INVARIANTS && !kinds[j].column) continue;
        for (int i = 0; i < model->count; i++) {
            const dal__entry *other = &model->entries[i];
            if (other == entry) break;
            if (other->section == kinds[j].section && same_name(other, entry))
                return dal__fail_at(error, DAL_STATUS_MODEL, DAL__AT_NAME(entry),
                                    "%s '%.80s': a %s already has this name", kinds[k].what, name,
                                    kinds[j].what);
        }
    }
    return DAL_STATUS_OK;
}

/* ---- collecting ---- */

static const char **collect(dal_model *model, dal_section section, int *count)
{
    *count = dal__model_count(model, section);
    const char **names = dal__model_allocate(model, (size_t)*count + 1, sizeof *names);
    if (!names) return NULL;
    for (int k = 0, i = 0; k < model->count; k++)
        if (model->entries[k].section == section) names[i++] = entry_name(&model->entries[k]);
    return names;
}

dal_status dal__collect_names(dal_model *model, dal_error *error)
{
    dal__equations *e = &model->equations;
    e->coordinate = collect(model, DAL_SECTION_COORDINATES, &e->n);
    e->parameter = collect(model, DAL_SECTION_PARAMETERS, &e->parameters);
    e->let_name = collect(model, DAL_SECTION_LET, &e->lets);
    e->invariant_name = collect(model, DAL_SECTION_INVARIANTS, &e->invariants);
    e->tag = collect(model, DAL_SECTION_TAGS, &e->tags);
    for (int i = 0; i < model->count; i++) e->observed += model->entries[i].observed;
    if (model->out_of_memory) return DAL_STATUS_OK;
    for (int k = 0; k < KINDS; k++)
        for (int i = 0; i < model->count; i++)
            if (model->entries[i].section == kinds[k].section && !model->entries[i].observed)
                DAL_TRY(check_clash(model, k, &model->entries[i], error));
    return DAL_STATUS_OK;
}

/* ---- meaning ---- */

static dal__node misplaced(const dal__scope *scope, const char *what, const char *name,
                           dal_error *error)
{
    dal__fail(error, DAL_STATUS_NAME, "%s '%.80s' may not stand here: only %sparameters%s", what,
              name, scope->inside ? "arguments and " : "",
              scope->given              ? ", t and what start gives before"
              : scope->may & DAL__MAY_T ? " and t"
                                        : "");
    return 0;
}

/* Coordinate i, or velocity i - n. */
static dal__node state(const dal__scope *scope, int i, const char *what, const char *name,
                       dal_error *error)
{
    const dal__equations *e = &scope->model->equations;
    if (scope->given && scope->given[i]) return scope->given[i];
    if (!(scope->may & DAL__MAY_STATE)) return misplaced(scope, what, name, error);
    return dal__symbol(e->graph, i < e->n ? e->q + i : e->v + i - e->n);
}

static dal__node unknown(const dal__scope *scope, const char *name, dal_error *error)
{
    enum { MAX_NAMES = DAL__MAX_ENTRIES + FORMULA_WORDS };
    const dal__equations *e = &scope->model->equations;
    const char *names[MAX_NAMES];
    int count = 0;
    for (int i = 0; i < e->n && scope->may & DAL__MAY_STATE; i++) {
        char velocity[DAL__MAX_LETTERS + 2];
        const char *pair[] = {e->coordinate[i], velocity};
        names[count++] = e->coordinate[i];
        snprintf(velocity, sizeof velocity, "%s'", e->coordinate[i]);
        if (dal__nearest_name(name, pair, 2) != velocity) continue;
        dal__unknown(error, "name", name, pair + 1, 1);
        return 0;
    }
    for (int i = 0; i < scope->parameters; i++) names[count++] = e->parameter[i];
    for (int i = 0; i < scope->lets; i++) names[count++] = e->let_name[i];
    for (int i = 0; i < e->sizes; i++) names[count++] = e->size_name[i];
    names[count++] = scope->may & DAL__MAY_T ? "t" : NULL;
    for (int i = WORD_E + 1; i < FORMULA_WORDS; i++) names[count++] = formula_words[i];
    dal__unknown(error, "name", name, names, count);
    return 0;
}

/* A let of what a start gives before it. */
static dal__node let_at_start(const dal__scope *scope, dal__node let)
{
    const dal__equations *e = &scope->model->equations;
    int symbols[2 * DAL__MAX_COORDINATES], count = 0;
    dal__node by[2 * DAL__MAX_COORDINATES];
    for (int i = 0; i < 2 * e->n; i++) {
        if (!scope->given[i]) continue;
        symbols[count] = i < e->n ? e->q + i : e->v + i - e->n;
        by[count++] = scope->given[i];
    }
    return dal__substitute(e->graph, let, symbols, count, by);
}

/* h1, .., hm, R_x, ..: the number of a reaction, -1: none */
static int reaction_index(const dal__equations *e, const char *name)
{
    char h[16];
    for (int a = 0; a < e->m && is_numbered(name, 'h'); a++) {
        snprintf(h, sizeof h, "h%d", a + 1);
        if (strcmp(h, name) == 0) return a;
    }
    if (e->m == 0 || strncmp(name, "R_", 2) != 0) return -1;
    const int i = dal__index_of(name + 2, strlen(name + 2), e->coordinate, e->n);
    return i < 0 ? -1 : e->m + i;
}

static dal__node reaction(const dal__scope *scope, const char *name, int i, dal_error *error)
{
    const dal__equations *e = &scope->model->equations;
    if (e->vakonomic)
        dal__fail(error, DAL_STATUS_NAME,
                  "vakonomic motion has no reaction '%.80s'; its multipliers are g1, g2, ..", name);
    else if (!(scope->may & DAL__MAY_REACTIONS))
        dal__fail(error, DAL_STATUS_NAME,
                  "the reaction '%.80s' may stand in invariants and events only", name);
    else
        return dal__symbol(e->graph, e->reaction + i);
    return 0;
}

static dal__node plain(const dal__scope *scope, const char *name, size_t length, dal_error *error)
{
    const dal__equations *e = &scope->model->equations;
    int i;
    if (scope->index && strcmp(name, scope->index) == 0) return dal__number(e->graph, scope->at);
    if ((i = dal__index_of(name, length, e->size_name, e->sizes)) >= 0)
        return dal__number(e->graph, e->size[i]);
    if (strcmp(name, "t") == 0)
        return scope->may & DAL__MAY_T ? dal__symbol(e->graph, e->t)
                                       : misplaced(scope, "the time", name, error);
    if ((i = dal__index_of(name, length, e->coordinate, e->n)) >= 0)
        return state(scope, i, "coordinate", name, error);
    if ((i = dal__index_of(name, length, e->parameter, scope->parameters)) >= 0)
        return dal__symbol(e->graph, i);
    if ((i = dal__index_of(name, length, e->let_name, scope->lets)) >= 0) {
        const dal__node let = scope->given ? let_at_start(scope, e->let[i]) : e->let[i];
        const bool has_state = dal__depends(e->graph, let, e->q, e->symbols);
        const bool has_t = dal__depends(e->graph, let, e->t, e->t + 1);
        const bool is_allowed =
            (!has_state || scope->may & DAL__MAY_STATE) && (!has_t || scope->may & DAL__MAY_T);
        return is_allowed ? let : misplaced(scope, "let", name, error);
    }
    if (strcmp(name, "e") == 0 && scope->may & DAL__MAY_GAUGE) return dal__symbol(e->graph, e->e);
    if (strcmp(name, "e") == 0) {
        dal__fail(error, DAL_STATUS_NAME, "e is the gauge variable; exp(1) is Euler's number");
        return 0;
    }
    char g[16];
    for (int a = 0; a < e->multipliers && scope->may & DAL__MAY_MULTIPLIERS; a++) {
        snprintf(g, sizeof g, "g%d", a + 1);
        if (strcmp(g, name) == 0) return dal__symbol(e->graph, e->g + a);
    }
    if ((i = reaction_index(e, name)) >= 0) return reaction(scope, name, i, error);
    return unknown(scope, name, error);
}

static dal__node resolve_name(void *user, const char *text, size_t length, bool prime,
                              dal_error *error)
{
    const dal__scope *scope = user;
    const dal__equations *e = &scope->model->equations;
    char name[128];
    if (length >= sizeof name) {
        dal__fail(error, DAL_STATUS_NAME, "unknown name '%.40s...'", text);
        return 0;
    }
    memcpy(name, text, length);
    name[length] = 0;
    for (int i = 0; scope->inside && !prime && i < scope->inside->arity; i++)
        if (strcmp(scope->inside->argument[i], name) == 0)
            return dal__symbol(e->graph, scope->inside->symbol[i]);
    if (!prime) return plain(scope, name, length, error);
    const bool is_second = length > 0 && name[length - 1] == '\''; /* x'', in equations alone */
    const int i = dal__index_of(name, length - is_second, e->coordinate, e->n);
    if (i >= 0 && is_second) return dal__symbol(e->graph, e->pi + i);
    if (i >= 0) return state(scope, e->n + i, "the velocity of", name, error);
    if (dal__index_of(name, length, e->parameter, e->parameters) < 0)
        return unknown(scope, name, error);
    dal__fail(error, DAL_STATUS_NAME, "parameter '%.80s' has no velocity", name);
    return 0;
}

/* ---- functions ---- */

static const char *scope_function(void *user, int i, int *arity)
{
    const dal__scope *scope = user;
    if (i >= scope->functions) return NULL;
    *arity = scope->model->equations.function[i].arity;
    return scope->model->equations.function[i].name;
}

static dal__node scope_call(void *user, int i, const dal__node *argument, dal_error *error)
{
    const dal__scope *scope = user;
    const dal__equations *e = &scope->model->equations;
    (void)error;
    return dal__call_function(e->graph, &e->function[i], argument);
}

/* ---- one formula ---- */

void dal__entry_title(const dal_model *model, const dal__entry *entry, char *title, size_t size)
{
    const char *label = entry->observed ? "observed" : dal__sections[entry->section].label;
    int number = 1; /* a formula that is no entry of the model has a name */
    for (int i = 0; i < model->count && &model->entries[i] != entry; i++)
        number += model->entries[i].section == entry->section;
    if (entry->item)
        snprintf(title, size,
                 entry->section == DAL_SECTION_EVENTS ? "%s %d, %.80s" : "%s %d on %.80s", label,
                 entry->item, entry->name);
    else if (entry->name && !entry->observed)
        snprintf(title, size, "%s %.80s", label, entry->name);
    else if (dal__sections[entry->section].form == DAL__FORM_LIST)
        snprintf(title, size, "%s %d", label, number);
    else
        snprintf(title, size, "%s", label);
}

/* Adds the title of the entry to the message, and its place in the file to the error's place. */
static dal_status locate(const dal_model *model, const dal__entry *entry, dal_error *error,
                         const dal_error *inner)
{
    char title[128];
    dal__entry_title(model, entry, title, sizeof title);
    int line = entry->line ? entry->line : 1, column = entry->line ? entry->column : 1;
    return dal__fail_at(error, inner->status, line + inner->line - 1,
                        inner->line == 1 ? column + inner->column - 1 : inner->column, "%s: %s",
                        title, inner->message);
}

dal_status dal__parse_entry(dal_model *model, const dal__entry *entry, dal__scope scope,
                            dal__node *node, dal_error *error)
{
    dal_error inner = {.line = 1, .column = 1};
    scope.model = model;
    scope.index = entry->index;
    scope.at = entry->at;
    const dal__names names = {resolve_name, scope_function, scope_call, &scope,
                              (scope.may & DAL__MAY_ACCELERATIONS) != 0};
    dal_status status =
        dal__parse(model->equations.graph, entry->text, strlen(entry->text), &names, node, &inner);
    if (status == DAL_STATUS_MEMORY) return dal__memory_error(error);
    return status == DAL_STATUS_OK ? DAL_STATUS_OK : locate(model, entry, error, &inner);
}

dal_status dal__not_finite(const dal_model *model, const dal__entry *entry, dal_error *error)
{
    const dal_error inner = {DAL_STATUS_MODEL, 1, 1, "the value is not finite"};
    const dal_status status = model->equations.graph->status;
    return status != DAL_STATUS_OK ? dal__size_error(status, error)
                                   : locate(model, entry, error, &inner);
}

dal__scope dal__scope_of(const dal__equations *e, unsigned may)
{
    return (dal__scope){
        .may = may, .parameters = e->parameters, .lets = e->lets, .functions = e->functions};
}
