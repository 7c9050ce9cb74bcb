/* allocation.h - makes allocation fail on demand, to see that out of memory is a status.
 *
 *     allocation_trial trial = {0};
 *     while (allocation_next(&trial)) {
 *         allocation_start(&trial);           trial.failures allocations succeed, no later one;
 *                                             next time all but the next one do
 *         status = ...;
 *         allocation_end(&trial, status);     back to normal
 *         ... frees what there is ...
 *     }
 *
 * Only calls from the library's and the tests' own objects count. */
#ifndef ALLOCATION_H
#define ALLOCATION_H

#include <dalembert.h>
#include <stdbool.h>

void allocation_fail_after(long count);
int allocation_failed(void); /* has one been refused since? */

typedef struct allocation_trial {
    long failures, blocks; /* so far; before the first */
    bool is_single;        /* later allocations succeed again */
    bool passed;
} allocation_trial;

/* Whether another allocation is to fail: until none did; in a quick run every second one.  Each
 * fails with all after it, then alone.  Checks that all blocks are free again. */
bool allocation_next(allocation_trial *trial);
void allocation_start(const allocation_trial *trial);
/* Whether an allocation failed: checks that then, and only then, the status is DAL_STATUS_MEMORY,
 * and DAL_STATUS_OK otherwise. */
bool allocation_end(allocation_trial *trial, dal_status status);

#endif
