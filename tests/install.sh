#!/bin/sh
# install.sh MAKE BUILD - installs into a temporary place, builds the examples against what is
# installed there and nothing else, and compares what they print with closed forms.
# CC and CFLAGS are as in the build.
make=$1 build=$2
cc=${CC:-cc}
root=$(mktemp -d) || exit 1
trap 'rm -rf "$root"' EXIT
fail() { echo "install: $*" >&2; exit 1; }

logged() { "$@" >"$root/log" 2>&1 || { cat "$root/log" >&2; fail "$* failed"; }; }
installing() { logged $make --no-print-directory BUILD="$build" CC="$cc" CFLAGS="$CFLAGS" "$@"; }
# Directories that a packager gave to make do not count here.
unset BINDIR LIBDIR INCLUDEDIR DATADIR MANDIR DOCDIR
MAKEFLAGS=${MAKEFLAGS%% -- *}

# The libraries where Debian has them.
prefix=$root/usr
lib=$prefix/lib/x86_64-linux-gnu
installing PREFIX="$prefix" LIBDIR="$lib" DESTDIR= install
PKG_CONFIG_PATH=$lib/pkgconfig
export PKG_CONFIG_PATH
[ "$(pkg-config --modversion dalembert)" = "$("$prefix/bin/dalembert" --version | sed 's/.* //')" ] ||
    fail "dalembert.pc and dalembert --version do not agree"

# Each example against the shared and against the static library.
for name in embed by_hand small_target own_integrator path_following contact_chain isokinetic_fluid kalman; do
    flags="-std=c11 -Wall -Wextra -Werror -Wno-psabi -ffp-contract=off $CFLAGS examples/$name.c"
    logged $cc $flags $(pkg-config --cflags --libs dalembert) -o "$root/$name"
    logged $cc $flags $(pkg-config --static --cflags --libs dalembert | sed 's/-ldalembert/-l:libdalembert.a/') \
        -o "$root/$name-static"
    LD_LIBRARY_PATH=$lib "$root/$name" >"$root/$name.txt" || fail "$name failed"
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
    LD_LIBRARY_PATH=$lib "$root/shown" || fail "the lines of $document fail"
done
logged $cc -std=c11 -Wall -Wextra -Werror -Wno-psabi $CFLAGS $(pkg-config --cflags dalembert) -c examples/heun.c \
    -o "$root/heun.o"
logged nm "$root/heun.o"
grep -q dal_integrator_heun "$root/log" || fail "examples/heun.c defines no descriptor"

# From C++ the headers have no warnings, and the kernel's has none from C++17 on.
cxx=${CXX:-c++}
if command -v "${cxx%% *}" >/dev/null; then
    for source in 'c++11 dalembert_analysis dalembert_codegen dalembert' 'c++17 dalembert_kernel'; do
        printf '#include <%s.h>\n' ${source#* } >"$root/headers.cpp"
        logged $cxx -std=${source%% *} -Wall -Wextra -Wpedantic -Werror -Wno-psabi \
            $(pkg-config --cflags dalembert) -fsyntax-only "$root/headers.cpp"
    done
else
    echo "install: 4 headers are not tried in C++: no $cxx"
    [ "${CI:-}" != true ] || fail "skipped though CI is true"
fi

# The examples by CMake: with the shared library, then, from a copy of the installation, with the
# static one; each variant gives the numbers of embed.  Other minor versions are refused.
cmake_examples() { # PREFIX LIBRARY
    CC=$cc CXX=$cxx CFLAGS="-Wall -Wextra -Werror -Wno-psabi -ffp-contract=off $CFLAGS" CXXFLAGS=$CFLAGS logged \
        cmake -S "$1/share/doc/dalembert/examples" -B "$root/$2" -DCMAKE_PREFIX_PATH="$1" -DLIBRARY=dalembert::$2
    logged cmake --build "$root/$2"
    for name in embed embed_cpp; do
        "$root/$2/$name" | cmp - "$root/embed.txt" || fail "cmake, dalembert::$2: $name differs"
    done
}
if command -v cmake >/dev/null && command -v "${cxx%% *}" >/dev/null; then
    moved="$root/moved there"
    cp -a "$prefix" "$moved"
    cmake_examples "$prefix" dalembert
    ldd "$root/dalembert/embed" | grep -q "$lib/libdalembert" || fail "cmake: embed has not the shared library"
    mv "$prefix" "$prefix.away"
    cmake_examples "$moved" static
    mv "$prefix.away" "$prefix"
    ! ldd "$root/static/embed" | grep libdalembert || fail "cmake: dalembert::static is shared"
    mkdir "$root/find"
    cat >"$root/find/CMakeLists.txt" <<'LISTS'
cmake_minimum_required(VERSION 3.10)
project(find C)
foreach(version 0.2 ${MINOR} ${MINOR}.0 ${MINOR}.99 0.99 1.0)
    unset(dalembert_DIR CACHE)
    find_package(dalembert ${version})
    if(dalembert_FOUND)
        message(STATUS "found ${version}")
    endif()
endforeach()
LISTS
    minor=$(pkg-config --modversion dalembert | sed 's/\.[0-9]*$//')
    logged cmake -S "$root/find" -B "$root/found" -DCMAKE_PREFIX_PATH="$prefix" -DMINOR=$minor
    [ "$(sed -n 's/^-- found //p' "$root/log" | tr '\n' ' ')" = "$minor $minor.0 " ] ||
        fail "cmake takes this for another version, or not for its own: $(cat "$root/log")"
else
    echo "install: 7 checks of CMake are skipped: no cmake, or no $cxx"
    [ "${CI:-}" != true ] || fail "skipped though CI is true"
fi

# A generated file needs no library at all.
logged "$prefix/bin/dalembert" generate chaplygin-sleigh --integrator gauss4+project \
    --prefix sleigh --with field -o "$root/sleigh.c"
for name in generated measured_state; do
    logged $cc -std=c11 -Wall -Wextra -Wpedantic -Werror -Wno-psabi $CFLAGS -I"$root" \
        examples/$name.c -lm -o "$root/$name"
    "$root/$name" >"$root/$name.txt" || fail "$name failed"
done

near='function near(a, b, tolerance) { d = a - b; if (d < 0) d = -d; if (!(d <= tolerance)) {
    print FILENAME ": line " FNR ": " a " should be " b; bad = 1 } }
    END { exit bad || NR != rows }'
