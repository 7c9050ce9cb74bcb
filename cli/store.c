/* store.c - the checkpoint of a run and the files around it.
 *
 * The checkpoint, in the byte order of the machine:
 *
 *     head      a magic word that tells version and byte order, the fingerprint of the run, the
 *               mark, the counts of what follows
 *     double    [memory] all that the run carries from step to step
 *     dal_drift [drifts] the statistics of each observable
 *     uint64    FNV-1a of all before */
#include "store.h"

#include "file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct head {
    uint64_t magic, fingerprint;
    int64_t row, offset;
    double seconds;
    uint64_t memory, drifts;
} head;

static const uint64_t checkpoint_magic = UINT64_C(0x31304b48434c4144); /* "DALCHK01" */

int store_open(cli_store *store, const char *directory)
{
    *store = (cli_store){.directory = directory, .descriptor = -1};
#define X(name, file) store->name = cli_join(directory, file);
    STORE_FILE_LIST(X)
#undef X
#define X(name, file) &&store->name
    if (1 STORE_FILE_LIST(X)) return CLI_DONE;
#undef X
    store_close(store);
    return cli_fail(CLI_IO, "out of memory");
}

void store_close(cli_store *store)
{
#define X(name, file) free(store->name);
    STORE_FILE_LIST(X)
#undef X
    free(store->text);
    if (store->descriptor >= 0) close(store->descriptor);
    *store = (cli_store){.descriptor = -1};
}

/* An empty rows.csv is all that a run leaves that was killed before it was described. */
static int holds(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && status.st_size > 0;
}

const char *store_holds(const cli_store *store)
{
#define X(name, file)                                                                              \
    if (holds(store->name)) return store->name;
    STORE_FILE_LIST(X)
#undef X
    return NULL;
}

int store_lock(cli_store *store)
{
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    store->descriptor = open(store->rows, O_RDWR | O_CREAT, 0666);
    if (store->descriptor < 0) return cli_io("write", store->rows);
    if (fcntl(store->descriptor, F_SETLK, &whole) == 0) return CLI_DONE;
    /* Some network file systems know no locks; there the user must take care. */
    if (errno != EACCES && errno != EAGAIN) return CLI_DONE;
    return cli_fail(CLI_USAGE, "'%s': another process is writing to it", store->rows);
}

/* ---- saving -------------------------------------------------------------------------------- */

static unsigned char *append(unsigned char *place, const void *from, size_t bytes)
{
    if (bytes) memcpy(place, from, bytes);
    return place + bytes;
}

int store_save(const cli_store *store, const cli_mark *mark, const dal_run *run,
               const dal_drift *drift, int drifts)
{
    size_t count;
    const double *memory = dal_run_memory(run, &count);
    head h = {checkpoint_magic, store->fingerprint, mark->row,       mark->offset,
              mark->seconds,    (uint64_t)count,    (uint64_t)drifts};
    size_t bytes = sizeof h + count * sizeof *memory + (size_t)drifts * sizeof *drift;
    unsigned char *text = malloc(bytes + sizeof(uint64_t));
    if (!text) return cli_fail(CLI_IO, "out of memory");
    unsigned char *place = append(text, &h, sizeof h);
    place = append(place, memory, count * sizeof *memory);
    place = append(place, drift, (size_t)drifts * sizeof *drift);
    uint64_t sum = file_hash(FILE_HASH_START, text, bytes);
    append(place, &sum, sizeof sum);
    int status = file_replace(store->checkpoint, text, bytes + sizeof sum);
    free(text);
    return status;
}

/* ---- loading ------------------------------------------------------------------------------- */

static int damaged(const cli_store *store, const char *how)
{
    return cli_fail(CLI_USAGE, "%s: the checkpoint is damaged: %s", store->checkpoint, how);
}

static int check(const cli_store *store, const char *text, size_t length, head *h, int drifts)
{
    uint64_t sum;
    if (length < sizeof *h + sizeof sum) return damaged(store, "it is too short");
    memcpy(h, text, sizeof *h);
    memcpy(&sum, text + length - sizeof sum, sizeof sum);
    if (h->magic != checkpoint_magic) return damaged(store, "it does not begin as one");
    if (sum != file_hash(FILE_HASH_START, text, length - sizeof sum))
        return damaged(store, "its check sum is wrong");
    if (h->fingerprint != store->fingerprint)
        return cli_fail(CLI_USAGE, "%s: belongs to another run: run.yaml or the system was changed",
                        store->checkpoint);
    size_t room = length - sizeof *h - sizeof sum;
    if (h->drifts != (uint64_t)drifts || h->drifts > room / sizeof(dal_drift) ||
        h->memory != (room - h->drifts * sizeof(dal_drift)) / sizeof(double))
        return damaged(store, "its size is wrong");
    return CLI_DONE;
}

static int place(const cli_store *store, const head *h, const char *text, dal_run *run,
                 dal_drift *drift)
{
    dal_error error = {0};
    size_t bytes = h->memory * sizeof(double);
    double *memory = malloc(bytes + 1);
    if (!memory) return cli_fail(CLI_IO, "out of memory");
    memcpy(memory, text + sizeof *h, bytes);
    dal_status loaded = dal_run_load(run, memory, h->memory, &error);
    free(memory);
    if (loaded != DAL_OK) return cli_error(CLI_USAGE, store->checkpoint, &error);
    if (h->drifts) memcpy(drift, text + sizeof *h + bytes, h->drifts * sizeof *drift);
    return CLI_DONE;
}

int store_load(const cli_store *store, cli_mark *mark, dal_run *run, dal_drift *drift, int drifts)
{
    *mark = (cli_mark){0};
    if (access(store->checkpoint, F_OK) != 0 && errno == ENOENT) return CLI_DONE;
    head h;
    size_t length;
    char *text = file_read(store->checkpoint, &length);
    if (!text) return CLI_IO;
    int status = check(store, text, length, &h, drifts);
    if (status == CLI_DONE) status = place(store, &h, text, run, drift);
    if (status == CLI_DONE) *mark = (cli_mark){h.row, h.offset, h.seconds};
    free(text);
    return status;
}
