#!/bin/sh
# run.sh MAKE CHECK... - runs the checks beside each other by tests/checks.mk, as many at a time as MAKE has
# jobs, and prints them in the order of their names here; what the parts of the command line and the CUnit
# suites count is added up, and the summary of the suites comes last.
#
# Each check has a directory in RESULTS (tests/record.sh).  One that fails, is killed or counts nothing
# fails the whole, after all the others.
make=$1
shift
RESULTS=$(mktemp -d) || exit 1
export RESULTS
chmod 711 "$RESULTS" # for checks that are made as another user
here=$(dirname "$0")
case $SUITE_OPTIONS in *--quick*) least=0 ;; *) least=1 ;; esac

# Ends what has RESULTS in its environment: after an interrupt that is all that still runs.
leave() {
    results=$RESULTS
    unset RESULTS
    grep -alsFxz "RESULTS=$results" /proc/[0-9]*/environ 2>/dev/null | cut -d/ -f3 | xargs -r kill -KILL 2>/dev/null
    rm -rf "$results"
}
trap leave EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP

# A python3 that is a script which finds another one, as pyenv's, does so once, not for each of hundreds of calls.
python=$(python3 -c 'import sys; print(sys.executable)' 2>/dev/null)
if [ -n "$python" ] && [ "$python" != "$(command -v python3)" ]; then
    mkdir "$RESULTS/bin"
    printf '#!/bin/sh\nexec "%s" "$@"\n' "$python" >"$RESULTS/bin/python3"
    chmod -R 755 "$RESULTS/bin"
    PATH=$RESULTS/bin:$PATH
fi

# What CHECK printed, without what is added up; its processor time; how it failed.
show() {
    folder=$RESULTS/$1
    if ! [ -f "$folder/status" ]; then
        echo "FAILED: $1 was ended before it had a result"
        return
    fi
    read -r status seconds <"$folder/status"
    printf '%6d s  %s\n' "$seconds" "$1"
    case $1 in
    cli-*) grep -Ev '^cli: [0-9]+ passed, [0-9]+ failed, [0-9]+ skipped$' "$folder/output" ;;
    suite-*) awk '/^Run Summary:/, /^Elapsed time/ { next } /^ *(CUnit - |http:..cunit)/ { next } NF' "$folder/output" ;;
    *) cat "$folder/output" ;;
    esac
    if [ "$status" -ne 0 ]; then
        echo "FAILED: $1, exit status $status"
    elif ! counts "$1"; then
        echo "FAILED: $1 counts no checks"
        echo 1 >"$folder/status"
    fi
}
# counts CHECK: it says how many of its checks passed, or were skipped, at least one; what is no part or suite need
# not, nor a suite that --quick cuts to nothing.
counts() {
    case $1 in
    cli-*) grep -qE '^cli: ([1-9][0-9]* passed|0 passed, 0 failed, [1-9])' "$RESULTS/$1/output" ;;
    suite-*) grep -q "^ *asserts *[$least-9]" "$RESULTS/$1/output" ;;
    esac
}
# In the order of the checks, each as soon as it and all before it are over.
show_all() {
    for check; do
        until [ -f "$RESULTS/$check/status" ] || [ -f "$RESULTS/over" ]; do
            kill -0 $$ 2>/dev/null || exit 1
            sleep 0.2
        done
        show "$check"
    done
}
show_all "$@" &
$make --no-print-directory -f "$here/checks.mk" CHECKS="$*"
touch "$RESULTS/over"
wait $!

# The sums.  What ended without a count is one failure.
failed=0
for check; do
    status=1
    [ ! -f "$RESULTS/$check/status" ] || read -r status seconds <"$RESULTS/$check/status"
    [ "$status" -eq 0 ] || failed=$((failed + 1))
done
outputs() { # KIND: what the checks of a kind printed
    cat "$RESULTS/$1"-*/output /dev/null 2>/dev/null
}
uncounted() { # KIND: how many of its checks counted nothing
    for check in $checks; do
        case $check in $1-*) counts "$check" || echo "$check" ;; esac
    done 2>/dev/null | grep -c .
}
checks=$*
case " $* " in *" cli-"*)
    outputs cli | awk -v failed="$(uncounted cli)" '
        /^cli: [0-9]+ passed, [0-9]+ failed, [0-9]+ skipped$/ { passed += $2; failed += $4; skipped += $6 }
        END { printf "cli: %d passed, %d failed, %d skipped\n", passed, failed, skipped }'
    ;;
esac
[ $failed -eq 0 ] || echo "$failed of $# checks failed"
case " $* " in *" suite-"*) outputs suite | awk -v broken="$(uncounted suite)" -f "$here/summary.awk" ;; esac
[ $failed -eq 0 ]
