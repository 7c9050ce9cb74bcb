/* study_results.c - the results of cells that keep no rows, in a few files of the study.
 *
 * A file has little-endian words of 64 bits, doubles by their bits:
 *
 *     header  the word DALRES02
 *     record  its number of words, the key of the cell (study_cell_key), state, status, time,
 *             steps, evaluations, seconds, bits, the number of observables; for each of them the
 *             members of a dal_trend; the message of a failure; FNV-1a of all before it
 *
 * Records are only ever added, so a file that is cut off anywhere has all records before. */
#include "study_results.h"

#include "dalembert_program.h"
#include "io/endian.h"
#include "io/file.h"
#include "io/store.h"
#include "ui/clock.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The members of a dal_trend: kind, name. */
#define TREND_LIST(MEMBER)                                                                         \
    MEMBER(integer, count)                                                                         \
    MEMBER(real, first)                                                                            \
    MEMBER(real, last)                                                                             \
    MEMBER(real, max_abs)                                                                          \
    MEMBER(real, deviation)                                                                        \
    MEMBER(real, amplitude)                                                                        \
    MEMBER(real, rate)                                                                             \
    MEMBER(real, rate_low)                                                                         \
    MEMBER(real, rate_high)                                                                        \
    MEMBER(real, max_drift)                                                                        \
    MEMBER(real, exponent)                                                                         \
    MEMBER(integer, size)                                                                          \
    MEMBER(integer, trend)                                                                         \
    MEMBER(real, confidence)                                                                       \
    MEMBER(integer, conservation)

#define ONE(kind, member) +1
enum {
    RECORD_WORDS = 10, /* before the trends */
    TREND_WORDS = 0 TREND_LIST(ONE),
    MESSAGE_WORDS = DAL_MESSAGE_SIZE / WORD
};
#undef ONE

static const uint64_t magic = UINT64_C(0x32305345524c4144);         /* "DALRES02" */
static const uint64_t earlier_magic = UINT64_C(0x31305345524c4144); /* "DALRES01" */

/* What was read of a file, or written to it. */
typedef struct results_file {
    char *path;
    unsigned char *bytes; /* as they were read */
    size_t size;          /* of the file then; */
    size_t valid;         /* bytes of whole records in it */
} results_file;

/* A cell and its results. */
typedef struct cell_record {
    uint64_t key;
    int number;
    const unsigned char *record; /* in a file, or NULL */
} cell_record;

struct study_results {
    results_file *file; /* [files], the first is this process's own */
    int files, cells;
    cell_record *of_key; /* [cells] by key */
    cell_record **cell;  /* [cells] in of_key, by number */
    char *directory;
    FILE *out;    /* NULL until a result is added */
    double saved; /* when results were last brought to the disk */
    pthread_mutex_t mutex;
};

/* ---- words --------------------------------------------------------------------------------- */

static void put_integer(unsigned char **at, long long value)
{
    write_le64(*at, (uint64_t)value);
    *at += WORD;
}

static void put_real(unsigned char **at, double value)
{
    write_le_double(*at, value);
    *at += WORD;
}

static long long get_integer(const unsigned char **at)
{
    const uint64_t word = read_le64(*at);
    *at += WORD;
    return (long long)word;
}

static double get_real(const unsigned char **at)
{
    const double value = read_le_double(*at);
    *at += WORD;
    return value;
}

static uint64_t observables_of(const unsigned char *record)
{
    return read_le64(record + (RECORD_WORDS - 1) * WORD);
}

/* ---- reading ------------------------------------------------------------------------------- */

/* The words of a record that begins in bytes[size]; 0 where none is whole there. */
static size_t check_record(const unsigned char *bytes, size_t size)
{
    if (size < WORD) return 0;
    const uint64_t words = read_le64(bytes);
    if (words <= RECORD_WORDS || words > size / WORD) return 0;
    const size_t length = ((size_t)words - 1) * WORD;
    if (dal__hash(DAL__HASH_START, bytes, length) != read_le64(bytes + length)) return 0;
    return words == RECORD_WORDS + observables_of(bytes) * TREND_WORDS + MESSAGE_WORDS + 1
               ? (size_t)words
               : 0;
}

static int compare_keys(const void *x, const void *y)
{
    const cell_record *one = x, *other = y;
    return (one->key > other->key) - (one->key < other->key);
}

