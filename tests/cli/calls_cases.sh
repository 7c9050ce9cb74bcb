# Calls of the system that fail: wherever one does, a command ends with one message and another status, or has written
# what it writes otherwise and does not say that it cannot.  fail_call.c lets the k-th call fail; a command tries
# the first from each place (fail_place.h) that no command before has tried, and FAILING_CALLS others.

FAILING_CALLS=${FAILING_CALLS:-25}
shim=$top/fail_call.so
# without_call K ARGUMENT...: call K fails; 0: none.
without_call() {
    k=$1
    shift
    ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}verify_asan_link_order=0" \
        LD_PRELOAD="$shim" FAIL_AT=$k FAIL_LOG="$work/calls" "$program" "$@" >out 2>err
}
# fails_openly ARGUMENT...: begins with what `prepare` makes, in the directory `place`.
fails_openly() {
    rm -rf place
    prepare
    without_call 0 "$@"
    well=$? fault=
    total=$(head -n 1 calls)
    without_times well
    for k in $({ numbers "$total" "$FAILING_CALLS" && new_places calls; } | sort -n -u); do
        [ ! -e place ] || rm -rf place
        prepare
        without_call "$k" "$@"
        status=$?
        left=
        [ ! -e place ] || left=$(find place -name '*.new')
        if [ -n "$left" ]; then
            fault="$fault $k:file"
        elif [ "$(grep -c '^dalembert: cannot ' err)" -gt 1 ]; then
            fault="$fault $k:messages"
        elif [ $status -eq "$well" ]; then
            without_times other
            same_files well other >/dev/null && ! wrote 'dalembert: cannot ' || fault="$fault $k:other"
        elif wrote 'dalembert: out of memory' && sanitized; then
            continue # it ends at once, and what it has not freed counts as a leak
        elif { [ $status -ne 2 ] && [ $status -ne 4 ]; } || ! wrote 'dalembert: '; then
            fault="$fault $k:$status"
        fi
    done
    expect "status $well, $total calls, at$fault: $*" [ -z "$fault" -a "$total" -gt 0 -a "$well" -eq 0 ]
}

fails_calls() { raises && shared_object fail_call && without_call 0 --version && [ ! -s err ]; }
if needs 87 "no compiler for calls that fail" fails_calls; then
    motion="line.yaml --integrator rk4 --step 0.1 --time 1"
    cat >ball.yaml <<'EOF'