# Chaplygin's sleigh moves in a circle: y1 = sin t, y2 = 1 - cos t, phi = t.  gauss4 errs by
# t h^4/4320 and less here; the projection holds D at rounding.
awk "$near"' { near($1, FNR, 1e-12); near($2, sin($1), 1e-10); near($3, 1 - cos($1), 1e-10)
    near($4, $1, 1e-12); near($5, cos($1), 1e-10); near($6, sin($1), 1e-10); near($7, 1, 1e-12)
    near($8, 0, 1e-14) }' rows=10 "$root/embed.txt" || fail "embed is wrong"
cmp "$root/embed.txt" "$root/small_target.txt" || fail "small_target differs from embed"
awk "$near"' { near($1, FNR, 1e-12); near($2, sin($1), 1e-10); near($3, 1 - cos($1), 1e-10)
    near($4, $1, 1e-12); near($5, 0, 1e-14) }' rows=10 "$root/generated.txt" ||
    fail "generated is wrong"
# The same 0.2 later, where the acceleration to the left is v0 omega = 1.
awk "$near"' { t = FNR + 0.2; near($2, sin(t), 1e-10); near($3, 1 - cos(t), 1e-10); near($4, t, 1e-12)
    near($5, 1, 1e-10) }' rows=10 "$root/measured_state.txt" || fail "measured_state is wrong"
# The guided oscillator: x = c + (1 - c) cos t + 2 sin t, c = k^2/(1 + k^2), y = k (x - 1).
awk "$near"' { x = 0.2 + 0.8 * cos(10) + 2 * sin(10); near($1, 10, 1e-12); near($2, x, 1e-7)
    near($3, (x - 1) / 2, 1e-7); near($4, 0, 1e-13) }' rows=1 "$root/by_hand.txt" || fail "by_hand is wrong"
# Heun's method: second order, h = 0.01, so wrong by some 1e-5, and not by 1e-4 or 1e-7.
awk "$near"' { near($2, sin(1), 1e-4); near($3, 1 - cos(1), 1e-4); near($4, 1, 1e-12)
    d = $2 - sin(1); if (d < 0) d = -d; if (d < 1e-7) bad = 1 }' rows=1 "$root/own_integrator.txt" ||
    fail "own_integrator is wrong"
