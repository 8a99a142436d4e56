# SPDX-License-Identifier: Apache-2.0
"""Scene-linear development against others: cameras' RAW files against dcraw, and simulated colour charts under three
lights against the observer's colours.

Usage: develop_test.py BUILD SOURCE SHARED
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

build, source, shared = (Path(argument).resolve() for argument in sys.argv[1:4])

import numpy as np
import OpenImageIO as oiio

TOOL = str(build / "bin" / "srisptool")
scratch = tempfile.TemporaryDirectory()
os.chdir(scratch.name)

failures = checks = 0


def check(what, good, detail=""):
    global failures, checks
    checks += 1
    if not good:
        failures += 1
        print(f"FAILED {what}: {detail}", flush=True)


def tool(*words):
    done = subprocess.run([TOOL, *map(str, words)], capture_output=True, text=True, timeout=300)
    check(" ".join(map(str, words)), done.returncode == 0, done.stderr)
    return done.stderr


def pixels(name):
    """Not through ImageBuf, whose cache goes by names."""
    file = oiio.ImageInput.open(str(name))
    if not file:
        raise RuntimeError(oiio.geterror())
    values = np.asarray(file.read_image("float"), np.float64)
    file.close()
    return values


SRGB_TO_XYZ = np.array([[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]])
D65 = np.array([0.95047, 1, 1.08883])
D50 = np.array([0.96422, 1, 0.82521])
BRADFORD = np.array([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]])


def adaptation(white, other):
    return np.linalg.inv(BRADFORD) @ np.diag(BRADFORD @ other / (BRADFORD @ white)) @ BRADFORD


# -- cameras' files ----------------------------------------------------------------------------------------------------

BLOCK = 16  # pixels a side: single pixels are a matter of demosaicing
# Linear sRGB → ACES2065-1 in dcraw and LibRaw, which leave white D65: (0.998, 1.009, 1.079). Ours is adapted.
DCRAW_ACES = np.array([[0.432996, 0.375380, 0.189317], [0.089427, 0.816523, 0.102989], [0.019165, 0.118150, 0.941914]])
ACES_TO_SRGB = np.array([[2.52168619, -1.13413099, -0.38755520], [-0.27647991, 1.37271909, -0.09623917],
                         [-0.01537806, -0.15297534, 1.16835340]])


def blocks(image):
    height, width = (side // BLOCK * BLOCK for side in image.shape[:2])
    image = image[:height, :width].reshape(height // BLOCK, BLOCK, width // BLOCK, BLOCK, 3)
    return image.mean((1, 3)), image.max((1, 3, 4))


def multipliers_of(name):
    """As shot, else of daylight: what the file and dcraw's table say. And whether they are as shot."""
    told = subprocess.run(["dcraw", "-i", "-v", name], capture_output=True, text=True, errors="replace").stdout
    found = {line.split(":")[0]: [float(word) for word in line.split(":")[1].split()[:3]]
             for line in told.splitlines() if line.startswith(("Camera multipliers", "Daylight multipliers"))}
    as_shot = found.get("Camera multipliers", [0])
    return (as_shot, True) if min(as_shot) > 0 else (found.get("Daylight multipliers"), False)


