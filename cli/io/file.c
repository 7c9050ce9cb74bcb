/* file.c - files, outputs and directories, and the numbers and texts of CSV. */
#include "file.h"
#include "dalembert_program.h"

#include "ui/memory.h"
#include "ui/message.h"
#include "ui/signals.h"

#include "text.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <fnmatch.h>
#include <math.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

static char *read_all(FILE *file, size_t *length)
{
    size_t room = 4096, n = 0;
    char *text = cli_malloc(room + 1);
    for (;;) {
        n += fread(text + n, 1, room - n, file);
        if (n < room) break;
        room *= 2;
        text = cli_realloc(text, room + 1);
    }
    text[n] = '\0';
    *length = n;
    return text;
}

char *file_read(const char *path, size_t *length)
{
    FILE *file = fopen(path, "rb");
    char *text = file ? read_all(file, length) : NULL;
    if (text && ferror(file)) {
        free(text);
        text = NULL;
    }
    if (!text) cli_io("read", path);
    if (file) fclose(file);
    return text;
}

bool file_exists(const char *path) { return access(path, F_OK) == 0; }

int file_equals(const char *path, const void *bytes, size_t length, bool *is_same)
{
    size_t n;
    char *text = file_read(path, &n);
    *is_same = text && n == length && memcmp(text, bytes, n) == 0;
    free(text);
    return text ? CLI_DONE : CLI_IO;
}

int file_is_copy(const char *path, const char *other, bool *is_same)
{
    size_t length;
    char *text = file_read(other, &length);
    const int status = text ? file_equals(path, text, length, is_same) : CLI_IO;
    free(text);
    return status;
}

bool file_is_same(const char *path, const char *other)
{
    struct stat x, y;
    return stat(path, &x) == 0 && stat(other, &y) == 0 && x.st_dev == y.st_dev &&
           x.st_ino == y.st_ino;
}

size_t file_transfer(int descriptor, void *bytes, size_t length, off_t place, file_way way)
{
    size_t done = 0;
    while (done < length) {
        char *at = (char *)bytes + done;
        const ssize_t n = way == FILE_WRITE
                              ? pwrite(descriptor, at, length - done, place + (off_t)done)
                              : pread(descriptor, at, length - done, place + (off_t)done);
        if (n < 0 && errno == EINTR) continue;
        if (n == 0) errno = EIO;
        if (n <= 0) break;
        done += (size_t)n;
    }
    return done;
}

static int write_all(int descriptor, const void *bytes, size_t length, int sync)
{
    const char *from = bytes;
    while (length) {
        ssize_t n = write(descriptor, from, length);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return 0;
        from += n;
        length -= (size_t)n;
    }
    return !sync || fsync(descriptor) == 0;
}

/* A rename is on the disk when the directory is; where a directory cannot be synchronised
 * (some network file systems) the rename is as safe as that system makes it. */
static void sync_directory(const char *path)
{
    const char *slash = strrchr(path, '/');
    char *directory = slash ? cli_strndup(path, (size_t)(slash - path) + 1) : cli_strdup(".");
    const int descriptor = open(directory, O_RDONLY);
    if (descriptor >= 0) {
        fsync(descriptor);
        close(descriptor);
    }
    free(directory);
}

static int write_and_close(int descriptor, const char *path, const void *bytes, size_t length,
                           int sync)
{
    int written = write_all(descriptor, bytes, length, sync);
    int reason = errno;
    if (close(descriptor) != 0 && written) {
        written = 0;
        reason = errno;
    }
    errno = reason;
    return written ? CLI_DONE : cli_io("write", path);
}

int file_write(const char *path, const void *bytes, size_t length, int sync)
{
    const int descriptor = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (descriptor < 0) return cli_io("write", path);
    return write_and_close(descriptor, path, bytes, length, sync);
}

int file_rename(const char *from, const char *to, int sync)
{
    if (rename(from, to) != 0) return cli_io("write", to);
    if (sync) sync_directory(to);
    return CLI_DONE;
}

/* ---- outputs ------------------------------------------------------------------------------- */

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

/* A descriptor, or -1 and the status after a message.  end_output() is due in either case. */
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
static int end_output(file_output *o, int status, int sync)
{
    if (o->fresh && status == CLI_DONE && rename(o->fresh, o->path) != 0)
        status = cli_io("write", o->name);
    if (o->fresh && status != CLI_DONE) unlink(o->fresh);
    if (o->fresh && status == CLI_DONE && sync) sync_directory(o->path);
    if (o->fresh) forget_unfinished(o->fresh);
    free(o->fresh);
    free(o->path);
    *o = (file_output){0};
    return status;
}

