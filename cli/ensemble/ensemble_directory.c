/* ensemble_directory.c - an ensemble in a directory: begun, read, marked. */
#include "ensemble_directory.h"
#include "dalembert_program.h"
#include "io/endian.h"
#include "io/file.h"
#include "io/file_output.h"
#include "io/json.h"
#include "run/manifest.h"
#include "run/system.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void ensemble_directory_open(ensemble_directory *dir, const char *path)
{
    *dir = (ensemble_directory){.path = path, .descriptor = -1};
    dir->members.descriptor = dir->final.descriptor = dir->rows.descriptor = -1;
    STORE_MAKE_PATHS(dir, ENSEMBLE_FILE_LIST);
}

static void detach(ensemble_directory *dir)
{
    npy_table_close(&dir->members);
    npy_table_close(&dir->final);
    npy_table_close(&dir->rows);
    store_close_marks(&dir->marks);
}

static void unlock(ensemble_directory *dir)
{
    if (dir->descriptor >= 0) close(dir->descriptor);
    dir->descriptor = -1;
}

void ensemble_directory_close(ensemble_directory *dir)
{
    detach(dir);
    unlock(dir);
    store_free_paths(dir->file, ENSEMBLE_FILES);
    store_free_manifest(dir->doc);
    *dir = (ensemble_directory){.descriptor = -1};
}

int ensemble_member_columns(const ensemble *e) { return MEMBER_DRAWN + e->variations; }

double *ensemble_allocate_rows(const ensemble *e)
{
    const int columns = ensemble_member_columns(e);
    return cli_calloc(ENSEMBLE_CHUNK * (size_t)(columns > e->columns ? columns : e->columns),
                      sizeof(double));
}

/* ---- the manifest -------------------------------------------------------------------------- */

/* What an ensemble adds to the request of a run, as a member of the manifest. */
static void put_ensemble(json_writer *w, const ensemble *e)
{
    json_open(w, "ensemble", JSON_LINES);
    json_put_integer(w, "members", e->members);
    json_put_integer(w, "seed", e->seed);
    json_open_list(w, "vary", JSON_ON_ONE_LINE);
    for (int i = 0; i < e->variations; i++) json_put_text(w, NULL, e->vary_text[i]);
    json_close(w);
    json_put_numbers(w, "quantiles", e->quantile, e->quantiles);
    json_put_text(w, "axes", e->axes);
    json_close(w);
}

int ensemble_directory_write_manifest(const ensemble_directory *dir, const ensemble *e,
                                      store_state state)
{
    char method[256], *input = manifest_input(&e->simulation.request);
    store_manifest m;
    store_begin_manifest(&m);
    json_put_source(&m.json, "input", input);
    put_ensemble(&m.json, e);
    manifest_put_machine(&m.json);
    json_put_text(&m.json, "integrator",
                  dal_method_name(&e->simulation.request.method, method, sizeof method));
    json_put_text(&m.json, "status", store_state_words[state]);
    free(input);
    return store_end_manifest(&m, dir->manifest, FILE_SYNCED);
}

int ensemble_directory_find(const char *path, bool *is_there)
{
    char *manifest = cli_join(path, "manifest.json");
    const int status = json_file_find(manifest, "ensemble", is_there);
    free(manifest);
    return status;
}

static int read_vary(void *user, const document *doc, yaml_node_t *value, const document_key *key)
{
    int status = CLI_DONE;
    for (int i = 0; i < document_count(value) && status == CLI_DONE; i++) {
        const char *text = document_scalar(doc, document_item(doc, value, i), key->name);
        status = text ? ensemble_parse_vary(user, NULL, text) : CLI_USAGE;
    }
    return status;
}

static int read_quantiles(void *user, const document *doc, yaml_node_t *value,
                          const document_key *key)
{
    ensemble *e = user;
    int status = CLI_DONE;
    const int count = document_count(value);
    if (count > ENSEMBLE_QUANTILES) return document_fail(doc, value, "too many quantiles");
    for (e->quantiles = 0; e->quantiles < count && status == CLI_DONE; e->quantiles++) {
        const yaml_node_t *item = document_item(doc, value, e->quantiles);
        double *p = &e->quantile[e->quantiles];
        status = document_number(doc, item, key->name, p);
        if (status == CLI_DONE && !(*p >= 0.0 && *p <= 1.0))
            status = document_fail(doc, item, "quantiles: %g is not from 0 to 1", *p);
    }
    return status;
}

static int read_integer(void *user, const document *doc, yaml_node_t *value,
                        const document_key *key)
{
    double x;
    const int status = document_number(doc, value, key->name, &x);
    if (status != CLI_DONE) return status;
    if (!(x >= 0.0 && x <= 0x1p53))
        return document_fail(doc, value, "%s: %g is out of range", key->name, x);
    *(long long *)(void *)((char *)user + key->offset) = (long long)x;
    return CLI_DONE;
}

