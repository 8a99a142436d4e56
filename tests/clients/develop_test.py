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


cameras_against_dcraw()
print(f"{checks - failures} passed, {failures} failed")
sys.exit(failures > 0)
