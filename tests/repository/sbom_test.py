# SPDX-License-Identifier: Apache-2.0
"""The bill of materials of an installed tree, and the table of what srisp needs. Usage: sbom_test.py BUILD SOURCE"""
import hashlib
import json
import os
import re
import subprocess
import sys
from pathlib import Path

build, source = map(Path, sys.argv[1:3])
prefix = Path(os.environ.get("SRISP_TEST_PREFIX", build / "tests" / "moved prefix"))
passed = failed = 0


def check(sentence, good, detail=""):
    global passed, failed
    passed += bool(good)
    failed += not good
    if not good:
        print(f"FAILED: {sentence}\n    {detail}")


def needed_by(path):
    said = subprocess.run(["readelf", "-d", path], capture_output=True, text=True).stdout
    return set(re.findall(r"\(NEEDED\).*\[(.*?)\.so", said))


# Its form (SPDX 2.3, JSON).
found = list(prefix.rglob("sbom.spdx.json"))
check("there is one list", len(found) == 1, found)
sbom = json.loads(found[0].read_text())
keys = {"spdxVersion", "dataLicense", "SPDXID", "name", "documentNamespace", "creationInfo", "packages", "files", "relationships"}
check("it has what SPDX 2.3 requires", keys <= set(sbom) and sbom["spdxVersion"] == "SPDX-2.3" and sbom["dataLicense"] == "CC0-1.0" and
      sbom["SPDXID"] == "SPDXRef-DOCUMENT", keys - set(sbom))
check("when and by what it was made", re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", sbom["creationInfo"]["created"]) and
      sbom["creationInfo"]["creators"][0].startswith("Tool: "), sbom["creationInfo"])
names = [part["SPDXID"] for part in sbom["packages"] + sbom["files"]] + ["SPDXRef-DOCUMENT"]
check("each part has a name of its own, of letters that SPDX takes", len(names) == len(set(names)) and
      all(re.fullmatch(r"SPDXRef-[A-Za-z0-9.-]+", name) for name in names), names)
wild = [link for link in sbom["relationships"] if not {link["spdxElementId"], link["relatedSpdxElement"]} <= set(names)]
check("relations are between these", not wild, wild)
related = {link["relatedSpdxElement"] for link in sbom["relationships"]}
check("nothing stands alone", set(names) - related == {"SPDXRef-DOCUMENT"}, set(names) - related)
for package in sbom["packages"]:
    check(f"{package['name']} has version, licence and place", package.get("versionInfo") and package.get("licenseDeclared") and
          "downloadLocation" in package and "filesAnalyzed" in package, package)

# The files are those that lie there.
hashes = {file["fileName"]: {sum["algorithm"]: sum["checksumValue"] for sum in file["checksums"]} for file in sbom["files"]}
there = {f"./{path.relative_to(prefix)}" for path in prefix.rglob("*")
         if path.is_file() and not path.is_symlink() and path.parent.name != "__pycache__"}
there -= {f"./{found[0].relative_to(prefix)}"}
check("it lists the files that lie there", there == set(hashes), sorted(there ^ set(hashes))[:10])
wrong = [name for name in there & set(hashes)
         if hashlib.sha256((prefix / name).read_bytes()).hexdigest() != hashes[name]["SHA256"]]
check("with their hashes", not wrong, wrong)
verification = hashlib.sha1("".join(sorted(sums["SHA1"] for sums in hashes.values())).encode()).hexdigest()
check("and one of all", sbom["packages"][0]["packageVerificationCode"]["packageVerificationCodeValue"] == verification)

# All that programs and libraries need is told.
listed = {library for package in sbom["packages"] for library in package.get("comment", "").replace("libraries: ", "").split()}
own = {path.name.split(".so")[0] for path in prefix.rglob("*.so*")}
system = {"libc", "libm", "libgcc_s", "libstdc++", "ld-linux-x86-64", "ld-linux-aarch64", "libpthread", "libdl", "librt"}
binaries = [path for path in prefix.rglob("*") if path.is_file() and path.open("rb").read(4) == b"\x7fELF"]
check("programs and libraries are installed", len(binaries) >= 8, binaries)
for binary in binaries:
    # "libOpenEXR-3_1" is OpenEXR's libOpenEXR.
    missing = {name for name in needed_by(binary) - own - system if re.sub(r"-\d+_\d+$", "", name) not in listed}
    check(f"what {binary.name} needs is listed", not missing, missing)

# The table of docs/contributing.md, CMake, and the list name the same.
text = (source / "docs" / "contributing.md").read_text()
rows = re.findall(r"^\| ([\w. -]+) \| `([\w.-]+)` \| ([\d.]+) \| ([\d.]+|-) \| (.+?) \|$", text, re.MULTILINE)
check("the table of what is needed has rows", len(rows) >= 15, rows)
cmake = "\n".join(path.read_text() for folder in ("lib", "ocio", "plugin", "tools", "configs")
                  for path in [source / "CMakeLists.txt", *(source / folder).rglob("CMakeLists.txt"), *(source / folder).rglob("*.cmake")])
calls = dict(re.findall(r"find_package\((\w+)(?: ([\d.]+))?[ )]", cmake))
calls.update(re.findall(r'"([\w.-]+)>=([\d.]+)"', cmake))
for called in "Threads", "PkgConfig", "srisp":  # CMake's own, and ours in comments
    calls.pop(called, None)
table = {name: least for _, name, least, _, _ in rows}
check("CMake asks for the versions of the table", calls == table,
      {name: (calls.get(name), table.get(name)) for name in set(calls) | set(table) if calls.get(name) != table.get(name)})
versions = {package["name"]: package["versionInfo"] for package in sbom["packages"]}
for name, package, least, tested, _ in rows:
    version = versions.get(name)
    as_numbers = lambda version: [int(part) for part in re.findall(r"\d+", version)]
    check(f"{name} is listed, with a version that is accepted", not version or as_numbers(version) >= as_numbers(least), f"{version} < {least}")
unnamed = set(versions) - {name for name, *_ in rows} - {"srisp"}
check("each package of the list has its reason in the table", not unnamed, unnamed)

print(f"{passed} passed, {failed} failed")
sys.exit(failed > 0)
