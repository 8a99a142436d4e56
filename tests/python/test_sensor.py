# SPDX-License-Identifier: Apache-2.0
"""Mosaics, noise and DNG files: the tool's, to the bit."""
import os

import numpy
import OpenImageIO
import pytest
import srisp
from conftest import read_floats, same_bits


def test_a_mosaic_has_of_each_pixel_its_filters_channel(raw):
    mosaic = srisp.mosaic(raw, "GRBG")
    same_bits(mosaic[0::2, 0::2], raw[0::2, 0::2, 1])
    same_bits(mosaic[0::2, 1::2], raw[0::2, 1::2, 0])
    same_bits(mosaic[1::2, 0::2], raw[1::2, 0::2, 2])
    same_bits(srisp.mosaic(numpy.asarray(raw), "GRBG"), mosaic)
    assert srisp.mosaic(raw).cfa_pattern == "RGGB"
    with pytest.raises(srisp.Error, match="RGBG"):
        srisp.mosaic(raw, "RGBG")
    with pytest.raises(srisp.Error, match="image in memory: is a mosaic already"):
        srisp.mosaic(mosaic, "RGGB")


def test_noise_is_the_tools(photo_path, raw, reference, reference_path, tool):
    expected = tool(photo_path, "--srisp-unprocess", reference_path, "--srisp-mosaic", "--srisp-noise:seed=5", "reference")
    mosaic = srisp.mosaic(raw)
    same_bits(srisp.add_noise(mosaic, reference.noise, 5, name="photo.jpg"), expected)
    assert not numpy.array_equal(srisp.add_noise(mosaic, reference.noise, 6, name="photo.jpg"), expected)


def test_noise_has_its_variance_in_each_colour():
    flat = numpy.full((512, 512, 3), 0.25, numpy.float32)
    noise = srisp.NoiseModel([0.004, 0.002, 0.003], [1e-5, 2e-5, 3e-5])
    wanted = numpy.array(noise.shot) * 0.25 + noise.read
    assert abs(srisp.add_noise(flat, noise, 1).var((0, 1)) / wanted - 1).max() < 0.03
    mosaic = srisp.add_noise(flat[..., 0], noise, 1, cfa_pattern="RGGB")
    assert abs(mosaic[0::2, 0::2].var() / wanted[0] - 1) < 0.03 and abs(mosaic[1::2, 1::2].var() / wanted[2] - 1) < 0.03


def test_noise_does_not_depend_on_threads_or_strides(raw):
    noise = srisp.NoiseModel(0.01, 1e-4)
    mosaic = srisp.mosaic(raw)
    expected = srisp.add_noise(mosaic, noise, 3)
    same_bits(srisp.add_noise(mosaic, noise, 3, threads=1), expected)
    same_bits(srisp.add_noise(numpy.asfortranarray(numpy.asarray(mosaic)), noise, 3, cfa_pattern="RGGB"), expected)
    before = mosaic.copy()
    srisp.add_noise(mosaic, noise, 3)
    same_bits(mosaic, before)


def test_noise_cannot_be_added_to_what_is_no_number(raw):
    broken = numpy.array(raw)
    broken[5, 6, 0] = numpy.nan
    with pytest.raises(srisp.Error, match="nan"):
        srisp.add_noise(broken, srisp.NoiseModel(0.01, 0))
    noisy = srisp.add_noise(raw, srisp.NoiseModel(0.01, 0))
    with pytest.raises(srisp.Error, match="has noise already"):
        srisp.add_noise(noisy, srisp.NoiseModel(0.01, 0))


def dng_pixels(path):
    """What LibRaw gives without any development: linear, camera RGB."""
    hints = OpenImageIO.ImageSpec()
    for name, value in (("raw:ColorSpace", "raw"), ("raw:Demosaic", "none"), ("raw:auto_bright", 0)):
        hints.attribute(name, value)
    return OpenImageIO.ImageBuf(str(path), 0, 0, hints).get_pixels(OpenImageIO.UINT16)


