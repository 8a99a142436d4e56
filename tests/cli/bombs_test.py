#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""bombs_test.py BUILD SOURCE: files of some 100 kB that claim far more are refused at every door, by one line, and no
process takes much memory for them. Prints the peak of each door."""
import os
import resource
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import bombs

BUILD, SOURCE = Path(sys.argv[1]), Path(sys.argv[2])
MOST_MB = 400  # of one process; libraries and a small photo take 140 to 250
LEFT = "import resource, subprocess, sys\n" \
    "run = subprocess.run(sys.argv[2:], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)\n" \
    "open(sys.argv[1], 'w').write(f'{run.returncode} {resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss}')\n" \
    "sys.stdout.buffer.write(run.stdout)\n"
failures = 0


def check(name, good, why=""):
    global failures
    failures += not good
    print("ok" if good else "FAILED", name, "" if good else why[-3000:], flush=True)


def run(*words, **environment):
    """Exit code, peak of any process (MB), and what it said."""
    done = subprocess.run([sys.executable, "-c", LEFT, "run.txt", *map(str, words)], stdout=subprocess.PIPE, timeout=300,
                          env={**os.environ, "OIIO_LIBRARY_PATH": str(PLUGINS), "SRISP_MAX_MEMORY": "2G", **environment})
    code, peak = Path("run.txt").read_text().split()
    return int(code), int(peak) // 1024, done.stdout.decode(errors="replace")


def door(name, texts, *words, codes=(1,), **environment):
    """It ends with one of `codes`, by short lines in which all texts are, and no process takes much memory."""
    code, peak, said = run(*words, **environment)
    unsaid = [text for text in texts if text not in said]
    short = all(len(line) < 1500 for line in said.splitlines())
    check(f"{name}: exit code {code}, peak {peak} MB, tells of {len(texts) - len(unsaid)}",
          code in codes and peak <= MOST_MB and not unsaid and short, f"lacks {unsaid}:\n{said}")


IN_PYTHON = """
import sys
import {module}
for path in sys.argv[1:]:
    try:
        {call}
        print('taken:', path)
    except {error} as error:
        print(path, str(error).splitlines()[0])
