#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Builds srisp where that has not been done, unprocesses a photo, and shows what came out on one sheet of pictures.
#   sh tools/demo.sh [PHOTO REFERENCE]     default: the sample in configs/sample
#   SRISP_BUILD_DIR                        the build folder; default build/ of the repository
set -eu

source=$(cd "$(dirname "$0")/.." && pwd)
build=${SRISP_BUILD_DIR:-$source/build}
out=$(pwd)/srisp-demo

case $# in
    0) photo=$source/configs/sample/photo.jpg reference=$source/configs/sample/reference.dng ;;
    2) photo=$1 reference=$2 ;;
    *) echo "usage: sh tools/demo.sh [PHOTO REFERENCE]" >&2; exit 2 ;;
esac
for file in "$photo" "$reference"; do
    [ -r "$file" ] || { echo "demo: cannot read '$file'" >&2; exit 1; }
done

sh "$source/tools/install-deps.sh" build
[ -f "$build/CMakeCache.txt" ] || cmake -G Ninja -S "$source" -B "$build" -DCMAKE_BUILD_TYPE=Release
# What `cmake --install` needs, without the tests and the trainer: they take longer than all the rest.
cmake --build "$build" --parallel "$(nproc)" --target installables

srisptool=$build/bin/srisptool
mkdir -p "$out"
cd "$out"
# The names of the user's files stay out of oiiotool's patterns.
case $photo in /*) ;; *) photo=$OLDPWD/$photo ;; esac
case $reference in /*) ;; *) reference=$OLDPWD/$reference ;; esac

echo "demo: unprocessing $photo with $reference" >&2
"$srisptool" --wildcardoff "$photo" --srisp-unprocess "$reference" --srisp-save-params parameters.json -o raw.exr
"$srisptool" raw.exr --srisp-process --reorient -d uint8 -o photo_again.png

# What is looked at: upright, colour only, at most 640 pixels, gamma 2.2.
view="--reorient --ch 0,1,2 --fit 640x640 --origin +0+0 --fullpixels"
white_balance=$(tr -d ' \n' <parameters.json | sed -n 's/.*"white_balance":\[\([^],]*,[^],]*,[^],]*\)\].*/\1/p')
channels=$(oiiotool --wildcardoff "$photo" --echo '{TOP.nchannels}' | head -n 1)
photo_view=$view
[ "$channels" -ge 3 ] || photo_view="--reorient --ch 0,0,0 --fit 640x640 --origin +0+0 --fullpixels"
oiiotool --wildcardoff "$photo" $photo_view -d uint8 -o 1_photo.png
oiiotool raw.exr $view --powc 0.4545 -d uint8 -o 2_raw_like.png
oiiotool raw.exr $view --mulc "$white_balance" --clamp:min=0:max=1 --powc 0.4545 -d uint8 -o 3_white_balanced.png
oiiotool photo_again.png $view -d uint8 -o 4_photo_again.png

# captioned FILE TEXT: puts a line of text above a picture, and takes from it what the photo's camera told of place and owner.
captioned() {
    oiiotool --nosoftwareattrib "$1" --eraseattrib '.*' --create '{TOP.width}x{TOP.height+30}' 3 --paste +0+30 \
        --text:x=6:y=21:size=17:font=DejaVuSans "$2" -d uint8 -o "$1"
}
captioned 1_photo.png "photo"
captioned 2_raw_like.png "RAW-like, shown at gamma 2.2"
captioned 3_white_balanced.png "RAW-like, white-balanced, gamma 2.2"
captioned 4_photo_again.png "the photo again, by the forward pipeline"
oiiotool --nosoftwareattrib 1_photo.png 2_raw_like.png 3_white_balanced.png 4_photo_again.png --mosaic:pad=8 2x2 -d uint8 -o sheet.png

echo "demo: the sheet of pictures   $out/sheet.png"
echo "demo: the RAW-like image      $out/raw.exr (float, linear camera RGB)"
echo "demo: its parameters          $out/parameters.json"
