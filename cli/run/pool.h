/* pool.h - tasks on several threads. */
#ifndef DAL_CLI_POOL_H
#define DAL_CLI_POOL_H

#include "ui/options.h"

enum { POOL_MAX_THREADS = 256 };

/* The row of --threads, a long long, in a table of options. */
#define POOL_THREADS_OPTION(settings, about)                                                       \
    {                                                                                              \
        "threads", "N", NULL, about " (OMP_NUM_THREADS or one per processor)",                     \
            .parse = cli_parse_integer, .offset = offsetof(settings, threads), .min = 1,           \
            .max = POOL_MAX_THREADS                                                                \
    }

/* The number of threads by default. */
int pool_threads(void);
/* Calls work(user, i) for i = 0..count-1, each once; a thread that is free takes the next i. */
void pool_run(int count, int threads, void (*work)(void *user, int i), void *user);
/* Calls work(user) while no other thread is in pool_exclude. */
void pool_exclude(void (*work)(void *user), void *user);

#endif
