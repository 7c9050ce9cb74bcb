/* order_screen.c - errors and orders on a terminal. */
#include "order_screen.h"
#include "ui/memory.h"
#include "ui/screen.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ROWS = 11 };
/* The error to which times are compared. */
static const double target = 1e-6;

/* The seconds of the largest step, or tolerance, whose error is at most the target. */
static double seconds_to_target(const order_study *s, const order_method *m, int *level)
{
    for (*level = 0; *level < s->levels; ++*level)
        if (m->state == ORDER_DONE && m->order.error[*level] <= target) return m->seconds[*level];
    return INFINITY;
}

/* The cells of a method; of the two lines above the columns for m = NULL. */
static void add_cells(screen_table *t, const order_study *s, const order_method *m, int line)
{
    const int last = s->levels - 1;
    const double steps = (double)order_count_steps(s, s->step[last]);
    const bool is_controlled = s->set->tolerances != NULL;
    const double *levels = is_controlled ? s->tolerance : s->step;
    char x[SCREEN_NUMBER];
    if (!m) {
        static const char *const heads[2][5] = {{"", "order", "", "a step", "takes"},
                                                {"integrator", "stated", "found", "F", "us"}};
        for (int i = 0; i < 3; i++) screen_add_cell(t, SCREEN_PLAIN, "%s", heads[line][i]);
        for (int i = 0; i < s->levels; i++)
            screen_add_cell(t, SCREEN_PLAIN, "%s",
                            line == 1 ? screen_number(x, levels[i], 3)
                            : i == 0  ? "error"
                            : i == 1  ? (is_controlled ? "at tol" : "at h =")
                                      : "");
        for (int i = 3; i < 5; i++) screen_add_cell(t, SCREEN_PLAIN, "%s", heads[line][i]);
        return;
    }
    screen_add_cell(t, SCREEN_PLAIN, "%s", m->name);
    screen_add_cell(t, SCREEN_PLAIN, "%d", dal_method_order(&m->method));
    if (!isnan(m->order.order))
        screen_add_cell(t, SCREEN_PLAIN, "%.2f", m->order.order);
    else
        screen_add_cell(
            t, SCREEN_FAINT, "%s",
            is_controlled || m->state != ORDER_DONE ? "-" : order_outcome_words[m->order.outcome]);
    for (int i = 0; i < s->levels; i++) {
        const double error = m->order.error[i];
        screen_add_cell(t, isnan(error) ? SCREEN_FAINT : screen_colour_of(error), "%s",
                        isnan(error) ? "-" : screen_number(x, error, 2));
    }
    const bool succeeded = m->failure[last].status == DAL_STATUS_OK;
    const double cost[] = {(double)m->order.evaluations[last] / steps,
                           1e6 * m->seconds[last] / steps};
    for (int i = 0; i < 2; i++)
        screen_add_cell(t, SCREEN_PLAIN, "%s", succeeded ? screen_number(x, cost[i], 2) : "-");
}

/* The headings of a table by itself, in one line. */
static void add_document_heads(screen_table *t, const order_study *s)
{
    static const char *const first[] = {"integrator", "order", "order found"};
    char x[SCREEN_NUMBER];
    const bool is_controlled = s->set->tolerances != NULL;
    for (int i = 0; i < 3; i++) screen_add_cell(t, SCREEN_PLAIN, "%s", first[i]);
    for (int i = 0; i < s->levels; i++)
        screen_add_cell(t, SCREEN_PLAIN, "%s = %s", is_controlled ? "error at tol" : "error at h",
                        screen_number(x, is_controlled ? s->tolerance[i] : s->step[i], 3));
    screen_add_cell(t, SCREEN_PLAIN, "F per step");
    screen_add_cell(t, SCREEN_PLAIN, "us per step");
}

int order_print_screen(const order_study *s)
{
    const order_method *end = s->methods + s->method_count, *best = NULL;
    int left_out = 0, best_level = 0, rows = 0;
    bool is_mixed = false;
    char space[80], x[SCREEN_NUMBER], h[SCREEN_NUMBER];
    screen_table t = {
        .columns = s->levels + 5, .gap = 1, .heads = s->set->format == SCREEN_TEXT ? 2 : 1};
    screen out;
    screen_open(&out, stdout, s->set->format);
    if (t.heads == 1)
        add_document_heads(&t, s);
    else
        for (int line = 0; line < 2; line++) add_cells(&t, s, NULL, line);
    for (const order_method *m = s->methods; m < end; m++) {
        int level;
        const double seconds = seconds_to_target(s, m, &level);
        int of_best;
        if (isfinite(seconds) && (!best || seconds < seconds_to_target(s, best, &of_best))) {
            best = m;
            best_level = level;
        }
        is_mixed |= order_space(s, m) != s->spec.options.space;
        if (m->state == ORDER_REFUSED) continue;
        if (rows++ < screen_limit(&out, ROWS))
            add_cells(&t, s, m, 0);
        else
            left_out++;
    }

    snprintf(space, sizeof space, "%s%s",
             s->spec.options.space == DAL_LIFTED ? "on the lift" : "in (q, v)",
             is_mixed ? ", in (q, v) where a method has none" : "");
    screen_say(&out, 2, "%s: error of (q, v) at t = %g %s, against %s%s%s",
               s->simulation->request.system_name, s->simulation->request.time, space,
               s->reference_method ? s->reference_method : "the exact solution",
               s->reference_method ? ", itself within " : "",
               s->reference_method ? screen_number(x, s->noise, 1) : "");
    if (best)
        screen_say(&out, 2, "Below an error of %s first: %s with %s = %s, in %s s",
                   screen_number(x, target, 1), best->name, s->set->tolerances ? "tolerance" : "h",
                   screen_number(h, best->order.step[best_level], 3),
                   screen_number(space, best->seconds[best_level], 2));
    screen_skip(&out);
    const int columns = screen_add_table(&out, &t, "lr", 0);
    screen_free_table(&t);
    if (left_out > 0) screen_say(&out, 2, "... and %d more methods (--details)", left_out);
    if (columns > 0) screen_say(&out, 2, "... and %d more columns (--details)", columns);
    for (const order_method *m = s->methods; m < end; m++)
        if (m->state != ORDER_DONE && (m->state == ORDER_FAILED || s->method_count < ROWS))
            screen_say(&out, 4, "%s: %s: %s", m->name,
                       m->state == ORDER_FAILED ? "failed" : "refused",
                       order_failure_message(s, m));
    return screen_close(&out, "--details");
}
