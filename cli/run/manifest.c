/* manifest.c - manifest.json: the request of a run, what ran it, and how far it is.
 *
 *     "input": {
 *       "system": "chaplygin-sleigh",            or "system.yaml", the copy beside it
 *       "integrator": "gauss8",
 *       "step": 0.01,                            digit for digit as it was given
 *       "time": 1e4,
 *       "set": {"m": 2},
 *       "start": {"e": "inf"}                    JSON has no infinite number
 *     },
 *
 * The text of the input never changes, whatever else is written, unless the run is extended; then
 * the one before is kept as "extends".  Its hash, continued over the text of the system, is in each
 * checkpoint, so that a checkpoint belongs to one request, or to what it extends, alone. */
#include "manifest.h"
#include "dalembert.h"
#include "dalembert_codegen.h"
#include "dalembert_program.h"
#include "request_json.h"
#include "system.h"
#include "ui/memory.h"
#include "ui/message.h"

#include "io/file.h"
#include "io/store.h"

#include <math.h>
#include <stdbool.h>
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

/* The Makefile defines how this program was compiled. */
#ifndef CLI_FLAGS
#define CLI_FLAGS ""
#endif

enum { OLDEST_VERSION = 3000 }; /* 0.3.0 */

static const char copy_name[] = "system.yaml";

/* ---- writing ------------------------------------------------------------------------------- */

void manifest_put_machine(json_writer *w)
{
    struct utsname machine;
    json_open(w, "machine", JSON_LINES);
    if (uname(&machine) == 0) {
        json_put_text(w, "system", machine.sysname);
        json_put_text(w, "release", machine.release);
        json_put_text(w, "processor", machine.machine);
    }
    json_put_text(w, "compiler", COMPILER);
    json_put_text(w, "flags", CLI_FLAGS);
    json_put_text(w, "libyaml", yaml_get_version_string());
    json_close(w);
}

int manifest_write(const run_directory *dir, const run_simulation *s, const run_position *position,
                   store_state state, const char *message)
{
    char method[256];
    store_manifest m;
    const dal_run *run = s->run;
    store_begin_manifest(&m);
    json_put_source(&m.json, "input", dir->input);
    if (dir->earlier) json_put_source(&m.json, "extends", dir->earlier);
    manifest_put_machine(&m.json);
    json_put_text(&m.json, "integrator",
                  dal_method_name(&s->request.method, method, sizeof method));
    json_put_text(&m.json, "status", store_state_words[state]);
    json_put_number(&m.json, "t", dal_run_time(run));
    json_put_integer(&m.json, "rows", position->row);
    json_put_integer(&m.json, "steps", dal_run_steps(run));
    json_put_integer(&m.json, "evaluations", dal_run_evaluations(run));
    json_put_bool(&m.json, "native", dal_run_is_native(run));
    json_put_number(&m.json, "seconds", position->seconds);
    if (message[0]) json_put_text(&m.json, "message", message);
    return store_end_manifest(&m, dir->manifest, dir->sync);
}

int manifest_read_end(const char *path, bool *has_ended)
{
    store_state state;
    const int status = store_read_state(path, &state);
    *has_ended = state == STORE_DONE || state == STORE_FAILED;
    return status;
}

/* ---- the request --------------------------------------------------------------------------- */

char *manifest_input(const run_request *request)
{
    char *text;
    size_t length;
    json_writer w = {.out = cli_memstream_open(&text, &length), .depth = 1, .lines = 1};
    const char *system = request->system_name;
    json_open(&w, NULL, JSON_LINES);
    json_put_text(&w, "system", cli_is_path(system) ? copy_name : system);
    for (int i = 0; i < REQUEST_system; i++) {
        const char *given = request->text[i], *name = request_options[i].name;
        if (i == REQUEST_set || i == REQUEST_start || (!given && i != REQUEST_step)) continue;
        if (!given)
            json_put_number(&w, name, request->options.step); /* which was chosen */
        else if (request_option_is_number(i))
            json_put_given(&w, name, given);
        else
            json_put_text(&w, name, given);
    }
    request_put_settings(&w, "set", &request->set);
    request_put_settings(&w, "start", &request->start);
    json_close(&w);
    cli_memstream_close(w.out);
    return text;
}

/* The text of a built-in system is the library's, of any other the copy's. */
static int find_fingerprint(run_directory *dir, const char *builtin)
{
    if (!builtin && !file_exists(dir->system))
        return cli_fail(CLI_USAGE, "'%s' is missing: the run cannot be continued", dir->system);
    const char *const inputs[] = {dir->input, dir->earlier ? dir->earlier : dir->input};
    uint64_t *const hashes[] = {&dir->fingerprint, &dir->earlier_fingerprint};
    int status = CLI_DONE;
    for (int i = 0; i < 2 && status == CLI_DONE; i++) {
        *hashes[i] = dal__hash(DAL__HASH_START, inputs[i], strlen(inputs[i]));
        status = store_hash_system(hashes[i], builtin, dir->system);
    }
    return status;
}

