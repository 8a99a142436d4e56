#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# --srisp-develop on srisptool's line: the same by every way, its tags, the way back, and what is refused.
. "$(dirname "$0")/setup.sh"

value() { # value FILE ATTRIBUTE
    oiiotool --info -v "$1" | sed -n "s/^ *$2: //p" | head -n 1
}
near() { idiff -fail "$3" -warn "$3" "$1" "$2"; } # near A B LIMIT

"$tool" "$photo" --srisp-unprocess "$reference" -o:datatype=float raw.exr
"$tool" "$photo" --srisp-unprocess "$reference" --srisp-develop ACEScg -o:datatype=float one.exr

from_file() { "$tool" raw.exr --srisp-develop ACEScg -o:datatype=float file.exr && same one.exr file.exr; }
check "of a RAW-like file as of a photo" from_file
by_steps() {
    "$tool" "$photo" --srisp-unprocess "$reference" --label x --srisp-develop ACEScg -o:datatype=float steps.exr &&
        same one.exr steps.exr
}
check "in one pass as in two" by_steps
query() {
    OIIO_LIBRARY_PATH=$plugins oiiotool -i:now=1 "photo.jpg.srisp?reference=$reference&develop=lin_ap1" \
        -o:datatype=float query.exr && same one.exr query.exr
}
check "by a query, under another name of the space" query
alone() {
    OIIO_LIBRARY_PATH=$plugins oiiotool -i:now=1 "raw.exr.srisp?develop=ACEScg" -o:datatype=float alone.exr &&
        same one.exr alone.exr && "$tool" "$reference" --srisp-develop ACEScg -o:datatype=float camera.exr &&
        OIIO_LIBRARY_PATH=$plugins OPENIMAGEIO_DEBUG=0 oiiotool -i:now=1 "reference.dng.srisp?develop=ACEScg" \
            -o:datatype=float alone.exr && same camera.exr alone.exr
}
check "by a query without a reference: a RAW-like image, a camera's file" alone
read_again() { # as a photo that says its space
    "$tool" "$reference" --srisp-develop ACEScg -o:datatype=float plate.exr &&
        oiiotool plate.exr --eraseattrib chromaticities -o:datatype=float named.exr &&
        "$tool" plate.exr --srisp-unprocess "$reference" -o:datatype=float a.exr &&
        "$tool" named.exr --srisp-unprocess "$reference" -o:datatype=float b.exr && near a.exr b.exr 1e-5 &&
        oiiotool named.exr --eraseattrib colorInteropID -o:datatype=float plain.exr &&
        "$tool" plain.exr --srisp-unprocess "$reference" -o:datatype=float c.exr && ! same a.exr c.exr >/dev/null
}
check "a plate is read as ACEScg by its chromaticities or its identifier" read_again
of_codes() {
    "$tool" raw.exr -o raw16.dng && "$tool" raw16.dng --srisp-develop ACEScg -o:datatype=float codes.exr &&
        near one.exr codes.exr 2e-3
}
check "of our DNG of integers" of_codes
threads() {
    "$tool" --threads 1 raw.exr --srisp-develop ACEScg -o:datatype=float threads.exr && same one.exr threads.exr
}
check "for any number of threads" threads
of_dng() {
    "$tool" "$photo" --srisp-unprocess "$reference" -o:datatype=float raw.dng &&
        "$tool" raw.dng --srisp-develop ACEScg -o:datatype=float dng.exr && near one.exr dng.exr 2e-4
}
check "of our DNG as of our EXR" of_dng
of_tiff() { # which keeps no matrices: those of the parameters are near
    "$tool" raw.exr -o:datatype=float raw.tif && "$tool" raw.tif --srisp-develop ACEScg -o:datatype=float tif.exr 2>notes &&
        grep -q "no colour matrix is known of the camera; the one of the parameters was taken" notes
}
check "of a TIFF by the parameters' matrix, which is said" of_tiff
both_ends() {
    "$tool" raw.exr --srisp-develop:highlights=keep ACEScg -o:datatype=float keep.exr \
        --srisp-process -o:datatype=float home.tif && "$tool" raw.exr --srisp-process -o:datatype=float back.tif &&
        near home.tif back.tif 1e-4 && "$tool" keep.exr --srisp-process -o:datatype=float stored.tif &&
        same home.tif stored.tif
}
check "and back, as from the RAW-like image" both_ends
clipped_ends() {
    "$tool" one.exr --srisp-process -o:datatype=float clipped.tif && near clipped.tif back.tif 0.02
}
check "and back from clipped highlights" clipped_ends

