# SPDX-License-Identifier: Apache-2.0
"""Images of all kinds in: the same bits that srisptool gives."""
import subprocess

import numpy
import OpenImageIO
import pytest
import srisp
from conftest import BUILD, same_bits
from PIL import Image, ImageCms

oiio = OpenImageIO


def write(path, pixels, **attributes):
    """By OpenImageIO; `icc`, `orientation`, `colorspace`."""
    spec = oiio.ImageSpec(pixels.shape[1], pixels.shape[0], pixels.shape[2], str(pixels.dtype).replace("float32", "float"))
    if "orientation" in attributes:
        spec.attribute("Orientation", attributes["orientation"])
    if "unassociated" in attributes:
        spec.attribute("oiio:UnassociatedAlpha", 1)
    output = oiio.ImageOutput.create(str(path))
    assert output.open(str(path), spec) and output.write_image(pixels) and output.close(), output.geterror()
    return path


def test_an_array_gives_the_tools_bits(photo, photo_path, reference, reference_path, tool):
    raw = srisp.unprocess(photo, reference)
    assert raw.dtype == numpy.float32 and raw.shape == photo.shape and type(raw) is srisp.Image
    same_bits(raw, tool(photo_path, "--srisp-unprocess", reference_path))


def test_a_path_gives_the_tools_bits_whatever_names_the_reference(photo_path, reference, reference_path, raw):
    same_bits(srisp.unprocess(photo_path, reference), raw)
    same_bits(srisp.unprocess(photo_path, reference_path), raw)
    assert srisp.unprocess(photo_path, reference_path).parameters == raw.parameters


@pytest.mark.parametrize("orientation", range(1, 9))
def test_results_are_upright(photo, reference_path, reference, tool, tmp_path, orientation):
    path = write(tmp_path / "turned.tif", numpy.ascontiguousarray(photo[:60, :90]), orientation=orientation)
    expected = tool(path, "--srisp-unprocess", reference_path)
    assert expected.shape == ((60, 90, 3) if orientation < 5 else (90, 60, 3))
    same_bits(srisp.unprocess(path, reference), expected)
    same_bits(srisp.unprocess(oiio.ImageBuf(str(path)), reference), expected)


def test_sixteen_bits_and_floats_give_the_tools_bits(photo, reference, reference_path, tool, tmp_path):
    codes = (photo.astype(numpy.uint16) * 257 + 5)
    path = write(tmp_path / "codes.tif", codes)
    same_bits(srisp.unprocess(codes, reference), tool(path, "--srisp-unprocess", reference_path))
    values = codes.astype(numpy.float32) / numpy.float32(65540)
    path = write(tmp_path / "values.tif", values)
    expected = tool(path, "--srisp-unprocess:input=srgb", reference_path)
    same_bits(srisp.unprocess(values, reference), expected)
    same_bits(srisp.unprocess(values.astype(numpy.float64), reference), expected)
    expected = tool(path, "--srisp-unprocess:input=linear", reference_path)
    same_bits(srisp.unprocess(values, reference, input="linear"), expected)


def test_half_floats_are_values_of_0_to_1(photo, reference):
    values = (photo / 255).astype(numpy.float16)
    same_bits(srisp.unprocess(values, reference), srisp.unprocess(values.astype(numpy.float32), reference))


def test_strides_do_not_matter(photo, reference, raw):
    views = {
        "transposed": numpy.ascontiguousarray(photo.transpose(1, 0, 2)).transpose(1, 0, 2),
        "planes": numpy.ascontiguousarray(photo.transpose(2, 0, 1)).transpose(1, 2, 0),
        "backwards": numpy.ascontiguousarray(photo[::-1, ::-1, ::-1])[::-1, ::-1, ::-1],
        "every other": numpy.repeat(numpy.repeat(photo, 2, 0), 2, 1)[::2, ::2],
        "of four": numpy.dstack([photo, photo[..., :1]])[..., :3],
        "fortran": numpy.asfortranarray(photo),
    }
    for name, view in views.items():
        assert not view.flags.c_contiguous, name
        same_bits(srisp.unprocess(view, reference), raw)
        floats = view.astype(numpy.float32, order="K") * numpy.float32(1 / 255)
        same_bits(srisp.unprocess(floats, reference), srisp.unprocess(numpy.ascontiguousarray(floats), reference))


