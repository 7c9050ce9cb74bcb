/* study.h - a study: systems x integrators x steps x starts, cell by cell.
 *
 *     study_plan    what is asked for, from a YAML text            study_plan.c, document.c
 *     study_cell    one run and what became of it                  study_cell_run.c
 *     study_pool    all cells on several threads                   study_pool.c
 *     tables, CSV   what is told about the cells                   study_table.c, study_csv.c */
#ifndef DAL_CLI_STUDY_H
#define DAL_CLI_STUDY_H

#include "dalembert_analysis.h"
#include "run/native.h"

#include <stdint.h>
#include <stdio.h>

/* ---- the plan ---- */

/* The keys of a study file: name, where it may stand, what it says.  Beside `systems` a key is the
 * default of every system. */
#define STUDY_KEY_LIST(X)                                                                          \
    X(title, "study", "text")                                                                      \
    X(systems, "study", "list of names, paths, or mappings of the keys below")                     \
    X(expect, "study", "label: {integrator: {quantity: what must become of it}}; see below")       \
    X(integrators, "both", "list of names with modifiers; all, all+project: every integrator")     \
    X(step, "both", "one step, or at most 16")                                                     \
    X(time, "both", "integrate from 0 to this, in whole steps")                                    \
    X(samples, "both", "rows kept of each run (400)")                                              \
    X(statistics, "both", "look at the quantities after every K-th step (1)")                      \
    X(seeds, "both", "integers; a case for each of them where something is drawn")                 \
    X(options, "both", "of the runs, but step and space: solver: newton, extend-energy: on, ..")   \
    X(starts, "both", "list of physical, surface, displaced (all three)")                          \
    X(displacement, "both", "size d of p, pi where displaced (1e-8)")                              \
    X(system, "system", "a built-in name or a path")                                               \
    X(label, "system", "another name for tables and files")                                        \
    X(set, "system", "parameter: values")                                                          \
    X(start, "system", "name: values")                                                             \
    X(displace, "system",                                                                          \
      "p_x: value in units of d; without it p = d, -d/2, .., pi = d/2, -d/3, ..")

/* Where a cell starts.  word, space, what it is */
#define STUDY_START_LIST(X)                                                                        \
    X(PHYSICAL, "physical", "physical", "(q,v) alone")                                             \
    X(SURFACE, "surface", "lifted", "lifted, on p = pi = 0")                                       \
    X(DISPLACED, "displaced", "lifted", "lifted, p and pi displaced")

enum {
#define X(code, word, space, about) STUDY_##code,
    STUDY_START_LIST(X)
#undef X
        STUDY_STARTS
};
const char *study_start_word(int start);

enum { STUDY_NAME = 80, STUDY_STEPS = 16 };

/* The options of the library, by number and by word. */
enum {
#define X(type, name, word, initial, least, greatest, value, help) STUDY_OPTION_##name,
    DAL_OPTION_LIST(X)
#undef X
        STUDY_OPTIONS
};
const char *study_option_word(int option);

/* One system of a study, with one value for each of its settings, and all that is to be done with
 * it.  Entries that differ in these values alone come from one group, stand together and share
 * model, copy and methods, which belong to the first of them. */
typedef struct study_case {
    const char *name;  /* a built-in name or a path */
    const char *group; /* its label in the file, or what stands for one */
    char *label;       /* what it is called in tables and files; no two cases share one */
    int is_first;      /* of its group */
    dal_model *model;
    const dal_system *system;
    char *copy; /* of the system file, in the directory of the study; NULL: a built-in system */
    double step[STUDY_STEPS], time, displacement;
    int steps, starts; /* starts: bit STUDY_x set */
    long long samples, statistics;
    const char *option[STUDY_OPTIONS]; /* what was said; NULL: nothing.  All but step and space */
    dal_setting *set, *start, *displace;
    int set_count, start_count, displace_count;
    char *names; /* of velocities, where start names those that were brought onto D = 0 */
    dal_method *methods;
    int method_count;
    int first_cell, cells; /* its cells stand together */
    native_mode native;
} study_case;

typedef struct study_cell study_cell;
typedef struct study_expectation study_expectation;

typedef struct study_plan {
    const char *place;  /* the file, for messages */
    const char *copies; /* where copies of system files are read instead; NULL: nowhere */
    const char *runs;   /* where the directories of the runs are */
    double interval;    /* seconds between checkpoints of a run */
    const char *title;
    void *document; /* the parsed text, where the names live */
    study_case *cases;
    int case_count;
    study_cell *cells;
    int cell_count;
    study_expectation *expectations;
    int expectation_count;
} study_plan;

/* Reads a plan and makes its systems and cells; copies as in study_plan, which keeps it.  Returns
 * CLI_DONE or prints and returns an exit status; study_plan_free it in any case. */
int study_plan_read(study_plan *plan, const char *place, const char *text, size_t length,
                    const char *copies);
void study_plan_free(study_plan *plan);
/* DIRECTORY/LABEL.yaml, where the copy of a system file lies; allocated. */
char *study_system_copy(const char *directory, const study_case *item);

/* ---- cells ---- */

