/* text.c - characters of UTF-8, lists and their items, and what a text of a file may hold. */
#include "text.h"
#include "ui/memory.h"

#include <stdlib.h>
#include <string.h>

/* Overlong forms, surrogates and codes beyond U+10FFFF are no characters (The Unicode Standard,
 * table 3-7). */
int text_read_character(const char *text, long *code)
{
    static const long min[] = {0, 0, 0x80, 0x800, 0x10000};
    const unsigned char *s = (const unsigned char *)text;
    const int length = s[0] < 0x80   ? 1
                       : s[0] < 0xc0 ? 0
                       : s[0] < 0xe0 ? 2
                       : s[0] < 0xf0 ? 3
                       : s[0] < 0xf8 ? 4
                                     : 0;
    *code = length > 1 ? s[0] & (0x7f >> length) : s[0];
    for (int i = 1; i < length; i++) {
        if ((s[i] & 0xc0) != 0x80) return 0;
        *code = *code << 6 | (s[i] & 0x3f);
    }
    if (*code < min[length] || *code > 0x10ffff) return 0;
    return *code < 0xd800 || *code > 0xdfff ? length : 0;
}

bool text_is_control(long code) { return code < 0x20 || (code >= 0x7f && code < 0xa0); }

long text_find_control(const char *text, const char *allowed)
{
    long code;
    while (*text) {
        const int length = text_read_character(text, &code);
        if (length > 0 && text_is_control(code) && !strchr(allowed, *text)) return code;
        text += length > 0 ? length : 1;
    }
    return -1;
}

void text_write_quoted(FILE *out, char quote, const char *text)
{
    long code;
    fputc(quote, out);
    while (*text) {
        const int length = text_read_character(text, &code), bytes = length > 0 ? length : 1;
        if (*text == quote) fputc(quote, out);
        if (length > 0 && text_is_control(code))
            fputc(' ', out);
        else
            fwrite(text, 1, (size_t)bytes, out);
        text += bytes;
    }
    fputc(quote, out);
}

bool text_is_file_name(const char *text)
{
    return text[0] && text[0] != '.' && !strchr(text, '/') && text_find_control(text, "") < 0;
}

char *text_append_item(char *list, const char *separator, const char *item)
{
    char *longer = list ? cli_format("%s%s%s", list, separator, item) : cli_strdup(item);
    free(list);
    return longer;
}

const char *text_find_comma(const char *item)
{
    for (int depth = 0; *item && (*item != ',' || depth > 0); item++)
        depth += (*item == '(') - (*item == ')');
    return item;
}

bool text_is_name(const char *formula)
{
    static const char letters[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_'";
    return formula[strspn(formula, letters)] == '\0';
}

int text_split(char *list, const char ***items)
{
    int count = 0;
    char *end = NULL;
    *items = NULL;
    for (char *item = strtok_r(list, ",", &end); item; item = strtok_r(NULL, ",", &end)) {
        *items = cli_realloc(*items, ((size_t)count + 1) * sizeof **items);
        (*items)[count++] = item;
    }
    return count;
}
