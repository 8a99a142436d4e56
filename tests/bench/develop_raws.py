#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What real RAW converters make of a pack's real RAW images: pairs of RAW image and photo for `srispeval --developed`.

    python3 tests/bench/develop_raws.py --pack pack --plugins build/lib/srisp -o developed.safetensors [--images 12]

Each image gets an exposure, is enlarged to 512 x 512 (so that demosaicing, sharpening and denoising of the converters
see flat squares), written as DNG with its true neutral and its camera's matrix by dng.imageio, developed by dcraw,
RawTherapee and darktable (those that are installed) in three styles each, and reduced again. The matrices are those of
darktable's installed table of cameras. A run that is stopped goes on where it was."""
import argparse
import glob
import json
import os
import random
import shutil
import struct
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as tree

import numpy as np

SIDE = 512  # of the DNG files; RawTherapee takes none below 100,000 bytes
CAMERAS = "/usr/share/darktable/rawspeed/cameras.xml"
DISPLAY_REFERRED = "plugins/darkroom/workflow=display-referred"
PROFILES = "/usr/share/rawtherapee/profiles/"
# name, program, its options; the first of each program are its defaults
STYLES = [
    ("dcraw", "dcraw", []),
    ("dcraw -w -o 1 -H 2", "dcraw", ["-w", "-o", "1", "-H", "2"]),
    ("dcraw -a -W, sRGB curve", "dcraw", ["-a", "-W", "-g", "2.4", "12.92"]),
    ("rawtherapee", "rawtherapee-cli", ["-d"]),
    ("rawtherapee, neutral", "rawtherapee-cli", []),
    ("rawtherapee, film curve", "rawtherapee-cli", ["-p", PROFILES + "Standard Film Curve - ISO Low.pp3"]),
    ("darktable", "darktable-cli", []),
    ("darktable, base curve", "darktable-cli", ["--conf", DISPLAY_REFERRED]),
    ("darktable, no workflow", "darktable-cli", ["--conf", "plugins/darkroom/workflow=none"]),
]


def read_tensors(path):
    with open(path, "rb") as file:
        head = json.loads(file.read(struct.unpack("<Q", file.read(8))[0]))
        start = file.tell()
        types = {"U16": np.uint16, "F32": np.float32}
        result = {}
        for name, entry in head.items():
            if name != "__metadata__":
                begin, end = entry["data_offsets"]
                file.seek(start + begin)
                result[name] = np.frombuffer(file.read(end - begin), types[entry["dtype"]]).reshape(entry["shape"])
        return result, head.get("__metadata__", {})


def write_tensors(path, tensors, metadata):
    head, offset = {"__metadata__": metadata}, 0
    for name, values in tensors.items():
        head[name] = {"dtype": "F32", "shape": list(values.shape), "data_offsets": [offset, offset + values.nbytes]}
        offset += values.nbytes
    text = json.dumps(head).encode()
    text += b" " * (-len(text) % 8)
    with open(path + ".partial", "wb") as file:
        file.write(struct.pack("<Q", len(text)) + text)
        for values in tensors.values():
            file.write(values.tobytes())
    os.replace(path + ".partial", path)


def matrices():
    """XYZ to camera for daylight, by the model's name without the maker's."""
    result = {}
    for camera in tree.parse(CAMERAS).getroot():
        rows = [row.text.split() for row in camera.iter("ColorMatrixRow")][:3]
        names = {camera.get("model")} | {name.text for name in camera.iter("Alias")}
        names |= {name.get("model") for name in camera.iter("ID")}
        if len(rows) == 3:
            for name in names:
                result.setdefault(bare(name), [int(value) / 10000 for row in rows for value in row])
    return result


def bare(camera):
    return (camera or "").lower().replace("canon ", "").replace("nikon ", "").replace("panasonic ", "").replace(
        "samsung ", "")


