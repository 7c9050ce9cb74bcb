/* pool.c - tasks on several threads.
 *
 * No result may depend on which thread takes a task, or when.  The pool does with the threads that
 * can be created. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* sched_getaffinity */
#endif
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
    const char *given = getenv("OMP_NUM_THREADS");
    long threads = given ? strtol(given, NULL, 10) : 0;
    if (threads < 1) threads = processors();
    return threads < 1 ? 1 : threads > POOL_MAX_THREADS ? POOL_MAX_THREADS : (int)threads;
}

typedef struct task_list {
    void (*work)(void *user, int i);
    void *user;
    int count;
    atomic_int next;
} task_list;

static void *run_tasks(void *list)
{
    task_list *l = list;
    for (int i; (i = atomic_fetch_add(&l->next, 1)) < l->count;) l->work(l->user, i);
    return NULL;
}

void pool_run(int count, int threads, void (*work)(void *user, int i), void *user)
{
    task_list list = {.work = work, .user = user, .count = count};
    pthread_t thread[POOL_MAX_THREADS];
    int others = 0;
    if (threads > count) threads = count;
    while (others < threads - 1 && others < POOL_MAX_THREADS &&
           pthread_create(&thread[others], NULL, run_tasks, &list) == 0)
        others++;
    run_tasks(&list);
    for (int i = 0; i < others; i++) pthread_join(thread[i], NULL);
}

void pool_exclude(void (*work)(void *user), void *user)
{
    static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
    pthread_mutex_lock(&mutex);
    work(user);
    pthread_mutex_unlock(&mutex);
}
