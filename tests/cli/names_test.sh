#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Names with characters that oiiotool scans. References, parameters and saved parameters are ours: any name works. Photos and
# outputs are oiiotool's: with wildcards and expressions off every name works that works in the stock oiiotool.
. "$(dirname "$0")/setup.sh"

$tool "$photo" --srisp-unprocess "$reference" --srisp-save-params plain.json --eraseattrib ".*" -o plain.sgi
for name in "two words" "50%" "50%20d" "x#y" "x##y" "a@b" "a&b" "k=v" "{1}" "{TOP.filename}" "who?" "[a]" "*" "it's" 'say "x"' \
    "a:b" "a;b" "größe" "写真" "100%04d" "%V" "back\\slash" "-dash" "a,b" "tab	tab"; do
    rm -rf folder a.sgi b.sgi
    mkdir folder "folder/$name"
    cp "$reference" "folder/$name/r $name.dng"
    cp plain.json "folder/$name/p $name.json"
    cp "$photo" "folder/$name/$name.jpg"
    quoted=$(printf '%s' "folder/$name/p $name.json" | sed 's/[\\"]/\\&/g')
    # SGI, 16 bits: equal pixels are equal files behind the header of 512 bytes, which holds the name.
    $tool "$photo" --srisp-unprocess "folder/$name/r $name.dng" --eraseattrib ".*" -o a.sgi \
        "$photo" "--srisp-unprocess:params=\"$quoted\"" - --srisp-save-params "folder/$name/saved.json" --eraseattrib ".*" -o b.sgi
    check "reference '$name'" cmp -i 512 a.sgi plain.sgi
    check "parameters '$name'" cmp -i 512 b.sgi plain.sgi
    check "saved parameters in folder '$name'" cmp "folder/$name/saved.json" plain.json
    literal="--wildcardoff --evaloff"
    # shellcheck disable=SC2086
    if (cd folder && oiiotool $literal "$name/$name.jpg" -o stock.exr && [ -e stock.exr ]) >/dev/null 2>&1; then
        (cd folder && $tool $literal "$name/$name.jpg" --srisp-unprocess "$reference" --eraseattrib ".*" -o a.sgi \
            "$name/$name.jpg" --dup --srisp-unprocess "$reference" --eraseattrib ".*" -o b.sgi)
        check "photo '$name'" cmp -i 512 folder/a.sgi plain.sgi
        check "photo '$name' by hand-over" cmp -i 512 folder/b.sgi plain.sgi
    else
        echo "the stock oiiotool cannot read '$name.jpg'"
    fi
    # shellcheck disable=SC2086
    if (cd folder && oiiotool $literal "$photo" -o "$name/stock.exr" && [ -e "$name/stock.exr" ]) >/dev/null 2>&1; then
        (cd folder && $tool $literal "$photo" --srisp-unprocess "$reference" --eraseattrib ".*" -o "$name/$name.sgi")
        check "output '$name'" cmp -i 512 "folder/$name/$name.sgi" plain.sgi
    else
        echo "the stock oiiotool cannot write to a folder '$name'"
    fi
done
# A name that exists is itself, also in a list: twenty seeds find every file, and none else.
mkdir odd
for name in "a;b.dng" "b.dng" "x*.dng" "y[1].dng"; do cp "$reference" "odd/$name"; done
for seed in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
    $tool "$photo" "--srisp-params:seed=$seed" "odd/a;b.dng;odd/b.dng;odd/x*.dng;odd/y[1].dng"
done | grep -o '"reference": {"name": "[^"]*"' | sort -u >taken.txt
printf '"reference": {"name": "%s"\n' "a;b.dng" "b.dng" "x*.dng" "y[1].dng" >expected.txt
check "references with odd names beside others" cmp taken.txt expected.txt
check "a missing one among them is told" says 1 "reference 'odd/c.dng' does not exist" \
    "$tool" "$photo" --srisp-params "odd/a;b.dng;odd/c.dng"
(cd odd && $tool "$photo" --srisp-params "*.dng" >../globbed.txt)
check "a glob finds them, too" grep -q '"reference": {"name": "[abxy]' globbed.txt
(cd folder && mkdir "here #1 {x}" && cd "here #1 {x}" && cp "$photo" p.jpg && cp "$reference" . &&
    $tool p.jpg --srisp-unprocess reference.dng --srisp-save-params p.json --eraseattrib ".*" -o out.sgi && mv out.sgi p.json ..)
check "a working folder with such a name" cmp -i 512 folder/out.sgi plain.sgi
check "parameters saved there" cmp folder/p.json plain.json
mkdir "t #1" && (TMPDIR="$scratch/t #1" && export TMPDIR &&
    $tool "$photo" --flip --flip --srisp-unprocess "$reference" --eraseattrib ".*" -o t.sgi)
check "TMPDIR with such a name" cmp -i 512 t.sgi plain.sgi
latin=$(printf 'latin\351.dng')
: >"$latin"
check "a name that is no UTF-8 is refused with a message" says 1 "not valid UTF-8" \
    "$tool" "$photo" --srisp-unprocess "$latin" -o latin.exr
check "nothing is left" nothing_left
finish
