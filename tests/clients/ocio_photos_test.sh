# SPDX-License-Identifier: Apache-2.0
# Real photos and RAW files: the bakes in oiiotool stay within 2e-3 of the library.
. "${0%/*}/ocio_setup.sh"
[ -d "$shared/data/photos" ] && [ -d "$shared/data/raw" ] || skip "needs $shared/data/photos and raw"

for reference in gopro_hero6.dng canon_eos_d30.crw nikon_d1.nef; do
    ln -sf "$(readlink -f "$shared/data/raw/$reference")" "$reference"
    for photo in $(ls "$shared/data/photos" | grep 'jpg$' | sed -n '3p;30p;77p'); do
        picture=$shared/data/photos/$photo
        $bake --reference "$reference" --source "$picture" --quiet
        library "$picture" "$reference" real.exr real_back.tif
        with "$scratch/$reference" oiiotool "$picture" --ociolook "$unprocess" -o:datatype=float ocio.exr
        check "$photo as $reference" near ocio.exr real.exr 2e-3
        with "$scratch/$reference" oiiotool real.exr --ociolook "$process" -o:datatype=float ocio_back.tif
        check "and back" near ocio_back.tif real_back.tif 2e-3
    done
done
finish
