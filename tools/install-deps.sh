#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs the Debian packages that srisp needs. Says nothing where all are there.
#   sh tools/install-deps.sh           everything, for the tests, too
#   sh tools/install-deps.sh build     what building and running needs, without the tests and the trainer
#   sh tools/install-deps.sh train     the trainer alone (-DSRISP_TRAINER_ONLY=ON): a machine that only trains
set -eu

packages="
    cmake g++ ninja-build pkg-config
    doctest-dev libcli11-dev libhwy-dev libimath-dev liblcms2-dev libopencolorio-dev libopenexr-dev libopenimageio-dev
    libheif-dev libjpeg-dev libpugixml-dev libraw-dev libssl-dev libtiff-dev libwebp-dev
    libxxhash-dev nlohmann-json3-dev pybind11-dev python3-dev zlib1g-dev
    openimageio-tools python3-openimageio python3-numpy fonts-dejavu-core
"
test_packages="
    chromium chromium-driver clang clang-format-14 darktable dcraw libclang-rt-14-dev libgl1-mesa-dri
    libheif-examples libimage-exiftool-perl libraw-bin libtbb-dev locales make man-db mount munge mypy
    opencolorio-tools parallel python3-distributed python3-matplotlib python3-pil python3-pip python3-pyopencolorio
    python3-pytest python3-selenium python3-setuptools python3-torch python3-venv python3-wheel rawtherapee
    slurm-wlm strace valgrind xauth xvfb
"
trainer_packages="libgloo-dev libopenblas0-openmp libtorch-dev"
case "$#${1:-}" in
    0) packages="$packages $trainer_packages $test_packages" ;;
    1build) ;;
    1train) packages="cmake g++ ninja-build doctest-dev libcli11-dev nlohmann-json3-dev $trainer_packages" ;;
    *) echo "usage: sh tools/install-deps.sh [build|train]" >&2; exit 2 ;;
esac

if ! command -v dpkg-query >/dev/null; then
    echo "install-deps: this is not Debian; install the equivalents of:" $packages >&2
    exit 1
fi
missing=""
for package in $packages; do
    case $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true) in
        installed) ;;
        *) missing="$missing $package" ;;
    esac
done
[ -n "$missing" ] || exit 0

as_root=""
if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
        echo "install-deps: neither root nor sudo here; as root, run: apt-get install$missing" >&2
        exit 1
    fi
    as_root="sudo"
fi
echo "install-deps: installing$missing" >&2
fail() {
    echo "install-deps: apt-get could not install$missing" >&2
    exit 1
}
$as_root apt-get update -qq </dev/null || echo "install-deps: apt-get update failed; trying with the lists that are here" >&2
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing </dev/null >&2 || fail
