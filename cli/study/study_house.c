/* study_house.c - the directory of a study: begun, joined, read. */
#include "study_house.h"

#include "io/file.h"
#include "io/json.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

void house_open(study_house *house, const char *directory)
{
    *house = (study_house){.directory = directory};
#define X(name, file) house->name = cli_join(directory, file);
    HOUSE_FILE_LIST(X)
#undef X
}

void house_close(study_house *house)
{
#define X(name, file) free(house->name);
    HOUSE_FILE_LIST(X)
#undef X
    free(house->text);
    *house = (study_house){0};
}

static int is_there(const char *path) { return access(path, F_OK) == 0; }

int house_holds_study(const study_house *house) { return is_there(house->study); }

int house_is_finished(const study_house *house)
{
    if (!is_there(house->study)) return 0;
    char *state = json_file_text(house->manifest, "status");
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

char *house_manifest(const study_house *house, study_shard shard)
{
    char name[64];
    if (shard.count == 0) return cli_strdup(house->manifest);
    snprintf(name, sizeof name, "shard-%lld-of-%lld.json", shard.number, shard.count);
    return cli_join(house->directory, name);
}

static int is_manifest(const char *name, study_shard *shard)
{
    int end = 0;
    sscanf(name, "shard-%lld-of-%lld.json%n", &shard->number, &shard->count, &end);
    return end > 0 && name[end] == '\0' && shard->number >= 1 && shard->number <= shard->count;
}

int house_each_shard(const study_house *house, house_visitor *visit, void *user)
{
    int status = CLI_DONE;
    DIR *directory = opendir(house->directory);
    if (!directory) return cli_io("read", house->directory);
    for (struct dirent *entry; status == CLI_DONE && (entry = readdir(directory));) {
        study_shard shard;
        if (is_manifest(entry->d_name, &shard)) status = visit(house, shard, user);
    }
    closedir(directory);
    return status;
}

static int forget_shard(const study_house *house, study_shard shard, void *user)
{
    (void)user;
    char *path = house_manifest(house, shard);
    int status = file_remove(path);
    free(path);
    return status;
}

/* Removes the study that is there, its description first. */
static int clear(const study_house *house)
{
    int status = CLI_DONE;
#define X(name, file)                                                                              \
    if (status == CLI_DONE) status = remove_all(house->name, 2);
    HOUSE_FILE_LIST(X)
#undef X
    return status == CLI_DONE ? house_each_shard(house, forget_shard, NULL) : status;
}

int house_is_of(study_shard shard, int cell)
{
    return shard.count <= 0 || cell % shard.count == shard.number - 1;
}

static int join_shard(const study_house *house, study_shard shard, void *user)
{
    study_plan *plan = user;
    (void)house;
    for (int i = 0; i < plan->cell_count; i++)
        if (house_is_of(shard, i)) plan->cells[i].elsewhere = 0;
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
static int copy_system(const study_house *house, study_entry *e)
{
    size_t length;
    if (!e->is_first || (!e->copy && !cli_is_path(e->name))) return CLI_DONE;
    char *path = study_system_copy(house->systems, e);
    char *text = file_read(e->copy ? e->copy : e->name, &length);
    int status = text ? CLI_DONE : CLI_IO;
    if (text && !is_there(path))
        status = file_replace(path, text, length);
    else if (text && !equals(path, text, length))
        status =
            cli_fail(CLI_USAGE, "'%s' is of another study: '%s' differs", house->directory, path);
    free(text);
    free(e->copy);
    e->copy = path;
    return status;
}

static int copy_systems(const study_house *house, study_plan *plan)
{
    int status = cli_directory(house->systems);
    for (int i = 0; i < plan->entry_count && status == CLI_DONE; i++) {
        study_entry *e = &plan->entries[i];
        status = copy_system(house, e);
        if (!e->is_first) e->copy = e[-1].copy;
    }
    return status;
}

/* Whether this study may be written there: a new one, or one more shard. */
static int check_place(const study_house *house, const char *text, size_t length, int is_shard)
{
    const char *held = is_there(house->study) ? house->study : house->manifest;
    if (!is_there(held)) return CLI_DONE;
    if (is_shard && held == house->study && !is_there(house->manifest)) {
        if (equals(house->study, text, length)) return CLI_DONE;
        return cli_fail(CLI_USAGE, "'%s' is another study; --force writes over it", held);
    }
    return cli_fail(CLI_USAGE,
                    "'%s' is there already: 'dalembert resume %s' goes on with it, --force writes "
                    "over it",
                    held, house->directory);
}

/* What is left of a study that was killed while it was begun, or written over: there is nothing in
 * it to be gone on with. */
static int is_left_over(const study_house *house)
{
    if (is_there(house->study)) return 0;
    char *title = json_file_text(house->manifest, "study");
    const int is_of_study = title != NULL;
    free(title);
    return is_of_study;
}

static int make(study_house *house, study_plan *plan, const char *text, size_t length, int is_shard,
                int force)
{
    const int begin_anew = force || is_left_over(house);
    int status = begin_anew ? clear(house) : check_place(house, text, length, is_shard);
    if (status == CLI_DONE) status = cli_directory(house->runs);
    if (status == CLI_DONE) status = copy_systems(house, plan);
    if (status == CLI_DONE) status = house_tell(house, plan, "running");
    return status == CLI_DONE ? file_replace(house->study, text, length) : status;
}

/* Shards that begin in one directory at the same time come one after the other: the descriptor of
 * a locked file, -1 where that cannot be had (some network file systems know no locks). */
static int lock(const study_house *house)
{
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    char *path = cli_join(house->directory, "lock");
    const int descriptor = open(path, O_RDWR | O_CREAT, 0666);
    if (descriptor >= 0) fcntl(descriptor, F_SETLKW, &whole);
    free(path);
    return descriptor;
}

int house_begin(study_house *house, study_plan *plan, const char *text, size_t length,
                study_shard shard, int force)
{
    int status = cli_directory(house->directory);
    if (status != CLI_DONE) return status;
    plan->runs = house->runs;
    house->shard = shard;
    for (int i = 0; i < plan->cell_count; i++) plan->cells[i].elsewhere = !house_is_of(shard, i);
    const int locked = lock(house);
    status = make(house, plan, text, length, shard.count > 0, force);
    if (locked >= 0) close(locked);
    return status;
}

/* ---- reading ---- */

int house_read(study_house *house, study_plan *plan)
{
    if (!is_there(house->study))
        return cli_fail(CLI_USAGE, "'%s' holds no study: there is no %s", house->directory,
                        house->study);
    house->text = file_read(house->study, &house->length);
    if (!house->text) return CLI_IO;
    int status = study_plan_read(plan, house->study, house->text, house->length, house->systems);
    plan->runs = house->runs;
    if (status != CLI_DONE || is_there(house->manifest)) return status;
    house->shard = (study_shard){.count = HOUSE_SHARDS};
    for (int i = 0; i < plan->cell_count; i++) plan->cells[i].elsewhere = 1;
    return house_each_shard(house, join_shard, plan);
}
