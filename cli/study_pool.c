/* study_pool.c - the cells of a study on several threads.
 *
 * The costliest cells are taken first, so that none is left for the end; a cell depends on nothing
 * but itself, so results do not depend on the number of threads. */
#include "pool.h"
#include "study.h"

#include <stdlib.h>

typedef struct work {
    study_plan *plan;
    int *order; /* cells by falling cost */
    int done;
    dal_status status; /* DAL_MEMORY once it ran out */
    double began;
} work;

/* Stages times steps, and more where implicit equations are solved on the wider space. */
static double cost(const study_cell *c)
{
    const dal_integrator *inner = c->method->chain[0];
    double stages = inner->stages > 0 ? inner->stages : 1;
    double implicit = inner->claims & DAL_EXPLICIT ? 1.0 : 8.0;
    double wide = c->start == STUDY_PHYSICAL ? 1.0 : 3.0;
    return c->entry->time / c->step * stages * implicit * wide;
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

static int *rank_cells(const study_plan *plan)
{
    const size_t count = (size_t)plan->cell_count;
    ranked *list = calloc(count + 1, sizeof *list);
    int *order = calloc(count + 1, sizeof *order);
    for (size_t i = 0; list && order && i < count; i++)
        list[i] = (ranked){cost(&plan->cells[i]), (int)i};
    if (list) qsort(list, count, sizeof *list, by_cost);
    for (size_t i = 0; list && order && i < count; i++) order[i] = list[i].cell;
    if (!list) {
        free(order);
        order = NULL;
    }
    free(list);
    return order;
}

static void tell(void *user)
{
    work *w = user;
    w->done++;
    cli_progress("study: %d of %d cells, %.0f s", w->done, w->plan->cell_count,
                 cli_seconds() - w->began);
}

static void run_out(void *user)
{
    work *w = user;
    w->status = DAL_MEMORY;
}

static void run_cell(void *user, int i)
{
    work *w = user;
    if (cli_interrupted()) return;
    const dal_status status = study_cell_run(&w->plan->cells[w->order[i]], cli_interrupted);
    if (status == DAL_MEMORY) pool_alone(run_out, w);
    if (status == DAL_OK) pool_alone(tell, w);
}

int study_pool_run(study_plan *plan, int threads)
{
    work w = {.plan = plan, .order = rank_cells(plan), .began = cli_seconds()};
    if (!w.order) return cli_fail(CLI_IO, "out of memory");
    pool_run(plan->cell_count, threads, run_cell, &w);
    cli_progress_end();
    free(w.order);
    if (w.status == DAL_MEMORY) return cli_fail(CLI_IO, "out of memory");
    return cli_interrupted() ? CLI_SIGNAL : CLI_DONE;
}
