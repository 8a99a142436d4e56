#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Which way up: what turns images turns them rightly, and outputs hold the orientation or a note says that they cannot.
. "$(dirname "$0")/setup.sh"

oiiotool "$photo" --cut 8x5+20+30 -o stored.tif
$tool "$photo" --srisp-unprocess "$reference" --srisp-save-params p.json -o raw.exr
unprocess="--srisp-unprocess:params=p.json -"
# As the Exif standard has it.
set -- "" --flop --rotate180 --flip --transpose --rotate90 "--transpose --rotate180" --rotate270
for orientation in 1 2 3 4 5 6 7 8; do
    # shellcheck disable=SC2086
    oiiotool stored.tif $1 --orientation 1 -o upright.tif
    shift
    oiiotool stored.tif --orientation "$orientation" -o photo.tif
    # shellcheck disable=SC2086
    $tool photo.tif --reorient -o reoriented.tif $unprocess -o turned.png
    check "--reorient, orientation $orientation" same reoriented.tif upright.tif
    # shellcheck disable=SC2086
    $tool --autoorient photo.tif -o autooriented.tif photo.tif -o twice.tif $unprocess -o turned.exr
    check "--autoorient, orientation $orientation" same autooriented.tif upright.tif
    check "--autoorient of a second image" same twice.tif upright.tif
    # shellcheck disable=SC2086
    $tool photo.tif $unprocess -o raw.png -o raw.exr
    check "PNG holds orientation $orientation" /usr/bin/python3 -c \
        "assert b'eXIfMM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0' + bytes([$orientation]) in open('raw.png', 'rb').read()"
    check "turned PNG is upright" /usr/bin/python3 -c \
        "assert b'eXIfMM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x01' in open('turned.png', 'rb').read()"
    oiiotool raw.png -d uint16 -o from_png.tif
    oiiotool raw.exr -d uint16 -o from_exr.tif
    check "its pixels can be read" same from_png.tif from_exr.tif
done
check "no trace in other outputs" sh -c "! iinfo -v raw.exr | grep -q srisp:Orientation"

oiiotool stored.tif --orientation 6 -o photo.tif
note="'raw.sgi' cannot hold an orientation"
# shellcheck disable=SC2086
{
    check "a format that cannot hold it gets a note" says 0 "$note" "$tool" photo.tif $unprocess -o raw.sgi
    check "with --quiet it does not" sh -c "'$tool' --quiet photo.tif $unprocess -o raw.sgi 2>&1 | cmp - /dev/null"
    check "nor where the image is upright" sh -c "'$tool' photo.tif --reorient $unprocess -o raw.sgi 2>&1 | cmp - /dev/null"
}
check "nothing is left" nothing_left
finish
