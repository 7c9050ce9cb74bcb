/* gnuplot.c - writing scripts for gnuplot and running them. */
#include "gnuplot.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { NOT_FOUND = 127 };

void gnuplot_quote(FILE *script, const char *text)
{
    fputc('"', script);
    for (; *text; text++) {
        if (*text == '"' || *text == '\\') fputc('\\', script);
        /* Back quotes would run a command. */
        fputc(*text == '`' ? '\'' : *text, script);
    }
    fputc('"', script);
}

/* First-order methods in warm colours, then green and black, then Gauss from violet to blue. */
const char *gnuplot_colour(int i)
{
    static const char *const colour[GNUPLOT_COLOURS] = {"#e6a700", "#d95f02", "#c51b2c", "#8c2d04",
                                                        "#1b9e49", "#000000", "#7a7a7a", "#c994c7",
                                                        "#9e5fc0", "#5e4fa2", "#2b83ba", "#08306b"};
    return colour[i % GNUPLOT_COLOURS];
}

FILE *gnuplot_open(const char *directory, const char *name, const char *format, int width,
                   int height, char **path)
{
    char file[512];
    snprintf(file, sizeof file, "%s.gp", name);
    *path = cli_join(directory, file);
    FILE *script = *path ? fopen(*path, "w") : NULL;
    if (!script) {
        cli_io("write", *path ? *path : name);
        free(*path);
        return NULL;
    }
    fprintf(script, "set terminal %s size %d,%d noenhanced font 'sans,11' background 'white'\n",
            strcmp(format, "png") == 0 ? "pngcairo" : "svg dynamic", width, height);
    snprintf(file, sizeof file, "%s.%s", name, format);
    fputs("set output ", script);
    gnuplot_quote(script, file);
    fputs("\nset datafile separator comma\nset datafile missing ''\nset tics nomirror font ',9'\n"
          "set border 3\nset grid back lt 1 lw 1 lc rgb '#e0e0e0'\n",
          script);
    return script;
}

static int run(const char *directory, const char *path, int *missing)
{
    const char *slash = strrchr(path, '/'), *script = slash ? slash + 1 : path;
    int state;
    fflush(NULL);
    pid_t child = fork();
    if (child < 0) return cli_io("run", "gnuplot");
    if (child == 0) {
        if (chdir(directory) == 0) execlp("gnuplot", "gnuplot", script, (char *)NULL);
        _exit(errno == ENOENT ? NOT_FOUND : 1);
    }
    while (waitpid(child, &state, 0) < 0)
        if (errno != EINTR) return cli_io("wait for", "gnuplot");
    if (WIFEXITED(state) && WEXITSTATUS(state) == 0) return CLI_DONE;
    *missing = WIFEXITED(state) && WEXITSTATUS(state) == NOT_FOUND;
    if (*missing)
        return cli_fail(CLI_IO, "gnuplot is not installed; the figures need it ('%s' is written)",
                        path);
    return cli_fail(CLI_IO, "gnuplot failed on '%s'", path);
}

int gnuplot_draw(const char *directory, FILE *script, const char *path, int *missing)
{
    int status = cli_close(script, path);
    *missing = 0;
    return status == CLI_DONE ? run(directory, path, missing) : status;
}
