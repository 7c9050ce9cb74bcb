/* request_data.c - what a run is made from. */
#include "request_data.h"
#include "ui/memory.h"

#include <stdlib.h>
#include <string.h>

bool request_has(const run_request *request, int option) { return request->text[option] != NULL; }

size_t request_find_formula(const char **list, const char **end)
{
    *list += strspn(*list, " ");
    size_t length = strcspn(*list, ";");
    *end = *list + length;
    while (length > 0 && (*list)[length - 1] == ' ') length--;
    return length;
}

bool request_observes(const run_request *request, const char *name)
{
    for (const char *at = request->observe, *end; at; at = *end ? end + 1 : NULL) {
        const size_t length = request_find_formula(&at, &end);
        if (strlen(name) == length && strncmp(at, name, length) == 0) return true;
    }
    return false;
}

void request_add_setting(request_settings *settings, const char *name, double value)
{
    for (int i = 0; i < settings->count; i++)
        if (strcmp(settings->item[i].name, name) == 0) {
            settings->item[i].value = value;
            return;
        }
    size_t count = (size_t)settings->count + 1;
    settings->item = cli_realloc(settings->item, count * sizeof *settings->item);
    settings->item[settings->count++] = (dal_setting){cli_strdup(name), value};
}

void request_free_settings(request_settings *settings)
{
    for (int i = 0; i < settings->count; i++) free((char *)settings->item[i].name);
    free(settings->item);
}
