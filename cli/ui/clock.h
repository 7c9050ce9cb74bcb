/* clock.h - seconds. */
#ifndef DAL_CLI_CLOCK_H
#define DAL_CLI_CLOCK_H

/* Seconds of a monotonic clock; seconds of processor time of this thread. */
double cli_seconds(void);
double cli_thread_seconds(void);

#endif
