# SPDX-License-Identifier: Apache-2.0
"""Files of some 100 kB that claim 60,000 x 60,000 pixels, or as much of something else."""
import binascii
import struct
import zlib

import numpy
import OpenImageIO as oiio

ROOM = 100_000  # bytes of a file
ZEROS = zlib.compress(bytes(ROOM * 1000), 9)  # 100 MB in 100 kB


def _chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", binascii.crc32(kind + data))


def png(*chunks, side=60000, depth=8, color=2, interlaced=0, data=ZEROS):
    head = struct.pack(">IIBBBBB", side, side, depth, color, 0, 0, interlaced)
    return b"\x89PNG\r\n\x1a\n" + _chunk(b"IHDR", head) + b"".join(_chunk(*c) for c in chunks) \
        + _chunk(b"IDAT", data) + _chunk(b"IEND", b"")


def jpeg(frame, side=60000, channels=3):
    """`frame`: 0xc0 baseline, 0xc2 progressive, 0xc9 and 0xca the same with arithmetic coding."""
    tables = b"" if frame > 0xc8 else b"".join(  # one code of one bit in each
        b"\xff\xc4" + struct.pack(">HB", 20, kind) + b"\1" + bytes(16) for kind in (0x00, 0x10))
    scan = b"".join(bytes([i + 1, 0]) for i in range(channels)) + (b"\0\0\0" if frame & 2 else b"\0\x3f\0")
    return b"\xff\xd8\xff\xdb" + struct.pack(">HB", 67, 0) + b"\1" * 64 + tables \
        + b"\xff" + bytes([frame]) + struct.pack(">HBHHB", 8 + 3 * channels, 8, side, side, channels) \
        + b"".join(bytes([i + 1, 0x11, 0]) for i in range(channels)) \
        + b"\xff\xda" + struct.pack(">HB", 6 + 2 * channels, channels) + scan + bytes(ROOM)


def small(name, folder, side=64, **attributes):
    """A small picture of the name's format, as bytes."""
    spec = oiio.ImageSpec(side, side, 3, attributes.pop("type", "uint8"))
    for key, value in attributes.items():
        spec.attribute(key, value)
    if attributes.get("tile"):
        spec.tile_width = spec.tile_height = attributes["tile"]
    path = str(folder / name)
    out = oiio.ImageOutput.create(path)
    if not out or not out.open(path, spec) or not out.write_image(numpy.full((side, side, 3), 0.5, "float32")):
        raise RuntimeError(out.geterror() if out else oiio.geterror())
    out.close()
    return open(path, "rb").read()


def tiff_tags(data, values):
    """Replaces tags of a little-endian TIFF's first directory: each counts as one LONG."""
    data = bytearray(data)
    at = struct.unpack_from("<I", data, 4)[0]
    for i in range(struct.unpack_from("<H", data, at)[0]):
        entry = at + 2 + 12 * i
        tag = struct.unpack_from("<H", data, entry)[0]
        if tag in values:
            struct.pack_into("<HII", data, entry + 2, 4, 1, values[tag])
    return bytes(data) + bytes(ROOM)


def dng(data, side):
    """Replaces width and height in the folder of a DNG that holds the mosaic."""
    data, (at,) = bytearray(data), struct.unpack_from("<I", data, 4)
    folders = [at]
    while folders:
        at = folders.pop()
        entries = [struct.unpack_from("<HHII", data, at + 2 + 12 * i) + (at + 2 + 12 * i,)
                   for i in range(struct.unpack_from("<H", data, at)[0])]
        for tag, _, count, value, entry in entries:
            if tag == 330:
                folders += [value] if count == 1 else struct.unpack_from(f"<{count}I", data, value)
        if any(tag == 262 and value & 0xffff == 32803 for tag, _, _, value, _ in entries):
            for tag, _, _, _, entry in entries:
                if tag in (256, 257):
                    struct.pack_into("<HII", data, entry + 2, 4, 1, side)
    return bytes(data)


def exr(data, side=60000, name=b"dataWindow"):
    mark = name + b"\0box2i\0" + struct.pack("<I", 16)
    at = data.index(mark) + len(mark)
    window = struct.pack("<4i", 0, 0, side - 1, side - 1)
    return data[:at] + window + data[at + 16:] + bytes(ROOM)


def exr_text(data, length):
    """An attribute of text before the first one."""
    return data[:8] + b"claims\0string\0" + struct.pack("<i", length) + bytes(ROOM) + data[8:]


def heif(data, side):
    at = data.index(b"ispe") + 8
    return data[:at] + struct.pack(">II", side, side) + data[at + 8:] + bytes(ROOM)


def webp(side):
    """An extended file of one lossless picture of a single colour."""
    def riff(kind, data):
        return kind + struct.pack("<I", len(data)) + data + bytes(len(data) % 2)
    sides = struct.pack("<I", side - 1)[:3] * 2
    bits = 0x2f | min(side - 1, 16383) << 8 | min(side - 1, 16383) << 22
    lossless = bits.to_bytes(5, "little") + bytes(ROOM)
    body = b"WEBP" + riff(b"VP8X", struct.pack("<I", 0) + sides) + riff(b"VP8L", lossless)
    return b"RIFF" + struct.pack("<I", len(body)) + body


