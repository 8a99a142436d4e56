# SPDX-License-Identifier: Apache-2.0
"""The functions of srisp: inputs of any kind to arrays."""

import os
from typing import Any, Dict, Optional, Sequence, Tuple, Union

import numpy
from numpy.typing import NDArray

from . import _core
from ._image import Image
from ._inputs import Input, image_input, photo_input, reference_input

_Path = Union[str, "os.PathLike[str]"]
_WhiteBalance = Union[str, float, Sequence[float]]
_models: Dict[Tuple[str, Optional[str]], Tuple[_core.Model, Optional[Tuple[int, int, int]]]] = {}


def unprocess(image: Any, reference: Union[_core.Reference, _Path, None] = None, *,
              parameters: Optional[_core.Parameters] = None, model: Union[_core.Model, _Path, None] = None,
              input: Optional[str] = None, brightness: Union[float, str, None] = None, seed: Optional[int] = None,
              resize: Optional[str] = None, crop: Optional[str] = None, gain_map: Optional[str] = None,
              precision: Optional[str] = None, allow_partial: bool = False, name: str = "", threads: int = 0) -> Image:
    """The linear image that the reference's camera would have recorded of the photo's scene, in the reference's light.

    image: a photo. An array height x width x 1 to 4 (uint8, uint16, or floats of 0 to 1; any strides, display-encoded
        sRGB, alpha straight), a PIL image (its colour profile and orientation count), an OpenImageIO ImageBuf, anything
        with __array__ or DLPack such as a tensor; or a path of any image that OpenImageIO reads.
    reference: a Reference, or a path, folder or glob of RAW files, of which one is taken by seed and name.
    parameters: these instead of chosen ones; then no reference is needed.
    model: a Model, a name or a path; None: the one that the parameters name, else "default".
    input: how colours are read: "auto" (what the image says, else sRGB), "srgb", "linear".
    brightness: EV that the result is to be brighter than it was chosen, or "sample": drawn by seed and name from what
        the model says of its own error.
    resize, crop: sizes before all else, as texts of srisptool: "640x480", "512", "50%"; "224", "random:224".
    gain_map: "apply" takes the HDR picture of an Ultra HDR JPEG.
    precision: "fast" computes within 1e-4 by a table.
    allow_partial: a file that breaks off is taken as far as it goes, with a note.
    name: what an array is called in messages and where a seed decides; a path has its own.
    threads: 0 all, 1 the calling one only.

    Returns an Image, float32, height x width x 3 (4 with alpha), upright, of 0 to 1: the same bits that srisptool gives.
    Raises srisp.Error, TypeError, ValueError.
    """
    options = _texts(model=_model_path(model), input=input, brightness=brightness, seed=seed, resize=resize, crop=crop,
                     gainmap=gain_map, precision=precision, allow_partial=1 if allow_partial else None)
    source = photo_input(image)
    return _image(*_core.unprocess(source.image, source.metadata, name, reference_input(reference), options, parameters,
                                   threads))


def process(image: Any, parameters: Optional[_core.Parameters] = None, *,
            model: Union[_core.Model, _Path, None] = None, threads: int = 0) -> Image:
    """A RAW-like image as a display-encoded photo again.

    image: what unprocess() or develop() returned, or a path of a file that holds it; or an array height x width x 3 in
    linear camera RGB. parameters: those to go back by; None: those that the image records.

    Returns an Image, float32, height x width x 3, sRGB of 0 to 1. Raises srisp.Error.
    """
    source = image_input(image)
    return _image(*_core.process(source.image, source.metadata, "", _texts(model=_model_path(model)), parameters, threads))


def develop(image: Any, space: str = "ACEScg", *, reference: Optional[_core.Reference] = None,
            parameters: Optional[_core.Parameters] = None, white_balance: _WhiteBalance = "scene", exposure: float = 0,
            highlights: str = "clip", threads: int = 0) -> Image:
    """A RAW-like image, or a camera's RAW file, as scene-linear colour.

    image: what unprocess() returned, a path of such a file or of a camera's RAW file, or an array of linear camera RGB
        with its reference.
    space: "ACEScg", "ACES2065-1", "lin_rec709", "lin_rec2020", "lin_p3d65", "XYZ".
    reference, parameters: the camera and what was chosen, for an array that does not know them.
    white_balance: "scene", "reference", a temperature in kelvin, (kelvin, tint), or three multipliers.
    exposure: EV. highlights: "clip", "blend" or "keep".

    Returns an Image, float32, height x width x 3, without upper limit. Raises srisp.Error.
    """
    source = _known(image_input(image), parameters, reference)
    balance = white_balance if isinstance(white_balance, (str, int, float)) else ",".join(map(repr, map(float, white_balance)))
    options = _texts(develop=space, whitebalance=balance, exposure=exposure, highlights=highlights)
    return _image(*_core.develop(source.image, source.metadata, "", options, None, threads))


