/* pool.c - pieces of work on several threads.
 *
 * Nothing that is computed may depend on who takes a piece, or when.  A thread that cannot be made
 * is done without. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* sched_getaffinity */
#endif
#include "ui/cli.h"

#include "pool.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <unistd.h>

/* Processors that this process may use. */
static long processors(void)
{
#ifdef CPU_COUNT
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0) return CPU_COUNT(&set);
#endif
    return sysconf(_SC_NPROCESSORS_ONLN);
}

int pool_threads(void)
{
    const char *wanted = getenv("OMP_NUM_THREADS");
    long threads = wanted ? strtol(wanted, NULL, 10) : 0;
    if (threads < 1) threads = processors();
    return threads < 1 ? 1 : threads > POOL_MOST ? POOL_MOST : (int)threads;
}

typedef struct pieces {
    void (*work)(void *user, int i);
    void *user;
    int count;
    atomic_int next;
} pieces;

static void *take_pieces(void *of)
{
    pieces *p = of;
    for (int i; (i = atomic_fetch_add(&p->next, 1)) < p->count;) p->work(p->user, i);
    return NULL;
}

void pool_run(int count, int threads, void (*work)(void *user, int i), void *user)
{
    pieces p = {.work = work, .user = user, .count = count};
    pthread_t thread[POOL_MOST];
    int others = 0;
    if (threads > count) threads = count;
    while (others < threads - 1 && others < POOL_MOST &&
           pthread_create(&thread[others], NULL, take_pieces, &p) == 0)
        others++;
    take_pieces(&p);
    for (int i = 0; i < others; i++) pthread_join(thread[i], NULL);
}

void pool_alone(void (*work)(void *user), void *user)
{
    static pthread_mutex_t alone = PTHREAD_MUTEX_INITIALIZER;
    pthread_mutex_lock(&alone);
    work(user);
    pthread_mutex_unlock(&alone);
}
