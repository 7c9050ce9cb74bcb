/* file.c - files and directories, and the numbers and texts of CSV. */
#include "file.h"

#include "ui/memory.h"
#include "ui/message.h"

#include "text.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
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

bool file_equals(const char *path, const void *bytes, size_t length)
{
    size_t n;
    char *text = file_read(path, &n);
    const int same = text && n == length && memcmp(text, bytes, n) == 0;
    free(text);
    return same;
}

bool file_is_copy(const char *path, const char *other)
{
    size_t length;
    char *text = file_read(other, &length);
    const int same = text && file_equals(path, text, length);
    free(text);
    return same;
}

bool file_is_same(const char *path, const char *other)
{
    struct stat x, y;
    return stat(path, &x) == 0 && stat(other, &y) == 0 && x.st_dev == y.st_dev &&
           x.st_ino == y.st_ino;
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

int file_create(const char *path, const void *bytes, size_t length)
{
    const int descriptor = open(path, O_WRONLY | O_CREAT | O_EXCL, 0666);
    if (descriptor < 0 && errno == EEXIST)
        return cli_fail(CLI_USAGE, "'%s' exists; it is not overwritten", path);
    if (descriptor < 0) return cli_io("write", path);
    const int status = write_and_close(descriptor, path, bytes, length, 1);
    if (status != CLI_DONE) unlink(path);
    return status;
}

int file_rename(const char *from, const char *to, int sync)
{
    if (rename(from, to) != 0) return cli_io("write", to);
    if (sync) sync_directory(to);
    return CLI_DONE;
}

int file_replace(const char *path, const void *bytes, size_t length, int sync)
{
    char *fresh = cli_format("%s.new", path);
    cli_hold_exit();
    int status = file_write(fresh, bytes, length, sync);
    if (status == CLI_DONE) status = file_rename(fresh, path, sync);
    if (status != CLI_DONE) unlink(fresh);
    cli_release_exit();
    free(fresh);
    return status;
}

int file_copy(const char *from, const char *to, int sync)
{
    size_t length;
    char *bytes = file_read(from, &length);
    const int status = bytes ? file_replace(to, bytes, length, sync) : CLI_IO;
    free(bytes);
    return status;
}

int file_remove(const char *path)
{
    return unlink(path) == 0 || errno == ENOENT ? CLI_DONE : cli_io("remove", path);
}

uint64_t file_hash(uint64_t hash, const void *bytes, size_t length)
{
    const unsigned char *byte = bytes;
    for (size_t i = 0; i < length; i++) hash = (hash ^ byte[i]) * UINT64_C(0x100000001b3);
    return hash;
}

void cli_put(FILE *out, double x)
{
    /* Zero of either sign is common (p = pi = 0 on the surface) and quick to write. */
    if (x == 0.0)
        fputc('0', out);
    else if (isnan(x))
        fputs("nan", out);
    else
        fprintf(out, "%.17g", x);
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

int cli_output_directory(const char *path)
{
    const int status = cli_directory(path);
    if (status == CLI_DONE) cli_note("'%s' is a directory", path);
    return status;
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
