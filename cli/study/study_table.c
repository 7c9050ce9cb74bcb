/* study_table.c - the results of a study, in tables for readers and as CSV.
 *
 * The tables are per system and step: the motion itself (D, E, invariants, error), whose numbers
 * describe (q,v) alone; and, off p = pi = 0, what only the lift can show (H, p, pi). */
#include "study_table.h"

#include "io/csv_cells.h"
#include "io/file.h"
#include "io/file_output.h"
#include "io/trend.h"
#include "study_predict.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/wrap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { METHOD = 28, CELL = 32 };

typedef struct table_row {
    const study_plan *plan;
    const study_cell *cell;
    study_quantities q;
    bool only; /* there is no lifted form of the method */
} table_row;

/* ---- columns ------------------------------------------------------------------------------- */

/* A format of a number, or 0 where it is exactly so. */
static void say_number(char *text, const dal_trend *trend, const char *format, double x)
{
    if (!trend || trend->count <= 0) return;
    if (x == 0.0)
        snprintf(text, CELL, "0");
    else
        snprintf(text, CELL, format, x);
}

/* "rounding, linear"; "exact" has no trend, and "aborted" no size. */
static void say_trend(char *text, const dal_trend *trend)
{
    if (!trend || trend->conservation != DAL_CONSERVED) return;
    if (trend->trend == DAL_TREND_ABORTED) {
        snprintf(text, CELL, "%s", dal_trend_text(trend->trend));
        return;
    }
    const bool is_exact = trend->size == DAL_SIZE_EXACT;
    snprintf(text, CELL, "%s%s%s", dal_size_text(trend->size), is_exact ? "" : ", ",
             is_exact ? "" : dal_trend_text(trend->trend));
}

static void say_same(char *text, const table_row *r)
{
    const study_cell *physical = study_cell_physical(r->plan, r->cell);
    if (r->only) snprintf(text, CELL, "only");
    if (physical) snprintf(text, CELL, "%s", physical->bits == r->cell->bits ? "same" : "DIFFERS");
}

/* Seconds are in cells.csv alone, since tables have the same bytes in every run. */
#define SIZE(quantity, member)                                                                     \
    say_number(text, r->q.quantity, "%.1e", r->q.quantity ? r->q.quantity->member : 0.0)
#define RATE(quantity)                                                                             \
    say_number(text, r->q.quantity, "%+.0e", r->q.quantity ? r->q.quantity->rate : 0.0)
#define TREND(quantity) say_trend(text, r->q.quantity)

#define WORK_LIST(COLUMN)                                                                          \
    COLUMN("steps", "", 8, snprintf(text, CELL, "%lld", r->cell->steps))                           \
    COLUMN("evals", "/step", 6,                                                                    \
           snprintf(text, CELL, "%.1f",                                                            \
                    r->cell->steps > 0 ? (double)r->cell->evaluations / (double)r->cell->steps     \
                                       : 0.0))

/* head, second line of the head, width, how the text is made */
#define MOTION_LIST(COLUMN)                                                                        \
    COLUMN("max", "|D|", 8, SIZE(D, max_abs))                                                      \
    COLUMN("D rate", "per t", 7, RATE(D))                                                          \
    COLUMN("D", "", 20, TREND(D))                                                                  \
    COLUMN("max", "|E-E0|", 8, SIZE(E, deviation))                                                 \
    COLUMN("E rate", "per t", 7, RATE(E))                                                          \
    COLUMN("E", "", 20, TREND(E))                                                                  \
    COLUMN("max", "|I-I0|", 8, SIZE(invariant, deviation))                                         \
    COLUMN("max", "error", 8, SIZE(error, max_abs))                                                \
    COLUMN("(q,v)", "alone", 8, say_same(text, r))                                                 \
    WORK_LIST(COLUMN)

#define LIFT_LIST(COLUMN)                                                                          \
    COLUMN("H0", "", 9, SIZE(H, first))                                                            \
    COLUMN("max", "|H-H0|", 8, SIZE(H, deviation))                                                 \
    COLUMN("H rate", "per t", 7, RATE(H))                                                          \
    COLUMN("H", "", 20, TREND(H))                                                                  \
    COLUMN("max", "|p|", 8, SIZE(p, max_abs))                                                      \
    COLUMN("max", "|pi|", 8, SIZE(pi, max_abs))                                                    \
    COLUMN("|pi| rate", "per t", 10, RATE(pi))                                                     \
    COLUMN("max", "|D|", 8, SIZE(D, max_abs))                                                      \
    WORK_LIST(COLUMN)

