/* model.c - a model: named texts, kept until its system is made. */
#include "model/model.h"
#include "core/words.h"
#include "expr/lexer.h"
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *dal__section_name(dal_section section)
{
    DAL__RETURN_WORD(DAL_SECTION_LIST, DAL__SECOND, section, "?");
}

const dal__model_section dal__sections[DAL_SECTION_COUNT] = {
    [DAL_SECTION_TITLE] = {DAL__FORM_SCALAR, NULL},
    [DAL_SECTION_REFERENCE] = {DAL__FORM_SCALAR, NULL},
    [DAL_SECTION_COORDINATES] = {DAL__FORM_LIST, NULL},
    [DAL_SECTION_SIZES] = {DAL__FORM_MAPPING, "size"},
    [DAL_SECTION_PARAMETERS] = {DAL__FORM_MAPPING, "parameter"},
    [DAL_SECTION_FILES] = {DAL__FORM_MAPPING, NULL},
    [DAL_SECTION_TABLES] = {DAL__FORM_MAPPING, NULL},
    [DAL_SECTION_FUNCTIONS] = {DAL__FORM_MAPPING, "function"},
    [DAL_SECTION_LET] = {DAL__FORM_MAPPING, "let"},
    [DAL_SECTION_LAGRANGIAN] = {DAL__FORM_SCALAR, "lagrangian"},
    [DAL_SECTION_ACCELERATIONS] = {DAL__FORM_MAPPING, "acceleration of"},
    [DAL_SECTION_FORCES] = {DAL__FORM_MAPPING, "force on"},
    [DAL_SECTION_CONSTRAINTS] = {DAL__FORM_LIST, "constraint"},
    [DAL_SECTION_HOLONOMIC] = {DAL__FORM_LIST, "holonomic constraint"},
    [DAL_SECTION_REACTIONS] = {DAL__FORM_MAPPINGS, "reaction"},
    [DAL_SECTION_MECHANICS] = {DAL__FORM_SCALAR, NULL},
    [DAL_SECTION_CONTROLS] = {DAL__FORM_MAPPINGS, "control"},
    [DAL_SECTION_EQUATIONS] = {DAL__FORM_LIST, "equation"},
    [DAL_SECTION_GAUGE] = {DAL__FORM_MAPPING, "gauge"},
    [DAL_SECTION_START] = {DAL__FORM_MAPPING, "start of"},
    [DAL_SECTION_INVARIANTS] = {DAL__FORM_MAPPING, "invariant"},
    [DAL_SECTION_EVENTS] = {DAL__FORM_MAPPINGS, "event"},
    [DAL_SECTION_EXACT] = {DAL__FORM_MAPPING, "exact solution for"},
    [DAL_SECTION_TAGS] = {DAL__FORM_LIST, NULL},
    [DAL_SECTION_PICTURE] = {DAL__FORM_MAPPING, "picture"},
    [DAL_SECTION_DEFAULTS] = {DAL__FORM_MAPPING, NULL},
};

const char dal__set_prefix[] = "set.", dal__solve_prefix[] = "solve.";

static const char *text_after(const char *prefix, const dal__entry *entry, dal_section section)
{
    const size_t length = strlen(prefix);
    const bool begins =
        entry->section == section && entry->name && strncmp(entry->name, prefix, length) == 0;
    return begins ? entry->name + length : NULL;
}

const char *dal__set_name(const dal__entry *entry)
{
    return text_after(dal__set_prefix, entry, DAL_SECTION_EVENTS);
}

const char *dal__solved_name(const dal__entry *entry)
{
    return text_after(dal__solve_prefix, entry, DAL_SECTION_START);
}

/* Whether a section has mappings. */
static bool has_names(dal_section section)
{
    return dal__sections[section].form >= DAL__FORM_MAPPING;
}

/* ---- memory ---- */

void *dal__model_allocate(dal_model *model, size_t count, size_t size)
{
    void *memory = dal__pool_allocate(&model->memory, count, size);
    model->out_of_memory |= !memory;
    return memory;
}