exposed() {
    "$tool" raw.exr --srisp-develop:exposure=1 ACEScg -o:datatype=float brighter.exr &&
        oiiotool brighter.exr --mulc 0.5 -o:datatype=float half.exr && near one.exr half.exr 1e-6
}
check "exposure doubles" exposed
balanced() {
    "$tool" raw.exr --srisp-develop:whitebalance=3200,10 ACEScg -o:datatype=float warm.exr &&
        "$tool" raw.exr --srisp-develop:whitebalance=reference ACEScg -o:datatype=float plate.exr &&
        ! same warm.exr plate.exr >/dev/null && ! same one.exr warm.exr >/dev/null
}
check "white balance" balanced
held() {
    for frame in 0001 0002; do cp "$photo" shot.$frame.jpg; done
    "$tool" --frames 1-2 shot.#.jpg --srisp-unprocess:hold=1 "$reference" --srisp-develop ACEScg -o:datatype=float p.#.exr &&
        same p.0001.exr p.0002.exr && same p.0001.exr one.exr
}
check "a sequence" held
alpha() {
    oiiotool "$photo" --ch R,G,B,A=0.5 --premult -o a.tif && "$tool" a.tif --srisp-unprocess "$reference" \
        --srisp-develop ACEScg -o:datatype=float a.exr && oiiotool a.exr --unpremult --ch R,G,B -o:datatype=float u.exr &&
        "$tool" a.tif --unpremult --ch R,G,B --srisp-unprocess "$reference" --srisp-develop ACEScg \
            -o:datatype=float opaque.exr && near u.exr opaque.exr 2e-3
}
check "with alpha as without" alpha

tags() {
    [ "$(value one.exr unprocess:colorspace)" = '"ACEScg"' ] && [ "$(value one.exr colorInteropID)" = '"lin_ap1_scene"' ] &&
        value one.exr chromaticities | grep -q '0.713, 0.293' && value one.exr adoptedNeutral | grep -q '0.32168'
}
check "tags of ACEScg" tags
no_tags() { # camera RGB has no chromaticities and no name of a space
    [ "$(value raw.exr unprocess:colorspace)" = '"camera_rgb"' ] && [ -z "$(value raw.exr colorInteropID)" ] &&
        [ -z "$(value raw.exr chromaticities)" ]
}
check "none of them on camera RGB" no_tags
stray_tag() {
    oiiotool "$photo" --sattrib colorInteropID srgb_rec709_scene -o stray.exr &&
        "$tool" stray.exr --srisp-unprocess:input=srgb "$reference" -o stray_raw.exr &&
        [ -z "$(value stray_raw.exr colorInteropID)" ]
}
check "nor a photo's" stray_tag

camera_file() { # white balance of the file, and upright by its tag
    "$tool" "$reference" --srisp-develop ACEScg -o:datatype=float camera.exr &&
        [ "$(value camera.exr colorInteropID)" = '"lin_ap1_scene"' ] &&
        value camera.exr chromaticities | grep -q '0.713, 0.293' && [ -z "$(value camera.exr unprocess:record)" ] &&
        says 1 "is not a RAW-like image of srisp's" "$tool" camera.exr --srisp-process -o camera.png
}
check "a camera's file" camera_file

check "a photo is none" says 1 "is neither a RAW-like image of srisp's nor a camera's RAW file" \
    "$tool" "$photo" --srisp-develop ACEScg -o no.exr
check "nor what is developed" says 1 "is developed already, into ACEScg" "$tool" one.exr --srisp-develop ACEScg -o no.exr
check "nor a mosaic" says 1 "mosaic" \
    "$tool" "$photo" --srisp-unprocess "$reference" --srisp-mosaic --srisp-develop ACEScg -o no.exr
check "nor a processed picture" says 1 "processed" "$tool" raw.exr --srisp-process --srisp-develop ACEScg -o no.exr
check "a developed image has no mosaic" says 1 "is developed" "$tool" one.exr --srisp-mosaic -o no.exr
check "is no reference" says 1 "is developed into ACEScg and cannot be a reference" \
    "$tool" "$photo" --srisp-unprocess one.exr -o no.exr
check "is no DNG" says 1 "a DNG holds camera RGB" "$tool" one.exr -o no.dng
check "is no photo" says 1 "is a RAW-like image already" "$tool" one.exr --srisp-unprocess "$reference" -o no.exr
check "a space that nobody knows" says 2 "did you mean 'ACEScg'" "$tool" raw.exr --srisp-develop ACESgc -o no.exr
check "a space of displays" says 2 "unknown scene-linear colour space 'sRGB'" "$tool" raw.exr --srisp-develop sRGB -o no.exr
check "a white that is none" says 2 "whitebalance 'warm' is none of" \
    "$tool" raw.exr --srisp-develop:whitebalance=warm ACEScg -o no.exr
check "an exposure that is none" says 2 "exposure '50' is no number" \
    "$tool" raw.exr --srisp-develop:exposure=50 ACEScg -o no.exr
check "an option of another command" says 2 "unknown modifier 'hold'" "$tool" raw.exr --srisp-develop:hold=1 ACEScg -o no.exr
check "no output of all these" [ ! -e no.exr ]
check "no temporary files" nothing_left
finish
