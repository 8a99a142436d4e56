#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# One clear message, exit code 1 or 2, no output left or overwritten.
. "$(dirname "$0")/setup.sh"

# refuses CODE TEXT WORDS…: the output raw.exr, written before, stays as it is.
refuses() {
    expected=$1 text=$2
    shift 2
    echo old >raw.exr
    says "$expected" "$text" "$tool" "$@" -o raw.exr || return 1
    [ "$(cat raw.exr)" = old ] || { echo "raw.exr was overwritten"; return 1; }
    rm raw.exr
    says "$expected" "$text" "$tool" "$@" -o raw.exr || return 1
    [ ! -e raw.exr ] || { echo "raw.exr is left"; return 1; }
    [ -z "$(find . -name '*.temp.*')" ]
}

# tells LINE WORDS…: that line is all there is on stderr.
tells() {
    printf '%s\n' "$1" >expected.txt
    shift
    exits 1 "$tool" "$@" 2>stderr.txt || return 1
    cmp expected.txt stderr.txt || { cat stderr.txt; return 1; }
}

head -c 20000 "$reference" >truncated.dng
head -c 200000 "$source/configs/models/default.safetensors" >truncated.safetensors
head -c 1000 "$photo" >truncated.jpg
echo "{" >broken.json
mkdir folder empty
cp "$photo" "$reference" folder
check "no such reference" refuses 1 "reference 'no.dng' does not exist" "$photo" --srisp-unprocess no.dng
check "no such photo" refuses 1 "no.jpg" no.jpg --srisp-unprocess "$reference"
check "no image" refuses 1 "--srisp-unprocess: no image before it" --srisp-unprocess "$reference"
check "all images gone" refuses 1 "" "$photo" --pop --srisp-unprocess "$reference"
check "no such model" refuses 2 "did you mean 'spatial'?" "$photo" --srisp-unprocess:model=spatail "$reference"
check "no such model file" refuses 1 "does not exist" "$photo" --srisp-unprocess:model=./no.safetensors "$reference"
check "truncated model" refuses 1 "truncated.safetensors" "$photo" --srisp-unprocess:model=truncated.safetensors "$reference"
check "no such parameters" refuses 1 "no.json" "$photo" --srisp-unprocess:params=no.json -
check "broken parameters" refuses 1 "broken.json" "$photo" --srisp-unprocess:params=broken.json -
check "no reference and no parameters" refuses 2 "params=FILE" "$photo" --srisp-unprocess -
check "unknown modifier" refuses 2 "did you mean 'model'?" "$photo" --srisp-unprocess:modell=default "$reference"
check "unknown command" refuses 2 "did you mean '--srisp-unprocess'" "$photo" --srisp-unproces "$reference"
check "a photo as reference" refuses 1 "photo.jpg" "$photo" --srisp-unprocess "$photo"
check "a truncated reference" refuses 1 "truncated.dng" "$photo" --srisp-unprocess truncated.dng
check "a truncated reference, by hand-over" refuses 1 "truncated.dng" "$photo" --flip --srisp-unprocess truncated.dng
check "an empty folder as reference" refuses 1 "empty" "$photo" --srisp-unprocess empty
check "a folder as photo" refuses 1 "folder" folder --srisp-unprocess "$reference"
check "a folder as model" refuses 1 "folder" "$photo" --srisp-unprocess:model=./folder "$reference"
echo text >text.jpg
no_jpeg="is not an image that OpenImageIO reads"
check "one line on a photo" tells "srisptool: ERROR: photo 'text.jpg': $no_jpeg" text.jpg --srisp-unprocess "$reference" -o raw.exr
check "and where it is only read" tells "srisptool: ERROR: image 'text.jpg': $no_jpeg" text.jpg --flip --srisp-params "$reference"
cp "$photo" s.0001.jpg
cp text.jpg s.0002.jpg
check "and on a frame" tells "srisptool: ERROR: photo 's.0002.jpg': $no_jpeg" "s.#.jpg" --srisp-unprocess "$reference" -o "raw.#.sgi"
check "one line on an image in the middle" tells \
    "srisptool: ERROR: image '$photo': is not a RAW-like image of srisp's, so it records no parameters; give params=" \
    "$photo" --flip --srisp-process -o raw.exr
check "one line where there is no image" tells "srisptool: ERROR: --srisp-unprocess: no image before it" \
    "$photo" --pop --srisp-unprocess "$reference" -o raw.exr
check "one line of oiiotool's own" tells "oiiotool ERROR: -o : Could not open \"no/x.exr\" (No such file or directory)" \
    "$photo" --srisp-unprocess "$reference" -o no/x.exr
check "errors on stdout where the user wants them there" sh -c \
    "'$tool' --nostderr '$photo' --srisp-process 2>&1 >out.txt | cmp - /dev/null && grep -q '^srisptool: ERROR: image' out.txt"
check "an argument of oiiotool's missing" says 2 "--resize lacks an argument" "$tool" "$photo" --srisp-process --resize
check "CMYK" sh -c "oiiotool '$photo' --ch R,G,B,A=0 -o:separate=0 rgba.tif"
check "unknown oiiotool command" refuses 1 "Invalid option" "$photo" --srisp-unprocess "$reference" --no-such-command
check "folder of the output missing" says 1 "no/such" "$tool" "$photo" --srisp-unprocess "$reference" -o no/such/raw.exr
check "folder of saved parameters missing" refuses 1 "no/p.json" "$photo" --srisp-unprocess "$reference" --srisp-save-params no/p.json
check "an argument missing" says 2 "needs an argument: REF" "$tool" "$photo" --srisp-unprocess
check "a name that cannot be written back is no silent loss" exits 1 "$tool" "$photo" --srisp-unprocess "$reference" -o "{TOP.filename}.exr"
check "a folder as reference stands for its RAW files, not for its photos" exits 0 \
    "$tool" "$photo" --srisp-unprocess folder -o chosen.exr
$tool "$photo" --srisp-unprocess "$reference" -o plain.exr
check "which is the same" same chosen.exr plain.exr
check "nothing is left" nothing_left
finish