def mosaic(image: Any, cfa_pattern: str = "reference", *, threads: int = 0) -> Image:
    """Of each pixel the channel that a sensor's colour filter lets through.

    image: height x width x 3 (or more channels: the first three), linear camera RGB, or a path.
    cfa_pattern: "RGGB", "GRBG", "GBRG", "BGGR" from pixel (0, 0) on; "reference": as the reference's sensor has it.

    Returns an Image, float32, height x width. Raises srisp.Error.
    """
    source = image_input(image)
    return _image(*_core.sense(source.image, source.metadata, "", _texts(mosaic=cfa_pattern), None, threads))


def add_noise(image: Any, noise: _core.NoiseModel, seed: int = 0, *, cfa_pattern: str = "", name: str = "",
              threads: int = 0) -> Image:
    """A mosaic, or a linear image height x width x 3, with a sensor's noise; values above 1 are clipped there.

    noise: variance over brightness: Reference.noise, NoiseModel(...). seed, name: say which noise; each pixel's depends
    on them and on its place alone. cfa_pattern: of a mosaic that does not know its own.

    Returns an Image of the same shape; values may be below 0. Raises srisp.Error, also for NaN and infinity.
    """
    source = image_input(image)
    if isinstance(source.image, numpy.ndarray) and source.image.ndim == 2:
        source = _with_pattern(source, cfa_pattern)
    figures = "shot=" + ",".join(map(repr, noise.shot)) + ",read=" + ",".join(map(repr, noise.read))
    options = _texts(noise=figures, noise_seed=seed)
    return _image(*_core.sense(source.image, source.metadata, name, options, None, threads))


def write_dng(path: _Path, image: Any, reference: Optional[_core.Reference] = None,
              parameters: Optional[_core.Parameters] = None, *, cfa_pattern: str = "", bits: int = 16,
              datatype: str = "uint16", compression: Optional[str] = None, layout: str = "standard") -> None:
    """Writes a DNG that RAW programs open, with the reference's levels, matrices and what was chosen.

    image: a mosaic, height x width, or linear camera RGB, height x width x 3; values of 0 to 1.
    reference, parameters: for an array that does not know them, or instead of what it knows.
    cfa_pattern: of a mosaic that does not know its own. bits: 10 to 16, of integers.
    datatype: "uint16"; of three channels also "half" and "float". compression: "lossless", "none"; of floats "deflate".
    layout: "standard" or "cinema" (CinemaDNG).

    The file appears when it is complete. Raises srisp.Error; ValueError where the path does not end in .dng.
    """
    name = os.fsencode(path)
    if not name.lower().endswith(b".dng"):
        raise ValueError(f"path '{os.fsdecode(name)}' does not end in .dng")
    source = _known(image_input(image), parameters, reference)
    array = _array(source)
    metadata = (_with_pattern(source, cfa_pattern) if array.ndim == 2 else source).metadata.copy()
    for key, value in (("dng:layout", layout), ("dng:datatype", datatype), ("compression", compression)):
        metadata[key] = value
    metadata["dng:bits"] = bits if datatype == "uint16" else None
    metadata["dng:quiet"] = "1"
    _core.write(name, numpy.ascontiguousarray(_float32(array)), metadata, "float")


def select(photo: Any, reference: Union[_core.Reference, _Path, Any], model: Union[_core.Model, _Path] = "default", *,
           input: str = "auto", threads: int = 0) -> _core.Parameters:
    """The parameters that turn a photo into what the camera of the reference would have recorded.

    photo: as for unprocess(); thumbnail() of it gives the same. reference: a Reference, a path, or an array of linear
    camera RGB, height x width x 3, of which its thumbnail counts. Raises srisp.Error, TypeError, ValueError.
    """
    if isinstance(reference, (str, bytes, os.PathLike)):
        reference = _core.Reference(reference)
    if not isinstance(reference, _core.Reference):
        reference = thumbnail(reference, input="srgb", threads=threads)
    return _core.select(_loaded(model), thumbnail(photo, input=input, threads=threads), reference)


