/* groups.h - many lanes as groups of lanes; to be included before num.h.
 *
 * A group has as many lanes as a register, and is a num.  Each number of DAL_LANES lanes is then
 * DAL_GROUPS nums, one after the other; the lanes stay interleaved. */
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
