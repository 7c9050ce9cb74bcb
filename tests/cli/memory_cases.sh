# Memory that runs out: every command ends with a message and status 4, wherever that happens, and
# with what it would have written wherever that does not matter.  fail_allocation.c lets the k-th
# allocation fail, the first from each place (fail_place.h) that no command before has tried, or all from
# the k-th on, for ALLOCATIONS of them.

ALLOCATIONS=${ALLOCATIONS:-16}
shim=$top/fail_allocation.so
# without_memory K COUNT ARGUMENT...: allocation K and COUNT - 1 after it fail; K = 0: none.
without_memory() {
    k=$1 count=$2
    shift 2
    LD_PRELOAD="$shim" FAIL_AT=$k FAIL_COUNT=$count FAIL_LOG="$work/allocations" "$program" "$@" >out 2>err
}
# fails_cleanly ARGUMENT...: begins with what `prepare` makes, in the directory `place`.
fails_cleanly() {
    rm -rf place
    prepare
    without_memory 0 1 "$@"
    well=$? fault=
    total=$(head -n 1 allocations)
    without_times well
    single=$(new_places allocations)
    for k in $single $(numbers "$total" "$ALLOCATIONS" | sed 's/$/-/'); do
        [ ! -e place ] || rm -rf place
        prepare
        case $k in
            *-) without_memory "${k%-}" 1000000 "$@" ;;
            *) without_memory "$k" 1 "$@" ;;
        esac
        status=$?
        if [ -e place ] && [ -n "$(find place -name '*.new')" ]; then
            fault="$fault $k:file"
        elif [ $status -eq "$well" ]; then
            without_times other
            same_files well other >/dev/null || fault="$fault $k:other"
        elif [ $status -ne 4 ] || ! wrote 'dalembert: '; then
            fault="$fault $k:$status"
        fi
    done
    expect "status $well, $total allocations, at$fault: $*" [ -z "$fault" -a "$total" -gt 0 ]
}

fails_allocations() { shared_object fail_allocation && without_memory 0 1 --version && [ ! -s err ]; }
if sanitized; then
    cannot 36 "sanitizers have an allocator of their own"
elif needs 36 "no compiler for allocations that fail" fails_allocations; then
    printf '%s\n' 'title: t' 'integrators: [rk4, gauss4]' 'step: 0.1' 'time: 1' 'systems:' \
        '  - {system: line.yaml, set: {k: [1, 2]}}' >scarce.yaml
    motion="line.yaml --integrator rk4 --step 0.1 --time 1"
    printf '%s\n' 'coordinates: [x, y]' "lagrangian: (x'^2 + y'^2)/2 - y" "start: {x': 1, y: 1}" \
        'events: [{when: y, direction: down, restitution: 0.5}]' >falling-ball.yaml
    awk 'BEGIN { print "t,x"; for (t = 0; t <= 1; t += 0.125) print t "," t * t }' >curve.csv
    mkdir scarce
    try 0 run $motion --output scarce/whole
    mkdir scarce/halves
    try 0 study scarce.yaml --shard 1/2 --output scarce/halves/one
    try 0 study scarce.yaml --shard 2/2 --output scarce/halves/two
    cp -R scarce/halves/two scarce/halves/begun
    rm -rf scarce/halves/begun/runs/*

    case_is "no memory: data on standard output"
    prepare() { :; }
    fails_cleanly check nonholonomic-particle
    fails_cleanly list systems
    fails_cleanly run $motion
    fails_cleanly section chaplygin-sleigh-full-turn --on phi=1 --integrator rk4 --step 0.05 --time 10
    fails_cleanly lyapunov isokinetic --integrator rk4 --step 0.1 --time 5
    fails_cleanly explain line.yaml --integrator rk4 --step 0.1 --time 2
    fails_cleanly generate line.yaml --integrator gauss4
    fails_cleanly check servo-pendulum
    fails_cleanly check chaplygin-sleigh-vakonomic
    fails_cleanly run falling-ball.yaml --integrator rk4 --step 0.1 --time 3
    fails_cleanly run bead-on-hoop --integrator rattle --step 0.05 --time 1 --observe "x*x"
    fails_cleanly run heisenberg --integrator gauss4 --step 0.1 --time 1 --sensitivities kx --json
    fails_cleanly run knife-edge --integrator taylor --step 0.1 --time 1 --start pi_x=0.1
    fails_cleanly predict heisenberg --integrator rk4,gauss4+project --step 0.1 --time 2
    fails_cleanly predict line.yaml --integrator rk4 --step 0.1 --time 2 --pieces 2
    fails_cleanly steer line.yaml --to x=1 --integrator gauss4 --step 0.1 --time 1
    fails_cleanly invariants heisenberg
    fails_cleanly dirac knife-edge
    fails_cleanly action line.yaml curve.csv --methods rk4
    fails_cleanly order line.yaml --integrators rk4,gauss4 --time 1 --threads 2
    fails_cleanly run --integrater rk4

    case_is "no memory: directories"
    prepare() { mkdir place; }
    fails_cleanly new place/begun
    prepare() { :; }
    fails_cleanly run $motion --output place
    fails_cleanly section chaplygin-sleigh-full-turn --on phi=1 --integrator rk4 --step 0.05 --time 10 --output place
    fails_cleanly study scarce.yaml --output place --threads 2 --no-page
    prepare() { cp -R scarce/halves/begun place; }
    fails_cleanly resume place --threads 2 --no-page
    prepare() { cp -R scarce/halves place; }
    fails_cleanly merge place/one place/two --output place/all --no-page
    prepare() { cp -R scarce/whole place; }
    fails_cleanly report place

    case_is "no memory: a run that failed for it is resumed"
    long="line.yaml --integrator rk4 --step 1e-3 --time 5000 --native off"
    rm -rf place
    without_memory 0 1 run $long --checkpoint 1000 --output scarce/long
    first=$(($(head -n 1 allocations) + 20)) # some checkpoints later
    without_memory $first 1000000 run $long --checkpoint 0 --output place
    expect "status $?" [ $? -eq 4 ]
    says '^dalembert: out of memory$'
    expect "no checkpoint" test -s place/checkpoint
    try 0 resume place
    expect "other rows" cmp scarce/long/trajectory.npy place/trajectory.npy
    rm -rf place scarce
    counted
fi
