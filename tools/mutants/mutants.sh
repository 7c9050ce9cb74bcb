#!/bin/sh
# mutants.sh MODULE SEED COUNT - whether the tests notice faults planted in MODULE, a source file or a
# directory of lib/, integrators/ or cli/, or several of them; `make mutants` calls it.
#
# A mutant is a copy of the sources with one line changed (candidates.awk).  OPERATORS=first: a
# comparison exchanged or off by one, && for ||, + for -, * for /, a constant changed, a condition
# negated, a statement deleted.  OPERATORS=new: & for |, ++ for --, break for continue, two arguments
# exchanged, a status dropped, another value returned, another word or no empty line printed.
# OPERATORS=all (the default): both.  OPERATORS=bounds: one turn too many of a loop, one place too few
# of an allocation.  SEED draws COUNT of all those that MODULE has.
#
# SANITIZE=1 builds them with the address and undefined-behaviour sanitizers, which notice reads and
# writes past an end that change no result.
#
# Each is built below BUILD/mutants by JOBS processes, at -O2 and with few variants, since a source of
# several widths must be changed in all of them; one is for AVX2, so that code for it runs as well.
# The tests that execute the line with the sources themselves, which gcov counts, run one by one until
# one fails: suites in quick runs and whole, and parts of the command line, for a file in cli/ only
# these.  Those come first that should notice a fault for the least processor time: by their own, over
# how often they noticed one in the folder of the file; both are kept for later calls.  Where the
# line itself is not counted, as in a statement of many lines, its function is.
# What fails must pass with the sources themselves.  A process that takes
# LIMIT times the longest processor time of its test that passed, and ten seconds, is ended, and a
# command of the command line after PATIENCE seconds: such a mutant counts as noticed, as one that
# crashes does.
#
# A mutant that does not compile, or has the same machine code, is drawn again.  Those that no test
# can notice are listed with their reason in equivalent.txt, by their line, or by function and both
# lines where a line as `return 0;` has many sources.  The others that are left are the
# survivors: FILE:LINE, the operator and the changed line.  More than one survivor in ten fails.
module=$1 seed=$2 wanted=$3
OPERATORS=${OPERATORS:-all}
case $OPERATORS in
first | new | all | bounds) ;;
*) echo "mutants: OPERATORS is first, new, all or bounds" >&2; exit 2 ;;
esac
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
LIMIT=${LIMIT:-3}
PATIENCE=${PATIENCE:-300}
BUILD=${BUILD:-build}
place=$root/$BUILD/mutants
case $BUILD in /*) place=$BUILD/mutants ;; esac
# What is no C, such as arguments exchanged that have other types, is no mutant.
flags="-O2 -Werror=incompatible-pointer-types -Werror=int-conversion"
if [ -n "$SANITIZE" ]; then
    place=$place-sanitize
    flags="$flags -fno-omit-frame-pointer -fno-sanitize-recover=all -fsanitize=address,undefined"
fi
tree=$place/tree
variants="x1 x1_QUAD x4"
grep -q avx2 /proc/cpuinfo 2>/dev/null && variants="x1 x1_QUAD x4_AVX2"
CC=${CC:-cc}
unset MAKEFLAGS MFLAGS MAKELEVEL
cd "$root" || exit 2
[ -n "$module" ] && find $module >/dev/null || { echo "mutants: no module '$module'; take MODULE=lib/dynamics/section.c" >&2; exit 2; }

# The sources as they are, below the tree.
copy_sources() {
    mkdir -p "$tree" "$place/tmp"
    find Makefile README.md CITATION.cff CHANGELOG.md CONTRIBUTING.md include lib integrators cli tests systems tools examples bench docs man \
        -type f | while read -r file; do
        cmp -s "$file" "$tree/$file" && continue
        mkdir -p "$tree/$(dirname "$file")"
        cp "$file" "$tree/$file"
    done
    (cd "$tree" && find . \( -path ./build -o -path ./counted \) -prune -o -type f -print) | while read -r file; do
        [ -e "$file" ] || rm "$tree/$file"
    done
}
build() {
    make -s -C "$tree" -j"${JOBS:-$(nproc)}" BUILD=build CC="$CC" CFLAGS="$flags" VARIANTS="$variants" "$@" \
        >"$place/make.log" 2>&1
}
# The same with counts of how often each line is executed, which each process adds to a file of its object.
build_counted() {
    build BUILD=counted CFLAGS="$flags -O1 --coverage" counted/tests/suite counted/dalembert
}
# tests_of FILE: what may notice a fault in it, "suite NAME" in a quick run, "whole NAME" and "cli PART".
tests_of() {
    case $1 in cli/*) ;; *) awk '{ print "suite", $1; print "whole", $1 }' "$place/suites" ;; esac
    for part in tests/cli/*_cases.sh; do
        part=${part##*/}
        echo "cli ${part%_cases.sh}"
    done
}
# cheapest_first FILE: the same by what a noticed fault should cost.  A line of the history is FOLDER, the test,
# its processor time, "passed" or "noticed".
cheapest_first() {
    tests_of "$1" | awk -v folder="$(dirname "$1")" '
        BEGIN { usual["suite"] = 1; usual["whole"] = 15; usual["cli"] = 5 }
        FILENAME == "-" {
            test = $1 " " $2
            cost = 0.05 + (test in time ? time[test] : usual[$1]) + 0.001 * ++count
            print cost * (tried[test] + 2) / (noticed[test] + 1), test
            next
        }
        { test = $2 " " $3 }
        $5 == "passed" && !(test in time && time[test] < $4) { time[test] = $4 }
        $1 == folder { tried[test]++; noticed[test] += $5 == "noticed" }
        ' "$place/history" - | sort -n | cut -d ' ' -f 2-
}
# limited SECONDS COMMAND...: in the tree, no process with more processor time or memory than faults may take;
# the sanitizers map much more than they use.  Leaves the processor time in the file spent.
limited() {
    seconds=$1
    shift
    (
        cd "$tree" && { [ -n "$SANITIZE" ] || ulimit -v 8000000; } && ulimit -S -t "$seconds" || exit 2
        TMPDIR=$place/tmp timeout -k 2 "$((20 * seconds + 10 * PATIENCE))" "$@" >"$place/test.log" 2>&1
        ended=$?
        times >"$place/spent"
        exit $ended
    )
}
# run_test SECONDS KIND NAME BINARY
run_test() {
    case $2 in
    suite) limited "$1" "$4" --quick "$3" ;;
    whole) limited "$1" "$4" "$3" ;;
    cli) limited "$1" env PATIENCE="$PATIENCE" FIRST_FAILURE=1 sh tests/cli/run.sh "$4" "$3" ;;
    esac
}
# record FOLDER KIND NAME RESULT: a line of the history, with the processor time of the test that ran.
record() {
    awk -F '[ms ]+' -v test="$1 $2 $3" -v result="$4" \
        'END { print test, 60 * $1 + $2 + 60 * $3 + $4, result }' "$place/spent" | tee -a "$place/history"
}
# confirm KIND NAME: that the test passes with the sources themselves; one that fails would notice nothing.
confirm() {
    grep -q "^- $1 $2 " "$place/times" && return
    cp "$place/test.log" "$place/noticed.log"
    run_test 3600 "$1" "$2" "$(intact_of "$1")" ||
        { { cat "$place/test.log"; echo "mutants: $1 $2 fails without a mutant"; } >&2; exit 2; }
    record - "$1" "$2" passed >>"$place/times"
    cp "$place/noticed.log" "$place/test.log"
}
# seconds_of KIND NAME: the longest that it took and passed, or more than most take.
seconds_of() {
    awk -v kind="$1" -v name="$2" '$2 == kind && $3 == name && $5 == "passed" && $4 + 1 > seconds { seconds = int($4 + 1) }
        END { print seconds ? seconds : 20 }' "$place/times" "$place/history"
}
# intact_of KIND: the binary of the sources themselves.
intact_of() { case $1 in cli) echo "$place/program" ;; *) echo "$place/suite" ;; esac; }
# passes FILE LINE: whether all tests pass that execute the line; names the test that does not.
passes() {
    cheapest_first "$1" >"$place/tests"
    while read -r kind name <&4; do
        executes "$kind" "$name" "$1" "$2" || continue
        noticed="$kind $name"
        binary=build/tests/suite
        if [ "$kind" = cli ]; then
            binary=build/dalembert
            build $binary || return
        fi
        run_test "$((LIMIT * $(seconds_of "$kind" "$name") + 10))" "$kind" "$name" $binary
        ends=$?
        if [ $ends -ne 0 ]; then
            record "$(dirname "$1")" "$kind" "$name" noticed >/dev/null
            confirm "$kind" "$name"
            return $ends
        fi
        record "$(dirname "$1")" "$kind" "$name" passed >/dev/null
    done 4<"$place/tests"
}
# executes KIND NAME FILE LINE: whether the test executes the line, or its function where it is not counted; that is
# not known of headers and tables, nor where processes are killed or cannot write, which leaves no counts.
executes() {
    case $3 in *.c) ;; *) return 0 ;; esac
    case $2 in wait | signal | kill) return 0 ;; esac
    counts=$place/reach/$1-$2
    [ -d "$counts" ] || count_lines "$1" "$2" "$counts"
    [ -e "$counts/incomplete" ] && return 0
    for object in "$counts/${3%.c}".gcda "$counts/${3%.c}"_x[0-9]*.gcda; do
        [ -e "$object" ] || continue
        base=${object%.gcda}
        ln -f "$tree/counted/${base#"$counts/"}.gcno" "$base.gcno"
        gcov -t "$object" 2>/dev/null
    done | awk -F: -v file="$3" -v line="$4" '
        $2 + 0 == 0 { is_it = $3 == "Source" ? $4 == file : is_it; next }
        !is_it { next }
        $2 + 0 == line { count = $1; gsub(/[ *]/, "", count); is_in = 1 }
        $1 ~ /[0-9]/ { runs = 1 }
        $3 ~ /^}/ {
            if (is_in && (count == "-" ? runs : count + 0 > 0)) found = 1
            is_in = runs = 0
        }
        END { exit !found }'
}
# count_lines KIND NAME FOLDER: runs a test with the sources themselves and leaves what it executes in the folder; a
# test that fails has seen messages of gcov.
count_lines() {
    binary=counted/dalembert
    [ "$1" = cli ] || binary=counted/tests/suite
    (
        GCOV_PREFIX=$3.$$
        GCOV_PREFIX_STRIP=$(echo "$tree/counted" | tr -cd / | wc -c)
        export GCOV_PREFIX GCOV_PREFIX_STRIP
        mkdir -p "$3.$$"
        run_test 3600 "$1" "$2" $binary || : >"$3.$$/incomplete"
    )
    mv -T "$3.$$" "$3"
}
# was_ended STATUS: of a test that was noticed, by its time: SIGXCPU is 24.
was_ended() {
    case $1 in 124 | 137 | 152) return ;; esac
    grep -qE 'exit (124|137|143|152), not' "$place/test.log"
}
# What a file is compiled into.
target_of() { case $1 in cli/*) echo dalembert ;; *) echo tests/suite ;; esac; }
# function_of FILE LINE: the function that the line is in.
function_of() {
    awk -v line="$2" 'FNR > line { exit }
        /^}/ { name = "" }
        /^[A-Za-z].*[(]/ && !/;$/ { name = $0; sub(/[(].*/, "", name); sub(/.*[ *]/, "", name) }
        END { print name }' "$1"
}
# is_listed FILE LINE TEXT
is_listed() {
    line_text=$(printf '%s\n' "$3" | sed 's/^ *//')
    original=$(sed -n "${2}s/^ *//p" "$1")
    grep -Fqx -e "$1: $line_text" -e "$1: $(function_of "$1" "$2"): $line_text, not $original" "$here/equivalent.txt"
}

