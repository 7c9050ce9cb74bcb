/* describe.c - the options of a run as they were given: "input" in its manifest.json, the only
 * place where they are kept.
 *
 *     "input": {
 *       "system": "chaplygin-sleigh",            or "system.yaml", the copy beside
 *       "integrator": "gauss8",
 *       "step": 0.01,                            as given: the digits are kept
 *       "time": 1e4,
 *       "set": {"m": 2},
 *       "start": {"e": "inf"}                    the only number that JSON has none for
 *     },
 *
 * Its text is kept as it stands there whatever else is written anew, and with the text of the
 * system it is signed: a checkpoint goes with one description alone. */
#include "io/file.h"
#include "io/json.h"
#include "run_directory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char copy_name[] = "system.yaml";
enum { OLDEST_VERSION = 3000 }; /* 0.3.0 */

/* ---- writing ------------------------------------------------------------------------------- */

/* e may be infinite, which JSON has no number for. */
static void put_settings(FILE *out, const char *name, const request_settings *settings)
{
    fprintf(out, ",\n    \"%s\": {", name);
    for (int i = 0; i < settings->count; i++) {
        const dal_setting *s = &settings->item[i];
        const char *before = i ? ", " : "";
        if (isfinite(s->value))
            json_number_member(out, before, s->name, s->value);
        else
            json_text_member(out, before, s->name, "inf");
    }
    fputc('}', out);
}

/* Allocated. */
static char *describe(const run_request *request)
{
    cli_option options[REQUEST_OPTIONS];
    char *text;
    size_t length;
    FILE *out = cli_memstream_open(&text, &length);
    request_list_options(options);
    fputc('{', out);
    json_text_member(out, "\n    ", "system",
                     cli_is_path(request->system_name) ? copy_name : request->system_name);
    for (int i = 0; i < REQUEST_OPTIONS; i++)
        if (request->text[i] && request_option_is_number(i))
            json_given_member(out, ",\n    ", options[i].name, request->text[i]);
        else if (request->text[i] && i != REQUEST_set && i != REQUEST_start)
            json_text_member(out, ",\n    ", options[i].name, request->text[i]);
    put_settings(out, options[REQUEST_set].name, &request->set);
    put_settings(out, options[REQUEST_start].name, &request->start);
    fputs("\n  }", out);
    cli_memstream_close(out);
    return text;
}

/* The text of a system: of a built-in one from the library, of any other from its file. */
static int sign(run_directory *dir, const char *builtin)
{
    const uint64_t hash = file_hash(FILE_HASH_START, dir->input, strlen(dir->input));
    size_t n = builtin ? strlen(builtin) : 0;
    if (!builtin && access(dir->system, F_OK) != 0)
        return cli_fail(CLI_USAGE, "'%s' is missing: the run cannot be continued", dir->system);
    char *text = builtin ? NULL : file_read(dir->system, &n);
    if (!builtin && !text) return CLI_IO;
    dir->fingerprint = file_hash(hash, builtin ? builtin : text, n);
    free(text);
    return CLI_DONE;
}

static int copy(const run_directory *dir, const char *from)
{
    size_t length;
    char *text = file_read(from, &length);
    if (!text) return CLI_IO;
    int status = file_replace(dir->system, text, length, dir->sync);
    free(text);
    return status;
}

/* All that another run may have left, but for the rows, which the table begins anew, and the copy,
 * which may be what this run is made from. */
static int clear(const run_directory *dir)
{
    int status = CLI_DONE;
#define X(name, file)                                                                              \
    if (status == CLI_DONE && dir->name != dir->rows && dir->name != dir->system)                  \
        status = file_remove(dir->name);
    RUN_FILE_LIST(X)
#undef X
    return status;
}

int run_directory_begin(run_directory *dir, const run_request *request)
{
    const int is_path = cli_is_path(request->system_name);
    int status = clear(dir);
    if (status == CLI_DONE)
        status = is_path ? copy(dir, request->system_name) : file_remove(dir->system);
    if (status != CLI_DONE) return status;
    dir->input = describe(request);
    status = sign(dir, is_path ? NULL : dal_builtin_text(request->system_name));
    const run_position nothing = {.row = 0};
    return status == CLI_DONE ? manifest_write(dir, request, &nothing, "running", "") : status;
}

/* Both are described in the present way, whatever version wrote the directory. */
int run_directory_compare(const run_directory *dir, const run_request *held,
                          const run_request *request)
{
    char *one = describe(held), *other = describe(request);
    int status = CLI_DONE;
    if (strcmp(one, other) != 0)
        status = cli_fail(CLI_USAGE, "'%s' holds another run: its input differs", dir->path);
    free(one);
    free(other);
    return status;
}

/* ---- reading ------------------------------------------------------------------------------- */

static const char *name_of(const document *doc, const yaml_node_pair_t *pair)
{
    return document_scalar(doc, document_node(doc, pair->key), "manifest");
}

