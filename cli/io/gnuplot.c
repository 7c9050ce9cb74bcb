/* gnuplot.c - writing scripts for gnuplot and running them.
 *
 * gnuplot runs commands out of many places: in double quotes it runs what `...` encloses and
 * expands @NAME, a line end begins a statement, and a file name that begins with < or | is a
 * command.  So texts are in single quotes, where all of that is plain, and every file name is the
 * caller's, after "./". */
#include "gnuplot.h"
#include "ui/memory.h"
#include "ui/message.h"

#include "file.h"
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

enum { NOT_FOUND = 127 };

/* ---- texts --------------------------------------------------------------------------------- */

static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

static bool is_of_word(char c)
{
    return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || (unsigned char)c >= 0x80;
}

/* A letter, or one by name, with digits and primes after it is a symbol: theta1' is
 * $\theta_{1}'$.  Returns the length of the symbol; 0: none begins here. */
static size_t write_symbol(FILE *out, const char *word)
{
    static const char *const greek[] = {"alpha", "beta",  "gamma", "delta",  "epsilon", "zeta",
                                        "eta",   "theta", "kappa", "lambda", "mu",      "nu",
                                        "xi",    "pi",    "rho",   "sigma",  "tau",     "phi",
                                        "chi",   "psi",   "omega"};
    size_t letters = 0;
    while (is_letter(word[letters])) letters++;
    const size_t digits = strspn(word + letters, "0123456789");
    const size_t primes = strspn(word + letters + digits, "'");
    const size_t length = letters + digits + primes;
    bool has_name = false;
    for (size_t i = 0; i < sizeof greek / sizeof *greek; i++)
        has_name |= strlen(greek[i]) == letters && strncmp(greek[i], word, letters) == 0;
    if ((letters != 1 && !has_name) || is_of_word(word[length])) return 0;
    fprintf(out, "$%s%.*s", has_name ? "\\" : "", (int)letters, word);
    if (digits > 0) fprintf(out, "_{%.*s}", (int)digits, word + letters);
    fprintf(out, "%.*s$", (int)primes, word + letters + digits);
    return length;
}

/* Every character that TeX does not set as itself is named. */
static void write_tex(FILE *out, const char *text)
{
    static const struct {
        char character;
        const char *tex;
    } special[] = {{'\\', "\\textbackslash{}"},
                   {'^', "\\textasciicircum{}"},
                   {'~', "\\textasciitilde{}"},
                   {'<', "$<$"},
                   {'>', "$>$"},
                   {'|', "$|$"},
                   {'"', "\\textquotedbl{}"},
                   {'-', "{-}"},
                   {'`', "\\textasciigrave{}"},
                   {'*', "$*$"}};
    enum { COUNT = sizeof special / sizeof special[0] };
    for (bool is_inside = false; *text;) {
        const size_t length = is_inside ? 0 : write_symbol(out, text);
        if (length > 0) {
            text += length;
            continue;
        }
        size_t k = 0;
        while (k < COUNT && special[k].character != *text) k++;
        if (k < COUNT)
            fputs(special[k].tex, out);
        else
            fprintf(out, strchr("{}$&#_%", *text) ? "\\%c" : "%c", *text);
        is_inside = is_of_word(*text);
        text++;
    }
}

void gnuplot_quote(const gnuplot *g, const char *text)
{
    char *tex;
    size_t length;
    if (g->format == GNUPLOT_SVG) {
        text_write_quoted(g->script, '\'', text);
        return;
    }
    FILE *out = cli_memstream_open(&tex, &length);
    write_tex(out, text);
    cli_memstream_close(out);
    text_write_quoted(g->script, '\'', tex);
    free(tex);
}

void gnuplot_set(const gnuplot *g, const char *what, const char *text)
{
    fprintf(g->script, "set %s ", what);
    gnuplot_quote(g, text);
    fputc('\n', g->script);
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

/* ---- scripts ------------------------------------------------------------------------------- */

/* The picture of an earlier script would hide that none was drawn. */
static int remove_pictures(const char *directory, const char *name)
{
    static const char *const suffixes[] = {"svg", "png", "pdf", "tex"};
    int status = CLI_DONE;
    for (size_t i = 0; i < sizeof suffixes / sizeof *suffixes && status == CLI_DONE; i++) {
        char *picture = cli_format("%s/%s.%s", directory, name, suffixes[i]);
        status = file_remove(picture);
        free(picture);
    }
    return status;
}

int gnuplot_open(gnuplot *g, const char *directory, const char *name, gnuplot_format format,
                 int height)
{
    *g = (gnuplot){.format = format};
    const int removed = remove_pictures(directory, name);
    if (removed != CLI_DONE) return removed;
    g->path = cli_format("%s/%s.gp", directory, name);
    g->script = fopen(g->path, "w");
    if (!g->script) {
        const int status = cli_io("write", g->path);
        free(g->path);
        return status;
    }
    if (format == GNUPLOT_PDF)
        fprintf(g->script, "set terminal cairolatex pdf size 3.4in,%.2fin\nset output '%s.tex'\n",
                height / 96.0, name);
    else
        fprintf(g->script,
                "set terminal svg dynamic size %d,%d noenhanced font 'sans,12'\n"
                "set output './%s.svg'\n",
                GNUPLOT_WIDTH, height, name);
    fputs("set datafile separator comma\nset datafile missing ''\nset tics nomirror font ',11.5'\n"
          "set border 3\nset grid back lt 1 lw 1 lc rgb '#c0808080'\n",
          g->script);
    return CLI_DONE;
}

int gnuplot_close(gnuplot *g)
{
    const int status = cli_close(g->script, g->path);
    free(g->path);
    return status;
}

/* ---- pictures ------------------------------------------------------------------------------ */

static int run(const char *directory, const char *path)
{
    int state;
    fflush(NULL);
    const pid_t parent = getpid();
    pid_t child = fork();
    if (child < 0) return cli_io("run", "gnuplot");
    if (child == 0) {
        /* The child ends with its parent. */
#ifdef __linux__
        prctl(PR_SET_PDEATHSIG, SIGTERM);
#endif
        if (getppid() != parent) _exit(1);
        char *script = cli_format(".%s", strrchr(path, '/'));
        if (chdir(directory) == 0) execlp("gnuplot", "gnuplot", script, (char *)NULL);
        _exit(errno == ENOENT ? NOT_FOUND : 1);
    }
    while (waitpid(child, &state, 0) < 0)
        if (errno != EINTR) return cli_io("wait for", "gnuplot");
    if (WIFEXITED(state) && WEXITSTATUS(state) == 0) return CLI_DONE;
    if (WIFEXITED(state) && WEXITSTATUS(state) == NOT_FOUND)
        return cli_fail(CLI_IO, "gnuplot is not installed; it draws '%s', which is written", path);
    return cli_fail(CLI_IO, "gnuplot failed on '%s'", path);
}

int gnuplot_draw(gnuplot *g, const char *directory)
{
    int status = cli_close(g->script, g->path);
    if (status == CLI_DONE) status = run(directory, g->path);
    char *picture = cli_format("%.*s%s", (int)strlen(g->path) - 2, g->path,
                               g->format == GNUPLOT_PDF ? "tex" : "svg");
    if (status == CLI_DONE && !file_exists(picture))
        status = cli_fail(CLI_IO, "gnuplot drew nothing from '%s'", g->path);
    free(picture);
    free(g->path);
    return status;
}
