# SPDX-License-Identifier: Apache-2.0
"""DNG files out of stock OpenImageIO programs and srisptool, into other people's RAW programs.

Usage: dng_test.py BUILD SOURCE
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

build, source = (Path(argument).resolve() for argument in sys.argv[1:3])
plugins = next((build / "lib").rglob("dng.imageio.so")).parent
os.environ["OIIO_LIBRARY_PATH"] = str(plugins)

import numpy as np
import OpenImageIO as oiio

TOOL = str(build / "bin" / "srisptool")
REFERENCE = str(source / "configs" / "sample" / "reference.dng")
PHOTO = str(source / "configs" / "sample" / "photo.jpg")
SRGB_TO_XYZ = np.array([[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750],
                        [0.0193339, 0.1191920, 0.9503041]])
failures = checks = 0


def check(what, good, detail=""):
    global failures, checks
    checks += 1
    if not good:
        failures += 1
        print(f"FAILED {what}: {detail}", flush=True)


def run(*words, cwd=None):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, errors="replace", cwd=cwd)


def works(what, *words):
    done = run(*words)
    check(what, done.returncode == 0, f"exit code {done.returncode}: {done.stderr[-500:]}")
    return done


def pixels(path):
    buffer = oiio.ImageBuf(str(path))
    values = buffer.get_pixels(oiio.FLOAT)
    if values is None:
        return np.zeros((1, 1, 3))
    return np.asarray(values).reshape(buffer.spec().height, buffer.spec().width, buffer.spec().nchannels)


def has(program):
    if shutil.which(program):
        return True
    print(f"SKIPPED dng_test.py: needs {program}", flush=True)
    return False


def exif(path):
    return json.loads(run("exiftool", "-json", "-n", "-a", path).stdout)[0]


# -- writing -----------------------------------------------------------------------------------------------------------

folder = Path(tempfile.mkdtemp())
kinds = {}


def write(name, *words, modifiers=""):
    path = folder / f"{name}.dng"
    works(f"srisptool writes {name}", TOOL, PHOTO, "--srisp-unprocess", REFERENCE, *words, "-o" + modifiers, path)
    kinds[name] = path


write("mosaic", "--srisp-mosaic")
write("noisy", "--srisp-mosaic", "--srisp-noise", "shot=0.0005,read=0.00001")
write("cinema", "--srisp-mosaic", modifiers=":layout=cinema")
write("plain", "--srisp-mosaic", modifiers=":layout=cinema:compression=none")
write("bits12", "--srisp-mosaic", modifiers=":bits=12:compression=none")
write("bggr", "--srisp-mosaic:phase=BGGR")
write("colours")
write("colours_plain", modifiers=":compression=none")

raw = folder / "raw.exr"
works("the RAW-like image", TOOL, PHOTO, "--srisp-unprocess", REFERENCE, "-o", raw)
expected = pixels(raw)

for name in ("one.dng", "two.dng"):
    works(f"stock oiiotool writes {name}", "oiiotool", raw, "--attrib", "dng:layout", "cinema", "-o", folder / name)
check("the same bytes each time", (folder / "one.dng").read_bytes() == (folder / "two.dng").read_bytes())
works("iconvert", "iconvert", raw, folder / "iconvert.dng")
kinds["iconvert"] = folder / "iconvert.dng"

spec = oiio.ImageSpec(64, 48, 1, oiio.FLOAT)
spec.attribute("unprocess:cfa_pattern", "GRBG")
spec.attribute("dng:layout", "cinema")
spec.attribute("oiio:BitsPerSample", 12)
output = oiio.ImageOutput.create("python.dng")
check("Python finds the writer", output is not None and output.format_name() == "dng")
values = np.linspace(0, 1, 64 * 48, dtype=np.float32).reshape(48, 64, 1)
kinds["python"] = folder / "python.dng"
check("Python writes", output.open(str(kinds["python"]), spec) and output.write_image(values) and output.close(),
      output.geterror())
reader = oiio.ImageInput.open(str(kinds["python"]))
check("OpenImageIO's own reader goes on reading DNG", reader is not None and reader.format_name() == "raw")

bad = folder / "bad.dng"
refused = run("oiiotool", raw, "--attrib", "dng:layout", "cine", "-o", bad)
check("an unknown layout", refused.returncode == 1 and "did you mean 'cinema'?" in refused.stderr, refused.stderr)
refused = run(TOOL, PHOTO, "--srisp-unprocess", REFERENCE, "-o:layout=cine", bad)
check("an unknown layout, srisptool", refused.returncode == 1 and refused.stderr.count("\n") == 1
      and f"'{bad}': unknown dng:layout 'cine'; did you mean 'cinema'?" in refused.stderr, refused.stderr)
refused = run(TOOL, PHOTO, "--srisp-unprocess", REFERENCE, "--ch", "R,G", "-o", bad)
check("two channels", refused.returncode == 1 and "image of 2 channels" in refused.stderr, refused.stderr)
check("nothing half-written", not bad.exists() and not list(folder.glob("*temp*")))

photo_only = run(TOOL, PHOTO, "-o", folder / "photo.dng")
check("a photo that was never unprocessed", photo_only.returncode == 0 and "was never unprocessed" in photo_only.stderr,
      photo_only.stderr)
kinds["photo"] = folder / "photo.dng"
check("-q is quiet", run(TOOL, "-q", PHOTO, "-o", folder / "quiet.dng").stderr == "")

# -- reading back ------------------------------------------------------------------------------------------------------

for name in ("mosaic", "cinema", "bits12", "bggr", "colours"):
    back = folder / f"{name}_back.png"
    works(f"{name} is processed to a photo", TOOL, kinds[name], "--srisp-process", "-d", "uint8", "-o", back)
    photo = pixels(back)
    original = pixels(folder / "colours_back.png") if (folder / "colours_back.png").exists() else pixels(PHOTO)
    if photo.shape == original.shape:
        difference = np.abs(photo - original).mean()
        check(f"{name} looks like the photo again", difference < 0.05, f"mean difference {difference:.4f}")
    else:
        check(f"{name} looks like the photo again", False, f"{photo.shape} and {original.shape}")
for name in ("mosaic", "cinema", "colours"):
    again = works(f"{name} is a reference", TOOL, PHOTO, "--srisp-unprocess", kinds[name], "-o", folder / "again.exr")
    difference = np.abs(pixels(folder / "again.exr") - expected).mean()
    check(f"{name} as a reference gives nearly what it was made with", difference < 0.02, f"mean difference {difference:.4f}")

# -- other people's programs -------------------------------------------------------------------------------------------

if has("exiftool"):
    for name, path in kinds.items():
        said = run("exiftool", "-validate", "-warning", "-a", path).stdout
        check(f"exiftool validates {name}", "Validate" in said and ": OK" in said, said)
    tags = exif(kinds["noisy"])
    check("NoiseProfile", np.allclose([float(v) for v in str(tags["NoiseProfile"]).split()], [0.0005, 0.00001] * 3),
          tags.get("NoiseProfile"))
    check("the mark", "no sensor recorded it" in str(tags.get("Description", "")), tags.get("Description"))
    check("BackwardVersion as low as can be", tags["DNGBackwardVersion"] == "1 1 0 0", tags["DNGBackwardVersion"])
    check("bits", exif(kinds["python"])["BitsPerSample"] == 12)

parameters = json.loads(run(TOOL, PHOTO, "--srisp-params", REFERENCE).stdout)
gains = np.array(parameters["white_balance"])
# Daylight's, which dcraw takes.
reference_matrix = np.array([float(v) for v in str(exif(REFERENCE)["ColorMatrix2"]).split()]).reshape(3, 3) \
    if shutil.which("exiftool") else None


def developed(camera):
    """Camera RGB to linear sRGB, as dcraw does: white balance, then the matrix whose inverse's rows sum to 1."""
    to_camera = reference_matrix @ SRGB_TO_XYZ
    to_camera /= to_camera.sum(1, keepdims=True)
    scale = gains / gains.min()
    return np.clip(np.clip(camera * scale, 0, 1) @ np.linalg.inv(to_camera).T, 0, 1)


