/* lanes.h - the lanes of an engine, as bits and as masks; for engine_wide.c. */
#ifndef DAL_LANES_H
#define DAL_LANES_H

#include "kernel/groups.h"

#include "run/engine.h"
#include <dalembert_kernel.h>

/* The lanes that are stepped together. */
enum { LANES = DAL_GROUPS * DAL_LANES };
/* Doubles that one of their numbers takes: one for each, or more for a longer number. */
enum { WIDTH = DAL_GROUPS * (int)(sizeof(num) / sizeof(double)) };

/* Lanes of all groups. */
typedef struct lane_mask {
    dal_mask group[DAL_GROUPS];
} lane_mask;

static inline lane_mask mask_of(dal__lanes lanes)
{
    int64_t all[LANES];
    lane_mask mask;
    for (int i = 0; i < LANES; i++) all[i] = -(int64_t)(lanes >> i & 1);
    memcpy(&mask, all, sizeof mask);
    return mask;
}

static inline dal__lanes lanes_of(const lane_mask *mask)
{
    dal__lanes lanes = 0;
    for (int g = 0; g < DAL_GROUPS; g++) {
        if (!dal_any(mask->group[g])) continue;
        for (int i = 0; i < DAL_LANES; i++)
            lanes |= (dal__lanes)dal_mask_lane(mask->group[g], i) << (g * DAL_LANES + i);
    }
    return lanes;
}

static inline lane_mask all_lanes(void)
{
    lane_mask all;
    for (int g = 0; g < DAL_GROUPS; g++) all.group[g] = dal_all();
    return all;
}

#endif
