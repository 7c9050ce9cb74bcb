/* manifest.c - manifest.json: the complete input of a run, what ran it, and how far it came. */
#include "file.h"
#include "record.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>

static void put_string(FILE *out, const char *text)
{
    fputc('"', out);
    for (; *text; text++) {
        const unsigned char c = (unsigned char)*text;
        if (c < ' ')
            fprintf(out, "\\u%04x", c);
        else if (c == '"' || c == '\\')
            fprintf(out, "\\%c", c);
        else
            fputc(c, out);
    }
    fputc('"', out);
}

static void put_text(FILE *out, const char *indent, const char *name, const char *text)
{
    fprintf(out, "%s\"%s\": ", indent, name);
    put_string(out, text);
    fputs(",\n", out);
}

/* e may be infinite, which JSON has no number for. */
static void put_settings(FILE *out, const char *name, const job_settings *settings)
{
    fprintf(out, "    \"%s\": {", name);
    for (int i = 0; i < settings->count; i++) {
        if (i) fputs(", ", out);
        put_string(out, settings->item[i].name);
        fputs(": ", out);
        if (isfinite(settings->item[i].value))
            cli_put(out, settings->item[i].value);
        else
            fputs("\"inf\"", out);
    }
    fputc('}', out);
}

static void put_input(FILE *out, const cli_job *job)
{
    cli_option options[JOB_OPTIONS];
    char method[256];
    job_options(options);
    fputs("  \"input\": {\n", out);
    put_text(out, "    ", "system", job->system);
    put_text(out, "    ", "method", dal_method_name(&job->method, method, sizeof method));
    for (int i = 0; i < JOB_OPTIONS; i++)
        if (job->text[i] && i != JOB_set && i != JOB_start)
            put_text(out, "    ", options[i].name, job->text[i]);
    put_settings(out, "set", &job->set);
    fputs(",\n", out);
    put_settings(out, "start", &job->start);
    fputs("\n  },\n", out);
}

static void put_machine(FILE *out)
{
    struct utsname machine;
    fputs("  \"machine\": {\n", out);
    if (uname(&machine) == 0) {
        put_text(out, "    ", "system", machine.sysname);
        put_text(out, "    ", "release", machine.release);
        put_text(out, "    ", "processor", machine.machine);
    }
    fputs("    \"compiler\": ", out);
#ifdef __VERSION__
    put_string(out, __VERSION__);
#else
    fputs("null", out);
#endif
    fputs("\n  },\n", out);
}

static void put_state(FILE *out, const cli_record *r, const char *state)
{
    const dal_run *run = r->job->run;
    put_text(out, "  ", "status", state);
    fputs("  \"t\": ", out);
    cli_put(out, dal_run_time(run));
    fprintf(out, ",\n  \"rows\": %lld,\n  \"steps\": %lld,\n  \"evaluations\": %lld,\n",
            r->mark.row, dal_run_steps(run), dal_run_evaluations(run));
    fprintf(out, "  \"native\": %s,\n  \"seconds\": ", dal_run_is_native(run) ? "true" : "false");
    cli_put(out, r->mark.seconds);
    fputs("\n}\n", out);
}

int manifest_write(const cli_record *r, const char *state)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);
    if (!out) return cli_fail(CLI_IO, "out of memory");
    fputs("{\n", out);
    put_text(out, "  ", "dalembert", DAL_VERSION);
    put_input(out, r->job);
    put_machine(out);
    put_state(out, r, state);
    int status = cli_close(out, r->store->manifest);
    if (status == CLI_DONE) status = file_replace(r->store->manifest, text, length);
    free(text);
    return status;
}
