#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""An independent implementation, in NumPy, of what model format srisp-4 adds to srisp-1: the quantile features, the
network that corrects the anchor, and white-balance gains of at least 1. Writes anchor_network.json, which the tests
compare the library with.

    python3 tests/golden/anchor_network.py GOLDEN > tests/golden/anchor_network.json

GOLDEN is the folder with the golden model and values of srisp-1 (model_spatial, values_spatial)."""
import json
import struct
import sys

import numpy as np


def load(path):
    with open(path, "rb") as file:
        (size,) = struct.unpack("<Q", file.read(8))
        header = json.loads(file.read(size))
        data = file.read()
    kinds = {"F32": np.float32, "F16": np.float16}
    return {
        name: np.frombuffer(data[slice(*entry["data_offsets"])], kinds[entry["dtype"]]).reshape(entry["shape"])
        for name, entry in header.items()
        if name != "__metadata__"
    }


def quantile_features(image):
    """image: [height, width, 3], linear."""
    height, width, _ = image.shape
    rows, columns = max(1, height // 64), max(1, width // 64)
    whole = image[: height // rows * rows, : width // columns * columns].astype(np.float64)
    small = whole.reshape(height // rows, rows, width // columns, columns, 3).mean((1, 3)).reshape(-1, 3)
    levels = [0.02, 0.1, 0.25, 0.4, 0.5, 0.6, 0.75, 0.9, 0.97, 0.995]
    channels = [small[:, 0], small[:, 1], small[:, 2], small.mean(1)]
    quantiles = [np.quantile(channel, levels) for channel in channels]
    logs = np.log(np.maximum(np.concatenate(quantiles), 1e-4)) * 0.5 + 1
    colors = np.log((small[:, [0, 2]] + 0.002) / (small[:, 1:2] + 0.002))
    bright = small.mean(1) >= np.quantile(small.mean(1), 0.75)
    color_levels = [0.02, 0.1, 0.25, 0.5, 0.75, 0.9, 0.98]
    color_quantiles = [np.quantile(some, color_levels, axis=0).T.ravel() for some in (colors, colors[bright])]
    return np.concatenate([logs, (small > 0.95).mean(0), *color_quantiles])


def made_up_image(height, width):
    y, x, c = np.meshgrid(np.arange(height), np.arange(width), np.arange(3), indexing="ij")
    wave = 0.5 + 0.5 * np.sin(0.013 * x + 0.007 * (c + 1) * y + c)
    return np.minimum(1.05 * wave**2, 1).astype(np.float32)


def made_up_network(inputs):
    """Four affine layers with made-up weights, ReLU between them."""
    x = inputs
    for layer, outputs in enumerate([256, 256, 256, 3]):
        weight = 0.05 * np.sin(0.7 * np.arange(outputs * len(x)) + layer).astype(np.float32).astype(np.float64)
        bias = 0.05 * np.cos(np.arange(outputs) + layer)
        x = weight.reshape(outputs, len(x)) @ x + bias
        if layer < 3:
            x = np.maximum(x, 0)
    return x


def convolve(image, weight, bias, stride, border):
    """3 x 3, image [height, width, channels]; `border`: a mode of np.pad."""
    padded = np.pad(image, ((1, 1), (1, 1), (0, 0)), mode=border)
    windows = np.lib.stride_tricks.sliding_window_view(padded, (3, 3), axis=(0, 1))[::stride, ::stride]
    return np.tensordot(windows, weight.astype(np.float64), axes=([2, 3, 4], [1, 2, 3])) + bias


def layers(image, count, tensors, name, stride, border):
    for layer in range(count):
        weight, bias = (tensors[f"{name}.{layer}.{part}"] for part in ("weight", "bias"))
        image = convolve(image, weight, bias, stride, border)
        if layer < count - 1:
            image = np.maximum(image, 0)
    return image


def block_weights(model, block, fused, candidates):
    """What a block chooses of its atoms, whose reverse outputs are given."""
    seen = [np.maximum(candidate, 1e-5) ** (1 / 2.2) - 0.3 for candidate in candidates]
    features = layers(np.concatenate(seen, 2), 4, model, block + ".encoder", 2, "constant").mean((0, 1))
    features = features + model[block + ".project.weight"] @ fused + model[block + ".project.bias"]
    logits = model[block + ".head.weight"] @ features + model[block + ".head.bias"]
    return np.exp(logits - logits.max()) / np.exp(logits - logits.max()).sum()


def inverse_gain(image, gains):
    scale = 1 / gains
    mask = np.clip((image.mean(2, keepdims=True) - 0.9) / 0.1, 0, 1) ** 2
    return image * np.maximum(mask + (1 - mask) * scale, scale)


def gains(model, golden, photo, base):
    """White-balance and global gain, with the anchor's `base`: no white-balance gain is below 1."""
    color = golden["parameters.color"].astype(np.float64)
    image = photo + layers(photo, 4, golden, "parameters.tone_reverse", 1, "edge")
    image = np.maximum(np.clip(image, 0, 1), 1e-8) ** float(golden["parameters.gamma"][0])
    image = np.clip(image @ np.linalg.inv(color).T, 0, 1)
    fused = golden["fused_features"].reshape(-1)

    def at_least_one(pair):
        balance = np.array([pair[0] * base[0] / base[1], 1, pair[1] * base[2] / base[1]])
        return balance / balance.min()

    atoms = model["dictionary.white_balance"].astype(np.float64)
    outputs = [inverse_gain(image, at_least_one(atom)) for atom in atoms]
    balance = at_least_one(block_weights(model, "white_balance", fused, outputs) @ atoms)
    image = inverse_gain(image, balance)
    candidates = model["dictionary.gain"] * base[1] / balance[1]
    outputs = [inverse_gain(image, np.full(3, gain)) for gain in candidates]
    return balance, block_weights(model, "gain", fused, outputs) @ candidates


golden, model = (load(f"{sys.argv[1]}/{name}_spatial.safetensors") for name in ("values", "model"))
photo = golden["thumb.source"].reshape(256, 256, 3).astype(np.float64)
source = np.maximum(photo, 1e-8) ** 2.2
reference = golden["thumb.reference"].reshape(256, 256, 3)
statistics = [golden[name].reshape(-1) for name in ("source_statistics", "reference_statistics")]
correction = made_up_network(np.concatenate([*statistics, quantile_features(source), quantile_features(reference)]))
base = golden["base_gain"].reshape(-1).astype(np.float64) / np.exp(correction)
white_balance, gain = gains(model, golden, photo, base)
json.dump(
    {
        "features_256x256": quantile_features(made_up_image(256, 256)).tolist(),
        "features_150x70": quantile_features(made_up_image(150, 70)).tolist(),
        "correction": correction.tolist(),
        "base_gain": base.tolist(),
        "white_balance": white_balance.tolist(),
        "gain": [gain],
    },
    sys.stdout,
    indent=1,
)
print()
