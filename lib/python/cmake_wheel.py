# SPDX-License-Identifier: Apache-2.0
"""What setuptools does not know: the wheel's compiled part is built and installed by CMake.

    SRISP_BUILD_DIR   a folder where CMake has built it already, for this Python; default: build/wheel, which is built

In the wheel, srisp/_native holds the library with its models, the program that decodes RAW files and the plugins for
OpenImageIO, as they lie below any prefix.
"""

import atexit
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path

from setuptools.command.build import build
from setuptools.command.build_py import build_py

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:  # before setuptools 70
    from wheel.bdist_wheel import bdist_wheel

SOURCE = Path(__file__).resolve().parents[2]
VERSION = re.search(r"project\(srisp VERSION ([0-9.]+)", (SOURCE / "CMakeLists.txt").read_text())[1]


class Build(build):
    """In a folder of its own: setuptools' usual one, build/lib, is CMake's."""

    def initialize_options(self):
        super().initialize_options()
        self.build_base = tempfile.mkdtemp(prefix="srisp-wheel.")
        # bdist_wheel takes the files from there afterwards; it goes with the process.
        atexit.register(shutil.rmtree, self.build_base, ignore_errors=True)


class BuildPackage(build_py):
    def run(self):
        super().run()
        folder = os.environ.get("SRISP_BUILD_DIR") or build_with_cmake()
        with tempfile.TemporaryDirectory() as prefix:
            subprocess.run(["cmake", "--install", folder, "--prefix", prefix, "--component", "python", "--strip"],
                           check=True)
            move_into_package(Path(prefix), Path(self.build_lib) / "srisp")


def build_with_cmake():
    folder = SOURCE / "build" / "wheel"
    options = ["-DCMAKE_BUILD_TYPE=Release", "-DSRISP_BUILD_TESTS=OFF", "-DSRISP_BUILD_TRAINER=OFF",
               f"-DPython_EXECUTABLE={sys.executable}"]
    if not (folder / "CMakeCache.txt").exists() and shutil.which("ninja"):
        options += ["-G", "Ninja"]
    subprocess.run(["cmake", "-S", SOURCE, "-B", folder, *options], check=True)
    subprocess.run(["cmake", "--build", folder, "--parallel", str(os.cpu_count()), "--target", "python_runtime"],
                   check=True)
    return folder


class PlatformWheel(bdist_wheel):
    def finalize_options(self):
        self.distribution.has_ext_modules = lambda: True  # it holds machine code, though setuptools compiles none
        super().finalize_options()


def move_into_package(prefix, package):
    """From the folders of an installed tree to those of a wheel."""
    suffix = sysconfig.get_config_var("EXT_SUFFIX")
    module = next(prefix.glob(f"lib/python*/*/srisp/_core{suffix}"), None)
    if module is None:
        raise SystemExit(f"srisp: the build folder has no srisp/_core{suffix}: pybind11-dev and this Python's headers "
                         "(python3-dev) are needed, and a build for this Python")
    shutil.move(module, package / module.name)
    native = package / "_native"
    (native / "lib").mkdir(parents=True)
    for library in prefix.rglob("libsrisp.so.*"):
        if library.is_symlink():  # by the name that is linked; a wheel holds no links
            shutil.copy(library.resolve(), native / "lib" / library.name)
            plugins = library.parent / "srisp"
    shutil.move(plugins, native / "lib" / "srisp")
    for folder in ("libexec", "share"):
        shutil.move(prefix / folder, native / folder)
