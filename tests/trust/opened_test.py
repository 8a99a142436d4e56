# SPDX-License-Identifier: Apache-2.0
"""What recipes, queries, parameters, configs, plans and tables make a program open, start and connect to, as strace sees
it: what is written in them, the system's libraries and settings, our own installation, and nothing else.
Usage: opened_test.py BUILD SOURCE
"""
import json
import os
import re
import shutil
from pathlib import Path

from checks import BUILD, PHOTO, PLUGINS, REFERENCE, SCRATCH, SOURCE, check, finish, need, run, tool, works

need("strace")
probe = run("strace", "-f", "-e", "trace=execve", "true")
if probe.returncode != 0:
    print("SKIPPED opened_test.py: needs strace that may trace:", probe.stderr.strip()[-200:])
    raise SystemExit

# What every program may look at: the system, and what we install.
SYSTEM = ("/lib", "/lib64", "/usr/lib", "/usr/local/lib", "/usr/share", "/usr/bin", "/bin", "/proc", "/sys", "/dev/null", "/dev/urandom",
          "/etc/ld.so.cache", "/etc/localtime", "/etc/fonts", "/etc/ssl/openssl.cnf")
CALLS = "trace=execve,execveat,open,openat,openat2,creat,socket,connect,bind,unlink,unlinkat,rename,renameat,renameat2,mkdir,chmod"
PROGRAMS = {"srisptool", "srispbatch", "srispbake", "srispdecode", "oiiotool", "iinfo", "srisppack", "python3", "python3.11"}
home = SCRATCH / "user"
for folder in "work", "outside", "tmp", "empty":
    (home / folder).mkdir(parents=True)
work, outside = home / "work", home / "outside"
works("oiiotool", PHOTO, "--resize", "48x32", "--nosoftwareattrib", "-o", work / "photo.jpg")
shutil.copy(REFERENCE, work / "ref.dng")
works(tool("srisptool"), "-q", work / "photo.jpg", "--srisp-unprocess", work / "ref.dng", "--srisp-save-params", work / "look.json",
      "-o", work / "raw.exr")
for name in "secret.dng", "secret.jpg", "secret.json":
    shutil.copy({"secret.dng": REFERENCE, "secret.jpg": work / "photo.jpg", "secret.json": work / "look.json"}[name], outside / name)
os.environ.update(HOME=str(home), TMPDIR=str(home / "tmp"), SECRET=str(outside), OIIO_LIBRARY_PATH=str(PLUGINS))
# Strangers may set traps where a shell, or a wildcard, would look.
(home / "secret.dng").symlink_to(outside / "secret.dng")


def traced(*words, cwd=work):
    log = SCRATCH / "trace"
    done = run("strace", "-f", "-qq", "-s", "4096", "-e", CALLS, "-o", log, *words, cwd=cwd)
    return done, joined(log.read_text(errors="replace") if log.exists() else "")


def joined(trace):
    """Calls that strace tells in two lines, since another thread came between, in one."""
    begun, lines = {}, []
    for line in trace.splitlines():
        process, _, call = line.partition(" ")
        call = call.strip()
        if call.endswith("<unfinished ...>"):
            begun[process] = call[:-len("<unfinished ...>")]
        elif resumed := re.match(r"<\.\.\. \w+ resumed>", call):
            lines.append(begun.pop(process, "") + call[resumed.end():])
        else:
            lines.append(call)
    return "\n".join(lines + list(begun.values()))


def files_of(trace):
    """Files that were opened or made, absolute; those that are not there are left out."""
    files = set()
    for line in trace.splitlines():
        if "ENOENT" in line or "ENOTDIR" in line:
            continue
        if match := re.search(r'\b(?:open|openat|openat2|creat)\((?:AT_FDCWD, |\d+, )?"([^"]*)"', line):
            files.add(os.path.normpath(os.path.join(work, match.group(1))))
    return files


