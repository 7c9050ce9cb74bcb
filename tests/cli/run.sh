#!/bin/sh
# run.sh PROGRAM [PART]... - the program as its users see it: exit statuses, what it writes where, what it says
# of bad input, and that nothing it wrote is lost when it is stopped, killed or out of room.
#
# A case runs the program by `try STATUS ARGUMENT...` and examines out and err with `says`, `prints`, `expect` and
# `refute`; `case_is` names it; a `table` has cases of one command each.  Expected numbers are closed forms or counts.
# PARTs are files, PART_cases.sh; all of them when none is named.  FIRST_FAILURE=1 ends them at the first check that
# fails.
case $1 in /*) program=$1 ;; *) program=$PWD/$1 ;; esac
shift
parts=$*
[ -d "$program" ] && program=$program/dalembert
[ -x "$program" ] || { echo "cli: no program '$program'"; exit 1; }
here=$(cd "$(dirname "$0")" && pwd)
top=$(mktemp -d) || exit 1
memory=
# An interrupt leaves no process and no file.  A compiler, whose program was killed, may still write some.
leave() {
    jobs -p >"$top/jobs" 2>/dev/null && kill -KILL $(cat "$top/jobs") 2>/dev/null
    kill "${watcher:-}" 2>/dev/null
    set -- "$top" ${memory:+"$memory"}
    rm -rf "$@" 2>/dev/null || { sleep 1 && rm -rf "$@"; }
}
trap leave EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP
cd "$top" || exit 1
mkdir home
# A library of charts, as far as the program knows: browser/ has the real one.
mkdir charts
echo 'function uPlot() {}' >charts/uPlot.iife.min.js
echo '.uplot {}' >charts/uPlot.min.css
echo 'A licence' >charts/LICENSE
DALEMBERT_UPLOT=$top/charts
export DALEMBERT_UPLOT
LC_ALL=C
export LC_ALL HOME
unset COLUMNS NO_COLOR OMP_NUM_THREADS

# No case expects a speed: after these seconds what hangs is ended, and what does not come is given up.
patience=${PATIENCE:-600}
# One process beside the part does that, as `timeout` takes as much processor time as a short run of the program:
# what of the program runs now, and did $patience seconds before, is ended.  It ends soon after this shell, even one
# that is killed.
end_what_hangs() {
    exec </dev/null >/dev/null 2>&1
    trap 'kill $!; exit' TERM
    before='' binary=$(readlink -f "$program")
    while kill -0 $$; do
        now=
        for process in $(grep -alsFxz "DALEMBERT_UPLOT=$DALEMBERT_UPLOT" /proc/[0-9]*/environ | cut -d/ -f3); do
            [ "$(readlink "/proc/$process/exe")" = "$binary" ] || continue
            case "$before " in *" $process "*) kill "$process" ;; esac
            now="$now $process"
        done
        before=$now
        timeout --foreground "$patience" tail -f -s 5 --pid=$$ /dev/null &
        wait $!
    done
}
# No child of this shell, which waits for its children.
watcher=$(end_what_hangs & echo $!)
passed=0
failed=0
skipped=0
label=

