#!/bin/sh
# prepare.sh [lint|bench|packages] - installs, on Debian, the packages that building and testing need, with
# `lint` also what the whole continuous check needs, with `bench` also the libraries that `make
# bench` compares with, with `packages` also what `make check-packages` needs; does nothing when all are there.
set -e
packages='gcc libc6-dev make pkg-config libyaml-dev libcunit1-dev libmpfr-dev libjansson-dev locales gnuplot-nox g++ cmake groff-base'
packages="$packages python3 python3-cffi python3-dev python3-numpy python3-pytest python3-setuptools python3-venv python3-wheel"
if [ "$1" = lint ]; then
    packages="$packages binutils clang clang-format shellcheck libclang-rt-14-dev universal-ctags valgrind openmpi-bin libopenmpi-dev chromium"
    packages="$packages python3-ipykernel python3-matplotlib python3-nbclient" # for the notebooks
    packages="$packages doxygen graphviz katex linkchecker mkdocs mkdocs-material"
fi
if [ "$1" = bench ]; then
    packages="$packages libgsl-dev libsundials-dev libboost-dev"
fi
if [ "$1" = packages ]; then
    packages="$packages debhelper dh-python dpkg-dev lintian mmdebstrap pybuild-plugin-pyproject python3-all-dev"
fi
missing=
for package in $packages; do
    dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed ||
        missing="$missing $package"
done
[ -n "$missing" ] || exit 0
sudo=
[ "$(id -u)" -eq 0 ] || sudo=sudo
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
