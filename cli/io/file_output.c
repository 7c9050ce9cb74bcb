/* file_output.c - what a user names as an output, and the files of a directory. */
#include "file_output.h"
#include "dalembert_program.h"

#include "ui/memory.h"
#include "ui/message.h"
#include "ui/signals.h"

#include "file.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

/* N of /dev/fd/N, to which /dev/stdout leads; -1 for other paths. */
static int descriptor_number(const char *path)
{
    static const char *const folder[] = {"/dev/fd/", "/proc/self/fd/"};
    for (size_t i = 0; i < sizeof folder / sizeof *folder; i++) {
        const size_t n = strlen(folder[i]);
        const char *digits = path + n;
        if (strncmp(path, folder[i], n) != 0 || !*digits || strlen(digits) > 5) continue;
        if (digits[strspn(digits, "0123456789")] == '\0') return atoi(digits);
    }
    return -1;
}

/* The path without symbolic links in its last component, which need not exist; allocated. */
static char *follow_links(const char *path)
{
    enum { MAX_LINKS = 40 };
    char text[4096], *at = cli_strdup(path);
    for (int i = 0; i < MAX_LINKS && descriptor_number(at) < 0; i++) {
        const ssize_t n = readlink(at, text, sizeof text);
        if (n <= 0 || n == sizeof text) break;
        const char *slash = strrchr(at, '/');
        const int folder = text[0] != '/' && slash ? (int)(slash - at) + 1 : 0;
        char *next = cli_format("%.*s%.*s", folder, at, (int)n, text);
        free(at);
        at = next;
    }
    return at;
}

static int connect_to(const char *path)
{
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    if (strlen(path) >= sizeof address.sun_path) {
        errno = ENAMETOOLONG;
        return -1;
    }
    strcpy(address.sun_path, path);
    const int descriptor = socket(AF_UNIX, SOCK_STREAM, 0);
    if (descriptor < 0) return -1;
    if (connect(descriptor, (struct sockaddr *)&address, sizeof address) == 0) return descriptor;
    const int reason = errno;
    close(descriptor);
    errno = reason;
    return -1;
}

/* A device, a FIFO or a socket.  Where nobody reads it any more a write fails, with a message. */
static int open_special(const char *path, mode_t mode)
{
    cli_catch_broken_pipe();
    if (S_ISSOCK(mode)) return connect_to(path);
    if (S_ISDIR(mode)) errno = EISDIR;
    return S_ISDIR(mode) ? -1 : open(path, O_WRONLY | O_NOCTTY | O_CLOEXEC);
}

/* Files that are not complete, which the end of the program removes: where memory runs out, that is
 * in the middle of one. */
typedef struct unfinished {
    const char *path; /* the output's */
    struct unfinished *next;
} unfinished;
static unfinished *all_unfinished;
static pthread_mutex_t unfinished_mutex = PTHREAD_MUTEX_INITIALIZER;
static pthread_once_t unfinished_once = PTHREAD_ONCE_INIT;

static void remove_unfinished(void)
{
    pthread_mutex_lock(&unfinished_mutex);
    for (const unfinished *u = all_unfinished; u; u = u->next) unlink(u->path);
    pthread_mutex_unlock(&unfinished_mutex);
}

static void watch_end(void) { atexit(remove_unfinished); }

static void add_unfinished(const char *path)
{
    unfinished *u = cli_malloc(sizeof *u);
    pthread_once(&unfinished_once, watch_end);
    pthread_mutex_lock(&unfinished_mutex);
    *u = (unfinished){path, all_unfinished};
    all_unfinished = u;
    pthread_mutex_unlock(&unfinished_mutex);
}

static void forget_unfinished(const char *path)
{
    pthread_mutex_lock(&unfinished_mutex);
    unfinished **at = &all_unfinished;
    while (*at && (*at)->path != path) at = &(*at)->next;
    unfinished *u = *at;
    if (u) *at = u->next;
    pthread_mutex_unlock(&unfinished_mutex);
    free(u);
}

/* A new file beside o->path, where held[1] is, with its owner and permissions; held NULL: nothing
 * is there yet.  A file in a directory where none can be made is written in place. */
static int open_beside(file_output *o, const struct stat *held)
{
    const char *slash = strrchr(o->path, '/');
    const int folder = slash ? (int)(slash - o->path) + 1 : 0;
    if (held && access(o->path, W_OK) != 0) return -1;
    o->fresh = cli_format("%.*s.%s.new", folder, o->path, o->path + folder);
    unlink(o->fresh); /* of a process that was killed */
    add_unfinished(o->fresh);
    const int descriptor = open(o->fresh, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0 && held) { /* as far as this user may set them */
        if (fchown(descriptor, held->st_uid, held->st_gid) != 0 &&
            fchown(descriptor, (uid_t)-1, held->st_gid) != 0)
            errno = 0;
        fchmod(descriptor, held->st_mode & 0777);
    }
    if (descriptor >= 0) return descriptor;
    const int reason = errno;
    forget_unfinished(o->fresh);
    free(o->fresh);
    o->fresh = NULL;
    errno = reason;
    if (!held || (reason != EACCES && reason != EROFS)) return -1;
    return open(o->path, O_RDWR | O_TRUNC | O_CLOEXEC);
}

