/* study_pool.c - the cells of a study on several threads.
 *
 * Each thread takes the costliest cell not yet taken, so that none is left for the end; a cell
 * depends on nothing but itself, so results do not depend on the number of threads.  The main
 * thread shows progress and writes cells in their order as soon as all before them are there. */
#include "study.h"

#include <stdlib.h>
#include <time.h>

enum { THREADS_MOST = 256, WAIT_NANOSECONDS = 100000000 };

typedef struct pool {
    study_plan *plan;
    int *order; /* cells by falling cost */
    int next, done, failed_memory;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    char *complete; /* [cells] */
} pool;

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

static int rank_cells(pool *p)
{
    size_t count = (size_t)p->plan->cell_count;
    ranked *list = calloc(count + 1, sizeof *list);
    p->order = calloc(count + 1, sizeof *p->order);
    p->complete = calloc(count + 1, 1);
    if (list && p->order && p->complete) {
        for (size_t i = 0; i < count; i++) list[i] = (ranked){cost(&p->plan->cells[i]), (int)i};
        qsort(list, count, sizeof *list, by_cost);
        for (size_t i = 0; i < count; i++) p->order[i] = list[i].cell;
    }
    int done = list && p->order && p->complete;
    free(list);
    return done ? CLI_DONE : cli_fail(CLI_IO, "out of memory");
}

static int take(pool *p)
{
    pthread_mutex_lock(&p->lock);
    int more = p->next < p->plan->cell_count && !p->failed_memory && !cli_interrupted();
    int cell = more ? p->order[p->next++] : -1;
    pthread_mutex_unlock(&p->lock);
    return cell;
}

static void give(pool *p, int cell, dal_status status)
{
    pthread_mutex_lock(&p->lock);
    p->complete[cell] = status == DAL_OK;
    p->done++;
    if (status == DAL_MEMORY) p->failed_memory = 1;
    pthread_cond_signal(&p->changed);
    pthread_mutex_unlock(&p->lock);
}

static void *work(void *user)
{
    pool *p = user;
    for (int cell; (cell = take(p)) >= 0;)
        give(p, cell, study_cell_run(&p->plan->cells[cell], cli_interrupted));
    return NULL;
}

/* Waits for a change; all is over when every cell that was taken is done and none will be. */
static int wait_for_change(pool *p, int *done)
{
    struct timespec until;
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += WAIT_NANOSECONDS;
    if (until.tv_nsec >= 1000000000) {
        until.tv_sec++;
        until.tv_nsec -= 1000000000;
    }
    pthread_mutex_lock(&p->lock);
    int finished = p->done == p->next &&
                   (p->next == p->plan->cell_count || p->failed_memory || cli_interrupted());
    if (!finished) pthread_cond_timedwait(&p->changed, &p->lock, &until);
    *done = p->done;
    pthread_mutex_unlock(&p->lock);
    return !finished;
}

/* Writes what is complete from *written on: in order, or over gaps when it is the last time. */
static int write_cells(pool *p, int *written, int over_gaps, study_output *output)
{
    int status = CLI_DONE;
    for (; *written < p->plan->cell_count && status == CLI_DONE; ++*written) {
        pthread_mutex_lock(&p->lock);
        int complete = p->complete[*written];
        pthread_mutex_unlock(&p->lock);
        if (!complete && !over_gaps) break;
        if (complete) status = study_output_cell(output, p->plan, &p->plan->cells[*written]);
    }
    return status;
}

static int watch(pool *p, study_output *output)
{
    int written = 0, status = CLI_DONE, done = 0;
    double began = cli_seconds();
    while (wait_for_change(p, &done)) {
        cli_progress("study: %d of %d cells, %.0f s", done, p->plan->cell_count,
                     cli_seconds() - began);
        if (status == CLI_DONE) status = write_cells(p, &written, 0, output);
    }
    cli_progress_end();
    return status == CLI_DONE ? write_cells(p, &written, 1, output) : status;
}

static int run_threads(pool *p, int threads, study_output *output)
{
    pthread_t thread[THREADS_MOST];
    int started = 0;
    if (threads > THREADS_MOST) threads = THREADS_MOST;
    while (started < threads && pthread_create(&thread[started], NULL, work, p) == 0) started++;
    if (started == 0) return cli_fail(CLI_IO, "no thread could be started");
    int status = watch(p, output);
    for (int i = 0; i < started; i++) pthread_join(thread[i], NULL);
    if (p->failed_memory) return cli_fail(CLI_IO, "out of memory");
    return status != CLI_DONE ? status : cli_interrupted() ? CLI_SIGNAL : CLI_DONE;
}

int study_pool_run(study_plan *plan, int threads, study_output *output)
{
    pool p = {.plan = plan};
    pthread_mutex_init(&p.lock, NULL);
    pthread_cond_init(&p.changed, NULL);
    int status = rank_cells(&p);
    if (status == CLI_DONE) status = run_threads(&p, threads, output);
    pthread_cond_destroy(&p.changed);
    pthread_mutex_destroy(&p.lock);
    free(p.order);
    free(p.complete);
    return status;
}
