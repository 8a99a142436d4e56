#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# srispbake from end to end: what it writes and prints, what it refuses, what it leaves.
. "$(dirname "$0")/setup.sh"
bake=$build/bin/srispbake
unset SRISP_BAKE_PATH

# no_bakes: nothing of a bake is left, not even half of it.
no_bakes() {
    [ -z "$(find . -name '*.clf*' -o -name '*.cube*')" ] && return 0
    find . -name '*.clf*' -o -name '*.cube*'
    return 1
}
# refuses CODE TEXT WORDS…
refuses() {
    expected=$1 text=$2
    shift 2
    says "$expected" "$text" "$bake" "$@" && no_bakes
}

head -c 20000 "$reference" >truncated.dng
head -c 1000 "$photo" >truncated.jpg
echo "{" >broken.json
"$tool" "$photo" --srisp-params:model=spatial "$reference" 2>/dev/null >spatial.json
"$tool" "$photo" --srisp-params "$reference" 2>/dev/null >look.json
check "nothing to bake" refuses 2 "no reference is given"
check "an unknown option" refuses 2 "--refrence" --refrence x
check "a LUT size that no host takes" refuses 2 "not in range 5 to 129" --reference "$reference" --lut-size 200
check "no such reference" refuses 1 "no.dng" --reference no.dng -o x
check "an empty name" refuses 2 "no reference is given" --reference ""
check "a truncated reference" refuses 1 "truncated.dng" --reference truncated.dng
check "a photo as reference" refuses 1 "photo.jpg" --reference "$photo" -o x
check "no such photo" refuses 1 "photo 'no.jpg': does not exist" --reference "$reference" --source no.jpg
check "a truncated photo" refuses 1 "truncated.jpg" --reference "$reference" --source truncated.jpg
check "no such model" refuses 1 "unknown model 'defalt'; did you mean 'default'?" --reference "$reference" --model defalt
check "a model that looks at neighbours" refuses 1 \
    "'spatial' looks at 3 x 3 pixels, and a colour transform sees one: needs a model with kernel size 1, such as 'default'" \
    --reference "$reference" --model spatial
check "broken parameters" refuses 1 "broken.json" --params broken.json -o x
check "no such parameters" refuses 1 "no.json" --params no.json -o x
check "parameters of the other model" refuses 1 "--srisp-params:model=default REFERENCE prints such" --params spatial.json -o x
check "a brightness that is none" refuses 2 "brightness 'dark' is neither a number of EV" --params look.json --brightness dark -o x
check "no such folder" refuses 1 "nowhere/x.unprocess.clf" --reference "$reference" -o nowhere/x
check "--help is on stdout" sh -c '"$1" --help | grep -q -- --lut-size' - "$bake"

prints_errors() {
    "$bake" --reference "$reference" --source "$photo" >report.txt || return 1
    cat report.txt
    grep -c "^  Error against srisptool's pixels: over a grid of colours largest [0-9.e-]*, mean [0-9.e-]*; over $photo " \
        report.txt | grep -qx 3 &&
        grep -qF "In the host: SRISP_REFERENCE=$reference" report.txt
}
check "a bake prints its errors, and what to set" prints_errors
check "it lies beside the reference" [ -s "$reference.unprocess.clf" -a -s "$reference.process.clf" ]
description() {
    for direction in unprocess process; do
        line=$(grep -A 1 "$direction.clf" report.txt | sed -n 's/^ *Error against/Error against/p')
        grep -qF "<Description>$line</Description>" "$reference.$direction.clf" || return 1
    done
}
check "the printed errors are in the file's description" description
check "and the parameters" grep -q "Parameters: .*white_balance.*xxh128" "$reference.unprocess.clf"
small_errors() {
    "$bake" --reference "$reference" --source "$photo" --json >report.json || return 1
    /usr/bin/python3 - <<'P'
import json
report = json.load(open("report.json"))
files = {file["direction"]: file for file in report["files"]}
assert list(files) == ["unprocess", "process", "develop"], report
for kind in ("unprocess", "process"):
    assert 0 < files[kind]["error_over_grid"]["largest"] < 1e-3, files
    assert 0 < files[kind]["error_over_photo"]["largest"] <= 2e-4, files
assert files["develop"]["error_over_grid"]["largest"] <= 1e-6, files
P
}
check "--json has the errors, and they are small" small_errors
cp "$reference.unprocess.clf" first.clf.kept
"$bake" --reference "$reference" --source "$photo" -q --threads 1
check "the same input gives the same file, with any number of threads" cmp first.clf.kept "$reference.unprocess.clf"
check "without a photo, the reference's own rendition is taken" sh -c \
    '"$1" --reference "$2" | grep -q "neutral rendition"' - "$bake" "$reference"
