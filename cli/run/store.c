/* store.c - a directory that holds a run: its files, and who may write to them. */
#include "store.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

void store_open(cli_store *store, const char *directory)
{
    *store = (cli_store){.directory = directory, .descriptor = -1, .settle = 1};
#define X(name, file) store->name = cli_join(directory, file);
    STORE_FILE_LIST(X)
#undef X
}

void store_close(cli_store *store)
{
#define X(name, file) free(store->name);
    STORE_FILE_LIST(X)
#undef X
    if (store->text) yaml_document_delete(&store->text->document);
    free(store->text);
    free(store->input);
    if (store->descriptor >= 0) close(store->descriptor);
    *store = (cli_store){.descriptor = -1};
}

/* An empty trajectory.npy is all that a run leaves that was killed before it was described. */
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

static int is_there(const char *path) { return access(path, F_OK) == 0; }

int store_is_described(const cli_store *store) { return is_there(store->manifest); }

int store_lock(cli_store *store, int is_new)
{
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    if (!is_new && !is_there(store->rows))
        return cli_fail(CLI_USAGE, "'%s' is missing: the run cannot be continued", store->rows);
    store->descriptor = open(store->rows, O_RDWR | (is_new ? O_CREAT : 0), 0666);
    if (store->descriptor < 0) return cli_io("write", store->rows);
    if (fcntl(store->descriptor, F_SETLK, &whole) == 0) return CLI_DONE;
    /* Some network file systems know no locks; there the user must take care. */
    if (errno != EACCES && errno != EAGAIN) return CLI_DONE;
    return cli_fail(CLI_USAGE, "'%s': another process is writing to it", store->rows);
}
