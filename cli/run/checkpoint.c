/* checkpoint.c - the state of a run in a file that outlives any end of the process.
 *
 * Little-endian words of 64 bits, doubles by their bits:
 *
 *     header      the word DALCHK05, then as in the struct below
 *     state       [state] all that the run carries from step to step, and its parameters, then
 *                 what derivatives of --sensitivities carry
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
    size_t run_words, added_words = 0;
    const size_t statistics_words = (size_t)observed->count * STATISTICS_WORDS;
    const size_t record_words = observed->record->number ? observed->record->count : 0;
    const double *state = dal_run_save(run, &run_words);
    const double *added = dal_sensitivity_save(observed->sensitivity, &added_words);
    const size_t state_words = run_words + added_words;
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
    copy_words(body, state, run_words);
    copy_words(body + run_words * WORD, added, added_words);
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

/* A file of a checkpoint in memory: the header, the state, statistics, the record of steps and the
 * check sum. */
typedef struct checkpoint_file {
    const char *path;
    unsigned char *bytes;
    size_t words; /* before the check sum */
    checkpoint_header header;
    size_t record_words;
} checkpoint_file;

static int damaged(const char *path, const char *reason)
{
    return cli_fail(CLI_USAGE, "%s: the checkpoint is damaged: %s", path, reason);
}

/* Copies the header; false: the file is too short, or has no whole words. */
static bool copy_header(checkpoint_file *f, size_t length)
{
    f->words = length / WORD - 1;
    if (length % WORD || length < (HEADER_WORDS + 1) * WORD) return false;
    copy_words(&f->header, f->bytes, HEADER_WORDS);
    return true;
}

static bool has_sum(const checkpoint_file *f)
{
    uint64_t sum;
    copy_words(&sum, f->bytes + f->words * WORD, 1);
    return sum == dal__hash(DAL__HASH_START, f->bytes, f->words * WORD);
}

/* The words of the record; false: the sizes in the header do not add up to the body. */
static bool find_record(checkpoint_file *f, const observed_steps *observed)
{
    const uint64_t too_many = UINT64_C(1) << 32;
    const checkpoint_header *h = &f->header;
    const size_t body = f->words - HEADER_WORDS;
    if (h->state > body || h->words >= too_many || h->statistics != (uint64_t)observed->count ||
        body - h->state < h->statistics * h->words)
        return false;
    f->record_words = body - h->state - h->statistics * h->words;
    return f->record_words == 0 || f->record_words == observed->record->count;
}

/* Reads and checks the header.  Statistics of another layout are refused: statistics of half a
 * run would pass for statistics of the whole. */
static int check_bytes(checkpoint_file *f, size_t length, const run_directory *dir,
                       const observed_steps *observed)
{
    const char *path = f->path;
    const checkpoint_header *h = &f->header;
    if (!copy_header(f, length)) return damaged(path, "it is too short");
    if (h->magic != magic && h->magic != magic_04 && h->magic != magic_03)
        return damaged(path, "it does not begin as one");
    if (!has_sum(f)) return damaged(path, "its check sum is wrong");
    if (h->fingerprint != dir->fingerprint && h->fingerprint != dir->earlier_fingerprint)
        return cli_fail(CLI_USAGE,
                        "%s: belongs to another run: its description or the system was changed",
                        path);
    if (!(h->seconds >= 0.0 && isfinite(h->seconds))) return damaged(path, "its time is wrong");
    if (h->row < 0 || !find_record(f, observed)) return damaged(path, "its size is wrong");
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

static int read_statistics(const checkpoint_file *f, dal_statistics *statistics)
{
    const unsigned char *bytes = f->bytes + (HEADER_WORDS + f->header.state) * WORD;
    for (uint64_t i = 0; i < f->header.statistics; i++) {
        dal_statistics s;
        uint64_t earlier[STATISTICS_WORDS_3];
        if (f->header.layout == DAL_STATISTICS_LAYOUT) {
            copy_words(&s, bytes + i * sizeof s, STATISTICS_WORDS);
        } else {
            copy_words(earlier, bytes + i * sizeof earlier, STATISTICS_WORDS_3);
            statistics_from_layout_3(&s, earlier);
        }
        if (!can_be_statistics(&s)) return damaged(f->path, "its statistics cannot be");
        statistics[i] = s;
    }
    return CLI_DONE;
}

/* Copies the record, or frees the one that would lack the steps before the checkpoint; false: it
 * cannot be one. */
static bool read_record(step_record *record, const checkpoint_file *f)
{
    if (f->record_words == 0) record_free(record);
    if (!record->number) return true;
    copy_words(record->number, f->bytes + (f->words - f->record_words) * WORD, f->record_words);
    return record_is_sound(record);
}

static int restore(const checkpoint_file *f, run_position *position, dal_run *run,
                   dal_sensitivity *sensitivity)
{
    dal_error error = {0};
    size_t count, added = 0;
    const checkpoint_header *header = &f->header;
    const unsigned char *body = f->bytes + HEADER_WORDS * WORD;
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
                        f->path);
    }
    dal_sensitivity_save(sensitivity, &added);
    const size_t stored = earlier || header->state < added ? count : header->state - added;
    dal_status loaded = dal_run_restore(run, state, stored, &error);
    if (loaded == DAL_STATUS_OK && sensitivity)
        loaded = dal_sensitivity_restore(sensitivity, state + stored, added, &error);
    free(state);
    if (loaded != DAL_STATUS_OK) return damaged(f->path, error.message);
    *position = (run_position){header->row, header->sum, header->seconds};
    return CLI_DONE;
}

