/* cache.c - compiled code in a private directory.
 *
 * The name of an object is a key, by which one finds whether making its text is worth it, and a
 * hash of its text and of the command that compiles it.  A hash of its own bytes follows at its
 * end, where loaders do not read, so that a truncated or changed object is compiled again; so is
 * one that is no regular file, or that another user owns or may write.
 *
 * An object is written elsewhere and renamed, so that no process sees a part of it: in a folder of
 * its compilation alone, OBJECT.so.XXXXXX, with the compiler's temporary files.  The source there
 * is locked as long as the compiler or the process that waits for it lives.  A folder whose source
 * nobody has locked was left by processes that were killed; the next compilation removes it. */
#include "jit/cache.h"
#include "core/machine.h"
#include "dalembert_program.h"
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

extern char **environ;

/* Compiler options; the bits do not depend on them.  Options of the machine belong to the name of
 * the object, since machines may share a directory.  Without -s it holds the name of its source. */
static const char *const usual[] = {"-x",
                                    "c",
                                    "-std=gnu11",
                                    "-O2",
                                    "-w",
                                    "-shared",
                                    "-fPIC",
                                    "-ffp-contract=off",
                                    "-fno-math-errno", /* square roots in vectors, too */
                                    "-s",
                                    NULL};
static const char *const machine[][8] = {
#define SET(set, ...) {__VA_ARGS__},
    DAL__INSTRUCTIONS_LIST(SET)
#undef SET
};
enum { PATIENCE = 60 /* seconds */ };

/* A command. */
typedef struct command {
    char *word[32]; /* not const for posix_spawn, which does not change it */
    int words;
} command;

static void add_word(command *c, const char *word) { c->word[c->words++] = (char *)word; }

static void add_words(command *c, const char *const *words)
{
    while (*words) add_word(c, *words++);
}

/* The command without its files. */
static command begin_command(const char *compiler)
{
    command c = {.words = 0};
    add_word(&c, compiler);
    add_words(&c, usual);
    add_words(&c, machine[dal__machine_best()]);
    return c;
}

static dal_status failed(dal_error *error, const char *what, const char *path)
{
    return dal__fail(error, DAL_STATUS_IO, "cannot %s '%.200s': %s", what, path, strerror(errno));
}

static dal_status make_private(const char *directory, dal_error *error)
{
    struct stat s;
    if (mkdir(directory, 0700) != 0 && errno != EEXIST)
        return failed(error, "make the directory", directory);
    if (lstat(directory, &s) != 0) return failed(error, "examine", directory);
    if (!S_ISDIR(s.st_mode) || s.st_uid != geteuid() || (s.st_mode & 077) != 0)
        return dal__fail(error, DAL_STATUS_IO,
                         "'%.200s' is not a directory of this user alone (mode 0700)", directory);
    return DAL_STATUS_OK;
}

/* ---- whole files ---- */

