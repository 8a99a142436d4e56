# SPDX-License-Identifier: Apache-2.0
"""DNG files out of stock programs (oiiotool, iconvert, Python), and what RAW programs make of them.

Usage: dng_hosts_test.py BUILD SOURCE
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

build, source = (Path(argument).resolve() for argument in sys.argv[1:3])
plugin = next((build / "lib").rglob("dng.imageio.so"))
os.environ["OIIO_LIBRARY_PATH"] = str(plugin.parent)

import numpy as np
import OpenImageIO as oiio

scratch = tempfile.TemporaryDirectory()
os.chdir(scratch.name)
os.environ["HOME"] = scratch.name  # programs write their settings there
SAMPLE = source / "configs" / "sample"
PHASES = ("RGGB", "GRBG", "GBRG", "BGGR")
XYZ_FROM_SRGB = np.array([[0.412391, 0.357584, 0.180481], [0.212639, 0.715169, 0.072192], [0.019331, 0.119195, 0.950532]])

failures = checks = 0


def check(what, good, detail=""):
    global failures, checks
    checks += 1
    if not good:
        failures += 1
        print(f"FAILED {what}: {detail}", flush=True)


def run(*command):
    """Exit code, stdout and stderr."""
    done = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=120, stdin=subprocess.DEVNULL)
    return done.returncode, done.stdout, done.stderr


def has(program):
    if shutil.which(program):
        return True
    print(f"SKIPPED dng_hosts_test.py: needs {program}")
    return False


def messages(stderr):
    """Without the command line that oiiotool repeats under its errors; iconvert's errors have two lines."""
    stderr = stderr.replace(" :\n\t", ": ")
    return [line for line in stderr.splitlines() if line.strip() and not line.startswith(("Full command line", "> "))]


def refused(what, text, *command, output="x.dng"):
    """One message with `text` in it, and no file."""
    if os.path.exists(output):
        os.unlink(output)
    code, _, stderr = run(*command)
    told = messages(stderr)
    check(what, code == 1 and len(told) == 1 and text in told[0], f"exit code {code}: {stderr!r}")
    check(what + ": no file", not os.path.exists(output), os.listdir(os.path.dirname(output) or "."))


# -- images ------------------------------------------------------------------------------------------------------------


def read(name):
    image = oiio.ImageBuf(name)
    check(f"{name} can be read", not image.has_error, image.geterror() if image.has_error else "")
    return np.asarray(image.get_pixels(oiio.FLOAT)), image.spec()


def save(name, pixels, spec, **attributes):
    """'' or what the writer says."""
    spec = oiio.ImageSpec(spec)
    spec.height, spec.width = pixels.shape[:2]
    spec.full_height, spec.full_width = spec.height, spec.width
    spec.nchannels = pixels.shape[2]
    spec.channelnames = ("R", "G", "B", "A")[: spec.nchannels] if spec.nchannels > 1 else ("Y",)
    for key, value in attributes.items():
        spec.attribute(key.replace("__", ":"), value)
    output = oiio.ImageOutput.create(name)
    if not output:
        return oiio.geterror()
    good = output.open(name, spec) and output.write_image(np.ascontiguousarray(pixels, np.float32)) and output.close()
    return "" if good else output.geterror()


def mosaic(pixels, phase):
    plane = np.zeros(pixels.shape[:2] + (1,))
    for y in range(2):
        for x in range(2):
            plane[y::2, x::2, 0] = pixels[y::2, x::2, "RGB".index(phase[y * 2 + x])]
    return plane


