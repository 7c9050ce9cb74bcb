/* study_data.h - a study: its cases, their cells and results, and what is expected of them. */
#ifndef DAL_CLI_STUDY_DATA_H
#define DAL_CLI_STUDY_DATA_H

#include "dalembert_statistics.h"
#include "io/document.h"
#include "run/native.h"
#include "run/request_data.h"
#include "ui/screen.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Where a cell starts.  code, word, space, what it is */
#define STUDY_START_LIST(START)                                                                    \
    START(PHYSICAL, "physical", DAL_PHYSICAL, "(q,v) alone")                                       \
    START(SURFACE, "surface", DAL_LIFTED, "lifted, on p = pi = 0")                                 \
    START(DISPLACED, "displaced", DAL_LIFTED, "lifted, p and pi displaced")

typedef enum study_start {
#define START_CODE(code, word, space, about) STUDY_##code,
    STUDY_START_LIST(START_CODE)
#undef START_CODE
        STUDY_STARTS
} study_start;
extern const char *const study_start_words[STUDY_STARTS];

/* What the figures show over time, window by window.  code, column */
#define STUDY_TRACK_LIST(TRACK)                                                                    \
    TRACK(D, "D")                   /* max |D_a| */                                                \
    TRACK(E, "E")                   /* |E - E(0)| */                                               \
    TRACK(H, "H")                   /* |H - H(0)| */                                               \
    TRACK(P, "p")                   /* max |p| */                                                  \
    TRACK(PI, "pi")                 /* max |pi| */                                                 \
    TRACK(INVARIANTS, "invariants") /* max |I - I(0)| / max(1, |I(0)|) */                          \
    TRACK(ERROR, "error")           /* against the exact solution */

enum {
#define TRACK_CODE(code, column) STUDY_TRACK_##code,
    STUDY_TRACK_LIST(TRACK_CODE)
#undef TRACK_CODE
        STUDY_TRACKS
};

enum { STUDY_WINDOWS = 100, STUDY_NAME = 128 };

/* Whether a cell has been run, and how that ended. */
#define STUDY_STATE_LIST(STATE)                                                                    \
    STATE(WAITING, "not run")                                                                      \
    STATE(FINISHED, "done")                                                                        \
    STATE(FAILED, "failed")   /* the run stopped early, or could not begin */                      \
    STATE(REFUSED, "refused") /* the integrator needs what the system lacks */

typedef enum study_state {
#define STATE_CODE(code, word) STUDY_##code,
    STUDY_STATE_LIST(STATE_CODE)
#undef STATE_CODE
        STUDY_STATES
} study_state;
extern const char *const study_state_words[STUDY_STATES];

/* A cell and its results.  What single steps predict has the same form: trends in the order of the
 * observables, without values where nothing is predicted; time: where the curves end; error: the
 * reason that they end before the run, or that there are none, and then the state is
 * STUDY_FAILED. */
typedef struct study_cell {
    const struct study_case *of_case;
    const dal_method *method;
    double step, tolerance; /* tolerance: of the key; 0: as the options say */
    study_start start;
    char *name;       /* also of its directory */
    bool other_shard; /* it belongs to another shard */
    study_state state;
    dal_error error;
    double time; /* reached */
    long long steps, evaluations;
    double seconds; /* of the thread's processor time, in steps */
    uint64_t bits;  /* a hash of the bits of (q,v) at all samples */
    int observables;
    dal_trend *trend;                /* [observables] in the order of dal_run_observe */
    char (*names)[STUDY_NAME];       /* [observables] */
    double (*windows)[STUDY_TRACKS]; /* maxima; NaN: no rows, or no such column */
    int window_count;
    struct study_cell *predicted; /* with the names of this one; NULL: the study does not predict */
} study_cell;

/* One of some words, or a number within bounds. */
typedef struct study_expectation {
    const char *label, *method, *quantity; /* as they are written */
    double step, tolerance;                /* of these cells alone; 0: of all */
    study_start start;                     /* the same; STUDY_STARTS: of all */
    size_t line;
    unsigned words;  /* bit k: size k, bit DAL_SIZE_COUNT + k: trend k, any of which will do; of
                        the quantity "state" bit k: state k; 0: bounds */
    int field;       /* STUDY_FIELD_x that has bounds, -1: none */
    double min, max; /* infinite where there is no bound */
} study_expectation;

enum { STUDY_STEPS = 16, STUDY_TOLERANCES = 16, STUDY_REPRESENTATIVES = 16 };

/* What is kept of runs: a directory with rows for each, or the results alone, for many short runs.
 */
typedef enum study_rows { STUDY_ROWS_KEPT, STUDY_ROWS_NONE } study_rows;

