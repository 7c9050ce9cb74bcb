/* study_pool.c - the cells of a study, run.
 *
 * The costliest cells are taken first, so that none remains for the end; a cell depends on nothing
 * but itself, so results do not depend on the number of threads. */
#include "study_pool.h"

#include "study_cell.h"
#include "study_predict.h"
#include "ui/clock.h"
#include "ui/memory.h"
#include "ui/message.h"

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

/* By falling cost, so that none remains for the end; allocated. */
static int *sort_cells(const study_plan *plan)
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
    int done, count;
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

static bool is_due(void *user, int item)
{
    return !((pool_state *)user)->plan->cells[item].other_shard;
}

static int run_cell(void *user, int item, const work_stop *stop)
{
    const study_plan *plan = ((pool_state *)user)->plan;
    return study_cell_run(plan, &plan->cells[item], stop);
}

static int end_cell(void *user, int item, int status)
{
    pool_state *p = user;
    (void)item;
    p->done += status == CLI_DONE;
    p->shown = 0.0;
    show_progress(p);
    return status;
}

int study_pool_run(study_plan *plan, work_runner *runner, int threads)
{
    pool_state p = {.plan = plan, .start = cli_seconds()};
    int *order = sort_cells(plan);
    const work_list list = {.user = &p,
                            .count = plan->cell_count,
                            .order = order,
                            .is_due = is_due,
                            .run = run_cell,
                            .end = end_cell,
                            .show = show_progress};
    study_plan_add_steps(plan);
    plan->motions = study_motions_create(plan->case_count);
    for (int i = 0; i < plan->cell_count; i++) p.count += is_due(&p, i);
    const int status = runner(&list, threads);
    study_motions_free(plan->motions, plan->case_count);
    plan->motions = NULL;
    native_end();
    plan->seconds = cli_seconds() - p.start;
    cli_progress_end();
    free(order);
    return status;
}