def patches(spec, width, height):
    """Flat colours as the recorded camera sees them, and the linear sRGB that it saw."""
    seen = [(0.2, 0.2, 0.2), (0.4, 0.25, 0.2), (0.15, 0.3, 0.2), (0.2, 0.2, 0.4)]
    camera = camera_from_srgb(spec)
    pixels = np.zeros((height, width, 3))
    for i, color in enumerate(seen):
        pixels[:, i * width // 4 : (i + 1) * width // 4] = camera @ color
    # Noise, since RawTherapee 5.9 takes no file under 100,000 bytes for a RAW one: flat colours need fewer.
    return pixels + np.random.default_rng(1).normal(0, 0.003, pixels.shape), seen


def camera_from_srgb(spec):
    """As dcraw has it: the matrix for daylight, white to white, and the scene's neutral."""
    which = "2" if spec.get_int_attribute("unprocess:xyz_to_camera2_illuminant") == 21 else ""
    matrix = np.array(spec.getattribute(f"unprocess:xyz_to_camera{which}")).reshape(3, 3) @ XYZ_FROM_SRGB
    neutral = np.array(spec.getattribute("unprocess:neutral")).reshape(3)
    return matrix / matrix.sum(axis=1, keepdims=True) * neutral[:, None]


def pnm(path):
    with open(path, "rb") as file:
        data = file.read()
    kind, width, height, most = re.match(rb"(P[56])\s+(\d+)\s+(\d+)\s+(\d+)\s", data).groups()
    start = re.match(rb"P[56]\s+\d+\s+\d+\s+\d+\s", data).end()
    kinds = {b"65535": ">u2", b"255": "u1"}
    return np.frombuffer(data, kinds[most], offset=start).reshape(int(height), int(width), 3 if kind == b"P6" else 1)


# -- the stock hosts ---------------------------------------------------------------------------------------------------

shutil.copy(SAMPLE / "reference.dng", "reference.dng")
run("oiiotool", str(SAMPLE / "photo.jpg"), "--resize", "320x0", "-o", "photo.jpg")
RESULT = "photo.jpg.srisp?reference=reference.dng"
MOSAIC = RESULT + "&mosaic=GRBG"
_, SPEC = read(RESULT)


def written(what, name, *command):
    code, _, stderr = run(*command)
    check(what, code == 0 and os.path.exists(name), f"exit code {code}: {stderr!r}")
    return stderr


def names_test():
    written("oiiotool writes a mosaic", "o.dng", "oiiotool", MOSAIC, "-o", "o.dng")
    written("iconvert writes a mosaic", "i.dng", "iconvert", MOSAIC, "i.dng")
    pixels, spec = read(MOSAIC)
    check("Python writes a mosaic", save("p.dng", pixels, spec) == "")
    same = open("o.dng", "rb").read() == open("i.dng", "rb").read()
    check("oiiotool and iconvert write the same file", same)
    for phase in PHASES:
        name = f"{phase}.dng"
        written(f"a mosaic of {phase}", name, "oiiotool", RESULT + "&mosaic=" + phase, "-o", name)
    written("tiles", "t.dng", "oiiotool", MOSAIC, "--tile", "64", "64", "-o", "t.dng")
    check("tiles give the same file", open("t.dng", "rb").read() == open("o.dng", "rb").read())
    written("a user's own mosaic", "own.dng", "oiiotool", "--pattern", "constant:color=0.25", "64x48", "1",
            "--attrib", "unprocess:cfa_pattern", "BGGR", "-o", "own.dng")


def windows_test():
    """A crop is the data window, with its own phase; nothing is filled up with black."""
    for window, phase in (("101x99+3+4", "0 1 1 2"), ("64x48+2+2", "1 0 2 1"), ("64x48-3-2", "0 1 1 2")):
        written(f"window {window}", "w.dng", "oiiotool", MOSAIC, "--crop", window, "-o", "w.dng")
        if shutil.which("exiftool"):
            said = run("exiftool", "-s3", "-DefaultCropSize", "-CFAPattern2", "w.dng")[1].splitlines()
            check(f"window {window}", said == [re.split("[-+]", window)[0].replace("x", " "), phase], said)


def reader_test():
    """OpenImageIO's own reader goes on reading DNG."""
    for command in ("iinfo", "oiiotool --info"):
        code, out, stderr = run(*command.split(), "reference.dng")
        check(f"{command} reads a DNG", code == 0 and "768 x  512, 3 channel" in out, out + stderr)
    image = oiio.ImageInput.open("reference.dng")
    check("Python reads a DNG by the RAW reader", image and image.format_name() == "raw")
    environment = dict(os.environ)
    del environment["OIIO_LIBRARY_PATH"]
    bare = subprocess.run(["oiiotool", "--hash", "reference.dng"], env=environment, capture_output=True, text=True).stdout
    check("with the same pixels as without the plugin", bare and bare == run("oiiotool", "--hash", "reference.dng")[1], bare)


def attributes_test():
    sizes = {}
    for name, arguments in {
        "none": ("--compression", "none"),
        "lossless": ("--compression", "lossless"),
        "zips": ("--compression", "zips"),
        "cinema": ("--attrib", "dng:layout", "cinema"),
        "12": ("--attrib", "oiio:BitsPerSample", "12", "--compression", "none"),
    }.items():
        written(name, "a.dng", "oiiotool", MOSAIC, *arguments, "-o", "a.dng")
        sizes[name] = os.path.getsize("a.dng")
    check("lossless is smaller than none", sizes["lossless"] < sizes["none"], sizes)
    check("other formats' compression is as none said", sizes["zips"] == sizes["lossless"], sizes)
    check("cinema has no preview", sizes["cinema"] < sizes["lossless"], sizes)
    for datatype in ("half", "float"):
        stderr = written(datatype, f"{datatype}.dng", "oiiotool", RESULT, "--attrib", "dng:datatype", datatype, "-o",
                         f"{datatype}.dng")
        for program in ("dcraw", "LibRaw", "RawTherapee"):
            check(f"{datatype}: {program} is named", program in stderr, stderr)


def photo_test():
    stderr = written("a photo", "photo.dng", "oiiotool", "photo.jpg", "-o", "photo.dng")
    notes = [line for line in messages(stderr) if "never unprocessed" in line]
    check("a photo: one note says what is assumed", len(notes) == 1 and notes[0].startswith("srisp: note: "), stderr)
    developed, _ = read("photo.dng")
    photo, _ = read("photo.jpg")
    check("a photo's DNG looks like it", np.abs(developed - photo).mean() < 0.02, np.abs(developed - photo).mean())


# -- what cannot be ----------------------------------------------------------------------------------------------------


def refusals_test():
    def made(channels, size="64x48"):
        return ("oiiotool", "--pattern", "constant:color=0.25,0.5,0.75,1,0.1", size, str(channels))

    refused("2 channels", "2 channels", *made(2), "-o", "x.dng")
    # Stock oiiotool leaves alpha out itself, and says so; other hosts are told how to.
    refused("alpha", "--ch R,G,B", "iconvert", "four.exr", "x.dng")
    refused("one channel without its filters", "unprocess:cfa_pattern", *made(1), "-o", "x.dng")
    refused("an unknown phase", "RGBG", *made(1), "--attrib", "unprocess:cfa_pattern", "RGBG", "-o", "x.dng")
    refused("a mistyped layout", "did you mean 'cinema'?", *made(3), "--attrib", "dng:layout", "cinem", "-o", "x.dng")
    refused("a mistyped attribute", "dng:layuot", *made(3), "--attrib", "dng:layuot", "cinema", "-o", "x.dng")
    refused("a mistyped compression", "did you mean 'lossless'?", *made(3), "--compression", "losless", "-o", "x.dng")
    refused("an image too wide", "65535", *made(3, "65536x2"), "-o", "x.dng")
    refused("iconvert's image of two channels", "2 channels", "iconvert", "two.exr", "x.dng")
    for bad in (np.nan, np.inf, -np.inf):
        pixels = np.full((32, 32, 3), 0.5)
        pixels[5, 7, 1] = bad
        message = save("x.dng", pixels, oiio.ImageSpec(32, 32, 3, "float"))
        check(f"{bad} is refused with its place", "x.dng" in message and "(7, 5)" in message, message)
        check(f"{bad}: no file", not os.path.exists("x.dng"))
    spec = oiio.ImageSpec(32, 32, 3, "float")
    for mode in ("AppendSubimage", "AppendMIPLevel"):
        output = oiio.ImageOutput.create("x.dng")
        good = output.open("x.dng", spec) and output.open("x.dng", spec, mode)
        check(f"{mode} is refused", not good and "one image" in output.geterror())
        output.close()
        check(f"{mode}: no file", not os.path.exists("x.dng"))
    written("values outside [0,1] are clipped", "out.dng", "oiiotool", "--pattern", "constant:color=-0.5,0.5,7", "64x48", "3",
            "--attrib", "oiio:ColorSpace", "linear", "-o", "out.dng")


def disks_test():
    """Where a file cannot be written whole, there is none, and the old one stays."""
    os.makedirs("full")
    os.makedirs("read_only")
    mounted = []
    try:
        for folder, options in (("full", "size=40k"), ("read_only", "ro")):
            if run("mount", "-t", "tmpfs", "-o", options, "tmpfs", folder)[0] != 0:
                print("SKIPPED dng_hosts_test.py: mounting a tmpfs is not permitted here")
                return
            mounted.append(folder)
        for host in (("oiiotool", MOSAIC, "-o"), ("iconvert", MOSAIC)):
            refused(f"{host[0]}: a disk that gets full", "No space left", *host, "full/x.dng", output="full/x.dng")
            refused(f"{host[0]}: a read-only folder", "Read-only", *host, "read_only/x.dng", output="read_only/x.dng")
        pixels, spec = read(MOSAIC)
        check("Python: a disk that gets full", "full/x.dng" in save("full/x.dng", pixels, spec))
        check("nothing lies on the full disk", os.listdir("full") == [], os.listdir("full"))
        with open("full/x.dng", "w") as old:
            old.write("old")
        run("oiiotool", MOSAIC, "-o", "full/x.dng")
        check("an old file stays", open("full/x.dng").read() == "old")
        check("and nothing beside it", os.listdir("full") == ["x.dng"], os.listdir("full"))
    finally:
        for folder in mounted:
            run("umount", folder)


# -- RAW programs ------------------------------------------------------------------------------------------------------

KINDS = {
    "standard": (1, {}),
    "standard none": (1, {"compression": "none"}),
    "standard 12": (1, {"dng__bits": 12, "compression": "none"}),
    "cinema": (1, {"dng__layout": "cinema"}),
    "cinema none": (1, {"dng__layout": "cinema", "compression": "none"}),
    "LinearRaw": (3, {}),
    "LinearRaw none": (3, {"compression": "none"}),
    "LinearRaw cinema": (3, {"dng__layout": "cinema"}),
}


def programs_test():
    width, height = 400, 304
    scene, seen = patches(SPEC, width, height)
    _, mosaic_spec = read(RESULT + "&mosaic=RGGB")
    middles = [(width // 8 + i * width // 4) for i in range(4)]
    files = []
    for phase, (kind, (channels, attributes)) in [("RGGB", item) for item in KINDS.items()] + [
        (phase, ("standard", KINDS["standard"])) for phase in PHASES[1:]
    ]:
        name = f"{kind} {phase}.dng".replace(" ", "_")
        if channels == 1:
            _, spec = read(RESULT + "&mosaic=" + phase)
            message = save(name, mosaic(scene, phase), spec, **attributes)
        else:
            message = save(name, scene, SPEC, **attributes)
        check(f"{name} is written", message == "", message)
        files.append(name)

    def colors(what, picture, tolerance):
        for at, expected in zip(middles, seen):
            area = picture[height // 4 : height * 3 // 4, at - 10 : at + 10].reshape(-1, 3).mean(axis=0)
            check(f"{what}: colour {expected}", np.allclose(area, expected, rtol=tolerance), area)

    if has("exiftool"):
        for name in files:
            out = run("exiftool", "-validate", "-warning", "-error", "-a", name)[1]
            check(f"exiftool: {name}", out == "Validate                        : OK\n", out)
    if has("dcraw"):
        for name in files:
            code, _, stderr = run("dcraw", "-4", "-w", "-o", "1", name)
            check(f"dcraw: {name}", code == 0 and stderr == "", stderr)
            colors(f"dcraw: {name}", pnm(name[:-4] + ".ppm") / 65535.0, 0.02)
    if has("dcraw_emu"):
        for name in files:
            code, _, stderr = run("dcraw_emu", "-4", "-w", "-o", "1", name)
            check(f"dcraw_emu: {name}", code == 0 and stderr == "", stderr)
            colors(f"dcraw_emu: {name}", pnm(name + ".ppm") / 65535.0, 0.02)

    def whole(what, path):
        """A picture of the whole scene, whose greys are grey."""
        if not os.path.exists(path):
            check(what, False, "no picture")
            return
        picture, spec = read(path)
        check(f"{what}: size", abs(spec.width - width) <= 16 and abs(spec.height - height) <= 16, (spec.width, spec.height))
        grey = picture[spec.height // 4 : spec.height * 3 // 4, 30:70, :3].reshape(-1, 3).mean(axis=0)
        check(f"{what}: grey", np.ptp(grey) < 0.03 and grey.min() > 0.05, grey)
        at = [spec.width // 8 + i * spec.width // 4 for i in range(1, 4)]
        most = [int(np.argmax(picture[spec.height // 2, x, :3])) for x in at]
        check(f"{what}: red, green and blue", most == [0, 1, 2], most)

    if has("rawtherapee-cli"):
        for name in files:
            run("rawtherapee-cli", "-o", "rt.tif", "-t", "-b8", "-Y", "-d", "-c", name)
            whole(f"rawtherapee-cli: {name}", "rt.tif")
            Path("rt.tif").unlink(missing_ok=True)
    if has("darktable-cli"):
        for name in files:
            run("darktable-cli", name, "dt.tif", "--core", "--configdir", "darktable", "--library", ":memory:")
            whole(f"darktable-cli: {name}", "dt.tif")
            Path("dt.tif").unlink(missing_ok=True)


for channels, name in ((2, "two.exr"), (4, "four.exr")):
    run("oiiotool", "--pattern", "constant:color=0.25,0.5,0.75,1", "64x48", str(channels), "-o", name)
for test in (names_test, windows_test, reader_test, attributes_test, photo_test, refusals_test, disks_test, programs_test):
    try:
        test()
    except Exception as error:  # one test's fault does not hide the others
        check(test.__name__, False, repr(error))
print(f"{checks - failures} passed, {failures} failed")
sys.exit(failures > 0)
