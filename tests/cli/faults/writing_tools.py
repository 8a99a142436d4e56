# SPDX-License-Identifier: Apache-2.0
"""The commands of all tools that write, each small, and what must hold of their files whatever goes wrong."""
import hashlib
import os
import re
import shutil
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

LONGEST = 120  # seconds for one run, which takes one or two: what takes longer hangs
PYTHON = "/usr/bin/python3"


@dataclass
class Tool:
    """A command, run in a folder with out/ and tmp/ (TMPDIR); its inputs are in ../in."""
    name: str
    command: list
    outputs: list  # what it writes, for messages: one of these names or a temporary folder is in each
    before: str = ""  # the folder of in/ that out/ begins as; "": each output is an old file
    journals: str = "^$"  # names of files that keep what was done when a run fails
    varies: str = "^$"  # names of files that differ from run to run (times); a good run has them
    environment: dict = field(default_factory=dict)
    stream: bool = False  # its output is stdout, of which what failed leaves a part


def tools_of(build):
    """The table."""
    bins = Path(build) / "bin"
    srisptool, bake, batch, evaluate = (str(bins / name) for name in ("srisptool", "srispbake", "srispbatch", "srispeval"))
    unprocess = [srisptool, "../in/photo.jpg", "--srisp-unprocess", "../in/reference.dng"]
    plain = [Tool(f"unprocess_{kind}", [*unprocess, "-o", f"out/raw.{kind}"], [f"raw.{kind}"])
             for kind in ("exr", "tif", "png", "dng")]
    batches = [Tool(f"batch_{kind}", [batch, "../in/photos", "--reference", "../in/reference.dng", "-o", "out/set", "-q",
                                      "--threads", "2", "--format", kind, "--copy", "*.txt"],
                    ["set"], before="nothing", journals=r"^set/(manifest/.*|.*\.(txt|exr|dng|npy))$") for kind in ("exr", "npy")]
    saved = "import srisp\nimage = srisp.unprocess('../in/photo.jpg', '../in/reference.dng')\n"
    python_path = {"PYTHONPATH": str(Path(build) / "python"), "PYTHONDONTWRITEBYTECODE": "1"}
    tools = [
        *plain,
        Tool("unprocess_jpg", [*unprocess, "--srisp-process", "-o", "out/again.jpg"], ["again.jpg"]),
        Tool("process_tif", [srisptool, "../in/raw.exr", "--srisp-process", "-d", "uint8", "-o", "out/photo.tif"], ["photo.tif"]),
        Tool("develop_exr", [srisptool, "../in/raw.exr", "--srisp-develop", "ACEScg", "-o", "out/aces.exr"], ["aces.exr"]),
        Tool("sensor_dng", [*unprocess, "--srisp-mosaic", "--srisp-noise", "reference", "-o", "out/raw.dng"], ["raw.dng"]),
        Tool("parameters", [*unprocess, "--srisp-save-params", "out/look.json", "-o", "out/raw.exr"], ["look.json", "raw.exr"]),
        Tool("parameters_stdout", [srisptool, "../in/photo.jpg", "--srisp-params", "../in/reference.dng"], ["stdout"], stream=True),
        Tool("bake_clf", [bake, "--reference", "../in/reference.dng", "--lut-size", "5", "-q", "-o", "out/look"],
             ["look.unprocess.clf", "look.process.clf", "look.develop.clf"]),
        Tool("bake_cube", [bake, "--params", "../in/look.json", "--lut-size", "5", "-q", "-o", "out/look.cube"], ["look.cube"]),
        Tool("bake_fragment", [bake, "--fragment", "out/studio.ocio", "-q"], ["studio.ocio"], before="config"),
        *batches,
        Tool("batch_merge", [batch, "--merge", "out/set", "-q"], ["set"], before="shards", journals=r"^set/manifest/"),
        Tool("batch_redo", [batch, "--redo", "out/set/1.exr", "-o", "out/again.exr", "-q"], ["again.exr"], before="shards"),
        Tool("eval", [evaluate, "half-split", "../in/reference.dng", "--size", "48", "--rendering", "fixed", "-q", "--threads", "1",
                      "--report", "out/report.html", "--json", "out/scores.json", "--csv", "out/scores.csv"],
             ["report.html", "scores.json", "scores.csv"], journals=r"unfinished$|^scores|^report"),
        Tool("eval_compare", [evaluate, "compare", "../in/scores.json", "../in/scores.json", "--method", "upi=default",
                              "--json", "out/compare.json"], ["compare.json"]),
        Tool("pack", [str(bins / "srisppack"), "../in/photos", "-o", "out/pack", "--size", "32", "--crops", "1", "--strict",
                      "--replace", "-q"], ["pack"], before="packed"),
        Tool("dng_plugin", ["oiiotool", "../in/raw.exr", "-d", "uint16", "-o", "out/raw.dng"], ["raw.dng"],
             environment={"OIIO_LIBRARY_PATH": str(Path(build) / "lib" / "srisp")}),
        *[Tool(f"python_{kind}", [PYTHON, "-c", saved + f"image.save('out/raw.{kind}')"], [f"raw.{kind}"], environment=python_path)
          for kind in ("exr", "tif", "png", "jp2")],
        Tool("python_dng", [PYTHON, "-c", saved + "srisp.write_dng('out/raw.dng', srisp.mosaic(image))"], ["raw.dng"],
             environment=python_path),
    ]
    if (bins / "srisptrain").exists():
        tools.append(Tool("train", [str(bins / "srisptrain"), "../in/tiny.json", "-o", "out/trained", "--threads", "1", "-q"],
                          ["trained"], before="nothing", journals=r"^trained/", varies=r"log\.|checkpoint"))
    return tools


