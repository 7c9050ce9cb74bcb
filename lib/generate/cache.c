/* cache.c - compiled steps kept in a private directory.
 *
 * An object is called after a hash of its text and of the command that compiles it, and ends, where
 * no loader looks, in a hash of its own bytes: what was cut short or changed is compiled anew.  It
 * is written under a name of its own and renamed, so that two processes never see half of one. */
#include "generate/cache.h"
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

/* How it is compiled; the bits do not depend on it.  No -march: the directory may be shared by
 * machines. */
static const char *const command[] = {"cc", "-x",      "c",     "-std=gnu11",       "-O2",
                                      "-w", "-shared", "-fPIC", "-ffp-contract=off"};
enum { WORDS = sizeof command / sizeof *command, PATH_SIZE = 1024, PATIENCE = 60 /* seconds */ };

/* FNV-1a, 64 bits. */
static uint64_t hash(uint64_t h, const char *bytes, size_t length)
{
    for (size_t i = 0; i < length; i++) h = (h ^ (unsigned char)bytes[i]) * 0x100000001b3u;
    return h;
}

static dal_status failed(dal_error *error, const char *what, const char *path)
{
    return dal__error(error, DAL_IO, 0, 0, "cannot %s '%.200s': %s", what, path, strerror(errno));
}

static dal_status make_private(const char *directory, dal_error *error)
{
    struct stat s;
    if (mkdir(directory, 0700) != 0 && errno != EEXIST)
        return failed(error, "make the directory", directory);
    if (lstat(directory, &s) != 0) return failed(error, "look at", directory);
    if (!S_ISDIR(s.st_mode) || s.st_uid != geteuid() || (s.st_mode & 077) != 0)
        return dal__error(error, DAL_IO, 0, 0,
                          "'%.200s' is not a directory of this user alone (mode 0700)", directory);
    return DAL_OK;
}

/* ---- whole files ---- */

static char *read_all(const char *path, size_t *length)
{
    struct stat s;
    const int file = open(path, O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
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

static bool write_all(int file, const char *bytes, size_t length)
{
    while (length > 0) {
        const ssize_t put = write(file, bytes, length);
        if (put < 0 && errno == EINTR) continue;
        if (put <= 0) return false;
        bytes += put;
        length -= (size_t)put;
    }
    return true;
}

static dal_status write_new(const char *path, const char *bytes, size_t length, dal_error *error)
{
    const int file = open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (file < 0) return failed(error, "write", path);
    const bool written = write_all(file, bytes, length);
    return close(file) == 0 && written ? DAL_OK : failed(error, "write", path);
}

/* ---- the compiler ---- */

/* Waits for a process, at most PATIENCE; its exit status, or -1. */
static int wait_for(pid_t process)
{
    const struct timespec pause = {0, 1000000};
    int status;
    for (long tick = 0;; tick++) {
        const pid_t ended = waitpid(process, &status, tick < PATIENCE * 1000L ? WNOHANG : 0);
        if (ended == process) return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        if (ended < 0 && errno != EINTR) return -1;
        if (tick == PATIENCE * 1000L - 1) kill(-process, SIGKILL); /* and what it started */
        nanosleep(&pause, NULL);
    }
}

/* Starts a command without input and output, as the head of a process group; 0 or an errno. */
static int start(char **words, pid_t *process)
{
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    if (posix_spawn_file_actions_init(&actions) != 0) return ENOMEM;
    int refused = posix_spawnattr_init(&attributes);
    if (!refused) {
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
        for (int file = 0; file < 3; file++)
            posix_spawn_file_actions_addopen(&actions, file, "/dev/null", O_RDWR, 0);
        refused = posix_spawnp(process, words[0], &actions, &attributes, words, environ);
        posix_spawnattr_destroy(&attributes);
    }
    posix_spawn_file_actions_destroy(&actions);
    return refused;
}

static dal_status compile(const char *source, const char *object, dal_error *error)
{
    char *words[WORDS + 5];
    pid_t process;
    int n = 0;
    for (; n < WORDS; n++) words[n] = (char *)command[n];
    words[n++] = (char *)source;
    words[n++] = (char *)"-o";
    words[n++] = (char *)object;
    words[n++] = (char *)"-lm";
    words[n] = NULL;
    const int refused = start(words, &process);
    if (refused)
        return dal__error(error, DAL_UNSUPPORTED, 0, 0, "no compiler '%s': %s", words[0],
                          strerror(refused));
    const int status = wait_for(process);
    if (status == 0) return DAL_OK;
    return dal__error(error, DAL_UNSUPPORTED, 0, 0,
                      status == 127 ? "no compiler '%s'" : "the compiler '%s' failed", words[0]);
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
    const uint64_t sum = bytes ? hash(0, bytes, length) : 0;
    free(bytes);
    const int file = open(path, O_WRONLY | O_APPEND | O_CLOEXEC);
    if (!bytes || file < 0) {
        if (file >= 0) close(file);
        return failed(error, "seal", path);
    }
    const bool written = write_all(file, (const char *)&sum, sizeof sum);
    return close(file) == 0 && written ? DAL_OK : failed(error, "seal", path);
}

static dal_status make_object(const char *text, const char *path, dal_error *error)
{
    char source[PATH_SIZE + 40], object[PATH_SIZE + 40];
    const void *mine = source; /* differs from thread to thread, as the process's number does not */
    snprintf(source, sizeof source, "%s.%ld.%p.c", path, (long)getpid(), mine);
    snprintf(object, sizeof object, "%s.%ld.%p.so", path, (long)getpid(), mine);
    dal_status status = write_new(source, text, strlen(text), error);
    if (status == DAL_OK) status = compile(source, object, error);
    if (status == DAL_OK) status = seal(object, error);
    if (status == DAL_OK && rename(object, path) != 0) status = failed(error, "write", path);
    unlink(source);
    if (status != DAL_OK) unlink(object);
    return status;
}

dal_status dal__cache_object(const char *directory, const char *text, char *path, size_t size,
                             dal_error *error)
{
    const size_t length = strlen(text);
    uint64_t one = hash(UINT64_C(0xcbf29ce484222325), text, length), two = hash(1, text, length);
    for (int i = 0; i < WORDS; i++) one = hash(one, command[i], strlen(command[i]) + 1);
    if (size > PATH_SIZE) size = PATH_SIZE;
    if ((size_t)snprintf(path, size, "%s/%016llx%016llx.so", directory, (unsigned long long)one,
                         (unsigned long long)two) >= size)
        return dal__error(error, DAL_ARGUMENT, 0, 0, "the path '%.80s...' is too long", directory);
    DAL_TRY(make_private(directory, error));
    return is_whole(path) ? DAL_OK : make_object(text, path, error);
}

void dal__cache_forget(const char *path) { unlink(path); }
