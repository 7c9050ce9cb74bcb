/* cache.c - compiled code in a private directory.
 *
 * The name of an object is a hash of its text and of the command that compiles it.  A hash of its
 * own bytes follows at its end, where loaders do not read, so that a truncated or changed object is
 * compiled again.  It is written under a temporary name and renamed, so that no process sees a part
 * of it. */
#include "jit/cache.h"
#include "core/machine.h"
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

extern char **environ;

/* Compiler options; the bits do not depend on them.  Those of the machine are a part of the name of
 * the object, since machines may share a directory. */
static const char *const usual[] = {"-x",      "c",     "-std=gnu11",        "-O2", "-w",
                                    "-shared", "-fPIC", "-ffp-contract=off", NULL};
static const char *const machine[][8] = {
#define SET(set, ...) {__VA_ARGS__},
    DAL__INSTRUCTIONS_LIST(SET)
#undef SET
};
enum { PATH_SIZE = 1024, PATIENCE = 60 /* seconds */ };

/* A command. */
typedef struct command {
    char *word[32]; /* not const for posix_spawn, which does not change it */
    int words, patience;
    int (*stop)(void *user);
    void *user;
} command;

static void add_word(command *c, const char *word) { c->word[c->words++] = (char *)word; }

static void add_words(command *c, const char *const *words)
{
    while (*words) add_word(c, *words++);
}

/* The command without its files. */
static command begin_command(const dal_native_options *options)
{
    command c = {.patience = options->patience > 0 ? options->patience : PATIENCE,
                 .stop = options->stop,
                 .user = options->user};
    add_word(&c, options->compiler ? options->compiler : "cc");
    add_words(&c, usual);
    add_words(&c, machine[dal__machine_best()]);
    return c;
}

/* FNV-1a, 64 bits. */
static uint64_t hash(uint64_t h, const char *bytes, size_t length)
{
    for (size_t i = 0; i < length; i++) h = (h ^ (unsigned char)bytes[i]) * 0x100000001b3u;
    return h;
}

static dal_status failed(dal_error *error, const char *what, const char *path)
{
    return dal__fail(error, DAL_IO, "cannot %s '%.200s': %s", what, path, strerror(errno));
}

static dal_status make_private(const char *directory, dal_error *error)
{
    struct stat s;
    if (mkdir(directory, 0700) != 0 && errno != EEXIST)
        return failed(error, "make the directory", directory);
    if (lstat(directory, &s) != 0) return failed(error, "record at", directory);
    if (!S_ISDIR(s.st_mode) || s.st_uid != geteuid() || (s.st_mode & 077) != 0)
        return dal__fail(error, DAL_IO,
                         "'%.200s' is not a directory of this user alone (mode 0700)", directory);
    return DAL_OK;
}

/* ---- whole files ---- */

