# SPDX-License-Identifier: Apache-2.0
"""What outputs pass on of a photo and a reference that say all that can be said of their place, device and owner, and
of the folders of the machine that made them: by every door, in every kind of file. Usage: passed_on_test.py BUILD SOURCE
"""
import json
import os
import shutil
import zlib
from pathlib import Path

from checks import BUILD, PHOTO, PLUGINS, REFERENCE, SCRATCH, check, finish, need, run, tool, works

os.environ["OIIO_LIBRARY_PATH"] = str(PLUGINS)
import OpenImageIO as oiio

need("exiftool")

# Written where exiftool can; each with a word of its own, by which it is found again.
PRIVATE = {
    "EXIF:SerialNumber": "{}-BODYSERIAL", "EXIF:LensSerialNumber": "{}-LENSSERIAL", "EXIF:OwnerName": "{}-OWNER",
    "EXIF:ImageUniqueID": "{}-UNIQUEID", "IFD0:HostComputer": "{}-HOST", "IFD0:CameraSerialNumber": "{}-CAMERASERIAL",
    "XMP-aux:SerialNumber": "{}-XMPSERIAL", "XMP-aux:OwnerName": "{}-XMPOWNER", "XMP-aux:LensSerialNumber": "{}-XMPLENS",
    "XMP-xmpMM:DocumentID": "{}-DOCUMENT", "XMP-xmpMM:HistorySoftwareAgent": "{}-XMPHISTORY",
    "XMP-xmpMM:DerivedFromFilePath": "/home/{}-FOLDER/x.psd", "XMP-mwg-rs:RegionName": "{}-PERSON",
    "XMP-iptcExt:PersonInImage": "{}-SHOWN", "XMP-photoshop:City": "{}-CITY", "XMP-photoshop:Country": "{}-COUNTRY",
    "XMP-iptcCore:Location": "{}-LOCATION", "IPTC:City": "{}-CITY", "IPTC:Sub-location": "{}-PLACE",
    "XMP-iptcExt:LocationCreatedCity": "{}-CREATED",
}
KEPT = {"EXIF:Artist": "KEPT-ARTIST", "EXIF:Copyright": "KEPT-COPYRIGHT", "EXIF:ImageDescription": "KEPT-DESCRIPTION"}
PLACE = {"EXIF:GPSLatitude": "48.1371", "EXIF:GPSLatitudeRef": "N", "EXIF:GPSLongitude": "11.5754",
         "EXIF:GPSLongitudeRef": "E", "EXIF:GPSAltitude": "519", "EXIF:GPSDateStamp": "2024:01:02",
         "XMP-exif:GPSLatitude": "48.1371", "XMP-exif:GPSLongitude": "11.5754"}


def described(path, mark, more=()):
    tags = {name: text.format(mark) for name, text in PRIVATE.items()}
    words = [f"-{name}={value}" for name, value in {**PLACE, **tags}.items()] + list(more)
    done = run("exiftool", "-q", "-q", "-m", "-overwrite_original", *words, path)
    said = run("exiftool", "-a", "-G1", path).stdout
    check(f"{path.name} was given its facts", f"{mark}-BODYSERIAL" in said and "GPS" in said, done.stderr + said)


home = SCRATCH / "MAKERFOLDER"
home.mkdir()
(home / "out").mkdir()
photo, reference = home / "photo.jpg", home / "ref.dng"
shutil.copy(REFERENCE, reference)
works("oiiotool", PHOTO, "--resize", "96x64", "--nosoftwareattrib", "-o", photo)
# A picture beside the photo, as cameras write it, and may show what was cropped away.
thumbnail = SCRATCH / "thumbnail.jpg"
works("oiiotool", "--create", "64x48", 3, "-d", "uint8", "-o", thumbnail)
run("exiftool", "-q", "-overwrite_original", "-comment=PHOTO-THUMBNAIL", thumbnail)
described(photo, "PHOTO", [f"-{name}={value}" for name, value in KEPT.items()] + [f"-ThumbnailImage<={thumbnail}"])
described(reference, "REFERENCE", ["-Artist=REFERENCE-ARTIST", "-Copyright=REFERENCE-COPYRIGHT"])
check("the photo holds a thumbnail", b"PHOTO-THUMBNAIL" in photo.read_bytes())
photos = {"jpeg": photo}
for kind in "tif", "png":
    photos[kind] = home / f"photo.{kind}"
    works("oiiotool", photo, "--nosoftwareattrib", "-o", photos[kind])
    described(photos[kind], "PHOTO", [f"-{name}={value}" for name, value in KEPT.items()])
