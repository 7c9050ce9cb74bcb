/* gnuplot.c - writing scripts for gnuplot and running them.
 *
 * gnuplot runs commands out of many places: in double quotes it runs what `...` encloses and
 * expands @NAME, a line end begins a statement, and a file name that begins with < or | is a
 * command.  So texts are in single quotes, where all of that is plain, and every file name is the
 * caller's, after "./". */
#include "gnuplot.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/signals.h"

#include "file.h"
#include "svg.h"
#include "text.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#include <unistd.h>

enum { NOT_FOUND = 127, AXES_SIZE = 256 };

void gnuplot_quote(FILE *script, const char *text) { text_write_quoted(script, '\'', text); }

void gnuplot_set(FILE *script, const char *what, const char *text)
{
    fprintf(script, "set %s ", what);
    gnuplot_quote(script, text);
    fputc('\n', script);
}

/* Of middling luminance (0.17 to 0.25), so that each is distinct on white and on black alike, by a
 * contrast of 3.6 at least. */
const char *gnuplot_colour(int i)
{
    static const char *const colour[GNUPLOT_COLOURS] = {"#d9600f", "#2f80d0", "#3d9a3d", "#d1479f",
                                                        "#12908e", "#9a5fd0", "#94851a", "#d33b4b"};
    return colour[i % GNUPLOT_COLOURS];
}

void gnuplot_style(FILE *script, int i)
{
    static const char *const dash[] = {"solid", "'- '", "'.'"};
    fprintf(script, "lc rgb '%s' dt %s", gnuplot_colour(i), dash[i / GNUPLOT_COLOURS % 3]);
}

FILE *gnuplot_open(const char *directory, const char *name, const char *format, int width,
                   int height, char **path)
{
    char file[512];
    snprintf(file, sizeof file, "%s.gp", name);
    *path = cli_join(directory, file);
    snprintf(file, sizeof file, "./%s.%s", name, format);
    /* An old picture would hide that none was drawn. */
    char *picture = cli_join(directory, file);
    const int removed = file_remove(picture);
    free(picture);
    FILE *script = removed == CLI_DONE ? fopen(*path, "w") : NULL;
    if (!script) {
        if (removed == CLI_DONE) cli_io("write", *path);
        free(*path);
        return NULL;
    }
    fprintf(script, "set terminal %s size %d,%d noenhanced font 'sans,12'\n",
            strcmp(format, "png") == 0 ? "pngcairo background 'white'" : "svg dynamic", width,
            height);
    gnuplot_set(script, "output", file);
    fputs("set datafile separator comma\nset datafile missing ''\nset tics nomirror font ',11.5'\n"
          "set border 3\nset grid back lt 1 lw 1 lc rgb '#c0808080'\nlog_x = 0\nlog_y = 0\n",
          script);
    return script;
}

bool gnuplot_is_there(void)
{
    const char *place = getenv("PATH");
    bool found = false;
    while (place && *place && !found) {
        const int length = (int)strcspn(place, ":");
        char *path = cli_format("%.*s/gnuplot", length, place);
        found = access(path, X_OK) == 0;
        free(path);
        place += length + (place[length] == ':');
    }
    return found;
}

/* The axes of the last plot: for x and y the pixels of both ends, the values there, and whether it
 * is logarithmic.  Pixels of SVG begin at the top. */
static const char print_axes[] =
    "scale = 1.0*GPVAL_TERM_SCALE\n"
    "height = GPVAL_TERM_YSIZE/scale\n"
    "set print '-'\n"
    "print sprintf('%.7g %.7g %.15g %.15g %d', GPVAL_TERM_XMIN, GPVAL_TERM_XMAX, GPVAL_X_MIN, "
    "GPVAL_X_MAX, log_x), \\\n"
    "  sprintf(' %.7g %.7g %.15g %.15g %d', height - GPVAL_TERM_YMIN, height - GPVAL_TERM_YMAX, "
    "GPVAL_Y_MIN, GPVAL_Y_MAX, log_y)\n";

/* Runs gnuplot and reads the axes that it prints. */
static int run(const char *directory, const char *path, char axes[AXES_SIZE], bool *missing)
{
    int state, ends[2];
    fflush(NULL);
    const pid_t parent = getpid();
    if (pipe(ends) != 0) return cli_io("run", "gnuplot");
    pid_t child = fork();
    if (child < 0) return cli_io("run", "gnuplot");
    if (child == 0) {
        dup2(ends[1], STDOUT_FILENO);
        close(ends[0]);
        close(ends[1]);
        /* The child ends with its parent. */
#ifdef __linux__
        prctl(PR_SET_PDEATHSIG, SIGTERM);
#endif
        if (getppid() != parent) _exit(1);
        char *script = cli_format(".%s", strrchr(path, '/'));
        if (chdir(directory) == 0) execlp("gnuplot", "gnuplot", script, (char *)NULL);
        _exit(errno == ENOENT ? NOT_FOUND : 1);
    }
    close(ends[1]);
    FILE *printed = fdopen(ends[0], "r");
    if (!printed || !fgets(axes, AXES_SIZE, printed)) axes[0] = '\0';
    const bool is_read = printed && !ferror(printed);
    if (printed)
        fclose(printed);
    else
        close(ends[0]);
    if (cli_interrupted()) kill(child, SIGTERM);
    while (waitpid(child, &state, 0) < 0) {
        if (errno != EINTR) return cli_io("wait for", "gnuplot");
        if (cli_interrupted()) kill(child, SIGTERM);
    }
    if (cli_interrupted()) return cli_fail(CLI_SIGNAL, "interrupted while gnuplot drew '%s'", path);
    if (WIFEXITED(state) && WEXITSTATUS(state) == 0)
        return is_read ? CLI_DONE : cli_fail(CLI_IO, "cannot read what gnuplot prints");
    const bool is_missing = WIFEXITED(state) && WEXITSTATUS(state) == NOT_FOUND;
    if (missing) *missing = is_missing;
    if (is_missing)
        return cli_fail(CLI_IO, "gnuplot is not installed; the figures need it ('%s' is written)",
                        path);
    return cli_fail(CLI_IO, "gnuplot failed on '%s'", path);
}

int gnuplot_draw(const char *directory, FILE *script, const char *path, bool *missing)
{
    char axes[AXES_SIZE] = "";
    fputs(print_axes, script);
    int status = cli_close(script, path);
    if (missing) *missing = false;
    if (status == CLI_DONE) status = run(directory, path, axes, missing);
    if (status != CLI_DONE) return status;
    /* NAME.gp has drawn NAME.svg or NAME.png. */
    const int length = (int)strlen(path) - 2;
    char *svg = cli_format("%.*ssvg", length, path), *png = cli_format("%.*spng", length, path);
    if (file_exists(svg))
        status = svg_tidy(svg, axes);
    else if (!file_exists(png))
        status = cli_fail(CLI_IO, "gnuplot drew nothing from '%s'", path);
    free(svg);
    free(png);
    return status;
}
