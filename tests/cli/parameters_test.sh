#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Parameters: printed, saved, edited, replayed; taken from outputs by --srisp-process.
. "$(dirname "$0")/setup.sh"

$tool "$photo" --srisp-unprocess "$reference" --srisp-save-params saved.json -o raw.exr
$tool "$photo" --srisp-params "$reference" >printed.json
check "--srisp-params prints one line of JSON and the image's name" \
    /usr/bin/python3 -c "import json; p = json.load(open('printed.json')); assert p.pop('image') == '$photo'; assert p == json.load(open('saved.json'))"
check "--srisp-params writes nothing else on stdout" sh -c '[ "$(wc -l <printed.json)" -eq 1 ]'
$tool "$photo" --srisp-unprocess:params=saved.json - -o replayed.exr
check "saved parameters replay to the bit" same raw.exr replayed.exr
$tool "$photo" --srisp-unprocess:params=saved.json "$reference" -o replayed.exr
check "also beside a reference" same raw.exr replayed.exr
$tool "$photo" --srisp-unprocess:params=printed.json - -o replayed.exr
check "printed parameters replay to the bit" same raw.exr replayed.exr
$tool raw.exr --srisp-save-params from_file.json -o:datatype=half half.exr
check "parameters are saved from a file made before" cmp saved.json from_file.json
/usr/bin/python3 - <<'P'
import json
p = json.load(open("saved.json"))
p["gain"] *= 2
json.dump(p, open("edited.json", "w"))
P
$tool "$photo" --srisp-unprocess:params=edited.json - -o edited.exr
check "an edited gain changes the result" sh -c '! cmp -s edited.exr raw.exr && iinfo edited.exr'

# near A B LIMIT PERCENT: at most PERCENT of the pixels differ by more than LIMIT.
near() { idiff -warn "$3" -warnpercent "$4" -fail "$3" -failpercent "$4" "$1" "$2"; }
$tool raw.exr --srisp-process -o:datatype=uint16 back.tif
# Eight bits of linear values are few: JPEG shall lose no more than that.
$tool "$photo" --srisp-unprocess "$reference" -d uint16 -o raw.tif -o raw.png \
    -d uint8 --compression jpeg:98 --attrib jpeg:subsampling 4:4:4 -o raw.jpg
for file in raw.tif raw.png raw.jpg; do
    check "$file is processed by the parameters in it" "$tool" "$file" --srisp-process -o:datatype=uint16 again.tif
    case $file in *.jpg) limit=0.25 ;; *) limit=0.01 ;; esac
    check "$file gives nearly what EXR gives" near back.tif again.tif $limit 5
done
$tool raw.exr --srisp-process:params=saved.json -o:datatype=uint16 again.tif
check "--srisp-process with the same parameters" same back.tif again.tif
check "and comes near to the photo" near "$photo" again.tif 0.05 1
check "a photo records no parameters" says 1 "records no parameters" "$tool" "$photo" --srisp-process -o no.tif
check "it names the photo" says 1 "photo.jpg" "$tool" "$photo" --dup --srisp-process -o no.tif
check "that leaves no output" [ ! -e no.tif ]
$tool "$photo" --srisp-unprocess:model=spatial "$reference" -o spatial.exr
check "model=spatial is another model" sh -c "iinfo -v spatial.exr | grep -q spatial && ! cmp -s spatial.exr raw.exr"
check "spatial parameters do not fit the default model" says 1 "model" \
    "$tool" "$photo" --srisp-params:model=spatial "$reference" --srisp-unprocess:model=default:params=edited.json - \
    --srisp-process:model=spatial -o no.tif
# Large enough for the table of a pointwise model.
$stock "$photo" --resize 400x0 -o large.tif
for model in default spatial; do
    $tool large.tif --srisp-unprocess:model=$model "$reference" -o plain.exr
    $tool large.tif --srisp-unprocess:model=$model:precision=fast "$reference" -o fast.exr
    check "precision=fast gives nearly the same with the model $model" near plain.exr fast.exr 2e-3 0
    check "but not the same" sh -c '! idiff -q -fail 0 -warn 0 plain.exr fast.exr'
done
check "another precision is refused" says 2 "unknown precision 'half'; known: float32, fast" \
    "$tool" "$photo" --srisp-unprocess:precision=half "$reference" -o no.tif

# parameter FILE KEY: a number of it.
parameter() { /usr/bin/python3 -c "import json; print(json.load(open('$1'))['$2'])"; }
# ratio A B EV: the gain of A is that of B, divided by 2^EV.
ratio() {
    /usr/bin/python3 -c "import json; a, b = (json.load(open(f))['gain'] for f in ('$1', '$2')); assert abs(b / a / 2 ** $3 - 1) < 1e-5, (a, b)"
}
check "the parameters tell how unsure the brightness is" parameter saved.json brightness_sd_ev
$tool "$photo" --srisp-unprocess:brightness=+0.5 "$reference" --srisp-save-params brighter.json -o brighter.exr
check "brightness=+0.5 divides the gain" ratio brighter.json saved.json 0.5
check "and is recorded" [ "$(parameter brighter.json brightness_ev)" = 0.5 ]
check "brighter it is" sh -c '! cmp -s brighter.exr raw.exr'
$tool brighter.exr --srisp-process -o:datatype=uint16 again.tif
check "the way back gives the photo as before" near back.tif again.tif 0.02 2
$tool "$photo" --srisp-params:brightness=-1 "$reference" >darker.json
check "--srisp-params prints a darker one" ratio darker.json saved.json -1
$tool "$photo" --srisp-unprocess:params=saved.json:brightness=0.5 - -o replayed.exr
check "a brightness of given parameters" same brighter.exr replayed.exr
for seed in 1 2 1; do
    $tool "$photo" --srisp-unprocess:brightness=sample:seed=$seed "$reference" --srisp-save-params drawn$seed.json \
        -o drawn$seed.exr 2>notes.txt
    cmp -s drawn$seed.json before$seed.json || [ ! -e before$seed.json ] || echo "seed $seed drew another" >unequal.txt
    cp drawn$seed.json before$seed.json
done
check "the same seed draws the same brightness" [ ! -e unequal.txt ]
check "a note tells what was drawn" grep -q "srisp: note: .*photo.jpg.*: a brightness of [-+].* EV was drawn" notes.txt
check "it is what the gain was changed by" ratio drawn1.json saved.json "$(parameter drawn1.json brightness_ev)"
check "another seed draws another" sh -c '! cmp -s drawn1.json drawn2.json'
/usr/bin/python3 - <<'P'
import json
p = json.load(open("saved.json"))
p["brightness_sd_ev"] = 1.5
json.dump(p, open("unsure.json", "w"))
del p["brightness_sd_ev"]
json.dump(p, open("unknown.json", "w"))
P
check "an unsure brightness is said" says 0 "the brightness is unsure, its standard deviation is 1.50 EV; brightness=EV" \
    "$tool" "$photo" --srisp-unprocess:params=unsure.json - -o unsure.exr
check "a sample needs a deviation" says 1 "brightness 'sample' has no standard deviation to draw from" \
    "$tool" "$photo" --srisp-unprocess:params=unknown.json:brightness=sample - -o no.tif
check "another brightness is refused" says 2 "brightness 'dark' is neither a number of EV from -20 to 20 nor 'sample'" \
    "$tool" "$photo" --srisp-unprocess:brightness=dark "$reference" -o no.tif
check "--srisp-process takes none" says 2 "brightness" "$tool" raw.exr --srisp-process:brightness=1 -o no.tif
check "nothing is left" nothing_left
finish
