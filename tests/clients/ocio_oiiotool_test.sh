# SPDX-License-Identifier: Apache-2.0
# The bakes and our config in the stock oiiotool.
. "${0%/*}/ocio_setup.sh"

here=$scratch/reference.dng
oiiotool photo.jpg --ociolook:key=SRISP_REFERENCE:value="$here" "$unprocess" -o:datatype=float key.exr
check "a look with the reference as context variable gives the library's pixels" near key.exr raw.exr 2e-4
with "$here" oiiotool photo.jpg --ociolook "$unprocess" -o:datatype=float variable.exr
check "the environment variable does the same" same key.exr variable.exr
with "$here" oiiotool photo.jpg --colorconvert sRGB "$camera" -o:datatype=float space.exr
check "a colour space does the same" near space.exr raw.exr 2e-4
with "$here" oiiotool photo.jpg --tocolorspace camera_rgb -o:datatype=float alias.exr
check "photos are known as sRGB, and camera RGB by its short name" same space.exr alias.exr
with "$here" oiiotool raw.exr --ociolook "$process" -o:datatype=float p.tif
check "our EXR is processed without telling its colour space" near p.tif back.tif 2e-4
oiiotool raw.exr --ociolook:key=SRISP_REFERENCE:value="$here" "$process" -o:datatype=float p.tif
check "and with the variable on the command line" near p.tif back.tif 2e-4
with "$here" oiiotool raw.exr --colorconvert "$camera" sRGB -o:datatype=float p.tif
check "or by its colour space" near p.tif back.tif 2e-4
with "$here" oiiotool raw.exr --ociodisplay "sRGB display" "$process" -o:datatype=float p.tif
check "or in a view" near p.tif back.tif 2e-4

# Developed: by srisptool, and by the config's spaces.
"$tool" raw.exr --srisp-develop ACEScg -o:datatype=float acescg.exr --srisp-process -o:datatype=float home.tif
"$tool" raw.exr --srisp-develop lin_rec709 -o:datatype=float rec709.exr
with "$here" oiiotool photo.jpg --colorconvert "srisp photo" ACEScg -o:datatype=float plate.exr
check "a photo is read as a plate in ACEScg" near plate.exr acescg.exr 1e-3
with "$here" oiiotool photo.jpg --colorconvert "srisp photo" "Linear sRGB" -o:datatype=float plate.exr
check "or in linear sRGB" near plate.exr rec709.exr 1e-3
with "$here" oiiotool photo.jpg --colorconvert sRGB "srisp ACEScg" -o:datatype=float plate.exr
check "a photo is converted to ACEScg" near plate.exr acescg.exr 1e-3
with "$here" oiiotool photo.jpg --colorconvert sRGB "srisp scene linear" -o:datatype=float plate.exr
check "or to scene-linear sRGB primaries" near plate.exr rec709.exr 1e-3
with "$here" oiiotool acescg.exr --colorconvert ACEScg "srisp photo" -o:datatype=float p.tif
check "ACEScg gets the photo's look" near p.tif home.tif 2e-3
with "$here" oiiotool acescg.exr --colorconvert "srisp ACEScg" sRGB -o:datatype=float p.tif
check "or is converted to the photo" near p.tif home.tif 2e-3
oiiotool photo.jpg --colorconvert "srisp photo" "Linear sRGB" -o:datatype=float n.exr
oiiotool photo.jpg --colorconvert sRGB "Linear sRGB" -o:datatype=float linear.exr
check "with no reference a photo is read as sRGB" near n.exr linear.exr 3e-4 # two matrices of four-digit whites
whites() {
    $bake --reference reference.dng --source photo.jpg --quiet --whitebalance reference --exposure 0.5 -o other_white &&
        "$tool" raw.exr --srisp-develop:whitebalance=reference:exposure=0.5 lin_rec709 -o:datatype=float other.exr &&
        with "$scratch/other_white" oiiotool photo.jpg --colorconvert "srisp photo" "Linear sRGB" -o:datatype=float o.exr &&
        near o.exr other.exr 2e-3
}
check "white and exposure of a bake" whites

