/* functions.c - the functions that a model defines: their names and arguments, and calls. */
#include "model/functions.h"
#include "expr/lexer.h"
#include "expr/simplify.h"
#include "expr/table.h"
#include "expr/traversal.h"
#include "model/model.h"
#include <string.h>

static const char *skip_blanks(const char *text) { return text + strspn(text, " \t\r\n"); }

/* A name at *text, which is moved behind it and the blanks after it; NULL: there is none. */
static const char *read_word(dal_model *model, const char **text)
{
    const size_t length = dal__name_length(*text, strlen(*text));
    const char *word = length ? dal__model_print(model, "%.*s", (int)length, *text) : NULL;
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
                return dal__fail_at(error, DAL_NAME, DAL__AT_NAME(entry),
                                    "function %s has two arguments '%s'", function->name, word);
        if (!word) break;
        function->argument[function->arity++] = word;
        separator = ',';
    }
    if (model->out_of_memory) return dal__memory_error(error);
    if (*at == ',' && function->arity == DAL__MAX_ARGUMENTS)
        return dal__fail_at(error, DAL_TOO_LARGE, DAL__AT_NAME(entry),
                            "function %s has more than %d arguments", function->name,
                            (int)DAL__MAX_ARGUMENTS);
    if (function->arity > 0 && *at == ')' && *skip_blanks(at + 1) == 0) return DAL_OK;
    return dal__fail_at(error, DAL_NAME, DAL__AT_NAME(entry),
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
