# SPDX-License-Identifier: Apache-2.0
"""The array that srisp's functions return."""

import os
from typing import Any, Optional, Tuple, Union

import numpy

from . import _core

_CFA_PATTERN = "unprocess:cfa_pattern"


class Image(numpy.ndarray):
    """A float32 array that knows how it was made: height x width x channels, or height x width for a mosaic.

    It is a numpy array in all respects; parts of it and results of arithmetic keep what it knows. Pickling keeps it, too.
    numpy.asarray(image) forgets it.
    """

    metadata: _core.Metadata

    def __new__(cls, pixels: numpy.ndarray, metadata: Optional[_core.Metadata] = None) -> "Image":
        image = numpy.asarray(pixels).view(cls)
        image.metadata = _core.Metadata() if metadata is None else metadata
        return image

    def __array_finalize__(self, made_from: Optional[numpy.ndarray]) -> None:
        metadata = getattr(made_from, "metadata", None)
        if metadata is None or made_from is None:
            metadata = _core.Metadata()
        elif _CFA_PATTERN in metadata and (self.shape != made_from.shape or self.strides != made_from.strides):
            metadata = metadata.copy()  # a part of a mosaic may begin under another filter
            metadata[_CFA_PATTERN] = None
            metadata["unprocess:record"] = metadata["ImageDescription"] = None
        self.metadata = metadata

    def __reduce__(self) -> Any:
        function, arguments, state = super().__reduce__()  # type: ignore[misc]
        return function, arguments, (state, self.metadata)

    def __setstate__(self, state: Any) -> None:
        super().__setstate__(state[0])  # type: ignore[misc]
        self.metadata = state[1]

    @property
    def parameters(self) -> Optional[_core.Parameters]:
        """A copy of the parameters that it was made with; None: it was not made by srisp."""
        return self.metadata.parameters

    @property
    def notes(self) -> Tuple[str, ...]:
        """What was ignored, assumed or clipped, one sentence each."""
        return tuple(note for note in self.metadata.notes.split("; ") if note)

    @property
    def cfa_pattern(self) -> str:
        """Of a mosaic: 'RGGB', ... from pixel (0, 0) on; '' for others."""
        return str(self.metadata.get(_CFA_PATTERN, ""))

    def save(self, path: "Union[str, os.PathLike[str]]", dtype: str = "") -> None:
        """Writes a file of the kind that its name ends in (exr, tif, png, dng, ...), with all that it knows.

        dtype: how values are stored: "half", "float", "uint8", "uint16"; "" is half in EXR, float in TIFF, else uint16.
        The file appears when it is complete. Raises srisp.Error.
        """
        pixels = numpy.ascontiguousarray(numpy.asarray(self), numpy.float32)
        _core.write(os.fsencode(path), pixels, self.metadata, dtype)
