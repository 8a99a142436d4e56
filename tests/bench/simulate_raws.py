#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""RAW files whose truth is known and whose pictures may be shown: openly licensed photos as cameras that were measured,
and that no model was trained on, would have recorded them.

    python3 tests/bench/simulate_raws.py --shared ../shared --pack pack --plugins build/lib/srisp -o raws [--count 24]

Photos for validation are made linear, expanded to reflectances (the first three principal components of measured ones,
which give a photo's colours under D65 exactly), lit by daylight, tungsten or a fluorescent lamp, seen by a camera's
sensitivities, exposed at random, given shot noise, and written as DNG by dng.imageio, with the matrix and the neutral
that the camera and the light have."""
import argparse
import csv
import json
import os
import re
import sys

import numpy as np

from develop_raws import write_dng

WAVELENGTHS = np.arange(380, 781, 5)
SRGB_TO_XYZ = np.array([[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750],
                        [0.0193339, 0.1191920, 0.9503041]])
FULL_WELL = 12000.0  # electrons at white


def spectra(path):
    """[wavelengths, columns], and the file's header."""
    with open(path) as file:
        content = json.load(file)
    data = content["spectral_data"]["data"]["main"]
    return np.array([data[str(wavelength)] for wavelength in WAVELENGTHS], float), content["header"]


def planck(kelvin):
    meters = WAVELENGTHS * 1e-9
    power = meters ** -5 / (np.exp(0.014387769 / (meters * kelvin)) - 1)
    return power / power[WAVELENGTHS == 560]


class World:
    """What is measured: lights, reflectances, the observer."""

    def __init__(self, folder):
        with open(f"{folder}/illuminants.csv") as file:
            rows = [{name: value for name, value in row.items()} for row in csv.DictReader(file)]
        at = [float(row["wavelength_nm"]) for row in rows]
        self.lights = {name: np.interp(WAVELENGTHS, at, [float(row[name]) for row in rows])
                       for name in rows[0] if name != "wavelength_nm"}
        self.observer = spectra(f"{folder}/cmf_1931.json")[0]
        self.reflectances = spectra(f"{folder}/training_spectral.json")[0]
        components = np.linalg.svd(self.reflectances, full_matrices=False)[0][:, :3]
        d65 = self.light("D_6500K")
        white = d65 @ self.observer[:, 1]
        to_xyz = (self.observer * d65[:, None]).T @ components / white
        # linear sRGB -> reflectance
        self.expansion = components @ np.linalg.inv(to_xyz) @ SRGB_TO_XYZ

    def light(self, word):
        found = [name for name in self.lights if re.search(rf"_{word}$", name)]
        if not found:
            sys.exit(f"simulate_raws.py: illuminants.csv has no {word}: {', '.join(self.lights)}")
        return self.lights[found[0]]

    def to_camera(self, sensitivities, light):
        """Linear sRGB -> camera RGB, whose largest response to white is 1."""
        matrix = (sensitivities * light[:, None]).T @ self.expansion
        return matrix / (matrix @ np.ones(3)).max()

    def xyz_to_camera(self, sensitivities):
        """For daylight, as a DNG's ColorMatrix has it: the best for the measured reflectances."""
        d65 = self.light("D_6500K")
        xyz = (self.observer * d65[:, None]).T @ self.reflectances / (d65 @ self.observer[:, 1])
        camera = (sensitivities * d65[:, None]).T @ self.reflectances
        matrix = camera @ xyz.T @ np.linalg.inv(xyz @ xyz.T)
        return matrix / (matrix @ SRGB_TO_XYZ @ np.ones(3)).max()


def open_photos(folder, count):
    """Paths and sources of openly licensed photos for validation, evenly spread."""
    with open(f"{folder}/manifest.csv") as file:
        rows = [row for row in csv.DictReader(file) if row["use"] == "validation" and row["open"] == "yes" and
                (row["licence"] == "MIT (repo)" or "public domain" in row["licence"])]
    count = min(count, len(rows))
    return [rows[(2 * i + 1) * len(rows) // (2 * count)] for i in range(count)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--shared", required=True, help="folder with data/photos and data/cameras")
    parser.add_argument("--pack", required=True, help="training pack, which says what cameras are kept from training")
    parser.add_argument("--plugins", required=True, help="folder of dng.imageio.so")
    parser.add_argument("-o", "--out", required=True)
    parser.add_argument("--count", type=int, default=24)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    os.environ["OIIO_LIBRARY_PATH"] = os.path.abspath(arguments.plugins)
    import OpenImageIO as oiio

    world = World(f"{arguments.shared}/data/cameras")
    with open(f"{arguments.pack}/pack.json") as file:
        cameras = [one for one in json.load(file)["cameras"]["cameras"] if one["validation"]]
    random = np.random.default_rng(arguments.seed)
    os.makedirs(arguments.out, exist_ok=True)
    credits = []
    for number, photo in enumerate(open_photos(f"{arguments.shared}/data/photos", arguments.count)):
        image = oiio.ImageBuf(f"{arguments.shared}/data/photos/{photo['file']}").get_pixels(oiio.FLOAT)[..., :3]
        linear = np.where(image <= 0.04045, image / 12.92, ((image + 0.055) / 1.055) ** 2.4)
        camera = cameras[number % len(cameras)]
        sensitivities = spectra(f"{arguments.shared}/data/cameras/sensitivities/{camera['source']}")[0]
        light = [world.light("D_6500K"), world.light("D_5000K"), planck(random.uniform(2500, 4500)),
                 world.light("FLs_2")][random.integers(4)]
        to_camera = world.to_camera(sensitivities, light)
        raw = np.maximum(linear @ to_camera.T, 0)
        raw *= np.exp(random.uniform(np.log(0.15), np.log(1.25))) / max(np.quantile(raw.max(2), 0.98), 1e-4)
        raw = np.clip(random.poisson(np.minimum(raw, 4) * FULL_WELL) / FULL_WELL, 0, 1)
        neutral = to_camera @ np.ones(3)
        write_dng(oiio, f"{arguments.out}/{photo['file'][:-4]}.dng", raw.astype(np.float32), camera["name"],
                  world.xyz_to_camera(sensitivities).flatten(), neutral / neutral[1])
        credits.append(f"{photo['file']}: {photo['source']}, {photo['licence']}")
    with open(f"{arguments.out}/credits.txt", "w") as file:
        file.write("\n".join(credits) + "\n")


if __name__ == "__main__":
    main()
