/* order_study.h - what orders are measured of, and what was measured. */
#ifndef DAL_CLI_ORDER_STUDY_H
#define DAL_CLI_ORDER_STUDY_H

#include "dalembert_order.h"
#include "run/simulation.h"
#include "ui/screen.h"

#include <stdbool.h>

typedef struct order_settings {
    run_simulation simulation;
    const char *integrators, *steps; /* lists between commas; steps NULL: step and level_count */
    const char *tolerances;          /* a list; NULL: none, else the step stays the same */
    const char *output;
    long long level_count, threads;
    bool json; /* to stdout, instead of a table */
    screen_format format;
    bool details;    /* on a terminal, too, what a pipe gets */
    bool force;      /* into any directory */
    bool is_written; /* set when output has the table */
} order_settings;

enum { ORDER_NAME = 128 };

/* The result of a method.  code, word */
#define ORDER_STATE_LIST(STATE)                                                                    \
    STATE(DONE, "done") STATE(FAILED, "failed") STATE(REFUSED, "refused")

typedef enum order_state {
#define STATE_CODE(code, word) ORDER_##code,
    ORDER_STATE_LIST(STATE_CODE)
#undef STATE_CODE
} order_state;

typedef struct order_method {
    dal_method method;
    char name[ORDER_NAME];
    dal_order order;                     /* error is NaN where the run failed */
    double seconds[DAL_ORDER_LEVELS];    /* of processor time */
    dal_error failure[DAL_ORDER_LEVELS]; /* status DAL_STATUS_OK where the run succeeded */
    order_state state;                   /* failed: at one step at least */
} order_method;

typedef struct order_study {
    order_settings *set;
    run_simulation *simulation;
    dal_run_spec spec;                                          /* except method and step */
    double step[DAL_ORDER_LEVELS], tolerance[DAL_ORDER_LEVELS]; /* tolerance: 0 unless it falls */
    int levels;
    bool divides; /* the step was not given, and is the whole time */
    order_method *methods;
    int method_count;
    int numbers;         /* that are compared: q, v and vakonomic g */
    const double *units; /* [numbers] of theirs: errors are fractions of these, or of a number */
    dal_scaled *scaled;  /* has them */
    double *reference;   /* [numbers] at T, and room for as many */
    const char *reference_method; /* NULL: the exact solution */
    double reference_step, reference_tolerance;
    double noise; /* the error of the reference; 0 where it is not known */
} order_study;

/* The words of DAL_ORDER_OUTCOME_LIST. */
extern const char *const order_outcome_words[];
/* Steps of this size from the start to T. */
long long order_count_steps(const order_study *s, double h);
/* The reason of the first failure of a method. */
const char *order_failure_message(const order_study *s, const order_method *m);
/* The space of the runs of a method: lifted where the method and the system have a lift, unless
 * --space says otherwise. */
dal_space order_space(const order_study *s, const order_method *m);

#endif
