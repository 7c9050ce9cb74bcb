/* study_matrix.c - which integrators and systems of a study its screens show. */
#include "study_matrix.h"

#include "ui/memory.h"
#include "ui/name_patterns.h"

#include <stdlib.h>
#include <string.h>

/* E is kept to this fraction of max |E|. */
static const double kept_fraction = 0.01;

/* ---- integrators and systems --------------------------------------------------------------- */

static study_method *find_method(const study_matrix *s, const dal_method *method)
{
    char name[STUDY_NAME];
    dal_method_name(method, name, sizeof name);
    for (int i = 0; i < s->method_count; i++)
        if (strcmp(s->methods[i].name, name) == 0) return &s->methods[i];
    return NULL;
}

static void list_methods(study_matrix *s)
{
    for (int i = 0; i < s->plan->case_count; i++) {
        const study_case *e = &s->plan->cases[i];
        for (int k = 0; e->is_first && k < e->method_count; k++) {
            if (find_method(s, &e->methods[k])) continue;
            const size_t count = (size_t)s->method_count + 1;
            s->methods = cli_realloc(s->methods, count * sizeof *s->methods);
            study_method *new = &s->methods[s->method_count++];
            *new = (study_method){0};
            dal_method_name(&e->methods[k], new->name, sizeof new->name);
        }
    }
}

static bool has_family(const study_matrix *s, const char *name)
{
    for (int i = 0; i < s->rows; i++)
        if (name_is_of_family(s->row[i]->name, name)) return true;
    return false;
}

/* Those that the study lists; else all or, where these are too many, the first of each family. */
static void choose_rows(study_matrix *s, study_scope scope)
{
    const study_plan *plan = s->plan;
    const bool are_listed = scope == STUDY_SOME && plan->representatives > 0;
    const bool are_many = scope == STUDY_SOME && s->method_count > STUDY_REPRESENTATIVES;
    s->row = cli_calloc((size_t)s->method_count + STUDY_REPRESENTATIVES, sizeof *s->row);
    for (; are_listed && s->rows < plan->representatives; s->rows++)
        s->row[s->rows] = find_method(s, &plan->representative[s->rows]);
    for (int i = 0; !are_listed && i < s->method_count; i++)
        if (!are_many || (s->rows < STUDY_REPRESENTATIVES && !has_family(s, s->methods[i].name)))
            s->row[s->rows++] = &s->methods[i];
}

/* Systems with constraints come first; where these are too many, one of each item. */
static void choose_columns(study_matrix *s, study_scope scope)
{
    const int limit = scope == STUDY_SOME ? STUDY_COLUMNS : s->plan->case_count;
    const bool are_many = s->plan->case_count > limit;
    s->column = cli_calloc((size_t)limit + 1, sizeof *s->column);
    for (int rank = 0; rank < 4; rank++)
        for (int i = 0; i < s->plan->case_count && s->columns < limit; i++) {
            const study_case *e = &s->plan->cases[i];
            if ((e->system->m == 0) * 2 + (are_many && !e->is_first) == rank)
                s->column[s->columns++] = e;
        }
}

/* Of the runs on p = pi = 0 from the first start of a system, whose numbers describe (q,v). */
static void count_runs(const study_matrix *s)
{
    for (int i = 0; i < s->plan->cell_count; i++) {
        const study_cell *c = &s->plan->cells[i];
        if (c->other_shard || c->start == STUDY_DISPLACED ||
            c->start != study_first_start(c->of_case))
            continue;
        study_method *method = s->of_cell[i];
        for (int k = 0; k < QUANTITIES; k++) {
            const fate of_run = study_find_fate(c, k);
            if (of_run == FATES) continue;
            const dal_trend *trend = study_get_trend(c, k);
            method->count[k][of_run]++;
            method->kept[k] +=
                of_run == AT_ROUNDING ||
                (of_run == BOUNDED && trend->deviation <= kept_fraction * trend->max_abs);
        }
    }
}

/* The cells of the matrix: of each system those from its first start with its first step. */
static void choose_cells(study_matrix *s)
{
    s->cell = cli_calloc((size_t)s->rows * (size_t)s->columns + 1, sizeof *s->cell);
    for (int k = 0; k < s->columns; k++) {
        const study_case *e = s->column[k];
        for (int i = e->first_cell; i < e->first_cell + e->cells; i++) {
            const study_cell *c = &s->plan->cells[i];
            int row = s->rows - 1;
            while (row >= 0 && s->row[row] != s->of_cell[i]) row--;
            if (row >= 0 && c->start == study_first_start(e) && c->step == e->step[0] &&
                (c->tolerance == 0.0 || c->tolerance == e->tolerance[0]))
                s->cell[row * s->columns + k] = c;
        }
    }
}

void study_matrix_make(study_matrix *s, const study_plan *plan, study_scope scope)
{
    *s = (study_matrix){.plan = plan};
    list_methods(s);
    s->of_cell = cli_calloc((size_t)plan->cell_count + 1, sizeof *s->of_cell);
    for (int i = 0; i < plan->cell_count; i++)
        s->of_cell[i] = find_method(s, plan->cells[i].method);
    choose_rows(s, scope);
    choose_columns(s, scope);
    choose_cells(s);
    count_runs(s);
}

void study_matrix_free(study_matrix *s)
{
    free(s->cell);
    free(s->column);
    free(s->row);
    free(s->of_cell);
    free(s->methods);
}

/* ---- integrators --------------------------------------------------------------------------- */

fate study_method_fate(const study_method *m, study_quantity quantity)
{
    const int *count = m->count[quantity], *of_D = m->count[CONSTRAINT];
    int runs = 0, on_D = of_D[AT_ROUNDING];
    for (int k = 0; k < REFUSED; k++) runs += count[k];
    if (runs == 0) return count[REFUSED] > 0 ? REFUSED : FATES;
    if (count[FAILED] > 0) return FAILED;
    if (count[ABORTED] > 0) return ABORTED;
    for (int k = 0; k < REFUSED; k++) on_D -= of_D[k];
    if (count[OFF_SURFACE] > 0 || (quantity == ENERGY && on_D < 0)) return OFF_SURFACE;
    if (count[UNDECIDED] > 0 && count[DRIFTING] == 0) return UNDECIDED;
    const int kept = quantity == CONSTRAINT ? count[AT_ROUNDING] : m->kept[quantity];
    return kept == runs ? AT_ROUNDING : DRIFTING;
}
