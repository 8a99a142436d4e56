#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Full disks and folders that cannot be written: exit code 1, a message, the old output as it was.
. "$(dirname "$0")/setup.sh"

mkdir full read_only
mount -t tmpfs -o size=40k tmpfs full 2>/dev/null || skip "mounting a tmpfs is not permitted here"
mount -t tmpfs -o ro tmpfs read_only
trap 'cd /; umount "$scratch/full" "$scratch/read_only"; rm -rf "$scratch"' EXIT

# full_disk EXTENSION FILLER_KB: with and without an old file.
full_disk() {
    for old in 1 0; do
        rm -f full/*
        [ $old = 0 ] || echo old >"full/raw.$1"
        dd if=/dev/zero of=filler bs=1k count="$2" 2>/dev/null && mv filler full/.filler
        says 1 "" "$tool" "$photo" --srisp-unprocess "$reference" -d uint16 -o "full/raw.$1" || return 1
        [ -s "$scratch/stderr" ] || { echo "no message"; return 1; }
        [ $old = 0 ] || [ "$(cat "full/raw.$1")" = old ] || { echo "the old file was overwritten"; return 1; }
        [ "$(ls full | wc -l)" -eq $old ] || { ls -l full; return 1; }
    done
}
for extension in exr tif png jp2 sgi dpx; do
    check "disk that gets full, $extension" full_disk $extension 0
    check "full disk, $extension" full_disk $extension 32
done
check "full disk, jpg" full_disk jpg 32
read_only() {
    says 1 "" "$tool" "$photo" --srisp-unprocess "$reference" -d uint16 -o "read_only/raw.$1" && [ -s "$scratch/stderr" ]
}
for extension in exr tif png jpg; do
    check "read-only folder, $extension" read_only $extension
done
parameters_on_full_disk() {
    rm -rf full/* full/.filler
    dd if=/dev/zero of=full/filler 2>/dev/null
    says 1 "full/p.json" "$tool" "$photo" --srisp-unprocess "$reference" --srisp-save-params full/p.json -o x.exr &&
        [ ! -s full/p.json ]
}
check "parameters saved to a full disk" parameters_on_full_disk
check "parameters saved to a read-only folder" says 1 "read_only/p.json" \
    "$tool" "$photo" --srisp-unprocess "$reference" --srisp-save-params read_only/p.json -o x.exr
full_temporary_folder() {
    rm -f x.exr
    says 1 "TMPDIR" env TMPDIR="$scratch/full" "$tool" "$photo" --flip --srisp-unprocess "$reference" -o x.exr && [ ! -e x.exr ]
}
check "TMPDIR on a full disk" full_temporary_folder
check "TMPDIR that is read-only: another folder is taken" env TMPDIR="$scratch/read_only" "$tool" "$photo" --flip --srisp-unprocess "$reference" -o x.exr
check "nothing is left" nothing_left
finish