static int load_file(const run_directory *dir, const char *path, const trajectory_writer *writer,
                     run_position *position, dal_run *run, const observed_steps *observed)
{
    size_t length;
    checkpoint_file f = {.path = path, .bytes = (unsigned char *)file_read(path, &length)};
    if (!f.bytes) return CLI_IO;
    int status = check_bytes(&f, length, dir, observed);
    if (status == CLI_DONE) status = writer_verify(writer, f.header.row, &f.header.sum);
    if (status == CLI_DONE) status = read_statistics(&f, observed->statistics);
    if (status == CLI_DONE && !read_record(observed->record, &f))
        status = damaged(path, "the record of its steps cannot be");
    if (status == CLI_DONE) status = restore(&f, position, run, observed->sensitivity);
    free(f.bytes);
    return status;
}

static bool exists(const char *path) { return access(path, F_OK) == 0 || errno != ENOENT; }

int checkpoint_load(const run_directory *dir, const trajectory_writer *writer,
                    run_position *position, dal_run *run, const observed_steps *observed)
{
    *position = (run_position){0};
    const bool has_newer = exists(dir->checkpoint), has_older = exists(dir->before);
    if (!has_newer && !has_older) return CLI_DONE;
    int status = CLI_USAGE;
    if (has_newer) status = load_file(dir, dir->checkpoint, writer, position, run, observed);
    if (status == CLI_DONE || !has_older) return status;
    if (has_newer) cli_note("%s is read instead", dir->before);
    return load_file(dir, dir->before, writer, position, run, observed);
}

/* Whether this version wrote the file for the run, and it is whole. */
static bool is_of_run(checkpoint_file *f, size_t length, const run_directory *dir,
                      const observed_steps *observed)
{
    const checkpoint_header *h = &f->header;
    return copy_header(f, length) && h->magic == magic && has_sum(f) &&
           h->fingerprint == dir->fingerprint && h->layout == DAL_STATISTICS_LAYOUT &&
           h->words == STATISTICS_WORDS && find_record(f, observed);
}

int checkpoint_read_observed(const run_directory *dir, const observed_steps *observed, bool *found)
{
    size_t length;
    *found = false;
    if (!exists(dir->checkpoint)) return CLI_DONE;
    checkpoint_file f = {.path = dir->checkpoint,
                         .bytes = (unsigned char *)file_read(dir->checkpoint, &length)};
    if (!f.bytes) return CLI_IO;
    bool is_good = is_of_run(&f, length, dir, observed);
    for (int i = 0; i < observed->count && is_good; i++) {
        copy_words(&observed->statistics[i],
                   f.bytes + (HEADER_WORDS + f.header.state + (size_t)i * STATISTICS_WORDS) * WORD,
                   STATISTICS_WORDS);
        is_good = can_be_statistics(&observed->statistics[i]);
    }
    if (is_good && f.record_words > 0) {
        record_allocate(observed->record);
        is_good = read_record(observed->record, &f);
    }
    free(f.bytes);
    *found = is_good;
    return CLI_DONE;
}
