# SPDX-License-Identifier: Apache-2.0
"""Photos of every container and colour description, on every way in, against an independent reading (Pillow with
Little CMS, and matrices of this file's own): they must give the result that the right picture gives.

Usage: photos_test.py BUILD SOURCE SHARED
"""
import json
import os
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

build, source, shared = (Path(argument).resolve() for argument in sys.argv[1:4])
plugin = next((build / "lib").rglob("srisp.imageio.so"))
os.environ["OIIO_LIBRARY_PATH"] = str(plugin.parent)

import numpy as np
import OpenImageIO as oiio

try:
    from PIL import Image, ImageCms
except ImportError:
    print("SKIPPED photos_test.py: needs python3-pil")
    sys.exit(0)

TOOL = str(build / "bin" / "srisptool")
REFERENCE = str(source / "configs" / "sample" / "reference.dng")
P3 = np.array([[0.680, 0.320], [0.265, 0.690], [0.150, 0.060]])
ADOBE = np.array([[0.64, 0.33], [0.21, 0.71], [0.15, 0.06]])
REC2020 = np.array([[0.708, 0.292], [0.170, 0.797], [0.131, 0.046]])
SRGB = np.array([[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]])
D65 = np.array([0.3127, 0.3290])

failures = 0
checks = 0


def check(what, good, detail=""):
    global failures, checks
    checks += 1
    if not good:
        failures += 1
        print(f"FAILED {what}: {detail}", flush=True)


# -- pictures ----------------------------------------------------------------------------------------------------------


def to_linear(v):
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)


def from_linear(v):
    v = np.clip(v, 0, 1)
    return np.where(v <= 0.0031308, 12.92 * v, 1.055 * v ** (1 / 2.4) - 0.055)


def rgb_to_xyz(primaries):
    columns = np.stack([primaries[:, 0], primaries[:, 1], 1 - primaries.sum(1)])
    white = np.array([D65[0], D65[1], 1 - D65.sum()]) / D65[1]
    return columns * np.linalg.solve(columns, white)


def from_srgb(linear, primaries):
    return linear @ (np.linalg.inv(rgb_to_xyz(primaries)) @ rgb_to_xyz(SRGB)).T


def calm_picture():
    """96 x 64, display-encoded sRGB as float64, of colours that also other spaces hold."""
    image = Image.open(source / "configs" / "sample" / "photo.jpg").convert("RGB").resize((96, 64), Image.BOX)
    return 0.03 + 0.94 * np.asarray(image, np.float64) / 255


def bytes8(picture):
    return np.rint(np.clip(picture, 0, 1) * 255).astype(np.uint8)


def matrix_profile(primaries, gamma):
    """An ICC profile, version 2, written by hand: D50-adapted colorants and one exponent."""
    bradford = np.array([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]])
    d50 = np.array([0.9642, 1.0, 0.8249])
    d65 = np.array([D65[0], D65[1], 1 - D65.sum()]) / D65[1]
    adapt = np.linalg.inv(bradford) @ np.diag((bradford @ d50) / (bradford @ d65)) @ bradford
    colorants = adapt @ rgb_to_xyz(primaries)

    def fixed(values):
        return b"".join(struct.pack(">i", round(v * 65536)) for v in values)

    curve = b"curv" + bytes(4) + struct.pack(">IH", 1, round(gamma * 256)) + bytes(2)
    text = b"made for a test\0"
    tags = [
        (b"desc", b"desc" + bytes(4) + struct.pack(">I", len(text)) + text + bytes(78)),
        (b"wtpt", b"XYZ " + bytes(4) + fixed(d50)),
        (b"rXYZ", b"XYZ " + bytes(4) + fixed(colorants[:, 0])),
        (b"gXYZ", b"XYZ " + bytes(4) + fixed(colorants[:, 1])),
        (b"bXYZ", b"XYZ " + bytes(4) + fixed(colorants[:, 2])),
        (b"rTRC", curve), (b"gTRC", curve), (b"bTRC", curve),
    ]
    table, data = struct.pack(">I", len(tags)), b""
    start = 128 + 4 + 12 * len(tags)
    for name, content in tags:
        content += bytes(-len(content) % 4)
        table += name + struct.pack(">II", start + len(data), len(content))
        data += content
    size = start + len(data)
    head = struct.pack(">I4sI4s4s4s", size, bytes(4), 0x02400000, b"mntr", b"RGB ", b"XYZ ")
    head += struct.pack(">6H4s", 2026, 1, 1, 0, 0, 0, b"acsp") + bytes(28) + fixed(d50)
    return head.ljust(128, b"\0") + table + data


