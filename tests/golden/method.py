# SPDX-License-Identifier: Apache-2.0
"""An independent implementation of the method in NumPy, in double precision: model formats srisp-1 and srisp-7.
Images are [height, width, channel]."""
import json
import struct

import numpy as np


def load(path):
    """The tensors and the metadata of a safetensors file."""
    with open(path, "rb") as file:
        (size,) = struct.unpack("<Q", file.read(8))
        header = json.loads(file.read(size))
        data = file.read()
    metadata = header.pop("__metadata__", {})
    kinds = {"F32": np.float32, "F16": np.float16}
    tensors = {
        name: np.frombuffer(data[slice(*entry["data_offsets"])], kinds[entry["dtype"]]).reshape(entry["shape"])
        for name, entry in header.items()
    }
    return tensors, metadata


def area_means(image, size):
    """Means over size x size equal areas, parts of pixels counted, of a square image [side, side, 3]."""
    side = image.shape[0]
    edges = np.arange(size + 1) * side / size
    pixels = np.arange(side)
    shares = np.clip(np.minimum(edges[1:, None], pixels + 1) - np.maximum(edges[:-1, None], pixels), 0, 1)
    shares /= side / size
    return np.einsum("yi,xj,ijc->yxc", shares, shares, image.astype(np.float64))


