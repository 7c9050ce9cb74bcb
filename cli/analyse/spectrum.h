/* spectrum.h - what `dalembert lyapunov` and `dalembert volume` share: a run with tangent vectors,
 * its means in rows, its end. */
#ifndef DAL_CLI_SPECTRUM_H
#define DAL_CLI_SPECTRUM_H

#include "analysis.h"
#include "io/table.h"

/* The options of both, behind which those of one may come.  name, value, default, help */
#define SPECTRUM_OPTION_LIST(X)                                                                    \
    X(transient, "T0", "0", "let the vectors turn for so long before the means begin")             \
    X(rows, "N", "100", "rows of the table, at equal distances in t")                              \
    X(output, "DIR|FILE", NULL,                                                                    \
      "the means as they settle: .csv, .npy, or a directory with a "                               \
      "picture")

enum {
#define X(name, value, initial, help) SPECTRUM_##name,
    SPECTRUM_OPTION_LIST(X)
#undef X
        SPECTRUM_OPTIONS
};

typedef struct spectrum_study {
    run_request request;
    const char *output;
    double transient;
    long long rows;
    long long exponents; /* 0: all */
    dal_spectrum *spectrum;
    double from; /* where the means begin */
    trajectory_writer table;
} spectrum_study;

/* Takes one of the options above.  Returns CLI_DONE or prints and returns an exit status, as all
 * here. */
int spectrum_take(spectrum_study *study, int option, const char *value);

/* A table of means: its name, which is the file's and the picture's, what it has beside t, and the
 * values of a row. */
typedef struct spectrum_table {
    const char *name, *ylabel;
    int columns;
    char *const *names; /* [1 + columns], t first */
    void (*fill)(const dal_spectrum *spectrum, double *values);
} spectrum_table;

/* Makes the spectrum.  spectrum_run then goes from transient to the end, writing rows, and may end
 * early with CLI_SIGNAL or CLI_FAILED, the means so far being good; spectrum_draw is for then. */
int spectrum_make(spectrum_study *study);
int spectrum_run(spectrum_study *study, const spectrum_table *table);
void spectrum_free(spectrum_study *study);

/* The first lines of what is told. */
void spectrum_print_head(const spectrum_study *study);
/* One line: a name, a mean and its interval, and a word. */
void spectrum_print_mean(const char *name, const dal_average *average, const char *word);
/* The sum of the exponents against the divergence, in a line; CLI_FAILED with a message when they
 * disagree. */
int spectrum_print_balance(spectrum_study *study);
/* What can be told from 0 after so long: regular motion has exponents about log(T)/T. */
double spectrum_resolution(const spectrum_study *study);

#endif
