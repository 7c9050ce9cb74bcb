/* study_csv.c - the files of a study: every cell, every observable, every track. */
#include "dalembert.h"
#include "io/output.h"
#include "io/trend.h"
#include "study.h"
#include "ui/memory.h"
#include "ui/message.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct study_output {
    char *cells_path, *quantities_path, *series_directory;
    FILE *cells, *quantities, *series;
    char *series_path;
    const study_case *series_case;
};

/* ---- a row per cell ---- */

/* What became of it, or count = 0 where the cell has none. */
typedef struct quantity {
    dal_trend trend;
    const char *name;
} quantity;

typedef struct row {
    const study_plan *plan;
    const study_cell *cell;
    const study_case *of_case;
    quantity D, E, H, p, pi, pi_e, invariant, error;
    char method[STUDY_NAME];
} row;

static quantity make_quantity(const dal_trend *trend, const char *name)
{
    return trend ? (quantity){*trend, name} : (quantity){.name = ""};
}

static quantity named(const study_cell *cell, const char *name)
{
    return make_quantity(study_trend(cell, name), name);
}

static row make_row(const study_plan *plan, const study_cell *cell)
{
    row r = {.plan = plan, .cell = cell, .of_case = cell->of_case};
    const char *invariant = "";
    const dal_trend *worst = study_worst_invariant(cell, &invariant);
    dal_method_name(cell->method, r.method, sizeof r.method);
    r.D = make_quantity(study_worst_constraint(cell), "D");
    r.invariant = make_quantity(worst, invariant);
    r.E = named(cell, "E");
    r.H = named(cell, "H");
    r.p = named(cell, "|p|");
    r.pi = named(cell, "|pi|");
    r.pi_e = named(cell, "|pi_e|");
    r.error = named(cell, "error");
    return r;
}

static void put_number(FILE *out, const quantity *q, double value)
{
    if (q->trend.count > 0) cli_put(out, value);
}

static void put_size(FILE *out, const quantity *q)
{
    if (q->trend.count > 0) fputs(cli_size_word(&q->trend), out);
}

static void put_trend(FILE *out, const quantity *q)
{
    if (q->trend.count > 0) fputs(cli_trend_word(&q->trend), out);
}

static void put_same(FILE *out, const row *r)
{
    const study_cell *physical = study_physical_cell(r->plan, r->cell);
    if (r->cell->start != STUDY_SURFACE || !physical || physical->state != STUDY_FINISHED) return;
    if (r->cell->state == STUDY_FINISHED)
        fputs(r->cell->bits == physical->bits ? "yes" : "no", out);
}

/* Its directory below that of the study; a cell whose run could not be made has none. */
static void put_run(FILE *out, const row *r)
{
    char *name = r->cell->observables > 0 ? study_cell_name(r->cell) : NULL;
    char *run = name ? cli_join("runs", name) : NULL;
    if (run) cli_put_text(out, run);
    free(run);
    free(name);
}

/* column, how it is written */
#define COLUMN_LIST(X)                                                                             \
    X(label, cli_put_text(out, r->of_case->label))                                                 \
    X(system, cli_put_text(out, r->of_case->name))                                                 \
    X(integrator, cli_put_text(out, r->method))                                                    \
    X(start, fputs(study_start_word(r->cell->start), out))                                         \
    X(step, cli_put(out, r->cell->step))                                                           \
    X(time, cli_put(out, r->of_case->time))                                                        \
    X(state, fputs(study_state_word(r->cell->state), out))                                         \
    X(status, fputs(dal_status_name(r->cell->error.status), out))                                  \
    X(reached, cli_put(out, r->cell->time))                                                        \
    X(steps, fprintf(out, "%lld", r->cell->steps))                                                 \
    X(evaluations, fprintf(out, "%lld", r->cell->evaluations))                                     \
    X(D_max, put_number(out, &r->D, r->D.trend.max_abs))                                           \
    X(D_rate, put_number(out, &r->D, r->D.trend.rate))                                             \
    X(D_size, put_size(out, &r->D))                                                                \
    X(D_trend, put_trend(out, &r->D))                                                              \
    X(E_first, put_number(out, &r->E, r->E.trend.first))                                           \
    X(E_deviation, put_number(out, &r->E, r->E.trend.deviation))                                   \
    X(E_rate, put_number(out, &r->E, r->E.trend.rate))                                             \
    X(E_size, put_size(out, &r->E))                                                                \
    X(E_trend, put_trend(out, &r->E))                                                              \
    X(H_first, put_number(out, &r->H, r->H.trend.first))                                           \
    X(H_deviation, put_number(out, &r->H, r->H.trend.deviation))                                   \
    X(H_rate, put_number(out, &r->H, r->H.trend.rate))                                             \
    X(H_size, put_size(out, &r->H))                                                                \
    X(H_trend, put_trend(out, &r->H))                                                              \
    X(p_max, put_number(out, &r->p, r->p.trend.max_abs))                                           \
    X(pi_max, put_number(out, &r->pi, r->pi.trend.max_abs))                                        \
    X(pi_e_max, put_number(out, &r->pi_e, r->pi_e.trend.max_abs))                                  \
    X(invariant, cli_put_text(out, r->invariant.name))                                             \
    X(invariant_deviation, put_number(out, &r->invariant, r->invariant.trend.deviation))           \
    X(invariant_rate, put_number(out, &r->invariant, r->invariant.trend.rate))                     \
    X(invariant_size, put_size(out, &r->invariant))                                                \
    X(invariant_trend, put_trend(out, &r->invariant))                                              \
    X(error_max, put_number(out, &r->error, r->error.trend.max_abs))                               \
    X(same_as_physical, put_same(out, r))                                                          \
    X(bits, fprintf(out, "%016llx", (unsigned long long)r->cell->bits))                            \
    X(run, put_run(out, r))                                                                        \
    X(message, cli_put_text(out, r->cell->error.message))                                          \
    X(seconds, cli_put(out, r->cell->seconds))