dal__node *dal__model_nodes(dal_model *model, int count, dal__node initial)
{
    dal__node *list = dal__model_allocate(model, (size_t)count, sizeof *list);
    for (int i = 0; list && i < count; i++) list[i] = initial;
    return list;
}

char *dal__model_print(dal_model *model, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    char *text = length < 0 ? NULL : dal__model_allocate(model, (size_t)length + 1, 1);
    if (!text) return NULL;
    va_start(arguments, format);
    vsnprintf(text, (size_t)length + 1, format, arguments);
    va_end(arguments);
    return text;
}

char *dal__model_copy(dal_model *model, const char *text, size_t length)
{
    char *copy = dal__pool_text(&model->memory, text, length);
    model->out_of_memory |= !copy;
    return copy;
}

void dal__model_warn(dal_model *model, const dal__entry *entry, const char *text)
{
    dal__warning *warning = dal__model_allocate(model, 1, sizeof *warning), **end = &model->warning;
    if (!warning) return;
    *warning = (dal__warning){.text = text, .line = entry->name_line, .column = entry->name_column};
    while (*end) end = &(*end)->next;
    *end = warning;
}

const char *dal_model_warning(const dal_model *model, int i, int *line, int *column)
{
    const dal__warning *warning = model && i >= 0 ? model->warning : NULL;
    while (warning && i-- > 0) warning = warning->next;
    if (!warning) return NULL;
    if (line) *line = warning->line;
    if (column) *column = warning->column;
    return warning->text;
}

dal_status dal__size_error(dal_status status, dal_error *error)
{
    if (status != DAL_STATUS_TOO_LARGE) return dal__memory_error(error);
    return dal__fail(error, status, "the equations of the system are too large");
}

dal_status dal__check_size(dal_status status, dal_error *error)
{
    return status == DAL_STATUS_OK ? DAL_STATUS_OK : dal__size_error(status, error);
}

dal_status dal__model_conclude(const dal_model *model, dal_status status, dal_error *error)
{
    const dal__graph *graph = model->equations.graph;
    if (model->out_of_memory) return dal__memory_error(error);
    if (graph) DAL_TRY(dal__check_size(graph->status, error));
    return status;
}

void dal__model_discard(dal_model *model)
{
    dal__pool_free(&model->memory);
    free(model->given);
    free(model);
}

dal_model *dal_model_create(const char *name)
{
    dal_model *model = calloc(1, sizeof *model);
    if (!model) return NULL;
    if (!name) name = "";
    model->name = dal__model_copy(model, name, strlen(name));
    if (model->name) return model;
    dal__model_discard(model);
    return NULL;
}

/* ---- entries ---- */

const dal__entry *dal__model_entry(const dal_model *model, dal_section section, int i)
{
    for (int k = 0; k < model->count; k++)
        if (model->entries[k].section == section && i-- == 0) return &model->entries[k];
    return NULL;
}

int dal__model_count(const dal_model *model, dal_section section)
{
    int count = 0;
    for (int k = 0; k < model->count; k++) count += model->entries[k].section == section;
    return count;
}

const dal__entry *dal__constraint_entry(const dal_model *model, int a)
{
    const int first = dal__model_count(model, DAL_SECTION_CONSTRAINTS);
    return a < first ? dal__model_entry(model, DAL_SECTION_CONSTRAINTS, a)
                     : dal__model_entry(model, DAL_SECTION_HOLONOMIC, a - first);
}

const char *dal_model_text(const dal_model *model, dal_section section, int i, const char **name,
                           int *line, int *column)
{
    const dal__entry *entry = NULL;
    for (int k = 0; model && i >= 0 && k < model->given_count && !entry; k++)
        if (model->given[k].section == section && i-- == 0) entry = &model->given[k];
    if (!entry) return NULL;
    if (name) *name = entry->name;
    if (line) *line = entry->line;
    if (column) *column = entry->column;
    return entry->text;
}

int dal__model_item(const dal_model *model, dal_section section, int i)
{
    for (int k = 0; i >= 0 && k < model->given_count; k++)
        if (model->given[k].section == section && i-- == 0) return model->given[k].item;
    return 0;
}

