# SPDX-License-Identifier: Apache-2.0
# OpenColorIO's own tools: ociocheck, ociochecklut, ocioconvert on the CPU and, under Xvfb with software GL, on the GPU.
. "${0%/*}/ocio_setup.sh"
command -v ociocheck >/dev/null || skip "needs opencolorio-tools"

here=$scratch/reference.dng
clean() {
    "$@" >"$scratch/ociocheck.log" 2>&1 || { cat "$scratch/ociocheck.log"; return 1; }
    ! grep -iE "warning|error|not found|failed" "$scratch/ociocheck.log"
}
check "ociocheck has no warnings, without a reference" clean ociocheck --iconfig "$OCIO"
check "and with one" clean env SRISP_REFERENCE="$here" ociocheck --iconfig "$OCIO"

# Its pixel of a plain grey against the library's.
"$tool" photo.jpg --srisp-params reference.dng 2>/dev/null >look.json
oiiotool --create 1x1 3 --fill:color=0.6,0.5,0.3 1x1 -d float -o grey.tif
"$tool" grey.tif --srisp-unprocess:params=look.json:input=srgb - -o:datatype=float grey.exr 2>/dev/null
ociochecklut reference.dng.unprocess.clf 0.6 0.5 0.3 >pixel.txt
near_pixel() {
    iinfo --stats grey.exr | sed -n 's/.*Stats Avg: *\([0-9. ]*\)(.*/\1/p' >expected.txt
    cat pixel.txt expected.txt
    paste -d' ' pixel.txt expected.txt | awk '{ for (c = 1; c <= 3; c++) { d = $c - $(c + 3); if (d * d > 1e-6 || NF < 6) exit 1 } }'
}
check "ociochecklut gives the library's pixel" near_pixel
check "ociochecklut knows all that is in a bake" sh -c \
    'ociochecklut -v reference.dng.process.clf >lut.log 2>&1 && ! grep -iE "warning|unrecognized" lut.log'

oiiotool photo.jpg -d float -o photo.tif # ocioconvert writes what it reads: 8 bits of a JPEG
with "$here" ocioconvert photo.tif sRGB cpu.exr "$camera" >/dev/null
check "ocioconvert gives the library's pixels" near cpu.exr raw.exr 1e-3
with "$here" ocioconvert raw.exr "$camera" cpu_back.tif sRGB >/dev/null
check "and back" near cpu_back.tif back.tif 1e-3
if command -v xvfb-run >/dev/null; then
    with "$here" xvfb-run -a ocioconvert --gpu -v photo.tif sRGB gpu.exr "$camera" >gpu.log
    check "there is a GPU renderer" grep -q "GL Renderer" gpu.log
    check "the GPU path agrees with the CPU" near gpu.exr cpu.exr 1e-3
    with "$here" xvfb-run -a ocioconvert --gpu raw.exr "$camera" gpu_back.tif sRGB >/dev/null
    check "and back" near_but_for_black gpu_back.tif cpu_back.tif
else
    echo "SKIPPED ${0##*/}: the GPU path needs xvfb-run"
fi
finish
