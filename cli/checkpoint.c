/* checkpoint.c - where a run stands, in a file that outlives any end of the process.
 *
 * Little-endian words of 64 bits, doubles by their bits:
 *
 *     head       the word DALCHK02, the fingerprint of the run, the mark, the counts of what
 * follows memory     [memory] all that the run carries from step to step statistics
 * [statistics][words] of each observable sum        FNV-1a of all before
 *
 * The file is written beside, brought to the disk and renamed, and the one before is kept: where
 * the newer one is damaged the run goes on from the older.  DALCHK01 had the same head and memory
 * and other statistics, in the byte order of its machine; such a run goes on, its statistics begin
 * anew. */
#include "file.h"
#include "store.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct head {
    uint64_t magic, fingerprint;
    int64_t row, offset;
    double seconds;
    uint64_t memory, statistics;
} head;

enum {
    WORD = sizeof(uint64_t),
    HEAD_WORDS = sizeof(head) / WORD,
    WORDS = sizeof(dal_statistics) / WORD, /* each member is one of 64 bits */
};

static const uint64_t magic_1 = UINT64_C(0x31304b48434c4144); /* "DALCHK01" */
static const uint64_t magic_2 = UINT64_C(0x32304b48434c4144); /* "DALCHK02" */

/* ---- saving -------------------------------------------------------------------------------- */

static unsigned char *append(unsigned char *place, const void *words, size_t count)
{
    const unsigned char *from = words;
    for (size_t i = 0; i < count; i++, from += WORD) {
        uint64_t word;
        memcpy(&word, from, sizeof word);
        for (int k = 0; k < WORD; k++) *place++ = (unsigned char)(word >> 8 * k);
    }
    return place;
}

static int keep_the_one_before(const cli_store *store)
{
    if (rename(store->checkpoint, store->before) == 0 || errno == ENOENT) return CLI_DONE;
    return cli_io("write", store->before);
}

int store_save(const cli_store *store, const cli_mark *mark, const dal_run *run,
               const dal_statistics *statistics, int count)
{
    size_t memory_count;
    const double *memory = dal_run_memory(run, &memory_count);
    const head h = {magic_2,       store->fingerprint,     mark->row,      mark->offset,
                    mark->seconds, (uint64_t)memory_count, (uint64_t)count};
    const size_t words = HEAD_WORDS + memory_count + (size_t)count * WORDS;
    unsigned char *text = malloc((words + 1) * WORD);
    if (!text) return cli_fail(CLI_IO, "out of memory");
    unsigned char *place = append(text, &h, HEAD_WORDS);
    place = append(place, memory, memory_count);
    place = append(place, statistics, (size_t)count * WORDS);
    const uint64_t sum = file_hash(FILE_HASH_START, text, words * WORD);
    append(place, &sum, 1);
    int status = file_write(store->fresh, text, (words + 1) * WORD);
    if (status == CLI_DONE) status = keep_the_one_before(store);
    if (status == CLI_DONE) status = file_rename(store->fresh, store->checkpoint);
    free(text);
    return status;
}

/* ---- loading ------------------------------------------------------------------------------- */

/* A checkpoint as it was read. */
typedef struct image {
    const char *path;
    unsigned char *text;
    size_t words; /* but for the sum */
    head head;
} image;

static const unsigned char *take(const unsigned char *place, void *words, size_t count)
{
    unsigned char *to = words;
    for (size_t i = 0; i < count; i++, to += WORD) {
        uint64_t word = 0;
        for (int k = 0; k < WORD; k++) word |= (uint64_t)*place++ << 8 * k;
        memcpy(to, &word, sizeof word);
    }
    return place;
}

static int damaged(const image *m, const char *how)
{
    return cli_fail(CLI_USAGE, "%s: the checkpoint is damaged: %s", m->path, how);
}

