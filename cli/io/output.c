/* output.c - writing numbers and files. */
#include "output.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

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

void cli_put_text(FILE *out, const char *text)
{
    if (!strpbrk(text, ",\"\n")) {
        fputs(text, out);
        return;
    }
    fputc('"', out);
    for (; *text; text++) {
        if (*text == '"') fputc('"', out);
        fputc(*text, out);
    }
    fputc('"', out);
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