def png_chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def write_png(path, values, *chunks):
    """8 or 16 bits RGB, with these chunks and no others."""
    height, width, _ = values.shape
    depth = values.dtype.itemsize * 8
    rows = b"".join(b"\0" + row.astype(values.dtype.newbyteorder(">")).tobytes() for row in values)
    header = struct.pack(">IIBBBBB", width, height, depth, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + png_chunk(b"IHDR", header) + b"".join(chunks) +
                     png_chunk(b"IDAT", zlib.compress(rows)) + png_chunk(b"IEND", b""))


def gama(gamma):
    return png_chunk(b"gAMA", struct.pack(">I", round(100000 / gamma)))


def chrm(primaries):
    numbers = [*D65, *primaries.ravel()]
    return png_chunk(b"cHRM", struct.pack(">8I", *[round(v * 100000) for v in numbers]))


def write_oiio(path, values, kind, **attributes):
    spec = oiio.ImageSpec(values.shape[1], values.shape[0], values.shape[2], kind)
    for name, value in attributes.items():
        spec.attribute(name.replace("__", ":"), value)
    output = oiio.ImageOutput.create(str(path))
    if not output or not output.open(str(path), spec):
        raise RuntimeError(f"{path}: {oiio.geterror()}")
    output.write_image(np.ascontiguousarray(values, np.float32))
    output.close()


def write_psd(path, values):
    """Merged picture alone, and a section of layers that holds an empty one (as adjustment layers are)."""
    height, width, _ = values.shape
    record = struct.pack(">4i", 0, 0, 0, 0) + struct.pack(">H", 0) + b"8BIMnorm" + bytes([255, 0, 0, 0])
    record += struct.pack(">I", 12) + bytes(8) + b"\x03abc"
    layers = struct.pack(">h", 1) + record
    layers += bytes(-len(layers) % 2)
    section = struct.pack(">I", len(layers)) + layers + struct.pack(">I", 0)
    path.write_bytes(b"8BPS" + struct.pack(">H6xHIIHH", 1, 3, height, width, 8, 3) + struct.pack(">II", 0, 0) +
                     struct.pack(">I", len(section)) + section + struct.pack(">H", 0) +
                     np.moveaxis(values, 2, 0).tobytes())


def turn(values, orientation):
    """How the pixels of an upright picture are stored under an EXIF orientation."""
    stored = {1: lambda v: v, 3: lambda v: v[::-1, ::-1], 6: lambda v: np.rot90(v), 8: lambda v: np.rot90(v, -1)}
    return np.ascontiguousarray(stored[orientation](values))


# -- the table ---------------------------------------------------------------------------------------------------------


