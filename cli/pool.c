/* pool.c - pieces of work on several threads by OpenMP, one after the other where there is none.
 *
 * The one file that is compiled with -fopenmp.  Nothing that is computed may depend on who takes a
 * piece, or when. */
#include "pool.h"

#ifdef _OPENMP
#include <omp.h>
#define OMP(directive) _Pragma(#directive)
#else
#define OMP(directive)
#endif

int pool_threads(void)
{
#ifdef _OPENMP
    const int threads = omp_get_max_threads();
#else
    const int threads = 1;
#endif
    return threads < POOL_MOST ? threads : POOL_MOST;
}

void pool_run(int count, int threads, void (*work)(void *user, int i), void *user)
{
    (void)threads;
    OMP(omp parallel for num_threads(threads) schedule(monotonic : dynamic, 1))
    for (int i = 0; i < count; i++) work(user, i);
}

void pool_alone(void (*work)(void *user), void *user)
{
    OMP(omp critical)
    work(user);
}
