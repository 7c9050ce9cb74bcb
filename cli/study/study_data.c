/* study_data.c - what follows from the cases and cells of a study. */
#include "study_data.h"
#include "run/row_times.h"
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
    if (cell->predicted) free(cell->predicted->trend);
    free(cell->predicted);
    *cell = (study_cell){.of_case = cell->of_case,
                         .method = cell->method,
                         .step = cell->step,
                         .tolerance = cell->tolerance,
                         .start = cell->start,
                         .name = cell->name,
                         .other_shard = cell->other_shard};
}

/* A number with as few digits as read back. */
static const char *print_shortest(char text[32], double x)
{
    for (int digits = 1; digits <= 17; digits++) {
        snprintf(text, 32, "%.*g", digits, x);
        if (strtod(text, NULL) == x) break;
    }
    return text;
}

/* LABEL_INTEGRATOR_START_STEP, and _tolerance=TOLERANCE; no two cells share one. */
char *study_cell_name(const study_cell *c)
{
    char method[STUDY_NAME], step[32], tolerance[32];
    const bool has_tolerance = c->tolerance > 0.0;
    return cli_format("%s_%s_%s_%s%s%s", c->of_case->label,
                      dal_method_name(c->method, method, sizeof method),
                      study_start_words[c->start], print_shortest(step, c->step),
                      has_tolerance ? "_tolerance=" : "",
                      has_tolerance ? print_shortest(tolerance, c->tolerance) : "");
}

const char *study_division(char text[STUDY_DIVISION], double step, double tolerance)
{
    const int length = snprintf(text, STUDY_DIVISION, "h = %g", step);
    if (tolerance > 0.0)
        snprintf(text + length, STUDY_DIVISION - (size_t)length, ", tolerance %g", tolerance);
    return text;
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

study_quantities study_cell_quantities(const study_cell *c)
{
    const dal_system *s = c->of_case->system;
    study_quantities q = {.D = study_cell_constraint(c),
                          .E = study_cell_trend(c, "E"),
                          .H = study_cell_trend(c, "H"),
                          .p = study_cell_trend(c, "|p|"),
                          .pi = study_cell_trend(c, "|pi|"),
                          .pi_e = study_cell_trend(c, "|pi_e|"),
                          .error = study_cell_trend(c, "error"),
                          .invariant_name = ""};
    for (int i = 0; i < s->invariants - s->observed; i++) {
        const dal_trend *trend = study_cell_trend(c, s->invariant[i]);
        if (!trend || (q.invariant && trend->deviation <= q.invariant->deviation)) continue;
        q.invariant = trend;
        q.invariant_name = s->invariant[i];
    }
    return q;
}

const study_cell *study_cell_physical(const study_plan *plan, const study_cell *cell)
{
    const study_case *e = cell->of_case;
    for (int i = e->first_cell; i < e->first_cell + e->cells; i++) {
        const study_cell *c = &plan->cells[i];
        if (c->method == cell->method && c->step == cell->step && c->tolerance == cell->tolerance &&
            c->start == STUDY_PHYSICAL && c->state == STUDY_FINISHED &&
            cell->start == STUDY_SURFACE)
            return c;
    }
    return NULL;
}

double study_cell_length(const study_cell *c)
{
    return (study_case_end(c->of_case, c->step) - c->of_case->from) / c->step;
}

double *study_cell_method_steps(const study_cell *c)
{
    const study_case *e = c->of_case;
    return &e->method_steps[c->method - e->methods][c->start != STUDY_PHYSICAL];
}

const char *study_case_system(const study_case *e)
{
    return e->copy ? e->copy : e->path ? e->path : e->name;
}

double study_case_end(const study_case *e, double step)
{
    return e->run_steps > 0 ? step_end(e->from, step, e->run_steps) : e->time;
}

int study_count_states(const study_plan *plan, int *count, const study_cell **failed)
{
    int cells = 0;
    memset(count, 0, STUDY_STATES * sizeof *count);
    *failed = NULL;
    for (const study_cell *c = plan->cells; c < plan->cells + plan->cell_count; c++) {
        if (c->other_shard) continue;
        cells++;
        count[c->state]++;
        if (!*failed && c->state == STUDY_FAILED) *failed = c;
    }
    return cells;
}
