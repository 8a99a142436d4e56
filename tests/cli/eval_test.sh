#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# srispeval on files: the three protocols, what it writes, what it leaves out, stopping and going on, comparing.
. "$(dirname "$0")/setup.sh"
evaluate=$build/bin/srispeval
mkdir -p raws/far photos

# RAW files of known content: the sample reference, and photos unprocessed with it and written as DNG. Their own
# unprocessing is what default does, so it can score well on them.
cp "$reference" raws/a.dng
for number in 1 2 3; do
    oiiotool "$photo" --mulc 0.$((10 - 2 * number)),0.9,0.$((5 + number)) -o photos/$number.jpg
    "$tool" photos/$number.jpg --srisp-unprocess "$reference" --srisp-mosaic -o raws/far/$number.dng
done
head -c 3000 raws/a.dng >raws/broken.dng
echo text >raws/notes.txt

# json FILE PYTHON: an expression about the scores s and their images i
json() {
    /usr/bin/python3 -c "
import json, sys
s = json.load(open('$1')); i = s['images']
if not ($2): sys.exit('not so: ' + '''$2''' + ' of ' + json.dumps(s)[:3000])"
}

half_split() { "$evaluate" half-split raws --size 128 -q "$@"; }
works() { exits 1 half_split --report report.html --json scores.json --csv scores.csv --threads 2 >table.txt 2>log.txt; }
check "half split of a folder with a broken file" works
check "the broken file is told, and the others are tested" sh -c '
    grep -q "left out: .*broken.dng" log.txt && [ "$(grep -c "left out" log.txt)" -eq 1 ]'
check "two parts of four files in three renderings" json scores.json "len(i) == 24 and {x['part'] for x in i} == {'top', 'bottom'}
    and {x['rendering'] for x in i} == {'fixed', 'random', 'camera'} and s['complete'] and len(s['left_out']) == 1"
check "methods in order, each measured" json scores.json "s['methods'] == ['gain_match', 'upi', 'default'] and
    all(x['methods'][m]['psnr_db'] > 5 and x['methods'][m]['angle_degrees'] >= 0 for x in i for m in s['methods'])"
check "the model beats gain match" json scores.json "(lambda m: m[2]['over_baseline']['psnr_db'][0] > 0)([g for g in s['groups'] if g['rendering'] == 'fixed'][0]['methods'])"
check "intervals hold their means" json scores.json "all(v[1] <= v[0] <= v[2] for g in s['groups'] if g['files'] > 1
    for m in g['methods'] for k, v in m['values'].items() if None not in v)"
check "parameters and weights are there" json scores.json "all(len(x['methods']['default']['parameters']['weights']['gain']) > 1 for x in i)"
check "CSV has a line for each" sh -c '[ "$(wc -l <scores.csv)" -eq 73 ]'
check "the table names all methods" sh -c 'grep -q "rendering fixed: 8 images of 4 files" table.txt &&
    grep -q "default .* (.* to .*)" table.txt'
check "the report is one page that needs nothing else" sh -c '
    grep -q "</html>" report.html && ! grep -Eq "(src|href)=\"?(https?:)?//" report.html'
check "nothing unfinished is left" sh -c '! ls -a | grep -q unfinished'
check "no temporary files are left" nothing_left

check "options before the files, repeated and as lists" sh -c '"$0" half-split --model default --model spatial \
    --baseline gain_match,upi --baseline upi --rendering fixed raws/a.dng -q --size 64 --json order.json >/dev/null' "$evaluate"
check "all of them count" json order.json "s['methods'] == ['gain_match', 'upi', 'default', 'spatial'] and len(i) == 2"

same_scores() { # same_scores ARGUMENTS…: without pictures
    half_split --json again.json "$@" >/dev/null 2>&1
    cmp scores.json again.json
}
check "one thread gives the same bytes" same_scores --threads 1

# A run that is stopped keeps what is done, and goes on from there.
stopped() {
    rm -f part.json
    /usr/bin/python3 - "$evaluate" <<'STOP'
import os, signal, subprocess, sys, time
run = subprocess.Popen([sys.argv[1], "half-split", "raws", "--size", "128", "-q", "--json", "part.json", "--threads", "1",
                        "--rendering", "fixed,embedded,libraw,dcraw"], stdout=subprocess.DEVNULL, stderr=open("stop.txt", "w"))
for _ in range(6000):
    if os.path.exists("part.json.unfinished") and os.path.getsize("part.json.unfinished") > 2000:
        break
    time.sleep(0.01)
run.send_signal(signal.SIGTERM)
sys.exit(run.wait() != -signal.SIGTERM)
STOP
}
check "a signal ends it" stopped
check "and leaves the scores of what was done" json part.json "not s['complete'] and 0 < len(i)"
check "and a way to go on" sh -c 'grep -q "the same command goes on" stop.txt && [ -s part.json.unfinished ]'
kinds=fixed,embedded,libraw,dcraw
goes_on() {
    exits 1 half_split --json part.json --rendering $kinds >/dev/null 2>&1 && [ ! -e part.json.unfinished ] &&
        exits 1 half_split --json whole.json --rendering $kinds >/dev/null 2>&1 && cmp part.json whole.json
}
check "which gives what one run gives, with what was left out" goes_on
all_kinds() { "$evaluate" half-split raws/a.dng --size 128 -q --rendering all --json all.json >/dev/null 2>&1; [ -s all.json ]; }
check "all renderings that are installed" all_kinds
check "are there" json all.json "{'fixed', 'random', 'camera', 'libraw'} <= {x['rendering'] for x in i}"
killed() {
    for delay in 0.05 0.2 0.4 0.8; do
        timeout -s KILL $delay "$evaluate" half-split raws --size 128 -q --json killed.json >/dev/null 2>&1
    done
    exits 1 half_split --json killed.json >/dev/null 2>&1 && cmp scores.json killed.json
}
check "kill -9 at any time: the next run gives the same" killed