def made_files(folder, upright):
    """(path, largest mean difference in steps of 1/255) for each container and colour description."""
    linear = to_linear(upright)
    p3, adobe, wide = (from_srgb(linear, primaries) for primaries in (P3, ADOBE, REC2020))
    p3_profile, adobe_profile = matrix_profile(P3, 2.2), matrix_profile(ADOBE, 563 / 256)
    p3_bytes, adobe_bytes = bytes8(np.clip(p3, 0, 1) ** (1 / 2.2)), bytes8(np.clip(adobe, 0, 1) ** (256 / 563))
    plain = bytes8(upright)
    lossless, jpeg = 0.4, 2.0
    files = []

    def add(name, limit, write):
        path = folder / name
        write(path)
        files.append((path, limit))

    for ending in ("bmp", "dpx", "ppm", "sgi", "tga", "tif", "png"):
        add(f"plain.{ending}", lossless, lambda path: write_oiio(path, plain / 255.0, "uint8"))
    add("plain_16.tif", lossless, lambda path: write_oiio(path, upright, "uint16"))
    add("plain.psd", lossless, lambda path: write_psd(path, plain))
    add("linear.tif", lossless, lambda path: write_oiio(path, linear, "float"))
    for name, profile, values in (("p3", p3_profile, p3_bytes), ("adobe", adobe_profile, adobe_bytes)):
        image = Image.fromarray(values)
        for ending, limit, options in (("jpg", jpeg, {"quality": 98, "subsampling": 0}), ("png", lossless, {}),
                                       ("tif", lossless, {}), ("webp", lossless, {"lossless": True})):
            add(f"{name}.{ending}", limit, lambda path: image.save(path, icc_profile=profile, **options))
    add("iccp_beside_gama.png", lossless, lambda path: write_png(
        path, p3_bytes, png_chunk(b"iCCP", b"p3\0\0" + zlib.compress(p3_profile)), gama(1.0), chrm(ADOBE)))
    add("srgb_beside_gama.png", lossless,
        lambda path: write_png(path, plain, png_chunk(b"sRGB", b"\0"), gama(1.8), chrm(ADOBE)))
    for gamma in (1.4, 1.8, 2.6):
        add(f"gama_{gamma}.png", lossless, lambda path: write_png(path, bytes8(linear ** (1 / gamma)), gama(gamma)))
    add("gama_1.png", 1.0, lambda path: write_png(path, np.rint(linear * 65535).astype(np.uint16), gama(1.0)))
    add("gama_chrm.png", lossless,
        lambda path: write_png(path, bytes8(np.clip(adobe, 0, 1) ** (1 / 2.2)), gama(2.2), chrm(ADOBE)))
    add("cicp_p3.png", lossless,
        lambda path: write_png(path, bytes8(from_linear(p3)), png_chunk(b"cICP", bytes([12, 13, 0, 1])), gama(1.8)))
    add("plain.exr", lossless, lambda path: write_oiio(path, linear, "half"))
    add("rec2020.exr", lossless, lambda path: write_oiio(path, wide, "half"))
    with_chromaticities(files[-1][0], wide)
    alpha = np.linspace(0.3, 1, 96)[None, :, None] * np.ones((64, 1, 1))
    straight = bytes8(np.concatenate([upright, alpha], 2))
    for ending in ("png", "tif", "webp", "jp2", "tga"):
        options = {"webp": {"lossless": True, "exact": True}, "jp2": {"irreversible": False}}.get(ending, {})
        add(f"alpha.{ending}", 0.5, lambda path: Image.fromarray(straight).save(path, **options))
    for tool, name, limit in ((["heif-enc", "-q", "95", "-p", "chroma=444"], "p3.heic", jpeg),
                              (["heif-enc", "-A", "-q", "95", "-p", "chroma=444"], "p3.avif", jpeg)):
        try:
            ran = subprocess.run([*tool, folder / "p3.png", "-o", folder / name], capture_output=True).returncode == 0
        except FileNotFoundError:
            ran = False
        if ran:
            files.append((folder / name, limit))
        else:
            print(f"SKIPPED {name}: needs heif-enc (libheif-examples)")
    return files


def with_chromaticities(path, values):
    spec = oiio.ImageSpec(values.shape[1], values.shape[0], 3, "half")
    spec.attribute("chromaticities", oiio.TypeDesc("float[8]"), [*REC2020.ravel().tolist(), *D65.tolist()])
    output = oiio.ImageOutput.create(str(path))
    output.open(str(path), spec)
    output.write_image(np.ascontiguousarray(values, np.float32))
    output.close()


def run(*words):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, errors="replace")


def pixels_of(name):
    """Height x width x channels, straight; None: cannot be read."""
    image = oiio.ImageInput.open(str(name))
    if not image:
        return None
    pixels = image.read_image("float")
    image.close()
    if pixels is not None and pixels.shape[2] == 4:
        pixels = pixels.copy()
        pixels[..., :3] /= np.maximum(pixels[..., 3:], 1e-6)
    return pixels