class Workplace:
    """A folder with the inputs of all tools, made by good runs."""

    def __init__(self, root, build, source):
        self.root, self.build = Path(root), Path(build)
        self.inputs = self.root / "in"
        self._make_inputs(Path(source) / "configs" / "sample")

    def _make_inputs(self, sample):
        bins, inputs = self.build / "bin", self.inputs
        for folder in ("photos", "nothing", "config", "packed", "tmp"):
            (inputs / folder).mkdir(parents=True)
        shutil.copy(sample / "reference.dng", inputs)

        def run(*words):
            subprocess.run(words, cwd=inputs, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                           env={**os.environ, "TMPDIR": str(inputs / "tmp")})
        run("oiiotool", str(sample / "photo.jpg"), "--resize", "96x0", "-o", "photo.jpg")
        run("oiiotool", "photo.jpg", "--mulc", "0.8,0.9,1", "-o", "photos/1.jpg")
        run("oiiotool", "photo.jpg", "--mulc", "0.9,0.8,1", "-o", "photos/2.png")
        (inputs / "photos" / "notes.txt").write_text("notes\n")
        run(bins / "srisptool", "photo.jpg", "--srisp-unprocess", "reference.dng", "--srisp-save-params", "look.json",
            "-o", "raw.exr")
        (inputs / "config" / "studio.ocio").write_text(STUDIO)
        for shard in ("0/2", "1/2"):  # with the paths that a tool's folder has
            run(bins / "srispbatch", "../in/photos", "--reference", "../in/reference.dng", "-o", "../in/shards/set", "-q",
                "--threads", "1", "--shard", shard)
        run(bins / "srispeval", "half-split", "reference.dng", "--size", "48", "--rendering", "fixed", "-q", "--json", "scores.json")
        run(bins / "srisppack", "photos", "-o", "packed/pack", "--size", "32", "--crops", "0", "-q")
        if (bins / "srisptrain").exists():
            run(bins / "small_pack", "train_pack")
            (inputs / "tiny.json").write_text(TINY)

    def begin(self, tool):
        """The folder of a tool, anew: a run's current folder."""
        place = self.root / tool.name
        shutil.rmtree(place, ignore_errors=True)
        (place / "tmp").mkdir(parents=True)
        if tool.before:
            shutil.copytree(self.inputs / tool.before, place / "out")
        else:
            (place / "out").mkdir()
            for output in tool.outputs:
                (place / "out" / output).write_text("old\n")
        return place

    def run(self, tool, place, around=(), environment=None):
        """Exit code (or "hangs") and what it said on stderr. around: words before the command."""
        variables = {**os.environ, **tool.environment, **(environment or {}), "TMPDIR": str(place / "tmp")}
        variables.pop("SRISP_BAKE_PATH", None)
        with open(place / "out" / tool.outputs[0] if tool.stream else os.devnull, "wb") as stdout:
            process = subprocess.Popen([*around, *tool.command], cwd=place, env=variables, stdin=subprocess.DEVNULL,
                                       stdout=stdout, stderr=subprocess.PIPE, start_new_session=True)
        try:
            _, said = process.communicate(timeout=LONGEST)
            return process.returncode, said.decode(errors="replace")
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, 9)
            process.communicate()
            return "hangs", ""


