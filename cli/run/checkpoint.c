/* checkpoint.c - where a run stands, in a file that outlives any end of the process.
 *
 * Little-endian words of 64 bits, doubles by their bits:
 *
 *     head        the word DALCHK03, then as below
 *     memory      [memory] all that the run carries from step to step
 *     statistics  [statistics * words] those of each observable, in a layout that has a number
 *     sum         FNV-1a of all before
 *
 * The file is written beside, brought to the disk and renamed, and the one before is kept: where
 * the newer one is damaged, or the rows are not those it tells of, the run goes on from the older.
 * Nothing in it is ever run or followed.  A later format raises the number and reads this one, too. */
#include "io/endian.h"
#include "io/file.h"
#include "run_directory.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct head {
    uint64_t magic;
    uint64_t fingerprint; /* of the input of the run */
    int64_t row;          /* rows in trajectory.npy, */
    row_sum sum;          /* and their sum */
    double seconds;       /* spent in steps and rows */
    uint64_t memory, statistics, words, layout;
} head;

enum {
    HEAD_WORDS = sizeof(head) / WORD,
    WORDS = sizeof(dal_statistics) / WORD, /* each member is one of 64 bits */
};

static const uint64_t magic = UINT64_C(0x33304b48434c4144); /* "DALCHK03" */

/* ---- saving -------------------------------------------------------------------------------- */

static unsigned char *append(unsigned char *place, const void *words, size_t count)
{
    const unsigned char *from = words;
    for (size_t i = 0; i < count; i++, from += WORD) {
        uint64_t word;
        memcpy(&word, from, sizeof word);
        write_le64(place, word);
        place += WORD;
    }
    return place;
}

static int keep_the_one_before(const run_directory *dir)
{
    if (rename(dir->checkpoint, dir->before) == 0 || errno == ENOENT) return CLI_DONE;
    return cli_io("write", dir->before);
}

int checkpoint_save(const run_directory *dir, const run_position *position, const dal_run *run,
                    const dal_statistics *statistics, int count)
{
    size_t memory_count;
    const double *memory = dal_run_memory(run, &memory_count);
    const head h = {.magic = magic,
                    .fingerprint = dir->fingerprint,
                    .row = position->row,
                    .sum = position->sum,
                    .seconds = position->seconds,
                    .memory = memory_count,
                    .statistics = (uint64_t)count,
                    .words = WORDS,
                    .layout = DAL_STATISTICS_LAYOUT};
    const size_t words = HEAD_WORDS + memory_count + (size_t)count * WORDS;
    unsigned char *text = cli_malloc((words + 1) * WORD);
    unsigned char *place = append(text, &h, HEAD_WORDS);
    place = append(place, memory, memory_count);
    place = append(place, statistics, (size_t)count * WORDS);
    const uint64_t sum = file_hash(FILE_HASH_START, text, words * WORD);
    append(place, &sum, 1);
    cli_hold_exit();
    int status = file_write(dir->fresh, text, (words + 1) * WORD, dir->sync);
    if (status == CLI_DONE) status = keep_the_one_before(dir);
    if (status == CLI_DONE) status = file_rename(dir->fresh, dir->checkpoint, dir->sync);
    if (status != CLI_DONE) unlink(dir->fresh);
    cli_release_exit();
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
        const uint64_t word = read_le64(place);
        memcpy(to, &word, sizeof word);
        place += WORD;
    }
    return place;
}

static int damaged(const image *m, const char *how)
{
    return cli_fail(CLI_USAGE, "%s: the checkpoint is damaged: %s", m->path, how);
}

static int check_bytes(image *m, size_t length)
{
    uint64_t sum;
    m->words = length / WORD - 1;
    if (length % WORD || length < (HEAD_WORDS + 1) * WORD) return damaged(m, "it is too short");
    take(take(m->text, &m->head, HEAD_WORDS) + (m->words - HEAD_WORDS) * WORD, &sum, 1);
    if (m->head.magic != magic) return damaged(m, "it does not begin as one");
    if (sum == file_hash(FILE_HASH_START, m->text, m->words * WORD)) return CLI_DONE;
    return damaged(m, "its check sum is wrong");
}

/* Statistics that begin in the middle of a run would say of its half what the summary says of the
 * whole. */
static int check_layout(const image *m)
{
    if (m->head.layout == DAL_STATISTICS_LAYOUT && m->head.words == WORDS) return CLI_DONE;
    return cli_fail(CLI_USAGE,
                    "%s: its statistics have layout %llu; dalembert " DAL_VERSION
                    " reads layout %d alone: resume with the version that manifest.json names",
                    m->path, (unsigned long long)m->head.layout, DAL_STATISTICS_LAYOUT);
}

static int check_sizes(const image *m, int count)
{
    const head *h = &m->head;
    const uint64_t room = m->words - HEAD_WORDS, most = UINT64_C(1) << 32;
    if (h->row >= 0 && h->memory <= room && h->words < most && h->statistics == (uint64_t)count &&
        room - h->memory == h->statistics * h->words)
        return CLI_DONE;
    return damaged(m, "its size is wrong");
}

static int read_image(const run_directory *dir, const trajectory_writer *writer, int count,
                      image *m)
{
    size_t length;
    m->text = (unsigned char *)file_read(m->path, &length);
    if (!m->text) return CLI_IO;
    int status = check_bytes(m, length);
    if (status == CLI_DONE && m->head.fingerprint != dir->fingerprint)
        return cli_fail(CLI_USAGE,
                        "%s: belongs to another run: its description or the system was "
                        "changed",
                        m->path);
    if (status == CLI_DONE) status = check_sizes(m, count);
    if (status == CLI_DONE) status = check_layout(m);
    return status == CLI_DONE ? writer_verify(writer, m->head.row, &m->head.sum) : status;
}

static int put_in_force(const image *m, run_position *position, dal_run *run,
                        dal_statistics *statistics)
{
    dal_error error = {0};
    const size_t count = m->head.memory;
    double *memory = cli_malloc((count + 1) * sizeof *memory);
    const unsigned char *place = take(m->text + HEAD_WORDS * WORD, memory, count);
    const dal_status loaded = dal_run_load(run, memory, count, &error);
    free(memory);
    if (loaded != DAL_OK) return cli_error(CLI_USAGE, m->path, &error);
    *position = (run_position){m->head.row, m->head.sum, m->head.seconds};
    take(place, statistics, m->head.statistics * WORDS);
    return CLI_DONE;
}

static int load(const run_directory *dir, const char *path, const trajectory_writer *writer,
                run_position *position, dal_run *run, dal_statistics *statistics, int count)
{
    image m = {.path = path};
    int status = read_image(dir, writer, count, &m);
    if (status == CLI_DONE) status = put_in_force(&m, position, run, statistics);
    free(m.text);
    return status;
}

static int is_there(const char *path) { return access(path, F_OK) == 0 || errno != ENOENT; }

int checkpoint_load(const run_directory *dir, const trajectory_writer *writer,
                    run_position *position, dal_run *run, dal_statistics *statistics, int count)
{
    *position = (run_position){0};
    const int newer = is_there(dir->checkpoint), older = is_there(dir->before);
    if (!newer && !older) return CLI_DONE;
    if (!newer) return load(dir, dir->before, writer, position, run, statistics, count);
    const int status = load(dir, dir->checkpoint, writer, position, run, statistics, count);
    if (status == CLI_DONE || !older) return status;
    cli_fail(CLI_DONE, "the one before is tried: %s", dir->before);
    return load(dir, dir->before, writer, position, run, statistics, count);
}
