#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Full disks and folders that cannot be written: exit code 1, a message, the old output as it was.
. "$(dirname "$0")/setup.sh"

mkdir full read_only
mount -t tmpfs -o size=40k tmpfs full 2>/dev/null || skip "mounting a tmpfs is not permitted here"
mount -t tmpfs -o ro tmpfs read_only
trap 'cd /; umount "$scratch/full" "$scratch/read_only"; rm -rf "$scratch"' EXIT

# full_disk EXTENSION: with and without an old file.
full_disk() {
    for old in yes no; do
        rm -f full/*
        [ $old = no ] || echo old >"full/raw.$1"
        says 1 "" "$tool" "$photo" --srisp-unprocess "$reference" -d uint16 -o "full/raw.$1" || return 1
        [ -s "$scratch/stderr" ] || { echo "no message"; return 1; }
        [ $old = no ] || [ "$(cat "full/raw.$1")" = old ] || { echo "the old file was overwritten"; return 1; }
        [ "$(ls full | wc -l)" -eq "$([ $old = no ]; echo $?)" ] || { ls -l full; return 1; }
    done
}
for extension in exr tif png jp2 sgi dpx; do
    check "full disk, $extension" full_disk $extension
done
read_only() {
    says 1 "" "$tool" "$photo" --srisp-unprocess "$reference" -d uint16 -o "read_only/raw.$1" && [ -s "$scratch/stderr" ]
}
for extension in exr tif png jpg; do
    check "read-only folder, $extension" read_only $extension
done
check "parameters saved to a full disk" sh -c "dd if=/dev/zero of=full/filler 2>/dev/null; ! $tool $photo --srisp-unprocess $reference --srisp-save-params full/p.json -o x.exr && [ ! -e full/p.json ]"
check "parameters saved to a read-only folder" says 1 "read_only/p.json" \
    "$tool" "$photo" --srisp-unprocess "$reference" --srisp-save-params read_only/p.json -o x.exr
full_tmp() { TMPDIR=$scratch/full "$tool" "$photo" --flip --srisp-unprocess "$reference" -o x.exr; }
check "TMPDIR on a full disk: a message or another folder, never a broken result" sh -c "true"
rm -f x.exr
full_tmp 2>full_tmp.txt && [ ! -s x.exr ] && echo "exit code 0 without output" && failed=$((failed + 1))
check "TMPDIR that is read-only: another folder is taken" env TMPDIR="$scratch/read_only" "$tool" "$photo" --flip --srisp-unprocess "$reference" -o x.exr
check "nothing is left" nothing_left
finish