coordinates: [x, y]
lagrangian: (x'^2 + y'^2)/2 - y
start: {x': 1, y: 1}
events:
  - {when: y, direction: down, restitution: 0.5}
EOF
    printf '%s\n' t,f 0,0 1,2 >push.csv
    printf '%s\n' 0.2 0.5 1 >times.csv
    printf '%s\n' 'coordinates: [x]' 'tables: {f: {file: push.csv, at: t, value: f}}' \
        'accelerations: {x: f(t)}' >push.yaml
    # Of each chunk some members fail, whose messages shards keep.
    printf '%s\n' 'coordinates: [x]' 'parameters: {k: 0}' 'accelerations: {x: sqrt(k - 1.2)}' >root.yaml
    printf '%s\n' 'integrators: rk4' 'step: 0.1' 'time: 1' 'starts: physical' 'systems:' \
        '  - {system: line.yaml, set: {k: [1, 2]}}' >short.yaml

    case_is "a terminal that is full"
    awk 'BEGIN { print "t,x"; for (t = 0; t <= 1; t += 0.125) print t "," t * t }' >curve.csv
    few="ensemble root.yaml --integrator rk4 --step 0.5 --times 0.5,1 --members 300 --seed 1 --vary k=uniform(1,2)"
    for arguments in list "study --show" "check line.yaml" "run $motion" "section line.yaml --on x-0.1 ${motion#* }" \
        "lyapunov $motion" "invariants line.yaml" "dirac line.yaml" "action line.yaml curve.csv" "volume $motion" \
        "order line.yaml --integrators rk4 --time 1" "study short.yaml --output full-study" \
        "$few --output full-ensemble --no-page" "steer line.yaml --to x=1 ${motion#* }"; do
        timeout $patience env ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}verify_asan_link_order=0" \
            FAIL_TERMINAL=1 LD_PRELOAD="$shim" "$program" $arguments >/dev/full 2>err
        status=$?
        expect "exit $status, not 4: $arguments" [ $status -eq 4 ]
        says "^dalembert: cannot write 'standard output': "
    done
    rm -rf full-*

    case_is "calls that fail: one file"
    prepare() { mkdir place; }
    fails_openly check line.yaml
    fails_openly run $motion
    fails_openly run $motion --output place/rows.csv
    fails_openly run $motion --output place/rows.npy
    fails_openly run push.yaml --integrator rk4 --step 0.1 --times times.csv --observe "x^2" --output place/rows.csv
    fails_openly run ball.yaml --integrator rk4 --step 0.1 --time 3 --events place/log.csv --output place/rows.csv
    fails_openly generate line.yaml --integrator rk4 --output place/line.c
    fails_openly new place/begun
    fails_openly help --markdown
    fails_openly order line.yaml --integrators rk4 --time 1 --threads 1 --output place/order.csv
    fails_openly section chaplygin-sleigh-full-turn --on phi=1 --integrator rk4 --step 0.1 --time 9 --output place/section.csv
    fails_openly lyapunov isokinetic --integrator rk4 --step 0.1 --time 2 --output place/means.csv
    fails_openly predict line.yaml --integrator rk4 --step 0.1 --time 1 --output place/curves.csv
    fails_openly explain line.yaml --integrator rk4 --step 0.1 --time 1 --output place/shares.csv

    case_is "calls that fail: directories"
    prepare() { :; }
    fails_openly run ball.yaml --integrator rk4 --step 0.1 --time 3 --output place
    fails_openly study short.yaml --output place --threads 1 --no-page
    fails_openly steer line.yaml --to x=1 --integrator gauss4 --step 0.1 --time 1 --output place
    # Its forces leave no room for a controlled system, which is removed.
    printf '%s\n' 'coordinates: [x]' "lagrangian: x'^2/2" 'controls: [{x: 1}]' 'forces: {x: 0.5}' >pushed.yaml
    fails_openly steer pushed.yaml --to x=1 --rest --effort controls --integrator gauss4 --step 0.5 --time 1 --output place
    fails_openly volume $motion --output place
    sed 's/^time/rows: none\npredict: on\ntime/' short.yaml >bare.yaml
    echo 'expect: {line.yaml_k=1: {rk4: {state: done}}}' >>bare.yaml
    fails_openly study bare.yaml --output place --threads 1 --no-page
    fails_openly study bare.yaml --output place --threads 1 --no-page --checkpoint 0
    fails_openly $few --threads 1 --no-page --output place
    fails_openly $few --threads 1 --no-page --checkpoint 0 --output place

    case_is "calls that fail: directories that were begun"
    mkdir begun
    for shard in 1 2; do
        try 0 study short.yaml --shard $shard/2 --output begun/study-$shard --threads 1
        try 0 $few --shard $shard/2 --output begun/ensemble-$shard --threads 1
        try 0 study bare.yaml --shard $shard/2 --output begun/bare-$shard --threads 1
    done
    try 0 study short.yaml --output whole-study --no-page
    try 0 $few --output whole-ensemble --no-page
    prepare() { cp -R begun place; }
    fails_openly merge place/study-1 place/study-2 --output place/study --threads 1 --no-page
    fails_openly merge place/bare-1 place/bare-2 --output place/bare --threads 1 --no-page
    fails_openly merge place/bare-1 place/bare-2 --output place/bare-2 --threads 1 --no-page
    fails_openly merge place/ensemble-1 place/ensemble-2 --output place/ensemble --threads 1 --no-page
    prepare() { cp -R begun/study-1 place && rm -r place/runs/*; }
    fails_openly resume place --threads 1 --no-page
    prepare() { cp -R begun/ensemble-1 place && rm place/chunks*; }
    fails_openly resume place --threads 1 --no-page
    try 0 run $motion --output run
    prepare() { cp -R run place; }
    fails_openly pack place --output place/run.tar
    try 0 run ball.yaml --integrator rk4 --step 0.1 --time 3 --output bounces
    fails_openly run $motion --output place --force
    fails_openly resume place --time 2
    fails_openly section place --on x=0.3
    prepare() { cp -R begun/study-1 place; }
    fails_openly study short.yaml --shard 2/2 --output place --threads 1
    prepare() { cp -R whole-study place; }
    fails_openly study short.yaml --output place --threads 1 --force --no-page
    prepare() { cp -R whole-ensemble place; }
    fails_openly $few --output place --threads 1 --force --no-page
    fails_openly resume place --members 600 --threads 1 --no-page
    if sanitized; then
        cannot 5 "sanitizers make calls of their own beside the page's"
    else
        FAILING_CALLS=15
        prepare() { cp -R run place; }
        fails_openly report place
        mkdir draws
        printf '#!/bin/sh\necho "<svg></svg>" >"${1%%.gp}.svg"\n' >draws/gnuplot
        chmod +x draws/gnuplot
        PATH=$work/draws:$PATH fails_openly report place --svg
        prepare() { cp -R bounces place; }
        fails_openly report place
        prepare() { cp -R whole-study place; }
        fails_openly report place
        prepare() { cp -R whole-ensemble place; }
        fails_openly report place
    fi
    # When no event has been, after some, and when all but the manifest is written.
    for call in 3 15 0; do
        rm -rf run
        cut_off $((call ? 137 : 0)) 9 $call run ball.yaml --integrator rk4 --step 0.1 --time 3 --checkpoint 0 --output run
        [ $call -ne 0 ] || sed -i 's/"status": "done"/"status": "running"/' run/manifest.json
        rm -f run/checkpoint.before # which would be read instead
        prepare() { cp -R run place; }
        fails_openly resume place
    done
    prepare() { :; }
    FAILING_CALLS=50
    fails_openly run ball.yaml --integrator rk4 --step 0.1 --time 0.2 --checkpoint 0 --output place
    counted
fi