# Pairs
cat >pairs.csv <<'PAIRS'
photo, RAW, reference,rendering
photos/1.jpg,raws/far/1.dng,raws/a.dng,made
photos/2.jpg,raws/far/2.dng,raws/a.dng,made
photos/3.jpg,raws/far/3.dng,raws/a.dng,
photos/none.jpg,raws/far/3.dng,raws/a.dng,made
PAIRS
pairs() { exits 1 "$evaluate" pairs pairs.csv -q --size 128 --json pairs.json --report pairs.html >/dev/null 2>pairs.txt; }
check "pairs" pairs
check "three are tested, the missing one is left out" json pairs.json "len(i) == 3 and len(s['left_out']) == 1 and
    [x['rendering'] for x in i] == ['made', 'made', 'photo']"
# They were made by default from these very photos.
check "where the truth is the model's own, it is found" json pairs.json "all(x['methods']['default']['psnr_db'] > 35 for x in i)"
check "a photo of another shape is left out" sh -c 'oiiotool "$0" --resize 100x100! -o square.jpg
    printf "photo,raw,reference\nsquare.jpg,raws/a.dng,raws/a.dng\n" >shape.csv
    "$1" pairs shape.csv -q 2>&1 | grep -q "another shape"' "$photo" "$evaluate"

# Unpaired
unpaired() {
    exits 1 "$evaluate" unpaired photos --reference raws --references 3 -q --size 128 --json unpaired.json \
        --report unpaired.html >unpaired.txt 2>&1
}
check "unpaired" unpaired
check "each photo with three references" json unpaired.json "len(i) == 9 and len({x['reference'] for x in i}) == 3"
check "rank correlations and histograms" json unpaired.json "(lambda v: -1 <= v['rank_green'][0] <= 1 and
    0 < v['lab_intersection_all_images'][0] <= 1)(s['groups'][0]['methods'][-1]['values'])"

# Comparing
check "a file against itself is within the noise" sh -c '"$0" compare scores.json scores.json >same.txt && ! grep -q better same.txt' "$evaluate"
check "methods against each other" sh -c '"$0" compare scores.json scores.json --method upi=default --json compare.json >better.txt &&
    grep -q "the second is better" better.txt' "$evaluate"
check "as JSON" sh -c '/usr/bin/python3 -c "
import json
c = json.load(open(\"compare.json\"))[\"differences\"]
assert all(d[\"first\"] == \"upi\" and d[\"second\"] == \"default\" and d[\"low\"] <= d[\"difference\"] <= d[\"high\"] for d in c if d[\"low\"] is not None) and c"'
check "nothing in common" says 1 "no image in common" "$evaluate" compare pairs.json unpaired.json
check "no such method" says 1 "has no method 'mine'" "$evaluate" compare scores.json scores.json --method mine

# Wrong usage and bad input
check "no arguments" says 2 "give half-split, pairs, unpaired" "$evaluate"
check "unknown word" says 2 "'halfsplit' is none of half-split" "$evaluate" halfsplit raws
check "unknown option" says 2 "--fast" "$evaluate" half-split raws --fast
check "unknown rendering" says 2 "--rendering" "$evaluate" half-split raws --rendering jpeg
check "no files" says 2 "needs RAW files" "$evaluate" half-split
check "no references" says 2 "needs --reference" "$evaluate" unpaired photos
check "unknown model" says 1 "none-such" "$evaluate" half-split raws --model none-such
check "folder without RAW files" says 1 "holds no RAW files" "$evaluate" half-split photos
check "missing file" says 1 "does not exist" "$evaluate" half-split none.dng
check "only broken files" says 1 "nothing could be tested" "$evaluate" half-split raws/broken.dng
check "missing table" says 1 "none.csv" "$evaluate" pairs none.csv
check "a table without a column" sh -c 'echo "photo,raw" >bad.csv; ! "$0" pairs bad.csv 2>bad.txt && grep -q "no column .reference." bad.txt' "$evaluate"
check "an output that is an input" says 1 "inputs are never overwritten" "$evaluate" half-split raws/a.dng --json raws/a.dng
check "an output that is one of a folder's files" says 1 "inputs are never overwritten" "$evaluate" half-split raws --csv raws/far/1.dng
check "an output that a table names" says 1 "inputs are never overwritten" "$evaluate" pairs pairs.csv --json photos/1.jpg
check "an output that is a reference" says 1 "inputs are never overwritten" "$evaluate" unpaired photos --reference raws --report raws/a.dng
check "a comparison onto what is compared" says 1 "inputs are never overwritten" "$evaluate" compare scores.json pairs.json --json scores.json
check "a folder that is not there" says 1 "there is no folder 'no'" "$evaluate" half-split raws/a.dng --report no/report.html
check "scores that are none" says 1 "is no file of scores" sh -c 'echo "{}" >no.json; "$0" compare no.json scores.json' "$evaluate"
check "help and version" sh -c '"$0" --help | grep -q "srispeval half-split RAWS" && "$0" half-split --help | grep -q Examples && "$0" half-split raws/a.dng --size 64 -q --rendering fixed | grep -q "left half of each RAW" && "$0" --version | grep -q srispeval' "$evaluate"
check "a device as an output has no file beside it" sh -c '"$0" half-split raws/a.dng -q --size 64 --json /dev/null >/dev/null && [ ! -e /dev/null.unfinished ]' "$evaluate"
if [ -w /dev/full ]; then
    full() { exits 1 half_split --csv /dev/full >/dev/null 2>full.txt && grep -q "No space left" full.txt; }
    check "a full disk" full
fi
finish