/* Other records are of cells that the study had before it was changed. */
static void keep_record(study_results *r, const unsigned char *record)
{
    const cell_record wanted = {.key = read_le64(record + WORD)};
    cell_record *cell =
        bsearch(&wanted, r->of_key, (size_t)r->cells, sizeof *r->of_key, compare_keys);
    if (cell) cell->record = record;
}

static int read_file(study_results *r, results_file *f)
{
    if (!file_exists(f->path)) return CLI_DONE;
    f->bytes = (unsigned char *)file_read(f->path, &f->size);
    if (!f->bytes) return CLI_IO;
    if (f->size < WORD) return CLI_DONE;
    if (read_le64(f->bytes) == earlier_magic)
        return cli_fail(CLI_USAGE,
                        "%s: results of an earlier version; begin the study again with --force",
                        f->path);
    if (read_le64(f->bytes) != magic)
        return cli_fail(CLI_USAGE, "%s: it does not begin as a file of results", f->path);
    f->valid = WORD;
    for (size_t words; (words = check_record(f->bytes + f->valid, f->size - f->valid));) {
        keep_record(r, f->bytes + f->valid);
        f->valid += words * WORD;
    }
    return CLI_DONE;
}

static results_file *add_file(study_results *r, const char *name)
{
    r->file = cli_realloc(r->file, ((size_t)r->files + 1) * sizeof *r->file);
    r->file[r->files] = (results_file){.path = cli_join(r->directory, name)};
    return &r->file[r->files++];
}

static void sort_cells(study_results *r, const uint64_t *key)
{
    r->of_key = cli_calloc((size_t)r->cells + 1, sizeof *r->of_key);
    r->cell = cli_calloc((size_t)r->cells + 1, sizeof *r->cell);
    for (int i = 0; i < r->cells; i++) r->of_key[i] = (cell_record){.key = key[i], .number = i};
    qsort(r->of_key, (size_t)r->cells, sizeof *r->of_key, compare_keys);
    for (int i = 0; i < r->cells; i++) r->cell[r->of_key[i].number] = &r->of_key[i];
}

int study_results_open(study_results **results, const char *directory, const char *writer,
                       const uint64_t *key, int cells)
{
    study_results *r = *results = cli_calloc(1, sizeof *r);
    *r =
        (study_results){.cells = cells, .directory = cli_strdup(directory), .saved = cli_seconds()};
    pthread_mutex_init(&r->mutex, NULL);
    sort_cells(r, key);
    int status = read_file(r, add_file(r, writer));
    DIR *list = opendir(directory);
    if (!list) return status != CLI_DONE || errno == ENOENT ? status : cli_io("read", directory);
    for (struct dirent *entry; status == CLI_DONE && (entry = readdir(list));)
        if (entry->d_name[0] != '.' && strcmp(entry->d_name, writer) != 0)
            status = read_file(r, add_file(r, entry->d_name));
    closedir(list);
    return status;
}

void study_results_free(study_results *r)
{
    if (!r) return;
    if (r->out) fclose(r->out);
    for (int i = 0; i < r->files; i++) {
        free(r->file[i].path);
        free(r->file[i].bytes);
    }
    pthread_mutex_destroy(&r->mutex);
    free(r->file);
    free(r->of_key);
    free(r->cell);
    free(r->directory);
    free(r);
}

bool study_results_has(const study_results *r, int number)
{
    return r->cell[number]->record != NULL;
}

/* Whether it is the result of a run: a file may hold anything. */
static bool is_result(const study_cell *cell)
{
    bool is_valid = cell->state == STUDY_FINISHED || cell->state == STUDY_FAILED;
    is_valid &= cell->error.status < DAL_STATUS_COUNT;
    for (int i = 0; i < cell->observables; i++) {
        const dal_trend *t = &cell->trend[i];
        is_valid &= t->size < DAL_SIZE_COUNT && t->trend < DAL_TREND_COUNT &&
                    t->conservation <= DAL_MOVED_BY_PI;
    }
    return is_valid;
}

bool study_results_get(const study_results *r, int number, study_cell *cell)
{
    const unsigned char *at = r->cell[number]->record;
    if (!at || observables_of(at) != (uint64_t)cell->observables) return false;
    study_cell read = *cell;
    at += 2 * WORD;
    read.state = (study_state)get_integer(&at);
    read.error = (dal_error){.status = (dal_status)get_integer(&at)};
    read.time = get_real(&at);
    read.steps = get_integer(&at);
    read.evaluations = get_integer(&at);
    read.seconds = get_real(&at);
    read.bits = (uint64_t)get_integer(&at);
    get_integer(&at);
    for (int i = 0; i < cell->observables; i++) {
        dal_trend *t = &cell->trend[i];
#define GET(kind, member) t->member = get_##kind(&at);
        TREND_LIST(GET)
#undef GET
    }
    memcpy(read.error.message, at, DAL_MESSAGE_SIZE);
    read.error.message[DAL_MESSAGE_SIZE - 1] = '\0';
    if (!is_result(&read)) return false;
    *cell = read;
    return true;
}

