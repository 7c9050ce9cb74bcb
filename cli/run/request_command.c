/* request_command.c - the command line of a command for the run of a request. */
#include "request_command.h"
#include "io/json.h"
#include "ui/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
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

/* A setting, with the shortest digits that are read back as the same number. */
static void put_setting(FILE *out, const char *option, const dal_setting *s)
{
    char digits[JSON_NUMBER];
    char *text = cli_format("%s=%s", s->name,
                            isinf(s->value) ? s->value < 0.0 ? "-inf" : "inf"
                                            : json_format_number(digits, s->value));
    fprintf(out, " --%s ", option);
    put_value(out, text);
    free(text);
}

char *request_format_command(const run_request *request, const char *command, const char *system,
                             unsigned without)
{
    char *text;
    size_t length;
    FILE *out = cli_memstream_open(&text, &length);
    fprintf(out, "dalembert %s ", command);
    put_value(out, system);
    for (int k = 0; k < REQUEST_system; k++) {
        const bool is_setting = k == REQUEST_set || k == REQUEST_start;
        if (!request->text[k] || is_setting || without >> k & 1) continue;
        fprintf(out, " --%s ", request_options[k].name);
        put_value(out, request->text[k]);
    }
    for (int k = 0; k < request->set.count; k++) put_setting(out, "set", &request->set.item[k]);
    for (int k = 0; k < request->start.count; k++)
        put_setting(out, "start", &request->start.item[k]);
    cli_memstream_close(out);
    return text;
}
