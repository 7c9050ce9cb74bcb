/* lyapunov.c - `dalembert lyapunov`: Lyapunov exponents of a motion, by the derivative of its
 * steps. */
#include "spectrum.h"

#include <stdlib.h>

/* name, value, default, help; behind those of spectrum.h */
#define OWN_LIST(X) X(exponents, "K", NULL, "so many of them, the largest; otherwise all")

enum { OWN_FIRST = SPECTRUM_OPTIONS - 1, OWN_LIST(CLI_OWN) OPTIONS };

static const cli_option options[OPTIONS] = {SPECTRUM_OPTION_LIST(CLI_OPTION) OWN_LIST(CLI_OPTION)};

static const char notes[] =
    "SYSTEM is a built-in name or the path of a system file.  On (q,v) tangent vectors are moved "
    "by\n"
    "the derivative of each step, and made orthonormal again: the means of the logarithms of what\n"
    "they lose are the exponents, per unit of t, of the method's motion.  The derivative is exact\n"
    "for Runge-Kutta, polarised and composed methods, and by differences for the others.\n"
    "\n"
    "--time is the time of the means, behind the transient.  The intervals are from block means;\n"
    "they know nothing of a slow approach: exponents of regular motion fall like log(t)/t, and "
    "what\n"
    "is smaller than that is not distinguished from 0.  Every constraint adds an exponent 0, since "
    "D\n"
    "is constant on each level; a method that forces D = 0 has no direction for it.  All "
    "exponents\n"
    "together are the mean divergence of the motion, and on D = 0 the mean growth of log |grad D|\n"
    "more.  The exit status is 3 when they differ by more than the error of the method: then the\n"
    "derivative of the steps is not reliable.\n"
    "\n"
    "FILE and DIR/lyapunov.csv get rows t, lambda1, .., divergence: the means so far.\n";

static int take(void *user, int k, const char *value)
{
    spectrum_study *s = user;
    if (k < SPECTRUM_OPTIONS) return spectrum_take(s, k, value);
    return cli_integer("--exponents", value, 1, 1000000, &s->exponents);
}

static void fill(const dal_spectrum *spectrum, double *values)
{
    const int count = dal_spectrum_count(spectrum);
    dal_average a;
    for (int i = 0; i < count; i++) {
        dal_spectrum_exponent(spectrum, i, &a);
        values[i] = a.mean;
    }
    dal_spectrum_divergence(spectrum, &a);
    values[count] = a.mean;
}

/* ---- telling ------------------------------------------------------------------------------- */

static const char *word_of(const dal_average *a, double resolution)
{
    if (a->low > resolution) return "positive";
    if (a->high < -resolution) return "negative";
    return "not distinguishable from 0";
}

static int print(spectrum_study *s)
{
    const int count = dal_spectrum_count(s->spectrum);
    const double resolution = spectrum_resolution(s);
    dal_average a;
    spectrum_print_head(s);
    for (int i = 0; i < count; i++) {
        char name[32];
        snprintf(name, sizeof name, "exponent %d", i + 1);
        dal_spectrum_exponent(s->spectrum, i, &a);
        spectrum_print_mean(name, &a, word_of(&a, resolution));
    }
    dal_spectrum_sum(s->spectrum, &a);
    spectrum_print_mean("their sum", &a, dal_spectrum_is_whole(s->spectrum) ? "all" : "not all");
    dal_spectrum_divergence(s->spectrum, &a);
    spectrum_print_mean("divergence of F", &a, "exact, at every step");
    printf("\nregular motion may show exponents up to about log(T)/T = %.2g\n", resolution);
    const int balanced = spectrum_print_balance(s);
    const int closed = cli_close(stdout, "standard output");
    return closed != CLI_DONE ? closed : balanced;
}

/* ---- the command --------------------------------------------------------------------------- */

/* t, lambda1, .., divergence in one text; NULL when memory is out. */
static char **name_columns(int count)
{
    enum { NAME = 24 };
    char **names = cli_calloc((size_t)count + 2, sizeof *names + NAME);
    char *text = (char *)(names + count + 2);
    for (int i = 0; i < count + 2; i++) {
        names[i] = text + i * NAME;
        snprintf(names[i], NAME, "lambda%d", i);
    }
    snprintf(names[0], NAME, "t");
    snprintf(names[count + 1], NAME, "divergence");
    return names;
}

static int go(spectrum_study *s)
{
    int status = spectrum_make(s);
    if (status != CLI_DONE) return status;
    const int count = dal_spectrum_count(s->spectrum);
    char **names = name_columns(count);
    const spectrum_table table = {"lyapunov", "mean so far", count + 1, names, fill};
    status = spectrum_run(s, &table);
    free(names);
    if (status == CLI_IO || status == CLI_USAGE) return status;
    const int printed = print(s);
    return status == CLI_DONE ? printed : status;
}

int command_lyapunov(int argc, char **argv)
{
    const analysis_command command = {options, OPTIONS, ANALYSIS_ROWS | ANALYSIS_OPTION(space),
                                      notes,   take,    NULL};
    spectrum_study s = {.request = request_default(), .rows = 100};
    int status = analysis_read(argc, argv, &command, &s.request, &s);
    if (status == CLI_GO_ON) status = go(&s);
    spectrum_free(&s);
    return status;
}
