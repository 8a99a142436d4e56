#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What model format srisp-6 adds to srisp-1, by the independent implementation in method.py: the quantile features, the
match features, the network that corrects the anchor, white-balance gains of at least 1, and clipped highlights rebuilt
where the global gain is below 1. Writes anchor_network.json, which the tests compare the library with.

    python3 tests/golden/anchor_network.py GOLDEN > tests/golden/anchor_network.json

GOLDEN is the folder with the golden model and values of srisp-1 (model_spatial, values_spatial)."""
import json
import sys

import numpy as np

from method import inverse_gain, layers, load, match_features, quantile_features, rebuilt_highlights


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


def block_weights(model, block, fused, candidates):
    """What a block chooses of its atoms, whose reverse outputs are given."""
    seen = [np.maximum(candidate, 1e-5) ** (1 / 2.2) - 0.3 for candidate in candidates]
    features = layers(np.concatenate(seen, 2), 4, model, block + ".encoder", 2, "constant").mean((0, 1))
    features = features + model[block + ".project.weight"] @ fused + model[block + ".project.bias"]
    logits = model[block + ".head.weight"] @ features + model[block + ".head.bias"]
    return np.exp(logits - logits.max()) / np.exp(logits - logits.max()).sum()


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


def clipped_colors():
    """A sensor's greys and near greys up to three times its white: [colours, 3]."""
    exposure, color = np.meshgrid(np.linspace(0, 3, 61), np.arange(3), indexing="ij")
    tint = 1 + 0.1 * np.sin(5 * exposure + 2 * color)
    return np.minimum(exposure * tint / np.array([2, 1, 1.25]), 1).astype(np.float32)


golden, model = (load(f"{sys.argv[1]}/{name}_spatial.safetensors")[0] for name in ("values", "model"))
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
        "process_gains": rebuilt_highlights(clipped_colors(), np.array([2, 1, 1.25]), 0.6).ravel().tolist(),
    },
    sys.stdout,
    indent=1,
)
print()
