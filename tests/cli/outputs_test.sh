#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# What outputs may not do: replace a device, an input, what a link leads to, or what another run is at; and many runs at once.
. "$(dirname "$0")/setup.sh"
bake=$build/bin/srispbake srisppack=$build/bin/srisppack
"$tool" "$photo" --srisp-unprocess "$reference" -o raw.exr --srisp-save-params good.json || exit 1
"$tool" "$photo" --srisp-params "$reference" >look.json || exit 1

# Devices and pipes.
null() {
    "$tool" "$photo" --srisp-unprocess "$reference" --srisp-save-params "$1" -o out.exr && [ -c /dev/null ]
}
# By links: a mistake of ours would cost a superuser's machine its devices.
for name in null full stdout; do ln -s /dev/$name $name.json; done
check "parameters saved to /dev/null" null null.json
check "which stays a link" [ -L null.json ]
device() { mknod device.json c 1 3 2>/dev/null || return 0; null device.json && [ -c device.json ]; }
check "parameters saved to a device of any name" device
to_stdout() {
    "$tool" "$photo" --srisp-unprocess "$reference" --srisp-save-params "$1" -o out.exr | cmp - good.json &&
        "$tool" "$photo" --srisp-unprocess "$reference" --srisp-save-params "$1" -o out.exr >out.json && cmp out.json good.json
}
check "parameters saved to /dev/stdout" to_stdout stdout.json
check "parameters saved to /dev/fd/1" to_stdout /dev/fd/1
numbered() {
    "$tool" "$photo" --srisp-unprocess "$reference" --srisp-save-params /dev/fd/9 -o out.exr 9>nine.json && cmp nine.json good.json
}
check "parameters saved to another descriptor" numbered
# through PIPE EXPECTED COMMAND…
through() {
    pipe=$1 expected=$2
    shift 2
    mkfifo "$pipe"
    timeout 60 cat "$pipe" >got &
    timeout 60 "$@" || return 1
    wait
    [ -p "$pipe" ] && cmp got "$expected"
}
check "parameters saved to a pipe" through p.json good.json \
    "$tool" "$photo" --srisp-unprocess "$reference" --srisp-save-params p.json -o out.exr
"$bake" --params look.json --lut-size 9 -o look.clf -q
check "a bake to a pipe" through pipe.clf look.clf "$bake" --params look.json --lut-size 9 -o pipe.clf -q
check "a bake to a pipe of any name" through pipe look.clf "$bake" --params look.json --lut-size 9 -o pipe -q
baked_to_stdout() { "$bake" --params look.json --lut-size 9 -o /dev/fd/1 -q | cmp - look.clf; }
check "a bake to stdout" baked_to_stdout
image_pipe() {
    "$tool" "$photo" --srisp-unprocess "$reference" -o raw.png || return 1
    mkfifo pipe.png
    timeout 60 cat pipe.png >got.png &
    timeout 60 "$tool" "$photo" --srisp-unprocess "$reference" -o pipe.png || return 1
    wait
    [ -p pipe.png ] && same got.png raw.png
}
check "an image to a pipe" image_pipe
full_device() { says 1 "full.json' cannot be written: No space left on device" "$tool" "$photo" --srisp-unprocess "$reference" --srisp-save-params full.json -o x.exr && [ -L full.json ]; }
check "a full device" full_device

# Inputs. keeps FILE WORDS…: the line is refused in one line before any work, FILE stays.
keeps() {
    file=$1
    shift
    before=$(cksum <"$file")
    rm -f made.exr
    says 1 "inputs are never overwritten" "$@" || return 1
    [ "$(wc -l <"$scratch/stderr")" -eq 1 ] && [ ! -e made.exr ] && [ "$(cksum <"$file")" = "$before" ]
}
mkdir folder refs
cp "$reference" refs/a.dng
cp "$reference" refs/b.dng
cp "$reference" ref.dng
cp "$source/configs/models/default.safetensors" model.safetensors
cp good.json p.json.kept
for other in link.exr hard.exr ./photo.jpg folder/../photo.jpg "$scratch/photo.jpg"; do
    case $other in link*) ln -s photo.jpg link.exr ;; hard*) ln photo.jpg hard.exr ;; esac
    check "an output that is the photo, as $other" keeps photo.jpg "$tool" photo.jpg --srisp-unprocess ref.dng -o made.exr -o "$other"