/* What of cells is in files of results: of those without rows all, and what is predicted. */
typedef enum study_stored {
    STUDY_STORED_RUNS,
    STUDY_STORED_PREDICTIONS,
    STUDY_STORED
} study_stored;

/* One system of a study, with one value for each of its settings.  Cases that differ in these
 * values alone are of one item: they stand together and share the model, the copy and the methods,
 * which belong to the first of them. */
typedef struct study_case {
    const char *name;       /* a built-in name or a path */
    const char *item_label; /* the label in the file, or the last part of the name */
    char *label;            /* name in tables and files; no two cases share one */
    bool is_first;          /* of its item */
    dal_model *model;
    const dal_system *system;
    cli_choices choices; /* of the item */
    char *variant;       /* LABEL_WORD, of the item; NULL: it has one mechanics */
    char *observe; /* formulas that the runs of the item observe, as in --observe; NULL: none */
    char *path;    /* of the system file, from the working directory; NULL: there is a copy, or the
                      system is built in */
    char *copy;    /* of the system file, in the directory of the study; NULL: a built-in system */
    double step[STUDY_STEPS], from, time, displacement; /* time: NaN: not given, but: */
    double tolerance[STUDY_TOLERANCES]; /* positive; of the methods that control their error */
    long long run_steps;                /* steps of each run; 0: not given, but time */
    study_rows rows;
    bool predict;                  /* cells have predictions, too */
    int steps, tolerances, starts; /* tolerances: 0: the options; starts: bit STUDY_x set */
    long long samples, statistics;
    dal_options options;                   /* but step and space, and as they were given: */
    const char *option[REQUEST_OPTIONS];   /* NULL: not given */
    request_settings set, start, displace; /* displace: in units of displacement */
    dal_method *methods;
    int method_count;
    bool is_projected;         /* +project was added to some, for holonomic constraints */
    double (*method_steps)[2]; /* [method_count] that the cells of the item take, on each space */
    int first_cell, cells;     /* its cells are consecutive */
} study_case;

typedef struct study_plan {
    const char *copies; /* directory with copies of system files, or NULL */
    const char *runs;   /* where the directories of the runs are */
    struct study_results *results[STUDY_STORED]; /* NULL where no cell has any there */
    struct study_motion *motions;                /* [cases] while cells are run, for predictions */
    uint64_t *key;   /* [cells] by which results name them; NULL until results are read */
    double interval; /* seconds between checkpoints of a run */
    native_mode native;
    const char *title;
    document *doc; /* the parsed text, to which all names point */
    study_case *cases;
    int case_count;
    study_cell *cells;
    int cell_count;
    study_expectation *expectations;
    int expectation_count;
    dal_method representative[STUDY_REPRESENTATIVES];
    int representatives;
    double seconds;       /* that the runs have taken */
    bool has_tolerances;  /* a case has the key tolerance: files have that column */
    bool has_predictions; /* likewise of `predict: on` */
    bool shows_tables, shows_matrices;
    screen_format format;
} study_plan;

/* Forgets the results. */
void study_cell_free(study_cell *cell);
/* The name of a cell, allocated. */
char *study_cell_name(const study_cell *cell);
/* "h = 0.1", or "h = 0.1, tolerance 1e-06", for tables. */
enum { STUDY_DIVISION = 64 };
const char *study_division(char text[STUDY_DIVISION], double step, double tolerance);
/* The trend of an observable by name, NULL for none; of the constraint with the largest D. */
const dal_trend *study_cell_trend(const study_cell *cell, const char *name);
const dal_trend *study_cell_constraint(const study_cell *cell);
/* The trends that tables show, NULL where the cell has none, and the name of the invariant that
 * moved farthest, or "". */
typedef struct study_quantities {
    const dal_trend *D, *E, *H, *p, *pi, *pi_e, *invariant, *error;
    const char *invariant_name;
} study_quantities;
study_quantities study_cell_quantities(const study_cell *cell);
/* The time of its run in steps. */
double study_cell_length(const study_cell *cell);
/* The steps of all cells that take the same ones, kept by the case. */
double *study_cell_method_steps(const study_cell *cell);
/* The finished cell in (q,v) with the same method, step and tolerance as one on the surface, or
 * NULL. */
const study_cell *study_cell_physical(const study_plan *plan, const study_cell *cell);
/* How many cells of this shard are in each state, count[STUDY_STATES], and the first that failed,
 * or NULL.  Returns how many they are. */
int study_count_states(const study_plan *plan, int *count, const study_cell **failed);

/* Where the runs of a step end, in t. */
double study_case_end(const study_case *item, double step);
/* What the system of a case is read from: its copy, its file, or its name. */
const char *study_case_system(const study_case *item);

#endif
