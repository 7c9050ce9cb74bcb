/* order.h - `dalembert order`: methods x steps on one system, and what is told of them. */
#ifndef DAL_CLI_ORDER_H
#define DAL_CLI_ORDER_H

#include "analysis.h"

enum { ORDER_NAME = 128 };

/* code, word: what became of a method */
#define ORDER_STATE_LIST(X) X(DONE, "done") X(FAILED, "failed") X(REFUSED, "refused")

typedef enum order_state {
#define X(code, word) ORDER_##code,
    ORDER_STATE_LIST(X)
#undef X
} order_state;
const char *order_state_word(order_state state);

typedef struct order_method {
    dal_method method;
    char name[ORDER_NAME];
    dal_order order;                  /* error is NaN where the step failed */
    double seconds[DAL_ORDER_LEVELS]; /* of processor time */
    dal_error why[DAL_ORDER_LEVELS];  /* status DAL_OK where it went through */
    order_state state;                /* refused, or failed at some step, or done */
} order_method;

typedef struct order_study {
    cli_job job;
    const char *system; /* the name it has in the table */
    double step[DAL_ORDER_LEVELS];
    int levels, threads;
    order_method *methods;
    int method_count;
    int numbers;       /* that are compared: q, v and vakonomic g */
    double *reference; /* [numbers] at T */
    const char *judge; /* what gave it: "the exact solution", "gauss12 with h = 0.01" */
    double noise;      /* its own error; 0 when not known */
    char judge_text[ORDER_NAME];
} order_study;

/* ---- order_run.c ---- */

/* The reference; then every method at every step, on threads.  Return CLI_DONE or print and return
 * an exit status. */
int order_reference(order_study *study);
int order_run(order_study *study);

/* ---- order_table.c ---- */

/* The table for the eye, and that for programs. */
void order_print(FILE *out, const order_study *study);
int order_write(const order_study *study, const char *path);
/* DIR/order.svg and DIR/work.svg from DIR/order.csv, with their scripts. */
int order_draw(const order_study *study, const char *directory);

#endif