/* The name of a column of its own, which is one line of a table. */
static dal_status check_observed(const dal__entry *entry, dal_error *error)
{
    const char *text = entry->text;
    const size_t length = strlen(text), letters = dal__name_length(text, length);
    const bool is_name = letters > 0 && letters + (text[letters] == '\'') == length;
    if (length > DAL__MAX_LETTERS)
        return dal__fail_at(error, DAL_STATUS_TOO_LARGE, DAL__AT_TEXT(entry),
                            "'%.40s...' has more than %d characters: an invariant of the system "
                            "file may be longer",
                            text, (int)DAL__MAX_LETTERS);
    if (length == 0)
        return dal__fail_at(error, DAL_STATUS_SYNTAX, DAL__AT_TEXT(entry),
                            "a formula to observe is missing");
    if (text[0] == ' ' || text[length - 1] == ' ' || strcspn(text, "\n\r\t;\"") < length)
        return dal__fail_at(error, DAL_STATUS_SYNTAX, DAL__AT_TEXT(entry),
                            "a formula to observe is one line, without quotes or semicolons, and "
                            "without blanks at its ends");
    if (is_name)
        return dal__fail_at(error, DAL_STATUS_NAME, DAL__AT_TEXT(entry),
                            "'%s' is a name; as a formula to observe it is written (%s)", text,
                            text);
    return DAL_STATUS_OK;
}

/* Checks the name of an entry, or the text of a coordinate.  A start, or what an event sets, may
 * name a velocity, x'. */
static dal_status check_name(const dal__entry *entry, dal_error *error)
{
    const char *name = entry->section == DAL_SECTION_COORDINATES ? entry->text : entry->name;
    if (entry->observed) return check_observed(entry, error);
    if (!name || entry->section == DAL_SECTION_FILES) return DAL_STATUS_OK;
    const char *set = dal__set_name(entry), *solved = dal__solved_name(entry);
    if (set || solved) name = set ? set : solved;
    size_t length = strlen(name);
    if (entry->section == DAL_SECTION_FUNCTIONS) length = dal__name_length(name, length);
    const bool velocity = entry->section == DAL_SECTION_START || set;
    if (velocity && length && name[length - 1] == '\'') length--;
    if (length > DAL__MAX_LETTERS && entry->section != DAL_SECTION_START)
        return dal__fail_at(error, DAL_STATUS_TOO_LARGE, DAL__AT_NAME(entry),
                            "'%.40s...' in %s has more than %d characters", name,
                            dal__section_name(entry->section), (int)DAL__MAX_LETTERS);
    size_t letters = dal__name_length(name, length);
    const bool may_index = !entry->name || dal__sections[entry->section].label;
    if (letters > 0 && may_index && name[letters] == '[' && length > letters &&
        strcspn(name, "]") == length - 1)
        letters = length;
    if (length > 0 && letters == length) return DAL_STATUS_OK;
    const char *hint = strchr(name, '(') || strchr(name, ')')
                           ? "; a formula with commas within {} or [] needs quotes"
                       : strchr(name, ' ') ? "; is a bracket not closed?"
                                           : "";
    return dal__fail_at(error, DAL_STATUS_NAME, DAL__AT_NAME(entry),
                        "'%.80s' in %s is not a name: a letter, then letters, digits and _%s", name,
                        dal__section_name(entry->section), hint);
}

dal_status dal__duplicate(const dal__entry *entry, dal_error *error)
{
    const char *section = entry->observed ? "what is observed" : dal__section_name(entry->section);
    const char *solved = dal__solved_name(entry);
    const char *name = entry->name ? entry->name : entry->text;
    if (dal__sections[entry->section].form == DAL__FORM_SCALAR)
        return dal__fail_at(error, DAL_STATUS_MODEL, DAL__AT_NAME(entry), "duplicate %s", section);
    return dal__fail_at(error, DAL_STATUS_MODEL, DAL__AT_NAME(entry), "duplicate '%.80s' in %s",
                        solved ? solved : name, solved ? "solve" : section);
}

