/* groups.h - for sources that work through a block of many lanes one group, a num, after the other.
 *
 * To be included before num.h, which then has a num of DAL_GROUP lanes, a register: each number of
 * a block is DAL_GROUPS of them, one behind the other.  The lanes are interleaved as ever. */
#ifndef DAL_KERNEL_GROUPS_H
#define DAL_KERNEL_GROUPS_H

#ifdef DAL_GROUP
enum { DAL_GROUPS = DAL_LANES / DAL_GROUP };
#undef DAL_LANES
#define DAL_LANES DAL_GROUP
#else
enum { DAL_GROUPS = 1 };
#endif

#endif
