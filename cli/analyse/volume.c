/* volume.c - `dalembert volume`: at what rate a motion, and its method, change the volume of the
 * phase space.
 *
 *     d/dt log(volume) = div (v, F) = trace F_v,     step: log|det J| / h
 *
 * On D = 0 the long-time mean is the same: D is constant on every level, and the densities of the
 * surface differ by the total derivative of a bounded function. */
#include "spectrum.h"

#include <math.h>

static const cli_option options[SPECTRUM_OPTIONS] = {SPECTRUM_OPTION_LIST(CLI_OPTION)};

static const char notes[] =
    "SYSTEM is a built-in name or the path of a system file.  Followed along the run are the "
    "exact\n"
    "divergence of the motion in (q,v), the trace of the derivative of F by v, and the logarithm "
    "of\n"
    "the determinant of the derivative of every step, over h: what the method does to the volume.\n"
    "Where the method forces D = 0 the latter is that on the surface.\n"
    "\n"
    "A system with an invariant measure has the mean 0; a negative one means an attractor, on "
    "which\n"
    "the motion settles.  The means on (q,v) and on D = 0 differ by the mean growth of log |grad "
    "D|.\n"
    "The exit status is 3 when they differ otherwise, by more than the error of the method: then "
    "the\n"
    "derivative of the steps is not reliable.  --time is the time of the means, behind the\n"
    "transient.  FILE and DIR/volume.csv get rows t, divergence, step: the means so far.\n";

static int take(void *user, int k, const char *value) { return spectrum_take(user, k, value); }

static void fill(const dal_spectrum *spectrum, double *values)
{
    dal_average a;
    dal_spectrum_divergence(spectrum, &a);
    values[0] = a.mean;
    dal_spectrum_sum(spectrum, &a);
    values[1] = a.mean;
}

/* A rate that is 0 but for rounding, at every step, is so by itself. */
static const char *word_of(const dal_average *a, double resolution)
{
    static const double rounding = 1e-11;
    if (fabs(a->low) <= rounding && fabs(a->high) <= rounding) return "kept at every step";
    if (a->low > resolution) return "grows";
    if (a->high < -resolution) return "shrinks";
    return "not distinguishable from 0";
}

static int print(spectrum_study *s)
{
    const double resolution = spectrum_resolution(s);
    dal_average motion, step;
    dal_spectrum_divergence(s->spectrum, &motion);
    dal_spectrum_sum(s->spectrum, &step);
    spectrum_print_head(s);
    spectrum_print_mean("divergence of F", &motion, word_of(&motion, resolution));
    spectrum_print_mean("log|det J|/h of a step", &step, word_of(&step, resolution));
    const int count = dal_spectrum_count(s->spectrum);
    const int dimension = dal_run_dimension(dal_spectrum_run(s->spectrum));
    printf("\n%d of %d directions; step less motion: %.2g\n", count, dimension,
           step.mean - motion.mean);
    const int balanced = spectrum_print_balance(s);
    const int closed = cli_close(stdout, "standard output");
    return closed != CLI_DONE ? closed : balanced;
}

static int go(spectrum_study *s)
{
    static char t[] = "t", divergence[] = "divergence", step[] = "step";
    static char *const names[] = {t, divergence, step};
    static const spectrum_table table = {"volume", "rate, mean so far", 2, names, fill};
    int status = spectrum_make(s);
    if (status == CLI_DONE) status = spectrum_run(s, &table);
    if (!s->spectrum || status == CLI_IO || status == CLI_USAGE) return status;
    const int printed = print(s);
    return status == CLI_DONE ? printed : status;
}

int command_volume(int argc, char **argv)
{
    const analysis_command command = {
        options, SPECTRUM_OPTIONS, ANALYSIS_ROWS | ANALYSIS_OPTION(space), notes, take, NULL};
    spectrum_study s = {.request = request_default(), .rows = 100};
    int status = analysis_read(argc, argv, &command, &s.request, &s);
    if (status == CLI_GO_ON) status = go(&s);
    spectrum_free(&s);
    return status;
}