/* Reads a regular file; does not wait for the writer of a FIFO. */
static char *read_all(const char *path, size_t *length)
{
    struct stat s;
    const int file = open(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    char *bytes = NULL;
    *length = 0;
    if (file < 0) return NULL;
    if (fstat(file, &s) == 0 && S_ISREG(s.st_mode)) bytes = malloc((size_t)s.st_size + 1);
    while (bytes && *length < (size_t)s.st_size) {
        const ssize_t got = read(file, bytes + *length, (size_t)s.st_size - *length);
        if (got <= 0) break;
        *length += (size_t)got;
    }
    close(file);
    return bytes;
}

/* Opens a file with these flags and writes the bytes; what: how a message calls that. */
static dal_status write_bytes(const char *path, int flags, const char *what, const void *bytes,
                              size_t length, dal_error *error)
{
    const int file = open(path, O_WRONLY | O_CLOEXEC | flags, 0600);
    if (file < 0) return failed(error, what, path);
    bool written = true;
    for (const char *at = bytes; written && length > 0;) {
        const ssize_t put = write(file, at, length);
        written = put > 0 || (put < 0 && errno == EINTR);
        at += put > 0 ? put : 0;
        length -= put > 0 ? (size_t)put : 0;
    }
    return close(file) == 0 && written ? DAL_OK : failed(error, what, path);
}

/* ---- the compiler ---- */

/* The end of a process. */
typedef struct outcome {
    int status; /* exit status, or -1 */
    bool hung, stopped;
} outcome;

/* Seconds since some time. */
static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Waits for a process; past its time, or where the caller stops, it is ended with all that it
 * started. */
static outcome wait_for(const command *c, pid_t process)
{
    const struct timespec pause = {0, 1000000};
    const double last = now() + c->patience;
    outcome out = {.status = -1};
    for (;;) {
        int status;
        const pid_t ended = waitpid(process, &status, out.hung || out.stopped ? 0 : WNOHANG);
        if (ended == process && WIFEXITED(status)) out.status = WEXITSTATUS(status);
        if (ended == process || (ended < 0 && errno != EINTR)) return out;
        if (c->stop && c->stop(c->user))
            out.stopped = kill(-process, SIGKILL) == 0;
        else if (now() >= last)
            out.hung = kill(-process, SIGKILL) == 0;
        nanosleep(&pause, NULL);
    }
}

/* Starts a command without input and output, as leader of a process group; returns 0 or an
 * errno. */
static int start(const command *c, pid_t *process)
{
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    if (posix_spawn_file_actions_init(&actions) != 0) return ENOMEM;
    int refused = posix_spawnattr_init(&attributes);
    if (!refused) {
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
        for (int file = 0; file < 3; file++)
            posix_spawn_file_actions_addopen(&actions, file, "/dev/null", O_RDWR, 0);
        refused = posix_spawnp(process, c->word[0], &actions, &attributes, c->word, environ);
        posix_spawnattr_destroy(&attributes);
    }
    posix_spawn_file_actions_destroy(&actions);
    return refused;
}

static dal_status compile(command c, const char *source, const char *object, dal_error *error)
{
    const char *const name = c.word[0], *const files[] = {source, "-o", object, "-lm", NULL};
    pid_t process;
    add_words(&c, files);
    const int refused = start(&c, &process);
    if (refused)
        return dal__fail(error, DAL_UNSUPPORTED, "no compiler '%.200s': %s", name,
                         strerror(refused));
    const outcome out = wait_for(&c, process);
    if (out.stopped)
        return dal__fail(error, DAL_INTERRUPTED, "the compiler '%.200s' was stopped", name);
    if (out.status == 0) return DAL_OK;
    if (out.hung)
        return dal__fail(error, DAL_UNSUPPORTED, "the compiler '%.200s' was ended after %d seconds",
                         name, c.patience);
    return dal__fail(error, DAL_UNSUPPORTED,
                     out.status == 127 ? "no compiler '%.200s'" : "the compiler '%.200s' failed",
                     name);
}

/* ---- objects ---- */

/* Whether the last eight bytes are the hash of those before. */
static bool is_whole(const char *path)
{
    size_t length;
    char *bytes = read_all(path, &length);
    uint64_t stored = 0, found = 1;
    if (bytes && length > sizeof stored) {
        memcpy(&stored, bytes + length - sizeof stored, sizeof stored);
        found = hash(0, bytes, length - sizeof stored);
    }
    free(bytes);
    return stored == found;
}

static dal_status seal(const char *path, dal_error *error)
{
    size_t length;
    char *bytes = read_all(path, &length);
    if (!bytes) return failed(error, "seal", path);
    const uint64_t sum = hash(0, bytes, length);
    free(bytes);
    return write_bytes(path, O_APPEND, "seal", &sum, sizeof sum, error);
}

static dal_status make_object(const command *c, const char *text, const char *path,
                              dal_error *error)
{
    char source[PATH_SIZE + 40], object[PATH_SIZE + 40];
    const void *mine = source; /* differs between threads of a process */
    snprintf(source, sizeof source, "%s.%ld.%p.c", path, (long)getpid(), mine);
    snprintf(object, sizeof object, "%s.%ld.%p.so", path, (long)getpid(), mine);
    unlink(object);
    dal_status status = write_bytes(source, O_CREAT | O_EXCL, "write", text, strlen(text), error);
    if (status == DAL_OK) status = compile(*c, source, object, error);
    if (status == DAL_OK) status = seal(object, error);
    if (status == DAL_OK && rename(object, path) != 0) status = failed(error, "write", path);
    unlink(source);
    if (status != DAL_OK) unlink(object);
    return status;
}

/* A path that no compiler takes for an option, and no loader for a name to record for. */
static dal_status name_object(const command *c, const char *directory, const char *text, char *path,
                              size_t size, dal_error *error)
{
    const size_t length = strlen(text);
    uint64_t one = hash(UINT64_C(0xcbf29ce484222325), text, length), two = hash(1, text, length);
    for (int i = 0; i < c->words; i++) one = hash(one, c->word[i], strlen(c->word[i]) + 1);
    const int written =
        snprintf(path, size, "%s%s/%016llx%016llx.so", directory[0] == '/' ? "" : "./", directory,
                 (unsigned long long)one, (unsigned long long)two);
    if (written > 0 && (size_t)written < size) return DAL_OK;
    return dal__fail(error, DAL_ARGUMENT, "the path '%.80s...' is too long", directory);
}

dal_status dal__cache_object(const dal_native_options *options, const char *text, char *path,
                             size_t size, dal_error *error)
{
    if (!options || !options->cache || !options->cache[0])
        return dal__fail(error, DAL_ARGUMENT, "no directory for compiled steps");
    const command c = begin_command(options);
    struct stat s;
    DAL_TRY(
        name_object(&c, options->cache, text, path, size < PATH_SIZE ? size : PATH_SIZE, error));
    DAL_TRY(make_private(options->cache, error));
    if (lstat(path, &s) == 0 && S_ISDIR(s.st_mode)) /* a rename replaces all else */
        return dal__fail(error, DAL_IO, "'%.200s' is in the way: it is a directory", path);
    return is_whole(path) ? DAL_OK : make_object(&c, text, path, error);
}

void dal__cache_forget(const char *path) { unlink(path); }