def is_own(file, allowed):
    inside = any(file == str(place) or file.startswith(str(place) + "/") for place in (*SYSTEM, BUILD, SOURCE / "configs"))
    temporary = file.startswith((str(home / "tmp") + "/", "/tmp/#")) or file == str(home / "tmp")
    return inside or temporary or file in allowed or re.search(r"\.[0-9a-f]{8}\.temp\.[a-z]+$|/\.[^/]*\.partial-[0-9a-f]{16}", file)


def judged(what, trace, allowed, listed=()):
    """`allowed`: files that may be opened, in the folder `work` unless absolute; `listed`: folders of which the names are read."""
    allowed = {os.path.normpath(work / name) for name in allowed} | {os.path.normpath(work / name) for name in listed}
    strange = sorted(file for file in files_of(trace) if not is_own(file, allowed))
    check(f"{what} opens nothing else", not strange, ", ".join(strange))
    sockets = [line for line in trace.splitlines() if re.search(r"\b(socket|connect|bind)\(", line)]
    check(f"{what} opens no socket", not sockets, sockets[:3])
    started = {Path(name).name for name in re.findall(r'execve\("([^"]*)".* = 0', trace)}
    check(f"{what} starts none but our programs", started <= PROGRAMS and started, started - PROGRAMS)
    return trace


def made(name, *words, allowed, code=0, says="", listed=()):
    done, trace = traced(*words)
    check(f"{name} ends with {code}", done.returncode == code, f"{done.returncode}: {done.stderr[-600:]}")
    if says:
        check(f"{name} says why", says in done.stderr + done.stdout, f"{says!r} is not in {done.stderr + done.stdout!r}")
    judged(name, trace, allowed, listed)


def recipe(**keys):
    (work / "look.srisp").write_text(json.dumps({"format": "srisp-recipe-1", **keys}))


# What is written, is read.
READ = {"look.srisp", "photo.jpg", "ref.dng", "look.json", "raw.exr"}
recipe(source="photo.jpg", reference="ref.dng")
made("a recipe", "iinfo", "--stats", "look.srisp", allowed={"look.srisp", "photo.jpg", "ref.dng"})
recipe(source="photo.jpg", parameters="look.json")
made("a recipe with parameters", "iinfo", "--stats", "look.srisp", allowed={"look.srisp", "photo.jpg", "look.json"})
made("a query", "iinfo", "--stats", "photo.jpg.srisp?reference=ref.dng", allowed={"photo.jpg", "ref.dng"})
made("srisptool", tool("srisptool"), "-q", "photo.jpg", "--srisp-unprocess:params=look.json", "-", "-o", "out.exr",
     allowed={"photo.jpg", "look.json", "out.exr"}, listed={"."})

# Names mean themselves: no shell, no home, no variable, no address.
NAMES = ["|touch ran", "$(touch ran)", "`touch ran`", "~/secret.dng", "$SECRET/secret.dng", "${SECRET}/secret.dng",
         "%SECRET%/secret.dng", "http://127.0.0.1:9/x.dng", "https://example.org/x.dng", "file:///etc/hostname", "ftp://127.0.0.1/x.dng",
         "tcp://127.0.0.1:9", "ref.dng; touch ran", "-", "@list.txt", "/dev/stdin", "/dev/fd/0", "pipe:0", "concat:a.dng"]
(work / "list.txt").write_text(str(outside / "secret.dng"))
for name in NAMES:
    recipe(source="photo.jpg", reference=[name])
    done, trace = traced("iinfo", "look.srisp")
    check(f"reference {name!r} is refused, with a message", done.returncode != 0 and "reference" in done.stdout + done.stderr,
          f"{done.returncode} {done.stdout} {done.stderr}")
    judged(f"reference {name!r}", trace, {"look.srisp", "photo.jpg", "/dev/stdin", "/dev/fd/0"})
for name in NAMES[:10:3]:
    done, trace = traced("iinfo", f"photo.jpg.srisp?reference={name}")
    check(f"reference {name!r} in a query is refused", done.returncode != 0, done.stdout)
    judged(f"reference {name!r} in a query", trace, {"photo.jpg", "/dev/stdin"})
