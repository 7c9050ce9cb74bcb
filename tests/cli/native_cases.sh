# Native mode: compiled steps change no byte, and where they cannot be had the tape goes on.

HOME=$work
XDG_CACHE_HOME=$work/cache
export HOME XDG_CACHE_HOME
motion="nonholonomic-particle --integrator gauss4+project --step 0.01 --time 5"
case_is "native: interpreted, for comparison"
try 0 run $motion --native off --output tape.csv
silent
expect "off made a cache" test ! -e cache
if needs 103 "no compiler" there cc; then
    case_is "native: the same bytes"
    try 0 run $motion --native on --output native.csv
    silent
    expect "other bytes" cmp -s tape.csv native.csv
    expect "not the objects of steps and observables" test "$(ls cache/dalembert | wc -l)" -eq 2
    expect "the cache is not private" test "$(stat -c %a cache/dalembert)" = 700
    objects=$(ls cache/dalembert/*.so)
    made=$(stat -c %i $objects)

    case_is "native: taken from the cache, by checkpoints too"
    try 0 run $motion --native on --output native.csv
    expect "compiled again" test "$(stat -c %i $objects)" = "$made"
    try 0 run $motion --native off --output interpreted
    try 0 run $motion --native on --output there
    expect "other bytes" cmp -s interpreted/trajectory.npy there/trajectory.npy
    expect "another summary" cmp -s interpreted/summary.csv there/summary.csv

    case_is "native: a corrupt object is compiled again"
    for object in $objects; do
        for damage in 'head -c 5000 "$object" > first_half && cp first_half "$object"' ': >"$object"' \
            'printf x | dd of="$object" bs=1 seek=4444 conv=notrunc 2>dd.log'; do
            eval "$damage"
            try 0 run $motion --native on --output native.csv
            silent
            expect "other bytes" cmp -s tape.csv native.csv
        done
    done

    case_is "native: a FIFO or a directory instead of an object"
    for object in $objects; do
        rm "$object"
        mkfifo "$object"
        try 0 run $motion --native on --output native.csv
        silent
        expect "other bytes" cmp -s tape.csv native.csv
        expect "no object instead" test -f "$object"
        rm "$object"
        mkdir "$object"
        try 0 run $motion --native on --output native.csv
        says "are interpreted: '.*/cache/dalembert/.*' is in the way: it is a directory"
        expect "other bytes" cmp -s tape.csv native.csv
        rmdir "$object"
    done

    case_is "native: two processes at once"
    rm -rf cache
    "$program" run $motion --native on --output one.csv 2>one.err &
    "$program" run $motion --native on --output two.csv 2>two.err
    wait
    cat one.err two.err >err
    silent
    expect "other bytes" cmp -s tape.csv one.csv
    expect "other bytes" cmp -s tape.csv two.csv
    expect "not the objects of steps and observables" test "$(ls cache/dalembert | wc -l)" -eq 2

    case_is "native: the same failure"
    try 3 run chaplygin-sleigh-nonlinear --integrator rk4 --step 0.05 --time 5 --native off
    cp out tape.csv
    cp err tape.err
    try 3 run chaplygin-sleigh-nonlinear --integrator rk4 --step 0.05 --time 5 --native on
    expect "other bytes" cmp -s out tape.csv
    expect "another message" cmp -s err tape.err
    try 0 run $motion --native off --output tape.csv

    case_is "native: a study"
    # Long enough for a compiler: half a million steps of each method and space.
    printf '%s\n' 'title: t' 'integrators: [rk4, gauss4]' 'step: [0.01, 0.005]' 'time: 1700' 'samples: 10' \
        'statistics: 1000' 'systems: [chaplygin-sleigh]' >native.yaml
    try 0 study native.yaml --output native-study --native on
    silent
    try 0 study native.yaml --output tape-study --native off
    for file in quantities.csv series/chaplygin-sleigh.csv; do
        expect "$file has other bytes" cmp -s native-study/$file tape-study/$file
    done

    case_is "native: the cells of a study share objects"
    # Each call of this compiler adds a line, and waits where it must for a file.
    mkdir -p gate
    printf '#!/bin/sh\necho $$ >>"%s/gate/begun"\n%s\nexec %s "$@"\n' "$work" \
        "while [ -e '$work/gate/closed' ]; do sleep 0.02; done" "$(command -v cc)" >gate/cc
    chmod +x gate/cc
    rm -rf cache native-study
    PATH=$PWD/gate:$PATH try 0 study native.yaml --output native-study --native on --threads 4
    silent
    expect "not the steps of two methods on two spaces" test "$(wc -l <gate/begun)" -eq 4
    cmp -s native-study/quantities.csv tape-study/quantities.csv || fail "other bytes"

    case_is "native: short cells of a study are not compiled"
    sed 's/time:.*/time: 20/' native.yaml >short.yaml
    rm -rf cache gate/begun native-study
    PATH=$PWD/gate:$PATH try 0 study short.yaml --output native-study --native on --threads 4
    silent
    expect "something is compiled" test ! -e gate/begun

    case_is "native: nothing is compiled again for other parameters and starts"
    sed "s/systems:.*/systems: [{system: chaplygin-sleigh, set: {m: [0.5, 2, 3]}, start: {phi': [1, 2]}}]/" \
        native.yaml | sed 's/time:.*/time: 290/' >grid.yaml
    rm -rf cache gate/begun native-study tape-study
    PATH=$PWD/gate:$PATH try 0 study grid.yaml --output native-study --native on --threads 4
    silent
    expect "not the steps of two methods on two spaces" test "$(wc -l <gate/begun)" -eq 4
    try 0 study grid.yaml --output tape-study --native off
    cmp -s native-study/quantities.csv tape-study/quantities.csv || fail "other bytes"

    case_is "native: auto takes from the cache what is there"
    cached="chaplygin-sleigh --integrator gauss4 --step 0.01 --samples 10"
    rm -rf cache gate/begun
    try 0 run $cached --time 1 --native on --output cached
    PATH=$PWD/gate:$PATH try 0 run $cached --time 5000 --output cached --force
    expect "not native" grep -q '"native": true' cached/manifest.json
    expect "something is compiled" test ! -e gate/begun
    cp cached/trajectory.npy native.npy
    try 0 run $cached --time 5000 --native off --output cached --force
    expect "other bytes" cmp -s native.npy cached/trajectory.npy

    case_is "native: changed over to while the run goes on"
    size() { wc -c <"$1"; }
    # first FILE COUNT: the first numbers of a trajectory, after its header.
    first() { tail -c +$((11 + $(od -An -tu2 -j8 -N2 "$1"))) "$1" | head -c "$2"; }
    endless="chaplygin-sleigh --integrator gauss4 --step 0.01 --time 1e9 --samples 500000000"
    rm -rf cache gate/begun
    : >gate/closed
    PATH=$PWD/gate:$PATH "$program" run $endless --output changed 2>err &
    reaches $! test -s gate/begun
    ends_by TERM 130 $!
    expect "native: no compiler was done" grep -q '"native": false' changed/manifest.json
    expect "the compiler goes on" sh -c "! kill -0 $(cat gate/begun)"
    expect "something is left in the cache" test -z "$(ls cache/dalembert)"
    rm gate/begun
    PATH=$PWD/gate:$PATH "$program" resume changed 2>err &
    reaches $! test -s gate/begun
    rm gate/closed
    # A folder is there while a compiler runs; the run takes note of its end before a signal.
    compiled() { ls cache/dalembert/*.so && ! ls -d cache/dalembert/*/; }
    reaches $! compiled
    ends_by TERM 130 $!
    expect "not native" grep -q '"native": true' changed/manifest.json
    "$program" run $endless --native off --output unchanged 2>err &
    length=$(size changed/trajectory.npy)
    reaches $! has_bytes unchanged/trajectory.npy $length
    ends_by TERM 130 $!
    first changed/trajectory.npy $((length - 1000)) >changed.rows
    first unchanged/trajectory.npy $((length - 1000)) >unchanged.rows
    expect "no rows" test -s changed.rows
    expect "other rows" cmp changed.rows unchanged.rows
    rm -rf changed unchanged

    case_is "native: a compiler that fails"
    mkdir -p broken
    printf '#!/bin/sh\necho spoken\necho spoken >&2\nexit 1\n' >broken/cc
    chmod +x broken/cc
    rm -rf cache
    PATH=$PWD/broken:$PATH try 0 run $motion --native on --output native.csv
    says "steps are interpreted: the compiler 'cc' failed"
    expect "what the compiler wrote" test "$(cat out err | grep -c spoken)" -eq 0
    expect "other bytes" cmp -s tape.csv native.csv
    expect "something is left in the cache" test -z "$(ls cache/dalembert)"

    case_is "native: the object of a compiler that fails, or is killed, is not used"
    for end in 'exit 1' 'kill -9 $$'; do
        printf '#!/bin/sh\n%s "$@"\n%s\n' "$(command -v cc)" "$end" >broken/cc
        rm -rf cache
        PATH=$PWD/broken:$PATH try 0 run $motion --native on --output native.csv
        says "steps are interpreted: the compiler 'cc' failed"
        expect "other bytes" cmp -s tape.csv native.csv
        expect "an object is left in the cache" test -z "$(ls cache/dalembert)"
    done

    # Its input is empty: what is typed, or piped, is not the compiler's.
    case_is "native: what a compiler writes and reads is not the program's"
    printf '#!/bin/sh\necho spoken\necho spoken >&2\ncat >>"%s/gate/read"\nexec %s "$@"\n' "$work" \
        "$(command -v cc)" >broken/cc
    rm -rf cache
    echo typed >typed.txt
    PATH=$PWD/broken:$PATH try 0 run $motion --native on <typed.txt
    silent
    expect "what the compiler wrote" eval '! grep -q spoken out'
    expect "the compiler did not run" test -e gate/read
    expect "the compiler read" test ! -s gate/read
    counted
fi

case_is "native: no compiler"
rm -rf cache
mkdir -p none
path=$PATH
timeout=$(command -v timeout)
# shellcheck disable=SC2123
PATH=$PWD/none
"$timeout" --foreground $patience "$program" run $motion --native on --output native.csv >out 2>err
status=$?
PATH=$path
expect "exit $status" test $status -eq 0
says "steps are interpreted: no compiler 'cc'"
expect "other bytes" cmp -s tape.csv native.csv

case_is "native: a cache that is not private, or cannot be"
mkdir -p cache/dalembert
chmod 755 cache/dalembert
try 0 run $motion --native on --output native.csv
says 'steps are interpreted: .* is not a directory of this user alone'
expect "other bytes" cmp -s tape.csv native.csv
rm -rf cache
: >cache
try 0 run $motion --native on --output native.csv
says 'steps are interpreted: cannot make the directory'
rm cache
XDG_CACHE_HOME= HOME= try 0 run $motion --native on --output native.csv
says 'steps are interpreted: no directory'
case_is "native: errors"
try 2 run $motion --native yes
says "'yes' is not one of auto.on.off"