# The robot by its two equations without a constraint, v' = F/m and w' = M/I, in steps of 1 ms.
awk "$near"'
    function rates(s) { k[1] = s[4] * cos(s[3]); k[2] = s[4] * sin(s[3]); k[3] = s[5]; k[4] = dv; k[5] = dw }
    function part(h, i) { for (i = 1; i <= 5; i++) { sum[i] += h * k[i] } }
    function move(h, i) { for (i = 1; i <= 5; i++) state[i] = start[i] + h * k[i] }
    function advance(h, i) {
        for (i = 1; i <= 5; i++) { start[i] = state[i]; sum[i] = 0 }
        rates(state); part(h / 6); move(h / 2); rates(state); part(h / 3); move(h / 2)
        rates(state); part(h / 3); move(h); rates(state); part(h / 6)
        for (i = 1; i <= 5; i++) state[i] = start[i] + sum[i]
    }
    function control(t, c, s, v, w, x, y) {
        c = cos(state[3]); s = sin(state[3]); v = state[4]; w = state[5]; t *= 0.3
        ex = 2 * sin(t) - state[1] - c / 2; ey = sin(2 * t) - state[2] - s / 2
        x = -0.18 * sin(t) + 10 * (0.6 * cos(t) - v * c + w * s / 2) + 25 * ex
        y = -0.36 * sin(2 * t) + 10 * (0.6 * cos(2 * t) - v * s - w * c / 2) + 25 * ey
        dv = x * c + y * s + w * w / 2; dw = 2 * (y * c - x * s - v * w); e = sqrt(ex * ex + ey * ey)
    }
    BEGIN { state[1] = state[2] = -sqrt(1 / 8); state[3] = atan2(1, 1); state[4] = 0.6 * sqrt(2); state[5] = 0 }
    $1 == "max" { near($2, largest, 1e-11); if (!($2 <= $4 && $4 < 1e-3)) bad = 1; next }
    { for (i = FNR > 1 ? 0 : 999; i < 1000; i++) {
          if (FNR > 1) advance(0.001)
          control(FNR > 1 ? FNR - 2 + (i + 1) / 1000 : 0)
          if (e > largest) largest = e
      }
      near($1, FNR - 1, 1e-9); near($2, state[1], 1e-9); near($3, state[2], 1e-9); near($4, e, 1e-10)
      near($5, 0, 1e-15) }' rows=23 "$root/path_following.txt" || fail "path_following is wrong"

# The filter begins 0.5 beside the circle phi = t, (y1', y2') = (cos t, sin t); from t = 10 on its heading
# errs by at most 3 of its standard deviations, which is below 0.05, as far as a position errs.
awk "$near"' { near($1, 2 * FNR, 1e-12); near(FNR < 5 ? 0 : $2 - $1, 0, 3 * $6); near($6 < 0.05 || FNR < 2, 1, 0)
    near($3, cos($1), FNR < 5 ? 1 : 0.1); near($4, sin($1), FNR < 5 ? 1 : 0.1); near($5, 1, FNR < 5 ? 1 : 0.05) }' \
    rows=10 "$root/kalman.txt" || fail "kalman is wrong"

# The program finds its built-in systems wherever it is, and reads the installed files.
"$prefix/bin/dalembert" check "$prefix/share/dalembert/systems/chaplygin-sleigh.yaml" \
    >/dev/null || fail "the installed system file does not pass its check"
manual=$prefix/share/man/man1/dalembert.1
grep -q '^\.SS run$' "$manual" && grep -q '^\.SH EXAMPLES$' "$manual" || fail "no man page of all commands"
! grep -q '@' "$manual" || fail "a part of the man page is not filled in"
bash -n "$prefix/share/bash-completion/completions/dalembert.bash" || fail "no completion for bash"
# Before 1.0 the soname has the minor version: libdalembert.so.0.5 of 0.5.0.
soname=libdalembert.so.$("$prefix/bin/dalembert" --version | sed 's/.* //; s/\.[0-9]*$//')
[ "$(readlink "$lib/libdalembert.so")" = "$soname" ] || fail "no link to $soname"
objdump -p "$lib/$soname" | grep -q "SONAME *$soname\$" || fail "the soname is not $soname"

# All that the tree has of a kind is installed.
copies() { # DIRECTORY FILE...
    directory=$prefix/share/$1
    shift
    for file; do cmp "$file" "$directory/${file##*/}" || fail "$file is not installed"; done
}
copies dalembert/systems systems/*
copies dalembert/studies bench/studies/*
copies doc/dalembert README.md LICENSE
copies doc/dalembert/docs docs/*.md
copies doc/dalembert/docs/gallery docs/gallery/*
copies doc/dalembert/examples examples/*
for header in include/*.h; do
    case $header in
    include/dalembert_program.h) [ ! -e "$prefix/$header" ] || fail "$header is only the program's" ;;
    *) [ -f "$prefix/$header" ] || fail "$header is not installed" ;;
    esac
done
! grep '#include "' "$prefix/include/dalembert_kernel.h" || fail "dalembert_kernel.h includes files of the tree"

# DESTDIR, with a space.  What is not of the installation stays when it is removed, all else goes.
staged() { installing PREFIX=/opt/dal DESTDIR="$root/a b" "$@"; }
mkdir -p "$root/a b/opt/dal/lib" "$root/a b/opt/dal/share/dalembert"
touch "$root/a b/opt/dal/lib/libother.so" "$root/a b/opt/dal/share/dalembert/mine.yaml"
find "$root/a b" | sort >"$root/before"
staged install
[ -x "$root/a b/opt/dal/bin/dalembert" ] || fail "DESTDIR does not work"
! grep -r "$root" "$root/a b" --include='*.pc' --include='*.cmake' || fail "a file knows DESTDIR"
grep -q "^prefix=/opt/dal$" "$root/a b/opt/dal/lib/pkgconfig/dalembert.pc" || fail "dalembert.pc has another prefix"
staged uninstall
find "$root/a b" | sort | diff "$root/before" - || fail "uninstall leaves or takes other files"
echo "install: ok"
