/* checkpoint.c - the state of a run in a file that outlives any end of the process.
 *
 * Little-endian words of 64 bits, doubles by their bits:
 *
 *     header      the word DALCHK05, then as in the struct below
 *     state       [state] all that the run carries from step to step, and its parameters
 *     statistics  [statistics * words] of each observable, in a layout that has a number
 *     record      of the steps of a run with many more of them than rows: see step_record.h
 *     sum         FNV-1a of all before
 *
 * The file is written under another name, brought to the disk and renamed, and the previous one is
 * kept: where the newer one is damaged, or the rows are not those it was written with, the run
 * resumes from the older.  Nothing in it is ever executed or followed.  A later format raises the
 * number and reads this one, too.  In DALCHK04 the state has no numbers of the choice of a solver,
 * which are before the last one and the parameters; in DALCHK03 it ends before them.  For systems
 * with events or compared pivots both are refused: what they have of these differs.  Statistics of
 * layout 3 have no root mean squares: earlier_statistics.c completes them. */
#include "checkpoint.h"
#include "dalembert.h"
#include "dalembert_program.h"
#include "io/earlier_statistics.h"
#include "ui/memory.h"
#include "ui/message.h"

#include "io/endian.h"
#include "io/file.h"

#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct checkpoint_header {
    uint64_t magic;
    uint64_t fingerprint; /* of the request */
    int64_t row;          /* rows in trajectory.npy, */
    row_sum sum;          /* and their sum */
    double seconds;       /* spent in steps and rows */
    uint64_t state, statistics, words, layout;
} checkpoint_header;

enum {
    HEADER_WORDS = sizeof(checkpoint_header) / WORD,
    STATISTICS_WORDS = sizeof(dal_statistics) / WORD, /* each member is one of 64 bits */
};

static const uint64_t magic = UINT64_C(0x35304b48434c4144);    /* "DALCHK05" */
static const uint64_t magic_04 = UINT64_C(0x34304b48434c4144); /* "DALCHK04" */
static const uint64_t magic_03 = UINT64_C(0x33304b48434c4144); /* "DALCHK03" */

/* From memory to the bytes of a file, or back: where that exchanges bytes, both do alike. */
static void copy_words(void *to, const void *from, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        uint64_t word;
        memcpy(&word, (const char *)from + i * WORD, WORD);
        write_le64((unsigned char *)to + i * WORD, word);
    }
}

/* ---- saving -------------------------------------------------------------------------------- */

int checkpoint_save(const run_directory *dir, const run_position *position, const dal_run *run,
                    const observed_steps *observed)
{
    size_t state_words;
    const size_t statistics_words = (size_t)observed->count * STATISTICS_WORDS;
    const size_t record_words = observed->record->number ? observed->record->count : 0;
    const double *state = dal_run_save(run, &state_words);
    const checkpoint_header header = {.magic = magic,
                                      .fingerprint = dir->fingerprint,
                                      .row = position->row,
                                      .sum = position->sum,
                                      .seconds = position->seconds,
                                      .state = state_words,
                                      .statistics = (uint64_t)observed->count,
                                      .words = STATISTICS_WORDS,
                                      .layout = DAL_STATISTICS_LAYOUT};
    const size_t words = HEADER_WORDS + state_words + statistics_words + record_words;
    unsigned char *bytes = cli_malloc((words + 1) * WORD);
    unsigned char *body = bytes + HEADER_WORDS * WORD;
    copy_words(bytes, &header, HEADER_WORDS);
    copy_words(body, state, state_words);
    copy_words(body + state_words * WORD, observed->statistics, statistics_words);
    copy_words(body + (state_words + statistics_words) * WORD, observed->record->number,
               record_words);
    const uint64_t sum = dal__hash(DAL__HASH_START, bytes, words * WORD);
    copy_words(bytes + words * WORD, &sum, 1);
    cli_hold_exit();
    int status = file_write(dir->fresh, bytes, (words + 1) * WORD, dir->sync);
    if (status == CLI_DONE && rename(dir->checkpoint, dir->before) != 0 && errno != ENOENT)
        status = cli_io("write", dir->before);
    if (status == CLI_DONE) status = file_rename(dir->fresh, dir->checkpoint, dir->sync);
    if (status != CLI_DONE) unlink(dir->fresh);
    cli_release_exit();
    free(bytes);
    return status;
}

/* ---- loading ------------------------------------------------------------------------------- */

static int damaged(const char *path, const char *reason)
{
    return cli_fail(CLI_USAGE, "%s: the checkpoint is damaged: %s", path, reason);
}