static int read_axes(void *user, const document *doc, yaml_node_t *value, const document_key *key)
{
    ensemble *e = user;
    const char *text = document_scalar(doc, value, key->name);
    e->axes = text && strcmp(text, "null") != 0 ? text : NULL;
    return text ? CLI_DONE : CLI_USAGE;
}

static const document_key keys[] = {{"members", read_integer, offsetof(ensemble, members)},
                                    {"seed", read_integer, offsetof(ensemble, seed)},
                                    {"vary", read_vary, 0},
                                    {"quantiles", read_quantiles, 0},
                                    {"axes", read_axes, 0}};

int ensemble_directory_read_request(ensemble_directory *dir, ensemble *e)
{
    char *bytes;
    int status = store_read_manifest(dir->manifest, &dir->doc, &bytes);
    free(bytes);
    if (status != CLI_DONE) return status;
    const document *doc = dir->doc;
    const yaml_node_t *node = document_value(doc, document_node(doc, 1), "ensemble");
    if (!node) return cli_fail(CLI_USAGE, "'%s' holds no ensemble", dir->path);
    status = manifest_read_input(&e->simulation.request, doc, dir->system);
    if (status == CLI_DONE)
        status = document_read_mapping(doc, node, "ensemble", keys, sizeof keys / sizeof *keys, e);
    if (status == CLI_DONE && !(e->members >= 1 && e->members <= ENSEMBLE_MAX_MEMBERS))
        status = document_fail(doc, node, "%lld members", e->members);
    return status;
}

int ensemble_directory_read(ensemble_directory *dir, ensemble *e)
{
    const int status = ensemble_directory_read_request(dir, e);
    return status == CLI_DONE ? ensemble_complete(e) : status;
}

/* Of what the members depend on: request, variations, system. */
static int find_fingerprint(ensemble_directory *dir, const ensemble *e)
{
    char *input = manifest_input(&e->simulation.request);
    const int64_t counts[] = {e->members, e->seed};
    uint64_t hash = dal__hash(DAL__HASH_START, input, strlen(input));
    hash = dal__hash(hash, counts, sizeof counts);
    for (int i = 0; i < e->variations; i++)
        hash = dal__hash(hash, e->vary_text[i], strlen(e->vary_text[i]) + 1);
    free(input);
    dir->marks.fingerprint = hash;
    return store_hash_system(&dir->marks.fingerprint,
                             dal_builtin_text(e->simulation.request.system_name), dir->system);
}

/* ---- messages ------------------------------------------------------------------------------ */

int ensemble_directory_write_messages(const ensemble_directory *dir, int chunk, const char *text)
{
    char *path = cli_format("%s/%d", dir->messages, chunk);
    int status = file_make_directory(dir->messages);
    if (status == CLI_DONE) status = file_replace(path, text, strlen(text), FILE_SYNCED);
    free(path);
    return status;
}

int ensemble_directory_read_messages(const ensemble_directory *dir, int chunk, char **text)
{
    size_t length;
    char *path = cli_format("%s/%d", dir->messages, chunk);
    const bool is_there = file_exists(path);
    *text = is_there ? file_read(path, &length) : NULL;
    free(path);
    return is_there && !*text ? CLI_IO : CLI_DONE;
}

/* ---- marks --------------------------------------------------------------------------------- */

static const store_shard_file marks_file = {"chunks", "chunks", ""};

int ensemble_directory_shards(const ensemble_directory *dir, store_shard **shards, int *count)
{
    return store_find_shards(dir->path, marks_file, shards, count);
}

static int sync_tables(const ensemble_directory *dir)
{
    int status = npy_table_sync(&dir->members);
    if (status == CLI_DONE) status = npy_table_sync(&dir->final);
    if (status == CLI_DONE && dir->has_rows) status = npy_table_sync(&dir->rows);
    return status;
}

int ensemble_directory_save(const ensemble_directory *dir)
{
    const int status = sync_tables(dir);
    return status == CLI_DONE ? store_save_marks(&dir->marks) : status;
}

int ensemble_directory_lock(ensemble_directory *dir)
{
    return dir->descriptor < 0 ? store_wait(dir->path, &dir->descriptor) : CLI_DONE;
}

/* ---- tables -------------------------------------------------------------------------------- */

/* The tables; a larger ensemble has others beside them until they replace them. */
enum { TABLES = 3 };
static const char *const table_names[TABLES] = {"members.npy", "final.npy", "rows.npy"};
static const char grown[] = "%s/%s.grown";

