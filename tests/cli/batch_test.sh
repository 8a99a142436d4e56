#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# srispbatch: the same results by every way, after every interruption, and what is refused.
. "$(dirname "$0")/setup.sh"

batch=$build/bin/srispbatch
mkdir -p photos/street refs
cp "$reference" refs/a.dng
"$tool" "$photo" --srisp-unprocess "$reference" -o refs/b.dng # a reference of another scene
for number in 1 2 3 4 5 6; do
    oiiotool "$photo" --mulc 0.$((10 - number)),0.9,0.8 -o photos/$number.jpg
    oiiotool "$photo" --mulc 0.7,0.9,0.$((number + 3)) -o photos/street/$number.png
done
echo text >photos/notes.txt
cp photos/1.jpg photos/.hidden.jpg

hashes() { # hashes FOLDER: names and bytes of all results
    (cd "$1" && find . -type f ! -path './manifest/*' | sort | xargs md5sum)
}
same_results() { hashes "$1" >one.txt && hashes "$2" >two.txt && cmp one.txt two.txt; }
summary() { # summary MADE DONE FAILED COMMAND…
    wanted=": $1 made, $2 done before, $3 failed"
    shift 3
    "$@" >summary.txt 2>batch.log
    grep -qF "$wanted" summary.txt && return 0
    cat summary.txt batch.log
    return 1
}

check "a folder of photos" summary 12 0 0 "$batch" photos --reference refs -o out
named() { [ -s out/1.exr ] && [ -s out/street/6.exr ] && [ "$(find out -name '*.exr' | wc -l)" -eq 12 ]; }
check "results are named after photos, in their folders" named
like_srisptool() {
    line=$(grep '"output":"street/3.exr"' out/manifest/all.jsonl)
    of=$(echo "$line" | sed 's/.*"reference":"\([^"]*\)".*/\1/')
    "$tool" photos/street/3.png --srisp-unprocess "$of" -d half -o tool.exr && same tool.exr out/street/3.exr
}
check "pixels are srisptool's" like_srisptool
both() { grep -q 'refs/a.dng' out/manifest/all.jsonl && grep -q 'refs/b.dng' out/manifest/all.jsonl; }
check "with both references" both
check "the same command makes nothing again" summary 0 12 0 "$batch" photos --reference refs -o out
check "and exits well" exits 0 "$batch" photos --reference refs -o out -q
one_thread() { "$batch" photos --reference refs -o single --threads 1 -q && same_results out single; }
check "the same bits on one thread" one_thread
shards() {
    for shard in 2 0 1; do "$batch" photos --reference refs -o shards --shard $shard/3 -q || return 1; done
    same_results out shards && [ "$(cat shards/manifest/*.jsonl | wc -l)" -eq 12 ]
}
check "the same bits in three shards" shards
slurm() {
    for task in 5 6; do
        SLURM_ARRAY_TASK_ID=$task SLURM_ARRAY_TASK_COUNT=2 SLURM_ARRAY_TASK_MIN=5 "$batch" photos --reference refs \
            -o slurm -q || return 1
    done
    same_results out slurm && [ -s slurm/manifest/0-of-2.jsonl ] && [ -s slurm/manifest/1-of-2.jsonl ]
}
check "the same bits in a job array" slurm
fewer() { "$batch" photos/street --reference refs -o few -q && [ -s few/3.exr ]; }
check "a folder by itself" fewer
lists() {
    (cd photos && find . -name '*.jpg' -o -name '*.png' | grep -v hidden | sort -r >../list.txt)
    (cd photos && "$batch" @../list.txt --reference ../refs -o ../listed -q && "$batch" - --reference ../refs -o ../piped -q <../list.txt)
    same_results listed piped && [ "$(find listed -name '*.exr' | wc -l)" -eq 12 ]
}
check "a list in a file, or on stdin" lists
globbed() { "$batch" "photos/*.jpg" --reference refs/a.dng -o globbed -q && [ "$(find globbed -name '*.exr' | wc -l)" -eq 6 ]; }
check "a glob" globbed
matched() { "$batch" photos --match '[12].*' --reference refs -o matched -q && [ "$(find matched -name '*.exr' | wc -l)" -eq 4 ]; }
check "files that fit" matched

