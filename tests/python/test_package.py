# SPDX-License-Identifier: Apache-2.0
"""What users find when they look: help, types, a light import."""
import inspect
import pydoc
import re
import subprocess
import sys

import pytest
import srisp
from conftest import BUILD, SOURCE

PACKAGE = SOURCE / "lib" / "python" / "srisp"


def run(program):
    return subprocess.run([sys.executable, "-c", program], check=True, stdout=subprocess.PIPE, text=True).stdout


def test_the_import_loads_nothing_of_the_library_nor_numpy():
    loaded = run("import sys; import srisp; print(*[m for m in ('numpy', 'srisp._core', 'PIL', 'torch', 'OpenImageIO')"
                 " if m in sys.modules])")
    assert loaded.strip() == ""


def test_using_it_imports_no_image_library():
    loaded = run("import sys, numpy, srisp; srisp.Model(); srisp.thumbnail(numpy.zeros((4, 4, 3), 'u1'));"
                 "print(*[m for m in ('PIL', 'torch', 'OpenImageIO') if m in sys.modules])")
    assert loaded.strip() == ""


def test_help_reads_well():
    text = pydoc.plain(pydoc.render_doc(srisp))
    for name in srisp.__all__:
        assert name in text or name == "__version__", name
    assert "srisp.unprocess(" in text and "float32, height x width x 3" in text
    assert not re.search(r"0x[0-9a-f]{6}|srisp\._core\.", text) and len(text.splitlines()) < 800


@pytest.mark.parametrize("name", srisp.__all__)
def test_everything_public_is_documented(name):
    thing = getattr(srisp, name)
    if name == "__version__":
        assert re.fullmatch(r"\d+\.\d+\.\d+", thing)
        return
    assert inspect.getdoc(thing) and len(inspect.getdoc(thing)) > 40
    if inspect.isclass(thing) and thing is not srisp.Error:
        own = [value for key, value in vars(thing).items() if not key.startswith("_")]
        assert thing is srisp.Metadata or thing is srisp.CameraFacts or all(inspect.getdoc(member) for member in own)


def test_names_are_listed_once_and_unknown_ones_are_errors():
    assert sorted(srisp.__all__) == sorted(set(srisp.__all__)) == sorted(set(dir(srisp)) - {"Image", "torch"})
    with pytest.raises(AttributeError, match="no attribute 'unproces'"):
        srisp.unproces  # noqa: B018


def test_errors_have_one_class():
    assert issubclass(srisp.Error, RuntimeError) and srisp.Error.__module__ == "srisp"


def test_types_are_whole():
    """mypy, strictly, on the package and on a user's program; and the stub against the compiled module."""
    subprocess.run([sys.executable, "-m", "mypy", "--cache-dir", BUILD / "mypy", "--config-file", "pyproject.toml"],
                   cwd=SOURCE, check=True)
    program = SOURCE / "tests" / "python" / "typed_program.py"
    subprocess.run([sys.executable, "-m", "mypy", "--cache-dir", BUILD / "mypy", "--strict", program], cwd=SOURCE, check=True,
                   env={"MYPYPATH": str(PACKAGE.parent), "PATH": "/usr/bin:/bin"})
    environment = {"MYPYPATH": str(PACKAGE.parent), "PYTHONPATH": str(BUILD / "python"), "PATH": "/usr/bin:/bin"}
    found = subprocess.run([sys.executable, "-m", "mypy.stubtest", "--concise", "srisp._core"], env=environment, text=True,
                           stdout=subprocess.PIPE).stdout.splitlines()
    # pybind11's classes have a metaclass, and one that Python cannot make an __init__ of object's.
    expected = re.compile(r"srisp\._core\.\w+ is inconsistent, metaclass differs|srisp\._core\.CameraFacts\.__init__ .*")
    assert [line for line in found if not expected.fullmatch(line)] == [] and len(found) > 5