int file_replace(const char *path, const void *bytes, size_t length, int sync)
{
    file_output o;
    cli_hold_exit();
    int descriptor, status = begin_output(&o, path, &descriptor);
    if (status == CLI_DONE)
        status = write_and_close(descriptor, path, bytes, length, sync && o.fresh);
    status = end_output(&o, status, sync);
    cli_release_exit();
    return status;
}

int file_output_open(file_output *o, const char *path)
{
    *o = (file_output){.name = "standard output", .stream = stdout};
    if (strcmp(path, "-") == 0) return CLI_DONE;
    int descriptor, status = begin_output(o, path, &descriptor);
    if (status == CLI_DONE && !(o->stream = fdopen(descriptor, "wb")))
        status = cli_io("write", path);
    return status == CLI_DONE ? CLI_DONE : end_output(o, status, 0);
}

static int close_output(file_output *o, int status, int sync)
{
    if (status == CLI_DONE && sync && (fflush(o->stream) != 0 || fsync(fileno(o->stream)) != 0))
        status = cli_io("write", o->name);
    if (status == CLI_DONE)
        status = cli_close(o->stream, o->name);
    else if (o->stream != stdout)
        fclose(o->stream);
    return end_output(o, status, sync);
}

int file_output_close(file_output *o, int status) { return close_output(o, status, 0); }

int file_open_output(const char *path, int *descriptor)
{
    file_output o;
    cli_hold_exit();
    const int begun = begin_output(&o, path, descriptor), status = end_output(&o, begun, 0);
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
    if (is_special) return file_replace(path, bytes, length, 0);
    const int descriptor = open(path, O_WRONLY | O_CREAT | O_EXCL, 0666);
    if (descriptor < 0 && errno == EEXIST)
        return cli_fail(CLI_USAGE, "'%s' exists; it is not overwritten", path);
    if (descriptor < 0) return cli_io("write", path);
    const int status = write_and_close(descriptor, path, bytes, length, 1);
    if (status != CLI_DONE) unlink(path);
    return status;
}

int file_copy(const char *from, const char *to, int sync)
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
                              sync && output.fresh);
    }
    fclose(source);
    return status;
}

int file_remove(const char *path)
{
    return unlink(path) == 0 || errno == ENOENT ? CLI_DONE : cli_io("remove", path);
}

void cli_put(FILE *out, double x)
{
    /* Zero of either sign is common (p = pi = 0 on the surface) and quick to write. */
    if (x == 0.0) {
        fputc('0', out);
    } else if (isnan(x)) {
        fputs("nan", out);
    } else {
        char text[DAL__NUMBER_SIZE];
        fwrite(text, 1, (size_t)dal__format_number(text, x), out);
    }
}

void cli_put_known(FILE *out, double x)
{
    if (!isnan(x)) cli_put(out, x);
}

void cli_put_text(FILE *out, const char *text)
{
    if (strpbrk(text, ",\"") || text_find_control(text, "") >= 0)
        text_write_quoted(out, '"', text);
    else
        fputs(text, out);
}

int cli_ends_in(const char *text, const char *ending)
{
    size_t n = strlen(text), m = strlen(ending);
    return n >= m && strcmp(text + n - m, ending) == 0;
}

int cli_directory(const char *path)
{
    struct stat status;
    if (mkdir(path, 0777) == 0) return CLI_DONE;
    int reason = errno;
    if (reason == EEXIST && stat(path, &status) == 0 && S_ISDIR(status.st_mode)) return CLI_DONE;
    errno = reason;
    return cli_io("make the directory", path);
}

/* ".h5" of "out/x.h5"; NULL where what follows the last dot is no format, as in "h0.1". */
static const char *ending_of(const char *path)
{
    static const char digits_and_letters[] =
        "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    if (!dot || dot == name || strspn(dot + 1, digits_and_letters + 10) == 0) return NULL;
    return dot[1 + strspn(dot + 1, digits_and_letters)] ? NULL : dot;
}

int cli_parse_output(void *settings, const cli_option *option, const char *text)
{
    struct stat status;
    const bool has_directory = strstr(option->value, "DIR") != NULL;
    const bool has_npy = strstr(option->value, "FILE.csv") == NULL;
    const bool exists = stat(text, &status) == 0;
    if (!strchr(option->value, '|')) { /* only a directory */
        if (strcmp(text, "-") != 0 && (!ending_of(text) || (exists && S_ISDIR(status.st_mode))))
            return cli_parse_text(settings, option, text);
        return cli_fail(CLI_USAGE, "--%s: '%s' is no directory, which has no ending", option->name,
                        text);
    }
    const bool is_fine =
        strcmp(text, "-") == 0 || cli_ends_in(text, ".csv") ||
        (has_npy && cli_ends_in(text, ".npy")) || (has_directory && !ending_of(text)) ||
        (exists && !S_ISREG(status.st_mode) && (has_directory || !S_ISDIR(status.st_mode)));
    if (is_fine) return cli_parse_text(settings, option, text);
    return cli_fail(CLI_USAGE, "--%s: '%s' does not end in %s%s", option->name, text,
                    has_npy ? ".csv or .npy" : ".csv",
                    has_directory ? "; a directory has no ending" : "");
}

