#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Makes configs/sample/reference.dng: a simulated RAW file, in tungsten light, of a photo that anybody may use.

    tools/make_sample.py PHOTO DATA_FOLDER OUTPUT.dng

DATA_FOLDER holds the open rawtoaces data set (sensitivities/, illuminants.csv, cmf_1931.json, training_spectral.json).
The photo is linearised, expanded to reflectances in the first three principal components of the 190 measured ones, lit,
integrated with a measured camera's sensitivities, exposed, given noise, mosaiced and written as a CFA DNG.
Needs python3-numpy and python3-pil; the same input gives the same bytes.
"""
import csv
import json
import struct
import sys

import numpy as np
from PIL import Image

CAMERA = "Canon_EOS_5D_Mark_II"
LIGHT, LIGHT_CODE = "CIE_A", 17      # EXIF LightSource: standard light A
DAYLIGHT, DAYLIGHT_CODE = "CIE_D_6500K", 21
WIDTH, HEIGHT = 768, 512
BLACK, WHITE = 512, 15360                  # 14-bit levels
ELECTRONS_AT_WHITE, READ_NOISE_ELECTRONS = 12000.0, 5.0
CLIPPED_PERCENT = 0.5                      # of the photo's pixels, in their brightest channel
SRGB_TO_XYZ = np.array([[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750],
                        [0.0193339, 0.1191920, 0.9503041]])
WAVELENGTHS = np.arange(380, 781, 5)


def spectra(path):
    """The columns of one data file, [81, n], at WAVELENGTHS."""
    with open(path) as file:
        table = json.load(file)["spectral_data"]["data"]["main"]
    known = np.array(sorted(map(int, table)), dtype=float)
    values = np.array([table[str(int(w))] for w in known])
    return np.stack([np.interp(WAVELENGTHS, known, column) for column in values.T], axis=1)


def illuminant(path, name):
    with open(path) as file:
        rows = list(csv.DictReader(file))
    return np.interp(WAVELENGTHS, [float(r["wavelength_nm"]) for r in rows], [float(r[name]) for r in rows])


def read_linear_photo(path):
    """Linear sRGB [HEIGHT, WIDTH, 3], cropped to the shape of the result in the middle."""
    photo = Image.open(path).convert("RGB")
    height = min(photo.height, photo.width * HEIGHT // WIDTH)
    width = min(photo.width, photo.height * WIDTH // HEIGHT)
    left, top = (photo.width - width) // 2, (photo.height - height) // 2
    encoded = np.asarray(photo.crop((left, top, left + width, top + height)), dtype=np.float32) / 255
    linear = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4).astype(np.float32)
    planes = [Image.fromarray(linear[..., c]).resize((WIDTH, HEIGHT), Image.BICUBIC) for c in range(3)]
    return np.clip(np.stack([np.asarray(p) for p in planes], axis=2), 0, 1).astype(float)


def xyz_to_camera(light, observer, camera, reflectances):
    """DNG ColorMatrix for one light: least squares over the measured reflectances, the white of the light exact."""
    xyz = reflectances.T @ (light[:, None] * observer) / (light @ observer[:, 1])
    rgb = reflectances.T @ (light[:, None] * camera)
    white_xyz, white_rgb = light @ observer / (light @ observer[:, 1]), light @ camera
    scale = white_rgb.max()
    weight = 1e3                           # many times the weight of all the patches
    a = np.vstack([xyz, weight * white_xyz])
    b = np.vstack([rgb, weight * white_rgb]) / scale
    return np.linalg.lstsq(a, b, rcond=None)[0].T


def simulate(photo, data):
    """Camera RGB in [0,1], clipped, without noise; and the DNG's colour tags."""
    observer = spectra(f"{data}/cmf_1931.json")
    camera = spectra(f"{data}/sensitivities/{CAMERA}_380_780_5.json")
    reflectances = spectra(f"{data}/training_spectral.json")
    light = illuminant(f"{data}/illuminants.csv", LIGHT)
    daylight = illuminant(f"{data}/illuminants.csv", DAYLIGHT)

    basis = np.linalg.svd(reflectances, full_matrices=False)[0][:, :3]
    basis_to_xyz = (daylight[:, None] * observer).T @ basis / (daylight @ observer[:, 1])
    srgb_to_camera = (light[:, None] * camera).T @ basis @ np.linalg.inv(basis_to_xyz) @ SRGB_TO_XYZ

    raw = np.maximum(photo @ srgb_to_camera.T, 0)
    raw /= np.percentile(raw.max(axis=2), 100 - CLIPPED_PERCENT)
    neutral = light @ camera
    matrices = [xyz_to_camera(light, observer, camera, reflectances),
                xyz_to_camera(daylight, observer, camera, reflectances)]
    return np.minimum(raw, 1), matrices, neutral / neutral[1]