/* Opens a file to be read; does not wait for the writer of a FIFO. */
static int open_file(const char *path)
{
    return open(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
}

/* Reads a regular file that this user alone can have written. */
static char *read_all(int file, size_t *length)
{
    struct stat s;
    char *bytes = NULL;
    *length = 0;
    if (fstat(file, &s) == 0 && S_ISREG(s.st_mode) && s.st_uid == geteuid() &&
        (s.st_mode & (S_IWGRP | S_IWOTH)) == 0)
        bytes = malloc((size_t)s.st_size + 1);
    while (bytes && *length < (size_t)s.st_size) {
        const ssize_t got = read(file, bytes + *length, (size_t)s.st_size - *length);
        if (got <= 0) break;
        *length += (size_t)got;
    }
    return bytes;
}

static bool write_all(int file, const void *bytes, size_t length)
{
    bool written = true;
    for (const char *at = bytes; written && length > 0;) {
        const ssize_t put = write(file, at, length);
        written = put > 0 || (put < 0 && errno == EINTR);
        at += put > 0 ? put : 0;
        length -= put > 0 ? (size_t)put : 0;
    }
    return written;
}

/* ---- the compiler ---- */

/* Seconds since some time. */
static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Starts a command without input and output, as leader of a process group, with its temporary files
 * in a folder and with a lock; returns 0 or an errno. */
static int start_process(const command *c, const char *folder, int lock, pid_t *process)
{
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    char variable[DAL__OBJECT_PATH + 60];
    size_t count = 0, kept = 0;
    while (environ && environ[count]) count++;
    char **const environment = calloc(count + 2, sizeof *environment);
    int refused = environment ? posix_spawn_file_actions_init(&actions) : ENOMEM;
    if (refused) return free(environment), refused;
    for (size_t i = 0; i < count; i++)
        if (strncmp(environ[i], "TMPDIR=", 7) != 0) environment[kept++] = environ[i];
    snprintf(variable, sizeof variable, "TMPDIR=%s", folder);
    environment[kept] = variable;
    refused = posix_spawnattr_init(&attributes);
    if (!refused) {
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
        for (int file = 0; file < 3; file++)
            posix_spawn_file_actions_addopen(&actions, file, "/dev/null", O_RDWR, 0);
        posix_spawn_file_actions_adddup2(&actions, lock, lock); /* inherited, with the lock */
        refused = posix_spawnp(process, c->word[0], &actions, &attributes, c->word, environment);
        posix_spawnattr_destroy(&attributes);
    }
    posix_spawn_file_actions_destroy(&actions);
    free(environment);
    return refused;
}

static dal_status start_compiler(dal__compilation *c, dal_error *error)
{
    const char *const files[] = {c->source, "-o", c->object, "-lm", NULL};
    command full = begin_command(c->compiler);
    pid_t process = 0;
    add_words(&full, files);
    const int refused = start_process(&full, c->folder, c->lock, &process);
    if (refused == ENOMEM) return dal__memory_error(error);
    if (refused)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED, "no compiler '%.200s': %s", c->compiler,
                         strerror(refused));
    if (c->nice > 0) setpriority(PRIO_PGRP, (id_t)process, getpriority(PRIO_PROCESS, 0) + c->nice);
    c->process = process;
    c->last = now() + c->patience;
    return DAL_STATUS_OK;
}

/* Whether the compiler runs no more; *exit_status is -1 where a signal ended it. */
static bool has_ended(dal__compilation *c, int *exit_status)
{
    int status;
    const pid_t ended = waitpid((pid_t)c->process, &status, WNOHANG);
    if (ended == 0 || (ended < 0 && errno == EINTR)) return false;
    *exit_status = ended > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    c->process = 0;
    return true;
}

/* ---- objects ---- */

/* Whether the last eight bytes are the hash of those before. */
static bool is_whole(int file)
{
    size_t length;
    char *bytes = read_all(file, &length);
    uint64_t stored = 0, found = 1;
    if (bytes && length > sizeof stored) {
        memcpy(&stored, bytes + length - sizeof stored, sizeof stored);
        found = dal__hash(0, bytes, length - sizeof stored);
    }
    free(bytes);
    return stored == found;
}

static bool is_usable(const char *path)
{
    const int file = open_file(path);
    const bool usable = file >= 0 && is_whole(file);
    if (file >= 0) close(file);
    return usable;
}

/* The loader opens the file by its name; what it opens is what was checked, unless this user, whose
 * directory it is, replaces it meanwhile.  Names like /proc/self/fd/3 are no way out: loaders take
 * equal names for one object. */
void *dal__compilation_load(const dal__compilation *c)
{
    struct stat checked, now;
    const int file = open_file(c->path);
    if (file < 0) return NULL;
    const bool usable = is_whole(file) && fstat(file, &checked) == 0 && stat(c->path, &now) == 0 &&
                        checked.st_dev == now.st_dev && checked.st_ino == now.st_ino;
    void *handle = usable ? dlopen(c->path, RTLD_NOW | RTLD_LOCAL) : NULL;
    close(file);
    return handle;
}

/* Appends the hash of an object, and takes from others what a mask of the user gave them. */
static dal_status seal(const char *path, dal_error *error)
{
    size_t length;
    const int file = open(path, O_RDWR | O_APPEND | O_NOFOLLOW | O_CLOEXEC);
    char *bytes = file >= 0 && fchmod(file, 0700) == 0 ? read_all(file, &length) : NULL;
    const uint64_t sum = bytes ? dal__hash(0, bytes, length) : 0;
    const bool sealed = bytes && write_all(file, &sum, sizeof sum);
    free(bytes);
    const bool closed = file >= 0 && close(file) == 0;
    return sealed && closed ? DAL_STATUS_OK : failed(error, "seal", path);
}