/* The files by which a directory of results is known: a file of that name, empty where it was only
 * begun, or with that beginning. */
static const struct {
    const char *name, *beginning;
} directory_marks[] = {
    {"manifest.json", "{\n  \"dalembert\": "},
    {"shard-*-of-*.json", "{\n  \"dalembert\": "},
    {"trajectory.npy", ""},
    {"lock", ""},
    {"section.csv", "crossing,t,direction,"},
    {"order.csv", "label,integrator,stated_order,"},
    {"lyapunov.csv", "t,lambda1"},
    {"volume.csv", "t,divergence,"},
};

static bool is_mark(const char *directory, const char *name)
{
    char bytes[64];
    bool found = false;
    for (size_t i = 0; i < sizeof directory_marks / sizeof *directory_marks && !found; i++) {
        if (fnmatch(directory_marks[i].name, name, 0) != 0) continue;
        const char *beginning = directory_marks[i].beginning;
        char *path = cli_join(directory, name);
        FILE *file = fopen(path, "rb");
        const size_t n = file ? fread(bytes, 1, sizeof bytes, file) : 1, length = strlen(beginning);
        found = file && (n == 0 || (length && n >= length && !memcmp(bytes, beginning, length)));
        if (file) fclose(file);
        free(path);
    }
    return found;
}

int file_find_directory(const char *path)
{
    struct stat state;
    if (stat(path, &state) != 0 && errno == ENOENT)
        return cli_fail(CLI_USAGE, "there is no directory '%s'", path);
    if (stat(path, &state) == 0 && !S_ISDIR(state.st_mode))
        return cli_fail(CLI_USAGE, "'%s' is no directory", path);
    return CLI_DONE;
}

static int compare_names(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

int file_list(const char *path, file_names *names)
{
    DIR *directory = opendir(path);
    *names = (file_names){NULL, 0};
    if (!directory) return cli_io("read", path);
    for (struct dirent *entry; (entry = readdir(directory));) {
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0) continue;
        names->name = cli_realloc(names->name, ((size_t)names->count + 1) * sizeof *names->name);
        names->name[names->count++] = cli_strdup(entry->d_name);
    }
    closedir(directory);
    if (names->count > 0)
        qsort(names->name, (size_t)names->count, sizeof *names->name, compare_names);
    return CLI_DONE;
}

void file_free_names(file_names *names)
{
    for (int i = 0; i < names->count; i++) free(names->name[i]);
    free(names->name);
}

bool file_owns_directory(const char *path)
{
    DIR *directory = opendir(path);
    bool is_empty = true, found = false;
    if (!directory && errno == ENOMEM) cli_out_of_memory();
    if (!directory) return errno != EACCES; /* what cannot be read may hold anything */
    for (struct dirent *entry; !found && (entry = readdir(directory));) {
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0) continue;
        is_empty = false;
        found = is_mark(path, entry->d_name);
    }
    closedir(directory);
    return is_empty || found;
}

int file_check_directory(const char *path)
{
    if (file_owns_directory(path)) return CLI_DONE;
    return cli_fail(CLI_USAGE,
                    "'%s' is not empty and holds no results of dalembert; --force writes into it",
                    path);
}

void file_report_directory(const char *path, int exit_status)
{
    if (exit_status == CLI_DONE || exit_status == CLI_FAILED)
        cli_note("wrote the directory '%s'", path);
}

/* A device or a pipe is written to as it is, whatever its name. */
bool cli_is_directory(const char *output)
{
    struct stat status;
    if (strcmp(output, "-") == 0 || cli_ends_in(output, ".csv") || cli_ends_in(output, ".npy"))
        return 0;
    return stat(output, &status) != 0 || S_ISDIR(status.st_mode) || S_ISREG(status.st_mode);
}

char *cli_join(const char *directory, const char *name)
{
    size_t n = strlen(directory), m = strlen(name);
    while (n > 1 && directory[n - 1] == '/') n--;
    char *path = cli_malloc(n + m + 2);
    memcpy(path, directory, n);
    path[n] = '/';
    memcpy(path + n + 1, name, m + 1);
    return path;
}
