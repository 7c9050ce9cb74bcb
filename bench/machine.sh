#!/bin/sh
# machine.sh PROCESSES - what the bench is measured on, as a line of JSON.
set -u
processor=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo 2>/dev/null | head -n 1)
load=$(cut -d ' ' -f 1-3 /proc/loadavg 2>/dev/null)
compiler=$(${CC:-cc} --version | head -n 1)
printf '{"processor":"%s","processors":%s,"load":"%s","system":"%s","compiler":"%s","measured":"%s","processes":%s}\n' \
    "${processor:-$(uname -m)}" "$(getconf _NPROCESSORS_ONLN)" "${load:-unknown}" "$(uname -sr)" \
    "$(echo "$compiler" | tr -d '\\"')" "$(date -u '+%Y-%m-%d %H:%M UTC')" "$1"