/* ---- rows ---------------------------------------------------------------------------------- */

/* The two lines of the head, or with a row the line of a cell. */
#define PUT_COLUMN(head, second, width, what)                                                      \
    {                                                                                              \
        char text[CELL] = "";                                                                      \
        if (r) {                                                                                   \
            what;                                                                                  \
        }                                                                                          \
        const char *shown = line == 0 ? head : line == 1 ? second : text[0] ? text : "-";          \
        fprintf(out, " %*s", width, shown);                                                        \
    }

static void put_motion(FILE *out, int line, const table_row *r) { MOTION_LIST(PUT_COLUMN) }
static void put_lift(FILE *out, int line, const table_row *r) { LIFT_LIST(PUT_COLUMN) }

/* A cell without numbers has its state instead. */
static void put_state(FILE *out, const study_cell *c)
{
    fprintf(out, " %s", study_state_words[c->state]);
    if (c->state == STUDY_FAILED && c->steps > 0) fprintf(out, " after t = %.6g", c->time);
    if (c->error.message[0]) fprintf(out, ": %s", c->error.message);
}

/* ---- tables -------------------------------------------------------------------------------- */

static bool is_in_table(const study_cell *c, double step, double tolerance, study_start start)
{
    return c->step == step && c->tolerance == tolerance && c->start == start;
}

static void print_table(FILE *out, const study_plan *plan, const study_case *e, double step,
                        double tolerance, study_start start)
{
#define START_TITLE(code, word, space, about) about,
    static const char *const titles[] = {STUDY_START_LIST(START_TITLE)};
#undef START_TITLE
    void (*const put_line)(FILE *, int, const table_row *) =
        start == STUDY_DISPLACED ? put_lift : put_motion;
    char division[STUDY_DIVISION];
    fprintf(out, "\n %s%s, %s, T = %g\n", start == STUDY_PHYSICAL ? "in " : "", titles[start],
            study_division(division, step, tolerance), study_case_end(e, step));
    for (int line = 0; line < 2; line++) {
        fprintf(out, "  %-*s", METHOD, line == 0 ? "integrator" : "");
        put_line(out, line, NULL);
        fputc('\n', out);
    }
    for (int i = e->first_cell; i < e->first_cell + e->cells; i++) {
        const study_cell *c = &plan->cells[i];
        char name[STUDY_NAME];
        if (c->other_shard || !is_in_table(c, step, tolerance, start)) continue;
        fprintf(out, "  %-*s", METHOD, dal_method_name(c->method, name, sizeof name));
        /* A method without lifted form has its numbers in (q,v), where those on the surface would
         * be the same. */
        const study_cell *physical =
            c->state == STUDY_REFUSED ? study_cell_physical(plan, c) : NULL;
        if (physical) c = physical;
        const table_row row = {plan, c, study_cell_quantities(c), physical != NULL};
        if (c->state != STUDY_FINISHED)
            put_state(out, c);
        else
            put_line(out, 2, &row);
        fputc('\n', out);
    }
}

/* One of the methods without a tolerance, and one for each tolerance. */
static void print_tables(FILE *out, const study_plan *plan, const study_case *e, double step,
                         study_start start)
{
    for (int k = -1; k < e->tolerances; k++) {
        const double tolerance = k < 0 ? 0.0 : e->tolerance[k];
        int i = e->first_cell;
        while (i < e->first_cell + e->cells &&
               !is_in_table(&plan->cells[i], step, tolerance, start))
            i++;
        if (i < e->first_cell + e->cells) print_table(out, plan, e, step, tolerance, start);
    }
}

void study_print_case(FILE *out, const study_plan *plan, const study_case *e)
{
    fprintf(out, "\n%s%s%s\n", e->label, e->system->title ? ": " : "",
            e->system->title ? e->system->title : "");
    for (int h = 0; h < e->steps; h++)
        for (study_start start = 0; start < STUDY_STARTS; start++) {
            /* The numbers on the surface describe (q,v); the files hold both. */
            const bool repeats = start == STUDY_PHYSICAL && e->starts & 1 << STUDY_SURFACE;
            if (e->starts & 1 << start && !repeats) print_tables(out, plan, e, e->step[h], start);
        }
}

