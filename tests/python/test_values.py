# SPDX-License-Identifier: Apache-2.0
"""Parameters, models, references and noise as Python values."""
import copy
import json
import pickle

import numpy
import pytest
import srisp
from conftest import SOURCE, same_bits


def test_parameters_are_plain_values(raw):
    parameters = raw.parameters
    assert parameters.color.shape == (3, 3) and len(parameters.white_balance) == 3
    assert 0 < parameters.brightness_sd_ev < 20 and parameters.model_name == "default"
    assert parameters.reference_name == "reference.dng" and parameters.reference_hash.startswith("xxh128:")
    for other in (pickle.loads(pickle.dumps(parameters)), copy.copy(parameters), copy.deepcopy(parameters),
                  srisp.Parameters.from_json(parameters.to_json()), srisp.Parameters.from_dict(parameters.to_dict())):
        assert other == parameters and other is not parameters
        other.gain *= 2
        assert other != parameters
    assert json.loads(parameters.to_json()) == parameters.to_dict()
    assert "\n" not in parameters.to_json(-1)
    assert parameters != "text" and not parameters == None  # noqa: E711


def test_parameters_can_be_edited_and_count_as_written(photo, raw):
    parameters = raw.parameters
    parameters.gain /= 2
    brighter = srisp.unprocess(photo, parameters=parameters)
    assert brighter.mean() > 1.2 * raw.mean()
    parameters.color = numpy.eye(3)
    parameters.white_balance = (1, 1, 1)
    assert (parameters.color == numpy.eye(3)).all() and parameters.white_balance == (1, 1, 1)
    assert srisp.unprocess(photo, parameters=parameters).parameters == parameters
    assert raw.parameters.brightened(1).gain == pytest.approx(raw.parameters.gain / 2)
    with pytest.raises(ValueError, match="ev is 99"):
        raw.parameters.brightened(99)


def test_editing_a_copy_in_vain_is_an_error(raw):
    parameters = raw.parameters
    with pytest.raises(ValueError):
        parameters.color[0, 0] = 2
    with pytest.raises(TypeError):
        parameters.white_balance[0] = 2
    with pytest.raises(TypeError):
        parameters.color = [1, 2, 3]
    with pytest.raises(AttributeError):
        parameters.gian = 1


@pytest.mark.parametrize("text, message", [
    ("", "JSON text"), ("{}", "no 'format'"), ("[1]", "object"), ('{"gain": NaN}', "JSON"), ("[" * 5000, "JSON text")])
def test_texts_that_are_no_parameters_are_refused(text, message):
    with pytest.raises(srisp.Error, match=message):
        srisp.Parameters.from_json(text)


def test_parameters_that_cannot_be_applied_are_refused(photo, raw):
    for change in ({"gain": -1.0}, {"gamma": float("nan")}, {"color": numpy.zeros((3, 3))}):
        parameters = raw.parameters
        for name, value in change.items():
            setattr(parameters, name, value)
        with pytest.raises(srisp.Error):
            srisp.unprocess(photo, parameters=parameters)
        with pytest.raises(srisp.Error):
            parameters.check(srisp.Model())
    with pytest.raises(srisp.Error, match="spatial"):
        raw.parameters.check(srisp.Model("spatial"))


def test_the_repr_of_parameters_helps(raw):
    text = repr(raw.parameters)
    for part in ("gamma=", "color=(", "white_balance=(", "gain=", "model_name='default'", "reference_name='reference.dng'"):
        assert part in text


def test_models(tmp_path):
    model = srisp.Model()
    assert model.name == "default" and model == srisp.Model("default") and model != srisp.Model("spatial")
    assert {"default", "spatial"} <= set(srisp.Model.available())
    assert (model.kernel_size, srisp.Model("spatial").kernel_size) == (1, 3)
    assert srisp.Model(SOURCE / "configs" / "models" / "spatial.safetensors") == srisp.Model("spatial")
    assert pickle.loads(pickle.dumps(model)) == model and len({model, srisp.Model()}) == 1
    assert "kernel_size=1" in repr(model) and "default.safetensors" in repr(model)
    with pytest.raises(srisp.Error, match="unknown model 'no'"):
        srisp.Model("no")
    cut = tmp_path / "cut.safetensors"
    cut.write_bytes(open(model.path, "rb").read()[:5000])
    with pytest.raises(srisp.Error, match="cut.safetensors"):
        srisp.Model(cut)


