#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# What is installed works from any folder: a small program finds it with CMake and with pkg-config, and runs.
. "$(dirname "$0")/check.sh"
programs=$source/tests/repository
sample=$source/configs/sample/reference.dng
photo=$source/configs/sample/photo.jpg
library=$(dirname "$(find "$prefix/" -name libsrisp.so)")

with_cmake() {
    cmake -S "$programs/$1" -B "$scratch/$1" -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$prefix" \
        && cmake --build "$scratch/$1"
}

# with_pkg_config FOLDER PACKAGE PROGRAM
with_pkg_config() {
    # One word per line: the prefix may hold spaces.
    PKG_CONFIG_PATH="$library/pkgconfig" pkg-config --cflags --libs "$2" >"$scratch/flags" || return 1
    eval "c++ -std=c++17 '$programs/$1/$3.cpp' -o '$scratch/$3' $(cat "$scratch/flags")"
}

gives_the_image_of_the_tool() {
    rm -f "$scratch/program.exr"
    "$@" "$photo" "$sample" "$scratch/program.exr" || return 1
    "$prefix/bin/srisptool" "$photo" --srisp-unprocess "$sample" -d half -o "$scratch/tool.exr" || return 1
    idiff -fail 0 -warn 0 "$scratch/program.exr" "$scratch/tool.exr" || return 1
    for image in program tool; do
        iinfo -v "$scratch/$image.exr" | grep -E 'unprocess:(parameters|model|reference|colorspace)' >"$scratch/$image.record"
    done
    [ "$(wc -l <"$scratch/tool.record")" -ge 3 ] && diff "$scratch/program.record" "$scratch/tool.record"
}

names_the_missing_photo() {
    ! "$scratch/package/unprocess" /no.jpg "$sample" "$scratch/no.exr" 2>"$scratch/stderr" \
        && grep -F "photo '/no.jpg': does not exist" "$scratch/stderr" && [ ! -e "$scratch/no.exr" ]
}

# A copy of the library that has no models beside it.
models_are_those_beside_the_library() {
    mkdir -p "$scratch/bare/lib" && cp -P "$library"/libsrisp.so* "$scratch/bare/lib/" || return 1
    ! LD_LIBRARY_PATH="$scratch/bare/lib" "$scratch/unprocess" "$photo" "$sample" "$scratch/no.exr" 2>"$scratch/stderr" \
        && grep -F "unknown model 'default' (no model folder found" "$scratch/stderr"
}

exports_only_srisp() {
    nm -DC --defined-only "$library/$1" | cut -d' ' -f3- >"$scratch/symbols"
    grep -q "^srisp::$2(" "$scratch/symbols" && ! grep -vE '^(srisp::|(typeinfo|vtable)( name)? for srisp::)' "$scratch/symbols"
}

names_no_absolute_folders() {
    for file in "$library/libsrisp.so" "$library/libsrisp_ocio.so" "$library"/srisp/*.so "$prefix"/bin/* \
        "$prefix"/lib/python*/dist-packages/srisp/*.so; do
        if readelf -d "$file" 2>/dev/null | grep -E 'R(UN)?PATH' | grep -E '\[/|:/'; then return 1; fi
    done
    ! grep -rlaF -e "$build" -e "$source" "$prefix"
}

gives_the_pixel_of_the_bake() {
    "$@" "$prefix/share/srisp/ocio/srisp.ocio" "$sample" >"$scratch/pixel" || return 1
    "$prefix/bin/srispbake" --reference "$sample" -o "$scratch/bake" -q && ociochecklut "$scratch/bake.unprocess.clf" 0.5 0.5 0.5 \
        | paste -d' ' "$scratch/pixel" - | tee "$scratch/both"
    awk 'NF != 6 { exit 1 } { for (c = 1; c <= 3; c++) { d = $c - $(c + 3); if (d * d > 1e-9) exit 1 } }' "$scratch/both"
}

names_the_missing_reference() {
    ! "$scratch/package_ocio/host" "$prefix/share/srisp/ocio/srisp.ocio" /no.dng 2>"$scratch/stderr" \
        && grep "SRISP_REFERENCE='/no.dng'" "$scratch/stderr"
}

check "a program builds with find_package(srisp)" with_cmake package
check "the program built with CMake gives the tool's image, to the bit" gives_the_image_of_the_tool "$scratch/package/unprocess"
check "a photo that is not there is named" names_the_missing_photo
check "a program builds with pkg-config" with_pkg_config package srisp unprocess
check "and so does the program built with pkg-config" \
    gives_the_image_of_the_tool env LD_LIBRARY_PATH="$library" "$scratch/unprocess"
check "models are those beside the library" models_are_those_beside_the_library
check "libsrisp exports nothing but srisp's own names" exports_only_srisp libsrisp.so select
check "and so does libsrisp_ocio" exports_only_srisp libsrisp_ocio.so transform_from_context
check "what is installed names no folder of the build, and has no run path but \$ORIGIN" names_no_absolute_folders
nobody_else_may_write() { ! find "$prefix" -type f -perm -o+w | grep .; }
check "others may write to nothing that is installed" nobody_else_may_write
model_that_was_changed() {
    cp -r "$prefix/bin" "$prefix/lib" "$prefix/libexec" "$prefix/share" "$scratch/copy/" && chmod -R u+w "$scratch/copy" || return 1
    model=$(find "$scratch/copy" -name default.safetensors)
    "$scratch/copy/bin/srisptool" "$photo" --srisp-params "$sample" || return 1
    cp "$prefix/share/srisp/models/spatial.safetensors" "$model"
    ! "$scratch/copy/bin/srisptool" "$photo" --srisp-params "$sample" 2>"$scratch/stderr" \
        && grep -F "default.safetensors': is not the file that ships under this name: its SHA-256 is $(sha256sum <"$model" | cut -c1-64)" \
            "$scratch/stderr" || return 1
    # By its path, and from a folder of the user's own, it is the user's.
    "$scratch/copy/bin/srisptool" "$photo" "--srisp-params:model=$model" "$sample" \
        && mkdir "$scratch/own" && cp "$model" "$scratch/own/" \
        && SRISP_MODEL_PATH="$scratch/own" "$scratch/copy/bin/srisptool" "$photo" --srisp-params "$sample"
}
mkdir "$scratch/copy"
check "a model that does not ship under its name is refused in the installed place, and nowhere else" model_that_was_changed
check "a host of OpenColorIO builds with find_package(srisp COMPONENTS ocio)" with_cmake package_ocio
check "it runs, and its pixel is that of the bake" gives_the_pixel_of_the_bake "$scratch/package_ocio/host"
check "it builds with pkg-config" with_pkg_config package_ocio srisp_ocio host
check "and runs" gives_the_pixel_of_the_bake env LD_LIBRARY_PATH="$library" "$scratch/host"
check "a reference that is not there is named" names_the_missing_reference
check "headers and models are installed" \
    test -f "$prefix/include/srisp/select.h" -a -f "$prefix/share/srisp/models/spatial.safetensors"
finish
