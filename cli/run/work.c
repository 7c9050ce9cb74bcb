/* work.c - a list of work on threads of this process. */
#include "work.h"
#include "pool.h"
#include "ui/message.h"
#include "ui/signals.h"

#include <stdatomic.h>

typedef struct thread_work {
    const work_list *list;
    atomic_int status; /* CLI_DONE, or the first failure */
} thread_work;

typedef struct work_end {
    thread_work *work;
    int item, status;
} work_end;

static void end_item(void *user)
{
    const work_end *end = user;
    const work_list *list = end->work->list;
    const int status = list->end(list->user, end->item, end->status);
    if (status != CLI_SIGNAL && end->work->status == CLI_DONE) end->work->status = status;
}

static bool must_stop(void *user)
{
    const thread_work *work = user;
    pool_exclude(work->list->show, work->list->user);
    return cli_interrupted();
}

static void run_item(void *user, int place)
{
    thread_work *work = user;
    const work_list *list = work->list;
    const int item = list->order ? list->order[place] : place;
    const bool has_ended = list->ends_early && work->status != CLI_DONE;
    if (has_ended || cli_interrupted() || !list->is_due(list->user, item)) return;
    work_end end = {work, item, list->run(list->user, item, &(work_stop){must_stop, work})};
    pool_exclude(end_item, &end);
}

int work_on_threads(const work_list *list, int threads)
{
    thread_work work = {.list = list};
    pool_run(list->count, threads, run_item, &work);
    if (work.status != CLI_DONE) return work.status;
    return cli_interrupted() ? CLI_SIGNAL : CLI_DONE;
}