/* A descriptor, or -1 and the status after a message.  end_output() is due in either case.  Between
 * cli_hold_exit() and cli_release_exit(), as end_output() is: a thread that ends the program has
 * then removed this file, or never will. */
static int begin_output(file_output *o, const char *name, int *descriptor)
{
    struct stat held;
    *o = (file_output){.name = name, .path = follow_links(name)};
    const int number = descriptor_number(o->path);
    const bool exists = stat(name, &held) == 0;
    if (number >= 0) {
        cli_catch_broken_pipe();
        *descriptor = fcntl(number, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    } else if (exists && !S_ISREG(held.st_mode)) {
        *descriptor = open_special(name, held.st_mode);
    } else {
        *descriptor = open_beside(o, exists ? &held : NULL);
    }
    return *descriptor < 0 ? cli_io("write", name) : CLI_DONE;
}

/* Gives the file its name, or removes it where status is not CLI_DONE. */
static int end_output(file_output *o, int status, file_sync sync)
{
    if (o->fresh && status == CLI_DONE && rename(o->fresh, o->path) != 0)
        status = cli_io("write", o->name);
    if (o->fresh && status != CLI_DONE) unlink(o->fresh);
    if (o->fresh && status == CLI_DONE && sync == FILE_SYNCED) file_sync_directory(o->path);
    if (o->fresh) forget_unfinished(o->fresh);
    free(o->fresh);
    free(o->path);
    *o = (file_output){0};
    return status;
}

int file_replace(const char *path, const void *bytes, size_t length, file_sync sync)
{
    file_output o;
    cli_hold_exit();
    int descriptor, status = begin_output(&o, path, &descriptor);
    if (status == CLI_DONE)
        status =
            file_write_and_close(descriptor, path, bytes, length, o.fresh ? sync : FILE_UNSYNCED);
    status = end_output(&o, status, sync);
    cli_release_exit();
    return status;
}

int file_output_open(file_output *o, const char *path)
{
    *o = (file_output){.name = "standard output", .stream = stdout};
    if (strcmp(path, "-") == 0) return CLI_DONE;
    cli_hold_exit();
    int descriptor, status = begin_output(o, path, &descriptor);
    if (status == CLI_DONE && !(o->stream = fdopen(descriptor, "wb")))
        status = cli_io("write", path);
    if (status != CLI_DONE) status = end_output(o, status, FILE_UNSYNCED);
    cli_release_exit();
    return status;
}

static int close_output(file_output *o, int status, file_sync sync)
{
    cli_hold_exit();
    if (status == CLI_DONE && sync == FILE_SYNCED &&
        (fflush(o->stream) != 0 || fsync(fileno(o->stream)) != 0))
        status = cli_io("write", o->name);
    if (status == CLI_DONE)
        status = cli_close(o->stream, o->name);
    else if (o->stream != stdout)
        fclose(o->stream);
    status = end_output(o, status, sync);
    cli_release_exit();
    return status;
}

int file_output_close(file_output *o, int status) { return close_output(o, status, FILE_UNSYNCED); }

int file_open_output(const char *path, int *descriptor)
{
    file_output o;
    cli_hold_exit();
    const int begun = begin_output(&o, path, descriptor),
              status = end_output(&o, begun, FILE_UNSYNCED);
    if (begun == CLI_DONE && status != CLI_DONE) close(*descriptor);
    cli_release_exit();
    return status;
}

int file_stream_output(const char *path, FILE **stream)
{
    int descriptor;
    *stream = stdout;
    if (strcmp(path, "-") == 0) return CLI_DONE;
    *stream = NULL;
    const int status = file_open_output(path, &descriptor);
    if (status == CLI_DONE && !(*stream = fdopen(descriptor, "wb"))) return cli_io("write", path);
    return status;
}

int file_create(const char *path, const void *bytes, size_t length)
{
    struct stat held;
    char *target = follow_links(path);
    const bool is_special =
        descriptor_number(target) >= 0 ||
        (stat(path, &held) == 0 && !S_ISREG(held.st_mode) && !S_ISDIR(held.st_mode));
    free(target);
    if (is_special) return file_replace(path, bytes, length, FILE_UNSYNCED);
    const int descriptor = open(path, O_WRONLY | O_CREAT | O_EXCL, 0666);
    if (descriptor < 0 && errno == EEXIST)
        return cli_fail(CLI_USAGE, "'%s' exists; it is not overwritten", path);
    if (descriptor < 0) return cli_io("write", path);
    const int status = file_write_and_close(descriptor, path, bytes, length, FILE_SYNCED);
    if (status != CLI_DONE) unlink(path);
    return status;
}

int file_copy(const char *from, const char *to, file_sync sync)
{
    char block[1 << 16];
    file_output output;
    FILE *source = fopen(from, "rb");
    if (!source) return cli_io("read", from);
    int status = file_output_open(&output, to);
    if (status == CLI_DONE) {
        for (size_t n; (n = fread(block, 1, sizeof block, source)) > 0;)
            if (fwrite(block, 1, n, output.stream) != n) break;
        status = close_output(&output, ferror(source) ? cli_io("read", from) : CLI_DONE,
                              output.fresh ? sync : FILE_UNSYNCED);
    }
    fclose(source);
    return status;
}
