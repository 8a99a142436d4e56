# SPDX-License-Identifier: Apache-2.0
"""What users may give as an image or a reference, as the compiled module takes it."""

import os
import sys
from typing import Any, NamedTuple, Union

import numpy
from numpy.typing import NDArray

from . import _core
from ._image import Image


class Input(NamedTuple):
    """The bytes of a path, or an array and what is known of it."""

    image: Union[bytes, NDArray[Any]]
    metadata: _core.Metadata


def photo_input(image: Any) -> Input:
    """A photo: where nothing is said of an array's colours, they are display-encoded sRGB."""
    found = image_input(image)
    if isinstance(found.image, numpy.ndarray):
        if "oiio:ColorSpace" not in found.metadata and "ICCProfile" not in found.metadata:
            metadata = found.metadata.copy()
            metadata["oiio:ColorSpace"] = "sRGB"
            return Input(found.image, metadata)
    return found


def image_input(image: Any) -> Input:
    """Raises TypeError for what is no image, ValueError for a shape that cannot be one."""
    if isinstance(image, (str, bytes, os.PathLike)):
        return Input(os.fsencode(image), _core.Metadata())
    if isinstance(image, Image):
        return Input(_checked(numpy.asarray(image)), image.metadata)
    openimageio = sys.modules.get("OpenImageIO")
    if openimageio is not None and isinstance(image, openimageio.ImageBuf):
        return _from_imagebuf(image, openimageio)
    if hasattr(image, "getbands") and hasattr(image, "convert"):
        return _from_pil(image)
    return Input(_checked(_array_of(image)), _straight())


def reference_input(reference: Any) -> Union[bytes, _core.Reference, None]:
    """A reference, or the bytes of a path."""
    if reference is None or isinstance(reference, _core.Reference):
        return reference
    if isinstance(reference, (str, bytes, os.PathLike)):
        return os.fsencode(reference)
    raise TypeError(f"reference is a {type(reference).__name__}: a srisp.Reference or a path is needed")


def _straight() -> _core.Metadata:
    metadata = _core.Metadata()
    metadata["oiio:UnassociatedAlpha"] = 1
    return metadata


def _array_of(image: Any) -> NDArray[Any]:
    if hasattr(image, "__array__") or hasattr(image, "__array_interface__"):
        return numpy.asarray(image)
    if hasattr(image, "__dlpack__"):
        return numpy.from_dlpack(image)
    raise TypeError(f"image is a {type(image).__name__}: a path, an array, a PIL image or a tensor is needed")


def _checked(array: NDArray[Any]) -> NDArray[Any]:
    """Of a shape that the compiled module takes, in the machine's own byte order."""
    if array.ndim not in (2, 3):
        raise ValueError(f"array of shape {array.shape}: height x width x channels is needed")
    if array.ndim == 3 and array.shape[2] > 4:
        hint = ""
        if array.shape[0] in (1, 3, 4):
            hint = "; channels come last: numpy.moveaxis(image, 0, -1), tensor.permute(1, 2, 0)"
        raise ValueError(f"array of shape {array.shape}: height x width x 1 to 4 channels is needed{hint}")
    if not array.dtype.isnative:
        array = array.astype(array.dtype.newbyteorder("="))
    return array if array.flags.aligned else array.copy()


def _from_pil(image: Any) -> Input:
    """With its colour profile and its EXIF orientation, as in a file."""
    mode = image.mode
    if mode in ("P", "PA"):
        transparent = mode == "PA" or "transparency" in image.info
        image = image.convert("RGBA" if transparent else "RGB")
    elif mode in ("1", "YCbCr"):
        image = image.convert("L" if mode == "1" else "RGB")
    elif mode not in ("L", "LA", "RGB", "RGBA", "I;16", "F"):
        raise ValueError(f"PIL image of mode {mode}: convert('RGB') it first")
    metadata = _straight()
    profile = image.info.get("icc_profile")
    if profile:
        metadata["ICCProfile"] = bytes(profile)
    orientation = image.getexif().get(0x0112, 1) if hasattr(image, "getexif") else 1
    if orientation in range(2, 9):
        metadata["Orientation"] = int(orientation)
    return Input(_checked(numpy.asarray(image)), metadata)


def _from_imagebuf(image: Any, openimageio: Any) -> Input:
    """With all that it says of itself."""
    if image.has_error:
        raise _core.Error(image.geterror())
    spec = image.spec()
    metadata = _core.Metadata()
    for attribute in spec.extra_attribs:
        value = attribute.value
        if isinstance(value, numpy.ndarray):
            value = value.tobytes() if value.dtype == numpy.uint8 else [float(number) for number in value.ravel()]
        if attribute.name == "ICCProfile" and not isinstance(value, bytes):
            value = bytes(bytearray(value))
        if isinstance(value, (str, int, float, bytes)) or (isinstance(value, (tuple, list)) and
                                                           all(isinstance(number, (int, float)) for number in value)):
            metadata[attribute.name] = value
    metadata.set_channels(list(spec.channelnames), spec.alpha_channel)
    types = (openimageio.UINT8, openimageio.UINT16, openimageio.HALF, openimageio.FLOAT)
    known = spec.format.basetype if spec.format.basetype in types else openimageio.FLOAT
    pixels = image.get_pixels(openimageio.TypeDesc(known))
    return Input(pixels, metadata)
