#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""An independent implementation, in NumPy, of what model format srisp-6 adds to srisp-1: the quantile features, the
match features, the network that corrects the anchor, white-balance gains of at least 1, and clipped highlights rebuilt
where the global gain is below 1. Writes anchor_network.json, which the tests compare the library with.

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


def reduced(image):
    """Means over blocks, [pixels, 3], of an image [height, width, 3]."""
    height, width, _ = image.shape
    rows, columns = max(1, height // 64), max(1, width // 64)
    whole = image[: height // rows * rows, : width // columns * columns].astype(np.float64)
    return whole.reshape(height // rows, rows, width // columns, columns, 3).mean((1, 3)).reshape(-1, 3)


def quantile_features(image):
    """image: [height, width, 3], linear."""
    small = reduced(image)
    levels = [0.02, 0.1, 0.25, 0.4, 0.5, 0.6, 0.75, 0.9, 0.97, 0.995]
    channels = [small[:, 0], small[:, 1], small[:, 2], small.mean(1)]
    quantiles = [np.quantile(channel, levels) for channel in channels]
    logs = np.log(np.maximum(np.concatenate(quantiles), 1e-4)) * 0.5 + 1
    colors = np.log((small[:, [0, 2]] + 0.002) / (small[:, 1:2] + 0.002))
    bright = small.mean(1) >= np.quantile(small.mean(1), 0.75)
    color_levels = [0.02, 0.1, 0.25, 0.5, 0.75, 0.9, 0.98]
    color_quantiles = [np.quantile(some, color_levels, axis=0).T.ravel() for some in (colors, colors[bright])]
    return np.concatenate([logs, (small > 0.95).mean(0), *color_quantiles])


def histogram(pixels):
    """Shares of 32 x 32 x 32 cells of ln R/G, ln B/G and ln brightness."""
    mean = pixels.mean(1)
    weighs = (pixels.max(1) < 0.95) & (mean > 0.05 * mean.mean())
    logs = np.log(np.maximum(pixels, 1e-4))
    axes = [
        (logs[:, 0] - logs[:, 1]) / 0.12,
        (logs[:, 2] - logs[:, 1]) / 0.12,
        (np.log(np.maximum(mean, 1e-5)) + 3) / 0.25,
    ]
    places = np.clip(np.stack(axes) + 16, 0, 30.99)
    cells, beyond = places.astype(int), places % 1
    weights = np.where(weighs, np.sqrt(np.maximum(mean, 1e-6)), 0)
    result = np.zeros((32, 32, 32))
    for corner in np.ndindex(2, 2, 2):
        upper = np.array(corner)[:, None]
        np.add.at(result, tuple(cells + upper), weights * np.where(upper, beyond, 1 - beyond).prod(0))
    return result / max(result.sum(), 1e-6)


def match_features(photo, reference):
    """Images [height, width, 3], linear."""
    camera = np.array([[0.60, 0.32, 0.08], [0.15, 0.70, 0.15], [0.05, 0.28, 0.67]])
    frequencies = np.fft.fftfreq(32)
    shifts = frequencies * 32
    reference_spectrum = np.fft.fftn(np.sqrt(histogram(reduced(reference))))
    features = []
    for gamma in (1.65, 2.2, 2.9):
        seen = reduced(photo) ** (gamma / 2.2) @ camera.T
        spectrum = np.conj(np.fft.fftn(np.sqrt(histogram(seen)))) * reference_spectrum
        for cells in (0.5, 1):
            gaussian = np.exp(-2 * np.pi**2 * cells**2 * frequencies**2)
            smooth = np.einsum("i,j,k->ijk", gaussian, gaussian, gaussian)
            correlation = np.fft.ifftn(spectrum * smooth).real
            fits = np.exp(25 * (correlation / correlation.max() - 1))
            for axis, size in enumerate((0.12, 0.12, 0.25)):
                share = fits.sum(tuple({0, 1, 2} - {axis})) / fits.sum()
                shift = share @ shifts
                features += [shift * size, np.sqrt(share @ (shifts - shift) ** 2) * size]
            features.append(correlation.max())
        features += list(np.log(np.maximum(seen.mean(0), 1e-4)))
    return np.array(features)


def made_up_image(height, width, phase=0):
    y, x, c = np.meshgrid(np.arange(height), np.arange(width), np.arange(3), indexing="ij")
    wave = 0.5 + 0.5 * np.sin(0.013 * x + 0.007 * (c + 1) * y + c + phase)
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


def process_gains(raw, balance, gain):
    """White balance and a gain below 1 of the forward pass; raw: [colours, 3]."""
    balanced = np.minimum(raw * balance, 1 / gain)
    brightest = np.maximum(balanced.max(1, keepdims=True), 1)
    near_white = np.clip((np.minimum(balanced, 1).sum(1, keepdims=True) - 2.9) / 0.1, 0, 1)
    share = (near_white * (brightest - 1) / (1 / gain - 1)) ** 2
    return gain * (balanced * (1 - share) + brightest * share)


def clipped_colors():
    """A sensor's greys and near greys up to three times its white: [colours, 3]."""
    exposure, color = np.meshgrid(np.linspace(0, 3, 61), np.arange(3), indexing="ij")
    tint = 1 + 0.1 * np.sin(5 * exposure + 2 * color)
    return np.minimum(exposure * tint / np.array([2, 1, 1.25]), 1).astype(np.float32)


golden, model = (load(f"{sys.argv[1]}/{name}_spatial.safetensors") for name in ("values", "model"))
photo = golden["thumb.source"].reshape(256, 256, 3).astype(np.float64)
source = np.maximum(photo, 1e-8) ** 2.2
reference = golden["thumb.reference"].reshape(256, 256, 3)
statistics = [golden[name].reshape(-1) for name in ("source_statistics", "reference_statistics")]
quantiles = [quantile_features(image) for image in (source, reference)]
correction = made_up_network(np.concatenate([*statistics, *quantiles, match_features(source, reference)]))
base = golden["base_gain"].reshape(-1).astype(np.float64) / np.exp(correction)
white_balance, gain = gains(model, golden, photo, base)
json.dump(
    {
        "features_256x256": quantile_features(made_up_image(256, 256)).tolist(),
        "features_150x70": quantile_features(made_up_image(150, 70)).tolist(),
        "match_256x256": match_features(made_up_image(256, 256), made_up_image(256, 256, 0.6) * 0.5).tolist(),
        "match_150x70": match_features(made_up_image(150, 70), made_up_image(150, 70, 0.6) * 0.5).tolist(),
        "correction": correction.tolist(),
        "base_gain": base.tolist(),
        "white_balance": white_balance.tolist(),
        "gain": [gain],
        "process_gains": process_gains(clipped_colors(), np.array([2, 1, 1.25]), 0.6).ravel().tolist(),
    },
    sys.stdout,
    indent=1,
)
print()
