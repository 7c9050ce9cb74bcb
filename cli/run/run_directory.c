/* run_directory.c - a directory that holds a run: its files, and who may write to them. */
#include "run_directory.h"
#include "io/output.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

void run_directory_open(run_directory *dir, const char *directory)
{
    *dir = (run_directory){.path = directory, .descriptor = -1, .sync = 1};
#define X(name, file) dir->name = cli_join(directory, file);
    RUN_FILE_LIST(X)
#undef X
}

void run_directory_close(run_directory *dir)
{
#define X(name, file) free(dir->name);
    RUN_FILE_LIST(X)
#undef X
    if (dir->doc) yaml_document_delete(&dir->doc->yaml);
    free(dir->doc);
    free(dir->input);
    if (dir->descriptor >= 0) close(dir->descriptor);
    *dir = (run_directory){.descriptor = -1};
}

/* An empty trajectory.npy is all that a run leaves that was killed before it was described. */
static int holds(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && status.st_size > 0;
}

const char *run_directory_find_file(const run_directory *dir)
{
#define X(name, file)                                                                              \
    if (holds(dir->name)) return dir->name;
    RUN_FILE_LIST(X)
#undef X
    return NULL;
}

static int is_there(const char *path) { return access(path, F_OK) == 0; }

int run_directory_has_run(const run_directory *dir) { return is_there(dir->manifest); }

int run_directory_lock(run_directory *dir, int is_new)
{
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    if (!is_new && !is_there(dir->rows))
        return cli_fail(CLI_USAGE, "'%s' is missing: the run cannot be continued", dir->rows);
    dir->descriptor = open(dir->rows, O_RDWR | (is_new ? O_CREAT : 0), 0666);
    if (dir->descriptor < 0) return cli_io("write", dir->rows);
    if (fcntl(dir->descriptor, F_SETLK, &whole) == 0) return CLI_DONE;
    /* Some network file systems know no locks; there the user must take care. */
    if (errno != EACCES && errno != EAGAIN) return CLI_DONE;
    return cli_fail(CLI_USAGE, "'%s': another process is writing to it", dir->rows);
}
