# What runs the checks of make check beside each other: tests/run.sh, in a tree whose parts and suites are scripts.

checks_name="tree of checks"
mkdir -p "$checks_name/tests/cli" "$checks_name/build/tests"
cp "$here/../run.sh" "$here/../record.sh" "$here/../checks.mk" "$here/../summary.awk" "$checks_name/tests"
cat >"$checks_name/tests/cli/run.sh" <<'END'
case $2 in
good) echo "cli: good: 2 checks are skipped: no tool"; echo "cli: 5 passed, 0 failed, 2 skipped" ;;
slow) until [ -e after ]; do sleep 0.1; done; echo "slow output"; echo "cli: 1 passed, 0 failed, 0 skipped" ;;
after) echo "after output" >&2; echo "cli: 2 passed, 0 failed, 0 skipped"; touch after ;;
bad) echo "cli: FAILED: a case: a reason"; echo "cli: 3 passed, 2 failed, 0 skipped"; exit 1 ;;
killed) kill -9 $$ ;;
ended) kill -9 $PPID ;;
none) ;;
zero) echo "cli: 0 passed, 0 failed, 0 skipped" ;;
late) echo "cli: 1 passed, 0 failed, 0 skipped"; echo "a file is left" >&2 ;;
place) echo "place: $TMPDIR, $XDG_CACHE_HOME, $(wc -c)"; touch "$TMPDIR/one"; [ "$(ls "$TMPDIR")" = one ] &&
    echo "cli: 1 passed, 0 failed, 0 skipped" ;;
endless) sleep 3600 & echo $! $$ >pids; setsid sleep 3600 & echo $! >>pids; touch begun; wait; sleep 3600 ;;
esac
END
cat >"$checks_name/build/tests/suite" <<'END'
#!/bin/sh
[ "$1" != --quick ] || { echo quick; shift; }
[ $1 != crash ] || kill -SEGV $$
bad=0
[ $1 != bad ] || { bad=1; printf 'Suite bad, Test t had failures:\n    1. f.c:7  - x\n'; }
[ $1 != skips ] || echo 'suite: 2 times tests are skipped'
printf '\n\n     CUnit - A unit testing framework for C - Version 2.1-3\n     http://cunit.sourceforge.net/\n\n'
cat <<TABLE

Run Summary:    Type  Total    Ran Passed Failed Inactive
              suites      1      1    n/a      0        0
               tests      3      3      $((3 - bad))      $bad        0
             asserts   1000   1000   $((1000 - bad))      $bad      n/a

Elapsed time =    1.500 seconds
TABLE
exit $bad
END
chmod +x "$checks_name/build/tests/suite"
# driven STATUS CHECK...: what the checks print goes to out.
driven() {
    expected=$1
    shift
    (cd "$checks_name" && unset MAKEFLAGS MFLAGS MAKELEVEL &&
        BUILD=build PROGRAM=none SUITE_OPTIONS=$options RUN_SUITE= timeout --foreground $patience \
            sh tests/run.sh "make -j$jobs" "$@") >out 2>err
    ended $? "$@"
}
jobs=2 options=
in_order() { # TEXT...: lines of out that begin so, in this order
    for text; do echo "$text"; done >expected
    sed 's/^ *[0-9]* s  /s /' out | awk 'NR == FNR { text[++count] = $0; next }
        k < count && index($0, text[k + 1]) == 1 { k++ }
        END { exit k != count }' expected -
}

if needs 32 "no make" there make; then
    case_is "checks beside each other: in order, each in its place"
    driven 0 cli-slow cli-after cli-good cli-place suite-one suite-skips
    expect "the order" in_order 's cli-slow' 'slow output' 's cli-after' 'after output' \
        's cli-good' 'cli: good: 2' 's cli-place' 's suite-one' 's suite-skips' \
        'cli: 9 passed, 0 failed, 2 skipped' 'suites: 2 times tests are skipped' 'Run Summary:' \
        '              suites      2      2    n/a      0        0' \
        '               tests      6      6      6      0        0' \
        '             asserts   2000   2000   2000      0      n/a' 'Elapsed time =    3.000 seconds'
    silent
    expect "one sum" test "$(grep -c '^cli: [0-9]' out)" -eq 1
    expect "the summary is last" sh -c 'tail -n 1 out | grep -q "^Elapsed time"'
    prints '^place: (/.*)/cli-place/tmp, \1/cli-place/tmp/cache, 0$'
    expect "files are left" test ! -e "$(sed -n 's/^place: \(.*\), .*, 0$/\1/p' out)"
    driven 0 cli-late

    case_is "checks beside each other: those that fail"
    jobs=1 options=--quick
    rm "$checks_name/after"
    driven 1 cli-bad cli-killed cli-none cli-zero cli-good suite-bad suite-crash suite-one
    expect "the order" in_order 's cli-bad' 'cli: FAILED: a case: a reason' 'FAILED: cli-bad, exit status 1' \
        'FAILED: cli-killed, exit status 137' 'FAILED: cli-none counts no checks' \
        'FAILED: cli-zero counts no checks' 's cli-good' 's suite-bad' quick 'Suite bad, Test t' \
        'FAILED: suite-bad, exit status 1' 'FAILED: suite-crash, exit status 139' 's suite-one' \
        'cli: 8 passed, 5 failed, 2 skipped' '6 of 8 checks failed' \
        '              suites      3      3    n/a      1        0' \
        '               tests      6      6      5      1        0'
    for check in cli-bad cli-killed cli-none cli-zero suite-bad suite-crash; do
        driven 1 $check
        expect "the last line" sh -c 'tail -n 1 out | grep -Eq "^(Elapsed|1 of 1 checks failed)"'
    done
    driven 1 cli-ended cli-good
    prints '^FAILED: cli-ended was ended before it had a result$'
    prints '^ *[0-9]+ s  cli-good$'
    prints '^cli: 5 passed, 1 failed, 2 skipped$'
    prints '^1 of 2 checks failed$'

    case_is "checks beside each other: no process remains after an interrupt"
    if needs 5 "no setsid" there setsid; then
        (cd "$checks_name" && unset MAKEFLAGS MFLAGS MAKELEVEL && exec env PROGRAM=none RUN_SUITE= BUILD=build \
            setsid sh tests/run.sh make cli-endless) >out 2>err &
        driver=$!
        expect "it begins" awaits test -e "$checks_name/begun"
        kill -TERM -$driver
        expect "the driver goes on" awaits gone $driver
        for process in $(cat "$checks_name/pids"); do expect "$process goes on" awaits gone "$process"; done
        counted
    fi
    counted
fi

case_is "a part that is killed: what watches it ends"
if needs 3 "no tail of GNU" sh -c "tail --help | grep -q pid"; then
    mkdir killed
    cp "$here/run.sh" killed
    echo 'echo "$watcher" >"$TMPDIR/watcher"; kill -KILL $$' >killed/killed_cases.sh
    { TMPDIR=$PWD/killed PATIENCE=36000 sh killed/run.sh "$program" killed; } >out 2>err
    killed=$?
    expect "exit $killed, not 137" test $killed -eq 137
    expect "it was not watched" test -s killed/watcher
    expect "it is watched on" awaits gone "$(cat killed/watcher)"
    counted
fi