def test_other_byte_orders_and_unaligned_arrays_are_taken(photo, reference):
    codes = photo.astype(numpy.uint16) * 257
    expected = srisp.unprocess(codes, reference)
    same_bits(srisp.unprocess(codes.astype(">u2"), reference), expected)
    memory = numpy.zeros(codes.nbytes + 1, numpy.uint8)
    unaligned = memory[1:].view(numpy.uint16).reshape(codes.shape)
    unaligned[...] = codes
    assert not unaligned.flags.aligned
    same_bits(srisp.unprocess(unaligned, reference), expected)


def test_read_only_arrays_stay_as_they_are(photo, reference):
    assert not photo.flags.writeable
    before = photo.copy()
    srisp.unprocess(photo, reference)
    same_bits(photo, before)


def test_grey_images_are_three_equal_channels(photo, reference):
    grey = numpy.ascontiguousarray(photo[..., 1])
    expected = srisp.unprocess(numpy.dstack([grey] * 3), reference)
    same_bits(srisp.unprocess(grey, reference), expected)
    same_bits(srisp.unprocess(grey[..., None], reference), expected)


def test_alpha_is_straight_and_kept(photo, reference, raw):
    alpha = numpy.full(photo.shape[:2], 128, numpy.uint8)
    result = srisp.unprocess(numpy.dstack([photo, alpha]), reference)
    assert result.shape == (*photo.shape[:2], 4)
    same_bits(result[..., :3], raw)
    assert (result[..., 3] == numpy.float32(128) * numpy.float32(1 / 255)).all()
    grey = srisp.unprocess(numpy.dstack([photo[..., 0], alpha]), reference)
    assert grey.shape == (*photo.shape[:2], 4)


def test_alpha_of_files_is_straight_too(photo, reference, tmp_path):
    pixels = numpy.dstack([photo[:50, :60], numpy.full((50, 60), 200, numpy.uint8)])
    path = write(tmp_path / "alpha.png", pixels, unassociated=1)
    same_bits(srisp.unprocess(path, reference), srisp.unprocess(pixels, reference))


def test_alpha_is_saved_as_the_tool_saves_it(photo, reference, reference_path, tool, tmp_path):
    alpha = numpy.arange(50 * 60, dtype=numpy.uint8).reshape(50, 60)
    path = write(tmp_path / "alpha.png", numpy.dstack([photo[:50, :60], alpha]), unassociated=1)
    raw = srisp.unprocess(path, reference)
    raw.save(tmp_path / "python.exr", "float")
    same_bits(oiio.ImageBuf(str(tmp_path / "python.exr")).get_pixels(oiio.FLOAT),
              tool(path, "--srisp-unprocess", reference_path, suffix=".exr"))
    again = srisp.process(tmp_path / "python.exr")
    opaque = alpha > 100
    assert abs(again[opaque] - srisp.process(raw)[opaque]).max() < 1e-3


def test_a_raw_like_image_is_no_photo(raw, reference):
    with pytest.raises(srisp.Error, match="photo in memory: is a RAW-like image already"):
        srisp.unprocess(raw, reference)


def test_pil_images_are_as_their_files(photo, photo_path, reference, raw, tmp_path):
    same_bits(srisp.unprocess(Image.open(photo_path), reference), raw)
    small = Image.open(photo_path).resize((90, 60))
    for mode in ("L", "LA", "RGB", "RGBA", "P", "1"):
        image = small.convert(mode)
        image.save(tmp_path / "pil.png")
        same_bits(srisp.unprocess(image, reference), srisp.unprocess(tmp_path / "pil.png", reference))
    same_bits(srisp.unprocess(small.convert("YCbCr"), reference), srisp.unprocess(small.convert("YCbCr").convert("RGB"), reference))
    for mode in ("CMYK", "LAB", "HSV"):
        image = small.convert("RGB") if mode != "LAB" else small
        image = Image.new(mode, (9, 9)) if mode == "LAB" else image.convert(mode)
        with pytest.raises(ValueError, match=f"PIL image of mode {mode}"):
            srisp.unprocess(image, reference)