round_trip() {
    with "$here" oiiotool photo.jpg --ociolook "$unprocess" --iscolorspace Linear --ociolook "$process" \
        -o:datatype=float round.tif
    # The pipeline's own error of the round trip, and no more than that beside it.
    near_but_for_black round.tif back.tif
}
check "process undoes unprocess as far as the library's does" round_trip
oiiotool --pattern fill:left=0,0,0:right=1,1,1 1024x8 3 --attrib oiio:ColorSpace sRGB -d float -o ramp.tif
"$tool" photo.jpg --srisp-params reference.dng 2>/dev/null >look.json
"$tool" ramp.tif --srisp-unprocess:params=look.json:input=srgb - -o:datatype=float ramp_raw.exr 2>/dev/null
with "$here" oiiotool ramp.tif --iscolorspace sRGB --ociolook "$unprocess" -o:datatype=float ramp_ocio.exr
check "a grey ramp is within 1e-3" near ramp_ocio.exr ramp_raw.exr 1e-3

oiiotool photo.jpg --ociolook "$unprocess" -o:datatype=float neutral.exr
oiiotool photo.jpg --colorconvert sRGB Linear -o:datatype=float linear.exr
check "with no reference nothing aborts: the photo is made linear" near neutral.exr linear.exr 1e-5

# Two shots in one comp.
mkdir other
cp photo.jpg other/photo.jpg
oiiotool photo.jpg --mulc 0.6,0.8,1 -o dark.jpg
cp reference.dng other/reference.dng
$bake --reference other/reference.dng --source dark.jpg --quiet
library dark.jpg other/reference.dng dark_raw.exr dark_back.tif
oiiotool photo.jpg --ociolook:key=SRISP_REFERENCE:value="$here" "$unprocess" -o:datatype=float a.exr \
    dark.jpg --ociolook:key=SRISP_REFERENCE:value="$scratch/other/reference.dng" "$unprocess" -o:datatype=float b.exr
check "two references at once: the first" same a.exr key.exr
check "two references at once: the second" near b.exr dark_raw.exr 2e-4

check "a missing bake: the message names its file" says "/nowhere/r.dng.unprocess.clf" \
    env SRISP_REFERENCE=/nowhere/r.dng oiiotool photo.jpg --ociolook "$unprocess" -o no.exr
check "a reference that was moved away: the message names its file" says "$scratch/gone.dng.unprocess.clf" \
    env SRISP_REFERENCE="$scratch/gone.dng" oiiotool photo.jpg --ociolook "$unprocess" -o no.exr
check "a name without a folder: the message names the file" says "r.dng.unprocess.clf" \
    env SRISP_REFERENCE=r.dng oiiotool photo.jpg --ociolook "$unprocess" -o no.exr
check "an empty variable: the message names the variable" says "SRISP_REFERENCE" \
    env SRISP_REFERENCE= oiiotool photo.jpg --ociolook "$unprocess" -o no.exr
head -c 100000 reference.dng.unprocess.clf >truncated.dng.unprocess.clf
cp reference.dng.process.clf truncated.dng.process.clf
check "a truncated bake: the message names its file" says "truncated.dng.unprocess.clf" \
    env SRISP_REFERENCE="$scratch/truncated.dng" oiiotool photo.jpg --ociolook "$unprocess" -o no.exr
check "none of these leaves an image" [ ! -e no.exr ]
SRISP_BAKE_PATH=$scratch SRISP_REFERENCE=reference.dng oiiotool photo.jpg --ociolook "$unprocess" -o:datatype=float s.exr
check "a name without a folder is found in SRISP_BAKE_PATH" same s.exr key.exr

for name in "two words" "pay \$100" "\${HOME}" "%HOME%" "50%" "50%20d" "a&b" "k=v" "größe" "写真" "it's" "100%04d" "a,b"; do
    mkdir -p "odd/$name"
    cp reference.dng "odd/$name/r $name.dng"
    cp reference.dng.unprocess.clf "odd/$name/r $name.dng.unprocess.clf"
    cp reference.dng.process.clf "odd/$name/r $name.dng.process.clf"
    with "$scratch/odd/$name/r $name.dng" oiiotool photo.jpg --ociolook "$unprocess" -o:datatype=float odd.exr
    check "a path with '$name'" same odd.exr key.exr
    rm -f odd.exr
done
finish
