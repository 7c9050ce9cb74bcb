/* builtin.c - the systems that are embedded in the library. */
#include "load/builtin.h"
#include "core/error.h"
#include "dalembert_model.h"
#include <string.h>

const char *dal_builtin_name(int i)
{
    for (int k = 0; k <= i; k++)
        if (!dal__builtins[k].name) return NULL;
    return i < 0 ? NULL : dal__builtins[i].name;
}

const char *dal_builtin_text(const char *name)
{
    for (const dal__builtin *b = dal__builtins; name && b->name; b++)
        if (strcmp(b->name, name) == 0) return b->text;
    return NULL;
}

dal_status dal_model_builtin(dal_model **model, const char *name, dal_error *error)
{
    DAL_REQUIRE(model, error);
    const char *names[64], *text = dal_builtin_text(name);
    int count = 0;
    *model = NULL;
    DAL_REQUIRE(name, error);
    if (text) return dal_model_read(model, name, text, strlen(text), error);
    while (count < 64 && (names[count] = dal_builtin_name(count)) != NULL) count++;
    return dal__unknown(error, "system", name, names, count);
}
