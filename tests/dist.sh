#!/bin/sh
# dist.sh MAKE BUILD - makes the tarball of the last commit, here and in a clone, which gives the same
# bytes; elsewhere, in a directory whose name has a blank, and without git it builds, passes a part of its
# tests and installs.
# CC and CFLAGS are as in its build.
make="$1 --no-print-directory" build=$2
top=$(mktemp -d) || exit 1
root="$top/of a user"
trap 'rm -rf "$top"' EXIT
mkdir "$root" || exit 1
fail() { echo "dist: $*" >&2; exit 1; }
logged() { "$@" >"$root/log" 2>&1 || { cat "$root/log" >&2; fail "$* failed"; }; }

# A repository of another user is one that git refuses to read.
printf '[safe]\n\tdirectory = *\n' >"$root/gitconfig"
GIT_CONFIG_GLOBAL=$root/gitconfig
export GIT_CONFIG_GLOBAL
git rev-parse -q --verify HEAD >"$root/log" 2>&1 || {
    echo "dist: skipped: no repository of git"
    [ "${CI:-}" != true ]
    exit
}
logged $make BUILD="$build" dist
logged git clone -q . "$root/clone"
(umask 077 && cd "$root/clone" && TZ=Asia/Tokyo logged $make BUILD=elsewhere dist) || exit 1
cmp "$build"/dalembert-*.tar.gz "$root"/clone/elsewhere/dalembert-*.tar.gz || fail "two tarballs differ"

mkdir "$root/bin"
printf '#!/bin/sh\necho git is called >&2\nexit 127\n' >"$root/bin/git"
chmod +x "$root/bin/git"
PATH=$root/bin:$PATH
tar -xzf "$build"/dalembert-*.tar.gz -C "$root" || fail "the tarball cannot be unpacked"
cd "$root"/dalembert-[0-9]* || fail "it has no directory of its name"
make="$make BUILD=build"
logged $make CC="$CC" CFLAGS="$CFLAGS"
! grep -q 'git is called' "$root/log" || fail "the build calls git"
logged env CC="$CC" CFLAGS="$CFLAGS" BRIEFLY=1 BUILD=build PROGRAM=build/dalembert \
    sh tests/run.sh "$1" cli-usage cli-check install python
logged $make CC="$CC" CFLAGS="$CFLAGS" PREFIX=/usr DESTDIR="$root/stage" install
logged "$root/stage/usr/bin/dalembert" check "$root/stage/usr/share/dalembert/systems/knife-edge.yaml"
logged $make PREFIX=/usr DESTDIR="$root/stage" uninstall
[ -z "$(find "$root/stage" ! -type d)" ] || fail "uninstall leaves files"
echo "dist: ok"
