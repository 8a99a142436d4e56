#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Prints a hash of each output of a set of commands: tool, plugin, bakes, packs, and a short training. Run it before and
# after a change that is to change no behaviour, and compare. Not a test: hashes differ between machines.
#   sh tests/properties/output_hashes.sh BUILD [SHARED] >hashes.txt
# SHARED: a folder whose data/photos, data/raw and data/linear are used, too.
set -eu
build=$(cd "$1" && pwd)
shared=${2:+$(cd "$2" && pwd)}
source=$(cd "$(dirname "$0")/../.." && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# Names and times are recorded in outputs: the same ones wherever build and sources lie.
stock=$(command -v oiiotool)
mkdir "$scratch/bin" "$scratch/work"
ln -s "$build"/bin/srisp* "$scratch/bin/"
PATH=$scratch/bin:$PATH
export PATH SRISP_OIIOTOOL="$stock" LC_ALL=C.UTF-8
plugins=$(dirname "$(find "$build/lib" -name srisp.imageio.so | head -n 1)")
cd "$scratch/work"
# Writers record the time where an image has none.
date="2020:01:01 00:00:00"
oiiotool "$source/configs/sample/photo.jpg" --attrib DateTime "$date" --nosoftwareattrib -o photo.jpg
cp "$source/configs/sample/reference.dng" ref.dng
for frame in 0001 0002 0003; do cp photo.jpg "shot.$frame.jpg"; done
oiiotool --create 64x48 4 --fill:color=0.5,0.25,0.1,0.5 64x24+0+0 -d uint16 --attrib DateTime "$date" --nosoftwareattrib -o alpha.png
oiiotool photo.jpg --ch R -d uint8 --nosoftwareattrib -o grey.tif
oiiotool photo.jpg --resize 300x0 --colorconvert sRGB Linear -d half --nosoftwareattrib -o linear.exr 2>/dev/null ||
    oiiotool photo.jpg --resize 300x0 --powc 2.2 -d half --nosoftwareattrib -o linear.exr
find . -type f -exec touch -d '2020-01-01 00:00:00 UTC' {} +

# show NAME FILE: the hash of a file, but for the path of the scratch folder.
show() { printf '%s  %s\n' "$(sed "s,$scratch,SCRATCH,g" <"$2" | sha256sum | cut -d' ' -f1)" "$1"; }
# run NAME COMMAND…: hashes of stdout, stderr (paths of the scratch folder taken out) and exit code.
run() {
    name=$1
    shift
    code=0
    "$@" >"$scratch/out" 2>"$scratch/err" || code=$?
    sed -i -e 's,srisptool.partial-[0-9a-f]*,srisptool-X,g' "$scratch/out" "$scratch/err"
    show "$name: stdout" "$scratch/out"
    show "$name: stderr, exit code $code" "$scratch/err"
}
# made NAME FILE COMMAND…
made() {
    label=$1 file=$2
    shift 2
    "$@" >/dev/null 2>"$scratch/err" || { echo "FAILED $label"; cat "$scratch/err" >&2; return 0; }
    show "$label" "$file"
}

made "tool: exr" raw.exr srisptool photo.jpg --srisp-unprocess ref.dng -o raw.exr
made "tool: 16-bit png" raw.png srisptool photo.jpg --srisp-unprocess ref.dng -o raw.png
made "tool: tif after resize" raw.tif srisptool photo.jpg --resize 50% --srisp-unprocess ref.dng -o raw.tif
made "tool: spatial" spatial.exr srisptool photo.jpg --srisp-unprocess:model=spatial ref.dng -o spatial.exr
made "tool: fast" fast.exr srisptool photo.jpg --srisp-unprocess:precision=fast ref.dng -o fast.exr
made "tool: alpha" alpha.exr srisptool alpha.png --srisp-unprocess ref.dng -o alpha.exr
made "tool: grey" grey.exr srisptool grey.tif --srisp-unprocess ref.dng -o grey.exr
made "tool: linear" fromlinear.exr srisptool linear.exr --srisp-unprocess:input=linear ref.dng -o fromlinear.exr
made "tool: half" half.exr srisptool photo.jpg --srisp-unprocess ref.dng -d half -o half.exr
made "tool: params" look.json sh -c 'srisptool photo.jpg --srisp-params ref.dng >look.json'
made "tool: saved params" saved.json srisptool photo.jpg --srisp-unprocess ref.dng --srisp-save-params saved.json -o x.exr
made "tool: replayed" replayed.exr srisptool grey.tif --srisp-unprocess:params=look.json - -o replayed.exr
made "tool: process" again.png srisptool raw.exr --srisp-process -d uint8 -o again.png
made "tool: process fast" again_fast.exr srisptool raw.exr --srisp-process:precision=fast -o again_fast.exr
srisptool --frames 1-3 shot.#.jpg --srisp-unprocess:hold=1 ref.dng -o frame.#.exr 2>/dev/null
for frame in 0001 0003; do show "tool: frame $frame" frame.$frame.exr; done
made "tool: list of references" list.exr srisptool photo.jpg --srisp-unprocess:seed=7 'ref.dng;raw.exr;spatial.exr' -o list.exr
export OIIO_LIBRARY_PATH="$plugins"
made "plugin: query" query.exr "$stock" -i:now=1 "photo.jpg.srisp?reference=ref.dng&seed=3" -o query.exr
run "plugin: iinfo" iinfo -v "photo.jpg.srisp?reference=ref.dng"
echo '{ "format": "srisp-recipe-1", "source": "photo.jpg", "reference": ["ref.dng", "raw.exr"], "input": "srgb" }' >look.srisp
made "plugin: recipe" recipe.exr "$stock" -i:now=1 look.srisp -o recipe.exr
unset OIIO_LIBRARY_PATH
run "bake: report" srispbake --reference ref.dng --source photo.jpg
for file in ref.dng.unprocess.clf ref.dng.process.clf; do [ ! -f $file ] || show "bake: $file" $file; done
run "bake: cube" srispbake --reference ref.dng --source photo.jpg --cube -o baked
for file in baked.*; do [ ! -f "$file" ] || show "bake: $file" "$file"; done
for word in '' --help --srisp-unprocess:sed=1 --srisp-unprocess:input=x --srisp-unprocess:hold=2 --srisp-unproces; do
    run "tool: words '$word'" srisptool photo.jpg $word ref.dng -o y.exr
done
run "tool: no reference" srisptool photo.jpg --srisp-unprocess none.dng -o y.exr
run "tool: photo as reference" srisptool photo.jpg --srisp-unprocess photo.jpg -o y.exr
run "bake: no photo" srispbake --reference ref.dng --source none.jpg

mkdir set
cp photo.jpg ref.dng set/
[ -z "$shared" ] || cp "$shared"/data/photos/000*.jpg set/
srisppack set -o pack --size 64 --crops 2 >/dev/null 2>&1
for file in pack/*; do show "pack: $file" "$file"; done
if [ -x "$build/bin/srisptrain" ]; then
    "$build/bin/small_pack" training >/dev/null
    echo '{ "base": "default", "description": "hashes", "pack": "training", "steps": 6, "pairs": 2, "unpaired": 2,
        "log_every": 1, "validate_every": 3, "data": { "image_size": 32 }, "anchor_fit": { "pairs": 32, "steps": 20 },
        "mean_teacher": { "start": 0.3 }, "validation": { "set": { "real_images": 1, "simulated_images": 2 } } }' >tiny.json
    srisptrain tiny.json -o trained --threads 1 >/dev/null 2>&1
    cut -d, -f1,4 trained/log.csv >losses.csv
    show "training: losses" losses.csv
    # Tensors only: the metadata names the commit.
    tail -c +$(($(od -An -t u8 -N 8 trained/best.safetensors) + 9)) trained/best.safetensors >tensors
    show "training: tensors" tensors
    made "evaluation" scores.json sh -c "srispeval --pack training '$source/configs/models/spatial.safetensors' --json >scores.json"
fi
[ -n "$shared" ] || exit 0
for raw in "$shared"/data/raw/*.*; do
    case $raw in *.md | *.json | *.txt) continue ;; esac
    cp "$raw" "reference.${raw##*.}"
    run "params by $(basename "$raw")" srisptool photo.jpg --srisp-params "reference.${raw##*.}"
done
count=0
for photo in "$shared"/data/photos/*.jpg; do
    [ $((count % 20)) -ne 0 ] || {
        cp "$photo" p.jpg
        touch -d '2020-01-01 00:00:00 UTC' p.jpg
        made "photo $(basename "$photo")" p.exr srisptool p.jpg --srisp-unprocess ref.dng -o p.exr
    }
    count=$((count + 1))
done