def apply(image: Any, parameters: _core.Parameters, *, direction: str = "reverse",
          model: Union[_core.Model, _Path, None] = None, region: Optional[Tuple[int, int, int, int]] = None,
          out: Optional[NDArray[Any]] = None, precision: str = "float32", threads: int = 0) -> NDArray[Any]:
    """Parameters on an array, without a look at anything else: no colour profile, no alpha, no orientation.

    image: height x width x 3, display-encoded sRGB (direction "reverse": to RAW-like) or linear camera RGB ("forward").
        float32 arrays whose channels are adjacent are not copied.
    model: what the parameters were chosen with; None: the one of that name.
    region: (x0, y0, x1, y1), the part to compute, half-open; None: all.
    out: float32, height x width x 3 of the region, which gets the result; it may be the image.
    precision: "float32" or "fast".

    Returns out, or a new array: float32, of 0 to 1; the same bits for any region and number of threads. Raises
    srisp.Error, TypeError, ValueError.
    """
    if not isinstance(parameters, _core.Parameters):
        raise TypeError(f"parameters is a {type(parameters).__name__}: srisp.Parameters is needed")
    loaded = _loaded(parameters.model_name if model is None else model)
    if direction not in ("reverse", "forward"):
        raise ValueError(f"direction is '{direction}': 'reverse' or 'forward' is needed")
    if precision not in ("float32", "fast"):
        raise ValueError(f"precision is '{precision}': 'float32' or 'fast' is needed")
    array = _array(image_input(image))
    if array.ndim != 3 or array.shape[2] != 3:
        raise ValueError(f"image has shape {array.shape}: height x width x 3 is needed")
    height, width = array.shape[:2]
    x0, y0, x1, y1 = (0, 0, width, height) if region is None else region
    if not (0 <= x0 < x1 <= width and 0 <= y0 < y1 <= height):
        raise ValueError(f"region {region} does not lie in the image of {width} x {height} pixels")
    applier = _core.Applier(loaded, parameters, direction == "forward", precision == "fast")
    if out is None:
        out = numpy.empty((y1 - y0, x1 - x0, 3), numpy.float32)
    left, right = max(x0 - applier.halo, 0), min(x1 + applier.halo, width)
    # Other values are converted piece by piece, some megabytes each.
    step = y1 - y0 if _is_view(array) else max((1 << 20) // (right - left), 1)
    for y in range(y0, y1, step):
        end = min(y + step, y1)
        top, bottom = max(y - applier.halo, 0), min(end + applier.halo, height)
        part = _pixels(array[top:bottom, left:right])
        applier.run(part, left, top, width, height, (x0, x1, y, end), out[y - y0:end - y0], threads)
    return out


def thumbnail(image: Any, *, input: str = "auto", threads: int = 0) -> NDArray[Any]:
    """What selection looks at: the whole image squashed to 256 x 256 x 3, float32, upright, by exact area averaging.

    image: as for unprocess(); of RAW-like images values are taken as they are. Raises srisp.Error, TypeError, ValueError.
    """
    source = photo_input(image)
    if input == "auto" and source.metadata.get("oiio:ColorSpace") == "camera_rgb":
        input = "srgb"
    return _core.photo_thumbnail(source.image, source.metadata, "", input, threads)


def read_photo(path: Any, *, input: Optional[str] = None, resize: Optional[str] = None, crop: Optional[str] = None,
               gain_map: Optional[str] = None, allow_partial: bool = False, threads: int = 0) -> Image:
    """A photo as the model sees it: colour profiles converted, linear values encoded, upright.

    path: any image that OpenImageIO reads; what unprocess() takes otherwise, too.

    Returns an Image, float32, height x width x 3 (4 with alpha, straight), display-encoded sRGB of 0 to 1.
    Raises srisp.Error.
    """
    source = photo_input(path)
    options = _texts(input=input, resize=resize, crop=crop, gainmap=gain_map, allow_partial=1 if allow_partial else None)
    return _image(*_core.read_photo(source.image, source.metadata, "", options, None, threads))


def psnr(result: Any, truth: Any) -> float:
    """Peak signal-to-noise ratio in dB, peak 1, over all channels; result is clamped to 0 to 1. inf: the two are equal.

    Both: height x width x 3, linear camera RGB. ValueError for two shapes.
    """
    return _core.psnr(_pixels(result), _pixels(truth))


def ssim(result: Any, truth: Any) -> float:
    """Structural similarity, peak 1: mean over R, G, B and a Gaussian window of 11 x 11 (Wang et al. 2004).

    1: the two are equal; nan: fewer than 11 pixels a side. ValueError for two shapes.
    """
    return _core.ssim(_pixels(result), _pixels(truth))


def angular_error(result: Any, truth: Any) -> float:
    """Mean angle between the colours of pixels in degrees; black ones do not count (nan: all are)."""
    return _core.angular_error(_pixels(result), _pixels(truth))


def highlight_errors(result: Any, truth: Any) -> Tuple[float, float]:
    """Mean of result - truth where truth is above 0.8: as it is, and at the gain that fits the darker pixels best."""
    return _core.highlight_errors(_pixels(result), _pixels(truth))


def delta_e2000(result: Any, truth: Any, camera_to_xyz: Any) -> float:
    """Mean CIEDE2000 of two images of linear camera RGB; about 1 is just noticeable.

    camera_to_xyz: 3 x 3, as for lab_intersection(). ValueError for two shapes.
    """
    return _core.delta_e2000(_pixels(result), _pixels(truth), numpy.asarray(camera_to_xyz, numpy.float32).tolist())


def lab_intersection(result: Any, truth: Any, camera_to_xyz: Any) -> float:
    """Part that the Lab histograms of two images have in common, 0 to 1.

    camera_to_xyz: 3 x 3, the inverse of an xyz_to_camera matrix of CameraFacts.color_matrices. Sizes may differ.
    """
    return _core.lab_intersection(_pixels(result), _pixels(truth), numpy.asarray(camera_to_xyz, numpy.float32).tolist())


def _texts(**options: Any) -> Dict[str, str]:
    """Options as srisptool takes them; None: not said."""
    return {key: str(value) for key, value in options.items() if value is not None}


def _loaded(model: Union[_core.Model, _Path]) -> _core.Model:
    """Loading takes ten times as long as selecting: models are kept, each as long as its file is the same."""
    if isinstance(model, _core.Model):
        return model
    key = (os.fspath(model), os.environ.get("SRISP_MODEL_PATH"))
    kept, state = _models.get(key, (None, None))
    if kept is None or state != _state(kept.path):
        kept = _core.Model(model)
        _models[key] = (kept, _state(kept.path))
    return kept


def _state(path: str) -> Optional[Tuple[int, int, int]]:
    try:
        found = os.stat(path)
    except OSError:
        return None
    return found.st_ino, found.st_mtime_ns, found.st_size


def _model_path(model: Union[_core.Model, _Path, None]) -> Optional[str]:
    return model.path if isinstance(model, _core.Model) else None if model is None else os.fspath(model)


def _image(pixels: NDArray[Any], metadata: _core.Metadata) -> Image:
    """Turned upright."""
    orientation = int(metadata.get("Orientation", 1))
    if orientation in range(2, 9):
        if orientation > 4:
            pixels = numpy.swapaxes(pixels, 0, 1)
        if orientation in (3, 4, 7, 8):
            pixels = pixels[::-1]
        if orientation in (2, 3, 6, 7):
            pixels = pixels[:, ::-1]
        pixels = numpy.ascontiguousarray(pixels)
        metadata["Orientation"] = 1
    return Image(pixels, metadata)


def _known(source: Input, parameters: Optional[_core.Parameters], reference: Optional[_core.Reference]) -> Input:
    if parameters is None and reference is None:
        return source
    return Input(source.image, source.metadata.recorded(parameters, reference))


def _with_pattern(source: Input, cfa_pattern: str) -> Input:
    if cfa_pattern:
        return Input(source.image, source.metadata.with_cfa_pattern(cfa_pattern))
    if not source.metadata.cfa_pattern:
        raise ValueError("cfa_pattern is needed: the mosaic does not know its own")
    return source


def _array(source: Input) -> NDArray[Any]:
    if isinstance(source.image, bytes):
        raise TypeError(f"image is the path '{os.fsdecode(source.image)}': an array is needed; read_photo() gives one")
    return source.image


def _float32(array: NDArray[Any]) -> NDArray[Any]:
    """The array itself where it is one of float32, else the floats that a file of its values gives."""
    return numpy.asarray(array) if array.dtype == numpy.float32 else _core.floats(array)


def _is_view(array: NDArray[Any]) -> bool:
    """Whether the compiled module takes it as it lies."""
    return bool(array.dtype == numpy.float32 and array.ndim == 3 and array.strides[2] == 4 and
                array.strides[0] % 4 == 0 and array.strides[1] % 4 == 0)


def _pixels(image: Any) -> NDArray[Any]:
    """float32 whose channels are adjacent."""
    array = _array(image_input(image))
    return array if _is_view(array) else numpy.ascontiguousarray(_float32(array))