replayed() {
    "$bake" --reference "$reference" --source "$photo" -q && "$bake" --params look.json -o replay -q || return 1
    ociolut() { sed '/<Description>/d' "$1"; }
    ociolut "$reference.unprocess.clf" >a.txt
    ociolut replay.unprocess.clf >b.txt
    cmp a.txt b.txt
}
check "parameters that srisptool printed replay to the same table" replayed
brighter() {
    for seed in 1 2 3; do
        "$bake" --params look.json --brightness sample --seed $((seed % 2)) -o "drawn$seed" --lut-size 5 >/dev/null 2>"notes$seed.txt" || return 1
    done
    "$bake" --params look.json --brightness +1 -o bright -q --lut-size 5 && grep -q "brightness_ev[^,]*: 1," bright.unprocess.clf &&
        grep -q "parameters 'look.json': a brightness of [-+][0-9.]* EV was drawn" notes1.txt &&
        cmp drawn1.unprocess.clf drawn3.unprocess.clf && ! cmp -s drawn1.unprocess.clf drawn2.unprocess.clf
}
check "a bake of another brightness, given or drawn by a seed" brighter
one_file() {
    "$bake" --params look.json -o one.clf -q --lut-size 17 --direction process && [ ! -e one.unprocess.clf ] &&
        grep -q 'id="srisp-process"' one.clf && grep -q 'dim="17 17 17 3"' one.clf
}
check "one file, of the size and in the direction that are asked for" one_file
development() {
    "$bake" --params look.json -o d.clf --direction develop --whitebalance 2,1,1.5 --highlights keep >report.txt 2>notes.txt &&
        grep -q 'id="srisp-develop"' d.clf && ! grep -q Range d.clf && grep -q "the one of the parameters was taken" notes.txt
}
check "a development alone, and the note that it has no camera's matrix" development
cubes() {
    "$bake" --params look.json -o c --cube --lut-size 21 >report.txt &&
        grep -q "^LUT_3D_SIZE 21$" c.unprocess.cube && [ "$(grep -cE '^[0-9.e-]+ [0-9.e-]+ [0-9.e-]+$' c.process.cube)" -eq 9261 ] &&
        [ "$(grep -c 'Error against' report.txt)" -eq 5 ] && grep -q "^# Error against" c.unprocess.cube
}
check ".cube files beside, with their own errors" cubes

names() {
    for name in "two words" "pay \$100" "50%20d" "größe" "a&b<c>" "it's" '"'; do
        cp "$reference" "r $name.dng"
        "$bake" --reference "r $name.dng" --source "$photo" -q --lut-size 9 2>warnings.txt || return 1
        [ -s "r $name.dng.process.clf" ] || return 1
        /usr/bin/python3 -c "import sys, xml.etree.ElementTree as x; x.parse(sys.argv[1])" "r $name.dng.unprocess.clf" || return 1
        case $name in *[$%]*) grep -q "may take for a variable" warnings.txt || return 1 ;; esac
    done
}
check "references with odd names; '\$' and '%' are warned of" names

# Bytes that are no UTF-8, control characters, and what XML and comments would end at.
hostile_names() {
    /usr/bin/python3 - "$bake" "$reference" "$photo" look.json <<'P'
import json, os, shutil, subprocess, sys
import xml.etree.ElementTree as xml
bake, reference, photo, look = (os.fsencode(a) for a in sys.argv[1:])
names = [b"gr\xf6\xdfe", b"\xff\xfe", b"\xed\xa0\x80", b"cut \xe2\x82", b"a\x01b", b"new\nline", b"\x7f", b"a--b", b"]]>",
         b"-->", b"<![CDATA[", b"&amp;", b'"q\'', b"tab\t", b"\xef\xbf\xbe", b"\xef\xbf\xbf", b"\xc0\xaf"]
for name in names:
    shutil.copy(reference, name + b".dng")
    shutil.copy(photo, name + b".jpg")
    run = subprocess.run([bake, "--reference", name + b".dng", "--source", name + b".jpg", "--cube", "--lut-size", "5", "--json"],
                         stdout=subprocess.PIPE, check=True)
    assert len(json.loads(run.stdout)["files"]) == 5
    for end in (b".unprocess", b".process"):
        text = open(name + b".dng" + end + b".clf", "rb").read()
        root = xml.fromstring(text)
        assert root.find("Description").text.strip()
        assert any(d.text.startswith("Reference: ") for d in root.findall("Description")), name
        open(name + b".dng" + end + b".cube", encoding="utf-8").read()
        subprocess.run([bake, "--reference", name + b".dng", "--lut-size", "5", "-q"], check=True)  # its own is known again
        for each in (b".clf", b".cube"):
            os.remove(name + b".dng" + end + each)
        shutil.rmtree(b"none", ignore_errors=True)
    os.remove(name + b".dng.develop.clf")
P
}
check "names of any bytes give well-formed files" hostile_names

