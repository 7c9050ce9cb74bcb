/* study_pool.c - the cells of a study on several threads.
 *
 * The costliest cells are taken first, so that none is left for the end; a cell depends on nothing
 * but itself, so results do not depend on the number of threads. */
#include "study_pool.h"

#include "run/pool.h"
#include "study_cell.h"
#include "ui/clock.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/signals.h"

#include <stdlib.h>

static const double interval = 0.2; /* seconds between two lines of progress */

/* ---- the order ---- */

typedef struct cell_cost {
    double cost;
    int cell;
} cell_cost;

/* Stages times steps, and more where implicit equations are solved on the larger space. */
static double estimate_cost(const study_cell *c)
{
    const dal_integrator *inner = c->method->layer[0];
    const double stages = inner->stages > 0 ? inner->stages : 1;
    const double implicit = inner->properties & DAL_EXPLICIT ? 1.0 : 8.0;
    const double lifted = c->start == STUDY_PHYSICAL ? 1.0 : 3.0;
    return study_cell_length(c) * stages * implicit * lifted;
}

static int compare_costs(const void *a, const void *b)
{
    const cell_cost *x = a, *y = b;
    if (x->cost != y->cost) return x->cost < y->cost ? 1 : -1;
    return x->cell < y->cell ? -1 : x->cell > y->cell;
}

int *study_sort_cells(const study_plan *plan)
{
    const size_t count = (size_t)plan->cell_count;
    cell_cost *list = cli_calloc(count + 1, sizeof *list);
    int *order = cli_calloc(count + 1, sizeof *order);
    for (size_t i = 0; i < count; i++)
        list[i] = (cell_cost){estimate_cost(&plan->cells[i]), (int)i};
    qsort(list, count, sizeof *list, compare_costs);
    for (size_t i = 0; i < count; i++) order[i] = list[i].cell;
    free(list);
    return order;
}

/* ---- running ---- */

typedef struct pool_state {
    study_plan *plan;
    int *order;
    int done, count;
    int status; /* CLI_DONE, or the status of the program's own first failure */
    double start, shown;
} pool_state;

static void show_progress(void *user)
{
    pool_state *p = user;
    const double now = cli_seconds();
    if (now - p->shown <= interval) return;
    p->shown = now;
    cli_progress("study: %d of %d cells, %.0f s", p->done, p->count, now - p->start);
}

typedef struct cell_end {
    pool_state *pool;
    int status;
} cell_end;

static void add_end(void *user)
{
    const cell_end *end = user;
    pool_state *p = end->pool;
    if (end->status == CLI_DONE) p->done++;
    if (p->status == CLI_DONE && end->status != CLI_SIGNAL) p->status = end->status;
    p->shown = 0.0;
    show_progress(p);
}

static bool must_stop(void *user)
{
    pool_exclude(show_progress, user);
    return cli_interrupted();
}

static void run_cell(void *user, int i)
{
    pool_state *p = user;
    study_cell *cell = &p->plan->cells[p->order[i]];
    if (cell->other_shard || cli_interrupted()) return;
    cell_end end = {p, study_cell_run(p->plan, cell, &(study_stop_check){must_stop, p})};
    pool_exclude(add_end, &end);
}

int study_pool_run(study_plan *plan, int threads)
{
    pool_state p = {.plan = plan, .order = study_sort_cells(plan), .start = cli_seconds()};
    study_plan_add_steps(plan);
    for (int i = 0; i < plan->cell_count; i++) p.count += !plan->cells[i].other_shard;
    pool_run(plan->cell_count, threads, run_cell, &p);
    native_end();
    plan->seconds = cli_seconds() - p.start;
    cli_progress_end();
    free(p.order);
    if (p.status != CLI_DONE) return p.status;
    return cli_interrupted() ? CLI_SIGNAL : CLI_DONE;
}
