# SPDX-License-Identifier: Apache-2.0
# PyOpenColorIO with a context: two references in one process; what a changed bake needs.
. "${0%/*}/ocio_setup.sh"
/usr/bin/python3 -c "import PyOpenColorIO, numpy" 2>/dev/null || skip "needs python3-pyopencolorio"

mkdir second
cp reference.dng second/
oiiotool photo.jpg --mulc 0.6,0.8,1 -o dark.jpg
$bake --reference second/reference.dng --source dark.jpg --quiet
library dark.jpg second/reference.dng dark_raw.exr dark_back.tif
"$tool" raw.exr --srisp-develop lin_rec709 -o:datatype=float developed.exr
cat >context.py <<'END'
import copy
import os
import subprocess
import sys

import numpy
import OpenImageIO as oiio
import PyOpenColorIO as ocio

config = ocio.Config.CreateFromFile(os.environ["OCIO"])


def pixels(path):
    return oiio.ImageBuf(path).get_pixels(oiio.FLOAT)


def unprocessed(photo, reference):
    context = copy.deepcopy(config.getCurrentContext())
    context["SRISP_REFERENCE"] = reference
    processor = config.getProcessor(context, "sRGB", "srisp camera RGB")
    image = numpy.ascontiguousarray(pixels(photo))
    processor.getDefaultCPUProcessor().applyRGB(image)
    return image


def check_near(a, b):
    difference = numpy.abs(a - b).max()
    assert difference <= 1e-3, difference


first, second = os.path.abspath("reference.dng"), os.path.abspath("second/reference.dng")
check_near(unprocessed("photo.jpg", first), pixels("raw.exr"))
check_near(unprocessed("dark.jpg", second), pixels("dark_raw.exr"))

# Developed, into the working space.
context = copy.deepcopy(config.getCurrentContext())
context["SRISP_REFERENCE"] = first
plate = numpy.ascontiguousarray(pixels("photo.jpg"))
config.getProcessor(context, "srisp photo", ocio.ROLE_SCENE_LINEAR).getDefaultCPUProcessor().applyRGB(plate)
check_near(plate, pixels("developed.exr"))
check_near(unprocessed("photo.jpg", first), pixels("raw.exr"))

# A bake that changes while the process runs: OpenColorIO keeps what it has read. Another name counts at once; the same
# name when the caches are cleared and the config is loaded again.
bake = [sys.argv[1], "--reference", first, "--source", "dark.jpg", "--quiet"]
subprocess.run(bake, check=True)
subprocess.run(bake + ["-o", "version2"], check=True)
check_near(unprocessed("photo.jpg", first), pixels("raw.exr"))
check_near(unprocessed("dark.jpg", os.path.abspath("version2")), pixels("dark_raw.exr"))
ocio.ClearAllCaches()
config = ocio.Config.CreateFromFile(os.environ["OCIO"])
check_near(unprocessed("dark.jpg", first), pixels("dark_raw.exr"))
END
check "two references at once, and when a changed bake counts" \
    /usr/bin/python3 context.py "$bake"
with "$scratch/reference.dng" oiiotool dark.jpg --ociolook "$unprocess" -o:datatype=float new_process.exr
check "a new process reads the changed bake" near new_process.exr dark_raw.exr 1e-3

cat >missing.py <<'END'
import copy
import os
import PyOpenColorIO as ocio

config = ocio.Config.CreateFromFile(os.environ["OCIO"])
context = copy.deepcopy(config.getCurrentContext())
context["SRISP_REFERENCE"] = "/nowhere/r.dng"
try:
    config.getProcessor(context, "sRGB", "srisp camera RGB")
except ocio.ExceptionMissingFile as error:
    assert "/nowhere/r.dng.unprocess.clf" in str(error), error
else:
    raise SystemExit("no exception")
END
check "a missing bake is an exception that names the file" /usr/bin/python3 missing.py
finish
