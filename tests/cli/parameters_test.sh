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
$tool "$photo" --srisp-unprocess:model=pointwise "$reference" -o pointwise.exr
check "model=pointwise is another model" sh -c "iinfo -v pointwise.exr | grep -q pointwise && ! cmp -s pointwise.exr raw.exr"
check "pointwise parameters do not fit the default model" says 1 "model" \
    "$tool" "$photo" --srisp-params:model=pointwise "$reference" --srisp-unprocess:model=default:params=edited.json - \
    --srisp-process:model=pointwise -o no.tif
# Large enough for the table of a pointwise model.
$stock "$photo" --resize 400x0 -o large.tif
for model in default pointwise; do
    $tool large.tif --srisp-unprocess:model=$model "$reference" -o plain.exr
    $tool large.tif --srisp-unprocess:model=$model:precision=fast "$reference" -o fast.exr
    check "precision=fast gives nearly the same with the model $model" near plain.exr fast.exr 2e-3 0
    check "but not the same" sh -c '! idiff -q -fail 0 -warn 0 plain.exr fast.exr'
done
check "another precision is refused" says 2 "unknown precision 'half'; known: float32, fast" \
    "$tool" "$photo" --srisp-unprocess:precision=half "$reference" -o no.tif
check "nothing is left" nothing_left
finish
