#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Full disks and folders that cannot be written: exit code 1, a message, the old output as it was.
. "$(dirname "$0")/setup.sh"

mkdir full read_only
mount -t tmpfs -o size=40k tmpfs full 2>/dev/null || skip "mounting a tmpfs is not permitted here"
mount -t tmpfs -o ro tmpfs read_only
trap 'cd /; umount "$scratch/full" "$scratch/read_only"; rm -rf "$scratch"' EXIT

# full_disk EXTENSION FILLER_KB [NAME]: with and without an old file.
full_disk() {
    output=full/${3-raw}.$1
    for old in 1 0; do
        rm -rf full/*
        mkdir -p "${output%/*}"
        [ $old = 0 ] || echo old >"$output"
        dd if=/dev/zero of=filler bs=1k count="$2" 2>/dev/null && mv filler full/.filler
        says 1 "" "$tool" "$photo" --srisp-unprocess "$reference" -d uint16 -o "$output" || return 1
        [ -s "$scratch/stderr" ] || { echo "no message"; return 1; }
        [ $old = 0 ] || [ "$(cat "$output")" = old ] || { echo "the old file was overwritten"; return 1; }
        [ "$(ls "${output%/*}" | wc -l)" -eq $old ] || { ls -lR full; return 1; }
    done
}
for extension in exr tif png jp2 sgi dpx dng; do
    check "disk that gets full, $extension" full_disk $extension 0
    check "full disk, $extension" full_disk $extension 32
done
check "full disk, jpg" full_disk jpg 32
for name in my.tempfolder/raw shot.template a.12345678.temp.dir/raw raw.12345678.temp t.temp/x.temp; do
    for extension in png jp2 sgi tga bmp; do
        check "full disk, $name.$extension" full_disk $extension 24 $name
    done
done
read_only() {
    says 1 "" "$tool" "$photo" --srisp-unprocess "$reference" -d uint16 -o "read_only/raw.$1" && [ -s "$scratch/stderr" ]
}
for extension in exr tif png jpg dng; do
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

# limited NAME COMMAND…: with a limit of 4 KB for the file NAME, which stays as it is.
limited() {
    file=$1
    shift
    echo old >"$file"
    count=$(ls | wc -l)
    (
        ulimit -f 8 # blocks of 512 bytes
        exec "$@" >/dev/null 2>stderr.txt
    )
    code=$?
    cat stderr.txt
    [ $code -eq 1 ] || { echo "exit code $code"; return 1; }
    [ "$(grep -vc WARNING stderr.txt)" -eq 1 ] && grep -q "$file" stderr.txt && grep -q "File too large" stderr.txt || return 1
    [ "$(cat "$file")" = old ] && [ "$(ls | wc -l)" -eq "$count" ]
}
: >stderr.txt
for extension in exr tif png jpg jp2 sgi tga bmp dpx dng; do
    check "a limit for files, $extension" limited raw.$extension "$tool" "$photo" --srisp-unprocess "$reference" -o raw.$extension
done
"$tool" "$photo" --srisp-params "$reference" >look.json
check "a limit for files, srispbake" limited look.clf "$build/bin/srispbake" --params look.json -o look.clf
packed() {
    mkdir -p photos && cp "$photo" photos
    says 1 "File too large" sh -c "ulimit -f 8; exec '$build/bin/srisppack' photos -o pack" && [ "$(ls -A | grep -c pack)" -eq 0 ]
}
check "a limit for files, srisppack" packed
finish
