#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What model format srisp-7 adds to srisp-1, by the independent implementation in method.py: selection at a size of the
model's own, the quantile features, the match features, the network that corrects the anchor and the deviation that it
tells, white-balance gains of at least 1, and clipped highlights rebuilt where the global gain is below 1. Writes anchor_network.json, which the tests compare the library with.

    python3 tests/golden/anchor_network.py GOLDEN > tests/golden/anchor_network.json

GOLDEN is the folder with the golden model and values of srisp-1 (model_spatial, values_spatial)."""
import json
import sys

import numpy as np

from method import Selection, area_means, load, match_features, quantile_features, rebuilt_highlights


def made_up_image(height, width, phase=0):
    y, x, c = np.meshgrid(np.arange(height), np.arange(width), np.arange(3), indexing="ij")
    wave = 0.5 + 0.5 * np.sin(0.013 * x + 0.007 * (c + 1) * y + c + phase)
    return np.minimum(1.05 * wave**2, 1).astype(np.float32)


def made_up_network():
    """The tensors of srisp-7, of made-up numbers."""
    sizes = {"anchor_network": [217, 256, 256, 256, 3], "anchor_deviation": [256, 32, 1]}
    tensors = {}
    for name, widths in sizes.items():
        for layer, (inputs, outputs) in enumerate(zip(widths, widths[1:])):
            weight = 0.05 * np.sin(0.7 * np.arange(outputs * inputs) + layer)
            tensors[f"{name}.{layer}.weight"] = weight.astype(np.float32).reshape(outputs, inputs)
            tensors[f"{name}.{layer}.bias"] = (0.05 * np.cos(np.arange(outputs) + layer)).astype(np.float32)
    return tensors


def selected(size):
    """What the golden model selects at so many pixels a side, with the made-up network."""
    model, metadata = load(f"{sys.argv[1]}/model_spatial.safetensors")
    golden = load(f"{sys.argv[1]}/values_spatial.safetensors")[0]
    metadata = {**metadata, "format": "srisp-7", "selection_size": str(size)}
    thumbnails = (golden[f"thumb.{name}"].reshape(256, 256, 3) for name in ("source", "reference"))
    values = Selection({**model, **made_up_network()}, metadata, *thumbnails).values
    names = {"base_gain": "base_gain", "white_balance": "parameters.white_balance", "gain": "parameters.gain",
             "gamma": "parameters.gamma", "brightness_sd_ev": "brightness_sd_ev"}
    return {f"{short}_{size}": np.atleast_1d(values[name]).tolist() for short, name in names.items()}


def clipped_colors():
    """A sensor's greys and near greys up to three times its white: [colours, 3]."""
    exposure, color = np.meshgrid(np.linspace(0, 3, 61), np.arange(3), indexing="ij")
    tint = 1 + 0.1 * np.sin(5 * exposure + 2 * color)
    return np.minimum(exposure * tint / np.array([2, 1, 1.25]), 1).astype(np.float32)


json.dump(
    {
        "features_256x256": quantile_features(made_up_image(256, 256)).tolist(),
        "features_150x70": quantile_features(made_up_image(150, 70)).tolist(),
        "match_256x256": match_features(made_up_image(256, 256), made_up_image(256, 256, 0.6) * 0.5).tolist(),
        "match_150x70": match_features(made_up_image(150, 70), made_up_image(150, 70, 0.6) * 0.5).tolist(),
        "area_means_96": area_means(made_up_image(256, 256), 96)[5::17, 3::23].ravel().tolist(),
        **selected(256),
        **selected(96),
        "process_gains": rebuilt_highlights(clipped_colors(), np.array([2, 1, 1.25]), 0.6).ravel().tolist(),
    },
    sys.stdout,
    indent=1,
)
print()
