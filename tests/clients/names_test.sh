# SPDX-License-Identifier: Apache-2.0
# Query names and configuration hints in programs that know nothing of srisp.
. "${0%/*}/setup.sh"

check "oiiotool reads a query name" test -s expected.exr
check "its output carries the parameters" prints 'white_balance' iinfo -v expected.exr
check "its output says that it is synthetic" prints 'synthetic RAW-like image' iinfo -v expected.exr
check "its output names its colour space" prints 'unprocess:colorspace: "camera_rgb"' iinfo -v expected.exr
check "its output carries the camera's matrix" prints 'unprocess:xyz_to_camera' iinfo -v expected.exr
check "iinfo reads a query name" prints "160 x" iinfo "$name"
check "iinfo reads the header only, if asked to" prints "160 x" iinfo "$name&lazy=1"
check "idiff reads a query name" same expected.exr "$name"
check "iconvert writes the same pixels" sh -c 'iconvert "$1" converted.exr && idiff -q -fail 0 -warn 0 expected.exr converted.exr' - "$name"
check "iconvert keeps the parameters" prints 'white_balance' iinfo -v converted.exr

oiiotool --iconfig srisp:reference reference.dng -i photo.jpg.srisp -o hint.exr
check "a configuration hint does what a query does" same expected.exr hint.exr

cat >read.py <<'END'
import sys
import OpenImageIO as oiio
source = oiio.ImageInput.open(sys.argv[1])
assert source, oiio.geterror()
spec, pixels = source.spec(), source.read_image(oiio.FLOAT)
assert '"parameters":{' in spec.getattribute("ImageDescription")
target = oiio.ImageOutput.create(sys.argv[2])
assert target.open(sys.argv[2], spec) and target.write_image(pixels) and target.close()
buffer = oiio.ImageBuf(sys.argv[1])
assert buffer.write(sys.argv[3]), buffer.geterror()
END
check "Python reads a query name" /usr/bin/python3 read.py "$name" python.exr python_buffer.exr
check "Python's ImageInput gives the same pixels" same expected.exr python.exr
check "Python's ImageBuf gives the same pixels" same expected.exr python_buffer.exr

mkdir "odd folder"
cp photo.jpg "odd folder/a photo.jpg"
cp reference.dng "odd folder/100%.dng"
oiiotool "odd folder/a photo.jpg.srisp?reference=odd%20folder/100%25.dng" -o odd.exr
check "a query is percent-decoded" same expected.exr odd.exr

cp reference.dng "odd folder/x*;y[1].dng"
oiiotool "photo.jpg.srisp?reference=odd folder/x*;y[1].dng;odd folder/100%25.dng&seed=18446744073709551615" -o odd.exr
check "odd names in a list, and the largest seed" same expected.exr odd.exr

for type in exr tif png jpg; do
    case $type in jpg) depth=uint8 ;; exr) depth=half ;; *) depth=uint16 ;; esac
    oiiotool "$name" -d "$depth" -o "raw.$type"
    oiiotool "raw.$type.srisp?direction=forward" -o "back_$type.png"
    check "what $type recorded is taken back" test -s "back_$type.png"
    [ $type = jpg ] || check "the picture made from $type is near the photo" \
        idiff -q -fail 0.2 -failpercent 5 -hardfail 0.6 "back_$type.png" photo.jpg
done
check "the picture made back is sRGB, and not RAW-like" \
    sh -c '! iinfo -v back_exr.png | grep -q "RAW-like image, computed"'

oiiotool photo.jpg --tile 64 64 --attrib textureformat "Plain Texture" -o:tile=64x64 tiled.tif
oiiotool "tiled.tif.srisp?reference=reference.dng" -o tiled.exr
check "a tiled photo gives the same pixels" same expected.exr tiled.exr
check "few tiles in the cache give the same pixels" sh -c \
    'oiiotool --cache 1 --autotile 16 "$1" -o cached.exr && idiff -q -fail 0 -warn 0 expected.exr cached.exr' - "$name"
check "one thread gives the same pixels" sh -c \
    'oiiotool --threads 1 "$1" -o one.exr && idiff -q -fail 0 -warn 0 expected.exr one.exr' - "$name"
finish