/* Words of the record; false: the sizes in the header do not add up to the body. */
static bool find_record(const checkpoint_header *h, size_t body, const observed_steps *observed,
                        size_t *words)
{
    const uint64_t too_many = UINT64_C(1) << 32;
    *words = 0;
    if (h->state > body || h->words >= too_many || h->statistics != (uint64_t)observed->count ||
        body - h->state < h->statistics * h->words)
        return false;
    *words = body - h->state - h->statistics * h->words;
    return *words == 0 || *words == observed->record->count;
}

/* Reads and checks the header.  Statistics of another layout are refused: statistics of half a
 * run would pass for statistics of the whole. */
static int check_bytes(const char *path, const unsigned char *bytes, size_t length,
                       const run_directory *dir, const observed_steps *observed,
                       checkpoint_header *h)
{
    uint64_t sum;
    size_t record_words;
    const size_t words = length / WORD - 1, body = words - HEADER_WORDS;
    if (length % WORD || length < (HEADER_WORDS + 1) * WORD)
        return damaged(path, "it is too short");
    copy_words(h, bytes, HEADER_WORDS);
    copy_words(&sum, bytes + words * WORD, 1);
    if (h->magic != magic && h->magic != magic_04 && h->magic != magic_03)
        return damaged(path, "it does not begin as one");
    if (sum != dal__hash(DAL__HASH_START, bytes, words * WORD))
        return damaged(path, "its check sum is wrong");
    if (h->fingerprint != dir->fingerprint && h->fingerprint != dir->earlier_fingerprint)
        return cli_fail(CLI_USAGE,
                        "%s: belongs to another run: its description or the system was changed",
                        path);
    if (!(h->seconds >= 0.0 && isfinite(h->seconds))) return damaged(path, "its time is wrong");
    if (h->row < 0 || !find_record(h, body, observed, &record_words))
        return damaged(path, "its size is wrong");
    if (h->layout == DAL_STATISTICS_LAYOUT && h->words == STATISTICS_WORDS) return CLI_DONE;
    if (h->layout == STATISTICS_LAYOUT_3 && h->words == STATISTICS_WORDS_3) return CLI_DONE;
    return cli_fail(
        CLI_USAGE,
        "%s: its statistics have layout %llu; dalembert " DAL_VERSION
        " reads layouts %d and %d alone: resume with the version that manifest.json names",
        path, (unsigned long long)h->layout, STATISTICS_LAYOUT_3, DAL_STATISTICS_LAYOUT);
}

/* Completes the state of an earlier format from the state of the start, state[count]; a number of
 * the run is one double or, in quad precision, two.  False: it lacks what this run needs. */
static bool read_earlier(const checkpoint_header *header, const unsigned char *body,
                         const dal_run *run, size_t count, double *state)
{
    enum { CHOICE = 3 }; /* numbers of the choice of a solver */
    const dal_system *system = dal_run_system(run);
    const bool pivots = system->pivots > 0 && system->properties & DAL_D_RANK_CHECKED;
    const size_t parameters = (size_t)system->parameters;
    const size_t present = header->state, missing = count - present;
    const size_t absent = header->magic == magic_04 ? CHOICE : CHOICE + 1 + parameters;
    if (pivots || system->events > 0 || present >= count) return false;
    if (missing != absent && missing != 2 * absent) return false;
    const size_t added = (1 + parameters) * (missing / absent);
    const size_t before = header->magic == magic_04 ? present - added : present;
    copy_words(state, body, before);
    copy_words(state + before + missing, body + before * WORD, present - before);
    return true;
}

/* Whether the counters agree, and all else is a number. */
static bool can_be_statistics(const dal_statistics *s)
{
    const long long max = 1LL << 53;
    const double *numbers = &s->first, *end = (const double *)(s + 1);
    if (s->length < 1 || s->length > max || (s->length & (s->length - 1)) != 0) return false;
    if (s->count < 0 || s->count > max || (s->lost != 0 && s->lost != 1)) return false;
    if (s->blocks != s->count / s->length || s->blocks >= DAL_STATISTICS_BLOCKS) return false;
    if (s->open_count != s->count % s->length || !(s->factor > 0.0 && s->factor <= 1.0))
        return false;
    for (; numbers < end; numbers++)
        if (isnan(*numbers) || (isinf(*numbers) && numbers != &s->scale)) return false;
    return true;
}

static int read_statistics(const char *path, const checkpoint_header *header,
                           const unsigned char *bytes, dal_statistics *statistics)
{
    for (uint64_t i = 0; i < header->statistics; i++) {
        dal_statistics s;
        uint64_t earlier[STATISTICS_WORDS_3];
        if (header->layout == DAL_STATISTICS_LAYOUT) {
            copy_words(&s, bytes + i * sizeof s, STATISTICS_WORDS);
        } else {
            copy_words(earlier, bytes + i * sizeof earlier, STATISTICS_WORDS_3);
            statistics_from_layout_3(&s, earlier);
        }
        if (!can_be_statistics(&s)) return damaged(path, "its statistics cannot be");
        statistics[i] = s;
    }
    return CLI_DONE;
}