# Attributes that no file format has a place for, as OpenImageIO's RAW reader and EXR files give them.
photos["exr"] = home / "photo.exr"
works("oiiotool", photo, "--nosoftwareattrib", "--attrib", "Canon:SerialNumber", "PHOTO-CANON", "--attrib", "Exif:MakerNote",
      "PHOTO-MAKERNOTE", "--attrib", "Software", f"oiiotool {home}/x.jpg -o y.jpg", "--attrib", "DocumentName",
      f"{home}/x.jpg", "-d", "half", "-o", photos["exr"])


def unpacked(path):
    """The bytes of a file, and those of PNG's compressed texts."""
    data = path.read_bytes() if path.exists() else b""
    texts, at = [data], 8
    while path.suffix == ".png" and at + 8 <= len(data):
        size, kind = int.from_bytes(data[at:at + 4], "big"), data[at + 4:at + 8]
        chunk = data[at + 8:at + 8 + size]
        if kind in (b"zTXt", b"iTXt") and (start := chunk.find(b"\x78")) >= 0:
            try:
                texts.append(zlib.decompress(chunk[start:]))
            except zlib.error:
                pass  # it is not compressed
        at += 12 + size
    return texts


def texts_of(paths):
    """All that files say: their bytes, as ASCII and UTF-16, and what exiftool and OpenImageIO read of them."""
    said = {path: [] for path in paths}
    for path in paths:
        for data in unpacked(path):
            said[path] += [data.decode("latin1"), data.decode("utf-16-le", "replace"), data[1:].decode("utf-16-le", "replace")]
        image = path.suffix in IMAGES and oiio.ImageInput.open(str(path))
        if image:
            said[path] += [f"{attribute.name}: {attribute.value}" for attribute in image.spec().extra_attribs]
    named = [path for path in paths if path.suffix in IMAGES]
    for tags in json.loads(run("exiftool", "-json", "-a", "-u", "-G1", "-x", "Directory", *named).stdout):
        said[Path(tags.pop("SourceFile"))].append(str(tags))
    return {path: "\n".join(parts) for path, parts in said.items()}


def judge(path, said):
    name = path.relative_to(SCRATCH)
    allowed = ["REFERENCE-ARTIST", "REFERENCE-COPYRIGHT"] if name.name.startswith("camera.") else []
    found = sorted({word for word in WORDS if word in said} - set(allowed))
    check(f"{name} is there, and passes nothing private on", said and not found, f"it holds {', '.join(found)}")
    credit = allowed[:1] or list(KEPT.values())  # OpenImageIO reads no copyright of RAW files
    if path.suffix in CREDITED:
        missing = [word for word in credit if word not in said]
        check(f"{name} keeps who made the photo, and what it shows", not missing, f"it lacks {', '.join(missing)}")


IMAGES = {".exr", ".tif", ".png", ".jpg", ".dng", ".webp", ".dpx", ".jp2"}
CREDITED = {".exr", ".tif", ".png", ".jpg", ".dng"}
WORDS = [text.format(mark).split("/")[-2 if "/" in text else -1]
         for text in PRIVATE.values() for mark in ("PHOTO", "REFERENCE")]
WORDS += ["REFERENCE-ARTIST", "REFERENCE-COPYRIGHT", "PHOTO-THUMBNAIL", "PHOTO-CANON", "PHOTO-MAKERNOTE", "MAKERFOLDER",
          "GPS Latitude", "GPS:Latitude", "GPSLatitude", "GPSDate", "GPS:Date", "48.1371", "11.5754"]

# srisptool: every kind of file, from absolute names. (OpenImageIO's writer of DPX writes the output's name as it is given.)
out = home / "out"
for kind in "exr", "tif", "png", "jpg", "dng", "webp", "dpx", "jp2":
    works(tool("srisptool"), "-q", photo, "--srisp-unprocess", reference, "-d", "uint8" if kind in ("jpg", "webp") else
          "uint16" if kind != "exr" else "half", "-o", f"tool.{kind}" if kind == "dpx" else out / f"tool.{kind}", cwd=out)
for kind, name in photos.items():
    works(tool("srisptool"), "-q", name, "--srisp-unprocess", reference, "-d", "half", "-o", out / f"of_{kind}.exr")
