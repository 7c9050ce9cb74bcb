/* quick.h - under valgrind and the sanitizers long runs are cut short, and of like cases some run:
 * `suite --quick`. */
#ifndef QUICK_H
#define QUICK_H

/* count, or a hundredth of it in a quick run. */
long long long_run(long long count);
/* Of a system whose cost grows with the square of its size: that, or an eighth in a quick run. */
int large_size(int size);
/* Of a list of like cases every one runs: 1, or in a quick run one in stride: stride. */
int case_stride(int stride);

#endif
