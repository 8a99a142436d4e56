#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# RAW files that make LibRaw write over its memory, or run out of stack: a message at every door, as reference and as
# photo.
. "$(dirname "$0")/setup.sh"

python3 - <<'END'
import struct

def tiff(order, *entries):
    head = {"<": b"II*\0", ">": b"MM\0*"}[order] + struct.pack(order + "IH", 8, len(entries))
    return head + b"".join(struct.pack(order + "HHI", *e[:3]) + e[3] for e in entries) + struct.pack(order + "I", 0)

def save(name, data):
    with open(name, "wb") as file:
        file.write(data)

fill = bytes(range(200, 256))
for order, name in (("<", "little"), (">", "big")):
    long = lambda value: struct.pack(order + "I", value)
    dng = (50706, 1, 4, b"\1\4\0\0")
    save(name + ".dng", tiff(order, (33422, 1, 36, long(8)), dng) + fill)
    save(name + ".nef", tiff(order, (64777, 1, 36, long(8))) + fill)
    save(name + "_loop.dng", tiff(order, (330, 4, 1, long(8)), dng) + fill)
olympus = tiff("<", (33422, 7, 36, struct.pack("<I", 8))) + fill
save("olympus.orf", b"IIRO" + olympus[4:])
block = b"PKTS" + struct.pack(">I", 1) + b"x" * 40 + struct.pack(">I", 0)
save("deep.nef", tiff(">", (34310, 7, 100, struct.pack(">I", 26))) + block * 200000)
END

# refuses FILE WORDS…: within a few seconds, by one line with its name.
refuses() {
    file=$1
    shift
    says 1 "$file" timeout 60 "$@" || return 1
    [ "$(wc -l <"$scratch/stderr")" -eq 1 ] || { cat "$scratch/stderr"; return 1; }
    [ ! -e raw.exr ] || { echo "raw.exr is left"; return 1; }
}
recipe() { printf '{"format": "srisp-recipe-1", "source": "%s", "reference": "%s"%s}' "$1" "$2" "$3" >"$4"; }
cp "$photo" plain.jpg
for file in little.dng big.dng little.nef big.nef little_loop.dng big_loop.dng olympus.orf deep.nef; do
    check "$file as reference" refuses $file "$tool" "$photo" --srisp-unprocess $file -o raw.exr
    check "$file as reference, by hand-over" refuses $file "$tool" "$photo" --flip --srisp-unprocess $file -o raw.exr
    check "$file as photo" refuses $file "$tool" $file --srisp-unprocess "$reference" -o raw.exr
    recipe plain.jpg $file "" photo.srisp
    recipe $file "$reference" "" raw.srisp
    for name in photo raw; do
        check "$file in a recipe ($name), stock iinfo" refuses $file env OIIO_LIBRARY_PATH="$plugins" iinfo $name.srisp
    done
    check "$file baked" refuses $file "$build/bin/srispbake" --reference $file -o baked
done
mkdir set
cp ./*.dng ./*.nef ./*.orf plain.jpg set
packs_the_rest() {
    timeout 100 "$build/bin/srisppack" set -o pack --size 64 --crops 1 >pack.txt 2>&1 || { cat pack.txt; return 1; }
    for file in little.dng big.dng little.nef big.nef little_loop.dng big_loop.dng olympus.orf deep.nef; do
        grep -q "$file" pack.txt || { echo "nothing about $file"; return 1; }
    done
    [ -e pack/pack.json ]
}
check "a set with all of them is packed without them" packs_the_rest
recipe plain.jpg little.nef ', "isolate": false' here.srisp
check "the look at a file does not need the other program" refuses little.nef env OIIO_LIBRARY_PATH="$plugins" iinfo here.srisp
recipe little.nef "$reference" ', "isolate": false' here.srisp
check "nor for a photo" refuses little.nef env OIIO_LIBRARY_PATH="$plugins" iinfo here.srisp

same_apart() {
    recipe plain.jpg "$reference" ', "isolate": false' here.srisp
    recipe plain.jpg "$reference" "" apart.srisp
    OIIO_LIBRARY_PATH="$plugins" "$stock" here.srisp -o here.exr && OIIO_LIBRARY_PATH="$plugins" "$stock" apart.srisp -o apart.exr &&
        same here.exr apart.exr
}
check "the same picture with and without the other program" same_apart
check "no temporary folder is left" nothing_left
finish
