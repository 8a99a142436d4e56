#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The Python package from an installed tree and from a wheel: it works from any folder and needs no variable.
. "$(dirname "$0")/check.sh"
python=$(sed -n 's/^_\{0,1\}Python_EXECUTABLE:[A-Z]*=//p' "$build/CMakeCache.txt" | head -n 1)
unset PYTHONPATH OIIO_LIBRARY_PATH LD_LIBRARY_PATH

cat >"$scratch/program.py" <<'END'
import sys
import numpy, srisp
photo, reference, folder = sys.argv[1:]
ref = srisp.Reference(reference)
raw = srisp.unprocess(photo, ref)
raw.save(f"{folder}/python.exr")
srisp.write_dng(f"{folder}/python.dng", srisp.add_noise(srisp.mosaic(raw), ref.noise, seed=1))
assert srisp.Reference(f"{folder}/python.dng").facts.model == ref.facts.model
assert abs(srisp.process(f"{folder}/python.exr") - srisp.process(raw)).max() < 0.02
assert {"default", "spatial"} <= set(srisp.Model.available())
print(srisp.__file__, srisp.Model().path)
END

# works PYTHON FOLDER: the package is that below FOLDER, and so is its model
works() {
    rm -rf "$scratch/made" && mkdir "$scratch/made" || return 1
    (cd / && "$1" "$scratch/program.py" "$source/configs/sample/photo.jpg" "$source/configs/sample/reference.dng" \
        "$scratch/made") >"$scratch/where" || return 1
    cat "$scratch/where"
    [ "$(grep -oF "$2/" "$scratch/where" | wc -l)" = 2 ] || return 1
    "$prefix/bin/srisptool" "$source/configs/sample/photo.jpg" --srisp-unprocess "$source/configs/sample/reference.dng" \
        -d half -o "$scratch/made/tool.exr" && idiff -fail 0 -warn 0 "$scratch/made/python.exr" "$scratch/made/tool.exr"
}

installed_tree_works() {
    PYTHONPATH=$(echo "$prefix"/lib/python3*/dist-packages) works "$python" "$prefix"
}

# pip as a user calls it, offline; the machine code is that of the build folder, which takes minutes to make anew.
wheel_is_built() {
    mkdir "$scratch/checkout" && cp -r "$source/pyproject.toml" "$source/README.md" "$source/LICENSE" "$source/CMakeLists.txt" \
        "$scratch/checkout/" && mkdir "$scratch/checkout/lib" && cp -r "$source/lib/python" "$scratch/checkout/lib/" || return 1
    "$python" -m venv --system-site-packages "$scratch/venv" || return 1
    (cd / && SRISP_BUILD_DIR=$build "$scratch/venv/bin/pip" install --no-build-isolation --no-deps --no-index "$scratch/checkout") \
        && rm -rf "$scratch/checkout"
}

holds_no_program_of_users() {
    "$scratch/venv/bin/pip" show -f srisp >"$scratch/files" && grep -q "srisp/_native/lib/libsrisp.so.0" "$scratch/files" \
        && grep -q "srisp/py.typed" "$scratch/files" && ! grep -E "bin/|cmake|include" "$scratch/files"
}

check "the installed tree works where PYTHONPATH leads to it" installed_tree_works
check "pip builds and installs a wheel, offline" wheel_is_built
check "the wheel works in a fresh venv, from another folder" works "$scratch/venv/bin/python" "$scratch/venv"
check "the wheel holds the library and nothing for other programs" holds_no_program_of_users
finish
