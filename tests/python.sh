#!/bin/sh
# python.sh MAKE BUILD - installs the package of python/ into an environment of its own, with the library of
# BUILD, with an installed one, and as a wheel made from a source distribution; runs its tests and what
# docs/python.md shows, and executes the notebooks.  CC and CFLAGS are as in the build.  With BRIEFLY=1 it ends
# after the tests of the package.
# Where CI is true it fails without Python and what the tests need.
# make gets BUILD as it was given: a path that begins with the tree's has the blanks of that.
make=$1 given=$2 build=$(realpath "$2") || exit 1
fail() { echo "python: $*" >&2; exit 1; }
skip() { echo "python: $(cat python/tests/*.py | grep -c '^ *def test_') tests are skipped: $*"; }

case $CFLAGS in *-fsanitize*) skip "Python itself has no sanitizers" && exit 0 ;; esac
usable='import os, sysconfig, cffi, ensurepip, numpy, pytest, setuptools, venv
from importlib.util import find_spec
assert find_spec("wheel") or find_spec("setuptools.command.bdist_wheel")
assert os.path.exists(sysconfig.get_path("include") + "/Python.h")'
for python in ${PYTHON:-python3 /usr/bin/python3} none; do
    $python -c "$usable" 2>/dev/null && break
done
if [ "$python" = none ]; then
    skip "no python3 with cffi, numpy, pytest, setuptools, wheel, venv and Python.h"
    [ "${CI:-}" != true ]
    exit
fi

root=$(mktemp -d) || exit 1
trap 'rm -rf "$root"' EXIT
logged() { "$@" >"$root/log" 2>&1 || { cat "$root/log" >&2; fail "$* failed"; }; }
HOME=$root PYTHONDONTWRITEBYTECODE=1 PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_NO_INDEX=1
DALEMBERT_PROGRAM=$build/dalembert
export HOME PYTHONDONTWRITEBYTECODE PIP_DISABLE_PIP_VERSION_CHECK PIP_NO_INDEX DALEMBERT_PROGRAM
unset PYTHONPATH DALEMBERT_BUILD DALEMBERT_PREFIX

logged $python -m venv --system-site-packages "$root/V"
package=$("$root/V/bin/python" -c 'import sysconfig; print(sysconfig.get_path("platlib"))')
logged env DALEMBERT_BUILD="$build" "$root/V/bin/pip" install --no-build-isolation --no-deps ./python
# A call that is not interrupted where it must be would never end.
(cd python/tests && timeout --foreground 1200 "$root/V/bin/python" -m pytest -q -p no:cacheprovider . ../../docs/python.md \
    --doctest-glob='*.md' --doctest-modules --pyargs dalembert) >"$root/tests" 2>&1 ||
    { cat "$root/tests" >&2; fail "tests failed"; }

ends() { tail -n 1 "$root/tests" | sed 's/^/python: /' && echo "python: ok"; }
[ -z "${BRIEFLY:-}" ] || { ends; exit; }

# The installed library, a shared one, wherever it is.
logged $make --no-print-directory BUILD="$given" PREFIX="$root/usr" DESTDIR= install
logged env DALEMBERT_PREFIX="$root/usr" "$root/V/bin/pip" install --no-build-isolation --no-deps \
    --target "$root/installed" ./python
ldd "$root"/installed/dalembert/_library.*.so | grep -q "=> $root/usr/lib" ||
    fail "the installed library is not used"
[ "$(PYTHONPATH=$root/installed "$root/V/bin/python" -c 'import dalembert; print(dalembert.__version__)')" = \
    "$("$build/dalembert" --version | sed 's/.* //')" ] || fail "the package has another version"
for variable in DALEMBERT_BUILD DALEMBERT_PREFIX; do
    env $variable="$root/none" "$root/V/bin/pip" install --no-build-isolation --no-deps ./python \
        >"$root/log" 2>&1 && fail "$variable=none is accepted"
    grep -q "dalembert: no [a-z.]* [a-z]* $root/none: run make" "$root/log" || fail "$variable=none: no reason"
done

# A source distribution, made where no library is, and a wheel from it: one that has the library, here with
# the fewest variants, and moves with the same bits.
tree="$root/a tree"
mkdir -p "$tree/bench" "$tree/cli/report" && cp -R Makefile LICENSE include integrators lib python systems tools "$tree" &&
    cp bench/bench.mk "$tree/bench" && cp cli/report/report_body.[ch] "$tree/cli/report" || fail "no copy of the sources"
(cd "$tree/python" && logged env PYTHONPATH=. "$root/V/bin/python" -c \
    'import sys, backend; backend.build_sdist(sys.argv[1])' "$root/made") || exit 1
rm -rf "$tree"
logged env CFLAGS=-O0 MAKEFLAGS='VARIANTS=x1\ x1_QUAD' "$root/V/bin/pip" wheel --no-build-isolation --no-deps \
    --wheel-dir "$root/made" "$root"/made/dalembert-*.tar.gz
logged "$root/V/bin/pip" install --no-deps --target "$root/wheel" "$root"/made/dalembert-*.whl
! ldd "$root"/wheel/dalembert/_library.*.so | grep libdalembert || fail "the wheel has no library"
moved() { # DIRECTORY: the state of a run by the package there, exactly
    (cd "$root" && PYTHONPATH=$1 "$root/V/bin/python" -c 'import dalembert
assert dalembert.__file__.startswith("'"$1"'"), dalembert.__file__
run = dalembert.Run("chaplygin-sleigh", "gauss4+project", step=0.01)
run.advance(1000)
print(dalembert.__version__, *map(float.hex, map(float, run.state)))')
}
[ -n "$(moved "$package")" ] && [ "$(moved "$root/wheel")" = "$(moved "$package")" ] || fail "the wheel moves differently"

# What an environment lacks that has nothing but pip.
logged $python -m venv "$root/bare"
"$root/bare/bin/pip" install --no-build-isolation --no-deps ./python >"$root/log" 2>&1 &&
    fail "nothing is missing in an empty environment"
grep -q 'dalembert: missing to build it: .*cffi: pip installs them' "$root/log" ||
    { cat "$root/log" >&2; fail "an empty environment: no reason"; }

# The kernel of the notebooks may be any python3.
if "$root/V/bin/python" -c 'import nbclient, ipykernel, matplotlib' 2>/dev/null; then
    printf '%s\n' python/examples/*.ipynb | PYTHONPATH=$package xargs -n 5 -P 2 "$root/V/bin/python" tools/notebooks.py \
        >"$root/log" 2>&1 || { cat "$root/log" >&2; fail "notebooks failed"; }
else
    echo "python: $(printf '%s\n' python/examples/*.ipynb | grep -c .) notebooks are skipped: no nbclient, ipykernel and matplotlib"
    [ "${CI:-}" != true ] || fail "skipped though CI is true"
fi
left=$(git ls-files --others --exclude-standard python 2>/dev/null)
[ -z "$left" ] || fail "files are left in the sources: $left"
ends