done
check "-o with modifiers" keeps photo.jpg "$tool" photo.jpg --srisp-unprocess ref.dng -o:datatype=uint8 photo.jpg
check "-otex" keeps photo.jpg "$tool" photo.jpg --srisp-unprocess ref.dng -otex photo.jpg
check "a photo by -i, changed before" keeps photo.jpg "$tool" -i photo.jpg --flip --srisp-unprocess ref.dng -o made.exr -o photo.jpg
check "a reference" keeps ref.dng "$tool" photo.jpg --srisp-unprocess ref.dng -o made.exr -o ref.dng
check "a reference under saved parameters" keeps ref.dng "$tool" photo.jpg --srisp-unprocess ref.dng -o made.exr --srisp-save-params ref.dng
check "a reference of a folder" keeps refs/b.dng "$tool" photo.jpg --srisp-unprocess refs -o made.exr --srisp-save-params refs/b.dng
check "a reference of a pattern" keeps refs/b.dng "$tool" photo.jpg --srisp-unprocess "refs/*.dng" -o made.exr --srisp-save-params refs/b.dng
check "a reference of a list" keeps refs/b.dng "$tool" photo.jpg --srisp-unprocess "ref.dng;refs/b.dng" -o made.exr --srisp-save-params refs/b.dng
check "a model" keeps model.safetensors "$tool" photo.jpg --srisp-unprocess:model=model.safetensors ref.dng -o made.exr --srisp-save-params model.safetensors
check "parameters" keeps good.json "$tool" photo.jpg --srisp-unprocess:params=good.json - -o made.exr --srisp-save-params good.json
check "a RAW-like image" keeps raw.exr "$tool" raw.exr --srisp-process -o raw.exr
check "an image whose parameters are printed" keeps photo.jpg "$tool" photo.jpg --srisp-params ref.dng --flip -o photo.jpg
printf '{"format":"srisp-recipe-1","source":"photo.jpg","reference":"ref.dng"}' >r.srisp
for file in r.srisp photo.jpg ref.dng; do
    check "$file of a recipe" keeps $file "$tool" r.srisp --srisp-params ref.dng -o made.exr --srisp-save-params $file
done
for frame in 1 2; do cp photo.jpg s.000$frame.jpg; done
check "frames" keeps s.0002.jpg "$tool" "s.#.jpg" --srisp-unprocess ref.dng -o "s.#.jpg"
check "one frame" keeps s.0002.jpg "$tool" "s.#.jpg" --srisp-unprocess ref.dng -o s.0002.jpg
printf '%s' '{"width": 64, "height": 64, "cfa": "RGGB", "bits": 16, "black": 0, "white": 65535}' >plain.json
/usr/bin/python3 -c "import sys; sys.stdout.buffer.write(bytes((i * 7) % 251 for i in range(8192)))" >plain.raw
check "the description of plain samples" keeps plain.json "$tool" photo.jpg --srisp-unprocess plain.raw -o made.exr --srisp-save-params plain.json
beside() { "$tool" photo.jpg --srisp-unprocess ref.dng --srisp-save-params ref.json && "$tool" photo.jpg --srisp-unprocess ref.dng --srisp-save-params ref.json; }
check "parameters beside a reference may be saved again" beside
in_between() {
    for _ in 1 2; do "$tool" photo.jpg --flip -o between.jpg between.jpg --srisp-unprocess ref.dng -o made.exr || return 1; done
}
check "an image that the line writes before it reads it" in_between
as_stock() { cp photo.jpg mine.jpg && "$tool" photo.jpg --srisp-unprocess ref.dng -o made.exr mine.jpg --flip -o mine.jpg && ! cmp -s photo.jpg mine.jpg; }
check "what only oiiotool reads may be written to, as with it" as_stock
stock_line() { cp photo.jpg mine.jpg && "$tool" mine.jpg --flip -o mine.jpg && ! cmp -s photo.jpg mine.jpg; }
check "and lines without commands of ours" stock_line

