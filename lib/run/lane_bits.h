/* lane_bits.h - sets of lanes, as bits and as masks of the kernel. */
#ifndef DAL_RUN_LANE_BITS_H
#define DAL_RUN_LANE_BITS_H

#include <dalembert_kernel.h>
#include <stdint.h>

static inline dal_mask dal__mask_of(uint64_t lanes)
{
    int64_t all[DAL_LANES];
    dal_mask mask;
    for (int i = 0; i < DAL_LANES; i++) all[i] = -(int64_t)(lanes >> i & 1);
    memcpy(&mask, all, sizeof mask);
    return mask;
}

static inline uint64_t dal__lanes_of(dal_mask mask)
{
    uint64_t lanes = 0;
    for (int i = 0; dal_any(mask) && i < DAL_LANES; i++)
        lanes |= (uint64_t)dal_mask_lane(mask, i) << i;
    return lanes;
}

#endif