def test_a_reference_tells_its_camera(reference, reference_path):
    facts = reference.facts
    assert facts.make == "srisp" and facts.cfa_pattern == "RGGB" and facts.size == (768, 512)
    assert len(facts.black_level) == 4 and facts.white_level > max(facts.black_level) and facts.iso is None
    matrix = facts.color_matrices[0]
    assert matrix["xyz_to_camera"].shape == (3, 3) and matrix["illuminant"] > 0
    assert facts.as_shot_neutral[1] == 1
    assert reference.path == reference_path and reference.name == "reference.dng" and reference.notes == []
    assert reference_path in repr(reference) and "Canon EOS 5D Mark II" in repr(reference) and "RGGB" in repr(facts)


def test_a_references_thumbnail_is_a_view_that_outlives_it(reference_path):
    reference = srisp.Reference(reference_path)
    thumbnail = reference.thumbnail
    assert thumbnail.shape == (256, 256, 3) and thumbnail.dtype == numpy.float32 and not thumbnail.flags.writeable
    before = thumbnail.copy()
    del reference
    same_bits(thumbnail, before)


def test_references_are_pickled_as_their_file(reference, reference_path, tmp_path):
    assert pickle.loads(pickle.dumps(reference)) == reference
    path = tmp_path / "ref.dng"
    path.write_bytes(open(reference_path, "rb").read())
    pickled = pickle.dumps(srisp.Reference(path))
    path.unlink()
    with pytest.raises(srisp.Error, match="ref.dng"):
        pickle.loads(pickled)


def test_what_is_no_reference_is_refused(photo_path, tmp_path):
    with pytest.raises(srisp.Error, match="photo.jpg"):
        srisp.Reference(photo_path)
    with pytest.raises(srisp.Error, match="no.dng.*No such file"):
        srisp.Reference("no.dng")
    (tmp_path / "empty.dng").write_bytes(b"")
    with pytest.raises(srisp.Error, match="empty.dng"):
        srisp.Reference(tmp_path / "empty.dng")
    with pytest.raises(TypeError):
        srisp.Reference(5)


def test_noise_models():
    noise = srisp.NoiseModel(0.01, [1e-4, 2e-4, 3e-4])
    assert noise.shot == (0.01,) * 3 and noise.read == (1e-4, 2e-4, 3e-4)
    assert pickle.loads(pickle.dumps(noise)) == noise != srisp.NoiseModel(0.01, 1e-4)
    assert repr(noise) == "NoiseModel(shot=(0.01, 0.01, 0.01), read=(0.0001, 0.0002, 0.0003))"
    assert srisp.NoiseModel.random(1) == srisp.NoiseModel.random(1) != srisp.NoiseModel.random(2)
    for wrong in ((-1, 0), (0, float("nan")), (2, 0)):
        with pytest.raises(srisp.Error):
            srisp.NoiseModel(*wrong)
    with pytest.raises((TypeError, RuntimeError)):
        srisp.NoiseModel([1, 2], 0)
    with pytest.raises(srisp.Error, match="noiseprofiles.json|nothing"):
        srisp.NoiseModel.darktable("nothing such", 100)


def test_images_keep_what_they_know(raw):
    assert raw.notes == "" and raw.cfa_pattern == "" and raw.metadata["oiio:ColorSpace"] == "camera_rgb"
    again = pickle.loads(pickle.dumps(raw))
    same_bits(again, raw)
    assert type(again) is srisp.Image and again.parameters == raw.parameters
    assert dict(again.metadata.items()) == dict(raw.metadata.items())
    assert raw[:10, :20].parameters == raw.parameters and (raw * 2).parameters == raw.parameters
    assert type(raw.mean()) is numpy.float32
    assert srisp.Image(numpy.zeros((2, 2, 3), numpy.float32)).parameters is None


def test_a_part_of_a_mosaic_forgets_its_filters(raw):
    mosaic = srisp.mosaic(raw, "GRBG")
    assert mosaic.cfa_pattern == "GRBG" and (mosaic * 0.5).cfa_pattern == "GRBG" and mosaic.copy().cfa_pattern == "GRBG"
    for part in (mosaic[1:], mosaic[::-1], mosaic[:, ::2], mosaic.T):
        assert part.cfa_pattern == ""
        with pytest.raises(ValueError, match="cfa_pattern is needed"):
            srisp.add_noise(part, srisp.NoiseModel(0.01, 0))