def chosen(pack, count):
    """Indices of whole images: `count` of each camera, evenly spread, those for validation first."""
    by_camera, index = {}, 0
    for image in pack["raws"]["images"]:
        by_camera.setdefault(image["group"], ([], []))[not image["validation"]].append((index, image))
        index += len(image["crops"])
    result = []
    for camera in sorted(by_camera):
        validation, training = by_camera[camera]
        more = max(0, count - len(validation))
        for some, wanted in ((validation, min(count, len(validation))), (training, min(more, len(training)))):
            result += [some[(2 * i + 1) * len(some) // (2 * wanted)] for i in range(wanted)]
    return result


def exposed(pixels, index, low, high):
    level = np.exp(random.Random(index).uniform(np.log(low), np.log(high)))
    return np.clip(pixels * (level / max(np.quantile(pixels.max(0), 0.98), 1e-4)), 0, 1)


def enlarged(pixels):
    """[3, size, size] as SIDE x SIDE pixels, [SIDE, SIDE, 3]."""
    return np.ascontiguousarray(np.repeat(np.repeat(pixels, SIDE // pixels.shape[1], 1), SIDE // pixels.shape[2], 2)
                                .transpose(1, 2, 0), np.float32)


def write_dng(oiio, path, rgb, camera, matrix, neutral):
    """Linear camera RGB [height, width, 3] as a RAW file. `camera`: make and model; `matrix`: nine numbers, XYZ to camera
    for daylight; `neutral`: what is neutral in the scene."""
    spec = oiio.ImageSpec(rgb.shape[1], rgb.shape[0], 3, "uint16")
    maker, _, model = camera.partition(" ")
    spec.attribute("unprocess:reference_make", maker)
    spec.attribute("unprocess:reference_model", model)
    for name, values in (("unprocess:xyz_to_camera", matrix), ("unprocess:neutral", neutral)):
        spec.attribute(name, oiio.TypeDesc(f"float[{len(values)}]"), [float(v) for v in values])
    spec.attribute("unprocess:xyz_to_camera_illuminant", 21)
    spec.attribute("oiio:ColorSpace", "srisp_camera_rgb")
    spec.attribute("dng:quiet", 1)
    output = oiio.ImageOutput.create(path)
    if not output or not output.open(path, spec) or not output.write_image(rgb) or not output.close():
        sys.exit(f"{os.path.basename(sys.argv[0])}: {path}: {output.geterror() if output else oiio.geterror()}")


def develop(program, options, names, folder):
    """Develops DNG files, all in one start where the program can; the photo of x.dng is x.tif."""
    if program == "dcraw":
        for name in names:
            subprocess.run([program, "-T", *options, name], check=True, cwd=folder)
            os.replace(f"{folder}/{name[:-4]}.tiff", f"{folder}/{name[:-4]}.tif")
    elif program == "rawtherapee-cli":
        subprocess.run([program, "-t", "-b8", "-Y", *options, "-c", *names], check=True, cwd=folder,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    else:
        os.makedirs(f"{folder}/in")
        os.makedirs(f"{folder}/out")
        for name in names:
            os.link(f"{folder}/{name}", f"{folder}/in/{name}")
        subprocess.run([program, "in", "out/$(FILE_NAME)", "--out-ext", "tif", "--core", "--configdir", "config", "--library",
                        ":memory:", *options], check=True, cwd=folder, stdout=subprocess.DEVNULL)
        for name in names:
            os.replace(f"{folder}/out/{name[:-4]}.tif", f"{folder}/{name[:-4]}.tif")
        for used in ("in", "out", "config"):
            shutil.rmtree(f"{folder}/{used}")


def read_photo(oiio, path, size):
    image = oiio.ImageBuf(path)
    if image.has_error or (image.spec().width, image.spec().height) != (SIDE, SIDE):
        sys.exit(f"develop_raws.py: {path}: {image.geterror()}, {image.spec().width} x {image.spec().height} pixels")
    pixels = np.asarray(image.get_pixels(oiio.FLOAT))[..., :3]
    step = SIDE // size
    reduced = pixels.reshape(size, step, size, step, 3).mean((1, 3)).transpose(2, 0, 1)
    return (np.round(np.clip(reduced, 0, 1) * 255) / 255).astype(np.float32)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pack", required=True)
    parser.add_argument("--plugins", required=True, help="folder of dng.imageio.so")
    parser.add_argument("-o", "--out", required=True)
    parser.add_argument("--images", type=int, default=12, help="of each camera")
    parser.add_argument("--exposure", type=float, nargs=2, default=[0.15, 1.25],
                        help="where the 98th percentile of an image lies, drawn evenly in ln; 1: clipping begins")
    arguments = parser.parse_args()
    os.environ["OIIO_LIBRARY_PATH"] = os.path.abspath(arguments.plugins)
    import OpenImageIO as oiio

    with open(os.path.join(arguments.pack, "pack.json")) as file:
        pack = json.load(file)
    pixels = read_tensors(os.path.join(arguments.pack, "raws.safetensors"))[0]["pixels"]
    known = matrices()
    done, origin = {}, json.dumps([arguments.images, arguments.exposure])
    if os.path.exists(arguments.out):
        tensors, metadata = read_tensors(arguments.out)
        if metadata.get("settings") == origin:
            done = {key[6:]: value for key, value in tensors.items() if key.startswith("photo:")}
    raws, cameras, files = [], [], []
    with tempfile.TemporaryDirectory() as folder:
        for index, image in chosen(pack, arguments.images):
            raw = exposed(pixels[index] / 65535.0, index, *arguments.exposure)
            name = f"{len(raws):04d}.dng"
            neutral = [image["white_balance"][1] / gain for gain in image["white_balance"]]
            write_dng(oiio, f"{folder}/{name}", enlarged(raw), image["group"], known[bare(image["group"])], neutral)
            raws.append(raw.astype(np.float32))
            cameras.append(image["group"])
            files.append(name)
        for style, program, options in STYLES:
            if style in done:
                continue
            if not shutil.which(program):
                print(f"SKIPPED {style}: {program} is not installed")
                continue
            print(f"{style}: {len(files)} images", flush=True)
            develop(program, options, files, folder)
            done[style] = np.stack([read_photo(oiio, f"{folder}/{name[:-4]}.tif", raws[0].shape[1]) for name in files])
            for path in glob.glob(f"{folder}/*.tif"):
                os.unlink(path)
            write_tensors(arguments.out, {"raw": np.stack(raws), **{"photo:" + key: done[key] for key in done}},
                          {"format": "srisp-developed-1", "settings": origin, "cameras": json.dumps(cameras)})


if __name__ == "__main__":
    main()