/* "NAME=VALUE" out of "set" or "start"; request_parse_option copies it. */
static int take_setting(run_request *request, int option, const char *name, const char *value)
{
    char *given;
    size_t length;
    FILE *out = cli_memstream_open(&given, &length);
    fprintf(out, "%s=%s", name, value);
    cli_memstream_close(out);
    const int status = request_parse_option(request, option, given);
    request->text[option] = NULL;
    free(given);
    return status;
}

static int take_settings(run_request *request, int option, const document *doc,
                         const yaml_node_t *node)
{
    if (node->type != YAML_MAPPING_NODE)
        return document_fail(doc, node, "names and values are wanted");
    const yaml_node_pair_t *pair = node->data.mapping.pairs.start;
    for (; pair < node->data.mapping.pairs.top; pair++) {
        const char *name = name_of(doc, pair);
        const char *value =
            name ? document_scalar(doc, document_node(doc, pair->value), name) : NULL;
        const int status = value ? take_setting(request, option, name, value) : CLI_USAGE;
        if (status != CLI_DONE) return status;
    }
    return CLI_DONE;
}

/* The copy in the directory is meant, wherever the program was started. */
static int take(const run_directory *dir, run_request *request, const char *name,
                const yaml_node_t *node)
{
    const document *doc = dir->doc;
    const int option = request_find_option(name), is_system = strcmp(name, "system") == 0;
    if (option == REQUEST_set || option == REQUEST_start)
        return take_settings(request, option, doc, node);
    if (option < 0 && !is_system)
        return document_fail(doc, node, "unknown option '%s' of a run", name);
    const char *value = document_scalar(doc, node, name);
    if (!value) return CLI_USAGE;
    if (!is_system) return request_parse_option(request, option, value);
    request->system_name = strcmp(value, copy_name) == 0 ? dir->system : value;
    return CLI_DONE;
}

static int take_all(const run_directory *dir, run_request *request, const yaml_node_t *input)
{
    const yaml_node_pair_t *pair = input->data.mapping.pairs.start;
    for (; pair < input->data.mapping.pairs.top; pair++) {
        const char *name = name_of(dir->doc, pair);
        const yaml_node_t *value = document_node(dir->doc, pair->value);
        const int status = name ? take(dir, request, name, value) : CLI_USAGE;
        if (status != CLI_DONE) return status;
    }
    if (request->system_name) return CLI_DONE;
    return document_fail(dir->doc, input, "the system is missing");
}

/* 1002003 for 1.2.3. */
static int version_number(const char *version)
{
    int part[3] = {0};
    sscanf(version, "%d.%d.%d", &part[0], &part[1], &part[2]);
    return (part[0] * 1000 + part[1]) * 1000 + part[2];
}

/* A directory of version 0.3 or later can be resumed, if its checkpoint can be read. */
static int check_version(const document *doc, const yaml_node_t *root)
{
    const yaml_node_t *node = json_find(doc, root, "dalembert");
    const char *version = node ? document_scalar(doc, node, "version") : "0";
    if (!version) return CLI_USAGE;
    const int made = version_number(version), present = version_number(DAL_VERSION);
    if (made > present)
        return document_fail(doc, node, "made by dalembert %s; this is " DAL_VERSION, version);
    if (made < OLDEST_VERSION)
        return document_fail(doc, node ? node : root,
                             "written by dalembert %s, which can resume it; dalembert " DAL_VERSION
                             " resumes what 0.3 or later wrote",
                             version);
    if (made < present)
        cli_fail(CLI_DONE, "%s: made by dalembert %s; the bits may differ from here on", doc->place,
                 version);
    return CLI_DONE;
}

static int read_manifest(run_directory *dir, run_request *request, const char *bytes, size_t length)
{
    dir->doc = cli_calloc(1, sizeof *dir->doc);
    int status = json_parse(dir->doc, dir->manifest, bytes, length);
    if (status != CLI_DONE) return status;
    const yaml_node_t *root = yaml_document_get_root_node(&dir->doc->yaml);
    const yaml_node_t *input = json_find(dir->doc, root, "input");
    if (!input || input->type != YAML_MAPPING_NODE)
        return document_fail(dir->doc, root, "there is no input of a run");
    status = check_version(dir->doc, root);
    if (status != CLI_DONE) return status;
    dir->input = json_source(bytes, input);
    return take_all(dir, request, input);
}

int run_directory_read(run_directory *dir, run_request *request)
{
    size_t length;
    struct stat info;
    if (stat(dir->manifest, &info) != 0)
        return cli_fail(CLI_USAGE, "'%s' holds no run: there is no %s", dir->path, dir->manifest);
    if (S_ISDIR(info.st_mode)) return cli_fail(CLI_USAGE, "'%s' is a directory", dir->manifest);
    char *bytes = file_read(dir->manifest, &length);
    if (!bytes) return CLI_IO;
    int status = read_manifest(dir, request, bytes, length);
    free(bytes);
    return status == CLI_DONE ? sign(dir, dal_builtin_text(request->system_name)) : status;
}