/* Copies the record, or frees the one that would lack the steps before the checkpoint; false: it
 * cannot be one. */
static bool read_record(step_record *record, const unsigned char *bytes, size_t words)
{
    if (words == 0) record_free(record);
    if (!record->number) return true;
    copy_words(record->number, bytes, words);
    return record_is_sound(record);
}

static int restore(const char *path, const checkpoint_header *header, const unsigned char *body,
                   run_position *position, dal_run *run)
{
    dal_error error = {0};
    size_t count;
    const double *begun = dal_run_save(run, &count);
    const bool earlier = header->magic != magic;
    double *state = cli_malloc((header->state + count) * sizeof *state);
    memcpy(state, begun, count * sizeof *state);
    if (!earlier) copy_words(state, body, header->state);
    if (earlier && !read_earlier(header, body, run, count, state)) {
        free(state);
        return cli_fail(CLI_USAGE,
                        "%s: has an earlier format, which lacks numbers that this system needs "
                        "now; resume with the version that manifest.json names",
                        path);
    }
    const dal_status loaded = dal_run_restore(run, state, earlier ? count : header->state, &error);
    free(state);
    if (loaded != DAL_STATUS_OK) return damaged(path, error.message);
    *position = (run_position){header->row, header->sum, header->seconds};
    return CLI_DONE;
}

static int load_file(const run_directory *dir, const char *path, const trajectory_writer *writer,
                     run_position *position, dal_run *run, const observed_steps *observed)
{
    size_t length, record_words;
    checkpoint_header header;
    unsigned char *bytes = (unsigned char *)file_read(path, &length);
    if (!bytes) return CLI_IO;
    int status = check_bytes(path, bytes, length, dir, observed, &header);
    if (status == CLI_DONE) status = writer_verify(writer, header.row, &header.sum);
    if (status == CLI_DONE)
        status = read_statistics(path, &header, bytes + (HEADER_WORDS + header.state) * WORD,
                                 observed->statistics);
    if (status == CLI_DONE) {
        const size_t words = length / WORD - 1;
        find_record(&header, words - HEADER_WORDS, observed, &record_words);
        if (!read_record(observed->record, bytes + (words - record_words) * WORD, record_words))
            status = damaged(path, "the record of its steps cannot be");
    }
    if (status == CLI_DONE)
        status = restore(path, &header, bytes + HEADER_WORDS * WORD, position, run);
    free(bytes);
    return status;
}

static bool exists(const char *path) { return access(path, F_OK) == 0 || errno != ENOENT; }

int checkpoint_load(const run_directory *dir, const trajectory_writer *writer,
                    run_position *position, dal_run *run, const observed_steps *observed)
{
    *position = (run_position){0};
    const int has_newer = exists(dir->checkpoint), has_older = exists(dir->before);
    if (!has_newer && !has_older) return CLI_DONE;
    int status = CLI_USAGE;
    if (has_newer) status = load_file(dir, dir->checkpoint, writer, position, run, observed);
    if (status == CLI_DONE || !has_older) return status;
    if (has_newer) cli_note("%s is read instead", dir->before);
    return load_file(dir, dir->before, writer, position, run, observed);
}

int checkpoint_read_observed(const run_directory *dir, const observed_steps *observed, bool *found)
{
    size_t length, record_words;
    uint64_t sum;
    checkpoint_header h;
    *found = false;
    if (!exists(dir->checkpoint)) return CLI_DONE;
    unsigned char *bytes = (unsigned char *)file_read(dir->checkpoint, &length);
    if (!bytes) return CLI_IO;
    const size_t words = length / WORD - 1;
    bool is_good = length % WORD == 0 && length >= (HEADER_WORDS + 1) * WORD;
    if (is_good) {
        copy_words(&h, bytes, HEADER_WORDS);
        copy_words(&sum, bytes + words * WORD, 1);
        is_good = h.magic == magic && sum == dal__hash(DAL__HASH_START, bytes, words * WORD) &&
                  h.fingerprint == dir->fingerprint && h.layout == DAL_STATISTICS_LAYOUT &&
                  h.words == STATISTICS_WORDS &&
                  find_record(&h, words - HEADER_WORDS, observed, &record_words);
    }
    for (int i = 0; i < observed->count && is_good; i++) {
        copy_words(&observed->statistics[i],
                   bytes + (HEADER_WORDS + h.state + (size_t)i * STATISTICS_WORDS) * WORD,
                   STATISTICS_WORDS);
        is_good = can_be_statistics(&observed->statistics[i]);
    }
    if (is_good && record_words > 0) {
        record_allocate(observed->record);
        is_good =
            read_record(observed->record, bytes + (words - record_words) * WORD, record_words);
    }
    free(bytes);
    *found = is_good;
    return CLI_DONE;
}
