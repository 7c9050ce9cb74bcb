#!/bin/sh
# packages.sh MAKE BUILD - makes the packages of debian/ from the tarball of the last commit, checks them by lintian,
# and installs them in a new Debian by mmdebstrap, where a user without privileges uses all four; then
# removes them.
make=$1 build=$2
root=$(mktemp -d) || exit 1
chmod 755 "$root"
trap 'rm -rf "$root"' EXIT
fail() { echo "packages: $*" >&2; exit 1; }
logged() { "$@" >"$root/log" 2>&1 || { cat "$root/log" >&2; fail "$* failed"; }; }
for tool in dpkg-buildpackage dh pybuild lintian mmdebstrap; do
    command -v $tool >/dev/null || fail "no $tool: sh tools/prepare.sh packages"
done

logged $make --no-print-directory BUILD="$build" dist
tar -xzf "$build"/dalembert-*.tar.gz -C "$root" || fail "the tarball cannot be unpacked"
cd "$root"/dalembert-[0-9]* || fail "it has no directory of its name"
version=${PWD##*-}
[ "$(dpkg-parsechangelog -S Version)" = "$version" ] || fail "debian/changelog is not of version $version"
# The PATH may begin with another Python or compiler.
ccache=
[ ! -d /usr/lib/ccache ] || ccache=/usr/lib/ccache:
logged env -u MAKEFLAGS -u MAKELEVEL -u CC -u CFLAGS PATH="$ccache/usr/sbin:/usr/bin:/sbin:/bin" \
    DEB_BUILD_OPTIONS="parallel=$(nproc) $DEB_BUILD_OPTIONS" dpkg-buildpackage -us -uc
cd ..
[ "$(dpkg-deb -f libdalembert0.5_*.deb Version)" = "$version" ] || fail "the library has another version"
logged lintian --allow-root --fail-on error,warning ./*.changes

# In the new system: as nobody, in /tmp.  Chaplygin's sleigh moves in a circle: at t = 1 y1 = sin 1, y2 = 1 - cos 1,
# v1 = cos 1, v2 = sin 1; gauss4 with steps of 0.01 errs by some 1e-12.
cat >use.sh <<'USE'
set -e
cd "$(mktemp -d)"
export HOME="$PWD" # for compiled steps
near() { # FILE FIELD VALUE: its last line has VALUE in FIELD
    tail -n 1 "$1" | tr ',' ' ' | awk -v i="$2" -v x="$3" '{ d = $i - x; if (d * d > 1e-18) { print $i " is not " x; exit 1 } }'
}
circle() { near "$1" 2 0.841470984807897 && near "$1" 3 0.459697694131860; }

dalembert run chaplygin-sleigh --integrator gauss4+project --step 0.01 --time 1 --samples 1 >rows.csv
circle rows.csv
dalembert check /usr/share/dalembert/systems/knife-edge.yaml >/dev/null
dalembert run chaplygin-sleigh --native on --integrator gauss4+project --step 0.01 --time 1 --samples 1 2>err | cmp - rows.csv
test ! -s err # it would state that steps are interpreted
bash -n /usr/share/bash-completion/completions/dalembert.bash
test -s /usr/share/man/man1/dalembert.1.gz

cp -r /usr/share/doc/libdalembert-dev/examples .
cc -ffp-contract=off examples/embed.c $(pkg-config --cflags --libs dalembert) -o embed
cc -ffp-contract=off -static examples/embed.c $(pkg-config --static --cflags --libs dalembert) -o embed-static
ldd embed | grep '/libdalembert\.so\.0\.5 '
./embed >embed.txt
./embed-static | cmp - embed.txt
awk '{ d = $2 - sin($1); if (d * d > 1e-18) exit 1; rows++ } END { exit rows != 10 }' embed.txt
cc examples/own_integrator.c $(pkg-config --cflags --libs dalembert) -o own_integrator
./own_integrator >/dev/null

python3 -c '
import dalembert
run = dalembert.Run("chaplygin-sleigh", "gauss4+project", step=0.01)
run.advance(100)
print(run.time, *map(repr, map(float, run.state)))' >python.txt
circle python.txt
ldd /usr/lib/python3/dist-packages/dalembert/_library.*.so | grep '/libdalembert\.so\.0\.5 '
USE
# The two files that name it: the suite, and where packages come from here.
suite=$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)
sources=$(find /etc/apt/sources.list /etc/apt/sources.list.d/debian.sources 2>/dev/null | head -n 1)
rm -f ./*-dbgsym_*.deb
named='libdalembert0.5 libdalembert-dev dalembert python3-dalembert'
cat >install.sh <<INSTALL
set -e
export DEBIAN_FRONTEND=noninteractive
apt-get install -y --no-install-recommends /packages/*.deb >/dev/null
apt-get install -y --no-install-recommends gcc libc6-dev pkg-config >/dev/null
runuser -u nobody -- sh /packages/use.sh
apt-get purge -y $named >/dev/null
left=\$(find / -xdev ! -path '/packages*' ! -path '/tmp/*' ! -path '/proc/*' -name '*dalembert*')
[ -z "\$left" ] || { echo "purging leaves \$left"; exit 1; }
INSTALL
mkdir packages && cp ./*.deb use.sh install.sh packages || fail "no copy of the packages"
logged mmdebstrap --variant=apt --customize-hook="copy-in packages /" \
    --customize-hook='chroot "$1" sh /packages/install.sh' "$suite" /dev/null "$sources"
for package in $named; do
    [ -e "$root/packages/${package}_${version}_$(dpkg --print-architecture).deb" ] || fail "no package $package"
done
echo "packages: ok"
