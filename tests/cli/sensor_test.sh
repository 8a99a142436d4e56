#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Mosaic, noise and DNG on srisptool's line: the same by every way, and what they are.
. "$(dirname "$0")/setup.sh"

value() { # value FILE ATTRIBUTE
    oiiotool --info -v "$1" | sed -n "s/^ *$2: //p" | head -n 1
}
statistic() { # statistic FILE Min|Max|Avg: of the first channel
    oiiotool --stats "$1" | sed -n "s/^ *Stats $2: \([-0-9.e]*\).*/\1/p" | head -n 1
}
below() { awk "BEGIN { exit !($1 < $2) }"; }

"$tool" "$photo" --srisp-unprocess "$reference" -o raw.exr
"$tool" "$photo" --srisp-unprocess "$reference" --srisp-mosaic --srisp-noise shot=0.001,read=0.0001 -o one.exr

by_steps() {
    "$tool" "$photo" --srisp-unprocess "$reference" --label x --srisp-mosaic --label y \
        --srisp-noise shot=0.001,read=0.0001 -o steps.exr && same one.exr steps.exr
}
check "in one pass as in three" by_steps
from_file() {
    cp raw.exr photo.exr # the noise is that of the photo's name
    "$tool" raw.exr --srisp-mosaic -o clean.exr &&
        "$tool" "$photo" --srisp-unprocess "$reference" --srisp-mosaic -o clean_one.exr && same clean.exr clean_one.exr
}
check "of a RAW-like file as of a photo" from_file
threads() {
    "$tool" --threads 1 "$photo" --srisp-unprocess "$reference" --srisp-mosaic --srisp-noise shot=0.001,read=0.0001 \
        -o threads.exr && same one.exr threads.exr
}
check "for any number of threads" threads
query() {
    OIIO_LIBRARY_PATH=$plugins oiiotool -i:now=1 \
        "photo.jpg.srisp?reference=$reference&mosaic=reference&noise=shot%3D0.001,read%3D0.0001" -o query.exr &&
        same one.exr query.exr
}
check "by a query" query
cropped() {
    "$tool" raw.exr --crop 100x60+3+5 --srisp-mosaic -o crop.exr && "$tool" clean.exr --crop 100x60+3+5 -o wanted.exr &&
        same crop.exr wanted.exr && [ "$(value crop.exr unprocess:cfa_pattern)" = "$(value clean.exr unprocess:cfa_pattern)" ]
}
check "a crop keeps the phase" cropped

frames() {
    for frame in 0001 0002; do cp "$photo" shot.$frame.jpg; done
    "$tool" --frames 1-2 shot.#.jpg --srisp-unprocess "$reference" --srisp-noise upi -o direct.#.exr &&
        "$tool" --frames 1-2 shot.#.jpg --label x --srisp-unprocess "$reference" --srisp-noise upi -o handed.#.exr &&
        same direct.0001.exr handed.0001.exr && same direct.0002.exr handed.0002.exr &&
        ! same direct.0001.exr direct.0002.exr >/dev/null
}
check "each frame has noise of its own, by hand-over, too" frames
seeds() {
    "$tool" "$photo" --srisp-unprocess "$reference" --srisp-mosaic --srisp-noise:seed=1 shot=0.001,read=0.0001 -o seed.exr &&
        ! same one.exr seed.exr >/dev/null
}
check "another seed gives other noise" seeds
of_reference() {
    "$tool" "$photo" --srisp-unprocess "$reference" --srisp-mosaic --srisp-noise reference -o own.exr &&
        value own.exr unprocess:noise_profile | grep -q '[1-9]' &&
        "$tool" "$photo" --srisp-unprocess "$reference" --resize 100% --srisp-noise reference -o later.exr &&
        [ "$(value own.exr unprocess:noise_profile)" = "$(value later.exr unprocess:noise_profile)" ]
}
check "the reference's noise" of_reference

integers() {
    "$tool" "$photo" --srisp-unprocess "$reference" --srisp-mosaic --srisp-noise shot=0.001,read=0.01 -o "codes.$1" || return 1
    [ "$(oiiotool --info "codes.$1" | grep -c '1 channel, uint16')" -eq 1 ] || return 1
    value "codes.$1" ImageDescription | grep -q '"black_level":\[' || return 1
    below "$(statistic "codes.$1" Min)" 512 # the sample's black level
}
check "noise below black survives in PNG" integers png
in_tiff() {
    "$tool" "$photo" --srisp-unprocess "$reference" --srisp-mosaic -d uint16 -o codes.tif &&
        "$tool" "$photo" --srisp-unprocess "$reference" --srisp-mosaic -o clean.png && same codes.tif clean.png &&
        value codes.tif ImageDescription | grep -q '"cfa_pattern":"[RGB]*"'
}
check "TIFF of integers holds the same, and its phase" in_tiff
codes_in_dng() {
    "$tool" clean.png -o from_png.dng && "$tool" "$photo" --srisp-unprocess "$reference" --srisp-mosaic -o straight.dng || return 1
    for name in from_png straight; do dcraw -D -4 -c $name.dng >$name.pgm || return 1; done
    cmp from_png.pgm straight.pgm
}
if command -v dcraw >/dev/null; then
    check "DNG of the codes is the DNG of the image" codes_in_dng
else
    echo "SKIPPED ${0##*/}: needs dcraw"
fi
below_zero() {
    "$tool" "$photo" --srisp-unprocess "$reference" --srisp-mosaic --srisp-noise shot=0,read=0.01 -o below.exr &&
        below "$(statistic below.exr Min)" 0 && ! below 1 "$(statistic below.exr Max)"
}
check "floats go below 0, and not above 1" below_zero

sequence() {
    "$tool" --frames 1-2 shot.#.jpg --srisp-unprocess:hold=1 "$reference" --srisp-mosaic -o:layout=cinema shot.#.dng &&
        [ -s shot.0001.dng ] && [ -s shot.0002.dng ]
}
check "a CinemaDNG sequence" sequence
check "a mosaic cannot be processed" says 1 "is a mosaic" "$tool" clean.exr --srisp-process -o x.exr
check "a mosaic is no photo" says 1 "is a mosaic" "$tool" clean.exr --srisp-unprocess "$reference" -o x.exr
check "a mosaic is made once" says 1 "is a mosaic already" "$tool" clean.exr --srisp-mosaic -o x.exr
check "noise is added once" says 1 "has noise already" "$tool" one.exr --srisp-noise upi -o x.exr
check "a processed picture has no sensor" says 1 "is a processed picture" \
    "$tool" raw.exr --srisp-process --srisp-noise upi -o x.exr
check "an ISO without a table" says 1 "does not exist" "$tool" raw.exr --srisp-noise:profile=none.json iso=100 -o x.exr
echo '{"version": 0, "noiseprofiles": []}' >profiles.json
check "a camera that the table lacks" says 1 "profiles.json" "$tool" raw.exr --srisp-noise:profile=profiles.json iso=100 -o x.exr
check "the table is never overwritten" says 1 "profiles.json' itself; inputs are never overwritten" \
    "$tool" raw.exr --srisp-noise:profile=profiles.json upi -o:fileformatname=tiff profiles.json
check "a mistyped source" says 2 "noise comes from reference" "$tool" raw.exr --srisp-noise refrence -o x.exr
check "an argument that is missing" says 2 "needs an argument: SOURCE" "$tool" raw.exr --srisp-noise
check "no image" says 1 "no image before it" "$tool" --srisp-mosaic
check "nothing is left" nothing_left
finish