# A fragment that fails leaves nothing; a folder for -o is not made.
fragments() {
    mkdir -p cfg && cd cfg || return 1
    cat >config.ocio <<'CONFIG'
ocio_profile_version: 2
search_path: luts/deep
roles:
  aces_interchange: ACES2065-1
  default: ACES2065-1
  scene_linear: ACES2065-1
file_rules:
- !<Rule> {name: Default, colorspace: default}
displays:
  d:
  - !<View> {name: v, colorspace: ACES2065-1}
colorspaces:
- !<ColorSpace>
  name: ACES2065-1
CONFIG
    says 1 "no/such" "$bake" --fragment config.ocio -o no/such/out.ocio || return 1
    [ "$(ls)" = config.ocio ] || { ls; return 1; }
    mkdir out.ocio # an output that cannot be taken
    says 1 "out.ocio" "$bake" --fragment config.ocio -o out.ocio || return 1
    [ "$(ls | tr '\n' ' ')" = "config.ocio out.ocio " ] || { ls; return 1; }
    "$bake" --fragment config.ocio -o /dev/fd/1 -q >copy.ocio || return 1
    grep -q "srisp unprocess" copy.ocio && [ "$(ls luts/deep | wc -l)" -eq 3 ] && [ ! -e /dev/fd/luts ]
}
fragment_case() { (fragments); }
check "a fragment that fails leaves no file and no folder" fragment_case

shared_bakes() {
    mkdir -p bakes a b
    cp "$reference" a/r.dng
    cp "$reference" b/r.dng
    mount -t tmpfs -o size=20m tmpfs b && cp "$reference" b/r.dng && mount -o remount,ro b || return 1
    says 1 "SRISP_BAKE_PATH" "$bake" --reference b/r.dng || return 1
    export SRISP_BAKE_PATH="$scratch/bakes"
    "$bake" --reference b/r.dng --lut-size 9 -q && [ -s bakes/r.dng.unprocess.clf ] || return 1
    "$bake" --reference b/r.dng --lut-size 9 -q || return 1 # its own may be made anew
    mount --bind a/ a && mount -o remount,bind,ro a || return 1
    says 1 "is the bake of another reference" "$bake" --reference a/r.dng --lut-size 9
}
full_disk() {
    mkdir -p full && mount -t tmpfs -o size=6m tmpfs full && cp "$reference" full/r.dng || return 1
    echo old >full/r.dng.process.clf
    says 1 "full/r.dng" "$bake" --reference full/r.dng --source "$photo" || return 1
    [ "$(cat full/r.dng.process.clf)" = old ] && [ "$(ls full | wc -l)" -eq 2 ]
}
mkdir -p mounted
if mount -t tmpfs tmpfs mounted 2>/dev/null; then
    trap 'cd /; for folder in mounted a b full; do umount "$scratch/$folder" 2>/dev/null; done; rm -rf "$scratch"' EXIT
    check "bakes of read-only folders go to SRISP_BAKE_PATH, and none replaces that of another reference" shared_bakes
    unset SRISP_BAKE_PATH
    check "a full disk: a message, the old file, and nothing else" full_disk
else
    echo "SKIPPED ${0##*/}: read-only folders and full disks need mount, which is not permitted here"
fi

# wait_for COMMAND…: until it holds, 20 s at most.
wait_for() {
    for _ in $(seq 200); do "$@" && return 0; sleep 0.1; done
    return 1
}
baked() { [ "$(grep -c 'unprocess.clf' watch.log)" -ge "$1" ]; }
watched() {
    cp "$reference" w.dng
    cp look.json w.json
    "$bake" --reference w.dng --params w.json --lut-size 9 --watch >watch.log 2>watch.err &
    pid=$!
    wait_for baked 1 || return 1
    cp w.dng.unprocess.clf before.txt
    sed -i 's/"gain": [0-9.]*/"gain": 2.5/' w.json
    wait_for baked 2 && grep -q "gain&quot;: 2.5" w.dng.unprocess.clf || return 1
    echo "{" >w.json
    wait_for grep -q "w.json" watch.err || return 1
    cp look.json w.json
    wait_for baked 3 && cmp before.txt w.dng.unprocess.clf || return 1
    touch w.dng
    wait_for baked 4 || return 1
    kill -TERM $pid # a shell's background jobs ignore SIGINT
    wait $pid
    [ $? -eq 143 ]
}
check "--watch bakes again after each change, outlives errors, and ends with a signal" watched
finish
