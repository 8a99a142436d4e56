# SPDX-License-Identifier: Apache-2.0
"""select and apply, step by step, are what unprocess does at once."""
import numpy
import OpenImageIO
import pytest
import srisp
from conftest import same_bits


def test_select_chooses_what_unprocess_chooses(photo, photo_path, raw, reference, reference_path):
    for image in (photo, photo_path, srisp.thumbnail(photo), OpenImageIO.ImageBuf(photo_path)):
        for camera in (reference, reference_path, reference.thumbnail):
            parameters = srisp.select(image, camera)
            parameters.reference_name, parameters.reference_hash = reference.name, reference.hash
            assert parameters == raw.parameters
    assert srisp.select(photo, reference, "spatial").model_name == "spatial"
    assert srisp.select(photo, reference, srisp.Model()).reference_name == "reference.dng"


def test_a_thumbnail_is_a_mean_of_areas(photo):
    small = srisp.thumbnail(photo)
    assert small.shape == (256, 256, 3) and small.dtype == numpy.float32
    assert numpy.allclose(small.mean((0, 1)), photo.mean((0, 1)) / 255, atol=1e-5)
    same_bits(srisp.thumbnail(small), small)
    same_bits(srisp.thumbnail(photo, threads=1), small)


@pytest.mark.parametrize("model", ["default", "spatial"])
@pytest.mark.parametrize("precision", ["float32", "fast"])
def test_apply_does_what_unprocess_does(photo, reference, model, precision):
    whole = srisp.unprocess(photo, reference, model=model, precision=precision)
    parameters = whole.parameters
    same_bits(srisp.apply(photo, parameters, precision=precision), whole)
    for region in ((0, 0, 400, 267), (10, 20, 30, 50), (399, 266, 400, 267), (0, 100, 400, 101)):
        x0, y0, x1, y1 = region
        part = srisp.apply(photo, parameters, region=region, precision=precision)
        if precision == "float32" or model == "spatial":
            same_bits(part, whole[y0:y1, x0:x1])


def test_apply_takes_whatever_lies_in_memory(photo, raw):
    floats = photo.astype(numpy.float32) * numpy.float32(1 / 255)
    padded = numpy.dstack([floats, floats[..., :1]])
    for image in (floats, padded[..., :3], floats[::-1][::-1], numpy.asfortranarray(floats), floats.astype(numpy.float64)):
        result = srisp.apply(image, raw.parameters)
        assert type(result) is numpy.ndarray
        same_bits(result, raw)


def test_out_gets_the_result_where_it_lies(photo, raw):
    out = numpy.full((300, 500, 3), 9, numpy.float32)
    given = srisp.apply(photo, raw.parameters, out=out[10:277, 20:420])
    assert given.base is out or numpy.shares_memory(given, out)
    same_bits(out[10:277, 20:420], raw)
    assert (out[:10] == 9).all() and (out[:, :20] == 9).all() and (out[277:] == 9).all()
    image = photo.astype(numpy.float32) * numpy.float32(1 / 255)
    srisp.apply(image, raw.parameters, out=image)
    same_bits(image, raw)


def test_forward_is_process(raw):
    same_bits(srisp.apply(raw, raw.parameters, direction="forward"), srisp.process(raw))


def test_an_out_that_does_not_fit_is_refused_and_kept(photo, raw):
    for out, error in ((numpy.zeros((267, 400, 4), numpy.float32), ValueError), (numpy.zeros((267, 399, 3), numpy.float32), srisp.Error),
                       (numpy.zeros((267, 400, 3), numpy.float64), TypeError), (numpy.zeros((3, 267, 400), numpy.float32).transpose(1, 2, 0), ValueError)):
        with pytest.raises(error):
            srisp.apply(photo, raw.parameters, out=out)
        assert (out == 0).all()
    fixed = numpy.zeros((267, 400, 3), numpy.float32)
    fixed.setflags(write=False)
    with pytest.raises(ValueError, match="out is read-only"):
        srisp.apply(photo, raw.parameters, out=fixed)


@pytest.mark.parametrize("keywords, error, message", [
    ({"region": (0, 0, 401, 5)}, ValueError, "does not lie in the image of 400 x 267"),
    ({"region": (5, 5, 5, 9)}, ValueError, "region"), ({"direction": "sideways"}, ValueError, "'sideways'"),
    ({"precision": "half"}, ValueError, "'half'"), ({"model": "spatial"}, srisp.Error, "spatial"),
    ({"model": "none such"}, srisp.Error, "none such")])
def test_wrong_arguments_are_named(photo, raw, keywords, error, message):
    with pytest.raises(error, match=message):
        srisp.apply(photo, raw.parameters, **keywords)


def test_apply_needs_three_channels_of_an_array(photo, photo_path, raw):
    with pytest.raises(ValueError, match="height x width x 3"):
        srisp.apply(photo[..., 0], raw.parameters)
    with pytest.raises(TypeError, match="read_photo"):
        srisp.apply(photo_path, raw.parameters)
    with pytest.raises(TypeError):
        srisp.apply(photo, None)


def test_apply_bounds_what_is_no_number(raw):
    image = numpy.full((4, 5, 3), numpy.nan, numpy.float32)
    image[0, 0] = (numpy.inf, -numpy.inf, 2)
    result = srisp.apply(image, raw.parameters)
    assert ((result >= 0) & (result <= 1)).all()


def test_metrics(raw):
    truth = numpy.asarray(raw)
    assert srisp.psnr(raw, truth) == numpy.inf and srisp.angular_error(raw, truth) < 1e-5
    assert srisp.psnr(numpy.clip(truth + 0.01, 0, 1), numpy.clip(truth, 0, 1)) == pytest.approx(40, abs=0.5)
    noise = numpy.random.default_rng(1).normal(0, 0.05, truth.shape).astype(numpy.float32)
    error = numpy.clip(truth + noise, 0, 1).astype(float) - truth
    assert srisp.psnr(truth + noise, truth) == pytest.approx(-10 * numpy.log10((error ** 2).mean()), rel=1e-6)
    turned = truth[..., ::-1]
    cosine = (truth * turned).sum(2) / numpy.maximum((truth ** 2).sum(2), 1e-12)
    lit = numpy.sqrt((truth.astype(float) ** 2).sum(2)) > 1e-6
    assert srisp.angular_error(turned, truth) == pytest.approx(numpy.degrees(numpy.arccos(numpy.clip(cosine, -1, 1)))[lit].mean(), rel=1e-3)
    bright = numpy.full((4, 4, 3), 0.9, numpy.float32)
    assert srisp.highlight_errors(bright - 0.1, bright)[0] == pytest.approx(-0.1, rel=1e-4)
    assert srisp.lab_intersection(raw, truth, numpy.eye(3)) == pytest.approx(1)
    assert srisp.lab_intersection(raw * 0.5, truth, numpy.eye(3)) < 0.9
    assert srisp.ssim(raw, truth) == pytest.approx(1) and 0 < srisp.ssim(truth + noise, truth) < 0.99
    assert numpy.isnan(srisp.ssim(truth[:10], truth[:10]))
    assert srisp.delta_e2000(raw, truth, numpy.eye(3)) == 0 < srisp.delta_e2000(raw * 0.9, truth, numpy.eye(3)) < 20
    with pytest.raises(ValueError, match="the same is needed"):
        srisp.psnr(truth, truth[1:])
    with pytest.raises(ValueError, match="height x width x 3"):
        srisp.psnr(truth[..., 0], truth[..., 0])
