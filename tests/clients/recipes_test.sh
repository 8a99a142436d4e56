# SPDX-License-Identifier: Apache-2.0
# Recipes on disk, also in programs that test for the file before they ask OpenImageIO.
. "${0%/*}/setup.sh"

mkdir shots
cat >shots/a.srisp <<'END'
{ "format": "srisp-recipe-1", "source": "../photo.jpg", "reference": "../reference.dng" }
END
check "oiiotool reads a recipe" sh -c 'oiiotool shots/a.srisp -o recipe.exr'
check "a recipe gives what a query gives" same expected.exr recipe.exr
check "igrep finds the mark of a recipe's image" prints "synthetic RAW-like image" igrep synthetic shots/a.srisp
check "maketx makes a texture of a recipe" maketx --format openexr -d float --filter box shots/a.srisp -o texture.exr
check "the texture's largest level is the image" sh -c 'oiiotool texture.exr --selectmip 0 -o level.exr && idiff -q -fail 0 -warn 0 expected.exr level.exr'
check "the texture carries the parameters" prints 'white_balance' iinfo -v texture.exr
oiiotool "texture.exr.srisp?direction=forward" --selectmip 0 -o texture_back.png
oiiotool "expected.exr.srisp?direction=forward" -o back.png
check "what the texture recorded is taken back" same texture_back.png back.png

check "a texture is a source too: its MIP levels are kept" sh -c \
    'maketx --format openexr photo.jpg -o photo.tx && iinfo "photo.tx.srisp?reference=reference.dng&input=srgb" >/dev/null &&
     oiiotool --info -v "photo.tx.srisp?reference=reference.dng&input=srgb" | grep -q "MIP-map levels: 160"'

mkdir "odd [1];*"
for name in "a;b.dng" "x*.dng" "y[1].dng"; do cp reference.dng "odd [1];*/$name"; done
for list in '"a;b.dng"' '"x*.dng;y[1].dng;a;b.dng"' '["a;b.dng", "x*.dng", "y[1].dng"]' '"*.dng"'; do
    printf '{ "format": "srisp-recipe-1", "source": "../photo.jpg", "reference": %s }\n' "$list" >"odd [1];*/a.srisp"
    check "a recipe in an odd folder takes the reference $list" same expected.exr "odd [1];*/a.srisp"
done

/usr/bin/python3 - <<'END'
import json
import OpenImageIO as oiio
record = json.loads(oiio.ImageInput.open("expected.exr").spec().getattribute("ImageDescription"))
parameters = record["parameters"]
json.dump(parameters, open("parameters.json", "w"))
parameters["gain"] *= 2
json.dump({"format": "srisp-recipe-1", "source": "photo.jpg", "parameters": parameters}, open("edited.srisp", "w"))
json.dump({"format": "srisp-recipe-1", "source": "photo.jpg", "parameters": "parameters.json"}, open("replay.srisp", "w"))
END
check "recorded parameters replay to the bit" same expected.exr replay.srisp
check "parameters edited in a recipe win" sh -c '! idiff -q -fail 0.02 -failpercent 5 expected.exr edited.srisp'

check "a recipe's mistake is named" says "unknown key 'refrence'; did you mean 'reference'?" sh -c \
    'echo "{\"format\": \"srisp-recipe-1\", \"source\": \"photo.jpg\", \"refrence\": \"a\"}" >bad.srisp; oiiotool bad.srisp -o bad.exr'
check "nothing is written then" test ! -e bad.exr
finish
