/* store.c - what the directories of runs, studies and ensembles have in common. */
#include "store.h"
#include "dalembert.h"
#include "dalembert_program.h"
#include "endian.h"
#include "file.h"
#include "file_output.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- files --------------------------------------------------------------------------------- */

void store_make_paths(const char *directory, const char *const *names, char **file, int count)
{
    for (int i = 0; i < count; i++) file[i] = cli_join(directory, names[i]);
}

void store_free_paths(char **file, int count)
{
    for (int i = 0; i < count; i++) free(file[i]);
}

int store_remove(const char *path, int depth)
{
    struct stat info;
    if (lstat(path, &info) != 0) return errno == ENOENT ? CLI_DONE : cli_io("remove", path);
    if (!S_ISDIR(info.st_mode) || depth == 0) return file_remove(path);
    DIR *directory = opendir(path);
    if (!directory) return cli_io("remove", path);
    int status = CLI_DONE;
    for (struct dirent *entry; status == CLI_DONE && (entry = readdir(directory));) {
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0) continue;
        char *inner = cli_join(path, entry->d_name);
        status = store_remove(inner, depth - 1);
        free(inner);
    }
    closedir(directory);
    if (status != CLI_DONE) return status;
    return rmdir(path) == 0 ? CLI_DONE : cli_io("remove", path);
}

/* ---- locks --------------------------------------------------------------------------------- */

/* Some network file systems have no locks. */
static bool lock_file(int descriptor, int command)
{
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    int result;
    do result = fcntl(descriptor, command, &whole);
    while (result != 0 && errno == EINTR);
    return result == 0 || (errno != EACCES && errno != EAGAIN);
}

int store_lock(int descriptor, const char *path)
{
    if (lock_file(descriptor, F_SETLK)) return CLI_DONE;
    return cli_fail(CLI_USAGE, "'%s': another process is writing to it", path);
}

int store_wait(const char *directory, int *descriptor)
{
    char *path = cli_join(directory, "lock");
    *descriptor = open(path, O_RDWR | O_CREAT, 0666);
    const int status = *descriptor < 0 ? cli_io("write", path) : CLI_DONE;
    if (status == CLI_DONE) lock_file(*descriptor, F_SETLKW);
    free(path);
    return status;
}

int store_begin(const char *directory, bool force, int *descriptor)
{
    int status = force ? CLI_DONE : file_check_directory(directory);
    if (status == CLI_DONE) status = file_make_directory(directory);
    return status == CLI_DONE ? store_wait(directory, descriptor) : status;
}

/* ---- shards -------------------------------------------------------------------------------- */

enum { MAX_SHARDS = 1000000 };

bool store_shard_has(store_shard shard, int item)
{
    return shard.count <= 0 || item % shard.count == shard.number - 1;
}

static bool is_shard(store_shard shard) { return shard.number >= 1 && shard.number <= shard.count; }

int store_parse_shard(void *settings, const cli_option *option, const char *text)
{
    store_shard *shard = (store_shard *)(void *)((char *)settings + option->offset);
    int end = 0;
    if (sscanf(text, "%lld/%lld%n", &shard->number, &shard->count, &end) != 2 || text[end])
        return cli_fail(CLI_USAGE, "--%s: '%s' is not K/N", option->name, text);
    if (is_shard(*shard) && shard->count <= MAX_SHARDS) return CLI_DONE;
    return cli_fail(CLI_USAGE, "--%s: '%s' is not K/N with 1 <= K <= N <= %d", option->name, text,
                    MAX_SHARDS);
}

char *store_shard_path(const char *directory, store_shard_file file, store_shard shard)
{
    if (shard.count == 0) return cli_join(directory, file.whole);
    return cli_format("%s/%s-%lld-of-%lld%s", directory, file.stem, shard.number, shard.count,
                      file.ending);
}

/* Whether a file has the name of a shard's. */
static bool read_name(const char *name, store_shard_file file, store_shard *shard)
{
    const size_t stem = strlen(file.stem);
    int end = 0;
    *shard = (store_shard){0, 0};
    if (strcmp(name, file.whole) == 0) return true;
    if (strncmp(name, file.stem, stem) != 0) return false;
    sscanf(name + stem, "-%lld-of-%lld%n", &shard->number, &shard->count, &end);
    return end > 0 && strcmp(name + stem + end, file.ending) == 0 && is_shard(*shard);
}

int store_find_shards(const char *path, store_shard_file file, store_shard **shards, int *count)
{
    DIR *directory = opendir(path);
    store_shard shard;
    *shards = NULL;
    *count = 0;
    if (!directory) return cli_io("read", path);
    for (struct dirent *entry; (entry = readdir(directory));) {
        if (!read_name(entry->d_name, file, &shard)) continue;
        *shards = cli_realloc(*shards, ((size_t)*count + 1) * sizeof **shards);
        (*shards)[(*count)++] = shard;
    }
    closedir(directory);
    return CLI_DONE;
}

int store_remove_shards(const char *directory, store_shard_file file)
{
    store_shard *shards;
    int count, status = store_find_shards(directory, file, &shards, &count);
    for (int i = 0; i < count && status == CLI_DONE; i++) {
        char *path = store_shard_path(directory, file, shards[i]);
        status = file_remove(path);
        free(path);
    }
    free(shards);
    return status;
}

/* ---- marks --------------------------------------------------------------------------------- */