static const char in_place[] = "%s/%s";

static int open_tables(ensemble_directory *dir, const ensemble *e, npy_state state,
                       const char *place)
{
    char *path[TABLES];
    const int columns = ensemble_member_columns(e);
    char **names = cli_calloc((size_t)columns, sizeof *names);
    char first[MEMBER_DRAWN][8] = {"status", "t"};
    for (int i = 0; i < columns; i++)
        names[i] = i < MEMBER_DRAWN ? first[i] : e->vary[i - MEMBER_DRAWN].name;
    for (int i = 0; i < TABLES; i++) path[i] = cli_format(place, dir->path, table_names[i]);
    dir->has_rows = e->simulation.request.times > 0;
    dir->member_count = e->members;
    int status = npy_table_open(&dir->members, path[0], names, columns, 0, e->members, state);
    free(names);
    if (status == CLI_DONE)
        status = npy_table_open(&dir->final, path[1], e->column, e->columns, 0, e->members, state);
    else
        free(path[1]);
    if (status == CLI_DONE && dir->has_rows)
        status =
            npy_table_open(&dir->rows, path[2], e->column, e->columns, e->times, e->members, state);
    else
        free(path[2]);
    return status;
}

/* Whether the grown chunks belong to the manifest. */
static int is_committed(const ensemble_directory *dir, const char *chunks, bool *committed)
{
    size_t length;
    *committed = false;
    if (!file_exists(chunks)) return CLI_DONE;
    char *bytes = file_read(chunks, &length);
    if (!bytes) return CLI_IO;
    *committed = length >= WORD && read_le64((unsigned char *)bytes) == dir->marks.fingerprint;
    free(bytes);
    return CLI_DONE;
}

int ensemble_directory_attach(ensemble_directory *dir, const ensemble *e, store_shard shard)
{
    detach(dir);
    dir->marks = (store_marks){.what = "ensemble",
                               .directory = dir->path,
                               .file = marks_file,
                               .shard = shard,
                               .count = ensemble_chunks(e)};
    bool is_growing = false;
    char *chunks = cli_format(grown, dir->path, marks_file.whole);
    int status = find_fingerprint(dir, e);
    if (status == CLI_DONE) status = is_committed(dir, chunks, &is_growing);
    free(chunks);
    if (is_growing)
        return cli_fail(CLI_USAGE, "'%s' is not whole: 'dalembert resume %s' continues it",
                        dir->path, dir->path);
    if (status == CLI_DONE) status = open_tables(dir, e, NPY_EXISTING, in_place);
    return status == CLI_DONE ? store_open_marks(&dir->marks) : status;
}

static int copy_rows(const npy_table *from, const npy_table *to, const long long first[2],
                     int count, double *rows)
{
    const int status = npy_table_read(from, first[0], count, rows);
    return status == CLI_DONE ? npy_table_write(to, first[1], count, rows) : status;
}

int ensemble_directory_copy_chunk(const ensemble_directory *from, const ensemble_directory *to,
                                  const ensemble *e, int chunk, double *rows)
{
    const long long start = (long long)chunk * ENSEMBLE_CHUNK, first[2] = {start, start};
    const int count = ensemble_chunk_members(e, chunk);
    int status = copy_rows(&from->members, &to->members, first, count, rows);
    if (status == CLI_DONE) status = copy_rows(&from->final, &to->final, first, count, rows);
    for (int t = 0; to->has_rows && t < e->times && status == CLI_DONE; t++) {
        const long long row[2] = {t * from->member_count + start, t * to->member_count + start};
        status = copy_rows(&from->rows, &to->rows, row, count, rows);
    }
    char *messages = NULL;
    if (status == CLI_DONE) status = ensemble_directory_read_messages(from, chunk, &messages);
    if (status == CLI_DONE && messages)
        status = ensemble_directory_write_messages(to, chunk, messages);
    free(messages);
    return status;
}

/* ---- growth -------------------------------------------------------------------------------- */

/* While there is a file of grown chunks with the fingerprint of the manifest, other grown files
 * replace the files of the smaller ensemble; with another one, the manifest was not yet written. */
int ensemble_directory_begin_growth(ensemble_directory *dir, const ensemble *e)
{
    char *chunks = cli_format(grown, dir->path, marks_file.whole);
    int status = file_remove(chunks);
    free(chunks);
    if (status == CLI_DONE) status = find_fingerprint(dir, e);
    return status == CLI_DONE ? open_tables(dir, e, NPY_NEW, grown) : status;
}