def test_a_dng_is_the_tools(photo_path, raw, reference, reference_path, tmp_path):
    import subprocess
    from conftest import BUILD
    path, expected = tmp_path / "python.dng", tmp_path / "tool.dng"
    noisy = srisp.add_noise(srisp.mosaic(raw), reference.noise, 1, name="photo.jpg")
    srisp.write_dng(path, noisy, reference, raw.parameters)
    subprocess.run([BUILD / "bin" / "srisptool", photo_path, "--srisp-unprocess", reference_path, "--srisp-mosaic",
                    "--srisp-noise:seed=1", "reference", "-o", expected], check=True)
    same_bits(dng_pixels(path), dng_pixels(expected))
    same_bits(srisp.process(path), srisp.process(expected))
    ours, tools = srisp.Reference(path), srisp.Reference(expected)
    same_bits(ours.thumbnail, tools.thumbnail)
    assert repr(ours.facts) == repr(tools.facts) and ours.facts.black_level == reference.facts.black_level
    assert ours.noise == tools.noise
    srisp.write_dng(tmp_path / "known.dng", noisy)
    same_bits(dng_pixels(tmp_path / "known.dng"), dng_pixels(expected))


def test_plain_arrays_become_dngs(raw, reference, tmp_path):
    path = tmp_path / "plain.dng"
    plain = numpy.asarray(srisp.mosaic(raw))
    with pytest.raises(ValueError, match="cfa_pattern is needed"):
        srisp.write_dng(path, plain, reference)
    srisp.write_dng(path, plain, reference, raw.parameters, cfa_pattern="BGGR", bits=12, compression="none")
    facts = srisp.Reference(path).facts
    assert facts.cfa_pattern == "BGGR" and facts.model == reference.facts.model and facts.white_level == 4095
    for keywords in ({}, {"datatype": "float"}, {"datatype": "half"}, {"layout": "cinema"}):
        srisp.write_dng(path, numpy.asarray(raw), reference, raw.parameters, **keywords)
        assert abs(srisp.Reference(path).thumbnail - srisp.thumbnail(raw)).max() < 1e-3
        assert srisp.process(path).parameters == raw.parameters


def test_dngs_that_cannot_be_are_refused(raw, reference, tmp_path):
    path = tmp_path / "no.dng"
    mosaic = srisp.mosaic(raw)
    for image, keywords, error, message in (
            (mosaic, {"bits": 9}, srisp.Error, "9"), (mosaic, {"datatype": "float"}, srisp.Error, "mosaic"),
            (mosaic, {"layout": "film"}, srisp.Error, "film"), (mosaic, {"compression": "zip9"}, srisp.Error, "zip9"),
            (numpy.dstack([raw, raw[..., 0]]), {}, srisp.Error, "4 channels"), ("raw.exr", {}, TypeError, "array is needed")):
        with pytest.raises(error, match=message):
            srisp.write_dng(path, image, reference, **keywords)
    broken = numpy.array(raw)
    broken[1, 2, 0] = numpy.inf
    with pytest.raises(srisp.Error, match="inf"):
        srisp.write_dng(path, broken, reference)
    with pytest.raises(ValueError, match="does not end in .dng"):
        srisp.write_dng(tmp_path / "no.tif", mosaic, reference)
    with pytest.raises(srisp.Error, match="/nowhere/no.dng"):
        srisp.write_dng("/nowhere/no.dng", mosaic, reference)
    assert os.listdir(tmp_path) == []


def test_a_full_disk_is_told(raw, tmp_path):
    (tmp_path / "full.tif").symlink_to("/dev/full")
    with pytest.raises(srisp.Error, match="No space left"):
        raw.save(tmp_path / "full.tif")


def test_the_mosaic_that_was_read_is_the_one_that_was_saved(raw, tmp_path):
    mosaic = srisp.mosaic(raw, "GBRG")
    mosaic.save(tmp_path / "mosaic.tif")
    same_bits(read_floats(tmp_path / "mosaic.tif"), mosaic)
