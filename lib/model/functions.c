/* functions.c - the functions that a model defines, by formulas or by the points of a table. */
#include "model/functions.h"
#include "expr/lexer.h"
#include "expr/simplify.h"
#include "expr/table.h"
#include "expr/traversal.h"
#include "model/model.h"
#include <math.h>
#include <string.h>

static const char *skip_blanks(const char *text) { return text + strspn(text, " \t\r\n"); }

/* A name at *text, which is moved past it and the blanks after it; NULL: there is none. */
static const char *read_word(dal_model *model, const char **text)
{
    const size_t length = dal__name_length(*text, strlen(*text));
    const char *word = length ? dal__model_copy(model, *text, length) : NULL;
    *text = skip_blanks(*text + length);
    return word;
}

dal_status dal__read_signature(dal_model *model, const dal__entry *entry, dal__function *function,
                               dal_error *error)
{
    const char *at = skip_blanks(entry->name);
    *function = (dal__function){.name = read_word(model, &at)};
    char separator = '(';
    while (function->name && *at == separator && function->arity < DAL__MAX_ARGUMENTS) {
        at = skip_blanks(at + 1);
        const char *word = read_word(model, &at);
        for (int i = 0; word && i < function->arity; i++)
            if (strcmp(function->argument[i], word) == 0)
                return dal__fail_at(error, DAL_STATUS_NAME, DAL__AT_NAME(entry),
                                    "function %s has two arguments '%s'", function->name, word);
        if (!word) break;
        function->argument[function->arity++] = word;
        separator = ',';
    }
    if (model->out_of_memory) return DAL_STATUS_OK;
    if (*at == ',' && function->arity == DAL__MAX_ARGUMENTS)
        return dal__fail_at(error, DAL_STATUS_TOO_LARGE, DAL__AT_NAME(entry),
                            "function %s has more than %d arguments", function->name,
                            (int)DAL__MAX_ARGUMENTS);
    if (function->arity > 0 && *at == ')' && *skip_blanks(at + 1) == 0) return DAL_STATUS_OK;
    return dal__fail_at(error, DAL_STATUS_NAME, DAL__AT_NAME(entry),
                        "'%.80s' in functions is not a function with its arguments, as V(r)",
                        entry->name);
}

dal__node dal__call_function(dal__graph *graph, const dal__function *function,
                             const dal__node *argument)
{
    if (function->table)
        return dal__node_table(graph, DAL__TABLE_ORDERS * (function->table - 1), argument[0]);
    return dal__substitute(graph, function->body, function->symbol, function->arity, argument);
}

/* ---- tables ---- */

dal_status dal__model_insert_table(dal_model *model, dal__entry entry, const dal_table *table,
                                   dal_error *error)
{
    if (table->points < 2)
        return dal__fail_at(error, DAL_STATUS_MODEL, DAL__AT_TEXT(&entry),
                            "table %s has %d point%s; it needs two or more", entry.name,
                            table->points, table->points == 1 ? "" : "s");
    if (table->points > DAL__MAX_POINTS)
        return dal__fail_at(error, DAL_STATUS_TOO_LARGE, DAL__AT_TEXT(&entry),
                            "table %s has more than %d points", entry.name, (int)DAL__MAX_POINTS);
    for (int i = 0; i < table->points; i++) {
        if (!isfinite(table->at[i]) || !isfinite(table->value[i]))
            return dal__fail_at(error, DAL_STATUS_MODEL, DAL__AT_TEXT(&entry),
                                "point %d of table %s is not finite", i + 1, entry.name);
        if (i > 0 && !(table->at[i] > table->at[i - 1]))
            return dal__fail_at(error, DAL_STATUS_MODEL, DAL__AT_TEXT(&entry),
                                "point %d of table %s is not above the one before", i + 1,
                                entry.name);
    }
    double *data = dal__model_allocate(model, dal__table_size(table->points), sizeof *data);
    if (!data) return dal__memory_error(error);
    dal__table_fill(table, data);
    if (!dal__table_is_finite(table, data))
        return dal__fail_at(error, DAL_STATUS_MODEL, DAL__AT_TEXT(&entry),
                            "table %s: its %s overflows: points are too large, or too close",
                            entry.name,
                            table->interpolation == DAL_LINEAR ? "slope" : "cubic spline");
    DAL_TRY(dal__model_insert(model, entry, error));
    if (model->tables == model->table_capacity) {
        const int capacity = model->tables ? 2 * model->tables : 4;
        dal__tape_table *more = dal__model_allocate(model, (size_t)capacity, sizeof *more);
        if (!more) return dal__memory_error(error);
        if (model->tables) memcpy(more, model->table, (size_t)model->tables * sizeof *more);
        model->table = more;
        model->table_capacity = capacity;
    }
    model->table[model->tables++] = (dal__tape_table){
        .knots = table->points, .degree = table->interpolation == DAL_LINEAR ? 1 : 3, .data = data};
    return DAL_STATUS_OK;
}

dal_status dal_model_add_table(dal_model *model, const char *name, const dal_table *table, int line,
                               int column, dal_error *error)
{
    DAL_REQUIRE(model, error);
    DAL_REQUIRE(name, error);
    DAL_REQUIRE(table, error);
    DAL_REQUIRE(table->points <= 0 || (table->at && table->value), error);
    const dal__entry entry = {
        .section = DAL_SECTION_TABLES,
        .name = name,
        .text = dal__model_print(model, "%d points, %s", table->points,
                                 table->interpolation == DAL_LINEAR ? "linear" : "cubic"),
        .line = line,
        .column = column,
        .name_line = line,
        .name_column = column};
    if (!entry.text) return dal__memory_error(error);
    return dal__model_insert_table(model, entry, table, error);
}
