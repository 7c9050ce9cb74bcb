/* pool.h - tasks on several threads. */
#ifndef DAL_CLI_POOL_H
#define DAL_CLI_POOL_H

enum { POOL_MAX_THREADS = 256 };

/* The number of threads by default, and what --help calls it. */
#define POOL_DEFAULT_TEXT "OMP_NUM_THREADS or one per processor"
int pool_threads(void);
/* Calls work(user, i) for i = 0..count-1, each once; a thread that is free takes the next i. */
void pool_run(int count, int threads, void (*work)(void *user, int i), void *user);
/* Calls work(user) while no other thread is in pool_exclude. */
void pool_exclude(void (*work)(void *user), void *user);

#endif