case_is() { label=$1; }
pass() { passed=$((passed + 1)); }
fail() {
    failed=$((failed + 1))
    echo "cli: FAILED: $label: $1"
    sed 's/^/    stderr: /' err | head -3
    [ -z "${FIRST_FAILURE:-}" ] || exit 1
}
# cannot COUNT REASON: COUNT checks are not made here, which no package changes; skips COUNT REASON: a tool is
# missing, and where CI is true that fails.
cannot() {
    skipped=$((skipped + $1))
    echo "cli: $name: $label: $1 checks are skipped: $2"
}
skips() {
    cannot "$@"
    [ "${CI:-}" != true ] || fail "skipped though CI is true: $2"
}
# A program under the address sanitizer has an allocator of its own.
sanitized() { ASAN_OPTIONS=help=1 "$program" --version 2>&1 | grep -q AddressSanitizer; }
# needs COUNT REASON COMMAND...: begins a block of COUNT checks, which counted ends; where the command fails they
# are skipped.
needs() {
    block_count=$1 block_reason=$2
    shift 2
    if "$@"; then
        blocks="$((passed + failed + skipped)):$block_count $blocks"
    else
        skips "$block_count" "$block_reason"
        false
    fi
}
# counted: the block had as many checks as it said, checks of blocks within it included.
counted() {
    block=${blocks%% *} blocks=${blocks#* }
    made=$((passed + failed + skipped - ${block%:*}))
    [ $made -eq "${block#*:}" ] || fail "the block has $made checks, not ${block#*:}"
}
# expect WHAT COMMAND...: the command must succeed; refute WHAT COMMAND...: it must fail.  WHAT is wrong otherwise.
expect() {
    what=$1
    shift
    if "$@" >/dev/null 2>&1; then pass; else fail "$what"; fi
}
refute() {
    what=$1
    shift
    if "$@" >/dev/null 2>&1; then fail "$what"; else pass; fi
}
try() {
    expected=$1
    shift
    "$program" "$@" >out 2>err
    ended $? "$@"
}
# ended STATUS ARGUMENT...: the program must have ended with the status $expected.
ended() {
    status=$1
    shift
    if [ "$status" -eq "$expected" ]; then pass; else fail "exit $status, not $expected: $*"; fi
}
says() { if grep -Eq -- "$1" err; then pass; else fail "stderr lacks /$1/"; fi; }
prints() { if grep -Eq -- "$1" out; then pass; else fail "stdout lacks /$1/"; fi; }
# wrote TEXT: a line of stderr begins with it.  It takes no process: loops use it.
wrote() {
    while IFS= read -r line; do
        case $line in "$1"*) return 0 ;; esac
    done <err
    return 1
}
# alone PATTERN: one line of stderr, which matches, is all that it wrote.
alone() {
    if [ ! -s out ] && [ "$(wc -l <err)" -eq 1 ] && grep -Eq -- "$1" err; then
        pass
    else
        fail "stdout is not empty, or stderr is not one line /$1/"
    fi
}
silent() { if [ -s err ]; then fail "stderr is not empty"; else pass; fi; }
empty() { if [ -s out ]; then fail "stdout is not empty"; else pass; fi; }

