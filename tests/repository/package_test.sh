#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# What is installed works from any folder: a small program finds it with CMake and with pkg-config, and runs.
. "$(dirname "$0")/check.sh"
here=$source/tests/repository/package
sample=$source/configs/sample/reference.dng
library=$(dirname "$(find "$prefix/" -name libsrisp.so)")

with_cmake() {
    cmake -S "$here" -B "$scratch/cmake" -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$prefix" \
        && cmake --build "$scratch/cmake"
}

with_pkg_config() {
    # One word per line: the prefix may hold spaces.
    PKG_CONFIG_PATH="$library/pkgconfig" pkg-config --cflags --libs srisp >"$scratch/flags" || return 1
    eval "c++ -std=c++17 '$here/main.cpp' -o '$scratch/unprocess' $(cat "$scratch/flags")"
}

model_is_the_installed_one() {
    "$@" "$sample" >"$scratch/out" || return 1
    cat "$scratch/out"
    grep -qF "$(readlink -f "$prefix")/share/srisp/models/default.safetensors RGGB " "$scratch/out"
}

exports_only_srisp() {
    nm -DC --defined-only "$library/libsrisp.so" | cut -d' ' -f3- >"$scratch/symbols"
    grep -q '^srisp::select(' "$scratch/symbols" && ! grep -vE '^(srisp::|(typeinfo|vtable)( name)? for srisp::)' "$scratch/symbols"
}

names_no_absolute_folders() {
    for file in "$library/libsrisp.so" "$library"/srisp/*.so "$prefix"/bin/*; do
        if readelf -d "$file" 2>/dev/null | grep -E 'R(UN)?PATH'; then return 1; fi
    done
    ! grep -rnF -e "$build" -e "$source" "$library/cmake" "$library/pkgconfig"
}

check "a program builds with find_package(srisp)" with_cmake
check "the program built with CMake runs" model_is_the_installed_one "$scratch/cmake/unprocess"
check "a program builds with pkg-config" with_pkg_config
check "the program built with pkg-config runs" \
    model_is_the_installed_one env LD_LIBRARY_PATH="$library" "$scratch/unprocess"
check "libsrisp exports nothing but srisp's own names" exports_only_srisp
check "what is installed names no folder of the build, and has no run path" names_no_absolute_folders
check "headers and models are installed" \
    test -f "$prefix/include/srisp/select.h" -a -f "$prefix/share/srisp/models/pointwise.safetensors"
finish
