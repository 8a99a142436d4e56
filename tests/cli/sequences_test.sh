#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Frames: wildcards, ranges, hold, one result per frame.
. "$(dirname "$0")/setup.sh"

for frame in 1 2 3; do
    oiiotool "$photo" --mulc "0.$((frame * 3))" -o "s.000$frame.tif"
    $tool "s.000$frame.tif" --srisp-unprocess "$reference" --srisp-save-params "single.000$frame.json" -o "single.000$frame.exr"
done
$tool "s.#.tif" --srisp-unprocess "$reference" -o "w.#.exr"
$tool --frames 1-3 "s.%04d.tif" --srisp-unprocess "$reference" --srisp-save-params "p.#.json" -o "r.%04d.exr"
$tool "s.1-3@@@@.tif" --flip --srisp-unprocess "$reference" --flip -o "f.1-3#.exr"
$tool "s.1-3#.tif" --flip -o "flipped.1-3#.tif"
for frame in 1 2 3; do
    check "wildcards, frame $frame" same "w.000$frame.exr" "single.000$frame.exr"
    check "--frames and printf style, frame $frame" same "r.000$frame.exr" "single.000$frame.exr"
    check "parameters of frame $frame, saved" cmp "p.000$frame.json" "single.000$frame.json"
    $tool "flipped.000$frame.tif" --srisp-unprocess "$reference" --flip -o "g.exr"
    check "in the middle of a chain, frame $frame" same "f.000$frame.exr" g.exr
done
check "the frames differ" sh -c '! cmp -s p.0001.json p.0003.json'

$tool --frames 1-3 "s.#.tif" --srisp-unprocess:hold=1 "$reference" --srisp-save-params "h.#.json" -o "h.#.exr"
for frame in 1 2 3; do
    check "hold keeps the first frame's parameters, frame $frame" cmp "h.000$frame.json" single.0001.json
    $tool "s.000$frame.tif" --srisp-unprocess:params=single.0001.json "$reference" -o "replayed.exr"
    check "and they are applied to frame $frame" same "h.000$frame.exr" replayed.exr
done
$tool --frames 1-3 "s.#.tif" --srisp-unprocess:hold=1:brightness=sample "$reference" --srisp-save-params "d.#.json" -o "d.#.exr" 2>/dev/null
check "one brightness is drawn for a held sequence" sh -c 'cmp d.0001.json d.0002.json && cmp d.0001.json d.0003.json && grep -q brightness_ev d.0001.json'
$tool --frames 1-3 "s.#.tif" --srisp-unprocess:brightness=sample "$reference" --srisp-save-params "e.#.json" -o "e.#.exr" 2>/dev/null
check "and one for each frame of another" sh -c '! grep brightness_ev e.0001.json | grep -qf - e.0002.json'
$tool --frames 2-3 "s.#.tif" --srisp-params "$reference" >lines.txt
check "--srisp-params prints one object per frame, with its name" \
    /usr/bin/python3 -c "import json; l = [json.loads(x) for x in open('lines.txt')]; assert len(l) == 2 and l[0]['image'] != l[1]['image'], l"
$tool --frames 1-3 "$photo" --srisp-unprocess "$reference" -o "c.#.exr"
check "a range without wildcards in the input" same c.0001.exr c.0003.exr
$tool --frames 1-2 "s.#.tif" --srisp-unprocess "$reference" --srisp-process -o "back.#.tif"
$tool single.0002.exr --srisp-process -o back.tif
check "there and back, frame 2" same back.0002.tif back.tif
$tool --frames 1-2 "s.#.tif" --srisp-unprocess "$reference" "s.#.tif" --flip --srisp-unprocess "$reference" --absdiff -o "two.#.exr"
$tool s.0002.tif --srisp-unprocess "$reference" s.0002.tif --flip --srisp-unprocess "$reference" --absdiff -o two.exr
check "two commands in a sequence, frame 2" same two.0002.exr two.exr
for frame in 1 2 3; do cp "s.000$frame.tif" "t.001$frame.tif"; done
$tool "s.#.tif" --flip --flip "t.#.tif" --srisp-unprocess "$reference" -o "u.#.exr"
for frame in 1 2 3; do
    check "a second sequence with numbers of its own, frame $frame" same "u.000$frame.exr" "single.000$frame.exr"
done
$tool --info "s.1-2#.tif" --flip --srisp-params "$reference" 2>&1 | grep -v '^{' >info.txt
oiiotool --info "s.1-2#.tif" >info_expected.txt
check "information bears the user's names" cmp info.txt info_expected.txt
$tool --frames 1000001-1000002 "$photo" --srisp-unprocess "$reference" -o "big.#.exr"
check "frame numbers beyond a million" same big.1000002.exr c.0001.exr
$tool --frames -2--1 "$photo" --dup --srisp-unprocess "$reference" --srisp-save-params "n.#.json" -o "n.#.exr"
check "negative frame numbers" sh -c "ls n.*01.exr n.*02.exr n.*01.json n.*02.json"
check "nothing is left" nothing_left
finish
