#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Names with characters that oiiotool scans. References, parameters and saved parameters are ours: any name works. Photos and
# outputs are oiiotool's: with wildcards and expressions off every name works that works in the stock oiiotool.
. "$(dirname "$0")/setup.sh"

$tool "$photo" --srisp-unprocess "$reference" --srisp-save-params plain.json -o plain.exr
for name in "two words" "50%" "50%20d" "x#y" "x##y" "a@b" "a&b" "k=v" "{1}" "{TOP.filename}" "who?" "[a]" "*" "it's" 'say "x"' \
    "a:b" "a;b" "größe" "写真" "100%04d" "%V" "back\\slash" "-dash" "a,b" "tab	tab"; do
    rm -rf folder a.exr
    mkdir folder "folder/$name"
    cp "$reference" "folder/$name/r $name.dng"
    cp plain.json "folder/$name/p $name.json"
    cp "$photo" "folder/$name/$name.jpg"
    $tool "$photo" --srisp-unprocess "folder/$name/r $name.dng" -o a.exr
    check "reference '$name'" same a.exr plain.exr
    rm -f a.exr
    quoted=$(printf '%s' "folder/$name/p $name.json" | sed 's/[\\"]/\\&/g')
    $tool "$photo" "--srisp-unprocess:params=\"$quoted\"" - -o a.exr
    check "parameters '$name'" same a.exr plain.exr
    $tool "$photo" --srisp-unprocess "$reference" --srisp-save-params "folder/$name/saved.json" -o a.exr
    check "saved parameters in folder '$name'" cmp "folder/$name/saved.json" plain.json
    for hand_over in "" --dup; do
        out="$name/out.exr"
        (cd folder && oiiotool --wildcardoff --evaloff "$name/$name.jpg" -o "$out" && mv "$out" b.exr) >/dev/null 2>&1 || {
            echo "the stock oiiotool cannot read '$name.jpg' or write to a folder '$name'"
            continue
        }
        # shellcheck disable=SC2086
        (cd folder && $tool --wildcardoff --evaloff "$name/$name.jpg" $hand_over --srisp-unprocess "$reference" -o "$out" &&
            mv "$out" b.exr)
        check "photo and output '$name' $hand_over" same folder/b.exr plain.exr
    done
done
(cd folder && mkdir "here #1 {x}" && cd "here #1 {x}" && cp "$photo" p.jpg && cp "$reference" . &&
    $tool p.jpg --srisp-unprocess reference.dng --srisp-save-params p.json -o out.exr && mv out.exr p.json ..)
check "a working folder with such a name" same folder/out.exr plain.exr
check "parameters saved there" cmp folder/p.json plain.json
mkdir "t #1" && (TMPDIR="$scratch/t #1" && export TMPDIR && $tool "$photo" --srisp-unprocess "$reference" -o t.exr)
check "TMPDIR with such a name" same t.exr plain.exr
latin=$(printf 'latin\351.dng')
: >"$latin"
check "a name that is no UTF-8 is refused with a message" says 1 "not valid UTF-8" \
    "$tool" "$photo" --srisp-unprocess "$latin" -o latin.exr
check "nothing is left" nothing_left
finish
