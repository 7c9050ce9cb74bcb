/* run_directory.c - the directory of a run: its files, and which process may write to them. */
#include "run_directory.h"
#include "ui/message.h"

#include "io/file.h"

#include <fcntl.h>
#include <stdbool.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

void run_directory_open(run_directory *dir, const char *path)
{
    *dir = (run_directory){.path = path, .descriptor = -1, .sync = FILE_SYNCED};
    STORE_MAKE_PATHS(dir, RUN_FILE_LIST);
}

void run_directory_close(run_directory *dir)
{
    store_free_paths(dir->file, RUN_FILES);
    store_free_manifest(dir->doc);
    free(dir->input);
    free(dir->earlier);
    if (dir->descriptor >= 0) close(dir->descriptor);
    *dir = (run_directory){.descriptor = -1};
}

/* A run that was killed before its manifest was written leaves an empty trajectory.npy alone. */
const char *run_directory_find_file(const run_directory *dir)
{
    struct stat status;
    for (int i = 0; i < RUN_FILES; i++)
        if (stat(dir->file[i], &status) == 0 && status.st_size > 0) return dir->file[i];
    return NULL;
}

bool run_directory_has_run(const run_directory *dir) { return file_exists(dir->manifest); }

int run_directory_lock(run_directory *dir, run_files files)
{
    if (files == RUN_EXISTING && !file_exists(dir->rows))
        return cli_fail(CLI_USAGE, "'%s' is missing: the run cannot be continued", dir->rows);
    dir->descriptor = open(dir->rows, O_RDWR | (files == RUN_NEW ? O_CREAT : 0), 0666);
    if (dir->descriptor < 0) return cli_io("write", dir->rows);
    return store_lock(dir->descriptor, dir->rows);
}
