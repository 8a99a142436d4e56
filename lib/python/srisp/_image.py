# SPDX-License-Identifier: Apache-2.0
"""The array that srisp's functions return."""

import os
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy
from numpy.typing import NDArray

from . import _core

_STORED = ("", "half", "float", "uint8", "uint16")

if TYPE_CHECKING:
    _Array = numpy.ndarray[Any, numpy.dtype[numpy.float32]]
else:
    _Array = numpy.ndarray


class Image(_Array):
    """A float32 array that knows how it was made: height x width x channels, or height x width for a mosaic.

    It is a numpy array in all respects; parts of it and results of arithmetic keep what it knows. Pickling keeps it, too.
    numpy.asarray(image) forgets it.
    """

    _metadata: _core.Metadata
    _whole: Any  # shape and strides of the mosaic whose filters the metadata names

    def __new__(cls, pixels: NDArray[Any], metadata: Optional[_core.Metadata] = None) -> "Image":
        image = numpy.asarray(pixels).view(cls)
        image._metadata = _core.Metadata() if metadata is None else metadata
        image._whole = (image.shape, image.strides)
        return image

    def __array_finalize__(self, made_from: Optional[NDArray[Any]]) -> None:
        self._metadata = getattr(made_from, "_metadata", None) or _core.Metadata()
        self._whole = getattr(made_from, "_whole", None)

    @property
    def metadata(self) -> _core.Metadata:
        """All that it knows. A part of a mosaic does not know its filters: it may begin under another one."""
        if self._whole != (self.shape, self.strides) and self._metadata.cfa_pattern:
            self._metadata = self._metadata.with_cfa_pattern("")
        return self._metadata

    def __array_wrap__(self, array: Any, context: Any = None, *more: Any) -> Any:
        return array[()] if array.ndim == 0 else super().__array_wrap__(array, context)

    def __reduce__(self) -> Any:
        function, arguments, state = super().__reduce__()  # type: ignore[misc]
        return function, arguments, (state, self.metadata)

    def __setstate__(self, state: Any) -> None:
        super().__setstate__(state[0])
        self._metadata = state[1]
        self._whole = (self.shape, self.strides)

    @property
    def parameters(self) -> Optional[_core.Parameters]:
        """A copy of the parameters that it was made with; None: it was not made by srisp."""
        return self.metadata.parameters

    @property
    def notes(self) -> str:
        """What was ignored, assumed or clipped, in sentences; "" where nothing was."""
        return self.metadata.notes

    @property
    def cfa_pattern(self) -> str:
        """Of a mosaic: 'RGGB', ... from pixel (0, 0) on; '' for others."""
        return self.metadata.cfa_pattern

    def save(self, path: "Union[str, os.PathLike[str]]", dtype: str = "") -> None:
        """Writes a file of the kind that its name ends in (exr, tif, png, dng, ...), with all that it knows.

        dtype: how values are stored: "half", "float", "uint8", "uint16"; "" is half in EXR, float in TIFF, else uint16.
            A kind of file that lacks the type takes the nearest.
        Colour is multiplied with alpha, as files of OpenImageIO have it. The file appears when it is complete. Raises
        srisp.Error, ValueError.
        """
        if dtype not in _STORED:
            raise ValueError(f"dtype is '{dtype}': one of {', '.join(map(repr, _STORED))} is needed")
        pixels = numpy.ascontiguousarray(numpy.asarray(self), numpy.float32)
        metadata = self.metadata
        if metadata.get("oiio:UnassociatedAlpha") and pixels.ndim == 3 and pixels.shape[2] == 4:
            pixels = pixels * numpy.concatenate([numpy.repeat(pixels[..., 3:], 3, 2), numpy.ones_like(pixels[..., 3:])], 2)
            metadata = metadata.copy()
            metadata["oiio:UnassociatedAlpha"] = None
        _core.write(os.fsencode(path), pixels, metadata, dtype)
