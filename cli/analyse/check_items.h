/* check_items.h - what the parts of `dalembert check` share: the system, points about its start,
 * and the items of the report. */
#ifndef DAL_CLI_CHECK_ITEMS_H
#define DAL_CLI_CHECK_ITEMS_H

#include "analysis.h"
#include "dalembert_evaluator.h"
#include "run/simulation.h"
#include "ui/message.h"

#include <stdbool.h>

/* The result of an item.  code, text */
#define CHECK_RESULT_LIST(RESULT)                                                                  \
    RESULT(OK, "ok")                                                                               \
    RESULT(FAIL, "FAIL")                                                                           \
    RESULT(UNMEASURED, "not measured")                                                             \
    RESULT(INFO, "info")

typedef enum check_result {
#define RESULT_CODE(code, text) CHECK_##code,
    CHECK_RESULT_LIST(RESULT_CODE)
#undef RESULT_CODE
} check_result;

/* An item of the report. */
typedef struct check_entry {
    const char *section;
    char *what; /* NULL: the section does not apply */
    check_result result;
    double value, least, most; /* a number and its limits; NaN: it has none */
    char *text;
} check_entry;

enum { CHECK_POINTS = 8 };

/* What an integrator may preserve of a system.  code, word */
#define CHECK_PRESERVED_LIST(PRESERVED)                                                            \
    PRESERVED(D, "D")                                                                              \
    PRESERVED(E, "E")                                                                              \
    PRESERVED(FORM, "symplectic form")                                                             \
    PRESERVED(REVERSAL, "reversal")

enum {
#define PRESERVED_CODE(code, word) CHECK_PRESERVES_##code,
    CHECK_PRESERVED_LIST(PRESERVED_CODE)
#undef PRESERVED_CODE
        CHECK_PRESERVED
};

/* An integrator of the library, and the system. */
typedef struct check_method {
    char *name;
    char *reason;       /* why it is refused; NULL: it is accepted */
    unsigned preserved; /* bits 1 << CHECK_PRESERVES_x */
} check_method;

typedef struct check {
    dal_scaled *scaled; /* the system of the request in units of its own: */
    const dal_system *system;
    run_simulation *simulation; /* of the arguments, its system made */
    dal_evaluator *evaluator;
    double *start;                   /* [2n + multipliers + 1] q, v, g, e */
    int n, m, nw, size;              /* nw = n + multipliers, size = n + nw */
    bool is_regular;                 /* F is finite at the start */
    dal_point origin;                /* the start, at t = 0 */
    dal_point near[CHECK_POINTS];    /* points about the start, 0 <= t < 1 */
    dal_point surface[CHECK_POINTS]; /* the same, projected to D = 0 */
    int near_count, surface_count;
    double *values;      /* scratch for the values of any one callback */
    const char *section; /* the present one */
    check_entry *entry;  /* [items] the report */
    int items, failed, unmeasured;
    char **preserving;     /* [preservers] names of integrators that preserve D; */
    int preservers;        /* -1: it is not known which, or there is no D, or all do */
    dal_growth growth;     /* of D; no levels where it has none */
    unsigned preserving_D; /* properties of integrators, one of which suffices */
    bool is_D_constant;    /* all preserve D */
    check_method *method;  /* [methods] */
    int methods;
} check;

/* Adds an item: what is examined, the result, and a text.  CHECK_UNMEASURED is as bad as a
 * failure. */
void check_item(check *c, check_result result, const char *what, const char *format, ...)
    CLI_PRINTF(4, 5);
/* The same of a number; an infinite limit is none. */
void check_number(check *c, check_result result, const char *what, double value, double least,
                  double most, const char *format, ...) CLI_PRINTF(7, 8);
/* The item of a number with an upper limit. */
void check_bound(check *c, const char *what, double value, double limit);

#endif
