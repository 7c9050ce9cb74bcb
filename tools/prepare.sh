#!/bin/sh
# prepare.sh [lint|bench|packages|cross|charts] - installs, on Debian, the packages that building and testing need, with
# `lint` also what the whole continuous check needs, with `bench` also the libraries that `make
# bench` compares with, with `packages` or `cross` also what `make check-packages` or `make check-cross` needs; and
# uPlot, the library of the charts of pages, from the npm registry, with `charts` that alone.  Does nothing when all are
# there.
set -e
# A package of the registry has the same bytes for ever.
uplot=1.6.32
package_sum=4b8a8191e425658e3ea8c8c1314b0fc679c861ee3a1af2b20c7b16ba50b5133d
script_sum=19c8d4c6ad88929a79f4ae49d6f7161566dfd0ba3d15cc495e974f787eb78f1f
place=${DALEMBERT_UPLOT:-/usr/local/share/dalembert/uplot}
has_charts() {
    [ -s "$place/LICENSE" ] && [ -s "$place/uPlot.min.css" ] &&
        echo "$script_sum  $place/uPlot.iife.min.js" | sha256sum -c --status 2>/dev/null
}
# By npm where it is installed and works, or wget.
download_charts() { # FILE
    { command -v npm >/dev/null 2>&1 && (cd "$(dirname "$1")" && npm pack --silent "uplot@$uplot" >/dev/null &&
        mv "uplot-$uplot.tgz" "$1"); } ||
        wget -q --tries=3 -O "$1" "https://registry.npmjs.org/uplot/-/uplot-$uplot.tgz"
}
install_charts() {
    has_charts && return
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
    download_charts "$work/package.tgz" || { echo "prepare.sh: cannot download uplot@$uplot" >&2; return 1; }
    echo "$package_sum  $work/package.tgz" | sha256sum -c --status ||
        { echo "prepare.sh: uplot@$uplot has another checksum than $package_sum" >&2; return 1; }
    tar -xzf "$work/package.tgz" -C "$work"
    mkdir -p "$place" 2>/dev/null || $sudo mkdir -p "$place"
    own=$sudo
    [ ! -w "$place" ] || own=
    $own install -m 644 "$work/package/dist/uPlot.iife.min.js" "$work/package/dist/uPlot.min.css" \
        "$work/package/LICENSE" "$place"
}
# All but the charts works without the registry.
try_charts() {
    install_charts && return
    [ "$CI" != true ] || exit 1
    echo 'prepare.sh: pages will have tables without charts; later: sh tools/prepare.sh charts' >&2
}
sudo=
[ "$(id -u)" -eq 0 ] || sudo=sudo
[ "$1" != charts ] || { install_charts; exit; }
packages='gcc libc6-dev make pkg-config libyaml-dev libcunit1-dev libmpfr-dev libjansson-dev locales gnuplot-nox g++ cmake groff-base'
packages="$packages python3 python3-cffi python3-dev python3-numpy python3-pytest python3-setuptools python3-venv python3-wheel"
if [ "$1" = lint ]; then
    packages="$packages binutils clang clang-format shellcheck libclang-rt-14-dev universal-ctags valgrind openmpi-bin libopenmpi-dev chromium"
    packages="$packages python3-ipykernel python3-matplotlib python3-nbclient" # for the notebooks
    packages="$packages doxygen graphviz katex mkdocs mkdocs-material"
    packages="$packages texlive-latex-base" # for the labels of figures
fi
if [ "$1" = bench ]; then
    packages="$packages libgsl-dev libsundials-dev libboost-dev"
fi
if [ "$1" = packages ]; then
    packages="$packages debhelper dh-python dpkg-dev lintian mmdebstrap pybuild-plugin-pyproject python3-all-dev"
fi
if [ "$1" = cross ]; then
    packages="$packages gcc-aarch64-linux-gnu libc6-dev-arm64-cross mmdebstrap qemu-user"
fi
has_charts || command -v npm >/dev/null 2>&1 || packages="$packages ca-certificates wget"
missing=
for package in $packages; do
    dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed ||
        missing="$missing $package"
done
[ -n "$missing" ] || { try_charts; exit 0; }
export DEBIAN_FRONTEND=noninteractive
# Another apt may run, as on a machine that has just started: wait for it.  The timeout of apt is for
# the lock of dpkg alone, not for the lock of the lists.
tries=60
until said=$(LC_ALL=C $sudo apt-get update 2>&1); do
    tries=$((tries - 1))
    case $said in *'Could not get lock'*) ;; *) tries=0 ;; esac
    [ $tries -gt 0 ] || { echo "$said" >&2; exit 1; }
    echo 'prepare.sh: another apt is running: waiting for it' >&2
    sleep 10
done
$sudo apt-get -o DPkg::Lock::Timeout=600 install -y --no-install-recommends $missing
try_charts