void study_print_note(FILE *out, const study_plan *plan)
{
    static const char lift[] =
        "\n"
        "What this shows.  On p = pi = 0 a lifted method is the same method on (q,v), bit for\n"
        "bit ('same'), p and pi stay zero and so does H; a method that has no lifted form is\n"
        "shown in (q,v) alone ('only').  That a method is symplectic on the lift says nothing\n"
        "there about D or the energy: every one-step method whose step is locally invertible,\n"
        "explicit Euler included, is the restriction of a symplectic one.  D and E are kept, or\n"
        "not, for other reasons: the form of D, whether D is enforced or projected on,\n"
        "reversibility.  What symplecticity does keep shows\n"
        "off p = pi = 0, in H.  There pi/e pushes v off D; p and pi grow where the motion\n"
        "contracts or a coordinate is cyclic, and the error of H, linear in them, grows with\n"
        "them: read it beside |p| and |pi|.  A step that lands in D = 0, by projection or\n"
        "by itself, has no lift of 4n+2 variables (restricted to D = 0 it lifts to T*{D = 0}, of\n"
        "dimension 2(2n - m)); a projection puts p = pi = 0, and H with them.\n";
    static const char words[] =
        "\n"
        "Sizes.  exact: never changed.  rounding: what the roundings of its steps make.  larger:\n"
        "larger than that.  Trends.  none: about one value.  settles: changes once.  random walk,\n"
        "linear, power law, exponential, growing oscillation: grows so.  undecided: several\n"
        "of these, or none, explain the values.  aborted: not finite.  quantities.csv has\n"
        "the confidence of each.  -: there is no such quantity, or E where the motion need not\n"
        "conserve it: never, or off D = 0 where it does so on D = 0 only.  Rates are slopes of\n"
        "fitted lines.  All values are of every step.  I is the invariant that moved farthest; ns\n"
        "are of the clock, observing included.\n";
    bool has_lift = false;
    for (int i = 0; i < plan->case_count; i++)
        has_lift |= (plan->cases[i].starts & ~(1 << STUDY_PHYSICAL)) != 0;
    if (has_lift) cli_wrap_notes(out, lift);
    cli_wrap_notes(out, words);
}

/* ---- a row per cell ------------------------------------------------------------------------ */

typedef struct csv_row {
    const study_plan *plan;
    const study_cell *cell;
    const study_case *of_case;
    study_quantities q, predicted;
    char method[STUDY_NAME];
} csv_row;

static void put_same(FILE *out, const csv_row *r)
{
    const study_cell *physical = study_cell_physical(r->plan, r->cell);
    if (physical && r->cell->state == STUDY_FINISHED)
        fputs(r->cell->bits == physical->bits ? "yes" : "no", out);
}

/* The directory of the run; a cell without rows, or whose run could not be created, has none. */
static void put_run(FILE *out, const csv_row *r)
{
    if (r->cell->observables == 0 || r->of_case->rows == STUDY_ROWS_NONE) return;
    char *run = cli_join("runs", r->cell->name);
    csv_put_text(out, run);
    free(run);
}

/* Studies that have the key tolerance have a column of it after the step's. */
static void put_step(FILE *out, const csv_row *r)
{
    csv_put(out, r->cell->step);
    if (!r->plan->has_tolerances) return;
    fputc(',', out);
    csv_put(out, r->cell->tolerance);
}

/* A cell is empty where there is no such quantity, or no run. */
#define NUMBER(quantity, member)                                                                   \
    (r->q.quantity && r->q.quantity->count > 0 ? csv_put(out, r->q.quantity->member) : (void)0)
#define RUN(how) (r->cell->observables > 0 ? (void)(how) : (void)0)
#define WORD(quantity, word)                                                                       \
    (r->q.quantity && r->q.quantity->count > 0 ? (void)fputs(word(r->q.quantity), out) : (void)0)

/* column, how it is written */
#define CELL_LIST(COLUMN)                                                                          \
    COLUMN(label, csv_put_text(out, r->of_case->label))                                            \
    COLUMN(system, csv_put_text(out, r->of_case->name))                                            \
    COLUMN(integrator, csv_put_text(out, r->method))                                               \
    COLUMN(start, fputs(study_start_words[r->cell->start], out))                                   \
    COLUMN(step, put_step(out, r))