cp ref.dng ref.clf
check "srispbake: the reference" keeps ref.clf "$bake" --reference ref.clf -o ref.clf
cp photo.jpg photo.clf
ln look.json look.json.clf
check "srispbake: the photo" keeps photo.clf "$bake" --reference ref.dng --source photo.clf -o photo.clf
check "srispbake: parameters, by a hard link" keeps look.json "$bake" --params look.json -o look.json.clf
mkdir sets
cp photo.jpg sets
"$srisppack" sets -o pack --size 32 -q >/dev/null || exit 1
ln -s ../pack/photos.safetensors sets/photos.safetensors
check "srisppack: a file of the pack that is replaced" keeps pack/photos.safetensors "$srisppack" sets -o pack --size 32 --replace
rm sets/photos.safetensors

# Packs: nothing but a pack of ours is replaced.
foreign() {
    for name in notes.txt .hidden sub; do
        [ $name = sub ] && mkdir pack/sub || echo mine >pack/$name
        says 1 "exists and holds '$name', which is no file of the pack; it is not replaced" "$srisppack" sets -o pack --size 32 --replace || return 1
        [ -e pack/$name ] || return 1
        rm -r pack/$name
    done
    mkdir mine && echo mine >mine/photo && echo '{}' >mine/pack.json
    says 1 "it is not replaced" "$srisppack" sets -o mine --size 32 --replace && [ -e mine/photo ] || return 1
    mkdir .pack.partial-mine .pack.partial-0123456789abcdef
    echo mine >.pack.partial-mine/photo
    "$srisppack" sets -o pack --size 32 --replace -q >/dev/null && [ -e .pack.partial-mine/photo ] && [ -d .pack.partial-0123456789abcdef ]
}
check "folders that are no pack, or more than a pack, are not replaced; nor are hidden ones of a user" foreign

# Links that were put where temporary files might lie.
links() {
    echo precious >precious
    for pid in $(seq $(($$ + 1)) $(($$ + 300))); do ln -s precious p2.json.tmp-$pid; done
    "$tool" "$photo" --srisp-unprocess "$reference" --srisp-save-params p2.json -o x.exr && cmp p2.json good.json &&
        [ "$(cat precious)" = precious ]
}
check "links under guessable names are not followed" links
rm -f p2.json.tmp-*

# killed: in the middle of its work srispbake is killed, and leaves nothing.
killed() {
    for delay in 0.05 0.1 0.2 0.3 0.5; do
        timeout -s KILL $delay "$bake" --params look.json -o killed -q
    done
    rm -f killed.unprocess.clf killed.process.clf
    [ -z "$(ls -A | grep killed)" ] || { ls -A | grep killed; return 1; }
}
check "SIGKILL leaves nothing of a bake" killed

# Many at once.
together() {
    seq 200 | xargs -P 16 -n 1 sh -c '"$0" "$1" --srisp-params "$2" >"together.$3.json" 2>&1 || { echo "start $3 failed:"; cat "together.$3.json"; exit 1; }' \
        "$tool" "$photo" "$reference" || return 1
    rm -f together.*.json
    nothing_left
}
check "200 starts, 16 at a time" together
packs_together() {
    for i in $(seq 24); do "$srisppack" sets -o together --size 32 --replace -q >log.$i 2>&1 & done
    wait
    [ -s together/pack.json ] && [ -z "$(ls -A | grep together.partial)" ] && ! grep -l "cannot be made: No such\|removed\|locked" log.*
}
check "packs of one name made at once" packs_together

# A planted folder.
planted() {
    echo photo >victim.jpg
    for name in srisptool-1-ABCdef .srisptool.partial-0123456789abcdef; do
        mkdir -m 700 "$TMPDIR/$name"
        : >"$TMPDIR/$name/lock"
        printf '%s\0' "$scratch/victim.jpg" >"$TMPDIR/$name/started_outputs"
    done
    "$tool" "$photo" --srisp-unprocess "$reference" -o x.exr && [ -e victim.jpg ] || return 1
    rm -r "$TMPDIR"/* "$TMPDIR"/.srisptool*
}
check "a planted folder makes nothing go" planted
check "nothing is left" nothing_left
finish
