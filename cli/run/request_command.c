/* request_command.c - the command line of a command for the run of a request. */
#include "request_command.h"
#include "ui/memory.h"

#include <stdio.h>
#include <string.h>

/* A value as a shell reads it: in double quotes where it has more than letters, digits and signs
 * that mean nothing to a shell. */
static void put_value(FILE *out, const char *text)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                "_.,:+=/%@-";
    if (*text && strspn(text, plain) == strlen(text)) {
        fputs(text, out);
        return;
    }
    fputc('"', out);
    for (; *text; text++) fprintf(out, "%s%c", strchr("\"\\$`", *text) ? "\\" : "", *text);
    fputc('"', out);
}

char *request_format_command(const run_request *request, const char *command, const char *system,
                             unsigned without)
{
    char *text;
    size_t length;
    const request_settings *settings[] = {&request->set, &request->start};
    FILE *out = cli_memstream_open(&text, &length);
    fprintf(out, "dalembert %s ", command);
    put_value(out, system);
    for (int k = 0; k < REQUEST_system; k++) {
        const bool is_setting = k == REQUEST_set || k == REQUEST_start;
        if (!request->text[k] || is_setting || without >> k & 1) continue;
        fprintf(out, " --%s ", request_options[k].name);
        put_value(out, request->text[k]);
    }
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < settings[i]->count; k++)
            fprintf(out, " --%s \"%s=%.15g\"", i == 0 ? "set" : "start", settings[i]->item[k].name,
                    settings[i]->item[k].value);
    cli_memstream_close(out);
    return text;
}
