#!/bin/sh
# install.sh MAKE BUILD - installs into a temporary place, builds the examples against what is
# installed there and nothing else, and compares what they print with closed forms.
# CC and CFLAGS are those of the build.
make=$1 build=$2
cc=${CC:-cc}
root=$(mktemp -d) || exit 1
trap 'rm -rf "$root"' EXIT
fail() { echo "install: $*" >&2; exit 1; }

logged() { "$@" >"$root/log" 2>&1 || { cat "$root/log" >&2; fail "$* failed"; }; }

prefix=$root/usr
logged $make --no-print-directory BUILD="$build" PREFIX="$prefix" DESTDIR= install
PKG_CONFIG_PATH=$prefix/lib/pkgconfig
export PKG_CONFIG_PATH
[ "$(pkg-config --modversion dalembert)" = "$("$prefix/bin/dalembert" --version | sed 's/.* //')" ] ||
    fail "dalembert.pc and dalembert --version do not agree"

# Each example against the shared and against the static library.
for name in embed by_hand own_integrator contact_chain isokinetic_fluid; do
    flags="-std=c11 -Wall -Wextra -Werror -Wno-psabi -ffp-contract=off $CFLAGS examples/$name.c"
    logged $cc $flags $(pkg-config --cflags --libs dalembert) -lm -o "$root/$name"
    logged $cc $flags $(pkg-config --cflags dalembert) "$prefix/lib/libdalembert.a" \
        $(pkg-config --libs yaml-0.1) -lm -o "$root/$name-static"
    LD_LIBRARY_PATH=$prefix/lib "$root/$name" >"$root/$name.txt" || fail "$name failed"
    "$root/$name-static" >"$root/$name-static.txt" || fail "$name-static failed"
    cmp "$root/$name.txt" "$root/$name-static.txt" || fail "$name: shared and static differ"
done

# The lines of C that documents show.
for document in README.md docs/embedding.md; do
    {
        echo '#include <dalembert.h>'
        echo 'int main(void) {'
        sed -n '/^    dal_model \*model;$/,/^$/p' $document
        echo 'dal_run_free(run); dal_model_free(model); return !q; }'
    } >"$root/shown.c"
    logged $cc -std=c11 $CFLAGS "$root/shown.c" $(pkg-config --cflags --libs dalembert) -o "$root/shown"
    LD_LIBRARY_PATH=$prefix/lib "$root/shown" || fail "the lines of $document fail"
done
sed -n '/^\/\* heun.c/,/^```$/p' docs/design.md | sed '$d' >"$root/heun.c"
logged $cc -std=c11 -Wall -Wextra -Werror -Wno-psabi $CFLAGS $(pkg-config --cflags dalembert) -c "$root/heun.c" \
    -o "$root/heun.o"
logged nm "$root/heun.o"
grep -q dal_integrator_heun "$root/log" || fail "the integrator of docs/design.md defines no descriptor"

# A generated file needs no library at all.
logged "$prefix/bin/dalembert" generate chaplygin-sleigh --integrator gauss4+project \
    --prefix sleigh -o "$root/sleigh.c"
logged $cc -std=c11 -Wall -Wextra -Wpedantic -Werror -Wno-psabi $CFLAGS -I"$root" \
    examples/generated.c -lm -o "$root/generated"
"$root/generated" >"$root/generated.txt" || fail "generated failed"

near='function near(a, b, tolerance) { d = a - b; if (d < 0) d = -d; if (!(d <= tolerance)) {
    print FILENAME ": line " FNR ": " a " should be " b; bad = 1 } }
    END { exit bad || NR != rows }'
# Chaplygin's sleigh moves in a circle: y1 = sin t, y2 = 1 - cos t, phi = t.  gauss4 errs by
# t h^4/4320 and less here; the projection holds D at rounding.
awk "$near"' { near($1, FNR, 1e-12); near($2, sin($1), 1e-10); near($3, 1 - cos($1), 1e-10)
    near($4, $1, 1e-12); near($5, cos($1), 1e-10); near($6, sin($1), 1e-10); near($7, 1, 1e-12)
    near($8, 0, 1e-14) }' rows=10 "$root/embed.txt" || fail "embed is wrong"
awk "$near"' { near($1, FNR, 1e-12); near($2, sin($1), 1e-10); near($3, 1 - cos($1), 1e-10)
    near($4, $1, 1e-12); near($5, 0, 1e-14) }' rows=10 "$root/generated.txt" ||
    fail "generated is wrong"
# The guided oscillator: x = c + (1 - c) cos t + 2 sin t, c = k^2/(1 + k^2), y = k (x - 1).
awk "$near"' { x = 0.2 + 0.8 * cos(10) + 2 * sin(10); near($1, 10, 1e-12); near($2, x, 1e-7)
    near($3, (x - 1) / 2, 1e-7); near($4, 0, 1e-13) }' rows=1 "$root/by_hand.txt" || fail "by_hand is wrong"
# Heun's method: second order, h = 0.01, so wrong by some 1e-5, and not by 1e-4 or 1e-7.
awk "$near"' { near($2, sin(1), 1e-4); near($3, 1 - cos(1), 1e-4); near($4, 1, 1e-12)
    d = $2 - sin(1); if (d < 0) d = -d; if (d < 1e-7) bad = 1 }' rows=1 "$root/own_integrator.txt" ||
    fail "own_integrator is wrong"

# The program finds its built-in systems wherever it stands, and reads the installed files.
"$prefix/bin/dalembert" check "$prefix/share/dalembert/systems/chaplygin-sleigh.yaml" \
    >/dev/null || fail "the installed system file does not pass its check"
manual=$prefix/share/man/man1/dalembert.1
grep -q '^\.SS run$' "$manual" && grep -q '^\.SH EXAMPLES$' "$manual" || fail "no man page of all commands"
! grep -q '@' "$manual" || fail "a part of the man page is not filled in"
bash -n "$prefix/share/bash-completion/completions/dalembert" || fail "no completion for bash"
# Before 1.0 the soname has the minor version: libdalembert.so.0.3 of 0.3.0.
soname=libdalembert.so.$("$prefix/bin/dalembert" --version | sed 's/.* //; s/\.[0-9]*$//')
[ "$(readlink "$prefix/lib/libdalembert.so")" = "$soname" ] || fail "no link to $soname"
objdump -p "$prefix/lib/$soname" | grep -q "SONAME *$soname\$" || fail "the soname is not $soname"

# DESTDIR, with a space; uninstall leaves no file.
logged $make --no-print-directory BUILD="$build" PREFIX=/opt/dal DESTDIR="$root/a b" install
[ -x "$root/a b/opt/dal/bin/dalembert" ] || fail "DESTDIR does not work"
grep -q "^prefix=/opt/dal$" "$root/a b/opt/dal/lib/pkgconfig/dalembert.pc" ||
    fail "dalembert.pc knows DESTDIR"
logged $make --no-print-directory BUILD="$build" PREFIX=/opt/dal DESTDIR="$root/a b" uninstall
[ -z "$(find "$root/a b" -type f -o -type l)" ] || fail "uninstall leaves files"
echo "install: ok"