def jpeg2000(side):
    components = b"\7\1\1" * 3
    siz = struct.pack(">HHIIIIIIIIH", 38 + 9, 0, side, side, 0, 0, side, side, 0, 0, 3) + components
    cod = struct.pack(">HBBHBBBBBB", 12, 0, 0, 1, 0, 5, 4, 4, 0, 1)
    qcd = struct.pack(">HB", 3 + 16, 0x40) + bytes(16)
    return b"\xff\x4f\xff\x51" + siz + b"\xff\x52" + cod + b"\xff\x5c" + qcd + b"\xff\x90" \
        + struct.pack(">HHIBB", 10, 0, 0, 0, 1) + b"\xff\x93" + bytes(ROOM)


def psd(side, version=1):
    return b"8BPS" + struct.pack(">H6xHIIHH", version, 3, side, side, 8, 3) + bytes(8) \
        + bytes(8 if version == 2 else 4) + b"\0\1" + bytes(ROOM)


def bmp(side, compression=0):
    return b"BM" + struct.pack("<IIIIiiHHIIIIII", ROOM, 0, 54, 40, side, side, 1, 8 if compression else 24, compression,
                               0, 0, 0, 0, 0) + bytes(ROOM)


def safetensors(header, data=b""):
    return len(header).to_bytes(8, "little") + header + data


def images(folder, reference, gain_map, side=60000):
    """Name to bytes of files that claim to be images. `reference`: a DNG; `gain_map`: a JPEG with one."""
    strips = small("strips.tif", folder, compression="none")
    tiles = small("tiles.tif", folder, tile=16, compression="zip")
    plain = small("plain.exr", folder, type="half")
    second = gain_map.rindex(b"\xff\xc0") + 5
    made = {
        "baseline.jpg": jpeg(0xc0, side), "progressive.jpg": jpeg(0xc2, side),
        "arithmetic.jpg": jpeg(0xc9, side), "arithmetic_progressive.jpg": jpeg(0xca, side),
        "plain.png": png(side=side), "interlaced.png": png(side=side, interlaced=1), "bits.png": png(side=side, depth=1, color=0),
        "deep.png": png(side=side, depth=16, color=6), "strips.tif": tiff_tags(strips, {256: side, 257: side, 278: side}),
        "tiles.tif": tiff_tags(tiles, {256: side, 257: side, 322: side // 16 * 16, 323: side // 16 * 16}),
        "plain.exr": exr(plain, side), "both.exr": exr(exr(plain, side), side, name=b"displayWindow"),
        "plain.webp": webp(side), "codestream.j2k": jpeg2000(side),
        "plain.gif": b"GIF89a" + struct.pack("<HHBBB", side, side, 0x80, 0, 0) + bytes(6) + b"\x2c"
                     + struct.pack("<HHHHB", 0, 0, side, side, 0) + b"\2\1\4" + bytes(ROOM),
        "plain.psd": psd(30000), "big.psb": psd(side, 2), "plain.bmp": bmp(side), "runs.bmp": bmp(side, 1),
        "plain.tga": struct.pack("<BBBHHBHHHHBB", 0, 0, 2, 0, 0, 0, 0, 0, side, side, 24, 0) + bytes(ROOM),
        "runs.tga": struct.pack("<BBBHHBHHHHBB", 0, 0, 10, 0, 0, 0, 0, 0, side, side, 24, 0) + bytes(ROOM),
        "plain.ppm": b"P6 %d %d 255\n" % (side, side) + bytes(ROOM),
        "plain.hdr": b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (side, side) + bytes(ROOM),
        "plain.sgi": struct.pack(">HBBHHHH", 474, 1, 1, 3, side, side, 3) + bytes(500) + bytes(ROOM),
        "plain.dds": b"DDS " + struct.pack("<IIII", 124, 0x1007, side, side) + bytes(56)
                     + struct.pack("<II4s", 32, 4, b"DXT1") + bytes(20) + struct.pack("<I", 0x1000) + bytes(16 + ROOM),
        "photo.dng": dng(reference, side),
        "gain_map.jpg": gain_map[:second] + struct.pack(">HH", side, side) + gain_map[second + 4:],
    }
    try:
        made["plain.heic"] = heif(small("plain.heic", folder), side)
    except RuntimeError:
        pass
    return made


def texts(folder):
    """Name to bytes of small images whose metadata claim more than the file has, or grow a thousandfold."""
    plain, strips = small("plain.exr", folder, type="half"), small("strips.tif", folder)
    pixels = zlib.compress(bytes(3 * 64 * 64 + 64))
    profile = struct.pack(">I", 2 ** 32 - 1) + bytes(124)
    return {
        "text.png": png((b"zTXt", b"Comment\0\0" + ZEROS), side=64, data=pixels),
        "profile.png": png((b"iCCP", b"profile\0\0" + ZEROS), side=64, data=pixels),
        "international.png": png((b"iTXt", b"XML:com.adobe.xmp\0\1\0\0\0" + ZEROS), side=64, data=pixels),
        "data.png": png(side=64),
        "claims.png": png((b"iCCP", b"profile\0\0" + zlib.compress(profile)), side=64, data=pixels),
        "text.exr": exr_text(plain, 2 ** 31 - 1),
        "text_longer.exr": exr_text(plain, ROOM * 20),
        "profile.tif": tiff_tags(strips, {}) [:-ROOM],
    }
