/* file.c - files and directories. */
#include "file.h"

#include "ui/memory.h"
#include "ui/message.h"
#include "ui/signals.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <fnmatch.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
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

bool file_is_in(const char *directory, const char *name)
{
    char *path = cli_join(directory, name);
    const bool is_found = file_exists(path);
    free(path);
    return is_found;
}

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

static bool write_all(int descriptor, const void *bytes, size_t length, file_sync sync)
{
    const char *from = bytes;
    while (length) {
        ssize_t n = write(descriptor, from, length);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return false;
        from += n;
        length -= (size_t)n;
    }
    return sync == FILE_UNSYNCED || fsync(descriptor) == 0;
}

/* A rename is on the disk when the directory is; where a directory cannot be synchronised
 * (some network file systems) the rename is as safe as that system makes it. */
void file_sync_directory(const char *path)
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

int file_write_and_close(int descriptor, const char *path, const void *bytes, size_t length,
                         file_sync sync)
{
    bool written = write_all(descriptor, bytes, length, sync);
    int reason = errno;
    if (close(descriptor) != 0 && written) {
        written = false;
        reason = errno;
    }
    errno = reason;
    return written ? CLI_DONE : cli_io("write", path);
}

int file_write(const char *path, const void *bytes, size_t length, file_sync sync)
{
    const int descriptor = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (descriptor < 0) return cli_io("write", path);
    return file_write_and_close(descriptor, path, bytes, length, sync);
}

int file_rename(const char *from, const char *to, file_sync sync)
{
    if (rename(from, to) != 0) return cli_io("write", to);
    if (sync == FILE_SYNCED) file_sync_directory(to);
    return CLI_DONE;
}

int file_remove(const char *path)
{
    return unlink(path) == 0 || errno == ENOENT ? CLI_DONE : cli_io("remove", path);
}

bool cli_ends_in(const char *text, const char *ending)
{
    size_t n = strlen(text), m = strlen(ending);
    return n >= m && strcmp(text + n - m, ending) == 0;
}

int file_make_directory(const char *path)
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
    {"steer.json", "{\n  \"schema\": \"dalembert/steer/"},
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
        return false;
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