# Of a mosaic, after a command of oiiotool's, developed, and the way back.
lines = {
    "mosaic.dng": [photo, "--srisp-unprocess", reference, "--srisp-mosaic", "--srisp-noise", "shot=1e-4,read=1e-6"],
    "mosaic.tif": [photo, "--srisp-unprocess", reference, "--srisp-mosaic"],
    "resized.exr": [photo, "--resize", "50%", "--srisp-unprocess", reference],
    "plate.exr": [photo, "--srisp-unprocess", reference, "--srisp-develop", "ACEScg"],
    "later.exr": [out / "tool.exr", "--srisp-develop", "ACEScg"],
    "camera.exr": [reference, "--srisp-develop", "ACEScg"],
    "camera.tif": [reference, "--srisp-develop", "ACEScg"],
    "back.jpg": [out / "tool.exr", "--srisp-process", "-d", "uint8"],
    "back.png": [out / "tool.exr", "--srisp-process", "-d", "uint8"],
    "replay.exr": [photo, f"--srisp-unprocess:params={out}/look.json", "-"],
}
works(tool("srisptool"), "-q", photo, "--srisp-unprocess", reference, "--srisp-save-params", out / "look.json", "-o",
      out / "with_look.exr")
for name, line in lines.items():
    works(tool("srisptool"), "-q", *line, "-o", out / name)
history = run("iinfo", "-v", out / "replay.exr").stdout
check("the history names files, not their folders",
      "srisptool -q photo.jpg --srisp-unprocess:params=look.json - -o replay.exr" in history, history)
works(tool("srisptool"), "-q", "photo.jpg", "--srisp-unprocess", "./ref.dng", "-o", "out/relative.exr", cwd=home)
check("relative names stay as they were typed",
      "--srisp-unprocess ./ref.dng -o out/relative.exr" in run("iinfo", "-v", out / "relative.exr").stdout)
works(tool("srisptool"), "-q", photo, "--srisp-unprocess", reference, "--attrib", "Exif:BodySerialNumber", "ASKED-FOR", "-o",
      out / "asked.exr")
check("what the user sets afterwards is kept", b"ASKED-FOR" in (out / "asked.exr").read_bytes())

# Stock oiiotool, by a query and by a recipe. (--nosoftwareattrib: its own history is its own matter.)
(home / "look.srisp").write_text(json.dumps(
    {"format": "srisp-recipe-1", "source": str(photo), "reference": str(reference)}))
for name, source in {"query": f"{photo}.srisp?reference={reference}", "recipe": home / "look.srisp"}.items():
    for kind in "exr", "tif", "dng":
        works("oiiotool", "--nosoftwareattrib", source, "-d", "uint16" if kind != "exr" else "half", "-o",
              out / f"{name}.{kind}", OIIO_LIBRARY_PATH=str(PLUGINS))

# srispbatch with relative names; its manifest has them as they were given.
(home / "set").mkdir()
shutil.copy(photo, home / "set" / "a.jpg")
for kind in "exr", "tif", "dng", "png", "npy":
    works(tool("srispbatch"), "set", "--reference", "ref.dng", "-o", f"out/batch_{kind}", "--format", kind, cwd=home)
    works(tool("srispbatch"), "--redo", f"out/batch_{kind}/a.{kind}", "-o", f"out/redone.{kind}", cwd=home)
    check(f"a relative manifest makes a.{kind} again", (out / f"redone.{kind}").read_bytes() ==
          (out / f"batch_{kind}" / f"a.{kind}").read_bytes())

# srispbake, packs and evaluations.
works(tool("srispbake"), "--reference", reference, "-o", out / "bake", "--lut-size", "9", "--cube", "-q")
works(tool("srisppack"), home / "set", reference, "-o", out / "pack", "--size", "64", "--crops", "1")
works(tool("srispeval"), "half-split", reference, "--size", "64", "-q", "--model", "default", "--rendering", "fixed", "--report",
      out / "report.html", "--json", out / "scores.json", "--csv", out / "scores.csv")

# Python.
if (BUILD / "python").is_dir():
    program = """if True:
        import sys, srisp
        photo, reference, out = sys.argv[1:]
        raw = srisp.unprocess(photo, reference)
        raw.save(f"{out}/python.exr")
        raw.save(f"{out}/python.tif")
        raw.save(f"{out}/python.dpx")
        srisp.write_dng(f"{out}/python.dng", srisp.mosaic(raw))
        srisp.develop(raw, "ACEScg").save(f"{out}/python_plate.exr")
    """
    works("/usr/bin/python3", "-c", program, photo, reference, out, PYTHONPATH=str(BUILD / "python"))

# All that was made.
for path, said in texts_of([path for path in sorted(out.rglob("*")) if path.is_file()]).items():
    judge(path, said)
finish()
