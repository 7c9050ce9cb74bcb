/* study_directory.c - the directory of a study: begun, joined, read. */
#include "study_directory.h"
#include "io/output.h"
#include "run/system.h"
#include "ui/memory.h"
#include "ui/message.h"

#include "io/file.h"
#include "io/json.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

void study_directory_open(study_directory *dir, const char *directory)
{
    *dir = (study_directory){.directory = directory};
#define X(name, file) dir->name = cli_join(directory, file);
    STUDY_FILE_LIST(X)
#undef X
}

void study_directory_close(study_directory *dir)
{
#define X(name, file) free(dir->name);
    STUDY_FILE_LIST(X)
#undef X
    free(dir->text);
    *dir = (study_directory){0};
}

static int is_there(const char *path) { return access(path, F_OK) == 0; }

int study_directory_has_study(const study_directory *dir) { return is_there(dir->study); }

int study_directory_is_finished(const study_directory *dir)
{
    if (!is_there(dir->study)) return 0;
    char *state = json_file_text(dir->manifest, "status");
    const int finished = state && (strcmp(state, "done") == 0 || strcmp(state, "unmet") == 0);
    free(state);
    return finished;
}

/* ---- clearing ---- */

static int is_dot(const char *name) { return strcmp(name, ".") == 0 || strcmp(name, "..") == 0; }

/* Removes what is in a directory, down to a depth that no study exceeds, and the directory. */
static int remove_all(const char *path, int depth)
{
    struct stat status;
    if (lstat(path, &status) != 0) return errno == ENOENT ? CLI_DONE : cli_io("remove", path);
    if (!S_ISDIR(status.st_mode)) return file_remove(path);
    DIR *directory = depth > 0 ? opendir(path) : NULL;
    if (!directory) return cli_io("remove", path);
    int done = CLI_DONE;
    for (struct dirent *entry; done == CLI_DONE && (entry = readdir(directory));) {
        if (is_dot(entry->d_name)) continue;
        char *inner = cli_join(path, entry->d_name);
        done = remove_all(inner, depth - 1);
        free(inner);
    }
    closedir(directory);
    if (done != CLI_DONE) return done;
    return rmdir(path) == 0 ? CLI_DONE : cli_io("remove", path);
}

/* ---- shards ---- */

char *study_directory_manifest(const study_directory *dir, study_shard shard)
{
    char name[64];
    if (shard.count == 0) return cli_strdup(dir->manifest);
    snprintf(name, sizeof name, "shard-%lld-of-%lld.json", shard.number, shard.count);
    return cli_join(dir->directory, name);
}

static int is_manifest(const char *name, study_shard *shard)
{
    int end = 0;
    sscanf(name, "shard-%lld-of-%lld.json%n", &shard->number, &shard->count, &end);
    return end > 0 && name[end] == '\0' && shard->number >= 1 && shard->number <= shard->count;
}

int study_directory_each_shard(const study_directory *dir, shard_visitor *visit, void *user)
{
    int status = CLI_DONE;
    DIR *directory = opendir(dir->directory);
    if (!directory) return cli_io("read", dir->directory);
    for (struct dirent *entry; status == CLI_DONE && (entry = readdir(directory));) {
        study_shard shard;
        if (is_manifest(entry->d_name, &shard)) status = visit(dir, shard, user);
    }
    closedir(directory);
    return status;
}

static int forget_shard(const study_directory *dir, study_shard shard, void *user)
{
    (void)user;
    char *path = study_directory_manifest(dir, shard);
    int status = file_remove(path);
    free(path);
    return status;
}

/* Removes the study that is there, its description first. */
static int clear(const study_directory *dir)
{
    int status = CLI_DONE;
#define X(name, file)                                                                              \
    if (status == CLI_DONE) status = remove_all(dir->name, 2);
    STUDY_FILE_LIST(X)
#undef X
    return status == CLI_DONE ? study_directory_each_shard(dir, forget_shard, NULL) : status;
}

int study_shard_has(study_shard shard, int cell)
{
    return shard.count <= 0 || cell % shard.count == shard.number - 1;
}

static int join_shard(const study_directory *dir, study_shard shard, void *user)
{
    study_plan *plan = user;
    (void)dir;
    for (int i = 0; i < plan->cell_count; i++)
        if (study_shard_has(shard, i)) plan->cells[i].elsewhere = 0;
    return CLI_DONE;
}

/* ---- beginning ---- */

static int equals(const char *path, const char *text, size_t length)
{
    size_t n;
    char *held = file_read(path, &n);
    const int same = held && n == length && memcmp(held, text, n) == 0;
    free(held);
    return same;
}