/* Adds the items that one shard has done. */
static int read_marks(store_marks *m, store_shard shard)
{
    size_t length;
    char *path = store_shard_path(m->directory, m->file, shard), *bytes = file_read(path, &length);
    int status = bytes ? CLI_DONE : CLI_IO;
    /* A process that was killed before it wrote the word has done nothing. */
    const bool is_new = bytes && length < WORD;
    if (bytes && !is_new &&
        (length != WORD + (size_t)m->count || read_le64((unsigned char *)bytes) != m->fingerprint))
        status = cli_fail(CLI_USAGE, "'%s' belongs to another %s", path, m->what);
    for (int i = 0; status == CLI_DONE && !is_new && i < m->count; i++)
        m->done[i] |= bytes[WORD + i] == 1;
    free(bytes);
    free(path);
    return status;
}

int store_update_marks(store_marks *m, bool *is_complete)
{
    store_shard *shards;
    int count, status = store_find_shards(m->directory, m->file, &shards, &count);
    for (int i = 0; i < count && status == CLI_DONE; i++) status = read_marks(m, shards[i]);
    *is_complete = status == CLI_DONE;
    for (int i = 0; i < m->count; i++) *is_complete &= m->done[i] == 1;
    free(shards);
    return status;
}

int store_open_marks(store_marks *m)
{
    bool is_complete;
    m->done = cli_calloc((size_t)m->count, 1);
    if (m->shard.count < 0) return store_update_marks(m, &is_complete);
    m->path = store_shard_path(m->directory, m->file, m->shard);
    m->descriptor = open(m->path, O_RDWR | O_CREAT, 0666);
    if (m->descriptor < 0) return cli_io("write", m->path);
    /* Reading the file would lose the lock. */
    const int status = store_update_marks(m, &is_complete);
    return status == CLI_DONE ? store_lock(m->descriptor, m->path) : status;
}

int store_save_marks(const store_marks *m)
{
    const size_t length = WORD + (size_t)m->count;
    unsigned char *bytes = cli_malloc(length);
    write_le64(bytes, m->fingerprint);
    memcpy(bytes + WORD, m->done, length - WORD);
    const size_t written = file_transfer(m->descriptor, bytes, length, 0, FILE_WRITE);
    free(bytes);
    return written == length ? CLI_DONE : cli_io("write", m->path);
}

void store_close_marks(store_marks *m)
{
    if (m->path && m->descriptor >= 0) close(m->descriptor);
    free(m->path);
    free(m->done);
    *m = (store_marks){0};
}

/* ---- manifests ----------------------------------------------------------------------------- */

void store_begin_manifest(store_manifest *manifest)
{
    manifest->json = (json_writer){.out = cli_memstream_open(&manifest->text, &manifest->length)};
    json_open(&manifest->json, NULL, JSON_LINES);
    json_put_text(&manifest->json, "dalembert", DAL_VERSION);
}

int store_end_manifest(store_manifest *manifest, const char *path, file_sync sync)
{
    json_end_results(&manifest->json);
    cli_memstream_close(manifest->json.out);
    const int status = file_replace(path, manifest->text, manifest->length, sync);
    free(manifest->text);
    return status;
}

int store_read_manifest(const char *path, document **manifest, char **bytes)
{
    size_t length;
    struct stat info;
    *manifest = cli_calloc(1, sizeof **manifest);
    *bytes = NULL;
    if (stat(path, &info) == 0 && S_ISDIR(info.st_mode))
        return cli_fail(CLI_USAGE, "'%s' is a directory", path);
    *bytes = file_read(path, &length);
    return *bytes ? json_parse(*manifest, path, *bytes, length) : CLI_IO;
}

void store_free_manifest(document *manifest)
{
    if (manifest) yaml_document_delete(&manifest->yaml);
    free(manifest);
}

int store_hash_system(uint64_t *hash, const char *builtin, const char *copy)
{
    size_t length = builtin ? strlen(builtin) : 0;
    char *bytes = builtin ? NULL : file_read(copy, &length);
    if (!builtin && !bytes) return CLI_IO;
    *hash = dal__hash(*hash, builtin ? builtin : bytes, length);
    free(bytes);
    return CLI_DONE;
}

/* ---- states -------------------------------------------------------------------------------- */

const char *const store_state_words[STORE_STATES] = {
#define STORE_WORD(code, word) word,
    STORE_STATE_LIST(STORE_WORD)
#undef STORE_WORD
};

store_state store_end_state(int exit_status)
{
    return exit_status == CLI_DONE     ? STORE_DONE
           : exit_status == CLI_CHECK  ? STORE_UNMET
           : exit_status == CLI_SIGNAL ? STORE_INTERRUPTED
                                       : STORE_FAILED;
}

static store_state find_state(const char *word)
{
    int i = word ? 0 : STORE_STATES;
    while (i < STORE_STATES && strcmp(word, store_state_words[i]) != 0) i++;
    return (store_state)i;
}

store_state store_stated(const document *manifest, const char **message)
{
    *message = json_text(manifest, "message");
    return find_state(json_text(manifest, "status"));
}

int store_read_state(const char *path, store_state *state)
{
    char *word;
    const int status = json_file_text(path, "status", &word);
    *state = find_state(word);
    free(word);
    return status;
}

int store_interrupt(const char *directory)
{
    return cli_fail(CLI_SIGNAL, "interrupted; resume with: dalembert resume %s", directory);
}