def difference(pixels, right):
    """Mean at gamma 2.2 in steps of 1/255, where alpha is more than 0.1."""
    if pixels is None or pixels.shape[:2] != right.shape[:2]:
        return float("inf")
    seen = pixels[..., 3] > 0.1 if pixels.shape[2] == 4 else np.ones(pixels.shape[:2], bool)
    values = [np.clip(each[..., :3][seen], 0, 1) ** (1 / 2.2) for each in (pixels, right)]
    return float(np.abs(values[0] - values[1]).mean() * 255) if seen.any() else 0.0


def by_tool(path, look, *commands):
    out = path.parent / "out.exr"
    out.unlink(missing_ok=True)
    run(TOOL, path, *commands, f"--srisp-unprocess:params={look}", "-", "-d", "float", "-o", out)
    return pixels_of(out) if out.exists() else None


def by_frames(path, look):
    folder = path.parent / f"frames_{path.name}"
    folder.mkdir()
    for frame in (1, 2):
        (folder / f"f.{frame:04d}{path.suffix}").write_bytes(path.read_bytes())
    run(TOOL, "--frames", "1-2", folder / f"f.#{path.suffix}", f"--srisp-unprocess:params={look}", "-", "-d", "float",
        "-o", folder / "out.#.exr")
    out = folder / "out.0002.exr"
    return pixels_of(out) if out.exists() else None


def by_recipe(path, look):
    recipe = path.parent / f"{path.name}.recipe.srisp"
    recipe.write_text(json.dumps({"format": "srisp-recipe-1", "source": str(path), "parameters": str(look)}))
    return pixels_of(recipe)


def by_image_buf(path, look):
    image = oiio.ImageBuf(f"{path}.srisp?params={look}")
    pixels = image.get_pixels(oiio.FLOAT)
    if pixels is not None and pixels.shape[2] == 4:
        pixels[..., :3] /= np.maximum(pixels[..., 3:], 1e-6)
    return pixels


WAYS = {
    "direct": lambda path, look: by_tool(path, look),
    "-i": lambda path, look: by_tool(path, look, "--addc", "0"),
    "after --crop": lambda path, look: by_tool(path, look, "--crop", "96x64+0+0"),
    "--frames": by_frames,
    "query": lambda path, look: pixels_of(f"{path}.srisp?params={look}"),
    "recipe": by_recipe,
    "ImageBuf": by_image_buf,
}


def printed_gain(path):
    printed = run(TOOL, path, "--srisp-params", REFERENCE).stdout
    return json.loads(printed)["gain"] if printed else 0.0


def check_table(folder):
    upright = calm_picture()
    right = folder / "right.png"
    write_png(right, np.rint(upright * 65535).astype(np.uint16), png_chunk(b"sRGB", b"\0"))
    look = folder / "look.json"
    look.write_text(run(TOOL, right, "--srisp-params", REFERENCE).stdout)
    expected = by_tool(right, look)
    gain = printed_gain(right)
    seen_containers = set()  # the slower ways in are tried with one file of each
    for path, limit in made_files(folder, upright):
        for way, read in WAYS.items():
            if way in ("after --crop", "--frames") and path.suffix in seen_containers:
                continue
            found = difference(read(path, look), expected)
            check(f"{path.name}, {way}", found <= limit, f"differs by {found:.2f}, at most {limit} is right")
        if path.suffix in seen_containers:
            continue
        seen_containers.add(path.suffix)
        check(f"{path.name}, --srisp-params", abs(printed_gain(path) / gain - 1) < 0.02,
              f"gain {printed_gain(path)}, right is {gain}")
        baked = run(build / "bin" / "srispbake", "--reference", REFERENCE, "--source", path, "-o", folder / "bake.clf",
                    "--lut-size", "17")
        check(f"{path.name}, srispbake", baked.returncode == 0, baked.stderr)