static dal_status check_duplicate(const dal_model *model, const dal__entry *entry, dal_error *error)
{
    bool named = has_names(entry->section);
    const char *name = named ? entry->name : entry->text;
    if (entry->section == DAL_SECTION_CONSTRAINTS || entry->section == DAL_SECTION_HOLONOMIC ||
        entry->section == DAL_SECTION_EQUATIONS)
        return DAL_STATUS_OK;
    for (int k = 0; k < model->given_count; k++) {
        const dal__entry *other = &model->given[k];
        if (other->section != entry->section || other->item != entry->item) continue;
        if (dal__sections[entry->section].form == DAL__FORM_SCALAR ||
            strcmp(named ? other->name : other->text, name) == 0)
            return dal__duplicate(entry, error);
    }
    return DAL_STATUS_OK;
}

dal_status dal__model_insert(dal_model *model, dal__entry entry, dal_error *error)
{
    int line = entry.name_line, column = entry.name_column;
    if (entry.section >= DAL_SECTION_COUNT)
        return dal__fail_at(error, DAL_STATUS_ARGUMENT, line, column,
                            "no section has the number %d", (int)entry.section);
    if (model->made)
        return dal__fail_at(error, DAL_STATUS_ARGUMENT, line, column,
                            "'%.80s' already has its system: nothing can be added", model->name);
    if (model->given_count && model->given[model->given_count - 1].observed && !entry.observed)
        return dal__fail_at(error, DAL_STATUS_ARGUMENT, line, column,
                            "formulas to observe come after all other entries");
    if (model->given_count == DAL__MAX_ENTRIES)
        return dal__fail_at(error, DAL_STATUS_TOO_LARGE, line, column, "more than %d entries",
                            (int)DAL__MAX_ENTRIES);
    const bool named = has_names(entry.section);
    if (!entry.text || named != (entry.name != NULL))
        return dal__fail_at(error, DAL_STATUS_ARGUMENT, line, column, "an entry of %s has %s",
                            dal__section_name(entry.section),
                            named ? "a name and a text" : "a text and no name");
    DAL_TRY(check_name(&entry, error));
    DAL_TRY(check_duplicate(model, &entry, error));
    entry.text = dal__model_copy(model, entry.text, strlen(entry.text));
    if (named) entry.name = dal__model_copy(model, entry.name, strlen(entry.name));
    if (model->given_count == model->given_capacity) {
        const int capacity = model->given_capacity ? 2 * model->given_capacity : 32;
        dal__entry *given = realloc(model->given, (size_t)capacity * sizeof *given);
        if (!given) return dal__memory_error(error);
        model->given = given;
        model->given_capacity = capacity;
    }
    if (!entry.text || (named && !entry.name)) return dal__memory_error(error);
    model->given[model->given_count++] = entry;
    model->entries = model->given;
    model->count = model->given_count;
    return DAL_STATUS_OK;
}

dal_status dal_model_add(dal_model *model, dal_section section, const char *name, const char *text,
                         int line, int column, dal_error *error)
{
    DAL_REQUIRE(model, error);
    dal__entry entry = {section, name, text, line, column, line, column, .item = 0};
    if (section >= DAL_SECTION_COUNT) return dal__model_insert(model, entry, error);
    if (section == DAL_SECTION_TABLES)
        return dal__fail_at(error, DAL_STATUS_ARGUMENT, line, column,
                            "tables are added by dal_model_add_table");
    if (dal__sections[section].form == DAL__FORM_MAPPINGS && name) { /* "2.x" is x of item 2 */
        const char *c = name;
        while (*c >= '0' && *c <= '9' && entry.item <= DAL__MAX_COORDINATES)
            entry.item = 10 * entry.item + (*c++ - '0');
        if (*c != '.' || entry.item < 1)
            return dal__fail_at(error, DAL_STATUS_NAME, line, column, "'%.80s' in %s is not %s",
                                name, dal__section_name(section),
                                section == DAL_SECTION_EVENTS ? "an event and a key, as 1.when"
                                : section == DAL_SECTION_CONTROLS
                                    ? "a column and a coordinate, as 1.x"
                                    : "a constraint and a coordinate, as 1.x");
        entry.name = c + 1;
    }
    return dal__model_insert(model, entry, error);
}

