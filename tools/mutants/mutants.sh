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
# Each is built below BUILD/mutants by JOBS processes, at -O1 and with few variants, since a source of
# several widths must be changed in all of them; one is for AVX2, so that code for it runs as well.
# The suites of the module (suites.txt) run until one fails, the fastest first, then the parts of the
# command line, one by one; for a file in cli/ only these.  A part that fails must pass with the sources themselves.  A
# mutant that takes LIMIT times as long as the sources themselves is ended and counts as noticed, as
# one that crashes does.
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
LIMIT=${LIMIT:-6}
BUILD=${BUILD:-build}
place=$root/$BUILD/mutants
case $BUILD in /*) place=$BUILD/mutants ;; esac
# What is no C, such as arguments exchanged that have other types, is no mutant.
flags="-O1 -Werror=incompatible-pointer-types -Werror=int-conversion"
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
    (cd "$tree" && find . -path ./build -prune -o -type f -print) | while read -r file; do
        [ -e "$file" ] || rm "$tree/$file"
    done
}
build() {
    make -s -C "$tree" -j"${JOBS:-$(nproc)}" BUILD=build CC="$CC" CFLAGS="$flags" VARIANTS="$variants" "$@" \
        >"$place/make.log" 2>&1
}
# tests_of FILE KIND: the suites, or the parts of the command line (KIND cli), of a file.
tests_of() {
    awk -v file="$1" -v kind="$2" '/^#/ || NF == 0 { next }
        $1 == "quick" { for (i = 2; i <= NF; i++) quick = quick " " $i; next }
        index(file, $1) == 1 && length($1) >= best { best = length($1); line = $0 }
        END {
            parts = suites = ""
            n = split(line, word, " ")
            for (i = 2; i <= n; i++)
                if (word[i] == "cli") cli = 1
                else if (cli) parts = parts " " word[i]
                else suites = suites " " word[i]
            if (kind == "cli") { print parts; exit }
            if (file ~ /^cli\//) exit
            n = split(suites quick, word, " ")
            for (i = 1; i <= n; i++) if (!(word[i] in seen)) { seen[word[i]] = 1; print word[i] }
        }' "$here/suites.txt"
}
# limited SECONDS COMMAND...: in the tree, within a time and a memory that faults may not exceed; the
# sanitizers map much more than they use.
limited() {
    seconds=$1
    shift
    (cd "$tree" && { [ -n "$SANITIZE" ] || ulimit -v 8000000; } && TMPDIR=$place/tmp exec timeout -k 2 "$seconds" "$@") \
        >"$place/test.log" 2>&1
}
# known SUITE...: those that this version has.
known() { for suite; do grep -x "$suite" "$place/suites"; done; }
# fastest_first SUITE...: those that this version has, by the time that they took with the sources themselves.
fastest_first() { known "$@" | sort -u | join - "$place/times" | sort -n -k 2 | cut -d ' ' -f 1; }
# passes FILE SECONDS: whether all tests of a file pass; names the test that does not.
passes() {
    for suite in $(fastest_first $(tests_of "$1" suites)); do
        noticed=$suite
        limited "$2" build/tests/suite --quick "$suite" || return
    done
    parts=$(tests_of "$1" cli)
    [ -z "$parts" ] || build build/dalembert || return
    for part in $parts; do
        noticed="cli $part"
        run_part "$((10 * $2 + 5 * PATIENCE))" build/dalembert "$part"
        ends=$?
        [ $ends -eq 0 ] || { confirm "$part"; return $ends; }
    done
}
# run_part SECONDS PROGRAM PART: PATIENCE ends commands that hang; a machine with other work needs more of it.
PATIENCE=${PATIENCE:-60}
run_part() { limited "$1" env PATIENCE="$PATIENCE" FIRST_FAILURE=1 sh tests/cli/run.sh "$2" "$3"; }
# A part that fails with the sources themselves would notice nothing.
confirm() {
    grep -qx "$1" "$place/confirmed" && return
    run_part 3600 "$place/program" "$1" ||
        { cat "$place/test.log"; echo "mutants: cli $1 fails without a mutant"; exit 2; }
    echo "$1" >>"$place/confirmed"
}
# What a file is compiled into.
target_of() { case $1 in cli/*) echo dalembert ;; *) echo tests/suite ;; esac; }
# function_of FILE LINE: the function that the line is in.
function_of() {
    awk -v line="$2" 'FNR > line { exit }
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
build build/tests/suite build/dalembert ||
    { cat "$place/make.log"; echo "mutants: the sources do not build"; exit 2; }
cp "$tree/build/tests/suite" "$place/suite"
cp "$tree/build/dalembert" "$place/program"
"$place/suite" --list >"$place/suites"
: >"$place/confirmed"
find $module -name '*.[ch]' | sort | xargs awk -v operators="$OPERATORS" -f "$here/candidates.awk" |
    awk -v seed="$seed" 'BEGIN { FS = OFS = "\t"; x = (seed * 48271 + 11) % 2147483646 + 1 }
        { x = (16807 * x) % 2147483647; print x, $0 }' | sort -n | cut -f2- >"$place/candidates"
began=$(date +%s)
for file in $(cut -f1 "$place/candidates" | sort -u); do tests_of "$file" suites; done | sort -u \
    >"$place/needed"
for suite in $(known $(cat "$place/needed")); do
    started=$(date +%s%N)
    limited 600 build/tests/suite --quick "$suite" ||
        { { cat "$place/test.log"; echo "mutants: $suite fails without a mutant"; } >&2; exit 2; }
    echo "$suite $(($(date +%s%N) - started))"
done >"$place/times"
limit=$((LIMIT * ($(date +%s) - began) / 4 + 10))

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
        passes "$file" "$limit"
        case $? in
        0) survived=$((survived + 1))
           printf 'survived  %s:%s: %s: %s\n' "$file" "$line" "$operator" "$shown" ;;
        124 | 137) late=$((late + 1)) ;;
        *) killed=$((killed + 1)) ;;
        esac
        [ -n "$V" ] && printf '          %s:%s: %s: %s (%s)\n' "$file" "$line" "$operator" "$shown" "$noticed"
    fi
    cp "$file" "$tree/$file"
done
echo "mutants: $module, OPERATORS=$OPERATORS, SEED=$seed: $count mutants, $((killed + late)) noticed ($late by their time)," \
    "$survived survived; beside them $listed listed as equivalent, $same of the same machine code," \
    "$broken that do not compile"
[ $((10 * survived)) -le "$count" ]