enum { KEY_DIGITS = 16, NAME_DIGITS = 48 }; /* of names, the key included */

/* A path that no compiler takes for an option, and no loader for a name to search for. */
static dal_status name_object(const command *c, const char *directory, uint64_t key,
                              const char *text, char *path, dal_error *error)
{
    const size_t length = strlen(text);
    uint64_t one = dal__hash(DAL__HASH_START, text, length), two = dal__hash(1, text, length);
    for (int i = 0; i < c->words; i++) one = dal__hash(one, c->word[i], strlen(c->word[i]) + 1);
    const int written = snprintf(
        path, DAL__OBJECT_PATH, "%s%s/%016llx%016llx%016llx.so", directory[0] == '/' ? "" : "./",
        directory, (unsigned long long)key, (unsigned long long)one, (unsigned long long)two);
    if (written > 0 && written < DAL__OBJECT_PATH) return DAL_STATUS_OK;
    return dal__fail(error, DAL_STATUS_ARGUMENT, "the path '%.80s...' is too long", directory);
}

/* ---- folders of compilations ---- */

static const char source_name[] = "code.c", object_name[] = "code.so";

/* Removes what a folder holds, the source last, since its lock says that the folder is in use. */
static void empty_folder(const char *path)
{
    DIR *folder = opendir(path);
    for (const struct dirent *entry; folder && (entry = readdir(folder));)
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0 &&
            strcmp(entry->d_name, source_name) != 0)
            unlinkat(dirfd(folder), entry->d_name, 0);
    if (folder) closedir(folder);
}

/* Removes the folder with all files in it.  opendir, which allocates, is called only where the
 * compiler has left files of its own. */
static void clean_up(dal__compilation *c)
{
    unlink(c->object);
    unlink(c->source);
    if (rmdir(c->folder) != 0) {
        empty_folder(c->folder);
        rmdir(c->folder);
    }
    if (c->lock >= 0) close(c->lock);
    c->lock = -1;
}

