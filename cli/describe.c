/* describe.c - run.yaml: the options of a run, as they were given, in a form that can be read.
 *
 *     dalembert: 0.1.0
 *     system: chaplygin-sleigh
 *     integrator: gauss8
 *     step: 0.01
 *     time: 1e4
 *     set:
 *       m: 2
 *
 * It is written and read here; of YAML it uses "key: value" lines, one level of indentation and
 * comments. */
#include "file.h"
#include "store.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void put_settings(FILE *out, const char *name, const job_settings *settings)
{
    if (settings->count) fprintf(out, "%s:\n", name);
    for (int i = 0; i < settings->count; i++) {
        fprintf(out, "  %s: ", settings->item[i].name);
        cli_put(out, settings->item[i].value);
        fputc('\n', out);
    }
}

static void put_job(FILE *out, const cli_job *job, const char *system)
{
    cli_option options[JOB_OPTIONS];
    job_options(options);
    fputs("# A run of dalembert; 'dalembert resume' with this directory goes on with it.\n", out);
    fprintf(out, "dalembert: " DAL_VERSION "\nsystem: %s\n", system);
    for (int i = 0; i < JOB_OPTIONS; i++)
        if (job->text[i] && i != JOB_set && i != JOB_start)
            fprintf(out, "%s: %s\n", options[i].name, job->text[i]);
    put_settings(out, options[JOB_set].name, &job->set);
    put_settings(out, options[JOB_start].name, &job->start);
}

/* The text of a system: of a built-in one from the library, of any other from its file. */
static int sign(cli_store *store, const char *description, size_t length, const char *builtin)
{
    uint64_t hash = file_hash(FILE_HASH_START, description, length);
    size_t n = builtin ? strlen(builtin) : 0;
    char *text = builtin ? NULL : file_read(store->system, &n);
    if (!builtin && !text) return CLI_IO;
    store->fingerprint = file_hash(hash, builtin ? builtin : text, n);
    free(text);
    return CLI_DONE;
}

static int copy(const char *from, const char *to)
{
    size_t length;
    char *text = file_read(from, &length);
    if (!text) return CLI_IO;
    int status = file_replace(to, text, length);
    free(text);
    return status;
}

static int clear(const cli_store *store)
{
    int status = file_remove(store->checkpoint);
    if (status == CLI_DONE) status = file_remove(store->before);
    if (status == CLI_DONE) status = file_remove(store->summary);
    return status;
}

int store_describe(cli_store *store, const cli_job *job)
{
    int is_path = cli_is_path(job->system);
    int status = clear(store);
    if (status == CLI_DONE)
        status = is_path ? copy(job->system, store->system) : file_remove(store->system);
    if (status != CLI_DONE) return status;
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);
    if (!out) return cli_fail(CLI_IO, "out of memory");
    put_job(out, job, is_path ? "system.yaml" : job->system);
    status = cli_close(out, store->settings);
    if (status == CLI_DONE)
        status = sign(store, text, length, is_path ? NULL : dal_builtin_text(job->system));
    if (status == CLI_DONE) status = file_replace(store->settings, text, length);
    free(text);
    return status;
}

/* ---- reading ------------------------------------------------------------------------------- */

typedef struct reader {
    cli_store *store;
    cli_job *job;
    int line, section; /* section: JOB_set or JOB_start within one, else -1 */
} reader;

static int fault(const reader *r, const char *what, const char *text)
{
    return cli_fail(CLI_USAGE, "%s:%d: %s '%s'", r->store->settings, r->line, what, text);
}

/* "NAME=VALUE" out of a line of a section; job_take copies it. */
static int take_setting(reader *r, const char *key, const char *value)
{
    size_t n = strlen(key), m = strlen(value);
    char *text = malloc(n + m + 2);
    if (!text) return cli_fail(CLI_IO, "out of memory");
    memcpy(text, key, n);
    text[n] = '=';
    memcpy(text + n + 1, value, m + 1);
    int status = job_take(r->job, r->section, text);
    r->job->text[r->section] = NULL;
    free(text);
    return status;
}

static int take(reader *r, const char *key, const char *value)
{
    int option = job_find(key);
    r->section = -1;
    if (strcmp(key, "system") == 0) {
        /* The copy in the directory is meant, wherever the program was started. */
        r->job->system = strcmp(value, "system.yaml") == 0 ? r->store->system : value;
        return CLI_DONE;
    }
    if (strcmp(key, "dalembert") == 0)
        return strcmp(value, DAL_VERSION) == 0 ? CLI_DONE
                                               : fault(r, "made by another version,", value);
    if (option < 0) return fault(r, "unknown key", key);
    if (option != JOB_set && option != JOB_start) return job_take(r->job, option, value);
    r->section = option;
    return CLI_DONE;
}

static char *trim(char *text)
{
    char *end = text + strlen(text);
    while (end > text && strchr(" \t\r", end[-1])) *--end = '\0';
    return text + strspn(text, " \t");
}

static int read_line(reader *r, char *line)
{
    int inner = line[0] == ' ';
    char *text = trim(line), *colon = strstr(text, ":");
    if (text[0] == '\0' || text[0] == '#') return CLI_DONE;
    if (!colon || (inner && r->section < 0)) return fault(r, "not 'key: value':", text);
    *colon = '\0';
    return inner ? take_setting(r, trim(text), trim(colon + 1))
                 : take(r, trim(text), trim(colon + 1));
}

int store_read(cli_store *store, cli_job *job)
{
    size_t length;
    if (access(store->settings, F_OK) != 0)
        return cli_fail(CLI_USAGE, "'%s' holds no run: there is no %s", store->directory,
                        store->settings);
    store->text = file_read(store->settings, &length);
    if (!store->text) return CLI_IO;
    /* Reading cuts the text into pieces, so what is signed is what was there before. */
    char *whole = malloc(length + 1);
    if (!whole) return cli_fail(CLI_IO, "out of memory");
    memcpy(whole, store->text, length + 1);
    reader r = {store, job, 0, -1};
    int status = CLI_DONE;
    for (char *line = store->text, *next; line && status == CLI_DONE; line = next) {
        next = strchr(line, '\n');
        if (next) *next++ = '\0';
        r.line++;
        status = read_line(&r, line);
    }
    if (status == CLI_DONE && !job->system) status = fault(&r, "missing key", "system");
    if (status == CLI_DONE) status = sign(store, whole, length, dal_builtin_text(job->system));
    free(whole);
    return status;
}
