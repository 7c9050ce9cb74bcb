/* study_restore.c - the results of a study, from its tables. */
#include "study_restore.h"

#include "io/trend.h"
#include "ui/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Whether a row of either table is about a cell. */
static bool is_row_of(const csv_table *t, int row, const study_cell *c)
{
    char method[STUDY_NAME];
    const double tolerance = csv_table_number(t, row, "tolerance");
    return csv_table_is(t, row, "integrator", dal_method_name(c->method, method, sizeof method)) &&
           csv_table_is(t, row, "start", study_start_words[c->start]) &&
           csv_table_is(t, row, "label", c->of_case->label) &&
           csv_table_number(t, row, "step") == c->step &&
           (isnan(tolerance) ? c->tolerance == 0.0 : tolerance == c->tolerance);
}

/* The next row from one on that is about a cell; 0: there is none. */
static int find_row(const csv_table *t, int from, const study_cell *c)
{
    int row = from;
    while (row < t->rows && !is_row_of(t, row, c)) row++;
    return row < t->rows ? row : 0;
}

/* The trends of a cell, whose rows begin with one; its D_a come first.  Of E the table does not say
 * why it is not conserved. */
static void restore_trends(study_cell *c, const csv_table *t, int row)
{
    static const char energy[] = "E", error[] = "error";
    const dal_system *s = c->of_case->system;
    const int most = s->m + 2;
    c->trend = cli_calloc((size_t)most, sizeof *c->trend);
    c->names = cli_calloc((size_t)most, sizeof *c->names);
    for (; row > 0 && row < t->rows && is_row_of(t, row, c) && c->observables < most; row++) {
        const char *name = csv_table_get(t, row, "quantity");
        const bool is_energy = strcmp(name, energy) == 0;
        if (c->observables >= s->m && !is_energy && strcmp(name, error) != 0) continue;
        dal_trend *trend = &c->trend[c->observables];
        *trend = cli_get_trend(t, row);
        if (is_energy && trend->conservation != DAL_CONSERVED &&
            s->properties & (DAL_E_EXACT | DAL_E_ON_D))
            trend->conservation = DAL_OFF_SURFACE;
        snprintf(c->names[c->observables++], sizeof *c->names, "%s", name);
    }
}

void study_restore(study_plan *plan, const csv_table *cells, const csv_table *quantities)
{
    for (int i = 0, row = 1, of_quantity = 1; i < plan->cell_count; i++) {
        study_cell *c = &plan->cells[i];
        const int found = find_row(cells, row, c);
        if (found == 0) continue;
        row = found + 1;
        for (int k = 0; k < STUDY_STATES; k++)
            if (csv_table_is(cells, found, "state", study_state_words[k]))
                c->state = (study_state)k;
        c->steps = (long long)fmax(csv_table_number(cells, found, "steps"), 0.0);
        if (c->state != STUDY_FINISHED && c->state != STUDY_FAILED) continue;
        const int first = find_row(quantities, of_quantity, c);
        restore_trends(c, quantities, first);
        if (first > 0) of_quantity = first + 1;
    }
}
