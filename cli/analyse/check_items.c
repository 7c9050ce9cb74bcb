/* check_items.c - the items of the report of `dalembert check`. */
#include "check_items.h"
#include "ui/memory.h"

#include <math.h>
#include <stdarg.h>

static check_entry *add_entry(check *c, check_result result, const char *what, char *text)
{
    c->entry = cli_realloc(c->entry, ((size_t)c->items + 1) * sizeof *c->entry);
    c->failed += result == CHECK_FAIL;
    c->unmeasured += result == CHECK_UNMEASURED;
    check_entry *entry = &c->entry[c->items++];
    *entry = (check_entry){.section = c->section, .result = result, .text = text};
    entry->value = entry->least = entry->most = NAN;
    entry->what = what ? cli_strdup(what) : NULL;
    return entry;
}

void check_item(check *c, check_result result, const char *what, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    add_entry(c, result, what, cli_format_list(format, list));
    va_end(list);
}

void check_number(check *c, check_result result, const char *what, double value, double least,
                  double most, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    check_entry *entry = add_entry(c, result, what, cli_format_list(format, list));
    va_end(list);
    entry->value = value;
    entry->least = least;
    entry->most = most;
}

void check_bound(check *c, const char *what, double value, double limit)
{
    check_number(c, value <= limit ? CHECK_OK : CHECK_FAIL, what, value, -INFINITY, limit,
                 "%.2g  (at most %.0e)", value, limit);
}