def developed_by(program, name, multipliers, space=6, adjusts=False):
    """By dcraw -4 -W or LibRaw's dcraw_emu: linear sRGB of -o 6, or camera RGB of -o 0."""
    words = [program, "-4", "-o", str(space), "-W", "-t", "0", *(["-c", "0"] if program == "dcraw_emu" and not adjusts else []), "-r", *(f"{v:.9g}" for v in (*multipliers, multipliers[1])), name]
    with open("theirs.ppm", "wb") as out:
        subprocess.run([*words[:1], "-c", *words[1:]] if program == "dcraw" else words, stdout=out if program == "dcraw" else
                       subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    if program != "dcraw" and os.path.exists(name + ".ppm"):
        os.replace(name + ".ppm", "theirs.ppm")
    theirs = pixels("theirs.ppm")
    return theirs @ np.linalg.inv(DCRAW_ACES).T if space == 6 else theirs


# Of the other files: XYZ → camera RGB by correlated colour temperature, and what was neutral, as exiftool prints them.
TWO_MATRICES = {
    "blackmagic_pocket.dng": ((0.8722, 1, 0.5928),
                              {2856: "1.31197 -0.49679 0.01156 -0.41723 1.44237 0.04528 0.06723 0.2171 0.72651",
                               6504: "1.00885 -0.27351 -0.08258 -0.48997 1.34441 0.11174 -0.06406 0.32997 0.53917"}),
    "gopro_hero6.dng": ((0.522449, 1, 0.571429),
                        {2856: "1.8331 -0.8166 -0.2478 0.1391 0.8961 -0.0367 0.0822 0.0662 0.2597",
                         5003: "1.0344 -0.421 -0.062 -0.2315 1.0625 0.1948 0.0093 0.1058 0.5541"}),
}
ONE_MATRIX = ("apple_quicktake.qtk", "canon_eos_d30.crw", "canon_kiss_x4.dng", "canon_powershot_g2.crw",
              "canon_powershot_s40.crw", "nikon_d1.nef", "raspberry_pi.dng")


def by_two_matrices(name):
    """Linear sRGB of dcraw's demosaiced camera RGB by the DNG specification; temperatures by McCamy's formula."""
    neutral, matrices = TWO_MATRICES[name]
    neutral = np.array(neutral)
    (warm, first), (cool, second) = ((t, np.array(text.split(), np.float64).reshape(3, 3)) for t, text in matrices.items())
    xyz = D50
    for _ in range(20):
        x, y = xyz[:2] / xyz.sum()
        n = (x - 0.3320) / (0.1858 - y)
        temperature = np.clip(449 * n**3 + 3525 * n**2 + 6823.3 * n + 5520.33, warm, cool)
        weight = (1 / temperature - 1 / cool) / (1 / warm - 1 / cool)
        matrix = weight * first + (1 - weight) * second
        xyz = np.linalg.inv(matrix) @ neutral
    balanced = developed_by("dcraw", name, 1 / neutral, 0)
    to_xyz = adaptation(xyz / xyz[1], D65) @ np.linalg.inv(matrix) @ np.diag(neutral) / xyz[1]
    return balanced @ (np.linalg.inv(SRGB_TO_XYZ) @ to_xyz).T


def difference(ours, theirs):
    """Of block means that are neither dark nor clipped, relative to the block's largest channel: median and 95 %."""
    (a, top_a), (b, top_b) = blocks(ours), blocks(theirs)
    good = (top_a < 0.9) & (top_b < 0.9) & (b.max(2) > 0.04)
    error = (np.abs(a - b).max(2) / b.max(2))[good]
    return np.median(error), np.percentile(error, 95), good.sum()


def check_near(what, ours, theirs):
    """`theirs`: several, of which the nearest counts. dcraw and LibRaw have other levels and matrices for some cameras,
    and LibRaw sets white by the picture unless it is told not to."""
    best = min((difference(ours, each) for each in theirs), key=lambda d: d[1])
    check(f"{what}: 1 %", best[0] < 0.005 and best[1] < 0.01 and best[2] >= 500, best)


def cameras_against_others():
    folder = shared / "data" / "raw"
    if not folder.is_dir():
        print(f"SKIPPED develop_test.py, cameras' files: needs {folder}")
        return
    if not shutil.which("dcraw") or not shutil.which("dcraw_emu"):
        print("SKIPPED develop_test.py, cameras' files: needs dcraw and dcraw_emu")
        return
    for name in (*ONE_MATRIX, *TWO_MATRICES):
        shutil.copy(folder / name, name)
        multipliers, as_shot = multipliers_of(name)
        if name in TWO_MATRICES:
            multipliers = 1 / np.array(TWO_MATRICES[name][0])
        white = ",".join(f"{v:.9g}" for v in multipliers)
        tool(name, f"--srisp-develop:whitebalance={white}", "ACES2065-1", "-o:datatype=float", "ours.exr")
        ours = pixels("ours.exr") @ ACES_TO_SRGB.T
        if as_shot and name != "nikon_d1.nef":  # dcraw takes numbers for its white that LibRaw does not
            tool(name, "--srisp-develop", "ACES2065-1", "-o:datatype=float", "as_shot.exr")
            same = np.abs(pixels("as_shot.exr") @ ACES_TO_SRGB.T - ours).max()
            check(f"{name}: white as shot is what dcraw says it is", same < 2e-3, same)
        if name in TWO_MATRICES:
            check_near(name, ours, [by_two_matrices(name)])
        else:
            check_near(name, ours, [developed_by(*each) for each in (("dcraw", name, multipliers),
                                                                     ("dcraw_emu", name, multipliers),
                                                                     ("dcraw_emu", name, multipliers, 6, True))])


# -- colour charts -----------------------------------------------------------------------------------------------------

# Display-encoded sRGB of the 24 patches of a ColorChecker, 8 bits (averages that BabelColor published).
CHART = """115,82,68 194,150,130 98,122,157 87,108,67 133,128,177 103,189,170 214,126,44 80,91,166 193,90,99 94,60,108
157,188,64 224,163,46 56,61,150 70,148,73 175,54,60 231,199,31 187,86,149 8,133,161 243,243,242 200,200,200 160,160,160
122,122,121 85,85,85 52,52,52"""
LIGHTS = {"CIE_A": 17, "CIE_D_6500K": 21, "CIE_D_5000K": None}  # EXIF codes of those that the cameras have matrices for


def lab(xyz):
    t = xyz / D65
    f = np.where(t > 216 / 24389, np.cbrt(t), (24389 / 27 * t + 16) / 116)
    return np.stack([116 * f[:, 1] - 16, 500 * (f[:, 0] - f[:, 1]), 200 * (f[:, 1] - f[:, 2])], 1)


def delta_e_2000(a, b):
    """CIEDE2000 [CIE 142-2001]; Sharma's notes of 2005 for angles."""
    (l1, a1, b1), (l2, a2, b2) = a.T, b.T
    c = (np.hypot(a1, b1) + np.hypot(a2, b2)) / 2
    g = 0.5 * (1 - np.sqrt(c**7 / (c**7 + 25.0**7)))
    a1, a2 = a1 * (1 + g), a2 * (1 + g)
    c1, c2 = np.hypot(a1, b1), np.hypot(a2, b2)
    h1, h2 = (np.degrees(np.arctan2(y, x)) % 360 for y, x in ((b1, a1), (b2, a2)))
    dh = (h2 - h1 + 180) % 360 - 180
    dl, dc, dH = l2 - l1, c2 - c1, 2 * np.sqrt(c1 * c2) * np.sin(np.radians(dh / 2))
    l, c, h = (l1 + l2) / 2, (c1 + c2) / 2, np.where(abs(h1 - h2) <= 180, (h1 + h2) / 2, (h1 + h2 + 360) / 2 % 360)
    t = (1 - 0.17 * np.cos(np.radians(h - 30)) + 0.24 * np.cos(np.radians(2 * h)) + 0.32 * np.cos(np.radians(3 * h + 6))
         - 0.20 * np.cos(np.radians(4 * h - 63)))
    sl, sc, sh = 1 + 0.015 * (l - 50) ** 2 / np.sqrt(20 + (l - 50) ** 2), 1 + 0.045 * c, 1 + 0.015 * c * t
    rt = -2 * np.sqrt(c**7 / (c**7 + 25.0**7)) * np.sin(np.radians(60 * np.exp(-(((h - 275) / 25) ** 2))))
    return np.sqrt((dl / sl) ** 2 + (dc / sc) ** 2 + (dH / sh) ** 2 + rt * dc / sc * dH / sh)


def spectra(path):
    data = next(iter(json.load(open(path))["spectral_data"]["data"].values()))
    return np.array([data[str(nm)] for nm in range(380, 781, 5)], np.float64)


class World:
    """Lights, reflectances and the observer: 380 to 780 nm in steps of 5."""

    def __init__(self, folder):
        rows = np.genfromtxt(folder / "illuminants.csv", delimiter=",", names=True)
        self.lights = {name: np.asarray(rows[name]) for name in LIGHTS}
        self.observer = spectra(folder / "cmf_1931.json")
        self.training = spectra(folder / "training_spectral.json").T
        # Reflectances in the first three components of the training set that have the chart's colours under D65.
        mean = np.linalg.svd(self.training, full_matrices=False)[2][:3]
        encoded = np.array([[int(v) for v in patch.split(",")] for patch in CHART.split()]) / 255
        linear = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
        self.chart = (linear @ SRGB_TO_XYZ.T) @ np.linalg.inv(self.seen_by(self.observer, mean, "CIE_D_6500K")) @ mean

    def seen_by(self, sensitivities, reflectances, light):
        """Rows: what is seen of each reflectance; of white the second channel is 1."""
        weights = sensitivities * self.lights[light][:, None]
        return reflectances @ weights / weights[:, 1].sum()


def fitted(inputs, outputs):
    """The matrix that takes the first to the second, both as rows, with the least relative error, so that dark patches
    count as much as light ones."""
    weight = 1 / outputs.sum(1, keepdims=True)
    return np.linalg.lstsq(inputs * weight, outputs * weight, rcond=None)[0].T


def camera_attributes(world, sensitivities):
    """What a DNG of the camera would have: matrices and forward matrices for A and D65."""
    white = np.ones((1, world.training.shape[1]))
    attributes = {}
    for light, end in (("CIE_D_6500K", ""), ("CIE_A", "2")):
        xyz, raw = (world.seen_by(each, world.training, light) for each in (world.observer, sensitivities))
        xyz_white, raw_white = (world.seen_by(each, white, light)[0] for each in (world.observer, sensitivities))
        forward = fitted(raw / raw_white, xyz @ adaptation(xyz_white, D50).T)
        attributes["unprocess:xyz_to_camera" + end] = fitted(xyz, raw)
        attributes["unprocess:forward_matrix" + end] = np.diag(D50 / forward.sum(1)) @ forward
        attributes[f"unprocess:xyz_to_camera{end}_illuminant"] = LIGHTS[light]
    return attributes


def chart_errors(world, sensitivities, light, forward):
    raw = world.seen_by(sensitivities, world.chart, light)
    white = np.ones((1, world.chart.shape[1]))
    raw_white, xyz_white = (world.seen_by(each, white, light)[0] for each in (sensitivities, world.observer))
    spec = oiio.ImageSpec(6, 4, 3, "float")
    spec.attribute("unprocess:colorspace", "camera_rgb")
    spec.attribute("unprocess:neutral", "float[3]", tuple(raw_white / raw_white[1]))
    for name, value in camera_attributes(world, sensitivities).items():
        if np.ndim(value) == 0:
            spec.attribute(name, value)
        elif forward or "forward" not in name:
            spec.attribute(name, "matrix33", tuple(np.ravel(value)))
    chart = oiio.ImageBuf(spec)
    chart.set_pixels(oiio.ROI(0, 6, 0, 4, 0, 1, 0, 3), np.ascontiguousarray(raw / raw_white.max(), np.float32).reshape(4, 6, 3))
    check("chart.exr is written", chart.write("chart.exr"), chart.geterror())
    tool("chart.exr", "--srisp-develop", "XYZ", "-o:datatype=float", "chart_xyz.exr")
    ours = pixels("chart_xyz.exr")
    truth = world.seen_by(world.observer, world.chart, light) @ adaptation(xyz_white, D65).T
    return delta_e_2000(lab(ours.reshape(-1, 3)), lab(truth))


def charts():
    folder = shared / "data" / "cameras"
    if not folder.is_dir():
        print(f"SKIPPED develop_test.py, charts: needs {folder}")
        return
    world = World(folder)
    files = sorted((folder / "sensitivities").glob("*.json"))
    for file in files[::9]:
        for light in LIGHTS:
            for forward in (True, False):
                errors = chart_errors(world, spectra(file), light, forward)
                check(f"{file.stem}, {light}, {'forward' if forward else 'colour'} matrices: mean 1.5, 3 at most",
                      errors.mean() < 1.5 and errors.max() < 3, (errors.mean(), errors.max()))


charts()
cameras_against_others()
print(f"{checks - failures} passed, {failures} failed")
sys.exit(failures > 0)