# ---- the sources themselves ----

copy_sources
build build/tests/suite build/dalembert && build_counted ||
    { cat "$place/make.log"; echo "mutants: the sources do not build"; exit 2; }
cp "$tree/build/tests/suite" "$place/suite"
cp "$tree/build/dalembert" "$place/program"
"$place/suite" --list >"$place/suites"
cksum "$place/suite" "$place/program" >"$place/now"
find "$tree/tests/cli" -type f | sort | xargs cat | cksum >>"$place/now"
if ! cmp -s "$place/now" "$place/known"; then
    rm -rf "$place/reach"
    : >"$place/times"
    cp "$place/now" "$place/known"
fi
touch "$place/history"
find $module -name '*.[ch]' | sort | xargs awk -v operators="$OPERATORS" -f "$here/candidates.awk" |
    awk -v seed="$seed" 'BEGIN { FS = OFS = "\t"; x = (seed * 48271 + 11) % 2147483646 + 1 }
        { x = (16807 * x) % 2147483647; print x, $0 }' | sort -n | cut -f2- >"$place/candidates"

# ---- mutants ----

count=0 killed=0 late=0 survived=0 listed=0 same=0 broken=0
exec 3<"$place/candidates"
while [ "$count" -lt "$wanted" ] && IFS= read -r candidate <&3; do
    file=$(printf '%s\n' "$candidate" | cut -f1)
    line=$(printf '%s\n' "$candidate" | cut -f2)
    operator=$(printf '%s\n' "$candidate" | cut -f3)
    text=$(printf '%s\n' "$candidate" | cut -f4-)
    shown=$text
    [ "$operator" = deleted ] && shown="no $(sed -n "${line}p" "$file" | sed 's/^ *//')"
    if is_listed "$file" "$line" "$shown"; then
        listed=$((listed + 1))
        continue
    fi
    TEXT=$text awk -v line="$line" 'FNR == line { print ENVIRON["TEXT"]; next } { print }' "$file" \
        >"$tree/$file"
    target=$(target_of "$file")
    intact=$place/suite
    [ "$target" = dalembert ] && intact=$place/program
    if ! build "build/$target"; then
        broken=$((broken + 1))
    elif cmp -s "$tree/build/$target" "$intact"; then
        same=$((same + 1))
    else
        count=$((count + 1))
        passes "$file" "$line"
        ends=$?
        if [ $ends -eq 0 ]; then
            noticed="by none"
            survived=$((survived + 1))
            printf 'survived  %s:%s: %s: %s\n' "$file" "$line" "$operator" "$shown"
        elif was_ended $ends; then
            late=$((late + 1))
            noticed="$noticed, by its time"
        else
            killed=$((killed + 1))
        fi
        [ -n "$V" ] && printf '          %s:%s: %s: %s (%s)\n' "$file" "$line" "$operator" "$shown" "$noticed"
    fi
    cp "$file" "$tree/$file"
done
echo "mutants: $module, OPERATORS=$OPERATORS, SEED=$seed: $count mutants, $((killed + late)) noticed ($late by their time)," \
    "$survived survived; beside them $listed listed as equivalent, $same of the same machine code," \
    "$broken that do not compile"
[ $((10 * survived)) -le "$count" ]
