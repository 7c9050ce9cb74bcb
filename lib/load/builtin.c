/* builtin.c - the systems that travel inside the library. */
#include "model/mechanics.h"
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
