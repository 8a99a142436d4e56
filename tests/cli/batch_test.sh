#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# srispbatch: the same results by every way, after every interruption, and what is refused.
. "$(dirname "$0")/setup.sh"

. "$source/tests/cli/batch_setup.sh"

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
elsewhere() { cp -r photos elsewhere && "$batch" elsewhere --reference refs -o copied -q && same_results out copied; }
check "the same bits of a copy of the photos" elsewhere
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

resized() {
    "$batch" photos --reference refs -o small --resize 48 --crop 32x40 -q &&
        [ "$(oiiotool --info small/1.exr | sed 's/.*: *\([0-9]* x *[0-9]*\).*/\1/')" = "32 x   40" ] || return 1
    "$batch" photos/street --reference refs/a.dng -o random --per-image 2 --crop random:40 -q && ! cmp -s random/1_0.exr random/1_1.exr &&
        says 1 "crop '999': the photo has only" "$batch" photos/street --reference refs -o large --crop 999
}
check "photos are resized and cropped first" resized
like_oiiotool() { # the photo resized by oiiotool, then srisptool: within the rounding of the TIFF in between
    oiiotool photos/street/2.png --resize 80x53 -d uint16 -o small.tif
    "$batch" photos/street --match 2.png --reference refs/a.dng -o eighty --resize 80x53 --depth float -q &&
        "$batch" small.tif --reference refs/a.dng -o eighty_tif --depth float -q &&
        idiff -fail 3e-4 -warn 1 eighty/2.exr eighty_tif/small.exr
}
check "as oiiotool resizes them" like_oiiotool
annotations() {
    cp -r photos labelled && echo '{}' >labelled/street/1.json && echo 0 >labelled/1.txt
    "$batch" labelled --reference refs -o labels --copy '*.json,*.txt' >copied.txt && grep -q "3 other files copied" copied.txt &&
        cmp labelled/street/1.json labels/street/1.json && cmp labelled/1.txt labels/1.txt || return 1
    "$batch" labelled --reference refs -o labels --copy '*.json,*.txt' | grep -q "0 made, 12 done before, 0 failed$" || return 1
    echo 1 >labels/1.txt
    says 1 "exists and differs" "$batch" labelled --reference refs -o labels --copy '*.txt'
}
check "annotations are copied" annotations
shots() {
    "$batch" photos --reference refs -o shots --hold --per-image 2 --brightness sample -q && /usr/bin/python3 - <<'P'
import collections, json, os
of = collections.defaultdict(set)
for line in open("shots/manifest/all.jsonl"):
    line = json.loads(line)
    of[os.path.dirname(line["photo"]), line["copy"]].add((json.dumps(line["parameters"]), line["reference"]))
assert sorted(of) == [("", 0), ("", 1), ("street", 0), ("street", 1)], list(of)
assert all(len(each) == 1 for each in of.values()), "photos of a shot differ"
assert len(set.union(*of.values())) == 4, "all shots are alike"
P
}
check "folders are shots" shots
shot_shards() {
    for shard in 0 1 2; do "$batch" photos --reference refs -o shot_shards --hold --per-image 2 --brightness sample -q --shard $shard/3 || return 1; done
    same_results shots shot_shards
}
check "shots stay whole in shards" shot_shards
compressed() {
    "$batch" photos/street --reference refs/a.dng -o piz --compression piz -q && oiiotool --info -v piz/1.exr | grep -q 'compression: "piz"'
}
check "another compression" compressed

merged() {
    cp -r shards merged && "$batch" --merge merged -q && [ "$(ls merged/manifest/*.jsonl)" = merged/manifest/all.jsonl ] &&
        [ "$(wc -l <merged/manifest/all.jsonl)" -eq 12 ] && "$batch" --verify merged | grep -q "12 results compared, 0 missing" &&
        summary 0 12 0 "$batch" photos --reference refs -o merged
}
check "manifests of shards become one" merged
incomplete() {
    "$batch" photos --reference refs -o part -q --shard 0/3 || return 1
    says 1 "was planned, and is not made" "$batch" --verify part
}
check "a set that lacks a shard is not complete" incomplete
redone() {
    cp -r shots redo && echo damaged >redo/street/4_1.exr && exits 1 "$batch" --verify redo -q 2>/dev/null || return 1
    "$batch" --redo redo/street/4_1.exr -q && same_results shots redo || return 1
    "$batch" --redo redo/manifest/all.jsonl:5 -o again.exr | grep -q "'again.exr' is made again, to the bit" || return 1
    cmp again.exr "shots/$(sed -n 5p redo/manifest/all.jsonl | sed 's/.*"output":"\([^"]*\).*/\1/')"
}
check "one result again, to the bit" redone
redone_from_damaged_line() {
    sed -i 's/"photo_hash":"[^"]*"/"photo_hash":3/' redo/manifest/all.jsonl
    says 1 "has changed since" "$batch" --redo redo/street/4_1.exr
}
check "a line whose hash is none is not taken for the photo's" redone_from_damaged_line
redone_noise() { "$batch" --redo copies/3_1.npy -o again.npy -q && cmp copies/3_1.npy again.npy && "$batch" --redo dngs/2.dng -o again.dng -q && cmp dngs/2.dng again.dng; }
check "with its noise" redone_noise
redone_by_srisptool() {
    /usr/bin/python3 - <<'P'
import json
for line in open("out/manifest/all.jsonl"):
    line = json.loads(line)
    if line["output"] == "street/3.exr":
        json.dump(line["parameters"], open("street3.json", "w"))
P
    "$tool" photos/street/3.png --srisp-unprocess:params=street3.json refs/a.dng -d half -o tool3.exr && same tool3.exr out/street/3.exr
}
check "and by srisptool from the recorded parameters" redone_by_srisptool
changed_since() {
    cp -r photos moved && "$batch" moved --reference refs -o moved_out -q && cp moved/2.jpg moved/1.jpg || return 1
    says 1 "photo 'moved/1.jpg' has changed since" "$batch" --redo moved_out/1.exr || return 1
    summary 0 12 0 "$batch" moved --reference refs -o moved_out && summary 1 11 0 "$batch" moved --reference refs -o moved_out --check
}
check "a photo that has changed is found by --redo and --check" changed_since
check "a line that is not there" says 1 "is not in the manifest" "$batch" --redo out/manifest/all.jsonl:99
check "a result that is not there" says 1 "is not in the manifest" "$batch" --redo out/9.exr
check "a folder without a manifest" says 1 "has no manifest" "$batch" --merge photos

dry() {
    "$batch" photos --reference refs -o dry --dry-run --photos-per-shard 5 >dry.txt && [ ! -e dry ] || return 1
    grep -q "12 results, of which 0 are done; nothing was made" dry.txt && grep -q "about .* s and .* [kM]B, by 12 of them" dry.txt &&
        grep -q "3 shards of about 5 photos: sbatch --array=0-2" dry.txt && nothing_left
}
check "a dry run makes nothing, and says how long and how much it would be" dry
events() {
    cp -r photos events && echo broken >events/bad.jpg
    exits 1 "$batch" events --reference refs -o events_out --json >events.txt || return 1
    /usr/bin/python3 - <<'P'
import json
events = [json.loads(line) for line in open("events.txt")]
kinds = [event["event"] for event in events]
assert kinds[0] == "started" and kinds[-1] == "finished" and kinds.count("failed") == 1, kinds
assert events[0]["results"] == 13 and events[-1]["made"] == 12 and events[-1]["failed"] == 1, events
assert [event for event in events if event["event"] == "failed"][0]["photo"] == "bad.jpg"
P
}
check "events as lines of JSON" events
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
finish
