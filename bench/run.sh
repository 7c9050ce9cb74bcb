#!/bin/sh
# bench/run.sh PROGRAM... - runs each bench program in fresh processes and prints the median ratio
# of its two times with the spread.  A program prints "NAME OURS THEIRS" and fails if the two sides
# do not reach the same end state.
set -eu
runs=${RUNS:-7}
for program in "$@"; do
    i=0
    while [ "$i" -lt "$runs" ]; do
        "$program"
        i=$((i + 1))
    done | awk '{ name = $1; ratio[NR] = $2 / $3; ours[NR] = $2; theirs[NR] = $3 }
        function median(x, n,   i, j, t) {
            for (i = 2; i <= n; i++)
                for (j = i; j > 1 && x[j] < x[j-1]; j--) { t = x[j]; x[j] = x[j-1]; x[j-1] = t }
            return n % 2 ? x[(n + 1) / 2] : (x[n / 2] + x[n / 2 + 1]) / 2
        }
        END {
            if (NR == 0) exit 1
            m = median(ratio, NR)
            printf "%-18s ratio %.2f (%.2f to %.2f), %.1f ns against %.1f ns a step, %d processes\n",
                name, m, ratio[1], ratio[NR], median(ours, NR), median(theirs, NR), NR
        }'
done