int manifest_begin(run_directory *dir, const run_simulation *s)
{
    const bool is_path = cli_is_path(s->request.system_name);
    int status = CLI_DONE;
    /* The writer begins the rows again, and the run may be made from the copy of the system. */
    for (int i = 0; i < RUN_FILES && status == CLI_DONE; i++)
        if (dir->file[i] != dir->rows && dir->file[i] != dir->system)
            status = file_remove(dir->file[i]);
    if (status == CLI_DONE)
        status = cli_keep_system(s->request.system_name, s->model, dir->system, dir->sync);
    if (status != CLI_DONE) return status;
    dir->input = manifest_input(&s->request);
    status = find_fingerprint(dir, is_path ? NULL : dal_builtin_text(s->request.system_name));
    const run_position start = {.row = 0};
    return status == CLI_DONE ? manifest_write(dir, s, &start, STORE_RUNNING, "") : status;
}

int manifest_extend(run_directory *dir, const run_simulation *simulation,
                    const run_position *position)
{
    const run_request *request = &simulation->request;
    free(dir->earlier);
    dir->earlier = dir->input;
    dir->input = manifest_input(request);
    const int status = find_fingerprint(dir, dal_builtin_text(request->system_name));
    return status == CLI_DONE ? manifest_write(dir, simulation, position, STORE_RUNNING, "")
                              : status;
}

int manifest_compare(const run_directory *dir, const run_request *held, const run_request *request)
{
    char *one = manifest_input(held), *other = manifest_input(request);
    const bool is_same = strcmp(one, other) == 0;
    free(one);
    free(other);
    if (is_same) return CLI_DONE;
    return cli_fail(CLI_USAGE, "'%s' holds another run: its input differs", dir->path);
}

/* ---- reading ------------------------------------------------------------------------------- */

/* 1002003 for 1.2.3. */
static int version_number(const char *version)
{
    int number[3] = {0};
    sscanf(version, "%d.%d.%d", &number[0], &number[1], &number[2]);
    return (number[0] * 1000 + number[1]) * 1000 + number[2];
}

static int check_version(const document *doc, const yaml_node_t *root)
{
    const yaml_node_t *node = document_value(doc, root, "dalembert");
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
        cli_note("%s: made by dalembert %s; the bits may differ from here on", doc->place, version);
    return CLI_DONE;
}

static int read_settings(request_settings *settings, const document *doc,
                         const document_pair *member)
{
    document_pair pair;
    int status = document_check_mapping(doc, member->value, member->name, "names and values");
    for (int i = 0; status == CLI_DONE && document_get_pair(doc, member->value, i, &pair); i++) {
        const char *text = document_scalar(doc, pair.value, pair.name);
        status = text ? request_parse_setting(settings, pair.name, pair.name, text) : CLI_USAGE;
    }
    return status;
}

static int read_member(run_request *request, const document *doc, const document_pair *member,
                       const char *copy)
{
    const int option = request_find_option(member->name);
    const bool is_system = strcmp(member->name, "system") == 0;
    if (option == REQUEST_set) return read_settings(&request->set, doc, member);
    if (option == REQUEST_start) return read_settings(&request->start, doc, member);
    if (option < 0 && !is_system)
        return document_fail(doc, member->value, "unknown option '%s' of a run", member->name);
    const char *text = document_scalar(doc, member->value, member->name);
    if (!text) return CLI_USAGE;
    if (!is_system) return request_parse_option(request, option, text);
    /* The system of a file is the copy in the directory, wherever the program is started. */
    request->system_name = strcmp(text, copy_name) == 0 ? copy : text;
    return CLI_DONE;
}

int manifest_read_input(run_request *request, const document *doc, const char *copy)
{
    const yaml_node_t *root = document_node(doc, 1), *input = document_value(doc, root, "input");
    if (!input || input->type != YAML_MAPPING_NODE)
        return document_fail(doc, root, "there is no input of a run");
    int status = check_version(doc, root);
    document_pair member;
    for (int i = 0; status == CLI_DONE && document_get_pair(doc, input, i, &member); i++)
        status = read_member(request, doc, &member, copy);
    if (status != CLI_DONE || request->system_name) return status;
    return document_fail(doc, input, "the system is missing");
}

int manifest_read(run_directory *dir, run_request *request)
{
    char *bytes;
    if (!file_exists(dir->manifest))
        return cli_fail(CLI_USAGE, "'%s' holds no run: there is no %s", dir->path, dir->manifest);
    int status = store_read_manifest(dir->manifest, &dir->doc, &bytes);
    if (status == CLI_DONE) status = manifest_read_input(request, dir->doc, dir->system);
    if (status == CLI_DONE)
        dir->input =
            json_source(bytes, document_value(dir->doc, document_node(dir->doc, 1), "input"));
    const yaml_node_t *earlier =
        status == CLI_DONE ? document_value(dir->doc, document_node(dir->doc, 1), "extends") : NULL;
    if (earlier) dir->earlier = json_source(bytes, earlier);
    free(bytes);
    return status == CLI_DONE ? find_fingerprint(dir, dal_builtin_text(request->system_name))
                              : status;
}