def mosaic(raw):
    """RGGB levels with shot and read noise."""
    rng = np.random.default_rng(1)
    channel = np.array([[0, 1], [1, 2]])[np.arange(HEIGHT)[:, None] % 2, np.arange(WIDTH) % 2]
    signal = np.take_along_axis(raw, channel[..., None], axis=2)[..., 0]
    electrons = rng.poisson(signal * ELECTRONS_AT_WHITE) + rng.normal(0, READ_NOISE_ELECTRONS, signal.shape)
    levels = BLACK + electrons / ELECTRONS_AT_WHITE * (WHITE - BLACK)
    return np.clip(np.rint(levels), 0, WHITE).astype("<u2")


def rationals(values, denominator=10000):
    return [v for x in np.ravel(values) for v in (int(round(x * denominator)), denominator)]


def write_dng(path, levels, matrices, neutral):
    """A one-directory little-endian TIFF: header, tags, values that do not fit in their tag, one strip."""
    byte, text, short, long, rational, srational, double = 1, 2, 3, 4, 5, 10, 12
    codes = {byte: "B", text: "s", short: "H", long: "I", rational: "I", srational: "i", double: "d"}
    model = f"srisp simulated {CAMERA.replace('_', ' ')}"
    shot, read = 1 / ELECTRONS_AT_WHITE, (READ_NOISE_ELECTRONS / ELECTRONS_AT_WHITE) ** 2
    strip_tag = 273
    tags = [                               # tag, type, values; sorted by tag
        (254, long, [0]), (256, long, [WIDTH]), (257, long, [HEIGHT]), (258, short, [16]), (259, short, [1]),
        (262, short, [32803]),             # colour filter array
        (270, text, "Simulated by srisp in the light of CIE standard illuminant A; no camera took this picture"),
        (271, text, "srisp"), (272, text, model), (strip_tag, long, [0]), (274, short, [1]), (277, short, [1]),
        (278, long, [HEIGHT]), (279, long, [levels.nbytes]), (284, short, [1]),
        (305, text, "srisp tools/make_sample.py"),
        (33421, short, [2, 2]), (33422, byte, [0, 1, 1, 2]),          # CFARepeatPatternDim, CFAPattern: RGGB
        (50706, byte, [1, 4, 0, 0]), (50707, byte, [1, 1, 0, 0]),     # DNGVersion, DNGBackwardVersion
        (50708, text, model),                                         # UniqueCameraModel
        (50713, short, [1, 1]), (50714, short, [BLACK]), (50717, short, [WHITE]),
        (50721, srational, rationals(matrices[0])), (50722, srational, rationals(matrices[1])),
        (50728, rational, rationals(neutral)),                        # AsShotNeutral
        (50778, short, [LIGHT_CODE]), (50779, short, [DAYLIGHT_CODE]),
        (51041, double, [shot, read]),                                # NoiseProfile
    ]
    values_at = 8 + 2 + 12 * len(tags) + 4
    entries, values = [], b""
    for tag, kind, content in tags:
        if kind == text:
            packed = content.encode() + b"\0"
            count = len(packed)
        else:
            packed = struct.pack("<%d%s" % (len(content), codes[kind]), *content)
            count = len(content) // 2 if kind in (rational, srational) else len(content)
        if len(packed) > 4:
            field = struct.pack("<I", values_at + len(values))
            values += packed + b"\0" * (len(packed) % 2)
        else:
            field = packed.ljust(4, b"\0")
        entries.append((tag, kind, count, field))
    with open(path, "wb") as file:
        file.write(struct.pack("<2sHIH", b"II", 42, 8, len(entries)))
        for tag, kind, count, field in entries:
            if tag == strip_tag:
                field = struct.pack("<I", values_at + len(values))
            file.write(struct.pack("<HHI4s", tag, kind, count, field))
        file.write(struct.pack("<I", 0) + values + levels.tobytes())


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    raw, matrices, neutral = simulate(read_linear_photo(sys.argv[1]), sys.argv[2])
    write_dng(sys.argv[3], mosaic(raw), matrices, neutral)
    print(f"{sys.argv[3]}: mean {np.round(raw.mean(axis=(0, 1)), 4)}, neutral {np.round(neutral, 4)}, "
          f"{100 * (raw >= 1).any(axis=2).mean():.2f} % of the pixels clip")


main()