# table: reads lines "STATUS | ARGUMENT... | says PATTERN", or alone or prints in place of says: each is a call of
# try, with words as the shell reads them, and what it must write.  A line "case: NAME" begins a case.
table() {
    title=$label
    while IFS= read -r row; do
        case $row in 'case: '*) title=${row#case: } && continue ;; esac
        arguments=${row#* | }
        written=${arguments#* | }
        arguments=${arguments%% | *}
        label="$title: $arguments"
        eval "try ${row%% | *} $arguments" </dev/null
        ${written%% *} "${written#* }"
    done
    label=$title
}

# there COMMAND...: it can be run here.
there() { command -v "${1%% *}" >/dev/null 2>&1; }
# whether commands can be given a terminal: there are machines without
terminal() { there script && there stty && script -qec true /dev/null >/dev/null 2>&1 </dev/null; }
# has_rows FILE ROWS: the header of a .npy file says that there are ROWS.
has_rows() { head -c 8192 "$1" | grep -aq "'shape': ($2,), }"; }
columns_of() { head -c 8192 "$1" | grep -ao "'<f8'" | wc -l; }

# json FILE EXPRESSION: what is true of a JSON document d, read by Python.  Where python3 is a script that finds
# the real one, it does so once: that takes longer than Python.
json() {
    : "${python:=$(python3 -c 'import sys; print(sys.executable)')}"
    "$python" "$here/holds_json.py" "$@"
}

# awaits COMMAND...: repeats it until it succeeds.
awaits() {
    waits=0
    until "$@" >/dev/null 2>&1; do
        waits=$((waits + 1))
        [ $waits -lt $((10 * patience)) ] || return 1
        sleep 0.1
    done
}
has_bytes() { [ "$(wc -c <"$1")" -ge "$2" ]; }
has_lines() { [ "$(wc -l <"$1")" -ge "$2" ]; }
# gone PID: the process has ended, if only as a zombie.
gone() { ! kill -0 "$1" || grep -q '^State:.Z' "/proc/$1/status"; }
# reaches PID COMMAND...: waits until the command succeeds, while the process lives.
reaches() {
    pid=$1 reached=
    shift
    awaits reached_or_gone "$@"
    [ -n "$reached" ]
}
reached_or_gone() { if "$@"; then reached=yes; else gone $pid; fi; }
# catches PID: the program has begun to catch SIGALRM, number 14, the last that it catches.  Of SIGINT and SIGTERM
# nothing follows: the shell, which becomes the program, catches them itself until then.
catches() { grep -q '^SigCgt:.*[2367abef]...$' "/proc/$1/status"; }
# ready PID: can be given signals.
ready() { if grep -q '^SigCgt' /proc/self/status; then reaches "$1" catches "$1"; else sleep 5; fi; }
# ends_by SIGNAL STATUS PID: the signal ends the process, with that status.
ends_by() {
    kill -"$1" "$3"
    expect "it goes on after SIG$1" awaits gone "$3"
    kill -9 "$3" 2>/dev/null
    wait "$3" 2>/dev/null
    status=$?
    expect "exit $status after SIG$1, not $2" test $status -eq "$2"
}

# numbers TOTAL COUNT: about COUNT numbers of 1 to TOTAL: the first and last few and some between.
numbers() {
    awk -v total="$1" -v count="$2" 'BEGIN {
        step = total > count ? total / count : 1
        for (x = 1; x <= total; x += step) print int(x)
        for (k = total - 3; k <= total; k++) if (k > 0) print k
    }' | sort -n -u
}

# new_places FILE: the numbers of the calls in FILE, of fail_place.h, from places of which no call was tried.
new_places() {
    touch "$top/places"
    awk -v known="$top/places" 'FILENAME == known { is_known[$1] = 1; next }
        FNR > 1 && !is_known[$2] { print $1; print $2 >> known }' "$top/places" "$1"
}

# What a command has printed and written, in the directory $1 and the file $1.out, without times.
without_times() {
    rm -rf "$1"
    mkdir -p place
    mv place "$1"
    grep -vE '^A step takes| runs in |^(rk4|gauss4) ' out >"$1.out"
    find "$1" -name cells.csv -o -name order.csv >tables
    while read -r file; do
        awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "seconds") k = i } { $k = ""; print }' "$file" >cells
        mv cells "$file"
    done <tables
}
# The checkpoint and the results of short runs hold times, the lock nothing.
same_files() { diff -r -I '"seconds"' -x 'checkpoint*' -x all -x lock "$1" "$2" && cmp "$1.out" "$2.out"; }

# shared_object NAME: makes NAME.so, for LD_PRELOAD.
shared_object() { there "${CC:-cc}" && ${CC:-cc} -shared -fPIC -O1 "$here/$1.c" -o "$top/$1.so" 2>/dev/null; }
# signalled NUMBER CALL ARGUMENT...: the program raises signal NUMBER in its call CALL of rename, by which it
# writes checkpoints and manifests: at the same place on every machine.
signalled() {
    number=$1 call=$2
    shift 2
    timeout --foreground $patience env ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}verify_asan_link_order=0" \
        LD_PRELOAD="$top/raise_signal.so" RAISE="$number" RAISE_AT="$call" "$program" "$@"
} >out 2>err
# raises: the program can be given such signals; begins what cut_off needs.
raises() {
    [ -n "${signalling:-}" ] || {
        shared_object raise_signal &&
            (cd "$top" && signalled 9 1 run line.yaml --integrator rk4 --step 1 --time 1 --output signalled)
        signalling=$?
    }
    [ "$signalling" -eq 137 ]
}
# cut_off STATUS NUMBER CALL ARGUMENT...: like try, with that signal.
cut_off() {
    expected=$1
    shift
    signalled "$@"
    ended $? "$@"
}