def reduced(image):
    """Means over blocks, [pixels, 3], of an image [height, width, 3]."""
    height, width, _ = image.shape
    rows, columns = max(1, height // 64), max(1, width // 64)
    whole = image[: height // rows * rows, : width // columns * columns].astype(np.float64)
    return whole.reshape(height // rows, rows, width // columns, columns, 3).mean((1, 3)).reshape(-1, 3)


def statistics(image):
    """12 numbers of a linear image [height, width, 3]."""
    pixels = image.reshape(-1, 3).astype(np.float64)
    logs = np.log(np.maximum(pixels, 1e-3)).mean(0)
    levels = [pixels.mean(0), np.median(pixels, 0), np.quantile(pixels, 0.98, axis=0)]
    mean, median, bright = (np.log(np.maximum(level, 1e-3)) for level in levels)
    return np.concatenate([mean, logs, median, bright]) * 0.5 + 1


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


def convolve(image, weight, bias, stride, border):
    """image: [height, width, channels]; `border`: a mode of np.pad."""
    size = weight.shape[2]
    padded = np.pad(image, ((size // 2, size // 2), (size // 2, size // 2), (0, 0)), mode=border)
    windows = np.lib.stride_tricks.sliding_window_view(padded, (size, size), axis=(0, 1))[::stride, ::stride]
    return np.tensordot(windows, weight.astype(np.float64), axes=([2, 3, 4], [1, 2, 3])) + bias


def layers(image, count, tensors, name, stride, border):
    for layer in range(count):
        weight, bias = (tensors[f"{name}.{layer}.{part}"] for part in ("weight", "bias"))
        image = convolve(image, weight, bias, stride, border)
        if layer < count - 1:
            image = np.maximum(image, 0)
    return image


def inverse_gain(image, gains):
    scale = 1 / gains
    mask = np.clip((image.mean(2, keepdims=True) - 0.9) / 0.1, 0, 1) ** 2
    return image * np.maximum(mask + (1 - mask) * scale, scale)


def rebuilt_highlights(raw, balance, gain):
    """White balance and a gain below 1 of the forward pass of srisp-7; raw: [..., 3]."""
    balanced = np.minimum(raw * balance, 1 / gain)
    brightest = np.maximum(balanced.max(-1, keepdims=True), 1)
    near_white = np.clip((np.minimum(balanced, 1).sum(-1, keepdims=True) - 2.9) / 0.1, 0, 1)
    share = (near_white * (brightest - 1) / (1 / gain - 1)) ** 2
    return gain * (balanced * (1 - share) + brightest * share)


class Selection:
    """Chooses block after block on the running thumbnail. `values` holds every step under its name in the golden
    files, `running` the thumbnail after each block."""

    def __init__(self, model, metadata, photo, reference):
        self.model = {name: tensor.astype(np.float64) for name, tensor in model.items()}
        self.perceptual = metadata["encoder_input"] == "perceptual"
        self.has_statistics = metadata["statistics"] == "12"
        self.has_anchor = metadata["anchor"] == "1"
        self.white_stays_white = metadata["format"] == "srisp-7"
        size = int(metadata["selection_size"]) if self.white_stays_white else 256
        self.photo, self.reference = area_means(photo, size), area_means(reference, size)
        self.image = self.photo
        self.values, self.running = {}, {}
        self.encode_images()
        self.choose_tone()
        self.choose_gamma()
        self.choose_color()
        base = self.base_gain()
        self.choose_gains(base)

    def display_input(self, image):
        return image - 0.4 if self.perceptual else image

    def linear_input(self, image):
        return np.maximum(image, 1e-5) ** (1 / 2.2) - 0.3 if self.perceptual else image

    def affine(self, name, inputs):
        return self.model[name + ".weight"] @ inputs + self.model[name + ".bias"]

    def encoded(self, image, count, name):
        return layers(image, count, self.model, name, 2, "constant").mean((0, 1))

    def encode_images(self):
        source = self.encoded(self.display_input(self.photo), 5, "source_encoder")
        reference = self.encoded(self.linear_input(self.reference), 5, "reference_encoder")
        if self.has_statistics:
            self.linear_photo = np.maximum(self.photo, 1e-8) ** 2.2
            numbers = statistics(self.linear_photo), statistics(self.reference)
            self.values["source_statistics"], self.values["reference_statistics"] = numbers
            source = source + self.affine("source_statistics", numbers[0])
            reference = reference + self.affine("reference_statistics", numbers[1])
        self.values["source_features"], self.values["reference_features"] = source, reference
        self.values["fused_features"] = self.affine("fuse", np.concatenate([source, reference]))

    def weights(self, block, features, suffix=""):
        sums = self.affine(f"{block}.project{suffix}", self.values["fused_features"]) + features
        logits = self.affine(f"{block}.head{suffix}", sums)
        return np.exp(logits - logits.max()) / np.exp(logits - logits.max()).sum()

    def choose(self, block, atoms, apply):
        """The mean of the atoms with the weights that the block gives them."""
        seen = [self.linear_input(apply(atom)) for atom in atoms]
        features = self.encoded(np.concatenate(seen, 2), 4, block + ".encoder")
        weights = self.values["weights." + block] = self.weights(block, features)
        return np.tensordot(weights, atoms, 1)

    def took(self, block, image):
        self.image = self.running[block] = image

    def choose_tone(self):
        features = self.encoded(self.display_input(self.photo), 4, "tone.encoder")
        weights = [self.weights("tone", features, f".{layer}") for layer in range(4)]
        self.values["weights.tone"] = np.stack(weights)
        for direction in ("tone_reverse", "tone_forward"):
            for layer in range(4):
                for part in ("weight", "bias"):
                    name = f"{direction}.{layer}.{part}"
                    self.values["parameters." + name] = np.tensordot(weights[layer], self.model["dictionary." + name], 1)
        self.took("tone", tone_map(self.image, self.values, "reverse"))

    def choose_gamma(self):
        image = np.maximum(self.image, 1e-8)
        gamma = self.choose("gamma", self.model["dictionary.gamma"], lambda atom: image**atom)
        self.values["parameters.gamma"] = gamma
        self.took("gamma", image**gamma)

    def choose_color(self):
        image = self.image
        atoms = self.model["dictionary.color"]
        atoms = atoms / atoms.sum(2, keepdims=True)
        color = self.choose("color", atoms, lambda atom: color_transform(image, np.linalg.inv(atom)))
        self.values["parameters.color"] = color
        self.took("color", color_transform(image, np.linalg.inv(color)))

    def base_gain(self):
        base = np.ones(3)
        if self.has_anchor:
            numbers = np.concatenate([self.values["source_statistics"], self.values["reference_statistics"]])
            expected = self.affine("anchor", numbers)
            if self.white_stays_white:
                images = self.linear_photo, self.reference
                quantiles = [quantile_features(image) for image in images]
                numbers = np.concatenate([numbers, *quantiles, match_features(*images)])
                for layer in range(3):
                    numbers = np.maximum(self.affine(f"anchor_network.{layer}", numbers), 0)
                expected = expected + self.affine("anchor_network.3", numbers)
                hidden = np.maximum(self.affine("anchor_deviation.0", numbers), 0)
                self.values["brightness_sd_ev"] = np.exp(self.affine("anchor_deviation.1", hidden)) / np.log(2)
            base = np.maximum(self.image.mean((0, 1)), 1e-3) / np.exp(expected)
        self.values["base_gain"] = base
        return base

    def choose_gains(self, base):
        image = self.image

        def balance(atom):
            gains = np.array([atom[0] * base[0] / base[1], 1, atom[1] * base[2] / base[1]])
            return gains / gains.min() if self.white_stays_white else gains

        atoms = self.model["dictionary.white_balance"]
        chosen = balance(self.choose("white_balance", atoms, lambda atom: inverse_gain(image, balance(atom))))
        self.values["parameters.white_balance"] = chosen
        self.took("white_balance", inverse_gain(image, chosen))

        balanced = self.image
        atoms = self.model["dictionary.gain"] * base[1] / chosen[1]
        gain = self.choose("gain", atoms, lambda atom: inverse_gain(balanced, np.full(3, atom)))
        self.values["parameters.gain"] = gain
        self.took("gain", np.clip(inverse_gain(balanced, np.full(3, gain)), 0, 1))


def tone_map(image, values, direction):
    return np.clip(image + layers(image, 4, values, f"parameters.tone_{direction}", 1, "edge"), 0, 1)


def color_transform(image, matrix):
    return np.clip(image @ matrix.T, 0, 1)


def reverse(image, values):
    """Photo [height, width, 3] to RAW-like, with the parameters among `values`."""
    image = np.maximum(tone_map(image.astype(np.float64), values, "reverse"), 1e-8) ** values["parameters.gamma"]
    image = color_transform(image, np.linalg.inv(values["parameters.color"]))
    image = inverse_gain(image, values["parameters.white_balance"])
    return np.clip(inverse_gain(image, np.full(3, values["parameters.gain"])), 0, 1)


def forward(raw, values, white_stays_white):
    """RAW-like to photo."""
    raw = raw.astype(np.float64)
    balance, gain = values["parameters.white_balance"], values["parameters.gain"]
    if white_stays_white and gain < 1:
        image = rebuilt_highlights(raw, balance, gain)
    else:
        image = np.clip(np.clip(raw * gain, 0, 1) * balance, 0, 1)
    image = color_transform(image, values["parameters.color"])
    return tone_map(np.maximum(image, 1e-8) ** (1 / values["parameters.gamma"]), values, "forward")