def swapped_profile():
    """An sRGB profile whose red is blue: the names of two entries of its table are exchanged."""
    profile = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
    head, table = profile[:128], profile[128:128 + 4 + 12 * int.from_bytes(profile[128:132], "big")]
    swapped = table.replace(b"rXYZ", b"....").replace(b"bXYZ", b"rXYZ").replace(b"....", b"bXYZ")
    assert swapped != table
    return head + swapped + profile[128 + len(table):]


def test_a_pil_images_profile_and_orientation_count(photo_path, reference, tmp_path):
    small = Image.open(photo_path).resize((90, 60))
    exif = Image.Exif()
    exif[0x0112] = 6
    path, plain = tmp_path / "turned.jpg", tmp_path / "plain.jpg"
    small.save(path, exif=exif.tobytes(), quality=100, icc_profile=swapped_profile())
    small.save(plain, exif=exif.tobytes(), quality=100)
    result = srisp.unprocess(Image.open(path), reference)
    assert result.shape == (90, 60, 3)
    same_bits(result, srisp.unprocess(path, reference))
    same_bits(result, srisp.unprocess(oiio.ImageBuf(str(path)), reference))
    seen, stored = srisp.read_photo(Image.open(path)), srisp.read_photo(plain)
    assert abs(seen - stored[..., ::-1]).max() < 0.01 < abs(seen - stored).max()


def test_an_imagebuf_is_as_its_file(photo_path, reference, raw):
    same_bits(srisp.unprocess(oiio.ImageBuf(photo_path), reference), raw)
    with pytest.raises(srisp.Error, match="missing.jpg"):
        srisp.unprocess(oiio.ImageBuf("missing.jpg"), reference)


def test_whatever_has_an_array_protocol_is_taken(photo, reference, raw):
    class Array:
        def __array__(self, dtype=None):
            return photo

    class Interface:
        __array_interface__ = photo.__array_interface__

    class Capsule:
        def __dlpack__(self, stream=None):
            return photo.copy().__dlpack__()

        def __dlpack_device__(self):
            return (1, 0)

    for image in (Array(), Interface(), Capsule()):
        same_bits(srisp.unprocess(image, reference), raw)


def test_a_tensor_is_taken(photo, reference, raw):
    torch = pytest.importorskip("torch")
    same_bits(srisp.unprocess(torch.from_numpy(photo.copy()), reference), raw)
    channels_first = torch.from_numpy(photo.copy()).permute(2, 0, 1).contiguous()
    with pytest.raises(ValueError, match=r"channels come last: .*permute\(1, 2, 0\)"):
        srisp.unprocess(channels_first, reference)
    same_bits(srisp.unprocess(channels_first.permute(1, 2, 0), reference), raw)


@pytest.mark.parametrize("shape", [(0, 5, 3), (5, 0, 3), (5, 5, 0), (5,), (2, 2, 2, 3), (7, 9, 5), ()])
def test_shapes_that_are_no_image_raise_ValueError(reference, shape):
    with pytest.raises(ValueError, match=r"shape \("):
        srisp.unprocess(numpy.zeros(shape, numpy.uint8), reference)


@pytest.mark.parametrize("dtype", ["int8", "int32", "int64", "uint32", "complex64", "bool", "object", "U3", "float128"])
def test_types_that_are_no_pixels_raise_TypeError(reference, dtype):
    with pytest.raises(TypeError, match="uint8, uint16, float16, float32 or float64"):
        srisp.unprocess(numpy.zeros((4, 4, 3), dtype), reference)


@pytest.mark.parametrize("image", [None, 5, [[1, 2], [3, 4]], {}, object()])
def test_what_is_no_image_raises_TypeError(reference, image):
    with pytest.raises(TypeError, match="a path, an array, a PIL image or a tensor is needed"):
        srisp.unprocess(image, reference)


