#!/bin/sh
# record.sh CHECK COMMAND... - runs the command of a check in RESULTS/CHECK: temporary files, native code
# and what it prints are there; status is written last, the exit status and the seconds of processor time.
folder=$RESULTS/$1
shift
mkdir -m 711 "$folder" "$folder/tmp" || exit 1
TMPDIR=$folder/tmp XDG_CACHE_HOME=$folder/tmp/cache
export TMPDIR XDG_CACHE_HOME
"$@" >"$folder/output" 2>&1 </dev/null
status=$?
rm -rf "$folder/tmp"
times >"$folder/times"
seconds=$(tr 'm' ' ' <"$folder/times" | awk '{ gsub("s", ""); sum += 60 * ($1 + $3) + $2 + $4 } END { print int(sum + 0.5) }')
echo "$status $seconds" >"$folder/status.new"
mv "$folder/status.new" "$folder/status"
