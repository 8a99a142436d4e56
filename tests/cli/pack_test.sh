#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# srisppack from end to end: what it packs, what it refuses and with which words, and that nothing unfinished is left.
. "$(dirname "$0")/setup.sh"

srisppack=$build/bin/srisppack
mkdir photos raws cameras cameras/sensitivities
for i in 1 2 3 4 5 6; do
    oiiotool --pattern "fill:topleft=$i,0,0:topright=0,1,0:bottomleft=0,0,1" 200x150 3 --mulc 0.15 -d uint8 -o photos/$i.png
done
cp "$photo" photos/photo.jpg
echo "no image" >photos/notes.txt
cp "$reference" raws/a.dng

# spectra COLUMNS VALUES: a spectral file of the same numbers at each wavelength, but the last of three, which rise.
spectra() {
    printf '{"header":{"manufacturer":"Anna","model":"One","license":"CC0"},"spectral_data":{"index":{"main":[%s]},"data":{"main":{' "$1"
    for w in $(seq 380 5 780); do
        printf '"%d":[%s,%s,%s]%s' "$w" "$2" "0.$((780 - w + 100))" "0.$((w * w / 1000))" "$([ "$w" = 780 ] || echo ,)"
    done
    echo '}}}}'
}
spectra '"R","G","B"' 0.5 >cameras/sensitivities/anna.json
spectra '"X","Y","Z"' 0.5 >cameras/cmf_1931.json
spectra '"a","b","c"' 0.5 >cameras/training_spectral.json
printf 'wavelength_nm,CIE_A,CIE_D_6500K\n380,1,2\n780,3,2\n' >cameras/illuminants.csv

# field FILE EXPRESSION: of a JSON file.
field() { /usr/bin/python3 -c "import json, sys; j = json.load(open(sys.argv[1])); print($2)" "$1"; }
# is A B
is() { [ "$1" = "$2" ] || { echo "'$1' is not '$2'"; return 1; }; }
# No hidden folder of a pack that was not finished.
nothing_unfinished() { [ -z "$(find . -name '.*.partial-*')" ] || { find . -name '.*.partial-*'; return 1; }; }
refused() { says "$@" && nothing_unfinished; }

packs_all() {
    "$srisppack" photos raws cameras -o all --size 64 --crops 2 --json >all.json || return 1
    is "$(field all.json "j['photos']['scenes'], j['photos']['images'], j['raws']['images'], j['other_files']")" "7 21 3 1" &&
        is "$(field all.json "j['cameras']['cameras'], j['cameras']['lights']")" "1 2" &&
        is "$(field all/pack.json "[m['name'] for m in j['photos']['images']][5:]")" "['6.png', 'photo.jpg']" &&
        is "$(field all/pack.json "sum(m['validation'] for m in j['photos']['images'])")" 1 &&
        is "$(field all/pack.json "j['settings']['crops'], j['format'], len(j['raws']['images'][0]['color'])")" "2 srisp-pack-1 9" &&
        is "$(stat -c %a all)" 755
}
umask 022
check "photos, raws and cameras are recognised by what they hold" packs_all
same_bits() {
    for threads in 1 2 3; do
        "$srisppack" photos raws cameras -o bits --size 64 --crops 2 --threads $threads --replace >/dev/null && cmp all/pack.json bits/pack.json || return 1
    done
}
check "the same bits for any number of threads, and in place of an old pack" same_bits
help() { "$srisppack" --help >out 2>err && [ -s out ] && [ ! -s err ] && "$srisppack" --version | grep -q '^srisppack [0-9]'; }
check "--help and --version on stdout" help
files() { "$srisppack" photos/1.png photos/2.png raws/a.dng -o files --json --raw-size 32 >o && is "$(field o "j['photos']['scenes'], j['raws']['size']")" "2 32"; }
check "single files" files

check "no input" refused 2 "srisppack: no input is given" "$srisppack" -o x
check "no output" refused 2 "srisppack: no output is given: -o PACK" "$srisppack" photos
check "an unknown option" refused 2 "--siez" "$srisppack" photos -o x --siez 3
check "a size out of range" refused 2 "--size: Value 16 not in range 32 to 1024" "$srisppack" photos -o x --size 16
check "a missing input" refused 1 "srisppack: input 'no' does not exist" "$srisppack" no -o x
check "an input without images" refused 1 "srisppack: the inputs hold no photos, RAW files or cameras" "$srisppack" photos/notes.txt -o x
check "two folders of cameras" refused 2 "two folders of cameras: 'cameras' and 'cameras'" "$srisppack" cameras --cameras cameras -o x
check "no folder of cameras" refused 1 "'photos' is not a folder of cameras" "$srisppack" --cameras photos -o x
check "an output in no folder" refused 1 "cannot be made: the folder '$scratch/no' does not exist" "$srisppack" photos -o no/x
check "an output that is a file" refused 1 "exists and is not a folder" "$srisppack" photos -o photos/notes.txt
check "an output that is a pack" refused 1 "exists already; --replace makes it anew" "$srisppack" photos -o all
check "an output that is another folder" refused 1 "holds no pack.json; it is not replaced" "$srisppack" photos -o photos --replace
check "--open-only without a manifest" refused 1 "--open-only leaves no image: 7 are not called open in a manifest.csv" "$srisppack" photos -o x --open-only