def test_a_side_beyond_the_limit_is_refused_without_memory(reference):
    wide = numpy.broadcast_to(numpy.zeros((1, 1, 3), numpy.uint8), (1, (1 << 20) + 1, 3))
    with pytest.raises(ValueError, match="1 to 1048576 a side"):
        srisp.unprocess(wide, reference)
    huge = numpy.broadcast_to(numpy.zeros((1, 1, 3), numpy.uint8), (1 << 20, 1 << 20, 3))
    with pytest.raises(srisp.Error, match="photo in memory: .*1048576"):
        srisp.unprocess(huge, reference)


def test_numbers_that_are_none_become_0_and_are_noted(photo, reference):
    values = photo.astype(numpy.float32) / 255
    values[3, 4, 1] = numpy.nan
    values[5, 6, 0] = numpy.inf
    values[7, 8, 2] = -1
    result = srisp.unprocess(values, reference)
    assert numpy.isfinite(result).all() and result.min() >= 0 and result.max() <= 1
    assert "were not numbers" in result.notes
    values[3, 4, 1], values[5, 6, 0], values[7, 8, 2] = 0, 1, 0
    same_bits(result, srisp.unprocess(values, reference))


def test_one_pixel_is_an_image(reference):
    assert srisp.unprocess(numpy.full((1, 1, 3), 99, numpy.uint8), reference).shape == (1, 1, 3)


def test_options_are_the_tools(photo_path, reference, reference_path, tool):
    same_bits(srisp.unprocess(photo_path, reference, brightness=-1),
              tool(photo_path, "--srisp-unprocess:brightness=-1", reference_path))
    same_bits(srisp.unprocess(photo_path, reference, brightness="sample", seed=7),
              tool(photo_path, "--srisp-unprocess:brightness=sample:seed=7", reference_path))
    same_bits(srisp.unprocess(photo_path, reference, model="spatial"),
              tool(photo_path, "--srisp-unprocess:model=spatial", reference_path))
    same_bits(srisp.unprocess(photo_path, reference, precision="fast"),
              tool(photo_path, "--srisp-unprocess:precision=fast", reference_path))
    assert srisp.unprocess(photo_path, reference, resize="100", crop="64").shape == (64, 64, 3)


def test_sizes_and_seeds_work_on_arrays_as_on_files(photo, photo_path, reference):
    for options in ({"resize": "150x100"}, {"crop": "random:64", "seed": 3}, {"brightness": "sample", "seed": 5}):
        same_bits(srisp.unprocess(photo, reference, name="photo.jpg", **options),
                  srisp.unprocess(photo_path, reference, **options))


def test_threads_do_not_change_a_bit(photo, reference, raw):
    for threads in (1, 2, 5):
        same_bits(srisp.unprocess(photo, reference, threads=threads), raw)
    for call in (srisp.unprocess, srisp.select):
        with pytest.raises(ValueError, match="threads is -1"):
            call(photo, reference, threads=-1)
    with pytest.raises(ValueError, match="threads is -1"):
        srisp.apply(photo, raw.parameters, threads=-1)


def test_parameters_take_the_place_of_a_reference(photo, raw):
    same_bits(srisp.unprocess(photo, parameters=raw.parameters), raw)
    with pytest.raises(srisp.Error, match="photo in memory: .*reference"):
        srisp.unprocess(photo)


@pytest.mark.parametrize("keywords, message", [
    ({"model": "defualt"}, "unknown model 'defualt'.*default"),
    ({"input": "srbg"}, "srbg"),
    ({"brightness": 99}, "99"),
    ({"resize": "nonsense"}, "nonsense"),
    ({"gain_map": "apply"}, "gain map"),
])
def test_wrong_options_are_named(photo, reference, keywords, message):
    with pytest.raises(srisp.Error, match=message):
        srisp.unprocess(photo, reference, **keywords)


def test_unknown_keywords_are_pythons_error(photo, reference):
    with pytest.raises(TypeError, match="brightnes"):
        srisp.unprocess(photo, reference, brightnes=1)
    with pytest.raises(TypeError, match="reference is a int"):
        srisp.unprocess(photo, 5)


