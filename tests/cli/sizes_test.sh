#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Files that claim sizes that they do not have, and images of no pixels: one message, at once, without much memory.
. "$(dirname "$0")/setup.sh"

bake=$build/bin/srispbake

# patched TAG VALUE IN OUT: a tag of the first directory of a little-endian TIFF.
patched() {
    python3 -c '
import struct, sys
tag, value, source, target = int(sys.argv[1]), int(sys.argv[2]), sys.argv[3], sys.argv[4]
data = bytearray(open(source, "rb").read())
directory = struct.unpack_from("<I", data, 4)[0]
for i in range(struct.unpack_from("<H", data, directory)[0]):
    entry = directory + 2 + 12 * i
    if struct.unpack_from("<H", data, entry)[0] == tag:
        struct.pack_into("<HII", data, entry + 2, 4, 1, value)
        open(target, "wb").write(data)
' "$@"
}

# refused TEXT WORDS…: within a generous time and 4 GB of addresses.
refused() {
    (ulimit -v 4000000 && says 1 "$@") || return 1
    [ "$(wc -l <"$scratch/stderr")" -eq 1 ] || { cat "$scratch/stderr"; return 1; }
    [ ! -e raw.exr ]
}
# everywhere TEXT FILE: on each way in.
everywhere() {
    refused "$1" timeout 60 "$tool" "$2" --srisp-unprocess "$reference" -o raw.exr &&
        refused "$1" timeout 60 "$tool" "$2" --flip --srisp-unprocess "$reference" -o raw.exr &&
        refused "$1" timeout 60 "$tool" "$2" --srisp-params "$reference" &&
        refused "$1" timeout 60 "$tool" "$2" --srisp-process:params=look.json -o raw.exr &&
        refused "$1" timeout 60 "$bake" --reference "$reference" --source "$2" -o baked
}

"$tool" "$photo" --srisp-params "$reference" >look.json
oiiotool "$photo" --tile 64 64 -o tiles.tif
oiiotool "$photo" -o strips.tif
for tag in 322 323; do
    patched $tag 2147483632 tiles.tif huge.tif
    check "a tile's side of 0x7ffffff0 (tag $tag)" everywhere "2147483632" huge.tif
done
for tag in 256 257; do
    patched $tag 2147483632 tiles.tif huge.tif
    check "a side of 0x7ffffff0 (tag $tag)" everywhere "huge.tif" huge.tif
done
patched 278 2147483632 strips.tif huge.tif
check "a strip of 0x7ffffff0 rows, most of which are missing" everywhere "huge.tif" huge.tif

printf '\377\330\377\300\000\013\010\377\334\377\334\001\001\021\000\377\332\000\010\001\001\000\000\000\000' >huge.jpg
head -c 100 /dev/zero >>huge.jpg
check "a JPEG of 125 bytes of 65,500 x 65,500" everywhere "says that it has 65500 x 65500 pixels, but has only 125 bytes" huge.jpg
printf 'GIF89a\334\377\334\377\000\000\000' >huge.gif
check "a GIF likewise" everywhere "says that it has 65500 x 65500 pixels" huge.gif
oiiotool --pattern constant:color=0.2,0.4,0.6 6000x4000 3 -d uint8 -o flat.png
check "a flat picture of 24 megapixels is no claim" "$tool" flat.png --srisp-params "$reference"
check "unless the user says so" refused "more than the limit of 20 million" env SRISP_MAX_MEGAPIXELS=20 \
    "$tool" flat.png --srisp-params "$reference"

for words in "--create 0x0 3" "--cut 0x0+5+5" "--crop 0x0+3+3" "--fullsize 0x0+0+0 --croptofull"; do
    check "no pixels: $words" refused "has 0 x 0 pixels" "$tool" "$photo" $words --srisp-unprocess "$reference" -o raw.exr
    check "no pixels, parameters: $words" refused "has 0 x 0 pixels" "$tool" "$photo" $words --srisp-params "$reference"
done
check "nothing is left" nothing_left
finish
