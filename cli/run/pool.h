/* pool.h - pieces of work on several threads. */
#ifndef DAL_CLI_POOL_H
#define DAL_CLI_POOL_H

enum { POOL_MOST = 256 };

/* How many threads are wanted where nothing is said: OMP_NUM_THREADS, else one per processor. */
int pool_threads(void);
/* work(user, i) for i = 0..count-1, each once, taken in this order by whichever of the threads is
 * free. */
void pool_run(int count, int threads, void (*work)(void *user, int i), void *user);
/* work(user) while no other thread is in pool_alone. */
void pool_alone(void (*work)(void *user), void *user);

#endif