static void put_heads(FILE *out)
{
    const char *comma = "";
#define X(name, how)                                                                               \
    fprintf(out, "%s%s", comma, #name);                                                            \
    comma = ",";
    COLUMN_LIST(X)
#undef X
    fputc('\n', out);
}

static void put_cell(FILE *out, const row *r)
{
    int first = 1;
#define X(name, how)                                                                               \
    if (!first) fputc(',', out);                                                                   \
    how;                                                                                           \
    first = 0;
    COLUMN_LIST(X)
#undef X
    fputc('\n', out);
}

/* ---- a row per observable ---- */

static void put_key(FILE *out, const row *r)
{
    cli_put_text(out, r->of_case->label);
    fputc(',', out);
    cli_put_text(out, r->method);
    fprintf(out, ",%s,", study_start_word(r->cell->start));
    cli_put(out, r->cell->step);
}

static void put_quantities(FILE *out, const row *r)
{
    for (int i = 0; i < r->cell->observables; i++) {
        const dal_trend *d = &r->cell->trend[i];
        const double numbers[] = {d->first, d->last, d->max_abs, d->deviation};
        put_key(out, r);
        fputc(',', out);
        cli_put_text(out, r->cell->names[i]);
        for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++) {
            fputc(',', out);
            cli_put(out, numbers[k]);
        }
        cli_put_trend(out, d);
        fputc('\n', out);
    }
}

/* ---- tracks ---- */

static void put_series(FILE *out, const row *r)
{
    for (int k = 0; k < r->cell->window_count; k++) {
        put_key(out, r);
        fputc(',', out);
        cli_put(out, r->of_case->time * (k + 1) / STUDY_WINDOWS);
        for (int track = 0; track < STUDY_TRACKS; track++) {
            fputc(',', out);
            cli_put(out, r->cell->windows[k][track]);
        }
        fputc('\n', out);
    }
}

static int close_series(study_output *output)
{
    int status = output->series ? cli_close(output->series, output->series_path) : CLI_DONE;
    output->series = NULL;
    free(output->series_path);
    output->series_path = NULL;
    return status;
}

static int open_series(study_output *output, const study_case *of_case)
{
    char name[512];
    int status = close_series(output);
    if (status != CLI_DONE) return status;
    snprintf(name, sizeof name, "%s.csv", of_case->label);
    output->series_path = cli_join(output->series_directory, name);
    output->series = fopen(output->series_path, "w");
    if (!output->series) return cli_io("write", output->series_path);
    output->series_case = of_case;
    fputs("label,integrator,start,step,until", output->series);
    for (int track = 0; track < STUDY_TRACKS; track++)
        fprintf(output->series, ",%s", study_track_column(track));
    fputc('\n', output->series);
    return CLI_DONE;
}

/* ---- the whole ---- */

static int open_file(FILE **file, char **path, const char *directory, const char *name)
{
    *path = cli_join(directory, name);
    *file = fopen(*path, "w");
    return *file ? CLI_DONE : cli_io("write", *path);
}

static int open_all(study_output *o, const char *directory)
{
    int status = cli_directory(directory);
    o->series_directory = cli_join(directory, "series");
    if (status == CLI_DONE) status = cli_directory(o->series_directory);
    if (status == CLI_DONE) status = open_file(&o->cells, &o->cells_path, directory, "cells.csv");
    if (status == CLI_DONE)
        status = open_file(&o->quantities, &o->quantities_path, directory, "quantities.csv");
    return status;
}

int study_output_open(study_output **output, const char *directory)
{
    study_output *o = *output = cli_calloc(1, sizeof *o);
    int status = open_all(o, directory);
    if (status != CLI_DONE) return status;
    put_heads(o->cells);
    fprintf(o->quantities, "label,integrator,start,step,quantity,first,last,max,deviation,%s\n",
            cli_trend_heads);
    return CLI_DONE;
}

int study_output_cell(study_output *output, const study_plan *plan, const study_cell *cell)
{
    row r = make_row(plan, cell);
    put_cell(output->cells, &r);
    put_quantities(output->quantities, &r);
    if (output->series_case != cell->of_case) {
        int status = open_series(output, cell->of_case);
        if (status != CLI_DONE) return status;
    }
    put_series(output->series, &r);
    if (fflush(output->cells) != 0) return cli_io("write", output->cells_path);
    return CLI_DONE;
}

int study_output_close(study_output *o)
{
    if (!o) return CLI_DONE;
    int status = close_series(o);
    int cells = o->cells ? cli_close(o->cells, o->cells_path) : CLI_DONE;
    int quantities = o->quantities ? cli_close(o->quantities, o->quantities_path) : CLI_DONE;
    free(o->cells_path);
    free(o->quantities_path);
    free(o->series_directory);
    free(o);
    return status != CLI_DONE ? status : cells != CLI_DONE ? cells : quantities;
}
