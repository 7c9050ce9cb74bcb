/* fast_clock.c - a clock a million times as fast, for a program that is started with LD_PRELOAD. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* syscall */
#endif
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

int clock_gettime(clockid_t clock, struct timespec *now)
{
    const int result = (int)syscall(SYS_clock_gettime, clock, now);
    now->tv_sec = now->tv_sec * 1000000 + now->tv_nsec / 1000;
    now->tv_nsec = now->tv_nsec % 1000 * 1000000;
    return result;
}