#define RESULT_LIST(COLUMN)                                                                        \
    COLUMN(time, csv_put(out, study_case_end(r->of_case, r->cell->step)))                          \
    COLUMN(state, fputs(study_state_words[r->cell->state], out))                                   \
    COLUMN(status, fputs(dal_status_name(r->cell->error.status), out))                             \
    COLUMN(reached, RUN(csv_put(out, r->cell->time)))                                              \
    COLUMN(steps, RUN(fprintf(out, "%lld", r->cell->steps)))                                       \
    COLUMN(evaluations, RUN(fprintf(out, "%lld", r->cell->evaluations)))                           \
    COLUMN(D_max, NUMBER(D, max_abs))                                                              \
    COLUMN(D_rate, NUMBER(D, rate))                                                                \
    COLUMN(D_size, WORD(D, cli_size_word))                                                         \
    COLUMN(D_trend, WORD(D, cli_trend_word))                                                       \
    COLUMN(E_first, NUMBER(E, first))                                                              \
    COLUMN(E_deviation, NUMBER(E, deviation))                                                      \
    COLUMN(E_rate, NUMBER(E, rate))                                                                \
    COLUMN(E_size, WORD(E, cli_size_word))                                                         \
    COLUMN(E_trend, WORD(E, cli_trend_word))                                                       \
    COLUMN(H_first, NUMBER(H, first))                                                              \
    COLUMN(H_deviation, NUMBER(H, deviation))                                                      \
    COLUMN(H_rate, NUMBER(H, rate))                                                                \
    COLUMN(H_size, WORD(H, cli_size_word))                                                         \
    COLUMN(H_trend, WORD(H, cli_trend_word))                                                       \
    COLUMN(p_max, NUMBER(p, max_abs))                                                              \
    COLUMN(pi_max, NUMBER(pi, max_abs))                                                            \
    COLUMN(pi_e_max, NUMBER(pi_e, max_abs))                                                        \
    COLUMN(invariant, csv_put_text(out, r->q.invariant_name))                                      \
    COLUMN(invariant_deviation, NUMBER(invariant, deviation))                                      \
    COLUMN(invariant_rate, NUMBER(invariant, rate))                                                \
    COLUMN(invariant_size, WORD(invariant, cli_size_word))                                         \
    COLUMN(invariant_trend, WORD(invariant, cli_trend_word))                                       \
    COLUMN(error_max, NUMBER(error, max_abs))                                                      \
    COLUMN(same_as_physical, put_same(out, r))                                                     \
    COLUMN(bits, RUN(fprintf(out, "%016llx", (unsigned long long)r->cell->bits)))                  \
    COLUMN(run, put_run(out, r))                                                                   \
    COLUMN(message, csv_put_text(out, r->cell->error.message))                                     \
    COLUMN(seconds, RUN(csv_put(out, r->cell->seconds)))

/* Studies that predict have these columns, too. */
#define PREDICTED(quantity, value)                                                                 \
    (r->predicted.quantity && r->predicted.quantity->count > 0                                     \
         ? csv_put_known(out, r->predicted.quantity->value)                                        \
         : (void)0)
#define PREDICTION(how) (r->cell->predicted ? (void)(how) : (void)0)
#define PREDICTED_LIST(COLUMN)                                                                     \
    COLUMN(predicted_D_max, PREDICTED(D, max_abs))                                                 \
    COLUMN(predicted_D_rate, PREDICTED(D, rate))                                                   \
    COLUMN(predicted_E_deviation, PREDICTED(E, deviation))                                         \
    COLUMN(predicted_E_rate, PREDICTED(E, rate))                                                   \
    COLUMN(predicted_E_rate_low, PREDICTED(E, rate_low))                                           \
    COLUMN(predicted_E_rate_high, PREDICTED(E, rate_high))                                         \
    COLUMN(predicted_invariant_deviation, PREDICTED(invariant, deviation))                         \
    COLUMN(predicted_invariant_rate, PREDICTED(invariant, rate))                                   \
    COLUMN(predicted_invariant_rate_low, PREDICTED(invariant, rate_low))                           \
    COLUMN(predicted_invariant_rate_high, PREDICTED(invariant, rate_high))                         \
    COLUMN(predicted_until, PREDICTION(csv_put_known(out, r->cell->predicted->time)))              \
    COLUMN(predicted_message, PREDICTION(csv_put_text(out, r->cell->predicted->error.message)))

static void put_cell(FILE *out, const csv_row *r)
{
    const char *comma = "";
#define COLUMN_CELL(name, how)                                                                     \
    fputs(comma, out);                                                                             \
    how;                                                                                           \
    comma = ",";
    CELL_LIST(COLUMN_CELL)
    RESULT_LIST(COLUMN_CELL)
    if (r->plan->has_predictions) {
        PREDICTED_LIST(COLUMN_CELL)
    }
#undef COLUMN_CELL
    fputc('\n', out);
}

