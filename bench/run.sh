#!/bin/sh
# run.sh CASES PROGRAMS OUTPUT - runs every contender of the case table in fresh processes, one
# after the other, RUNS times (7); verifies that both sides of a case reach the same end state;
# prints the median of each ratio with its spread as a table, and as JSON lines to OUTPUT, for page.c.
#
# Each process gets a copy of its program, made for it: where the pages of a file happen to lie can cost
# a few percent, and stays so as long as the file does.
#
# A goal that is not met is reported, not punished: the exit status is 1 only when a contender fails
# or two end states differ.  A contender whose program was not built is skipped by name.
set -u
cases=$1 programs=$2 output=$3
runs=${RUNS:-7}
here=$(dirname "$0")
log=$(mktemp) || exit 1
trap 'rm -rf "$log" "$programs"/copy.*' EXIT

contenders() {
    awk -F '|' '/^ *(#|$)/ { next } { for (i = 3; i <= 4; i++) {
        gsub(/^ +| +$/, "", $i); if ($i != "" && !seen[$i]++) print $i } }' "$cases"
}

machine=$(sh "$here/machine.sh" "$runs") || exit 1
round=1
while [ "$round" -le "$runs" ]; do
    contenders | while read -r name; do
        [ -x "$programs/${name%% *}" ] || { printf '%s\tskip\n' "$name"; continue; }
        copy=$programs/copy.${name%% *}
        rm -f "$copy" && cp "$programs/${name%% *}" "$copy" || exit 1
        # shellcheck disable=SC2086 # the words of a contender are arguments
        line=$("$programs"/copy.$name </dev/null) || line=fail
        rm -f "$copy"
        printf '%s\t%s\n' "$name" "$line"
    done >>"$log"
    round=$((round + 1))
done
printf 'load %s, %s processes each, %s\n' "$(cut -d ' ' -f 1-3 /proc/loadavg)" "$runs" \
    "$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)"
printf '%s\n' "$machine" >"$output" || exit 1
awk -F '\t' -v output="$output" -f "$here/report.awk" of=log "$log" of=cases FS='|' "$cases"