/* A copy that is there already, of a study joined, must be the same. */
static int copy_system(const study_directory *dir, study_case *e)
{
    size_t length;
    if (!e->is_first || (!e->copy && !cli_is_path(e->name))) return CLI_DONE;
    char *path = study_system_copy(dir->systems, e);
    char *text = file_read(e->copy ? e->copy : e->name, &length);
    int status = text ? CLI_DONE : CLI_IO;
    if (text && !is_there(path))
        status = file_replace(path, text, length, 1);
    else if (text && !equals(path, text, length))
        status =
            cli_fail(CLI_USAGE, "'%s' is of another study: '%s' differs", dir->directory, path);
    free(text);
    free(e->copy);
    e->copy = path;
    return status;
}

static int copy_systems(const study_directory *dir, study_plan *plan)
{
    int status = cli_directory(dir->systems);
    for (int i = 0; i < plan->case_count && status == CLI_DONE; i++) {
        study_case *e = &plan->cases[i];
        status = copy_system(dir, e);
        if (!e->is_first) e->copy = e[-1].copy;
    }
    return status;
}

/* Whether this study may be written there: a new one, or one more shard. */
static int check_place(const study_directory *dir, const char *text, size_t length, int is_shard)
{
    const char *held = is_there(dir->study) ? dir->study : dir->manifest;
    if (!is_there(held)) return CLI_DONE;
    if (is_shard && held == dir->study && !is_there(dir->manifest)) {
        if (equals(dir->study, text, length)) return CLI_DONE;
        return cli_fail(CLI_USAGE, "'%s' is another study; --force writes over it", held);
    }
    return cli_fail(CLI_USAGE,
                    "'%s' is there already: 'dalembert resume %s' resumes it, --force writes "
                    "over it",
                    held, dir->directory);
}

/* What is left of a study that was killed while it was begun, or written over: there is nothing in
 * it to be gone on with. */
static int is_left_over(const study_directory *dir)
{
    if (is_there(dir->study)) return 0;
    char *title = json_file_text(dir->manifest, "study");
    const int is_of_study = title != NULL;
    free(title);
    return is_of_study;
}

static int make(study_directory *dir, study_plan *plan, const char *text, size_t length,
                int is_shard, int force)
{
    const int begin_anew = force || is_left_over(dir);
    int status = begin_anew ? clear(dir) : check_place(dir, text, length, is_shard);
    if (status == CLI_DONE) status = cli_directory(dir->runs);
    if (status == CLI_DONE) status = copy_systems(dir, plan);
    if (status == CLI_DONE) status = study_directory_write_manifest(dir, plan, "running");
    return status == CLI_DONE ? file_replace(dir->study, text, length, 1) : status;
}

/* Shards that begin in one directory at the same time come one after the other: the descriptor of
 * a locked file, -1 where that cannot be had (some network file systems know no locks). */
static int lock(const study_directory *dir)
{
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    char *path = cli_join(dir->directory, "lock");
    const int descriptor = open(path, O_RDWR | O_CREAT, 0666);
    if (descriptor >= 0) fcntl(descriptor, F_SETLKW, &whole);
    free(path);
    return descriptor;
}

int study_directory_begin(study_directory *dir, study_plan *plan, const char *text, size_t length,
                          study_shard shard, int force)
{
    int status = cli_directory(dir->directory);
    if (status != CLI_DONE) return status;
    plan->runs = dir->runs;
    dir->shard = shard;
    for (int i = 0; i < plan->cell_count; i++)
        plan->cells[i].elsewhere = !study_shard_has(shard, i);
    const int locked = lock(dir);
    status = make(dir, plan, text, length, shard.count > 0, force);
    if (locked >= 0) close(locked);
    return status;
}

/* ---- reading ---- */

int study_directory_read(study_directory *dir, study_plan *plan)
{
    if (!is_there(dir->study))
        return cli_fail(CLI_USAGE, "'%s' holds no study: there is no %s", dir->directory,
                        dir->study);
    dir->text = file_read(dir->study, &dir->length);
    if (!dir->text) return CLI_IO;
    int status = study_plan_read(plan, dir->study, dir->text, dir->length, dir->systems);
    plan->runs = dir->runs;
    if (status != CLI_DONE || is_there(dir->manifest)) return status;
    dir->shard = (study_shard){.count = STUDY_ALL_SHARDS};
    for (int i = 0; i < plan->cell_count; i++) plan->cells[i].elsewhere = 1;
    return study_directory_each_shard(dir, join_shard, plan);
}