copies() {
    "$batch" photos/street --reference refs/a.dng -o copies --per-image 2 --mosaic --noise reference --format npy \
        --depth uint16 -q && [ "$(ls copies | grep -c npy)" -eq 12 ] && ! cmp -s copies/1_0.npy copies/1_1.npy &&
        /usr/bin/python3 -c "import numpy; a = numpy.load('copies/1_0.npy'); assert a.ndim == 2 and a.dtype == 'uint16' and a.max() > 600, a"
}
check "copies with noise of their own, as mosaics for NumPy" copies
array() {
    "$batch" photos/1.jpg --reference refs/a.dng -o array --format npy --depth float -q &&
        "$batch" photos/1.jpg --reference refs/a.dng -o floats --depth float -q && /usr/bin/python3 - <<'P'
import glob, numpy, OpenImageIO
a = numpy.load(glob.glob("array/**/*.npy", recursive=True)[0])
b = OpenImageIO.ImageBuf(glob.glob("floats/**/*.exr", recursive=True)[0]).get_pixels(OpenImageIO.FLOAT)
assert a.shape == b.shape and a.dtype == "float32" and (a == b).all()
P
}
check "NumPy files have the pixels of the EXR" array
dngs() {
    "$batch" photos/street --reference refs/a.dng -o dngs --format dng --mosaic --noise reference -q &&
        oiiotool --info -v dngs/1.dng 2>/dev/null | grep -q "DNG\|raw\|tiff" && [ "$(ls dngs | grep -c dng)" -eq 6 ]
}
check "DNG files" dngs
developed() { "$batch" photos/street --reference refs/a.dng -o plates --develop ACEScg --exposure 0.5 -q && oiiotool --info -v plates/1.exr | grep -q lin_ap1_scene; }
check "developed plates" developed
every() { "$batch" photos/street --reference refs -o every --pairing all -q && [ "$(ls every | grep -c exr)" -eq 12 ]; }
check "each photo with each reference" every
pairs() {
    printf 'photo,reference\r\n1.png,refs/a.dng\n"2.png",refs/b.dng\n2.png,refs/a.dng\n' >pairs.csv
    says 1 "photo '3.png' has no reference in the CSV file" "$batch" photos/street --reference pairs.csv -o pairs -q || return 1
    "$batch" photos/street --match '[12].png' --reference pairs.csv -o pairs -q && [ -s pairs/1.exr ] && [ -s pairs/2_1.exr ]
}
check "pairs in a CSV file" pairs
weights() {
    printf 'reference,weight\nrefs/a.dng,1e-9\nrefs/b.dng,3\n' >weights.csv
    "$batch" photos --reference weights.csv -o weights -q && ! grep -q 'refs/a.dng' weights/manifest/all.jsonl
}
check "weights in a CSV file" weights
another_seed() {
    "$batch" photos --reference refs -o seed --seed 9 -q && ! same_results out seed >/dev/null
}
check "another seed pairs otherwise" another_seed

