# The library for small targets, `make MINIMAL=1`: its size, what it lacks, and the bits of every method against the
# whole library, with all integrators and with three.

root=$here/../..
whole=$(dirname "$program")/libdalembert.a
compiler=${CC:-cc}
# makes VARIABLE...: with flags of its own, and by one process, as other parts run beside this one.
makes() { env -u CFLAGS -u MAKEFLAGS make -C "$root" -j1 MINIMAL=1 BUILD="$work/small" CC="$compiler" "$@" >log 2>err; }
# small LIBRARY VARIABLE...: makes it.
small() {
    library=$1
    shift
    expect "it is not made" makes "$@"
    refute "the compiler warns" grep -q 'warning:' err
    cp small/libdalembert.a "$library"
}
bytes() { size -t "$1" | awk 'END { print $1 + $2 }'; }
is_gcc_12() { case "$($compiler -dumpmachine) $($compiler -dumpversion)" in x86_64-*' 12'*) ;; *) false ;; esac; }
links() {
    $compiler -std=c11 -Wall -Wextra -Werror -O1 -ffp-contract=off -I"$root/include" "$@" -lm 2>err
}
# runs SOURCE PROGRAM FLAG...: links PROGRAM, which prints PROGRAM.txt.
runs() {
    source=$1 linked=$2
    shift 2
    expect "$linked is not linked" links "$root/$source" "$@" -o "$linked"
    "./$linked" >"$linked.txt"
    expect "$linked fails" [ $? -eq 0 ]
}
# What the headers of a small library declare.
declared() {
    for header in status system method model run; do
        ctags -x --c-kinds=p --_xformat=%N "$root/include/dalembert_$header.h"
    done | grep -v '^dal__\|_callback$\|_function$' | sort
}

compare_libraries() {
    case_is "the library for small targets"
    small all.a
    small three.a INTEGRATORS="rk4 gauss4+project"
    all=$(bytes all.a) three=$(bytes three.a)
    if is_gcc_12; then # other compilers take other sizes
        expect "$all bytes of text and data, not 300000 at most" [ "$all" -le 300000 ]
    else
        cannot 1 "another compiler than gcc 12 for x86-64"
    fi
    expect "three integrators take $three bytes, all of them $all" [ "$three" -lt $((all - 30000)) ]
    refute "gauss3 is an integrator" makes INTEGRATORS=gauss3
    says "^INTEGRATORS: 'gauss3' is not in integrators"

    case_is "what a small library lacks"
    if needs 1 "no ctags" there ctags; then
        declared >declared.txt
        nm all.a 2>/dev/null | awk '$2 == "T" { print $3 }' | sort >defined.txt
        comm -23 declared.txt defined.txt >lacking.txt
        printf 'dal_%s\n' builtin_name builtin_text model_builtin model_growth model_growth_of model_ranks model_read model_read_file \
            model_source model_tangent model_tangent_by >expected.txt
        expect "$(tr '\n' ' ' <lacking.txt)" cmp lacking.txt expected.txt
        counted
    fi

    case_is "the bits of a small library"
    for source in examples/small_target.c tests/cli/every_method.c; do
        stem=$(basename $source .c)
        runs $source $stem ${CFLAGS:-} "$whole" -lyaml -pthread
        for library in all three; do runs $source $stem-$library $library.a -Wl,--gc-sections; done
    done
    head -n -2 every_method.txt >expected.txt # the last lines are what a small library refuses
    expect "no holonomic constraints" grep -qx 'holonomic DAL_OK' every_method.txt
    grep -E '^(rk4|gauss4)[+ ]' expected.txt >expected-three.txt
    head -n -2 every_method-all.txt >all.txt
    head -n -2 every_method-three.txt >three.txt
    expect "few methods run" [ "$(grep -c ' DAL_OK .*p' expected.txt)" -ge 60 ]
    expect "a method has other bits" cmp all.txt expected.txt
    expect "one of three methods has other bits" cmp three.txt expected-three.txt
    for library in all three; do
        expect "the example has other bits" cmp small_target.txt small_target-$library.txt
        expect "quad precision is not refused" grep -qx 'rk4 DAL_UNSUPPORTED' every_method-$library.txt
        expect "holonomic constraints are not refused" grep -qx 'holonomic DAL_UNSUPPORTED' every_method-$library.txt
    done
    expect "the sleigh leaves its circle" awk '
        { x = $2 - sin($1); y = $3 - 1 + cos($1); if (x * x + y * y > 1e-18) exit 1 }
        END { exit NR != 10 }' small_target.txt
}

case_is "the library for small targets"
if sanitized; then
    cannot 32 "a library with sanitizers has other flags"
elif needs 32 "no compiler, make or library" eval 'there "$compiler" && there make && there size && [ -f "$whole" ]'; then
    compare_libraries
    counted
fi