"""
PLUGIN = "image = OpenImageIO.ImageBuf(path + '.srisp?reference=reference.dng')\n" \
    "        image.read(force=True)\n        if image.has_error: raise RuntimeError(image.geterror())"

tool, batch = BUILD / "bin/srisptool", BUILD / "bin/srispbatch"
PLUGINS = next((BUILD / "lib").rglob("srisp.imageio.so")).parent
folder = tempfile.TemporaryDirectory()
os.chdir(folder.name)
Path("tmp").mkdir()
os.environ["TMPDIR"] = str(Path("tmp").absolute())
reference, photo = SOURCE / "configs/sample/reference.dng", SOURCE / "configs/sample/photo.jpg"
shutil.copy(reference, "reference.dng")
subprocess.check_call([BUILD / "bin/ultra_hdr_sample", "gain_map.jpg"])
gain_map = Path("gain_map.jpg").read_bytes()


def write(into, files):
    Path(into).mkdir(exist_ok=True)
    for name, data in files.items():
        (Path(into) / name).write_bytes(data)
    return [f"{into}/{name}" for name in files]


# Images: 60,000 a side is more than any may have; 40,000 is not, but more than 2 GB where a reader holds all.
made = bombs.images(Path.cwd(), reference.read_bytes(), gain_map)
within = bombs.images(Path.cwd(), reference.read_bytes(), gain_map, 40000)
held = ["arithmetic_progressive.jpg", "tiles.tif", "codestream.j2k", "plain.gif", "runs.bmp", "runs.tga", "plain.dds"]
made.update({"within_" + name: within[name] for name in held})
made.update({name: data for name, data in bombs.texts(Path.cwd()).items() if name.startswith("text.exr")})
taken, raw = made.pop("gain_map.jpg"), made.pop("photo.dng")
paths = write("images", {f"{i}_{name}": data for i, (name, data) in enumerate(made.items())})
for name in ("plain.png", "text.exr", "within_arithmetic_progressive.jpg", "within_runs.bmp"):
    path = next(path for path in paths if path.endswith("_" + name))
    for words in ((), ("--flip",)):
        door(f"srisptool {name} {' '.join(words)}", [path], tool, path, *words, "--srisp-unprocess", "reference.dng",
             "-o", "raw.exr")
door("srispbake", [paths[-1]], BUILD / "bin/srispbake", "--reference", "reference.dng", "--source", paths[-1], "-o",
     "baked")
door("srispbatch", paths, batch, "images", "--match", "*", "--reference", "reference.dng", "-o", "set", "--threads", "2")
shutil.copy(photo, "images/photo.jpg")
door("srisppack", [f"{len(paths)} photos cannot be read"], BUILD / "bin/srisppack", "images", "-o", "pack", codes=(0,))
os.remove("images/photo.jpg")
write("raws", {"0_photo.dng": raw})
shutil.copy("reference.dng", "other.dng")
names = [Path(path).name for path in paths]
door("srispeval", names, BUILD / "bin/srispeval", "unpaired", *paths, "--reference", "reference.dng", "--reference",
     "other.dng", "--size", "64")
door("srispeval, a RAW file", ["0_photo.dng"], BUILD / "bin/srispeval", "half-split", "raws")
paths.append("raws/0_photo.dng")
door("the plugin", paths, sys.executable, "-c",
     IN_PYTHON.format(module="OpenImageIO", call=PLUGIN, error="RuntimeError"), *paths, codes=(0,))
if (BUILD / "python/srisp").exists():
    door("Python", paths, sys.executable, "-c",
         IN_PYTHON.format(module="srisp", call="srisp.unprocess(path, 'reference.dng')", error="srisp.Error"), *paths,
         codes=(0,), PYTHONPATH=str(BUILD / "python"))

# References, the photo a good one.
shutil.copy(photo, "photo.jpg")
for name in ("photo.dng", "plain.exr", "text.exr", "tiles.tif"):
    path = next(path for path in paths if path.endswith("_" + name))
    door(f"srisptool, reference {name}", [path], tool, "photo.jpg", "--srisp-unprocess", path, "-o", "raw.exr")

# Small images with more text, profile or gain map than they should have are taken without it.
texts = {name: data for name, data in bombs.texts(Path.cwd()).items() if not name.startswith("text.exr")}
texts["gain_map.jpg"] = taken
for path in write("texts", texts):
    code, peak, said = run(tool, path, "--srisp-unprocess:gainmap=apply", "reference.dng", "-o", "raw.exr")
    check(f"srisptool {path}: exit code {code}, peak {peak} MB", code in (0, 1) and peak <= MOST_MB, said)

# Models, packs and sets of linear images.
tensors = {"long.safetensors": (2 ** 63 - 1).to_bytes(8, "little") + bytes(bombs.ROOM),
           "large.safetensors": bombs.safetensors(
               b'{"raw":{"dtype":"F32","shape":[60000,60000,60000,3],"data_offsets":[0,2592000000000000]}}'),
           "overflow.safetensors": bombs.safetensors(
               b'{"raw":{"dtype":"F32","shape":[4294967296,4294967296],"data_offsets":[0,0]}}')}
for path in write("models", tensors):
    door(f"srisptool, model {path}", [path], tool, "photo.jpg", f"--srisp-unprocess:model=./{path}", "reference.dng", "-o",
         "raw.exr")
door("srisppack, a set", ["large.safetensors"], BUILD / "bin/srisppack", "--strict", "--raws",
     "models/large.safetensors", "-o", "no")
write("bad_pack", {"pack.json": b'{"format":"srisp-pack-1","photos":[' + b"[" * bombs.ROOM, "photos.bin": b""})
door("srispeval, a pack", ["bad_pack"], BUILD / "bin/srispeval", "half-split", "bad_pack")

# Files that are longer than their kind may be: sparse, so that the disk does not mind.
MB = 1 << 20
Path("set.csv").write_text("photo,reference\nphoto.jpg,reference.dng\n")
door("srispbatch takes as much memory for a CSV as that has", [], batch, "photo.jpg", "--reference", "set.csv", "-o",
     "set1", codes=(0,))
Path("long").mkdir()
unprocess = (tool, "photo.jpg", "--srisp-unprocess")
for name, most, text, *words in (
        ("a.safetensors", 64 * MB, "bytes, limit 67108864", *unprocess[:2], "--srisp-unprocess:model=./long/a.safetensors",
         "reference.dng"),
        ("a.json", MB, "has more than 1048576 bytes", *unprocess[:2], "--srisp-unprocess:params=long/a.json", "-"),
        ("a.srisp", MB, "has more than 1048576 bytes", "iinfo", "long/a.srisp"),
        ("a.dng", 2048 * MB, "bytes, the limit is 2147483648", *unprocess, "long/a.dng"),
        ("a.csv", 1024 * MB, "has more than 1073741824 bytes", batch, "photo.jpg", "--reference", "long/a.csv"),
        ("profiles.json", 16 * MB, "has more than 16777216 bytes", *unprocess, "reference.dng",
         "--srisp-noise:profile=long/profiles.json", "iso=100"),
        ("a.ocio", 64 * MB, "has too many bytes, the limit is 67108863", BUILD / "bin/srispbake", "--fragment",
         "long/a.ocio"),
        ("manifest.csv", 256 * MB, "has more than 268435456 bytes", BUILD / "bin/srisppack", "long"),
        ("pack.json", 1024 * MB, "bytes, limit 1073741824", BUILD / "bin/srispeval", "half-split", "long"),
        ("scores.json", 1024 * MB, "bytes, limit 1073741824", BUILD / "bin/srispeval", "compare", "long/scores.json",
         "long/scores.json")):
    with open(f"long/{name}", "wb") as sparse:
        sparse.write(b"" if name != "a.dng" else reference.read_bytes()[:1000])
        sparse.truncate(most + 1)
    output = () if words[0] in ("iinfo", BUILD / "bin/srispeval") else ("-o", "no.exr")
    door(f"one byte more than {most}: {name}", [name if name != "pack.json" else "pack 'long'", text], *words, *output,
         codes=(1, 2))
    os.remove(f"long/{name}")

# The limits that a user sets: the same at each door, and a large photo that is read by rows is within little memory.
large = ("--create", "3000x2000", "3", "-d", "uint8", "-o")
subprocess.check_call(["oiiotool", *large, "large.png"])
limit = "has 3000 x 2000 pixels, which is more than the limit of 5 million; SRISP_MAX_MEGAPIXELS"
shutil.copy("large.png", "raws/large.png")
for environment, option in (({}, ["--max-megapixels", "5"]), ({"SRISP_MAX_MEGAPIXELS": "5"}, [])):
    how = option[0] if option else "SRISP_MAX_MEGAPIXELS"
    door(f"{how}: srisptool", [limit], tool, *option, "large.png", "--srisp-unprocess", "reference.dng", "-o", "raw.exr",
         **environment)
    door(f"{how}: srispbatch", [limit], batch, *option, "large.png", "--reference", "reference.dng", "-o", "set2",
         **environment)
    door(f"{how}: srispbake", [limit], BUILD / "bin/srispbake", *option, "--source", "large.png", "--reference",
         "reference.dng", "-o", "baked", **environment)
    door(f"{how}: srisppack", [limit], BUILD / "bin/srisppack", *option, "--photos", "large.png", "-o", "pack2",
         **environment)
    door(f"{how}: srispeval", [limit], BUILD / "bin/srispeval", "unpaired", *option, "large.png", "--reference",
         "reference.dng", "--reference", "other.dng", **environment)
door("a resize to a large size", ["resized it has 65535 x 65535 pixels, which is more than the limit"], batch, "photo.jpg",
     "--reference", "reference.dng", "-o", "no", "--resize", "65535x65535")
door("threads", ["--threads: Value 1025 not in range 0 to 1024"], batch, "photo.jpg", "--reference", "reference.dng", "-o",
     "no", "--threads", "1025", codes=(2,))
for wrong in ("0", "many", "1000001", "-5"):
    door(f"--max-megapixels {wrong}", [f"--max-megapixels '{wrong}' is not a whole number from 1 to 1000000"], tool,
         "--max-megapixels", wrong, "photo.jpg", codes=(2,))
little = "which is more than the limit of 0.105 GB; SRISP_MAX_MEMORY in the environment sets another"
door("SRISP_MAX_MEMORY: srisptool reads by rows", [], tool, "-q", "large.png", "--srisp-unprocess", "reference.dng", "-o",
     "raw.exr", codes=(0,), SRISP_MAX_MEMORY="100")
door("SRISP_MAX_MEMORY: srisptool keeps what comes between two commands", [little], tool, "large.png", "--flip",
     "--srisp-unprocess", "reference.dng", "-o", "raw.exr", SRISP_MAX_MEMORY="100")
door("SRISP_MAX_MEMORY: srispbatch keeps a result", [little], batch, "large.png", "--reference", "reference.dng", "-o",
     "set3", SRISP_MAX_MEMORY="100")
door("SRISP_MAX_MEMORY: a resized photo", [little], batch, "large.png", "--reference", "reference.dng", "-o", "set4",
     "--resize", "64", SRISP_MAX_MEMORY="100")
door("SRISP_MAX_MEMORY: a RAW file", ["of 1 channel at a time, which is more than the limit of 0.00105 GB"], tool,
     "photo.jpg", "--srisp-unprocess", "reference.dng", "-o", "raw.exr", SRISP_MAX_MEMORY="1")
door("SRISP_MAX_MEMORY: nonsense", ["SRISP_MAX_MEMORY in the environment is 'much'; a number of megabytes"], tool,
     "photo.jpg", "--srisp-unprocess", "reference.dng", "-o", "raw.exr", SRISP_MAX_MEMORY="much")
if (BUILD / "python/srisp").exists():
    door("SRISP_MAX_MEMORY: Python keeps a result", [little], sys.executable, "-c", IN_PYTHON.format(
        module="srisp", call="srisp.unprocess(path, 'reference.dng')", error="srisp.Error"), "large.png", codes=(0,),
        PYTHONPATH=str(BUILD / "python"), SRISP_MAX_MEMORY="100")
print("peak of this script itself:", resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024, "MB")
print(f"{failures} failed")
sys.exit(failures > 0)