static int check_sum(image *m, size_t length)
{
    uint64_t sum;
    m->words = length / WORD - 1;
    if (length % WORD || length < (HEAD_WORDS + 1) * WORD) return damaged(m, "it is too short");
    take(take(m->text, &m->head, HEAD_WORDS) + (m->words - HEAD_WORDS) * WORD, &sum, 1);
    if (m->head.magic != magic_1 && m->head.magic != magic_2)
        return damaged(m, "it does not begin as one");
    if (sum != file_hash(FILE_HASH_START, m->text, m->words * WORD))
        return damaged(m, "its check sum is wrong");
    return CLI_DONE;
}

static int check_sizes(const image *m, int count)
{
    const uint64_t room = m->words - HEAD_WORDS, memory = m->head.memory;
    if (memory > room || m->head.statistics != (uint64_t)count)
        return damaged(m, "its size is wrong");
    if (m->head.magic == magic_2 && room - memory != (uint64_t)count * WORDS)
        return damaged(m, "its size is wrong");
    return CLI_DONE;
}

/* The rows the checkpoint counts on must be there. */
static int check_rows(const cli_store *store, const image *m)
{
    struct stat rows;
    if (stat(store->rows, &rows) == 0 && rows.st_size >= (off_t)m->head.offset) return CLI_DONE;
    return cli_fail(CLI_USAGE, "'%s': shorter than the %lld bytes its checkpoint tells of",
                    store->rows, (long long)m->head.offset);
}

static int read_image(const cli_store *store, const char *path, int count, image *m)
{
    size_t length;
    *m = (image){.path = path};
    m->text = (unsigned char *)file_read(path, &length);
    if (!m->text) return CLI_IO;
    int status = check_sum(m, length);
    if (status == CLI_DONE && m->head.fingerprint != store->fingerprint)
        return cli_fail(CLI_USAGE,
                        "%s: belongs to another run: its description or the system was "
                        "changed",
                        path);
    if (status == CLI_DONE) status = check_sizes(m, count);
    return status == CLI_DONE ? check_rows(store, m) : status;
}

static int put_in_force(const image *m, cli_mark *mark, dal_run *run, dal_statistics *statistics)
{
    dal_error error = {0};
    const size_t count = m->head.memory;
    double *memory = malloc((count + 1) * sizeof *memory);
    if (!memory) return cli_fail(CLI_IO, "out of memory");
    const unsigned char *place = take(m->text + HEAD_WORDS * WORD, memory, count);
    const dal_status loaded = dal_run_load(run, memory, count, &error);
    free(memory);
    if (loaded != DAL_OK) return cli_error(CLI_USAGE, m->path, &error);
    *mark = (cli_mark){m->head.row, m->head.offset, m->head.seconds};
    if (m->head.magic == magic_2)
        take(place, statistics, m->head.statistics * WORDS);
    else
        cli_fail(CLI_DONE, "%s: of an older version: the statistics begin here", m->path);
    return CLI_DONE;
}

static int load(const cli_store *store, const char *path, cli_mark *mark, dal_run *run,
                dal_statistics *statistics, int count)
{
    image m;
    int status = read_image(store, path, count, &m);
    if (status == CLI_DONE) status = put_in_force(&m, mark, run, statistics);
    free(m.text);
    return status;
}

static int is_there(const char *path) { return access(path, F_OK) == 0 || errno != ENOENT; }

int store_load(const cli_store *store, cli_mark *mark, dal_run *run, dal_statistics *statistics,
               int count)
{
    *mark = (cli_mark){0};
    const int newer = is_there(store->checkpoint), older = is_there(store->before);
    if (!newer && !older) return CLI_DONE;
    if (!newer) return load(store, store->before, mark, run, statistics, count);
    const int status = load(store, store->checkpoint, mark, run, statistics, count);
    if (status == CLI_DONE || !older) return status;
    cli_fail(CLI_DONE, "the one before is tried: %s", store->before);
    return load(store, store->before, mark, run, statistics, count);
}
