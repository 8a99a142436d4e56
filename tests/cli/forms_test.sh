#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The three ways to call it, and what oiiotool's stack makes of ours.
. "$(dirname "$0")/setup.sh"

$tool "$photo" --srisp-unprocess "$reference" -o a.exr
PATH=$build/libexec/srisp:$PATH oiiotool "$photo" --srisp-unprocess "$reference" -o b.exr
OIIO_LIBRARY_PATH=$plugins oiiotool "photo.jpg.srisp?reference=reference.dng" -o c.exr
check "srisptool and oiiotool from libexec give the same pixels" same a.exr b.exr
check "srisptool and a query name in the stock oiiotool give the same pixels" same a.exr c.exr
check "the result is float and marked as synthetic" sh -c "iinfo -v a.exr | grep -q 'float' && iinfo -v a.exr | grep -qi synthetic"

$tool "$photo" --dup --pop --srisp-unprocess "$reference" -o d.exr
check "a hand-over gives the pixels of a recipe" same a.exr d.exr
$tool -i "$photo" --srisp-unprocess "$reference" -o e.exr
check "-i is as good as a name" same a.exr e.exr
$tool --evaloff "$photo" --dup --srisp-unprocess "$reference" -o f.exr
check "with evaluation off too" same a.exr f.exr
for option in "-d uint8" "-d uint10" --autotrim --dither --native --autoorient "--tile 64 64" "--compression zip" \
    --no-autopremult -a --scanline "--planarconfig separate" --noautocrop "--threads 1" --metamerge; do
    # shellcheck disable=SC2086
    $tool $option "$photo" --dup --pop --srisp-unprocess "$reference" -o:datatype=float:autocc=0 g.exr
    check "$option leaves the hand-over alone" same a.exr g.exr
done
$tool --autocc "$photo" --srisp-unprocess "$reference" -o:autocc=0 g.exr
check "--autocc linearises the photo before, and is nearly undone" idiff -fail 0.0001 -warn 0.0001 a.exr g.exr

$tool "$photo" --srisp-unprocess "$reference" -o h1.exr --srisp-process -o h2.exr
$tool a.exr --srisp-process -o h3.exr
check "an output between two of ours is what it is alone" same a.exr h1.exr
check "process behind unprocess is process of the file" same h2.exr h3.exr

oiiotool "$photo" --flip -o flipped.tif
$tool "$photo" --srisp-unprocess "$reference" flipped.tif --srisp-unprocess "$reference" --absdiff -o both.exr
$tool flipped.tif --srisp-unprocess "$reference" -o flipped.exr
oiiotool a.exr flipped.exr --absdiff -o separately.exr
check "two images on the stack are unprocessed each by itself" same both.exr separately.exr
$tool "$photo" flipped.tif --srisp-unprocess "$reference" --swap --srisp-unprocess "$reference" -o i.exr
check "an image from the middle of the stack" same a.exr i.exr
$tool "$photo" --label shot --flip shot --srisp-unprocess "$reference" -o j.exr
check "a labelled image" same a.exr j.exr
$tool --add "$photo" "$photo" --srisp-unprocess "$reference" -o k.exr
oiiotool --add "$photo" "$photo" -d float -o over.tif
$tool over.tif --srisp-unprocess "$reference" -o l.exr
check "a command that waits for its second image goes before ours" same k.exr l.exr
$tool --for i 0,2 "$photo" --srisp-unprocess "$reference" --endfor --absdiff -o zero.exr
oiiotool a.exr a.exr --absdiff -o really_zero.exr
check "a loop may make several images by one command" same zero.exr really_zero.exr
$tool "$photo" --if 0 --srisp-unprocess "$reference" --endif -o m.tif
check "a condition may leave ours out" same "$photo" m.tif

oiiotool "$photo" "$photo" --siappend -o two.tif
$tool -a two.tif --srisp-unprocess "$reference" -o two.exr
check "all subimages are unprocessed" sh -c "oiiotool two.exr --subimage 1 -o second.exr && iinfo two.exr"
check "the second subimage is the first" same second.exr a.exr

$tool "$photo" --srisp-unprocess "$reference" -o n.exr && cp n.exr n1.exr && $tool "$photo" --srisp-unprocess "$reference" -o n.exr
check "the same command twice gives the same bytes" cmp n.exr n1.exr
check "the result records the user's command" sh -c "iinfo -v n.exr | grep -q 'srisptool.*--srisp-unprocess'"
$tool "$photo" --srisp-unprocess "$reference" --srisp-process -o twice.exr
check "a command line with two of ours is recorded once" sh -c \
    "[ \$(iinfo -v twice.exr | grep ImageHistory | grep -o 'twice.exr' | wc -l) -eq 1 ]"
check "no temporary name is in the result" sh -c "! grep -aq srisptool.partial- n.exr"

$tool "$photo" --srisp-unprocess "$reference" -o raw.png 2>png.txt
check "PNG gets 16 bits" sh -c "iinfo raw.png | grep -q uint16 && ! grep -q WARNING png.txt"
$tool "$photo" --srisp-unprocess "$reference" -o raw.jpg 2>jpg.txt
check "JPEG gets a warning that names -d" grep -q -- "-d uint8" jpg.txt
$tool "$photo" --srisp-unprocess "$reference" -d uint8 -o raw8.png
check "-d wins" sh -c "iinfo raw8.png | grep -q uint8"
check "nothing is left" nothing_left
finish