/* ---- adding -------------------------------------------------------------------------------- */

/* The record of a cell, allocated. */
static unsigned char *make_record(uint64_t key, const study_cell *cell)
{
    const size_t words = RECORD_WORDS + (size_t)cell->observables * TREND_WORDS + MESSAGE_WORDS + 1;
    unsigned char *bytes = cli_malloc(words * WORD);
    unsigned char *at = bytes;
    put_integer(&at, (long long)words);
    put_integer(&at, (long long)key);
    put_integer(&at, cell->state);
    put_integer(&at, cell->error.status);
    put_real(&at, cell->time);
    put_integer(&at, cell->steps);
    put_integer(&at, cell->evaluations);
    put_real(&at, cell->seconds);
    put_integer(&at, (long long)cell->bits);
    put_integer(&at, cell->observables);
    for (int i = 0; i < cell->observables; i++) {
        const dal_trend *t = &cell->trend[i];
#define PUT(kind, member) put_##kind(&at, t->member);
        TREND_LIST(PUT)
#undef PUT
    }
    memcpy(at, cell->error.message, DAL_MESSAGE_SIZE);
    write_le64(at + DAL_MESSAGE_SIZE,
               dal__hash(DAL__HASH_START, bytes, (size_t)(at - bytes) + DAL_MESSAGE_SIZE));
    return bytes;
}

/* Takes the file of this process for it alone, as it was when it was read, and cuts off a record
 * that is not whole. */
static int take_file(int descriptor, const results_file *f)
{
    struct stat info;
    const int status = store_lock(descriptor, f->path);
    if (status != CLI_DONE) return status;
    if (fstat(descriptor, &info) != 0) return cli_io("read", f->path);
    if ((size_t)info.st_size != f->size)
        return cli_fail(CLI_USAGE, "'%s': another process is writing to it", f->path);
    return ftruncate(descriptor, (off_t)f->valid) == 0 ? CLI_DONE : cli_io("write", f->path);
}

static int open_file(study_results *r)
{
    const results_file *f = &r->file[0];
    unsigned char header[WORD];
    int status = file_make_directory(r->directory);
    if (status != CLI_DONE) return status;
    const int descriptor = open(f->path, O_WRONLY | O_CREAT | O_APPEND, 0666);
    if (descriptor < 0) return cli_io("write", f->path);
    status = take_file(descriptor, f);
    if (status == CLI_DONE && !(r->out = fdopen(descriptor, "ab")))
        status = cli_io("write", f->path);
    if (status != CLI_DONE) {
        close(descriptor);
        return status;
    }
    write_le64(header, magic);
    if (f->valid == 0) fwrite(header, 1, sizeof header, r->out);
    return CLI_DONE;
}

static int save(study_results *r)
{
    r->saved = cli_seconds();
    if (!r->out) return CLI_DONE;
    const bool is_written = !ferror(r->out) && fflush(r->out) == 0;
    return is_written && fdatasync(fileno(r->out)) == 0 ? CLI_DONE
                                                        : cli_io("write", r->file[0].path);
}

static int append(study_results *r, const unsigned char *record, double interval)
{
    const size_t words = (size_t)read_le64(record);
    pthread_mutex_lock(&r->mutex);
    int status = r->out ? CLI_DONE : open_file(r);
    if (status == CLI_DONE && fwrite(record, WORD, words, r->out) != words)
        status = cli_io("write", r->file[0].path);
    if (status == CLI_DONE && cli_seconds() - r->saved >= interval) status = save(r);
    pthread_mutex_unlock(&r->mutex);
    return status;
}

int study_results_add(study_results *r, int number, const study_cell *cell, double interval)
{
    unsigned char *record = make_record(r->cell[number]->key, cell);
    const int status = append(r, record, interval);
    free(record);
    return status;
}

int study_results_copy(study_results *to, const study_results *from, int number)
{
    return append(to, from->cell[number]->record, INFINITY);
}

int study_results_save(study_results *r)
{
    pthread_mutex_lock(&r->mutex);
    const int status = save(r);
    pthread_mutex_unlock(&r->mutex);
    return status;
}
