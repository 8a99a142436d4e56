#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""RAW files and the JPEGs that their cameras put into them, as pairs of RAW image and photo for `srispeval --set
developed=FILE`.

    python3 tests/bench/camera_jpegs.py --srisppack build/bin/srisppack -o pairs.safetensors FILE.CRW...

srisppack reads the RAW files; dcraw takes out the JPEGs. Both become squares of 128 x 128. A JPEG that is turned
against its RAW image is an error: it has another shape."""
import argparse
import json
import os
import subprocess
import sys
import tempfile

import numpy as np

from develop_raws import read_tensors, write_tensors

SIDE, READ_SIDE = 128, 256
SHAPE_TOLERANCE = 0.02  # of width / height: cameras cut some pixels off


def squashed(oiio, path):
    """[3, SIDE, SIDE] in [0, 1]: exact means of areas, rounded to 8 bits."""
    image = oiio.ImageBuf(path)
    if image.has_error:
        sys.exit(f"camera_jpegs.py: {path}: {image.geterror()}")
    small = oiio.ImageBufAlgo.resize(image, filtername="box", roi=oiio.ROI(0, SIDE, 0, SIDE, 0, 1, 0, 3))
    pixels = np.asarray(small.get_pixels(oiio.FLOAT)).transpose(2, 0, 1)
    return (np.round(np.clip(pixels, 0, 1) * 255) / 255).astype(np.float32), image.spec()


def raw_size(path):
    for line in subprocess.run(["dcraw", "-i", "-v", path], check=True, capture_output=True, text=True).stdout.split("\n"):
        if line.startswith("Image size:"):
            return [int(number) for number in line.split(":")[1].split("x")]
    sys.exit(f"camera_jpegs.py: {path}: dcraw does not tell the size of the image")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--srisppack", required=True, help="the program")
    parser.add_argument("-o", "--out", required=True)
    parser.add_argument("raws", nargs="+", metavar="RAW")
    arguments = parser.parse_args()
    import OpenImageIO as oiio

    raws, photos, cameras = [], [], []
    with tempfile.TemporaryDirectory() as folder:
        for number, path in enumerate(arguments.raws):
            name = f"{folder}/{number:04d}{os.path.splitext(path)[1]}"
            os.symlink(os.path.abspath(path), name)
            subprocess.run(["dcraw", "-e", name], check=True)
            photo, spec = squashed(oiio, os.path.splitext(name)[0] + ".thumb.jpg")
            width, height = raw_size(name)
            if abs(spec.width / spec.height * height / width - 1) > SHAPE_TOLERANCE:
                sys.exit(f"camera_jpegs.py: {path}: its JPEG of {spec.width} x {spec.height} has another shape than the "
                         f"image of {width} x {height}")
            pack = f"{folder}/pack{number}"
            subprocess.run([arguments.srisppack, "--raws", name, "--raw-size", str(READ_SIDE), "--crops", "0", "-o", pack],
                           check=True, stdout=subprocess.DEVNULL)
            with open(f"{pack}/pack.json") as file:
                cameras.append(json.load(file)["raws"]["images"][0]["group"])
            pixels = read_tensors(f"{pack}/raws.safetensors")[0]["pixels"][0] / 65535
            step = READ_SIDE // SIDE
            raws.append(pixels.reshape(3, SIDE, step, SIDE, step).mean((2, 4)).astype(np.float32))
            photos.append(photo)
    write_tensors(arguments.out, {"raw": np.stack(raws), "photo:the camera itself": np.stack(photos)},
                  {"format": "srisp-developed-1", "cameras": json.dumps(cameras)})


if __name__ == "__main__":
    main()
