/* name_groups.c - names of methods in groups. */
#include "name_groups.h"
#include "memory.h"
#include "screen.h"

#include <stdlib.h>
#include <string.h>

bool name_is_of_family(const char *a, const char *b)
{
    static const char number[] = "-0123456789";
    for (;; a++, b++) {
        a += strspn(a, number);
        b += strspn(b, number);
        if (*a != *b) return false;
        if (!*a) return true;
    }
}

bool name_is_of_group(const char *a, const char *b)
{
    const char *modifiers_a = strchr(a, '+'), *modifiers_b = strchr(b, '+');
    if (!modifiers_a || !modifiers_b)
        return !modifiers_a && !modifiers_b && name_is_of_family(a, b);
    return modifiers_a > a && modifiers_b > b && strcmp(modifiers_a, modifiers_b) == 0;
}

char *name_groups(const char *const *names, const bool *is_in, int count, int columns)
{
    enum { FEW = 2, MANY = 6, PASSES = 3 };
    char **groups = cli_calloc((size_t)count + 1, sizeof *groups), *text;
    int found = 0, out[FEW] = {0}, outside = 0;
    /* Groups of modifiers come first, single names last. */
    for (int j = 0; j < PASSES * count; j++) {
        const int i = j % count;
        if (j < count && !is_in[i] && outside++ < FEW) out[outside - 1] = i;
        int size = 0, inside = 0, first = i;
        for (int k = count - 1; k >= 0; k--) {
            if (k != i && !name_is_of_group(names[i], names[k])) continue;
            size++;
            inside += is_in[k];
            first = k;
        }
        const bool is_group = size > 1 && inside == size;
        const char *modifiers = strchr(names[i], '+');
        int length = (int)strlen(names[i]);
        while (length > 1 && strchr("0123456789", names[i][length - 1])) length--;
        const int pass = !is_group ? 2 : !modifiers;
        if (is_in[i] && pass == j / count && (!is_group || first == i))
            groups[found++] = !is_group   ? cli_strdup(names[i])
                              : modifiers ? cli_format("any %s", modifiers)
                                          : cli_format("%.*s*", length, names[i]);
    }
    if (outside == count)
        text = cli_strdup("none");
    else if (outside == 0)
        text = cli_strdup("all");
    else if (outside <= FEW && count >= MANY)
        text = cli_format("all but %s%s%s", names[out[0]], outside > 1 ? " and " : "",
                          outside > 1 ? names[out[1]] : "");
    else
        text = screen_list_names((const char *const *)groups, found, columns);
    for (int i = 0; i < found; i++) free(groups[i]);
    free(groups);
    return text;
}