int ensemble_directory_commit_growth(ensemble_directory *dir, const ensemble *e,
                                     const unsigned char *done)
{
    const size_t count = (size_t)ensemble_chunks(e);
    char *path = cli_format(grown, dir->path, marks_file.whole);
    unsigned char *bytes = cli_malloc(WORD + count);
    write_le64(bytes, dir->marks.fingerprint);
    memcpy(bytes + WORD, done, count);
    int status = sync_tables(dir);
    if (status == CLI_DONE) status = file_replace(path, bytes, WORD + count, FILE_SYNCED);
    if (status == CLI_DONE) status = ensemble_directory_write_manifest(dir, e, STORE_RUNNING);
    free(bytes);
    free(path);
    return status;
}

static int replace_tables(const ensemble_directory *dir)
{
    int status = CLI_DONE;
    for (int i = 0; i < TABLES && status == CLI_DONE; i++) {
        char *from = cli_format(grown, dir->path, table_names[i]);
        char *to = cli_format(in_place, dir->path, table_names[i]);
        if (file_exists(from)) status = file_rename(from, to, FILE_SYNCED);
        free(from);
        free(to);
    }
    for (int i = 1; i < ENSEMBLE_RESULTS && status == CLI_DONE; i++) /* 0 is the manifest */
        status = file_remove(dir->file[i]);
    return status == CLI_DONE ? store_remove_shards(dir->path, marks_file) : status;
}

static int remove_grown(const ensemble_directory *dir)
{
    char *chunks = cli_format(grown, dir->path, marks_file.whole);
    int status = file_remove(chunks);
    free(chunks);
    for (int i = 0; i < TABLES && status == CLI_DONE; i++) {
        char *path = cli_format(grown, dir->path, table_names[i]);
        status = file_remove(path);
        free(path);
    }
    return status;
}

int ensemble_directory_end_growth(ensemble_directory *dir, const ensemble *e)
{
    bool committed;
    char *chunks = cli_format(grown, dir->path, marks_file.whole);
    char *marks = cli_format(in_place, dir->path, marks_file.whole);
    int status = find_fingerprint(dir, e);
    if (status == CLI_DONE) status = is_committed(dir, chunks, &committed);
    if (status == CLI_DONE && committed) status = replace_tables(dir);
    if (status == CLI_DONE)
        status = committed ? file_rename(chunks, marks, FILE_SYNCED) : remove_grown(dir);
    free(chunks);
    free(marks);
    return status;
}

/* ---- beginning ----------------------------------------------------------------------------- */

/* The manifest is written last, when all else is there. */
static int begin_new(ensemble_directory *dir, const ensemble *e)
{
    int status = CLI_DONE;
    char *rows = cli_join(dir->path, "rows.npy");
    for (int i = 0; i < ENSEMBLE_RESULTS && status == CLI_DONE; i++)
        status = file_remove(dir->file[i]);
    if (status == CLI_DONE) status = file_remove(rows);
    if (status == CLI_DONE) status = remove_grown(dir);
    free(rows);
    if (status == CLI_DONE)
        status = cli_keep_system(e->simulation.request.system_name, e->simulation.model,
                                 dir->system, FILE_SYNCED);
    if (status == CLI_DONE) status = open_tables(dir, e, NPY_NEW, in_place);
    detach(dir);
    return status == CLI_DONE ? ensemble_directory_write_manifest(dir, e, STORE_RUNNING) : status;
}

/* A shard joins an ensemble that is there; that it is the same one, its marks show. */
static int begin_or_join(ensemble_directory *dir, const ensemble *e, store_shard shard, bool force)
{
    bool is_there;
    int status = ensemble_directory_find(dir->path, &is_there);
    if (status != CLI_DONE) return status;
    if (!is_there && file_exists(dir->manifest))
        return cli_fail(CLI_USAGE, "'%s' holds something else: '%s' is not of an ensemble",
                        dir->path, dir->manifest);
    if (is_there && shard.count > 0 && !force) return CLI_DONE;
    if (is_there && !force)
        return cli_fail(CLI_USAGE,
                        "'%s' holds an ensemble: 'dalembert resume %s' continues it, --force "
                        "overwrites it",
                        dir->path, dir->path);
    if (is_there) status = store_remove_shards(dir->path, marks_file);
    if (status == CLI_DONE && is_there) status = store_remove(dir->messages, 1);
    return status == CLI_DONE ? begin_new(dir, e) : status;
}

int ensemble_directory_begin(ensemble_directory *dir, const ensemble *e, store_shard shard,
                             bool force)
{
    int status = store_begin(dir->path, force, &dir->descriptor);
    if (status == CLI_DONE) status = begin_or_join(dir, e, shard, force);
    if (status == CLI_DONE) status = ensemble_directory_attach(dir, e, shard);
    unlock(dir);
    return status;
}
