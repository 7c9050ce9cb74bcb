#!/bin/sh
# versions.sh PROGRAM DIR - what a compiled step costs whose observables are all evaluated, against
# version 0.4, which is built in DIR.
#
# Instructions, counted by valgrind: they do not depend on what else the machine does.  Two lengths of
# a run differ by 120000 steps, and by nothing that a run does once.
program=$1
dir=$2
last=7fb1caf # commit of version 0.4
command -v valgrind >/dev/null || { echo "bench: versions: skipped: no valgrind"; exit 0; }
if [ ! -x "$dir/dalembert" ]; then
    mkdir -p "$dir/source" || exit 1
    git archive $last | tar -x -C "$dir/source" &&
        ${MAKE:-make} -s -C "$dir/source" BUILD=build build/dalembert >"$dir/log" 2>&1 &&
        cp "$dir/source/build/dalembert" "$dir/dalembert" || { tail -3 "$dir/log"; exit 1; }
fi

instructions() { # PROGRAM METHOD STEPS
    valgrind --tool=cachegrind --cache-sim=no --cachegrind-out-file=/dev/null "$1" run \
        chaplygin-sleigh --integrator "$2" --step 0.01 --steps "$3" --native on --summary \
        2>&1 >"$dir/out" | sed -n 's/.*I *refs: *//p' | tr -d ,
}
per_step() { echo $((($(instructions "$1" "$2" 180000) - $(instructions "$1" "$2" 60000)) / 1200)); }

echo "an observed step, instructions:  version 0.4       now     ratio   goal"
for method in rk4 symplectic-euler; do
    "$program" run chaplygin-sleigh --integrator $method --step 0.01 --steps 10 --native on >"$dir/out"
    echo "$method $(per_step "$dir/dalembert" $method) $(per_step "$program" $method)"
done | awk '{ printf "%-32s %11.2f %9.2f %9.4f   %s\n", $1, $2 / 100, $3 / 100, $3 / $2,
              $3 <= 1.02 * $2 ? "<= 1.02 met" : "<= 1.02 missed" }'
