# Runs that are killed (SIGKILL) at random moments, again and again, and resumed: the bytes are
# the same as without.  KILLS, 52 when not given, is how many there are in all; SEED
# draws the moments.  Between two kills the file of rows must be one that can be read.

# Where there is a file system in memory it is used: a moment is then one of the program, not one of
# waiting for the disk.

memory=$(mktemp -d -p /dev/shm 2>/dev/null) && { cd "$memory" || exit 1; }
XDG_CACHE_HOME=$work/kill_cache
export XDG_CACHE_HOME
seed=${SEED:-$(date +%s)}
kills_left=${KILLS:-52}
killed=0
rounds=0

product() { awk "BEGIN { print $1 * $2 }"; }
milliseconds() { echo $(($(date +%s%N) / 1000000)); }

# whole_rows FILE: the file ends after the rows that its header counts, or later.
whole_rows() {
    [ -s "$1" ] || return 0 # killed before there was a header
    set -- "$1" "$(head -c 8192 "$1" | tr -cd ' -~\n' | sed -n "1s/.*'shape': (\([0-9]*\),).*/\1/p")"
    [ -n "$2" ] && [ "$(wc -c <"$1")" -ge $((header_bytes + $2 * row_bytes)) ]
}

# one_life MOMENT COMMAND...: runs it for MOMENT seconds at most; true when it was killed.
one_life() {
    life=$1
    shift
    "$program" "$@" >out 2>err &
    sleep "$life"
    kill -9 $! 2>/dev/null
    wait $! 2>/dev/null
    [ $? -eq 137 ]
}

# survive DIR RUN...: killed at up to four moments within $span seconds each, then left alone.  The
# span shrinks where a run ends before its moment: it was measured on a machine that was busier.
survive() {
    folder=$1
    shift
    rm -rf "$folder"
    rounds=$((rounds + 1))
    for moment in $(awk -v seed=$((seed + rounds)) \
        'BEGIN { srand(seed); for (i = 0; i < 4; i++) printf "%.4f\n", rand() }'); do
        if [ -e "$folder/manifest.json" ]; then set -- resume "$folder" --native $native; fi
        if [ -e "$folder" ] && [ "$1" = run ]; then set -- "$@" --force; fi
        if ! one_life "$(product "$span" "$moment")" "$@" --checkpoint 0; then
            span=$(product "$span" 0.8)
            continue
        fi
        killed=$((killed + 1))
        kills_left=$((kills_left - 1))
        expect "rows that cannot be read" whole_rows "$folder/trajectory.npy"
    done
    [ -e "$folder/manifest.json" ] && set -- resume "$folder" --native $native
    try 0 "$@"
}

motion="chaplygin-sleigh --integrator rk4 --step 0.001 --samples 20011 --set omega=1.5"
try 0 run $motion --time 200 --output unkilled --native off
row_bytes=$((8 * $(columns_of unkilled/trajectory.npy)))
header_bytes=$(($(wc -c <unkilled/trajectory.npy) - 20012 * row_bytes))

natives=off
if there cc; then natives="off on"; else skips 1 "no compiler: nothing is killed with --native on"; fi
share=$((kills_left / $(echo $natives | wc -w)))
for native in $natives; do
    case_is "killed at random moments, --native $native, seed $seed"
    [ $native = on ] && try 0 run $motion --time 0.1 --samples 1 --native on
    begun=$(milliseconds)
    try 0 run $motion --time 200 --output unkilled2 --force --native $native --checkpoint 0
    span=$(awk "BEGIN { print ($(milliseconds) - $begun) / 1000 }")
    until_left=$((kills_left - share))
    [ $native = "${natives##* }" ] && until_left=0
    while [ $kills_left -gt $until_left ]; do
        survive killed_often run $motion --time 200 --output killed_often --native $native
        expect "other rows" cmp unkilled/trajectory.npy killed_often/trajectory.npy
        expect "another summary" cmp unkilled/summary.csv killed_often/summary.csv
        [ $failed -gt 0 ] && break
    done
done

# With CALLS set, which takes half a minute: killed, or with a full disk, at each call of
# the system that changes a file.
[ -z "${CALLS:-}" ] || there strace || skips 1 "no strace"
if [ -n "${CALLS:-}" ] && there strace; then
    motion="$motion --samples 3000 --time 6 --native off"
    try 0 run $motion --output undisturbed
    for call in pwrite64 write rename fsync ftruncate unlink mkdir; do
        rm -rf counted
        strace -o calls -e trace=$call "$program" run $motion --checkpoint 0 --output counted
        for how in signal=KILL error=ENOSPC; do
            case_is "$how at every $call"
            for i in $(seq "$(grep -ac "^$call" calls)"); do
                rm -rf injected
                strace -o calls.log -e trace=$call -e inject=$call:$how:when="$i" "$program" \
                    run $motion --checkpoint 0 --output injected >out 2>err
                set -- run $motion --output injected --force
                [ -e injected/manifest.json ] && set -- resume injected
                try 0 "$@"
                expect "other rows, call $i" cmp undisturbed/trajectory.npy injected/trajectory.npy
                expect "another summary, call $i" cmp undisturbed/summary.csv injected/summary.csv
            done
        done
    done 2>killed.log
fi
cd "$work" || exit 1
echo "cli: $killed kills at random moments, seed $seed"