/* What is followed through time for the figures, window by window: code, column. */
#define STUDY_TRACK_LIST(X)                                                                        \
    X(D, "D")                   /* max |D_a| */                                                    \
    X(E, "E")                   /* |E - E(0)| */                                                   \
    X(H, "H")                   /* |H - H(0)| */                                                   \
    X(P, "p")                   /* max |p| */                                                      \
    X(PI, "pi")                 /* max |pi| */                                                     \
    X(INVARIANTS, "invariants") /* max |I - I(0)| / max(1, |I(0)|) */                              \
    X(ERROR, "error")           /* against the exact solution */

enum {
#define X(code, column) STUDY_TRACK_##code,
    STUDY_TRACK_LIST(X)
#undef X
        STUDY_TRACKS
};
const char *study_track_column(int track);

enum { STUDY_WINDOWS = 100 };

/* Whether a cell has been run, and how that ended. */
#define STUDY_STATE_LIST(X)                                                                        \
    X(WAITING, "not run")                                                                          \
    X(FINISHED, "done")                                                                            \
    X(FAILED, "failed")   /* the run broke off, or could not begin */                              \
    X(REFUSED, "refused") /* the integrator needs what the system lacks */

typedef enum study_state {
#define X(code, word) STUDY_##code,
    STUDY_STATE_LIST(X)
#undef X
} study_state;
const char *study_state_word(study_state state);

struct study_cell {
    const study_case *of_case;
    const dal_method *method;
    double step;
    int start;
    int elsewhere; /* it belongs to another shard */
    study_state state;
    dal_error error;
    double time; /* reached */
    long long steps, evaluations;
    double seconds; /* of the thread's processor time, in steps */
    uint64_t bits;  /* a hash of the bits of (q,v) at all samples */
    int observables;
    dal_trend *trend;          /* [observables] in the order of dal_run_observe */
    char (*names)[STUDY_NAME]; /* [observables] */
    double (*windows)[STUDY_TRACKS];
    int window_count;
};

/* Asked now and then while a run goes: whether it is to stop, with a checkpoint. */
typedef struct study_stop_check {
    int (*stop)(void *user);
    void *user;
} study_stop_check;

/* Runs a cell in its directory, or goes on with it, or reads what is finished; watch may be NULL,
 * for interruptions alone.  What befalls the run is in the cell; its state stays STUDY_WAITING
 * when it was stopped.  Returns CLI_DONE; CLI_SIGNAL when it was stopped; or prints and returns an
 * exit status.  Different cells may be run by different threads. */
int study_cell_run(const study_plan *plan, study_cell *cell, const study_stop_check *watch);
void study_cell_free(study_cell *cell);
/* Whether the run of a cell can be made at all: a refused one has none. */
int study_cell_is_runnable(study_cell *cell);
/* Its name, which is that of its directory below plan->runs; and that directory.  Allocated, NULL
 * when memory is out. */
char *study_cell_name(const study_cell *cell);
char *study_cell_directory(const study_plan *plan, const study_cell *cell);
/* What became of an observable by name, or NULL; of the worst of D1, D2, ... and of the invariants.
 */
const dal_trend *study_trend(const study_cell *cell, const char *name);
const dal_trend *study_worst_constraint(const study_cell *cell);
const dal_trend *study_worst_invariant(const study_cell *cell, const char **name);
/* The cell with the same method and step in (q,v), or NULL. */
const study_cell *study_physical_cell(const study_plan *plan, const study_cell *cell);

/* ---- running, telling ---- */

/* What concerns the running alone. */
typedef struct study_run_options {
    int threads;
    double interval; /* seconds between checkpoints of a run */
    native_mode native;
} study_run_options;

/* Goes on with the study in a directory.  Returns the exit status. */
int study_resume(const char *directory, const study_run_options *options);

typedef struct study_output study_output;

/* The cells by falling cost, so that none is left for the end; allocated. */
int *study_sort_cells(const study_plan *plan);
/* Runs all cells that are not elsewhere, on threads.  Returns CLI_DONE, CLI_SIGNAL when it was
 * interrupted, or the exit status of the first failure of the program's own, which was told. */
int study_pool_run(study_plan *plan, int threads);

/* The files of a study below a directory:
 *     cells.csv        a row per cell
 *     quantities.csv   a row per cell and observable
 *     series/LABEL.csv the tracks of the cells of a case, window by window
 * All functions return CLI_DONE or print and return CLI_IO. */
int study_output_open(study_output **output, const char *directory);
int study_output_cell(study_output *output, const study_plan *plan, const study_cell *cell);
int study_output_close(study_output *output);

/* How many expectations are not met; whether one of them says that this cell fails.  Their table,
 * if there are any; and a file with all of them: CLI_DONE, or prints and returns CLI_IO. */
int study_count_unmet(const study_plan *plan);
int study_failure_is_expected(const study_plan *plan, const study_cell *cell);
void study_print_expectations(FILE *out, const study_plan *plan);
int study_write_expectations(const study_plan *plan, const char *path);

/* The tables of one case, and the note that belongs under all of them. */
void study_print_case(FILE *out, const study_plan *plan, const study_case *item);
void study_print_note(FILE *out, const study_plan *plan);

#endif
