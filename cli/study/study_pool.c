/* study_pool.c - the cells of a study on several threads.
 *
 * The costliest cells are taken first, so that none is left for the end; a cell depends on nothing
 * but itself, so results do not depend on the number of threads. */
#include "dalembert.h"
#include "run/pool.h"
#include "study.h"
#include "ui/clock.h"
#include "ui/memory.h"
#include "ui/message.h"
#include "ui/signals.h"

#include <stdlib.h>

static const double interval = 0.2; /* seconds between two looks at the progress */

typedef struct work {
    study_plan *plan;
    int *order;
    int done, count;
    int status; /* CLI_DONE, or that of the first failure of the program's own */
    double began, told;
} work;

/* Stages times steps, and more where implicit equations are solved on the wider space. */
static double cost(const study_cell *c)
{
    const dal_integrator *inner = c->method->layer[0];
    double stages = inner->stages > 0 ? inner->stages : 1;
    double implicit = inner->properties & DAL_EXPLICIT ? 1.0 : 8.0;
    double wide = c->start == STUDY_PHYSICAL ? 1.0 : 3.0;
    return c->of_case->time / c->step * stages * implicit * wide;
}

typedef struct ranked {
    double cost;
    int cell;
} ranked;

static int by_cost(const void *a, const void *b)
{
    const ranked *x = a, *y = b;
    if (x->cost != y->cost) return x->cost < y->cost ? 1 : -1;
    return x->cell < y->cell ? -1 : x->cell > y->cell;
}

int *study_sort_cells(const study_plan *plan)
{
    const size_t count = (size_t)plan->cell_count;
    ranked *list = cli_calloc(count + 1, sizeof *list);
    int *order = cli_calloc(count + 1, sizeof *order);
    for (size_t i = 0; i < count; i++) list[i] = (ranked){cost(&plan->cells[i]), (int)i};
    qsort(list, count, sizeof *list, by_cost);
    for (size_t i = 0; i < count; i++) order[i] = list[i].cell;
    free(list);
    return order;
}

static void tell(void *user)
{
    work *w = user;
    w->told = cli_seconds();
    cli_progress("study: %d of %d cells, %.0f s", w->done, w->count, w->told - w->began);
}

typedef struct ending {
    work *work;
    int status;
} ending;

static void note(void *user)
{
    const ending *e = user;
    work *w = e->work;
    if (e->status == CLI_DONE) w->done++;
    if (w->status == CLI_DONE && e->status != CLI_SIGNAL) w->status = e->status;
    tell(w);
}

static void look(void *user)
{
    work *w = user;
    if (cli_seconds() - w->told > interval) tell(w);
}

/* Asked by each run now and then. */
static int stop(void *user)
{
    pool_exclude(look, user);
    return cli_interrupted();
}

static void run_cell(void *user, int i)
{
    work *w = user;
    study_cell *cell = &w->plan->cells[w->order[i]];
    if (cell->elsewhere || cli_interrupted()) return;
    ending e = {w, study_cell_run(w->plan, cell, &(study_stop_check){stop, w})};
    pool_exclude(note, &e);
}

int study_pool_run(study_plan *plan, int threads)
{
    work w = {.plan = plan, .order = study_sort_cells(plan), .began = cli_seconds()};
    for (int i = 0; i < plan->cell_count; i++) w.count += !plan->cells[i].elsewhere;
    pool_run(plan->cell_count, threads, run_cell, &w);
    cli_progress_end();
    free(w.order);
    if (w.status != CLI_DONE) return w.status;
    return cli_interrupted() ? CLI_SIGNAL : CLI_DONE;
}
