#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Golden values of the models that ship, by the independent implementation in method.py.

    python3 tests/golden/golden.py          writes inputs, values_default and values_spatial beside this script
    python3 tests/golden/golden.py GOLDEN   holds the implementation against the golden values of other ones: GOLDEN has
                                            model_NAME and values_NAME for spatial, pointwise and paper

Whoever ships another model runs the first. Its inputs are cut from configs/sample/photo.jpg; the reference is what a
simulated camera makes of another part of it."""
import json
import pathlib
import struct
import sys

import numpy as np

from method import Selection, forward, load, reverse

FOLDER = pathlib.Path(__file__).resolve().parent
ROOT = FOLDER.parent.parent
BLOCKS = ["tone", "gamma", "color", "white_balance", "gain"]


def save(path, tensors, metadata):
    header, data = {"__metadata__": metadata}, b""
    kinds = {"float32": "F32", "float16": "F16"}
    for name, tensor in sorted(tensors.items()):
        bytes_of_it = tensor.tobytes()
        offsets = [len(data), len(data) + len(bytes_of_it)]
        header[name] = {"dtype": kinds[tensor.dtype.name], "shape": tensor.shape, "data_offsets": offsets}
        data += bytes_of_it
    text = json.dumps(header).encode()
    text += b" " * (-len(text) % 8)
    path.write_bytes(struct.pack("<Q", len(text)) + text + data)


def made_inputs():
    """Two thumbnails and a small image, as float16."""
    import OpenImageIO

    photo = OpenImageIO.ImageBuf(str(ROOT / "configs/sample/photo.jpg")).get_pixels(OpenImageIO.UINT8)[:, :, :3] / 255
    camera = np.array([[0.60, 0.32, 0.08], [0.15, 0.70, 0.15], [0.05, 0.28, 0.67]])
    light = np.array([0.75, 1, 0.45])
    other = photo[-256:, -256:][::-1, ::-1] ** 2.2 @ camera.T * light
    image = photo[20:68, 100:164].copy()
    image[:6] = np.minimum(image[:6] * 4, 1)  # clipped highlights
    inputs = {"thumb.source": photo[:256, :256], "thumb.reference": np.minimum(other * 0.6, 1), "image.source": image}
    return {name: value.astype(np.float16) for name, value in inputs.items()}


def computed(model, metadata, inputs, step):
    """All golden values but the way back; of the thumbnails every `step`th row and column."""
    selection = Selection(model, metadata, inputs["thumb.source"], inputs["thumb.reference"])
    values = dict(selection.values)
    for block in BLOCKS:
        values["thumb.after_" + block] = selection.running[block][::step, ::step]
    values["image.reverse"] = reverse(inputs["image.source"], values)
    return values


def largest_difference(values, golden):
    return max(
        (np.abs(value - golden[name].reshape(np.shape(value))) / np.maximum(1, np.abs(value))).max()
        for name, value in values.items()
    )


def check(folder):
    for name in ("spatial", "pointwise", "paper"):
        model, metadata = load(f"{folder}/model_{name}.safetensors")
        golden = load(f"{folder}/values_{name}.safetensors")[0]
        values = computed(model, metadata, golden, 4)
        missing = {key for key in golden if key not in values} - {"thumb.source", "thumb.reference", "image.source"}
        assert missing == {"image.forward_of_reverse"}, missing
        difference = np.abs(forward(golden["image.reverse"], values, False) - golden["image.forward_of_reverse"])
        print(
            f"{name}: largest difference {largest_difference(values, golden):.1e} of max(1, |value|); way back "
            f"{np.quantile(difference, 0.999):.1e} (99.9 %), {difference.max():.1e} (largest)"
        )


def write():
    inputs = made_inputs()
    save(FOLDER / "inputs.safetensors", inputs, {"origin": "configs/sample/photo.jpg"})
    for name in ("default", "spatial"):
        path = ROOT / f"configs/models/{name}.safetensors"
        model, metadata = load(path)
        values = computed(model, metadata, inputs, 2)
        raw = values["image.reverse"] = values["image.reverse"].astype(np.float32)
        values["image.forward_of_reverse"] = forward(raw, values, metadata["format"] == "srisp-7")
        tensors = {key: np.atleast_1d(value).astype(np.float32) for key, value in values.items()}
        save(FOLDER / f"values_{name}.safetensors", tensors, {"model": f"configs/models/{name}.safetensors"})


if len(sys.argv) > 1:
    check(sys.argv[1])
else:
    write()
