/* quick.h - under valgrind, fifty times slower, long runs are cut short: `suite --quick`. */
#ifndef QUICK_H
#define QUICK_H

/* count, or a hundredth of it in a quick run. */
long long long_run(long long count);
/* Of a system whose cost grows with the square of its size: that, or an eighth in a quick run. */
int large_size(int size);

#endif