# Whether there are dalembert-mpi, which `make mpi` makes, and Open MPI's mpirun.
mpi_program=$(dirname "$program")/dalembert-mpi
has_mpi() { [ -x "$mpi_program" ] && there mpirun; }
# by_mpi STATUS OPTION... PROGRAM ARGUMENT...: like try, by mpirun.
by_mpi() {
    expected=$1
    shift
    # Leaks are Open MPI's own; another object may be loaded first.
    ASAN_OPTIONS=detect_leaks=0:verify_asan_link_order=0 timeout --foreground $patience \
        mpirun --allow-run-as-root --oversubscribe --mca mpi_yield_when_idle 1 "$@" >out 2>err
    ended $? "$@"
}

# The cells of a column by its head.
column() { awk -F, -v head="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == head) k = i; next }
                                 { print $k }' "$2"; }

# bad TEXT PATTERN: a study file that is refused.
bad() {
    printf "$1" >bad.yaml
    try 2 study bad.yaml --output there --force
    says "$2"
    empty
}

# A particle on a line with friction: no constraint, E known, exact solution x = 1 - exp(-t).
cat >line.yaml <<'END'
title: friction on a line
coordinates: [x]
parameters: {k: 1}
lagrangian: x'^2/2
forces: {x: -k*x'}
start: {x': 1}
invariants: {c: x' + k*x}
exact: {x: (1 - exp(-k*t))/k}
END
# Two coordinates and a constant linear constraint.
cat >plane.yaml <<'END'
coordinates: [x, y]
lagrangian: (x'^2 + y'^2)/2
constraints: [x' - y']
start: {x': 1, y': 1}
END

# ball FILE EVENT...: a ball that falls, moves along x with u and bounces, and further events.
ball() {
    file=$1
    shift
    printf '%s\n' 'coordinates: [x, y]' 'parameters: {g: 9.81, c: 0.8, u: 0.5}' \
        "lagrangian: (x'^2 + y'^2)/2 - g*y" "start: {y: 1, x': u}" 'events:' >"$file"
    for event in 'when: y, direction: down, restitution: c' "$@"; do echo "  - {$event}"; done >>"$file"
}
# study_of_states FILE LABEL METHODS: a study whose cells end in each way there is, with further methods, as
# ', rk4', and a system of this label.
study_of_states() {
    cat >"$1" <<END
title: Three & more
integrators: [rk4, gauss4, gauss4+project, dop853$3]
step: [0.1, 0.05]
tolerance: [1e-6, 1e-8]
time: 2
systems:
  - {system: chaplygin-sleigh, label: $2}
  - line.yaml
  - {system: chaplygin-sleigh-vakonomic, label: refused, starts: surface}
  - {system: pursuit, label: "ends early", time: 10}
expect:
  line.yaml: {rk4: {state: done, E: {at most: 1e-30}}, gauss4: {state: done}}
  ends early: {rk4: {D: {at most: 1}}}
END
}

# Each part has a directory of its own, so that none meets what another left.
for part in "$here"/[a-z]*_cases.sh; do
    name=${part##*/} name=${name%_cases.sh}
    case " ${parts:-$name} " in *" $name "*) ;; *) continue ;; esac
    work=$top/$name
    mkdir "$work" && cp "$top/line.yaml" "$top/plane.yaml" "$work" && cd "$work" || exit 1
    HOME=$top/home blocks=
    unset XDG_CACHE_HOME
    . "$part"
done

echo "cli: $passed passed, $failed failed, $skipped skipped"
[ $failed -eq 0 ]