def test_files_that_are_missing_or_damaged_are_named(photo, photo_path, reference, tmp_path):
    with pytest.raises(srisp.Error, match="photo 'no.jpg': does not exist"):
        srisp.unprocess("no.jpg", reference)
    with pytest.raises(srisp.Error, match="no.dng"):
        srisp.unprocess(photo, "no.dng")
    cut = tmp_path / "cut.jpg"
    cut.write_bytes(open(photo_path, "rb").read()[:9000])
    with pytest.raises(srisp.Error, match="cut.jpg"):
        srisp.unprocess(cut, reference)
    assert srisp.unprocess(cut, reference, allow_partial=True).notes


def test_names_of_any_bytes_work(photo_path, reference, tmp_path):
    name = bytes(tmp_path) + b"/\xff %d # {} \xe9.jpg"
    with open(name, "wb") as file:
        file.write(open(photo_path, "rb").read())
    assert srisp.unprocess(name, reference).shape == (267, 400, 3)
    with pytest.raises(srisp.Error, match="missing"):
        srisp.unprocess(bytes(tmp_path) + b"/\xff missing.jpg", reference)


def test_the_way_back_gives_the_photo(photo, raw):
    again = srisp.process(raw)
    assert again.dtype == numpy.float32 and abs(again * 255 - photo).mean() < 1.5
    same_bits(srisp.process(numpy.asarray(raw), raw.parameters), again)
    with pytest.raises(srisp.Error, match="image in memory: is not a RAW-like image"):
        srisp.process(numpy.asarray(raw))


def test_the_way_back_is_the_tools(raw, tool, tmp_path):
    raw.save(tmp_path / "raw.tif")
    same_bits(srisp.process(raw), tool(tmp_path / "raw.tif", "--srisp-process"))
    same_bits(srisp.process(tmp_path / "raw.tif"), srisp.process(raw))


def test_developed_images_are_the_tools(photo_path, raw, reference, reference_path, tool):
    for keywords in ({}, {"space": "lin_rec709", "exposure": 0.5, "highlights": "blend"}, {"white_balance": (5000, 10)},
                     {"white_balance": 4000}):
        developed = srisp.develop(raw, **keywords)
        assert developed.shape == raw.shape and numpy.isfinite(developed).all()
        same_bits(developed, srisp.develop(numpy.asarray(raw), reference=reference, parameters=raw.parameters, **keywords))
    same_bits(srisp.develop(raw), tool(photo_path, "--srisp-unprocess", reference_path, "--srisp-develop", "ACEScg"))
    with pytest.raises(srisp.Error, match="acescgg"):
        srisp.develop(raw, "acescgg")


def test_photos_are_read_as_the_tools_read_them(photo, photo_path, reference, raw):
    seen = srisp.read_photo(photo_path)
    same_bits(seen, photo.astype(numpy.float32) * numpy.float32(1 / 255))
    same_bits(srisp.unprocess(seen, reference), raw)
    linear = ((seen.astype(numpy.float64) + 0.055) / 1.055) ** 2.4
    assert abs(srisp.read_photo(linear, input="linear")[seen > 0.05] - seen[seen > 0.05]).max() < 1e-5


def test_images_are_saved_with_all_that_they_know(raw, tmp_path):
    for name, dtype, most in (("raw.exr", "float", 0), ("raw.tif", "", 0), ("raw.exr", "", 5e-4), ("raw.png", "uint16", 1e-5)):
        raw.save(tmp_path / name, dtype)
        read = oiio.ImageBuf(str(tmp_path / name))
        assert abs(read.get_pixels(oiio.FLOAT) - raw).max() <= most
        assert srisp.process(tmp_path / name).parameters == raw.parameters
    with pytest.raises(srisp.Error, match="/nowhere/raw.exr"):
        raw.save("/nowhere/raw.exr")
    with pytest.raises(ValueError, match="dtype is 'flaot'"):
        raw.save(tmp_path / "raw.exr", "flaot")
    with pytest.raises(srisp.Error, match="raw.xyz"):
        raw.save(tmp_path / "raw.xyz")


def test_the_command_line_reads_what_python_saved(raw, tmp_path):
    raw.save(tmp_path / "raw.exr", "float")
    subprocess.run([BUILD / "bin" / "srisptool", tmp_path / "raw.exr", "--srisp-process", "-o", tmp_path / "again.tif"],
                   check=True)
    assert oiio.ImageBuf(str(tmp_path / "again.tif")).spec().width == raw.shape[1]
