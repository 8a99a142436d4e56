#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Names with characters that oiiotool scans: literal for us in references, parameters and saved parameters; in photos and
# outputs they are what they are in stock oiiotool.
. "$(dirname "$0")/setup.sh"

$tool "$photo" --srisp-unprocess "$reference" --srisp-save-params plain.json -o plain.exr
for name in "two words" "50%" "50%20d" "x#y" "x##y" "a@b" "a&b" "k=v" "{1}" "{TOP.filename}" "who?" "[a]" "*" "it's" 'say "x"' \
    "a:b" "a;b" "größe" "写真" "100%04d" "%V" "back\\slash" "-dash" "a,b" "tab	tab"; do
    rm -rf folder
    mkdir folder
    mkdir "folder/$name"
    cp "$reference" "folder/$name/r $name.dng"
    cp plain.json "folder/$name/p $name.json"
    $tool "$photo" --srisp-unprocess "folder/$name/r $name.dng" -o a.exr
    check "reference '$name'" same a.exr plain.exr
    rm -f a.exr
    quoted=$(printf '%s' "folder/$name/p $name.json" | sed 's/[\\"]/\\&/g')
    $tool "$photo" "--srisp-unprocess:params=\"$quoted\"" - -o a.exr
    check "parameters '$name'" same a.exr plain.exr
    rm -f a.exr
    $tool "$photo" --srisp-unprocess "$reference" --srisp-save-params "folder/$name/saved.json" -o a.exr
    check "saved parameters in folder '$name'" cmp "folder/$name/saved.json" plain.json
    # wildcards and expressions are off for the names of photo and output: stock oiiotool's own means
    cp "$photo" "folder/$name/$name.jpg"
    $tool --wildcardoff --evaloff "folder/$name/$name.jpg" --srisp-unprocess "$reference" -o "folder/$name/out.exr" 2>error.txt
    check "photo '$name' as it is" same "folder/$name/out.exr" plain.exr
    $tool --wildcardoff --evaloff "folder/$name/$name.jpg" --dup --srisp-unprocess "$reference" -o "folder/$name/out2.exr"
    check "photo '$name' by hand-over" same "folder/$name/out2.exr" plain.exr
done
(cd "folder" && mkdir "here #1 {x}" && cd "here #1 {x}" && cp "$photo" p.jpg && cp "$reference" r.dng &&
    $tool p.jpg --srisp-unprocess r.dng --srisp-save-params p.json -o out.exr)
check "a working folder with such a name" same "folder/here #1 {x}/out.exr" plain.exr
check "parameters saved there" cmp "folder/here #1 {x}/p.json" plain.json
mkdir "t #1" && (TMPDIR="$scratch/t #1" && export TMPDIR && $tool "$photo" --srisp-unprocess "$reference" -o t.exr)
check "TMPDIR with such a name" same t.exr plain.exr
printf 'x' >"$(printf 'latin\351.dng')"
check "a name that is no UTF-8 is refused with a message" says 1 "not valid UTF-8" \
    "$tool" "$photo" --srisp-unprocess "$(printf 'latin\351.dng')" -o latin.exr
check "nothing is left" nothing_left
finish
