# SPDX-License-Identifier: Apache-2.0
"""Photos to the RAW-like linear images of any camera, and back.

    import srisp

    ref = srisp.Reference("ref.dng")               # the camera and the light to imitate
    raw = srisp.unprocess("photo.jpg", ref)        # or an array, a PIL image, a tensor: float32, height x width x 3
    raw.parameters.gain                            # what was chosen
    mosaic = srisp.mosaic(raw, "RGGB")             # height x width
    noisy = srisp.add_noise(mosaic, ref.noise, seed=1)
    srisp.write_dng("photo.dng", noisy, ref, raw.parameters)
    photo = srisp.process(raw)                     # display-encoded again

Pictures are arrays, height x width x 3, upright. Photos are display-encoded sRGB: uint8 and uint16 use all their codes,
floats are 0 to 1. RAW-like images are linear camera RGB, 0 black and 1 saturated. Alpha is straight. What the library
refuses raises srisp.Error; wrong types and shapes raise TypeError and ValueError. All functions release the
interpreter's lock and may be called from any number of threads.

The compiled part is loaded when something of it is first used, not by the import: that takes a quarter of a second.
"""

import importlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._core import (CameraFacts, Error, Metadata, Model, NoiseModel, Parameters, Reference, __version__)
    from ._functions import (add_noise, angular_error, apply, delta_e2000, develop, highlight_errors, lab_intersection,
                             mosaic, process, psnr, read_photo, select, ssim, thumbnail, unprocess, write_dng)
    from ._image import Image

_places = {
    "_core": ("CameraFacts", "Error", "Metadata", "Model", "NoiseModel", "Parameters", "Reference", "__version__"),
    "_functions": ("add_noise", "angular_error", "apply", "delta_e2000", "develop", "highlight_errors", "lab_intersection",
                   "mosaic", "process", "psnr", "read_photo", "select", "ssim", "thumbnail", "unprocess", "write_dng"),
    "_image": ("Image",),
}

# Image is none of them: `help(srisp)` would list all of numpy.ndarray.
__all__ = ["CameraFacts", "Error", "Metadata", "Model", "NoiseModel", "Parameters", "Reference", "__version__", "add_noise",
           "angular_error", "apply", "delta_e2000", "develop", "highlight_errors", "lab_intersection", "mosaic", "process",
           "psnr", "read_photo", "select", "ssim", "thumbnail", "unprocess", "write_dng"]


def __getattr__(name: str) -> object:
    for place, names in _places.items():
        if name in names:
            value = getattr(importlib.import_module("." + place, __name__), name)
            globals()[name] = value
            return value
    if name == "torch":
        return importlib.import_module(".torch", __name__)
    raise AttributeError(f"module 'srisp' has no attribute '{name}'")


def __dir__() -> "list[str]":
    return sorted([*__all__, "Image", "torch"])
