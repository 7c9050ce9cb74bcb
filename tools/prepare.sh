#!/bin/sh
# prepare.sh [lint|bench] - installs, on Debian, the packages that building and testing need, with
# `lint` also those of the whole continuous check, with `bench` also the libraries that `make bench`
# compares with; nothing happens when all are there.
set -e
packages='gcc libc6-dev make pkg-config libyaml-dev libcunit1-dev libmpfr-dev libjansson-dev locales gnuplot-nox'
if [ "$1" = lint ]; then
    packages="$packages binutils clang clang-format libclang-rt-14-dev universal-ctags valgrind openmpi-bin libopenmpi-dev chromium"
fi
if [ "$1" = bench ]; then
    packages="$packages g++ libgsl-dev libsundials-dev libboost-dev"
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
$sudo apt-get update
$sudo apt-get install -y --no-install-recommends $missing
