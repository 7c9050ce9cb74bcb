/* study_cell.c - what is asked of a cell: its names, and its trends by name. */
#include "dalembert.h"
#include "io/output.h"
#include "study.h"
#include "ui/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- names ---- */

static int reads_back(const char *text, double x) { return strtod(text, NULL) == x; }

/* LABEL_INTEGRATOR_START_STEP, the step with as few digits as tell it; no two cells share one. */
char *study_cell_name(const study_cell *c)
{
    char method[STUDY_NAME], step[32];
    for (int digits = 1; digits <= 17; digits++) {
        snprintf(step, sizeof step, "%.*g", digits, c->step);
        if (reads_back(step, c->step)) break;
    }
    return cli_format("%s_%s_%s_%s", c->of_case->label,
                      dal_method_name(c->method, method, sizeof method), study_start_word(c->start),
                      step);
}

char *study_cell_directory(const study_plan *plan, const study_cell *c)
{
    char *name = study_cell_name(c);
    char *directory = cli_join(plan->runs, name);
    free(name);
    return directory;
}

/* ---- words ---- */

const char *study_track_column(int track)
{
    static const char *const column[] = {
#define X(code, name) name,
        STUDY_TRACK_LIST(X)
#undef X
    };
    return column[track];
}

const char *study_state_word(study_state state)
{
    static const char *const words[] = {
#define X(code, word) word,
        STUDY_STATE_LIST(X)
#undef X
    };
    return words[state];
}

/* ---- trends ---- */

const dal_trend *study_trend(const study_cell *cell, const char *name)
{
    for (int i = 0; i < cell->observables; i++)
        if (strcmp(cell->names[i], name) == 0) return &cell->trend[i];
    return NULL;
}

const dal_trend *study_worst_constraint(const study_cell *cell)
{
    const dal_trend *worst = NULL;
    int m = cell->of_case->system->m;
    for (int a = 0; a < m && a < cell->observables; a++)
        if (!worst || cell->trend[a].max_abs > worst->max_abs) worst = &cell->trend[a];
    return worst;
}

const dal_trend *study_worst_invariant(const study_cell *cell, const char **name)
{
    const dal_trend *worst = NULL;
    const dal_system *s = cell->of_case->system;
    for (int i = 0; i < s->invariants; i++) {
        const dal_trend *trend = study_trend(cell, s->invariant[i]);
        if (!trend || (worst && trend->deviation <= worst->deviation)) continue;
        worst = trend;
        if (name) *name = s->invariant[i];
    }
    return worst;
}

const study_cell *study_physical_cell(const study_plan *plan, const study_cell *cell)
{
    const study_case *e = cell->of_case;
    for (int i = e->first_cell; i < e->first_cell + e->cells; i++) {
        const study_cell *c = &plan->cells[i];
        if (c->method == cell->method && c->step == cell->step && c->start == STUDY_PHYSICAL)
            return c;
    }
    return NULL;
}
