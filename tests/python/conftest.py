# SPDX-License-Identifier: Apache-2.0
import itertools
import os
import subprocess
from pathlib import Path

import numpy
import OpenImageIO
import pytest

import srisp

SOURCE = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ["SRISP_TEST_BUILD"])
SAMPLE = SOURCE / "configs" / "sample"


@pytest.fixture(scope="session")
def photo_path():
    return str(SAMPLE / "photo.jpg")


@pytest.fixture(scope="session")
def photo(photo_path):
    """The sample as it is stored: uint8, 267 x 400 x 3."""
    pixels = OpenImageIO.ImageBuf(photo_path).get_pixels(OpenImageIO.UINT8)
    pixels.setflags(write=False)
    return pixels


@pytest.fixture(scope="session")
def reference_path():
    return str(SAMPLE / "reference.dng")


@pytest.fixture(scope="session")
def reference(reference_path):
    return srisp.Reference(reference_path)


@pytest.fixture(scope="session")
def raw(photo, reference):
    image = srisp.unprocess(photo, reference)
    image.setflags(write=False)
    return image


@pytest.fixture
def tool(tmp_path):
    """Runs srisptool with an output; gives its pixels, upright, float32."""
    numbers = itertools.count()

    def run(*arguments, suffix=".tif"):
        path = tmp_path / f"tool{next(numbers)}{suffix}"  # OpenImageIO caches images by their names
        words = [str(argument) for argument in arguments]
        subprocess.run([BUILD / "bin" / "srisptool", *words, "-d", "float", "--reorient", "-o", path], check=True,
                       stderr=subprocess.PIPE)
        return read_floats(path)

    return run


def read_floats(path):
    image = OpenImageIO.ImageBuf(str(path))
    assert not image.has_error, image.geterror()
    pixels = image.get_pixels(OpenImageIO.FLOAT)
    return pixels[..., 0] if pixels.shape[2] == 1 else pixels


def same_bits(a, b):
    """Says where two arrays differ most."""
    a, b = numpy.asarray(a), numpy.asarray(b)
    assert a.shape == b.shape and a.dtype == b.dtype, (a.shape, b.shape, a.dtype, b.dtype)
    if not numpy.array_equal(a, b, equal_nan=True):
        difference = numpy.abs(a.astype(float) - b)
        place = numpy.unravel_index(numpy.nanargmax(difference), difference.shape)
        pytest.fail(f"{(a != b).sum()} of {a.size} values differ, most at {place}: {a[place]} and {b[place]}")
    return True


def pytest_terminal_summary(terminalreporter, exitstatus):
    """The line that tests/run.sh counts; errors of fixtures and of collection are failures."""
    stats = terminalreporter.stats
    for report in stats.get("skipped", []):
        terminalreporter.write_line(f"SKIPPED {report.nodeid}: {report.longrepr[2]}")
    failed = len(stats.get("failed", [])) + len(stats.get("error", []))
    terminalreporter.write_line(f"{len(stats.get('passed', []))} passed, {failed} failed")