def snapshot(place, tool):
    """Names and contents of all that is in out/; without what differs from run to run."""
    files = {}
    for path in sorted((place / "out").rglob("*")):
        name = str(path.relative_to(place / "out"))
        if path.is_file():
            content = re.sub(rb'"(time|ms|seconds)": ?[0-9.]+', b"", path.read_bytes())
            if name.endswith(".jsonl"):  # whose lines come as they are done
                content = b"".join(sorted(content.splitlines(True)))
            files[name] = "" if re.search(tool.varies, name) else hashlib.sha256(content).hexdigest()
    return files


def left_behind(place):
    """What no run may leave: hidden and temporary files."""
    return [str(path.relative_to(place)) for folder in ("out", "tmp") for path in (place / folder).rglob("*")
            if folder == "tmp" or re.search(UNFINISHED, path.name)]


UNFINISHED = r"(^|/)\.|\.[0-9a-f]{8}\.temp\."  # ours, and oiiotool's: what the next run removes


def broken_files(place, tool, expected, before):
    """Files that are neither as before, nor complete, nor a journal."""
    return [name for name, content in snapshot(place, tool).items()
            if content not in (expected.get(name), before.get(name)) and not re.search(tool.journals, name)
            and not tool.stream and not re.search(UNFINISHED, name)]


def messages(said):
    """Without warnings, notes, and what Python and oiiotool say beside their messages; oiiotool itself warns in many words."""
    told = [line for line in said.splitlines()
            if line and not re.search(r"^ |^Traceback|^Full command line was|^> |warning|note:|WARNING|^libpng ", line)]
    return told


STUDIO = """ocio_profile_version: 2
search_path: luts
roles: {default: raw, scene_linear: lin, reference: lin}
file_rules:
  - !<Rule> {name: Default, colorspace: default}
displays:
  sRGB:
    - !<View> {name: Raw, colorspace: raw}
colorspaces:
  - !<ColorSpace> {name: raw, isdata: true}
  - !<ColorSpace> {name: lin, aliases: [lin_rec709]}
  - !<ColorSpace>
    name: ACES2065-1
    to_scene_reference: !<MatrixTransform> {matrix: [2.5, -1.1, -0.4, 0, -0.3, 1.4, -0.1, 0, 0, -0.1, 1.1, 0, 0, 0, 0, 1]}
"""
TINY = """{
    "base": "default", "description": "for tests", "pack": "../in/train_pack", "steps": 4, "pairs": 2, "unpaired": 2,
    "log_every": 1, "validate_every": 2, "data": { "image_size": 32 }, "anchor_fit": { "pairs": 32, "steps": 4 },
    "optimizer": { "rate": 1e-4, "dictionary_rate": 1e-4 }, "mean_teacher": { "start": 0.3 },
    "validation": { "set": { "real_images": 1, "simulated_images": 2 } }
}
"""
