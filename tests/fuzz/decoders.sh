#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Fuzzes with LibRaw and OpenImageIO instrumented, too, so that the fuzzer sees the way through them, and the sanitizers
# what they do on it. From anywhere:
#   sh tests/fuzz/decoders.sh --minutes N [TARGET...]   as run.sh; the targets that reach them where none is named
#   sh tests/fuzz/decoders.sh --seconds N [TARGET...]
# The libraries are built of Debian's sources of the installed versions, as theirs but by Clang, and take their place
# for the fuzzer alone: nothing is installed, no file of /etc is changed. Of OpenImageIO's dependencies some headers
# are needed beyond ours (libfmt-dev, robin-map-dev, libboost-thread-dev, libgif-dev, libopenjp2-7-dev; or a folder of
# theirs in CMAKE_PREFIX_PATH). Sources that cannot be fetched may be put, patched, into decoders/libraw and
# decoders/openimageio of run.sh's build folder; a library without sources stays as it is installed, which is told.
set -eu

root=$(cd "$(dirname "$0")/../.." && pwd)
build=${SRISP_FUZZ_BUILD_DIR:-$root/build-fuzz}
work=$build/decoders
# Not all undefined behaviour: casts, shifts and unaligned stores would hide all else.
flags="-O1 -g1 -fPIC -fno-omit-frame-pointer -fsanitize=fuzzer-no-link,address,bounds,integer-divide-by-zero,vla-bound \
-fno-sanitize-recover=all"

case "${1:-}" in
    --minutes | --seconds) [ $# -ge 2 ] ;;
    *) false ;;
esac || { sed -n 's/^#   //p' "$0" >&2; exit 2; }
how=$1 time=$2
shift 2

# fetch NAME PACKAGE: the source NAME of the installed PACKAGE, patched, to $work/NAME.
fetch() {
    [ -d "$work/$1" ] && return
    version=$(dpkg-query -W -f '${source:Version}' "$2")
    mkdir -p "$work/apt/lists/partial" "$work/apt/cache/archives/partial" "$work/fetched"
    apt-get indextargets --format 'deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $(REPO_URI) $(RELEASE) $(COMPONENT)' \
        'Created-By: Packages' | sort -u >"$work/apt/sources.list"
    apt="apt-get -qq -o Dir::Etc::sourcelist=$work/apt/sources.list -o Dir::Etc::sourceparts=/dev/null \
        -o Dir::State::lists=$work/apt/lists -o Dir::Cache=$work/apt/cache"
    (cd "$work/fetched" && $apt update && $apt source "$1=$version") >"$work/$1.log" 2>&1 ||
        { echo "decoders.sh: the sources of $1 $version cannot be fetched, it stays as installed ($work/$1.log)" >&2; return 1; }
    mv "$work/fetched/$1"-*/ "$work/$1"
}

build_libraw() {
    fetch libraw libraw20 || return 0
    [ -e "$work/lib/libraw_r.so.20" ] && return
    make -C "$work/libraw" -f Makefile.dist -j "$(nproc)" lib/libraw_r.a CC=clang CXX=clang++ \
        CFLAGS="-I. -w -DUSE_JPEG -DUSE_JPEG8 -DUSE_LCMS2 $flags" >"$work/libraw.log" 2>&1 ||
        { tail "$work/libraw.log" >&2; exit 2; }
    clang++ -shared -fsanitize=address -Wl,-soname,libraw_r.so.20 -o "$work/lib/libraw_r.so.20" \
        -Wl,--whole-archive "$work/libraw/lib/libraw_r.a" -Wl,--no-whole-archive -llcms2 -ljpeg
}

build_openimageio() {
    fetch openimageio libopenimageio2.4 || return 0
    ls "$work"/lib/libOpenImageIO.so.* >/dev/null 2>&1 && return
    off=
    for part in PYTHON QT OPENCV TBB DCMTK FFMPEG OPENVDB PTEX NUKE FREETYPE CCACHE; do off="$off -DUSE_$part=OFF"; done
    cmake -G Ninja -S "$work/openimageio" -B "$work/openimageio-build" -DCMAKE_CXX_COMPILER=clang++ \
        -DCMAKE_C_COMPILER=clang -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS="$flags" -DCMAKE_CXX_STANDARD=17 \
        -DCMAKE_LIBRARY_OUTPUT_DIRECTORY="$work/lib" -DOIIO_BUILD_TOOLS=OFF -DOIIO_BUILD_TESTS=OFF -DBUILD_DOCS=OFF \
        -DSTOP_ON_WARNING=OFF -DBUILD_MISSING_FMT=OFF -DBUILD_MISSING_ROBINMAP=OFF $off >"$work/openimageio.log" 2>&1 &&
        cmake --build "$work/openimageio-build" --target OpenImageIO >>"$work/openimageio.log" 2>&1 ||
        { tail "$work/openimageio.log" >&2; exit 2; }
}

mkdir -p "$work/lib"
build_libraw
build_openimageio
export LD_LIBRARY_PATH="$work/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
[ $# -gt 0 ] || set -- dng_levels dng_round_trip linear_reference photo raw_formats raw_preview
exec sh "$root/tests/fuzz/run.sh" "$how" "$time" "$@"
