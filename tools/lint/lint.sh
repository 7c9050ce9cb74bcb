#!/bin/sh
# lint.sh - the rules of the project, checked on sources and on object files.  Every check prints
# violations, one a line; any violation fails.  BUILD names a finished plain build.
cd "$(dirname "$0")/../.." || exit 2
BUILD=${BUILD:-build}
here=tools/lint
failed=0

check() { # TITLE COMMAND...: a violation is a line of output, or a command that fails
    title=$1
    shift
    if violations=$("$@" 2>&1) && [ -z "$violations" ]; then
        echo "lint: $title: ok"
    else
        echo "lint: $title:"
        echo "$violations" | sed 's/^/    /'
        failed=1
    fi
}

# The templates (.inc), too.
sources() { find include lib integrators cli python tests examples bench -name '*.[ch]' -o -name '*.inc' | sort; }
objects() { find "$BUILD/lib" "$BUILD/integrators" -name '*.o' | sort; }

format() { sources | xargs clang-format --dry-run -Werror --ferror-limit=1; }
includes() {
    sources | xargs awk -f $here/includes.awk $here/includes.txt
    grep -lr '#include "dalembert.h"' lib cli | xargs grep -L DAL_VERSION |
        sed 's/$/: dalembert.h is for DAL_VERSION here; include the headers of the topics/'
}
sizes() { sources | xargs awk 'length > 100 { print FILENAME ":" FNR ": longer than 100 columns" }
    FNR == 601 { print FILENAME ": longer than 600 lines" }'; }
functions() {
    sources | xargs ctags -x --map-C=+.inc --c-kinds=f --_xformat='%F %{line} %{end} %N' |
        awk '$3 - $2 >= 60 { print $1 ":" $2 ": " $4 " has " $3 - $2 + 1 " lines (60 at most)" }'
}
# clang-format indents by four columns: a fourth level of control begins in column 17.
nesting() {
    sources | xargs awk '/^                +(} )?(if|for|while|do|switch|else)[ ({]/ {
        print FILENAME ":" FNR ": more than 3 levels deep" }'
}
# The first line of a file has its name and what it is for.
heads() {
    sources | xargs awk 'FNR == 1 {
        name = FILENAME
        sub(/.*\//, "", name)
        if (index($0, "/* " name " - ") != 1) print FILENAME ": does not begin with /* " name " - what it is for"
    }'
}
# Names that differ by an underscore only.
underscores() {
    git ls-files lib include integrators cli | grep '\.[ch]$\|\.inc$' | xargs cat | grep -o '[A-Za-z_][A-Za-z_0-9]*__*[A-Za-z0-9_]*' |
        sort -u | awk '{ if (/_$/) next; key = $0; gsub(/__+/, "_", key); if (key in first) print first[key] " and " $0; first[key] = $0 }'
}
# Two files with one comment have one thought: it is in one of them, or has one name.
twice() {
    git ls-files '*.[ch]' '*.inc' '*.sh' '*.awk' '*.py' '*.mk' Makefile .ci/run |
        xargs awk -v BLOCK=64 -f $here/blocks.awk
}
# Files and names that comments speak of.
comments() {
    find . -name build -prune -o -name .git -prune -o -type f -print >"$BUILD/files.txt"
    sources | xargs awk -f $here/comments.awk "$BUILD/files.txt"
}
cplusplus() {
    printf "#include <%s>\n" dalembert.h dalembert_analysis.h dalembert_codegen.h |
        clang -x c++ -std=c++11 -Wall -Wextra -Wpedantic -fsyntax-only -Iinclude -
}
# What a missing tool skips is counted, by needs or skips.
skipped() {
    find tests/cli -name '*_cases.sh' ! -name checks_cases.sh | sort |
        xargs grep -nE '^ *(el)?if (! )?(there|command -v) |echo .*skipped' | grep -v ' skips [0-9]' |
        sed 's/$/: use needs or skips/'
}
scripts() {
    for script in $(find tools tests .ci -name '*.sh' -o -path .ci/run); do
        case $(head -n 1 "$script") in
        *bash*) bash -n "$script" ;;
        *) sh -n "$script" ;;
        esac
    done
}
# What shellcheck warns of, except what these scripts mean: words are split and lists of files read without
# quotes, where no name has a blank (SC2038, SC2044, SC2046); parts of the command line have neither a first
# line nor variables that they do not share with run.sh (SC1090, SC2034, SC2148, SC2154); they write x= y= z,
# to files whose names are commands, too (SC1007, SC1010, SC2217, SC2238); variables go before a function
# (SC2097, SC2098); some shells have ulimit -v, and tests that need it look (SC3045).
shell() {
    find tools tests bench .ci -name '*.sh' -o -path .ci/run | sort >"$BUILD/scripts.txt"
    for dialect in sh bash; do
        while read -r script; do
            case $(head -n 1 "$script") in *bash*) echo bash ;; *) echo sh ;; esac | grep -qx $dialect && echo "$script"
        done <"$BUILD/scripts.txt" | xargs shellcheck --shell=$dialect --severity=warning --format=gcc \
            --exclude=SC1007,SC1010,SC1090,SC2034,SC2038,SC2044,SC2046,SC2097,SC2098,SC2148,SC2154,SC2217,SC2238,SC3045
    done
}

