/* manifest.c - manifest.json: the complete input of a run, what ran it, and how far it came. */
#include "dalembert_codegen.h"
#include "io/file.h"
#include "io/json.h"
#include "run_directory.h"

#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>

#if defined(__clang__)
#define COMPILER __VERSION__
#elif defined(__GNUC__)
#define COMPILER "gcc " __VERSION__
#else
#define COMPILER "unknown"
#endif

/* The Makefile tells how this program was compiled. */
#ifndef CLI_FLAGS
#define CLI_FLAGS ""
#endif

void manifest_put_machine(FILE *out)
{
    struct utsname machine;
    fputs(",\n  \"machine\": {", out);
    if (uname(&machine) == 0) {
        json_text_member(out, "\n    ", "system", machine.sysname);
        json_text_member(out, ",\n    ", "release", machine.release);
        json_text_member(out, ",\n    ", "processor", machine.machine);
        fputc(',', out);
    }
    json_text_member(out, "\n    ", "compiler", COMPILER);
    json_text_member(out, ",\n    ", "flags", CLI_FLAGS);
    json_text_member(out, ",\n    ", "libyaml", yaml_get_version_string());
    fputs("\n  }", out);
}

static void put_state(FILE *out, const run_request *request, const run_position *position,
                      const char *state)
{
    char method[256];
    json_text_member(out, ",\n  ", "method",
                     dal_method_name(&request->method, method, sizeof method));
    json_text_member(out, ",\n  ", "status", state);
    json_number_member(out, ",\n  ", "t", dal_run_time(request->run));
    fprintf(out, ",\n  \"rows\": %lld,\n  \"steps\": %lld,\n  \"evaluations\": %lld", position->row,
            dal_run_steps(request->run), dal_run_evaluations(request->run));
    fprintf(out, ",\n  \"native\": %s", dal_run_is_native(request->run) ? "true" : "false");
    json_number_member(out, ",\n  ", "seconds", position->seconds);
}

int manifest_write(const run_directory *dir, const run_request *request,
                   const run_position *position, const char *state, const char *why)
{
    char *text;
    size_t length;
    FILE *out = cli_memstream_open(&text, &length);
    json_text_member(out, "{\n  ", "dalembert", DAL_VERSION);
    fprintf(out, ",\n  \"input\": %s", dir->input);
    manifest_put_machine(out);
    put_state(out, request, position, state);
    if (why[0]) json_text_member(out, ",\n  ", "message", why);
    fputs("\n}\n", out);
    cli_memstream_close(out);
    const int status = file_replace(dir->manifest, text, length, dir->sync);
    free(text);
    return status;
}

int manifest_has_ended(const char *path)
{
    char *state = json_file_text(path, "status");
    const int over = state && (strcmp(state, "done") == 0 || strcmp(state, "failed") == 0);
    free(state);
    return over;
}
