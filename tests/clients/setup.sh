# SPDX-License-Identifier: Apache-2.0
# Sourced by the scripts here, with the folders of build and sources as arguments. In a fresh folder: photo.jpg,
# reference.dng, expected.exr (made by oiiotool through a query name). The plugin is on OpenImageIO's search path.
. "$2/tests/repository/check.sh"

OIIO_LIBRARY_PATH=$(dirname "$(find "$build/lib" -name srisp.imageio.so | head -n 1)")
export OIIO_LIBRARY_PATH
cd "$scratch" || exit 1
cp "$source/configs/sample/reference.dng" reference.dng
oiiotool "$source/configs/sample/photo.jpg" --resize 160x0 -o photo.jpg
name="photo.jpg.srisp?reference=reference.dng"
oiiotool "$name" -o expected.exr

# same A B: sizes and pixels are equal to the bit.
same() { idiff -q -fail 0 -warn 0 "$1" "$2"; }

# says TEXT COMMAND…: fails, within a minute, with TEXT in its messages.
says() {
    text=$1
    shift
    timeout 60 "$@" >"$scratch/says.log" 2>&1
    code=$?
    cat "$scratch/says.log"
    [ "$code" -ne 0 ] && [ "$code" -ne 124 ] && grep -qF -- "$text" "$scratch/says.log"
}

# prints TEXT COMMAND…: succeeds with TEXT in its output.
prints() {
    text=$1
    shift
    "$@" >"$scratch/prints.log" 2>&1 || { cat "$scratch/prints.log"; return 1; }
    grep -qF -- "$text" "$scratch/prints.log" && return 0
    cat "$scratch/prints.log"
    return 1
}