for name in NAMES[1::3]:
    recipe(source=name.replace(".dng", ".jpg"), reference="ref.dng")
    done, trace = traced("iinfo", "look.srisp")
    check(f"source {name!r} is refused", done.returncode != 0, done.stdout)
    judged(f"source {name!r}", trace, {"look.srisp", "/dev/stdin", "/dev/fd/0"})
check("no name was run", not any(home.rglob("ran")), list(home.rglob("ran")))

# A FIFO and a folder do not stop it; a link is the file that it leads to, since the user put it there.
os.mkfifo(work / "fifo")
for name in "fifo", "empty.dng":
    (work / "empty.dng").mkdir(exist_ok=True)
    for key in "source", "reference", "parameters":
        recipe(**{"source": "photo.jpg", "reference": "ref.dng", key: name})
        done, trace = traced("timeout", "20", "iinfo", "look.srisp")
        check(f"'{key}': {name!r} is refused at once", done.returncode not in (0, 124), done.stdout + done.stderr)

# Parameters name a model and a reference, for information: nothing is opened by that name.
look = json.loads((work / "look.json").read_text())
look["reference"]["name"] = str(outside / "secret.dng")
(work / "named.json").write_text(json.dumps(look))
recipe(source="photo.jpg", parameters="named.json")
made("parameters that name another file", "iinfo", "look.srisp", allowed={"look.srisp", "photo.jpg", "named.json"})
for name in str(outside / "secret.json"), "../outside/secret", "http://127.0.0.1:9/m.safetensors":
    (work / "model.json").write_text(json.dumps({**look, "model": {**look["model"], "name": name}}))
    recipe(source="photo.jpg", parameters="model.json")
    done, trace = traced("iinfo", "look.srisp")
    judged(f"parameters that name the model {name!r}", trace, {"look.srisp", "photo.jpg", "model.json"})

# Metadata that name files are not followed; nor is what a stranger puts beside the image.
works("oiiotool", "photo.jpg", "--attrib", "DocumentName", outside / "secret.jpg", "--attrib", "wrapmodes", "black,black", "--attrib",
      "textureformat", outside / "secret.jpg", "--attrib", "ICCProfile:file", outside / "secret.jpg", "--attrib", "XMP:stRef:filePath",
      outside / "secret.jpg", "-o", "naming.tif", cwd=work)
record = run("iinfo", "-v", "raw.exr", cwd=work).stdout
check("the result has a record", '"reference' in record or "reference" in record)
works("oiiotool", "raw.exr", "--attrib", "unprocess:reference", outside / "secret.dng", "-o", "renamed.exr", cwd=work)
(work / "photo.jpg.xmp").write_text("<x/>")
(work / "photo.xmp").write_text("<x/>")
recipe(source="naming.tif", reference="ref.dng")
made("a photo whose metadata name files", "iinfo", "--stats", "look.srisp", allowed={"look.srisp", "naming.tif", "ref.dng"})
made("a result that names another reference", tool("srisptool"), "-q", "renamed.exr", "--srisp-process", "-o", "back.tif",
     allowed={"renamed.exr", "back.tif"}, listed={"."})

# srispbatch: its tables and manifests.
(work / "refs.csv").write_text("reference,weight\nref.dng,1\n")
(work / "set").mkdir()
shutil.copy(work / "photo.jpg", work / "set" / "a.jpg")
BATCH = {"set/a.jpg", "ref.dng", "refs.csv", "made/a.exr", "made"}
done, trace = traced(tool("srispbatch"), "set", "--reference", "refs.csv", "-o", "made", "--quiet")
check("a batch by a table works", done.returncode == 0, done.stderr)
mine = [file for file in files_of(trace) if file.startswith(str(work / "made") + "/manifest")]
judged("a batch by a table", trace, {*BATCH, *mine}, {"set", "made", "."})
for row in "~/secret.dng", "$SECRET/secret.dng", "|touch ran", "http://127.0.0.1:9/x.dng":
    (work / "refs.csv").write_text(f"reference,weight\n{row},1\n")
    done, trace = traced(tool("srispbatch"), "set", "--reference", "refs.csv", "-o", "none", "--quiet")
    check(f"a table with {row!r} is refused", done.returncode != 0, done.stdout)
    mine = [file for file in files_of(trace) if file.startswith(str(work / "none"))]
    judged(f"a table with {row!r}", trace, {*BATCH, *mine}, {"set", "none", "."})