broken() {
    cp -r photos other && echo broken >other/bad.jpg
    exits 1 "$batch" other --reference refs -o other_out 2>batch.log >summary.txt || return 1
    grep -q "12 made, 0 done before, 1 failed" summary.txt && grep -q "1 × is not an image" summary.txt &&
        grep -q '"photo":"bad.jpg"' other_out/manifest/failed.jsonl || { cat summary.txt; return 1; }
    summary 0 12 1 "$batch" other --reference refs -o other_out || return 1
    cp photos/1.jpg other/bad.jpg
    summary 1 12 0 "$batch" other --reference refs -o other_out && [ ! -e other_out/manifest/failed.jsonl ]
}
check "a broken photo costs itself, and is tried again" broken
lost() {
    cp -r out damaged
    rm damaged/1.exr && head -c 100 out/2.exr >damaged/2.exr
    summary 2 10 0 "$batch" photos --reference refs -o damaged && same_results out damaged
}
check "what is lost or cut is made again, to the bit" lost
checked() {
    printf x | dd of=damaged/3.exr bs=1 seek=2000 conv=notrunc 2>/dev/null
    says 1 "'damaged/3.exr' has not the bytes" "$batch" --verify damaged || return 1
    summary 0 12 0 "$batch" photos --reference refs -o damaged || return 1
    summary 1 11 0 "$batch" photos --reference refs -o damaged --check && same_results out damaged &&
        exits 0 "$batch" --verify damaged -q
}
check "changed bytes are found by --verify, and made again by --check" checked
foreign() {
    mkdir foreign && echo mine >foreign/1.exr
    summary 11 0 1 "$batch" photos --reference refs -o foreign || return 1
    [ "$(cat foreign/1.exr)" = mine ] && grep -q "srispbatch did not make it so" foreign/manifest/failed.jsonl &&
        summary 12 0 0 "$batch" photos --reference refs -o foreign --overwrite && same_results out foreign
}
check "what others made stays, but for --overwrite" foreign
onto_inputs() { # a set of PNGs into its own folder, a reference's folder
    cp -r photos/street own && hashes own >before.txt
    exits 1 "$batch" own --reference refs/a.dng -o own --format png --overwrite -q || return 1
    hashes own >after.txt && cmp before.txt after.txt || return 1
    cp photos/1.jpg a.jpg && md5sum refs/a.dng >a.md5
    exits 1 "$batch" a.jpg --reference refs/a.dng -o refs --format dng --overwrite -q && md5sum -c --quiet a.md5 &&
        grep -q "inputs are never overwritten" refs/manifest/failed.jsonl && rm -r refs/manifest
}
check "inputs are never overwritten" onto_inputs
inside() {
    cp -r photos nest
    summary 12 0 0 "$batch" nest --reference refs -o nest/raw && summary 0 12 0 "$batch" nest --reference refs -o nest/raw
}
check "results inside the photos' folder are no photos" inside
depths() {
    "$batch" photos/1.jpg --reference refs/a.dng -o floats.dngs --format dng --depth half -q &&
        "$batch" photos/1.jpg --reference refs/a.dng -o units --format png --mosaic --levels unit -q &&
        oiiotool --stats units/photos/1.png | grep "Stats Min" | grep -q " 0 \| [0-9][0-9]\? \| [0-9][0-9][0-9] "
}
check "depths and levels that are asked for" depths
without_manifest() { cp -r out bare && rm -r bare/manifest && summary 12 0 0 "$batch" photos --reference refs -o bare && same_results out bare; }
check "results whose record is lost are known by their bytes" without_manifest
killed() {
    for round in 1 2 3 4 5 6; do
        "$batch" photos --reference refs -o killed -q &
        sleep 0.$((round * 2 % 10 + 1))
        kill -9 $! 2>/dev/null
        wait $! 2>/dev/null
        find killed -name '*.exr' ! -name '.*' 2>/dev/null | while read -r file; do iinfo "$file" >/dev/null || echo broken; done
    done >broken.txt
    [ ! -s broken.txt ] && "$batch" photos --reference refs -o killed -q && same_results out killed &&
        exits 0 "$batch" --verify killed -q
}
check "killed at any moment, it goes on to the same bits" killed
interrupted() {
    "$batch" photos --reference refs -o stopped --per-image 20 -q &
    pid=$!
    sleep 0.7
    kill -TERM $pid # a shell's background jobs ignore the other one
    wait $pid
    [ $? -eq 143 ] || return 1
    [ -z "$(find stopped -name '.*' -type f)" ] && "$batch" photos --reference refs -o stopped --per-image 20 -q &&
        [ "$(find stopped -name '*.exr' | wc -l)" -eq 240 ]
}
check "a signal lets it finish what is being written" interrupted
cut_line() {
    cp -r out cut && truncate -s -40 cut/manifest/all.jsonl
    summary 1 11 0 "$batch" photos --reference refs -o cut && summary 0 12 0 "$batch" photos --reference refs -o cut
}
check "a record that was cut off is no record" cut_line

dry() { "$batch" photos --reference refs -o dry --dry-run | grep -q "12 results, of which 0 are done; nothing was made" && [ ! -e dry ]; }
check "a dry run makes nothing" dry
summary_as_json() { "$batch" photos --reference refs -o out --json | /usr/bin/python3 -c "import json, sys; assert json.load(sys.stdin)['done_before'] == 12"; }
check "the summary as JSON" summary_as_json
check "other settings in the same folder" says 1 "was made with other settings" "$batch" photos --reference refs -o out --brightness 1
check "no photos" says 2 "no photos are given" "$batch" --reference refs -o no
check "no reference" says 2 "no reference is given" "$batch" photos -o no
check "no output" says 2 "no output is given" "$batch" photos --reference refs
check "a photo that is missing" says 1 "photo 'none.jpg' does not exist" "$batch" none.jpg --reference refs -o no
mkdir empty
check "an empty folder" says 1 "folder 'empty' holds no images" "$batch" empty --reference refs -o no
check "a reference that is missing" says 1 "none.dng" "$batch" photos --reference none.dng -o no
check "a shard that is none" says 2 "is not I/N" "$batch" photos --reference refs -o no --shard 3/3
check "an option's value" says 2 "brightness 'dark'" "$batch" photos --reference refs -o no --brightness dark
check "a depth that the format lacks" says 2 "EXR holds half and float" "$batch" photos --reference refs -o no --depth uint16
check "two photos of one name" says 2 "would both become" sh -c 'cp photos/1.jpg photos/street/1.jpg; "$0" photos/street --reference refs -o no; code=$?; rm photos/street/1.jpg; exit $code' "$batch"
check "no output of all these" [ ! -e no ]
if mount -t tmpfs -o size=300k tmpfs "$(mkdir -p full && echo full)" 2>/dev/null; then
    trap 'cd /; umount "$scratch/full" 2>/dev/null; rm -rf "$scratch"' EXIT
    full() {
        says 1 "No space left on device" "$batch" photos --reference refs -o full || return 1
        [ "$(grep -c . "$scratch/stderr")" -eq 1 ] && mount -o remount,size=40m full &&
            "$batch" photos --reference refs -o full -q && same_results out full
    }
    check "a full disk stops it with one message, and it goes on" full
    umount full
fi
finish
