/* ensemble.h - an ensemble: the run that its members share, what varies, and when they are
 * observed. */
#ifndef DAL_CLI_ENSEMBLE_H
#define DAL_CLI_ENSEMBLE_H

#include "dalembert_batch.h"
#include "run/run.h"
#include "run/simulation.h"

/* Members that one batch steps together; what is written and marked as done together.  It belongs
 * to the files: another number would not resume them. */
enum { ENSEMBLE_CHUNK = 256, ENSEMBLE_QUANTILES = 16, ENSEMBLE_MAX_MEMBERS = 1000000000 };

/* What of a run an ensemble does not take. */
#define ENSEMBLE_WITHOUT (REQUEST_ROW_OPTIONS & ~REQUEST_OPTION(times))

typedef struct ensemble {
    run_simulation simulation;
    long long members, seed;
    dal_variation *vary; /* [variations] */
    char **vary_text;    /* [variations] as they were given */
    int variations;
    double quantile[ENSEMBLE_QUANTILES];
    int quantiles;
    const char *axes; /* "X,Y": the plane of the figures; NULL: chosen */
    /* The rest is made by ensemble_complete. */
    dal_run_spec spec;
    dal_ensemble *first; /* one of ENSEMBLE_CHUNK lanes, which the first thread uses */
    char **column;       /* [columns] the names of the state */
    int columns, axis[2], times;
    double *time;     /* [times] when the members are observed; the last is the end */
    long long *steps; /* [times] until then */
} ensemble;

/* Parsers of options whose settings begin with an ensemble. */
cli_parser ensemble_parse_vary, ensemble_parse_quantiles;

/* What commands take that begin an ensemble in a directory. */
typedef struct ensemble_settings {
    ensemble ensemble; /* first: its parsers expect it there */
    const char *output;
    double interval; /* seconds between checkpoints */
    native_mode native;
    bool force;
} ensemble_settings;

/* Its options, except the options of the request. */
cli_option_set ensemble_option_set(ensemble_settings *settings);

/* An empty ensemble. */
ensemble ensemble_default(void);
void ensemble_free(ensemble *e);
/* Checks all and makes what is derived.  Returns CLI_DONE, or prints and returns an exit status. */
int ensemble_complete(ensemble *e);
/* How many chunks there are; how many members one has. */
int ensemble_chunks(const ensemble *e);
int ensemble_chunk_members(const ensemble *e, int chunk);

#endif
