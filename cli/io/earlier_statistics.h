/* earlier_statistics.h - the statistics of quantities as earlier versions saved them. */
#ifndef DAL_CLI_EARLIER_STATISTICS_H
#define DAL_CLI_EARLIER_STATISTICS_H

#include "dalembert_statistics.h"

#include <stdint.h>

/* Of versions 0.3 and 0.4. */
enum { STATISTICS_LAYOUT_3 = 3, STATISTICS_WORDS_3 = 41 + 4 * DAL_STATISTICS_BLOCKS };

/* What is missing there is estimated: root mean squares of blocks from their ranges. */
void statistics_from_layout_3(dal_statistics *statistics,
                              const uint64_t *words /* [STATISTICS_WORDS_3] */);

#endif
