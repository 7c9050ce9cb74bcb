/* study_cell.c - one cell of a study: its name and its results by name. */
#include "study_cell.h"

#include "io/output.h"
#include "study_plan.h"
#include "ui/memory.h"

#include <stdlib.h>
#include <string.h>

#define START_WORD(code, word, space, about) word,
const char *const study_start_words[STUDY_STARTS] = {STUDY_START_LIST(START_WORD)};
#define STATE_WORD(code, word) word,
const char *const study_state_words[STUDY_STATES] = {STUDY_STATE_LIST(STATE_WORD)};

void study_cell_free(study_cell *cell)
{
    free(cell->trend);
    free(cell->names);
    free(cell->windows);
    *cell = (study_cell){.of_case = cell->of_case,
                         .method = cell->method,
                         .step = cell->step,
                         .start = cell->start,
                         .other_shard = cell->other_shard};
}

/* LABEL_INTEGRATOR_START_STEP, the step with as few digits as read back; no two cells share one. */
char *study_cell_name(const study_cell *c)
{
    char method[STUDY_NAME], step[32];
    for (int digits = 1; digits <= 17; digits++) {
        snprintf(step, sizeof step, "%.*g", digits, c->step);
        if (strtod(step, NULL) == c->step) break;
    }
    return cli_format("%s_%s_%s_%s", c->of_case->label,
                      dal_method_name(c->method, method, sizeof method),
                      study_start_words[c->start], step);
}

char *study_cell_directory(const study_plan *plan, const study_cell *c)
{
    char *name = study_cell_name(c);
    char *directory = cli_join(plan->runs, name);
    free(name);
    return directory;
}

const dal_trend *study_cell_trend(const study_cell *cell, const char *name)
{
    for (int i = 0; i < cell->observables; i++)
        if (strcmp(cell->names[i], name) == 0) return &cell->trend[i];
    return NULL;
}

const dal_trend *study_cell_constraint(const study_cell *cell)
{
    const dal_trend *largest = NULL;
    for (int a = 0; a < cell->of_case->system->m && a < cell->observables; a++)
        if (!largest || cell->trend[a].max_abs > largest->max_abs) largest = &cell->trend[a];
    return largest;
}

const dal_trend *study_cell_invariant(const study_cell *cell, const char **name)
{
    const dal_trend *largest = NULL;
    const dal_system *s = cell->of_case->system;
    for (int i = 0; i < s->invariants; i++) {
        const dal_trend *trend = study_cell_trend(cell, s->invariant[i]);
        if (!trend || (largest && trend->deviation <= largest->deviation)) continue;
        largest = trend;
        if (name) *name = s->invariant[i];
    }
    return largest;
}

study_quantities study_cell_quantities(const study_cell *c)
{
    study_quantities q = {.D = study_cell_constraint(c),
                          .E = study_cell_trend(c, "E"),
                          .H = study_cell_trend(c, "H"),
                          .p = study_cell_trend(c, "|p|"),
                          .pi = study_cell_trend(c, "|pi|"),
                          .pi_e = study_cell_trend(c, "|pi_e|"),
                          .error = study_cell_trend(c, "error"),
                          .invariant_name = ""};
    q.invariant = study_cell_invariant(c, &q.invariant_name);
    return q;
}

const study_cell *study_cell_physical(const study_plan *plan, const study_cell *cell)
{
    const study_case *e = cell->of_case;
    for (int i = e->first_cell; i < e->first_cell + e->cells; i++) {
        const study_cell *c = &plan->cells[i];
        if (c->method == cell->method && c->step == cell->step && c->start == STUDY_PHYSICAL &&
            c->state == STUDY_FINISHED && cell->start == STUDY_SURFACE)
            return c;
    }
    return NULL;
}
