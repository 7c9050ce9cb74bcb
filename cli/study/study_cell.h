/* study_cell.h - one cell of a study: a run and its results. */
#ifndef DAL_CLI_STUDY_CELL_H
#define DAL_CLI_STUDY_CELL_H

#include "dalembert_analysis.h"

#include <stdbool.h>
#include <stdint.h>

struct study_case;
struct study_plan;

/* Where a cell starts.  code, word, space, what it is */
#define STUDY_START_LIST(START)                                                                    \
    START(PHYSICAL, "physical", DAL_PHYSICAL, "(q,v) alone")                                       \
    START(SURFACE, "surface", DAL_LIFTED, "lifted, on p = pi = 0")                                 \
    START(DISPLACED, "displaced", DAL_LIFTED, "lifted, p and pi displaced")

enum {
#define START_CODE(code, word, space, about) STUDY_##code,
    STUDY_START_LIST(START_CODE)
#undef START_CODE
        STUDY_STARTS
};
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

typedef struct study_cell {
    const struct study_case *of_case;
    const dal_method *method;
    double step, tolerance; /* tolerance: of the key; 0: as the options say */
    int start;
    char *name;      /* that of its directory, too */
    int other_shard; /* it belongs to another shard */
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
} study_cell;

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
/* Those of all cells that take the same steps, kept by the case. */
double *study_cell_method_steps(const study_cell *cell);
/* The finished cell in (q,v) with the same method, step and tolerance as one on the surface, or
 * NULL. */
const study_cell *study_cell_physical(const struct study_plan *plan, const study_cell *cell);

/* Called now and then while a run goes: whether to stop it, with a checkpoint. */
typedef struct study_stop_check {
    int (*stop)(void *user);
    void *user;
} study_stop_check;

/* Runs a cell in its directory, resumes it there, or reads its results when it is finished; without
 * a check interruptions alone stop it.  How the run ended is in the cell; its state stays
 * STUDY_WAITING when it was stopped.  Returns CLI_DONE; CLI_SIGNAL when it was stopped; or prints
 * and returns an exit status.  Different cells may be run by different threads. */
int study_cell_run(const struct study_plan *plan, study_cell *cell, const study_stop_check *check);
/* Whether the run of a cell can be made: a refused one has none. */
bool study_cell_is_runnable(study_cell *cell);

#endif
