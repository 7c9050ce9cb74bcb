/* request_command.c - the command line of another command for the run of a request. */
#include "request_command.h"
#include "ui/memory.h"

#include <stdio.h>

char *request_format_command(const run_request *request, const char *command)
{
    char *text;
    size_t length;
    const request_settings *settings[] = {&request->set, &request->start};
    FILE *out = cli_memstream_open(&text, &length);
    fprintf(out, "dalembert %s %s", command, request->system_name);
    for (int k = 0; k < REQUEST_system; k++) {
        const bool is_setting = k == REQUEST_set || k == REQUEST_start;
        if (!request->text[k] || is_setting || REQUEST_ROW_OPTIONS >> k & 1) continue;
        fprintf(out, " --%s %s", request_options[k].name, request->text[k]);
    }
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < settings[i]->count; k++)
            fprintf(out, " --%s \"%s=%.15g\"", i == 0 ? "set" : "start", settings[i]->item[k].name,
                    settings[i]->item[k].value);
    cli_memstream_close(out);
    return text;
}