mkdir listed
cp photos/1.png photos/2.png photos/3.png photos/4.png listed
printf 'file,use,open,source,licence\n1.png,training,yes,me,CC0\n2.png,validation,no,"you, too",\ngone.png,training,yes,,\n3.png,training,yes,me,CC0\n' >listed/manifest.csv
manifest() {
    says 0 "srisppack: photo 'listed/gone.png': does not exist" "$srisppack" listed -o x --size 32 --replace --json >o &&
        is "$(field o "j['photos']['scenes'], j['photos']['open'], j['photos']['validation'], j['not_in_manifest'], len(j['photos']['failures'])")" "3 2 1 1 1" &&
        is "$(field x/pack.json "[(m['source'], m['licence']) for m in j['photos']['images']]")" "[('me', 'CC0'), ('you, too', 'not stated'), ('me', 'CC0')]"
}
check "a manifest gives licences and splits; what it lists and is not there is told" manifest
open_only() { "$srisppack" listed -o x --size 32 --replace --open-only 2>/dev/null | grep -qF "2 scenes, 8 images of 32 x 32 pixels; 2 scenes are open"; }
check "--open-only" open_only
check "--strict" refused 1 "srisppack: 1 photos cannot be read (--strict)" "$srisppack" listed -o strict --strict
not_strict() { [ ! -e strict ]; }
check "--strict leaves no pack" not_strict

mkdir broken
head -c 2000 photos/photo.jpg >broken/cut.jpg
echo "no PNG" >broken/text.png
oiiotool photos/1.png --resize 100x20 -o broken/small.png
: >broken/empty.jpg
check "a photo that is truncated" refused 1 "photo 'broken/cut.jpg'" "$srisppack" broken -o x2
check "a photo that is none" refused 1 "photo 'broken/text.png'" "$srisppack" broken -o x2
check "a photo that is empty" refused 1 "photo 'broken/empty.jpg'" "$srisppack" broken -o x2
check "a photo that is too small" refused 1 "photo 'broken/small.png': has 100 x 20 pixels, at least 32 a side are needed" "$srisppack" broken -o x2
check "photos none of which can be read" refused 1 "srisppack: none of the photos can be used" "$srisppack" broken -o x2
head -c 3000 raws/a.dng >broken/cut.dng
check "a RAW file that is truncated" refused 1 "reference 'broken/cut.dng'" "$srisppack" broken/cut.dng -o x2
check "a set that is damaged" refused 1 "set 'broken/set.safetensors': header of" sh -c "echo 'no safetensors' >broken/set.safetensors; exec '$srisppack' broken/set.safetensors -o x2"
damaged_cameras() {
    cp -r cameras nan && sed -i 's/"400":\[0.5/"400":[NaN/' nan/sensitivities/anna.json &&
        refused 1 "'nan/sensitivities/anna.json': file is not a JSON object" "$srisppack" nan photos -o x2
}
check "sensitivities that are not numbers" damaged_cameras
old_stays() {
    before=$(cat all/pack.json | cksum)
    ! "$srisppack" broken -o all --replace 2>/dev/null && is "$(cat all/pack.json | cksum)" "$before" && nothing_unfinished
}
check "a run that fails leaves the old pack as it was" old_stays

# interrupted SIGNAL CODE: in the middle of photos that take long.
mkdir large
oiiotool --pattern noise 6000x4000 3 -d uint8 --compression none -o large/0.tif
for i in 1 2 3 4 5 6 7 8 9; do ln large/0.tif large/$i.tif; done
interrupted() {
    /usr/bin/python3 -c "
import os, signal
for name in ('SIGINT', 'SIGTERM', 'SIGHUP'): signal.signal(getattr(signal, name), signal.SIG_DFL)
os.execv('$srisppack', ['srisppack', 'large', '-o', 'stopped'])" 2>err &
    pid=$!
    for _ in $(seq 400); do ls -d .stopped.partial-* >/dev/null 2>&1 && break; sleep 0.02; done
    sleep 0.2
    kill "-$1" $pid
    wait $pid
    is $? "$2" && [ ! -e stopped ]
}
stopped() { interrupted "$@" && nothing_unfinished && grep -q "interrupted; nothing was written" err; }
check "SIGINT leaves nothing" stopped INT 130
check "SIGTERM leaves nothing" stopped TERM 143
killed() {
    interrupted KILL 137 && ! nothing_unfinished >/dev/null &&
        ! ls .stopped.partial-*/pack.json 2>/dev/null && "$srisppack" photos -o stopped >/dev/null && nothing_unfinished
}
check "what SIGKILL leaves is no pack, and goes with the next run" killed

mkdir full read_only
if mount -t tmpfs -o size=60k tmpfs full 2>/dev/null; then
    mount -t tmpfs -o ro tmpfs read_only
    trap 'cd /; umount "$scratch/full" "$scratch/read_only"; rm -rf "$scratch"' EXIT
    full_disk() { refused 1 "No space left on device" "$srisppack" photos -o full/x --size 64 && is "$(ls -A full)" ""; }
    check "a full disk" full_disk
    check "a read-only folder" refused 1 "Read-only file system" "$srisppack" photos -o read_only/x
else
    echo "SKIPPED pack_test.sh, full disks: mounting a tmpfs is not permitted here"
fi
finish
