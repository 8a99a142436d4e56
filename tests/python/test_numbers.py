# SPDX-License-Identifier: Apache-2.0
"""What becomes of values that are no numbers, or outside 0 to 1: docs/limits.md."""
import numpy
import OpenImageIO
import pytest
import srisp
from conftest import same_bits

ODD = [(numpy.nan, 0), (numpy.inf, 1), (-numpy.inf, 0), (-1, 0), (2, 1), (65504, 1), (70000, 1), (3e38, 1)]
PLACE = (20, 24, 1)


def with_value(image, value):
    changed = numpy.array(image, numpy.float32)
    changed[PLACE] = value
    return changed


def changed_pixels(a, b):
    different = (a != b) & ~(numpy.isnan(a) & numpy.isnan(b))
    return set(zip(*numpy.nonzero(different.reshape(a.shape[0], a.shape[1], -1).any(-1))))


@pytest.mark.parametrize("value, counted", ODD)
def test_a_photo_with_it_has_the_parameters_and_pixels_of_one_with_0_or_1(photo, reference, value, counted):
    image = photo[:100, :120].astype(numpy.float32) / 255
    odd = srisp.unprocess(with_value(image, value), reference)
    plain = srisp.unprocess(with_value(image, counted), reference)
    same_bits(odd, plain)
    assert odd.parameters.to_json() == plain.parameters.to_json()
    assert numpy.isfinite(odd).all() and odd.min() >= 0 and odd.max() <= 1


@pytest.mark.parametrize("model", ["default", "spatial"])
def test_the_way_back_gives_numbers_of_0_to_1(photo, reference, model):
    raw = srisp.unprocess(photo[:60, :80], reference, model=model)
    for value, counted in ODD:
        back = srisp.process(with_value(raw, value), raw.parameters, model=model)
        same_bits(back, srisp.process(with_value(raw, counted), raw.parameters, model=model))
        assert numpy.isfinite(back).all() and back.min() >= 0 and back.max() <= 1


@pytest.mark.parametrize("highlights", ["clip", "blend", "keep"])
def test_development_changes_its_own_pixel_alone(raw, reference, highlights):
    def developed(image):
        return srisp.develop(image, reference=reference, parameters=raw.parameters, highlights=highlights)
    plain = developed(numpy.array(raw))
    for value, _ in ODD:
        odd = developed(with_value(raw, value))
        assert changed_pixels(odd, plain) <= {PLACE[:2]}
        assert numpy.isfinite(odd[PLACE[:2]]).all() or not numpy.isfinite(value) or abs(value) > 1e30


def test_a_mosaic_keeps_what_its_filters_let_through(raw):
    plain = srisp.mosaic(raw, "GRBG")  # green at PLACE
    for value, _ in ODD:
        odd = srisp.mosaic(with_value(raw, value), "GRBG")
        assert changed_pixels(odd, plain) <= {PLACE[:2]}
        numpy.testing.assert_equal(odd[PLACE[:2]], numpy.float32(value))


def test_noise_and_DNG_refuse_what_is_no_number(raw, reference, tmp_path):
    for value in (numpy.nan, numpy.inf, -numpy.inf):
        with pytest.raises(srisp.Error, match=r"of pixel \(24, 20\)"):
            srisp.add_noise(with_value(raw, value), srisp.NoiseModel(0.01, 0))
        for datatype in ("uint16", "half", "float"):
            with pytest.raises(srisp.Error, match=r"\(24, 20\)"):
                srisp.write_dng(tmp_path / "a.dng", with_value(raw, value), reference, raw.parameters, datatype=datatype)
    with pytest.raises(srisp.Error, match="65504"):
        srisp.write_dng(tmp_path / "a.dng", with_value(raw, 70000), reference, raw.parameters, datatype="half")
    assert not list(tmp_path.iterdir())
    noisy = srisp.add_noise(with_value(raw, 3e38), srisp.NoiseModel(0.01, 0))
    assert numpy.isfinite(noisy).all()


def test_half_EXR_holds_what_halfs_can(raw, tmp_path):
    path = str(tmp_path / "a.exr")
    for value, stored in ((65504, 65504), (70000, numpy.inf), (numpy.nan, numpy.nan), (-1, -1), (1e-40, 0)):
        image = with_value(raw, value)
        buffer = OpenImageIO.ImageBuf(OpenImageIO.ImageSpec(image.shape[1], image.shape[0], 3, "half"))
        buffer.set_pixels(buffer.roi, image)
        buffer.write(path)
        held = OpenImageIO.ImageBuf(path).get_pixels(OpenImageIO.FLOAT)
        numpy.testing.assert_equal(held[PLACE], numpy.float32(stored))
        assert numpy.isfinite(srisp.process(path, raw.parameters)).all()