/* Removes a folder unless its source is locked; one without a source, if it is empty. */
static void remove_abandoned(const char *folder)
{
    char source[DAL__OBJECT_PATH + 60];
    snprintf(source, sizeof source, "%s/%s", folder, source_name);
    const int lock = open(source, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (lock >= 0 && flock(lock, LOCK_EX | LOCK_NB) == 0) {
        empty_folder(folder);
        unlink(source);
    }
    rmdir(folder);
    if (lock >= 0) close(lock);
}

static size_t digits_of(const char *name) { return strspn(name, "0123456789abcdef"); }

/* Removes the folders that processes left which were killed, named by a hash, ".so." and more. */
static void remove_all_abandoned(const char *directory)
{
    char path[DAL__OBJECT_PATH + 40];
    DIR *cache = opendir(directory);
    for (const struct dirent *entry; cache && (entry = readdir(cache));) {
        if (digits_of(entry->d_name) != NAME_DIGITS ||
            strncmp(entry->d_name + NAME_DIGITS, ".so.", 4) != 0)
            continue;
        const int length = snprintf(path, sizeof path, "%s/%s", directory, entry->d_name);
        if (length > 0 && (size_t)length < sizeof path) remove_abandoned(path);
    }
    if (cache) closedir(cache);
}

/* Makes the source in a new folder and locks it.  Another process may have found the folder before
 * it was locked, and removed it.  Where files cannot be locked nothing is removed either. */
static bool make_source(dal__compilation *c)
{
    struct stat made, now;
    snprintf(c->folder, sizeof c->folder, "%s.XXXXXX", c->path);
    if (!mkdtemp(c->folder)) return false;
    snprintf(c->source, sizeof c->source, "%s/%s", c->folder, source_name);
    snprintf(c->object, sizeof c->object, "%s/%s", c->folder, object_name);
    c->lock = open(c->source, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    const bool locked =
        c->lock >= 0 && (flock(c->lock, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK);
    if (locked && fstat(c->lock, &made) == 0 && stat(c->source, &now) == 0 &&
        made.st_ino == now.st_ino)
        return true;
    const int reason = errno;
    clean_up(c);
    errno = reason;
    return false;
}

/* ---- compilations ---- */

static dal_status start(dal__compilation *c, const char *text, dal_error *error)
{
    enum { TRIALS = 4 };
    struct stat s;
    bool made = false;
    if (lstat(c->path, &s) == 0 && S_ISDIR(s.st_mode)) /* a rename replaces all else */
        return dal__fail(error, DAL_STATUS_IO, "'%.200s' is in the way: it is a directory",
                         c->path);
    for (int i = 0; i < TRIALS && !made; i++) made = make_source(c);
    if (!made) return failed(error, "make the directory", c->folder);
    dal_status status = DAL_STATUS_OK;
    if (!write_all(c->lock, text, strlen(text))) status = failed(error, "write", c->source);
    if (status == DAL_STATUS_OK) status = start_compiler(c, error);
    if (status != DAL_STATUS_OK) clean_up(c);
    return status;
}

bool dal__compilation_is_likely(const dal_native_options *options, uint64_t key)
{
    char digits[KEY_DIGITS + 1];
    snprintf(digits, sizeof digits, "%016llx", (unsigned long long)key);
    DIR *cache = options && options->cache ? opendir(options->cache) : NULL;
    bool found = false;
    for (const struct dirent *entry; cache && !found && (entry = readdir(cache));)
        found = strncmp(entry->d_name, digits, KEY_DIGITS) == 0 &&
                digits_of(entry->d_name) == NAME_DIGITS &&
                strcmp(entry->d_name + NAME_DIGITS, ".so") == 0;
    if (cache) closedir(cache);
    return found;
}

dal_status dal__compilation_begin(dal__compilation *c, const dal_native_options *options,
                                  uint64_t key, const char *text, dal_error *error)
{
    if (!options || !options->cache || !options->cache[0])
        return dal__fail(error, DAL_STATUS_ARGUMENT, "no directory for compiled steps");
    const char *const compiler = options->compiler ? options->compiler : "cc";
    *c = (dal__compilation){.patience = options->patience > 0 ? options->patience : PATIENCE,
                            .nice = options->nice,
                            .lock = -1};
    if (strlen(compiler) >= sizeof c->compiler)
        return dal__fail(error, DAL_STATUS_ARGUMENT, "the path '%.80s...' is too long", compiler);
    snprintf(c->compiler, sizeof c->compiler, "%s", compiler);
    const command words = begin_command(c->compiler);
    DAL_TRY(name_object(&words, options->cache, key, text, c->path, error));
    DAL_TRY(make_private(options->cache, error));
    remove_all_abandoned(options->cache);
    if (is_usable(c->path)) return DAL_STATUS_OK;
    return options->only_cached
               ? dal__fail(error, DAL_STATUS_UNSUPPORTED, "the cache has no such code")
               : start(c, text, error);
}

void dal__compilation_forget(const dal__compilation *c) { unlink(c->path); }

dal_status dal__compilation_repeat(dal__compilation *c, const char *text, dal_error *error)
{
    dal__compilation_forget(c);
    return start(c, text, error);
}

static dal_status keep_object(const dal__compilation *c, int exit_status, dal_error *error)
{
    if (exit_status != 0)
        return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                         exit_status == 127 ? "no compiler '%.200s'"
                                            : "the compiler '%.200s' failed",
                         c->compiler);
    DAL_TRY(seal(c->object, error));
    return rename(c->object, c->path) == 0 ? DAL_STATUS_OK : failed(error, "write", c->path);
}

dal_status dal__compilation_poll(dal__compilation *c, dal_error *error)
{
    int exit_status;
    if (!c->process) return DAL_STATUS_OK;
    if (has_ended(c, &exit_status)) {
        const dal_status status = keep_object(c, exit_status, error);
        clean_up(c);
        return status;
    }
    if (now() < c->last) return DAL_STATUS_OK;
    dal__compilation_end(c);
    return dal__fail(error, DAL_STATUS_UNSUPPORTED,
                     "the compiler '%.200s' was ended after %d seconds", c->compiler, c->patience);
}

void dal__compilation_end(dal__compilation *c)
{
    int status;
    if (!c->process) return;
    kill(-(pid_t)c->process, SIGKILL); /* with all that it started */
    while (waitpid((pid_t)c->process, &status, 0) < 0 && errno == EINTR) continue;
    c->process = 0;
    clean_up(c);
}

void dal__compilation_pause(void)
{
    const struct timespec pause = {0, 1000000};
    nanosleep(&pause, NULL);
}