def check_orientations(folder):
    upright = bytes8(calm_picture())
    gain = None
    for orientation in (1, 3, 6, 8):
        exif = Image.Exif()
        exif[0x112] = orientation
        stored = Image.fromarray(turn(upright, orientation))
        for ending in ("jpg", "png", "tif", "webp"):
            path = folder / f"turned_{orientation}.{ending}"
            options = {"webp": {"lossless": True}, "jpg": {"quality": 98, "subsampling": 0}}.get(ending, {})
            stored.save(path, exif=exif.tobytes() if ending != "tif" else exif, **options)
            for commands in ((), ("--addc", "0")):
                out = folder / "turned.exr"
                run(TOOL, path, *commands, "--srisp-unprocess", REFERENCE, "-o", out)
                found = oiio.ImageInput.open(str(out)).spec().get_int_attribute("Orientation", 1)
                check(f"{path.name} {commands} keeps its orientation", found == orientation, f"has {found}")
            gain = gain or printed_gain(path)
            check(f"{path.name} chooses upright", abs(printed_gain(path) / gain - 1) < 0.01,
                  f"gain {printed_gain(path)}, upright {gain}")


def check_cut(folder, look):
    """A file that breaks off is refused on every way in, and nothing is written."""
    for name in ("plain.png", "p3.jpg", "p3.webp", "plain_16.tif", "plain.exr", "p3.heic", "p3.avif", "alpha.jp2"):
        whole = folder / name
        if not whole.exists():
            continue
        cut = folder / f"cut{whole.suffix}"
        cut.write_bytes(whole.read_bytes()[: whole.stat().st_size * 6 // 10])
        for commands in ((), ("--addc", "0")):
            check(f"{cut.name} {commands} is refused", by_tool(cut, look, *commands) is None)
        baked = run(build / "bin" / "srispbake", "--reference", REFERENCE, "--source", cut, "-o", folder / "cut.clf")
        check(f"{cut.name}, srispbake refuses it", baked.returncode == 1 and not (folder / "cut.clf").exists())


def enlarged(values, height, width):
    """Bilinear, pixel centres on each other, edges repeated."""
    for axis, size in ((0, height), (1, width)):
        count = values.shape[axis]
        at = np.clip((np.arange(size) + 0.5) * count / size - 0.5, 0, count - 1)
        low = np.floor(at).astype(int)
        weight = (at - low).reshape([-1 if i == axis else 1 for i in range(values.ndim)])
        high = np.minimum(low + 1, count - 1)
        values = np.take(values, low, axis) * (1 - weight) + np.take(values, high, axis) * weight
    return values


def check_gain_map(folder, look):
    """gainmap=apply against the formula of Ultra HDR 1, with the sample's map (2 stops, offsets of 1/64)."""
    path = folder / "hdr.jpg"
    run(build / "bin" / "ultra_hdr_sample", path)
    whole = path.read_bytes()
    (folder / "map.jpg").write_bytes(whole[whole.rfind(b"\xff\xd8\xff"):])
    photo = np.asarray(Image.open(path).convert("RGB"), np.float64) / 255
    gain = enlarged(np.asarray(Image.open(folder / "map.jpg").convert("L"), np.float64) / 255, *photo.shape[:2])
    light = (to_linear(photo) + 1 / 64) * 4 ** gain[..., None] - 1 / 64
    headroom = np.maximum(light.max(2, keepdims=True), 1)
    base = folder / "headroom.png"
    write_png(base, np.rint(from_linear(light / headroom) * 65535).astype(np.uint16), png_chunk(b"sRGB", b"\0"))
    expected = by_tool(base, look) * headroom
    found = pixels_of(f"{path}.srisp?params={look}&gainmap=apply")
    check("gainmap=apply exceeds 1", found.max() > 1.5, f"largest {found.max()}")
    # Decoders of JPEG differ by one step.
    check("gainmap=apply", np.abs(found - expected).mean() < 0.004, f"differs by {np.abs(found - expected).mean()}")
    refused = run(TOOL, path, "--addc", "0", f"--srisp-unprocess:params={look}:gainmap=apply", "-", "-o", folder / "no.exr")
    check("gainmap=apply after a command is refused", refused.returncode == 1 and "gainmap=apply" in refused.stderr)
    told = run(TOOL, path, f"--srisp-unprocess:params={look}", "-", "-o", folder / "sdr.exr").stderr
    check("a gain map that is not applied is told of", "holds a gain map (Ultra HDR)" in told, told)
    check("the SDR rendition stays within 1", pixels_of(folder / "sdr.exr").max() <= 1)


# -- varied photos -----------------------------------------------------------------------------------------------------


def varied_files(folder):
    """Photos of the shared data, each made another kind of file, and pictures that this machine's packages brought."""
    photos = sorted((shared / "data" / "photos").glob("*.jpg"))
    if not photos:
        print(f"SKIPPED photos of {shared}/data/photos: not there")
    profiles = {"p3": matrix_profile(P3, 2.2), "adobe": matrix_profile(ADOBE, 563 / 256)}
    kinds = [
        ("jpg", {"quality": 90}, "RGB", None), ("jpg", {"quality": 85, "progressive": True}, "RGB", "p3"),
        ("jpg", {"quality": 90}, "L", None), ("png", {}, "RGB", "adobe"), ("png", {}, "P", None), ("png", {}, "L", None),
        ("tif", {"compression": "tiff_lzw"}, "RGB", "p3"), ("webp", {"quality": 90}, "RGB", "adobe"),
        ("bmp", {}, "RGB", None), ("tga", {}, "RGB", None), ("gif", {}, "P", None), ("png", {}, "1", None),
    ]
    for i, photo in enumerate(photos[:: max(1, len(photos) // 160)][:160]):
        ending, options, mode, profile = kinds[i % len(kinds)]
        path = folder / f"varied_{i}.{ending}"
        kept = {"icc_profile": profiles[profile]} if profile else {}
        Image.open(photo).convert("RGB").convert(mode).save(path, **options, **kept)
        yield path
    found = []
    for ending in ("png", "jpg", "gif", "webp", "tif", "bmp"):
        found += sorted(Path("/usr/share").rglob(f"*.{ending}"))[::7]
    yield from [path for path in found if 200 < path.stat().st_size < 2_000_000][:: max(1, len(found) // 60)][:60]


def independent_reading(path, out):
    """Writes what Pillow and Little CMS read: 8-bit sRGB, straight; False: they do not read it."""
    try:
        image = Image.open(path)
        image.load()
    except Exception:
        return False
    profile = image.info.get("icc_profile")
    if min(image.size) < 8 or max(image.size) > 4000 or getattr(image, "n_frames", 1) > 1 or image.mode in ("CMYK", "I;16", "I"):
        return False
    if "gamma" in image.info and "srgb" not in image.info and abs(image.info["gamma"] - 0.45455) > 0.002:
        return False  # Pillow does not apply it
    mode = "RGBA" if "A" in image.mode or "transparency" in image.info else "RGB"
    if profile and image.mode in ("RGB", "RGBA"):
        import io
        rgb = ImageCms.profileToProfile(image.convert("RGB"), ImageCms.ImageCmsProfile(io.BytesIO(profile)),
                                        ImageCms.createProfile("sRGB"), renderingIntent=1)
        image = Image.merge("RGBA", (*rgb.split(), image.getchannel("A"))) if mode == "RGBA" else rgb
    elif profile:
        return False
    image.convert(mode).save(out)
    return True


def check_varied(folder, look):
    read = 0
    for path in varied_files(folder):
        right = folder / "independent.png"
        right.unlink(missing_ok=True)
        if not independent_reading(path, right):
            continue
        right_name = folder / f"independent_{read}.png"  # OpenImageIO keeps files by name
        right.rename(right_name)
        read += 1
        ours, expected = (pixels_of(f"{each}.srisp?params={look}") for each in (path, right_name))
        if ours is None or expected is None:
            check(str(path), False, oiio.geterror())
            continue
        found = difference(ours, expected)
        # Pillow and OpenImageIO turn JPEG's and WebP's YCbCr to RGB by decoders of their own.
        limit = 1.0 if path.suffix in (".jpg", ".webp") else 0.6
        check(str(path), found <= limit, f"differs by {found:.2f}, at most {limit} is right")
    print(f"{read} varied photos read")


with tempfile.TemporaryDirectory() as name:
    scratch = Path(name)
    check_table(scratch)
    check_orientations(scratch)
    check_cut(scratch, scratch / "look.json")
    check_gain_map(scratch, scratch / "look.json")
    check_varied(scratch, scratch / "look.json")
print(f"{checks - failures} passed, {failures} failed")
sys.exit(1 if failures else 0)
