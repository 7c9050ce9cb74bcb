/* name_patterns.c - names of methods in patterns. */
#include "name_patterns.h"
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

/* Whether two names have the same modifiers, or, without any, are of one family. */
static bool is_like(const char *a, const char *b)
{
    const char *modifiers_a = strchr(a, '+'), *modifiers_b = strchr(b, '+');
    if (!modifiers_a || !modifiers_b)
        return !modifiers_a && !modifiers_b && name_is_of_family(a, b);
    return modifiers_a > a && modifiers_b > b && strcmp(modifiers_a, modifiers_b) == 0;
}

char *name_patterns(const char *const *names, const bool *is_in, int count, int columns)
{
    enum { FEW = 2, MANY = 6, PASSES = 3 };
    char **patterns = cli_calloc((size_t)count + 1, sizeof *patterns), *text;
    int found = 0, out[FEW] = {0}, outside = 0;
    /* Patterns of modifiers come first, single names last. */
    for (int j = 0; j < PASSES * count; j++) {
        const int i = j % count;
        if (j < count && !is_in[i] && outside++ < FEW) out[outside - 1] = i;
        int size = 0, inside = 0, first = i;
        for (int k = count - 1; k >= 0; k--) {
            if (k != i && !is_like(names[i], names[k])) continue;
            size++;
            inside += is_in[k];
            first = k;
        }
        const bool is_pattern = size > 1 && inside == size;
        const char *modifiers = strchr(names[i], '+');
        int length = (int)strlen(names[i]);
        while (length > 1 && strchr("0123456789", names[i][length - 1])) length--;
        const int pass = !is_pattern ? 2 : !modifiers;
        if (is_in[i] && pass == j / count && (!is_pattern || first == i))
            patterns[found++] = !is_pattern ? cli_strdup(names[i])
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
        text = screen_list_names((const char *const *)patterns, found, columns);
    for (int i = 0; i < found; i++) free(patterns[i]);
    free(patterns);
    return text;
}
