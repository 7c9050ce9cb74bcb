/* study_csv.c - the results of a study as CSV: every cell, every observable, every track. */
#include "study_csv.h"

#include "io/output.h"
#include "io/trend.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <stdlib.h>

/* ---- a row per cell ------------------------------------------------------------------------ */

typedef struct csv_row {
    const study_plan *plan;
    const study_cell *cell;
    const study_case *of_case;
    study_quantities q;
    char method[STUDY_NAME];
} csv_row;

static void put_same(FILE *out, const csv_row *r)
{
    const study_cell *physical = study_cell_physical(r->plan, r->cell);
    if (physical && r->cell->state == STUDY_FINISHED)
        fputs(r->cell->bits == physical->bits ? "yes" : "no", out);
}

/* The directory of the run; a cell whose run could not be created has none. */
static void put_run(FILE *out, const csv_row *r)
{
    if (r->cell->observables == 0) return;
    char *name = study_cell_name(r->cell), *run = cli_join("runs", name);
    cli_put_text(out, run);
    free(run);
    free(name);
}

/* A cell is empty where there is no such quantity. */
#define NUMBER(quantity, member)                                                                   \
    (r->q.quantity && r->q.quantity->count > 0 ? cli_put(out, r->q.quantity->member) : (void)0)
#define WORD(quantity, word)                                                                       \
    (r->q.quantity && r->q.quantity->count > 0 ? (void)fputs(word(r->q.quantity), out) : (void)0)

/* column, how it is written */
#define COLUMN_LIST(COLUMN)                                                                        \
    COLUMN(label, cli_put_text(out, r->of_case->label))                                            \
    COLUMN(system, cli_put_text(out, r->of_case->name))                                            \
    COLUMN(integrator, cli_put_text(out, r->method))                                               \
    COLUMN(start, fputs(study_start_words[r->cell->start], out))                                   \
    COLUMN(step, cli_put(out, r->cell->step))                                                      \
    COLUMN(time, cli_put(out, r->of_case->time))                                                   \
    COLUMN(state, fputs(study_state_words[r->cell->state], out))                                   \
    COLUMN(status, fputs(dal_status_name(r->cell->error.status), out))                             \
    COLUMN(reached, cli_put(out, r->cell->time))                                                   \
    COLUMN(steps, fprintf(out, "%lld", r->cell->steps))                                            \
    COLUMN(evaluations, fprintf(out, "%lld", r->cell->evaluations))                                \
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
    COLUMN(invariant, cli_put_text(out, r->q.invariant_name))                                      \
    COLUMN(invariant_deviation, NUMBER(invariant, deviation))                                      \
    COLUMN(invariant_rate, NUMBER(invariant, rate))                                                \
    COLUMN(invariant_size, WORD(invariant, cli_size_word))                                         \
    COLUMN(invariant_trend, WORD(invariant, cli_trend_word))                                       \
    COLUMN(error_max, NUMBER(error, max_abs))                                                      \
    COLUMN(same_as_physical, put_same(out, r))                                                     \
    COLUMN(bits, fprintf(out, "%016llx", (unsigned long long)r->cell->bits))                       \
    COLUMN(run, put_run(out, r))                                                                   \
    COLUMN(message, cli_put_text(out, r->cell->error.message))                                     \
    COLUMN(seconds, cli_put(out, r->cell->seconds))

static void put_cell(FILE *out, const csv_row *r)
{
    const char *comma = "";
#define COLUMN_CELL(name, how)                                                                     \
    fputs(comma, out);                                                                             \
    how;                                                                                           \
    comma = ",";
    COLUMN_LIST(COLUMN_CELL)
#undef COLUMN_CELL
    fputc('\n', out);
}

/* ---- rows per observable and per window ---------------------------------------------------- */

static void put_key(FILE *out, const csv_row *r)
{
    cli_put_text(out, r->of_case->label);
    fputc(',', out);
    cli_put_text(out, r->method);
    fprintf(out, ",%s,", study_start_words[r->cell->start]);
    cli_put(out, r->cell->step);
    fputc(',', out);
}

static void put_quantities(FILE *out, const csv_row *r)
{
    for (int i = 0; i < r->cell->observables; i++) {
        put_key(out, r);
        cli_put_text(out, r->cell->names[i]);
        cli_put_values(out, &r->cell->trend[i]);
        fputc('\n', out);
    }
}

static void put_series(FILE *out, const csv_row *r)
{
    for (int k = 0; k < r->cell->window_count; k++) {
        put_key(out, r);
        cli_put(out, r->of_case->time * (k + 1) / STUDY_WINDOWS);
        for (int track = 0; track < STUDY_TRACKS; track++) {
            fputc(',', out);
            cli_put(out, r->cell->windows[k][track]);
        }
        fputc('\n', out);
    }
}

/* ---- the files ----------------------------------------------------------------------------- */

typedef void row_writer(FILE *out, const csv_row *r);

/* Writes DIRECTORY/NAME: heads, then rows of the cells that have results, of one case or of all.  A
 * case without results has no file. */
static int write_file(const study_plan *plan, const study_case *of_case, const char *directory,
                      const char *name, const char *heads, row_writer *put)
{
    const int first = of_case ? of_case->first_cell : 0;
    const int end = of_case ? first + of_case->cells : plan->cell_count;
    int next = first;
    while (next < end && plan->cells[next].state == STUDY_WAITING) next++;
    if (of_case && next == end) return CLI_DONE;
    char *path = cli_join(directory, name);
    FILE *out = fopen(path, "w");
    int status = out ? CLI_DONE : cli_io("write", path);
    if (out) fprintf(out, "%s\n", heads);
    for (; next < end && out; next++) {
        const study_cell *c = &plan->cells[next];
        if (c->state == STUDY_WAITING) continue;
        csv_row r = {plan, c, c->of_case, study_cell_quantities(c), ""};
        dal_method_name(c->method, r.method, sizeof r.method);
        put(out, &r);
    }
    if (out) status = cli_close(out, path);
    free(path);
    return status;
}

int study_write_csv(const study_plan *plan, const char *directory)
{
#define COLUMN_HEAD(name, how)   "," #name
#define TRACK_HEAD(code, column) "," column
    static const char cell_heads[] = COLUMN_LIST(COLUMN_HEAD);
    static const char series_heads[] =
        "label,integrator,start,step,until" STUDY_TRACK_LIST(TRACK_HEAD);
    char *heads = cli_format("label,integrator,start,step,quantity,first,last,max,deviation,%s",
                             cli_trend_heads);
    char *series = cli_join(directory, "series");
    int status = cli_directory(series);
    if (status == CLI_DONE)
        status = write_file(plan, NULL, directory, "cells.csv", cell_heads + 1, put_cell);
    if (status == CLI_DONE)
        status = write_file(plan, NULL, directory, "quantities.csv", heads, put_quantities);
    for (int i = 0; i < plan->case_count && status == CLI_DONE; i++) {
        char *name = cli_format("%s.csv", plan->cases[i].label);
        status = write_file(plan, &plan->cases[i], series, name, series_heads, put_series);
        free(name);
    }
    free(heads);
    free(series);
    return status;
}