if has("dcraw") and reference_matrix is not None:
    for name in ("mosaic", "plain", "bggr"):
        tiff = kinds[name].with_suffix(".tiff")
        works(f"dcraw develops {name}", "dcraw", "-4", "-o", "1", "-w", "-T", kinds[name])
        means = pixels(tiff)[..., :3].mean((0, 1))
        wanted = developed(expected).mean((0, 1))
        check(f"dcraw's colours of {name}", np.all(np.abs(means / wanted - 1) < 0.02), f"{means / wanted}")
if has("dcraw_emu"):
    for name, path in kinds.items():
        works(f"dcraw_emu develops {name}", "dcraw_emu", "-w", "-o", "1", "-T", "-Z", folder / f"{name}_emu.tiff", path)


def looks_like_the_photo(what, path):
    """By default settings no program gives the photo itself: the same scene, upright, not black, not tinted."""
    if not Path(path).exists():
        check(what, False, "no picture")
        return
    small = [oiio.ImageBufAlgo.resize(oiio.ImageBuf(str(p)), roi=oiio.ROI(0, 48, 0, 32, 0, 1, 0, 3))
             .get_pixels(oiio.FLOAT).mean(2).ravel() for p in (path, PHOTO)]
    likeness = np.corrcoef(small[0], small[1])[0, 1]
    colours = pixels(path)[..., :3].mean((0, 1))
    check(what, likeness > 0.85 and colours.max() < 2.5 * colours.min() and colours.mean() > 0.03,
          f"correlation {likeness:.3f}, means {colours}")


clients = ("mosaic", "noisy", "cinema", "colours", "photo")
if has("rawtherapee-cli"):
    for name in clients:
        tiff = folder / f"{name}_rawtherapee.tif"
        works(f"rawtherapee-cli opens {name}", "rawtherapee-cli", "-o", tiff, "-t", "-b8", "-Y", "-d", "-c", kinds[name])
        looks_like_the_photo(f"RawTherapee's picture of {name}", tiff)
if has("darktable-cli"):
    for name in clients:
        tiff = folder / f"{name}_darktable.tif"
        works(f"darktable-cli opens {name}", "darktable-cli", kinds[name], tiff, "--core", "--configdir",
              folder / "darktable", "--library", ":memory:")
        looks_like_the_photo(f"darktable's picture of {name}", tiff)

shutil.rmtree(folder)
print(f"{checks - failures} passed, {failures} failed")
sys.exit(failures != 0)
