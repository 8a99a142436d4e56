# SPDX-License-Identifier: Apache-2.0
"""Checks, programs and a folder for the scripts here, which are called with the folders of build and sources."""
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

BUILD, SOURCE = (Path(argument).resolve() for argument in sys.argv[1:3])
PLUGINS = next((BUILD / "lib").rglob("srisp.imageio.so")).parent
REFERENCE = SOURCE / "configs" / "sample" / "reference.dng"
PHOTO = SOURCE / "configs" / "sample" / "photo.jpg"
_holder = tempfile.TemporaryDirectory()
SCRATCH = Path(_holder.name).resolve()
_passed = _failed = 0


def check(sentence, good, detail=""):
    global _passed, _failed
    if good:
        _passed += 1
    else:
        _failed += 1
        print(f"FAILED: {sentence}\n    {detail}", flush=True)


def tool(name):
    return str(BUILD / "bin" / name)


def run(*words, cwd=SCRATCH, **variables):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, errors="replace", cwd=cwd,
                          stdin=subprocess.DEVNULL, env={**os.environ, **variables}, timeout=300)


def works(*words, **options):
    done = run(*words, **options)
    check(" ".join(str(word) for word in words) + " works", done.returncode == 0, done.stderr[-800:])
    return done


def need(program):
    if not shutil.which(program):
        print(f"SKIPPED {Path(sys.argv[0]).name}: needs {program}")
        sys.exit(0)


def finish():
    print(f"{_passed} passed, {_failed} failed")
    sys.exit(_failed > 0)