/* ---- rows per observable and per window ---------------------------------------------------- */

static void put_key(FILE *out, const csv_row *r)
{
    csv_put_text(out, r->of_case->label);
    fputc(',', out);
    csv_put_text(out, r->method);
    fprintf(out, ",%s,", study_start_words[r->cell->start]);
    put_step(out, r);
    fputc(',', out);
}

static void put_quantities(FILE *out, const csv_row *r)
{
    for (int i = 0; i < r->cell->observables; i++) {
        put_key(out, r);
        csv_put_text(out, r->cell->names[i]);
        cli_put_values(out, &r->cell->trend[i]);
        fputc('\n', out);
    }
}

static void put_series(FILE *out, const csv_row *r)
{
    const double end = study_case_end(r->of_case, r->cell->step) - r->of_case->from;
    for (int k = 0; k < r->cell->window_count; k++) {
        put_key(out, r);
        csv_put(out, fabs(end) * (k + 1) / STUDY_WINDOWS);
        for (int track = 0; track < STUDY_TRACKS; track++) {
            fputc(',', out);
            csv_put_known(out, r->cell->windows[k][track]);
        }
        fputc('\n', out);
    }
}

/* ---- the files ----------------------------------------------------------------------------- */

typedef void row_writer(FILE *out, const csv_row *r);

/* Writes DIRECTORY/NAME: heads, then rows of the cells that have results, of one case or of all.  A
 * case without any has no file. */
static int write_file(const study_plan *plan, const study_case *of_case, const char *directory,
                      const char *name, const char *heads, row_writer *put)
{
    const int first = of_case ? of_case->first_cell : 0;
    const int end = of_case ? first + of_case->cells : plan->cell_count;
    int next = first;
    while (next < end && plan->cells[next].state == STUDY_WAITING) next++;
    if (of_case && next == end) return CLI_DONE;
    char *path = cli_join(directory, name);
    file_output output;
    int status = file_output_open(&output, path);
    if (status == CLI_DONE) fprintf(output.stream, "%s\n", heads);
    for (; next < end && status == CLI_DONE; next++) {
        const study_cell *c = &plan->cells[next];
        if (c->state == STUDY_WAITING) continue;
        csv_row r = {plan, c, c->of_case, study_cell_quantities(c), study_predicted_quantities(c),
                     ""};
        dal_method_name(c->method, r.method, sizeof r.method);
        put(output.stream, &r);
    }
    if (status == CLI_DONE) status = file_output_close(&output, CLI_DONE);
    free(path);
    return status;
}

int study_write_csv(const study_plan *plan, const char *directory)
{
#define COLUMN_HEAD(name, how)   "," #name
#define TRACK_HEAD(code, column) "," column
    static const char cell_heads[] = CELL_LIST(COLUMN_HEAD);
    static const char result_heads[] = RESULT_LIST(COLUMN_HEAD);
    static const char key_heads[] = "label,integrator,start,step";
    const char *tolerance = plan->has_tolerances ? ",tolerance" : "";
    static const char predicted_heads[] = PREDICTED_LIST(COLUMN_HEAD);
    char *cells = cli_format("%s%s%s%s", cell_heads + 1, tolerance, result_heads,
                             plan->has_predictions ? predicted_heads : "");
    char *quantities = cli_format("%s%s,quantity,first,last,max,deviation,%s", key_heads, tolerance,
                                  cli_trend_heads);
    char *windows = cli_format("%s%s,until%s", key_heads, tolerance, STUDY_TRACK_LIST(TRACK_HEAD));
    char *series = cli_join(directory, "series");
    int status = file_make_directory(series);
    if (status == CLI_DONE)
        status = write_file(plan, NULL, directory, "cells.csv", cells, put_cell);
    if (status == CLI_DONE)
        status = write_file(plan, NULL, directory, "quantities.csv", quantities, put_quantities);
    for (int i = 0; i < plan->case_count && status == CLI_DONE; i++) {
        if (plan->cases[i].rows == STUDY_ROWS_NONE) continue;
        char *name = cli_format("%s.csv", plan->cases[i].label);
        status = write_file(plan, &plan->cases[i], series, name, windows, put_series);
        free(name);
    }
    free(cells);
    free(quantities);
    free(windows);
    free(series);
    return status;
}
