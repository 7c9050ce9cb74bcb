/* mpi_work.c - a list of work on the processes of a job.
 *
 * Rank 0 hands out the items in their order while it runs some itself: it serves requests when its
 * own item checks whether to stop.  Processes exchange only numbers of items and exit statuses; all
 * else is in the directory, which can be resumed after an interruption, by any number of processes
 * or by `dalembert resume`, to the same bytes. */
#include "mpi_work.h"
#include "ui/message.h"
#include "ui/signals.h"

#include <mpi.h>
#include <string.h>

int mpi_set_output(mpi_request *request, const char *path)
{
    if (strlen(path) >= sizeof request->output)
        return cli_fail(CLI_USAGE, "--output: the path is too long");
    memcpy(request->output, path, strlen(path) + 1);
    return CLI_DONE;
}

int mpi_max_status(int status)
{
    int max;
    MPI_Allreduce(&status, &max, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    return max;
}

typedef struct work_queue {
    const work_list *list;
    int rank;
    int next;    /* of rank 0: the place of the next item in its order */
    int waiting; /* of rank 0: how many other ranks may still request an item */
} work_queue;

enum { TAG_REQUEST, TAG_ITEM };
enum { LEAVE, REQUEST_ITEM };

static int next_item(work_queue *q)
{
    const work_list *list = q->list;
    while (q->next < list->count && !cli_interrupted()) {
        const int place = q->next++, item = list->order ? list->order[place] : place;
        if (list->is_due(list->user, item)) return item;
    }
    return -1;
}

static void serve_request(work_queue *q)
{
    MPI_Status from;
    int wanted, item = -1;
    MPI_Recv(&wanted, 1, MPI_INT, MPI_ANY_SOURCE, TAG_REQUEST, MPI_COMM_WORLD, &from);
    if (wanted == REQUEST_ITEM) {
        item = next_item(q);
        MPI_Send(&item, 1, MPI_INT, from.MPI_SOURCE, TAG_ITEM, MPI_COMM_WORLD);
    }
    if (item < 0) q->waiting--;
}

/* On rank 0 serves the requests that have arrived. */
static bool must_stop(void *user)
{
    work_queue *q = user;
    for (int arrived = 1; q->rank == 0 && arrived && q->waiting > 0;) {
        MPI_Iprobe(MPI_ANY_SOURCE, TAG_REQUEST, MPI_COMM_WORLD, &arrived, MPI_STATUS_IGNORE);
        if (arrived) serve_request(q);
    }
    return cli_interrupted();
}

static void send_request(int wanted)
{
    MPI_Send(&wanted, 1, MPI_INT, 0, TAG_REQUEST, MPI_COMM_WORLD);
}

static int request_item(void)
{
    int item;
    send_request(REQUEST_ITEM);
    MPI_Recv(&item, 1, MPI_INT, 0, TAG_ITEM, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return item;
}

int mpi_run_list(const work_list *list, int threads)
{
    work_queue q = {.list = list};
    const work_stop stop = {must_stop, &q};
    int status = CLI_DONE, item;
    (void)threads;
    MPI_Comm_rank(MPI_COMM_WORLD, &q.rank);
    MPI_Comm_size(MPI_COMM_WORLD, &q.waiting);
    q.waiting--;
    while (status == CLI_DONE && (item = q.rank == 0 ? next_item(&q) : request_item()) >= 0) {
        status = list->end(list->user, item, list->run(list->user, item, &stop));
        must_stop(&q);
    }
    if (q.rank > 0 && status != CLI_DONE) send_request(LEAVE);
    while (q.rank == 0 && q.waiting > 0) serve_request(&q);
    return status == CLI_DONE && cli_interrupted() ? CLI_SIGNAL : status;
}
