#!/bin/sh
# cross.sh MAKE BUILD - builds the library, the program and the suites for aarch64 by Debian's compiler, and runs them
# under qemu-user: every method, every built-in system and SUITES.  States have the bits of BUILD.
# CC is the compiler of BUILD.  Libraries of arm64 are from mmdebstrap, in BUILD/cross/sysroot, which stays.
make=$1 here=$2 there=$2/cross
root=$(mktemp -d) || exit 1
trap 'rm -rf "$root"' EXIT
fail() { echo "cross: $*" >&2; exit 1; }
logged() { "$@" >"$root/log" 2>&1 || { cat "$root/log" >&2; fail "$* failed"; }; }
for tool in aarch64-linux-gnu-gcc qemu-aarch64 mmdebstrap; do
    command -v $tool >/dev/null || fail "no $tool: sh tools/prepare.sh cross"
done

sysroot=$there/sysroot
if ! [ -d "$sysroot" ]; then
    rm -rf "$sysroot.new"
    mkdir -p "$there"
    logged mmdebstrap -q --variant=extract --architecture=arm64 \
        --include=libc6-dev,libyaml-dev,libcunit1-dev,libmpfr-dev,libjansson-dev bookworm "$sysroot.new"
    mv "$sysroot.new" "$sysroot" || exit 1
fi
foreign="aarch64-linux-gnu-gcc --sysroot=$sysroot"
emulator="qemu-aarch64 -L $sysroot"
logged $make --no-print-directory BUILD="$there" CC="$foreign" CFLAGS='-O2 -g' \
    HOST_PROGRAM="$emulator $there/dalembert" all "$there/tests/suite"
! grep 'warning:' "$root/log" || fail "the compiler warns"

# Every method on a system of formulas.
every="-std=c11 -O1 -ffp-contract=off -Iinclude tests/cli/every_method.c"
logged ${CC:-cc} $CFLAGS $every "$here/libdalembert.a" -lyaml -lm -pthread -o "$root/here"
logged $foreign $every "$there/libdalembert.a" -lyaml -lm -pthread -o "$root/there"
"$root/here" >"$root/here.txt" || fail "every_method fails"
$emulator "$root/there" >"$root/there.txt" || fail "every_method fails on aarch64"
states=$(grep -c ' DAL_OK .*p' "$root/here.txt")
[ "$states" -ge 60 ] || fail "few methods run"
cmp "$root/here.txt" "$root/there.txt" || fail "a method has other bits on aarch64"
echo "cross: $states runs of all methods have the same bits"

# Every built-in system by the program.
systems=0
for system in systems/*.yaml; do
    system=$(basename "$system" .yaml)
    run="run $system --integrator gauss4 --step 0.01 --time 0.1 --samples 10 --native off"
    "$here/dalembert" $run >"$root/here.csv" 2>"$root/log"
    status=$?
    $emulator "$there/dalembert" $run >"$root/there.csv" 2>"$root/log"
    [ $? -eq $status ] || fail "$system: other exit status than $status: $(cat "$root/log")"
    cmp "$root/here.csv" "$root/there.csv" || fail "$system: other rows on aarch64"
    [ $status -ne 0 ] || systems=$((systems + 1))
done
[ $systems -ge 30 ] || fail "few systems run"
echo "cross: runs of $systems systems have the same rows"

# What suites compile is compiled for aarch64.
mkdir "$root/bin"
printf '#!/bin/sh\nexec aarch64-linux-gnu-gcc --sysroot=%s "$@"\n' "$(cd "$sysroot" && pwd)" >"$root/bin/cc"
chmod +x "$root/bin/cc"
export PATH="$root/bin:$PATH"
RUN_SUITE=$emulator BUILD=$there PROGRAM=$there/dalembert SUITE_OPTIONS='' sh tests/run.sh "$make" \
    $(for suite in $SUITES; do echo "suite-$suite"; done) || exit 1
echo "cross: ok"