prefix() {
    objects | xargs nm -A -g --defined-only | awk '$NF !~ /^dal_/ { print $1 ": global " $NF }'
}
# Constant tables of addresses lie in .data.rel.ro; whatever else is not read-only is a variable.
globals() {
    objects | xargs objdump -t | awk -F '\t' '/file format/ { file = $1; sub(/:.*/, "", file) }
        NF == 2 {
            n = split($1, word, " ")
            split($2, symbol, " ")
            section = word[n]
            if (section !~ /^(\.(data|bss|tdata|tbss)|\*COM\*)/ || section ~ /^\.data\.rel\.ro/) next
            if (symbol[2] !~ /^\./) print file ": changeable " symbol[2]
        }'
}
calls() { objects | xargs nm -A -u | awk -v build="$BUILD/" -f $here/calls.awk $here/calls.txt -; }

# The program has its memory from cli/ui/memory.c, which ends it where there is none.
memory() {
    find "$BUILD/cli" -name '*.o' ! -name memory.o | sort | xargs nm -A -u |
        awk '$NF ~ /^((m|c|re)alloc|reallocarray|aligned_alloc|strn?dup|open_memstream|v?asprintf|getline)$/ {
            sub(/:.*/, "", $1); print $1 ": calls " $NF "; cli/ui/memory.c does so alone" }'
}

exported() { nm -D --defined-only "$BUILD/libdalembert.so" | awk '{ print $3 }' | sort; }
declared() {
    ctags -x --c-kinds=p --_xformat='%N' include/dalembert.h include/dalembert_[!k]*.h | grep -v '^dal__'
    sed -n 's/^INTEGRATOR(\(.*\),.*/dal_integrator_\1/p' integrators/integrators.def
}
exports() {
    exported >"$BUILD/exported.txt"
    declared | sort >"$BUILD/declared.txt"
    comm -3 "$BUILD/exported.txt" "$BUILD/declared.txt" |
        sed 's/^\t\(.*\)/\1 is declared but not exported/; t; s/$/ is exported but not declared/'
}

# Words that texts avoid.
words() {
    git ls-files | grep -v '^tests/cli/data/\|\.npy$\|^LICENSE$\|^tools/lint/words\|\.svg$\|\.png$' |
        xargs awk -f $here/words.awk $here/words.txt
}
# Each header compiles on its own, and declares what the file of its name defines.
alone() {
    for header in $(find include lib cli tests bench -name '*.h'); do
        case $header in
        cli/*) place=-Icli ;;
        lib/kernel/*) place="-Ilib -DDAL_LANES=1 -DDAL_GROUP=1" ;;
        *) place=-Ilib ;;
        esac
        ${CC:-cc} -std=c11 -D_POSIX_C_SOURCE=200809L -Iinclude $place -I"$BUILD/generated" \
            -fsyntax-only -Wno-unused -x c "$header" >/dev/null 2>&1 ||
            echo "$header: does not compile on its own"
    done
}
headers() {
    where=$BUILD/declared-where.txt
    find include lib cli -name '*.h' | xargs ctags -x --c-kinds=pv --_xformat='prototype %F %N %{line}' >"$where"
    find lib cli -name '*.c' | xargs ctags -x --c-kinds=f --_xformat='function %F %N %{line}' >>"$where"
    find lib cli -name '*.c' | xargs awk -f $here/headers.awk "$where"
}
# Directories depend on each other in one direction, as docs/dependencies.dot draws it; so do files.
dependencies() {
    sh $here/dependencies.sh >"$BUILD/dependencies.dot" || return 1
    cmp -s "$BUILD/dependencies.dot" docs/dependencies.dot ||
        echo "docs/dependencies.dot: run make references"
    sed -n 's/^ *"\(.*\)" -> "\(.*\)";/\1 \2/p' docs/dependencies.dot | sort >"$BUILD/dependencies.txt"
    sed -n 's/^<title>\(.*\)&#45;&gt;\(.*\)<\/title>/\1 \2/p' docs/gallery/dependencies.svg | sort |
        cmp -s - "$BUILD/dependencies.txt" ||
        echo "docs/gallery/dependencies.svg: run make references, with dot (graphviz)"
}
crowded() {
    find lib cli -name '*.c' | sed 's#/[^/]*$##' | sort | uniq -c |
        awk '$1 > 20 { print $2 ": " $1 " sources (20 at most)" }'
}
# What the static functions are: see functions.awk.  ONCE=lib/run lists those that are called once and
# have at most 8 lines there.
static_functions() { # REPORT
    find lib cli integrators -name '*.c' >"$BUILD/sources.txt"
    xargs ctags -x --c-kinds=f --_xformat='%F %{line} %{end} %N' <"$BUILD/sources.txt" >"$BUILD/ctags.txt"
    xargs awk -v report="$1" -v list="${ONCE-}" -v by="${BY-}" -f $here/functions.awk "$BUILD/ctags.txt" <"$BUILD/sources.txt"
}
names() { static_functions names; }
once() { static_functions once; }
table() { static_functions table; }

# Single checks by name: sh tools/lint/lint.sh words headers
if [ $# -gt 0 ]; then
    for single; do check "$single" $single; done
    exit $failed
fi
check "format" format
check "who may include what" includes
check "dependencies of directories and files" dependencies
check "lines and files" sizes
check "functions" functions
check "nesting" nesting
check "first lines of files" heads
check "names an underscore apart" underscores
check "words" words
check "headers compile on their own" alone
check "headers declare what their files define" headers
check "sources in a directory" crowded
check "names of static functions" names
check "static functions called once" once
check "names in comments" comments
check "the public header in C++" cplusplus
check "comments that two files have" twice
check "scripts" scripts
check "tests that are skipped" skipped
check "shellcheck" shell
check "symbol prefix" prefix
check "no changeable globals" globals
check "calls of the library" calls
check "memory of the program" memory
check "the shared library exports what the headers declare" exports
check "documents" sh $here/documents.sh "$BUILD/dalembert"
exit $failed
