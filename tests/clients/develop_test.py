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
    image = oiio.ImageBuf(str(name))
    return np.asarray(image.get_pixels(oiio.FLOAT), np.float64), image.spec()


# -- cameras' files ----------------------------------------------------------------------------------------------------

BLOCK = 16  # pixels a side: two demosaicings differ in single pixels


def blocks(image, offset=(0, 0)):
    y, x = offset
    image = image[y:, x:]
    height, width = (side // BLOCK * BLOCK for side in image.shape[:2])
    image = image[:height, :width].reshape(height // BLOCK, BLOCK, width // BLOCK, BLOCK, 3)
    return image.mean((1, 3)), image.max((1, 3, 4))


def as_shot_multipliers(name):
    """What dcraw would say with -v."""
    told = subprocess.run(["dcraw", "-i", "-v", name], capture_output=True, text=True).stdout
    for line in told.splitlines():
        if line.startswith("Camera multipliers:"):
            return [float(word) for word in line.split(":")[1].split()[:3]]
    return None


def compare_with_dcraw(file):
    """The largest relative difference of block means that are not dark and not clipped, 99th percentile."""
    shutil.copy(file, file.name)
    with open("dcraw.ppm", "wb") as out:
        done = subprocess.run(["dcraw", "-c", "-4", "-o", "6", "-W", "-w", "-t", "0", file.name], stdout=out,
                              stderr=subprocess.PIPE)
    if done.returncode or not os.path.getsize("dcraw.ppm"):
        return None
    theirs, _ = pixels("dcraw.ppm")
    tool(file.name, "--srisp-develop", "ACES2065-1", "-o:datatype=float", "ours.exr")
    ours, _ = pixels("ours.exr")
    best = None
    for dy in range(0, 3):  # borders of two decoders differ by a few rows
        for dx in range(0, 3):
            y, x = max(theirs.shape[0] - ours.shape[0], 0), max(theirs.shape[1] - ours.shape[1], 0)
            a, top_a = blocks(ours, (dy, dx))
            b, top_b = blocks(theirs, (min(dy + y // 2 * 2, dy + y), dx + x // 2 * 2))
            rows, columns = min(a.shape[0], b.shape[0]), min(a.shape[1], b.shape[1])
            a, b = a[:rows, :columns], b[:rows, :columns]
            good = (top_a[:rows, :columns] < 0.9) & (top_b[:rows, :columns] < 0.9) & (b.min(2) > 0.02)
            if good.sum() < 20:
                continue
            error = np.abs(a[good] / b[good] - 1)
            score = np.percentile(error, 99), np.median(error), good.sum()
            best = min(best or score, score)
            if y == x == 0:
                return best
    return best


def cameras_against_dcraw():
    folder = shared / "data" / "raw"
    if not folder.is_dir():
        print(f"SKIPPED develop_test.py, cameras' files: needs {folder}")
        return
    if not shutil.which("dcraw"):
        print("SKIPPED develop_test.py, cameras' files: needs dcraw")
        return
    for file in sorted(folder.iterdir()):
        print(file.name, compare_with_dcraw(file), flush=True)


# -- colour charts -----------------------------------------------------------------------------------------------------

# Display-encoded sRGB of the 24 patches of a ColorChecker, 8 bits (averages that BabelColor published).
CHART = """115,82,68 194,150,130 98,122,157 87,108,67 133,128,177 103,189,170 214,126,44 80,91,166 193,90,99 94,60,108
157,188,64 224,163,46 56,61,150 70,148,73 175,54,60 231,199,31 187,86,149 8,133,161 243,243,242 200,200,200 160,160,160
122,122,121 85,85,85 52,52,52"""
SRGB_TO_XYZ = np.array([[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]])
D65 = np.array([0.95047, 1, 1.08883])
D50 = np.array([0.96422, 1, 0.82521])
BRADFORD = np.array([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]])
LIGHTS = {"CIE_A": 17, "CIE_D_6500K": 21, "CIE_D_5000K": None}  # EXIF codes of those that the cameras have matrices for


def adaptation(white, other):
    return np.linalg.inv(BRADFORD) @ np.diag(BRADFORD @ other / (BRADFORD @ white)) @ BRADFORD


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
    ours, _ = pixels("chart_xyz.exr")
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
                print(file.stem, light, forward, errors.mean().round(2), errors.max().round(2))


charts()
cameras_against_dcraw()
print(f"{checks - failures} passed, {failures} failed")
sys.exit(failures > 0)
