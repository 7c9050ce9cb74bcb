#!/bin/sh
# run.sh PROGRAM [PART]... - the program as its users see it: exit statuses, what it writes where, what it says
# of bad input, and that nothing it wrote is lost when it is stopped, killed or out of room.
#
# A case runs the program by `try STATUS ARGUMENT...` and examines out and err with `says`,
# `prints` and `holds`; `case_is` names it.  Expected numbers are closed forms or counts.  PARTs are
# files, PART_cases.sh; all of them when none is named.
case $1 in /*) program=$1 ;; *) program=$PWD/$1 ;; esac
shift
parts=$*
[ -d "$program" ] && program=$program/dalembert
[ -x "$program" ] || { echo "cli: no program '$program'"; exit 1; }
here=$(cd "$(dirname "$0")" && pwd)
top=$(mktemp -d) || exit 1
memory=
trap 'rm -rf "$top" ${memory:+"$memory"}' EXIT
cd "$top" || exit 1
LC_ALL=C
export LC_ALL
unset COLUMNS

passed=0
failed=0
label=

case_is() { label=$1; }
pass() { passed=$((passed + 1)); }
fail() {
    failed=$((failed + 1))
    echo "cli: FAILED: $label: $1"
    sed 's/^/    stderr: /' err | head -3
}
# holds WHAT COMMAND...: the command must succeed.
holds() {
    what=$1
    shift
    if "$@" >/dev/null 2>&1; then pass; else fail "$what"; fi
}
try() {
    expected=$1
    shift
    timeout "${limit:-60}" "$program" "$@" >out 2>err
    status=$?
    if [ $status -eq "$expected" ]; then pass; else fail "exit $status, not $expected: $*"; fi
}
says() { if grep -Eq -- "$1" err; then pass; else fail "stderr lacks /$1/"; fi; }
prints() { if grep -Eq -- "$1" out; then pass; else fail "stdout lacks /$1/"; fi; }
silent() { if [ -s err ]; then fail "stderr is not empty"; else pass; fi; }
empty() { if [ -s out ]; then fail "stdout is not empty"; else pass; fi; }

# there COMMAND...: it can be run here.
there() { command -v "${1%% *}" >/dev/null 2>&1; }
# whether commands can be given a terminal: there are machines without
terminal() { there script && there stty && script -qec true /dev/null >/dev/null 2>&1 </dev/null; }
# has_rows FILE ROWS: the header of a .npy file says that there are ROWS.
has_rows() { head -c 8192 "$1" | grep -aq "'shape': ($2,), }"; }
columns_of() { head -c 8192 "$1" | grep -ao "'<f8'" | wc -l; }

# json FILE EXPRESSION: what is true of a JSON document d, read by Python.
json() { python3 "$here/holds_json.py" "$@"; }

# appears FILE: waits for it, at most ten seconds.
appears() {
    for i in 1 2 3 4 5 6 7 8 9 10; do
        for j in 1 2 3 4 5 6 7 8 9 10; do
            [ -e "$1" ] && return 0
            sleep 0.1
        done
    done
    return 1
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

# Each part has a directory of its own, so that none meets what another left.
for part in "$here"/[a-z]*_cases.sh; do
    name=$(basename "$part" _cases.sh)
    case " ${parts:-$name} " in *" $name "*) ;; *) continue ;; esac
    work=$top/$name
    mkdir "$work" && cp "$top/line.yaml" "$top/plane.yaml" "$work" && cd "$work" || exit 1
    . "$part"
done

echo "cli: $passed passed, $failed failed"
[ $failed -eq 0 ]