# A manifest that somebody else wrote names results in its folder, and settings beside itself; others are refused.
manifest = next((work / "made" / "manifest").glob("*.jsonl"))
line = json.loads(manifest.read_text().splitlines()[0])
for stolen in "../../outside/secret.json", str(outside / "secret.json"):
    manifest.write_text(json.dumps({**line, "output": stolen}) + "\n")
    for words in ["--verify", "made"], ["--merge", "made"], ["set", "--reference", "ref.dng", "-o", "made", "--quiet"]:
        done, trace = traced(tool("srispbatch"), *words)
        check(f"{words[0]}: a manifest that lists {stolen!r} is refused, with its line",
              done.returncode == 1 and "line 1: output" in done.stderr, done.stderr)
        mine = [file for file in files_of(trace) if file.startswith(str(work / "made"))]
        judged(f"{words[0]}: a manifest that lists {stolen!r}", trace, [*mine, *BATCH], {"set", "made", "."})
(work / "made" / "manifest" / "settings-").mkdir()
manifest.write_text(json.dumps({**line, "settings": "xxh128:/../../../../outside/secret"}) + "\n")
done, trace = traced(tool("srispbatch"), "--redo", "made/a.exr", "-o", "again.exr")
check("settings elsewhere are refused", done.returncode == 1 and "are no hash" in done.stderr, done.stderr)
mine = [file for file in files_of(trace) if file.startswith(str(work / "made"))]
judged("a manifest that names settings elsewhere", trace, [*mine, *BATCH], {"made", "."})

# OpenColorIO: the config names our bakes by a context variable; the bake is a file of numbers.
works(tool("srispbake"), "--reference", "ref.dng", "-o", "ref.dng", "--lut-size", "9", "-q", cwd=work)
shutil.copy(SOURCE / "configs" / "ocio" / "srisp.ocio", work / "srisp.ocio")
for clf in (SOURCE / "configs" / "ocio").glob("*.clf"):
    shutil.copy(clf, work / clf.name)
neutral = {path.name for path in work.glob("srisp_neutral*")}
os.environ["SRISP_REFERENCE"] = str(work / "ref.dng")
made("an OpenColorIO config", "oiiotool", "--colorconfig", "srisp.ocio", "photo.jpg", "--colorconvert", "srisp photo", "srisp camera RGB", "-o",
     "ocio.exr", allowed={"srisp.ocio", "photo.jpg", "ocio.exr", *neutral, *(f"ref.dng.{kind}.clf" for kind in
                                                                             ("unprocess", "process", "develop"))}, listed={"."})
made("srispbake", tool("srispbake"), "--reference", "ref.dng", "-o", "baked", "--lut-size", "9", "-q",
     allowed={"ref.dng", *(f"baked.{kind}.clf" for kind in ("unprocess", "process", "develop"))}, listed={"."})

# Python.
if (BUILD / "python").is_dir():
    os.environ["PYTHONPATH"] = str(BUILD / "python")
    # What the interpreter opens by itself is its own matter.
    interpreter = files_of(traced("/usr/bin/python3", "-B", "-c", "pass")[1])
    made("the Python package", "/usr/bin/python3", "-B", "-c", "import srisp; srisp.unprocess('photo.jpg', 'ref.dng').save('py.exr')",
         allowed={"photo.jpg", "ref.dng", "py.exr", *interpreter}, listed={"."})

finish()