const char *dal_effort_name(dal_effort effort)
{
    DAL__RETURN_WORD(DAL_EFFORT_LIST, DAL__SECOND, effort, "?");
}

dal_status dal_model_set_effort(dal_model *model, dal_effort effort, dal_error *error)
{
    DAL_REQUIRE(model, error);
    if ((unsigned)effort >= DAL_EFFORT_COUNT)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "no effort has the number %d", (int)effort);
    if (model->made)
        return dal__fail(error, DAL_STATUS_ARGUMENT,
                         "'%.80s' already has its system: its effort is %s", model->name,
                         dal_effort_name(model->effort));
    model->effort = effort;
    return DAL_STATUS_OK;
}

dal_status dal_model_set_gauge(dal_model *model, const char *text, dal_error *error)
{
    static const char blanks[] = " \t";
    DAL_REQUIRE(model, error);
    DAL_REQUIRE(text, error);
    if (model->made)
        return dal__fail(error, DAL_STATUS_ARGUMENT,
                         "'%.80s' already has its system, with its gauge", model->name);
    int kept = 0;
    for (int i = 0; i < model->given_count; i++)
        if (model->given[i].section != DAL_SECTION_GAUGE) model->given[kept++] = model->given[i];
    model->given_count = model->count = kept;
    model->has_other_gauge = true;
    for (const char *end = text, *name = text;; name = ++end) {
        name += strspn(name, blanks);
        for (int depth = 0; *end && (depth > 0 || *end != ','); end++)
            depth += (*end == '(') - (*end == ')');
        const char *formula = memchr(name, '=', end > name ? (size_t)(end - name) : 0);
        const int column = 1 + (int)(name - text);
        if (!formula)
            return dal__fail_at(error, DAL_STATUS_SYNTAX, 1, column,
                                "a gauge is 'e = 1, mu_e = 0.1*cos(t)', of these two or one");
        for (formula++; formula < end && strchr(blanks, *formula);) formula++;
        dal__entry entry = {.section = DAL_SECTION_GAUGE,
                            .line = 1,
                            .column = 1 + (int)(formula - text),
                            .name_line = 1,
                            .name_column = column};
        entry.name = dal__model_copy(model, name, strcspn(name, " \t="));
        entry.text = dal__model_copy(model, formula, (size_t)(end - formula));
        if (!entry.name || !entry.text) return dal__memory_error(error);
        if (strcmp(entry.name, "e") != 0 && strcmp(entry.name, "mu_e") != 0)
            return dal__fail_at(error, DAL_STATUS_NAME, 1, column,
                                "'%.40s' is not e or mu_e, which a gauge gives", entry.name);
        DAL_TRY(dal__model_insert(model, entry, error));
        if (!*end) return DAL_STATUS_OK;
    }
}

dal_status dal_model_set_mechanics(dal_model *model, dal_mechanics mechanics, dal_error *error)
{
    DAL_REQUIRE(model, error);
    if ((unsigned)mechanics >= DAL_MECHANICS_COUNT)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "no mechanics has the number %d",
                         (int)mechanics);
    if (model->made)
        return dal__fail(error, DAL_STATUS_ARGUMENT,
                         "'%.80s' already has its system: its mechanics is %s", model->name,
                         model->equations.vakonomic ? "vakonomic" : "lagrange-dalembert");
    model->mechanics = mechanics;
    return DAL_STATUS_OK;
}

dal_status dal_model_observe(dal_model *model, const char *formula, int line, int column,
                             dal_error *error)
{
    DAL_REQUIRE(model, error);
    DAL_REQUIRE(formula, error);
    return dal__model_insert(model,
                             (dal__entry){.section = DAL_SECTION_INVARIANTS,
                                          .name = formula,
                                          .text = formula,
                                          .line = line,
                                          .column = column,
                                          .name_line = line,
                                          .name_column = column,
                                          .observed = true},
                             error);
}
