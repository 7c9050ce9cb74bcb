/* allocation.h - makes allocation fail on demand, to see that out of memory is a status.
 *
 *     for (long n = 0;; n++) {
 *         long blocks = allocation_blocks();
 *         allocation_fail_after(n);           n allocations succeed, all later ones fail
 *         status = ...;
 *         if (!allocation_failed()) break;    it went through: every place has failed once
 *         ... status must be DAL_MEMORY, and allocation_blocks() == blocks ...
 *     }
 *     allocation_fail_after(-1);              back to normal
 *
 * Only calls from the library's and the tests' own objects count. */
#ifndef ALLOCATION_H
#define ALLOCATION_H

void allocation_fail_after(long count);
int allocation_failed(void); /* has one been refused since? */
long allocation_count(void); /* calls since the last allocation_fail_after */
/* Blocks that are allocated and not yet freed, of all threads. */
long allocation_blocks(void);

#endif
