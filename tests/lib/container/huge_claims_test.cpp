// SPDX-License-Identifier: Apache-2.0
// Files that claim sizes that they do not have. They are refused, by one line, before memory or time is taken.
#include "container/image_file.h"

#include <functional>

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <srisp/photo.h>
#include <srisp/reference.h>

#include "lib/container/made_files.h"
#include "scratch_folder.h"

using namespace srisp;

namespace {

std::string refusal(const std::string& path)
{
    const auto file = ImageFile::open(path, {}, "photo");
    REQUIRE(!file);
    CHECK(file.error().message.rfind("photo: ", 0) == 0);
    CHECK(file.error().message.find('\n') == std::string::npos);
    return file.error().message;
}

/// Replaces the value of a tag in a little-endian TIFF's first directory; counts as one LONG.
std::string with_tag(std::string tiff, unsigned tag, std::uint32_t value)
{
    const auto number = [&](std::size_t at, int bytes) {
        std::uint32_t sum = 0;
        for (int i = bytes; i-- > 0;)
            sum = sum << 8 | static_cast<unsigned char>(tiff[at + std::size_t(i)]);
        return sum;
    };
    const std::size_t directory = number(4, 4);
    for (std::size_t i = 0; i < number(directory, 2); ++i) {
        const std::size_t entry = directory + 2 + 12 * i;
        if (number(entry, 2) == tag) {
            tiff.replace(entry + 2, 10, little_endian(4, 2) + little_endian(1) + little_endian(value));
            return tiff;
        }
    }
    FAIL("no such tag");
    return tiff;
}

/// Replaces an EXR's window; `name`: "dataWindow" or "displayWindow".
std::string with_window(std::string exr, const std::string& name, int x0, int y0, int x1, int y1)
{
    const std::string attribute = name + std::string("\0box2i\0", 7) + little_endian(16);
    const std::size_t at = exr.find(attribute);
    REQUIRE(at != std::string::npos);
    std::string window;
    for (const int edge : { x0, y0, x1, y1 })
        window += little_endian(std::uint32_t(edge));
    return exr.replace(at + attribute.size(), 16, window);
}

/// A JPEG's first bytes: a frame of one channel. `sof`: 0xc0 baseline, 0xc2 progressive, 0xca arithmetic.
std::string jpeg_start(int sof, unsigned width, unsigned height)
{
    const std::string quantisation = "\xff\xdb" + big_endian(67, 2) + std::string(1, '\0') + std::string(64, '\1');
    return "\xff\xd8" + quantisation + "\xff" + std::string(1, char(sof)) + big_endian(11, 2) + "\x08" +
           big_endian(height, 2) + big_endian(width, 2) + "\1\1\x11" + std::string(1, '\0');
}

const std::string kJpegScan = "\xff\xda" + big_endian(8, 2) + "\1\1" + std::string("\0\0\0\0", 4);

constexpr unsigned kSide = 65500;

} // namespace

TEST_CASE("a TIFF's tags of huge sizes")
{
    const ScratchFolder folder;
    OIIO::ImageSpec spec(16, 12, 3, OIIO::TypeUInt8);
    write_made(folder.path("strips.tif"), spec);
    spec.tile_width = spec.tile_height = 16;
    write_made(folder.path("tiles.tif"), spec);
    const std::string strips = bytes_of(folder.path("strips.tif")), tiles = bytes_of(folder.path("tiles.tif"));
    constexpr unsigned width = 256, length = 257, tile_width = 322, tile_length = 323, rows_per_strip = 278;
    const std::string path = folder.path("huge.tif");
    for (const std::uint32_t size : { 0x7ffffff0u, 0x80000000u, 0xfffffff0u, 0x10000000u })
        for (const unsigned tag : { width, length, tile_width, tile_length }) {
            CAPTURE(size);
            CAPTURE(tag);
            write_bytes(path, with_tag(tiles, tag, size));
            refusal(path);
            CHECK(!load_photo_thumbnail(path));
        }
    for (const unsigned tag : { width, length }) {
        write_bytes(path, with_tag(strips, tag, 0x7ffffff0));
        refusal(path);
    }
    for (const std::uint32_t rows : { 0x7ffffff0u, 0x7fffffffu }) {
        write_bytes(path, with_tag(strips, rows_per_strip, rows));
        CHECK(refusal(path) == "photo: has strips of " + std::to_string(rows) + " rows; the limit is 1048576");
    }
    // Writers that say nothing of strips mean this.
    write_bytes(path, with_tag(strips, rows_per_strip, 0xffffffff));
    const auto sound = load_photo_thumbnail(folder.path("strips.tif")), whole = load_photo_thumbnail(path);
    REQUIRE(sound);
    REQUIRE_MESSAGE(whole, (whole ? "" : whole.error().message));
    CHECK(whole->rgb == sound->rgb);
    write_bytes(path, with_tag(tiles, tile_length, 0x7ffffff0));
    CHECK(refusal(path) == "photo: has tiles of 16 x 2147483632 x 1 pixels; from 1 to 1048576 a side are possible");
}

TEST_CASE("An attribute of an OpenEXR file that ends beyond the file is refused, as photo and as reference")
{
    const ScratchFolder folder;
    write_made(folder.path("sound.exr"), OIIO::ImageSpec(16, 12, 3, OIIO::TypeHalf));
    const std::string sound = bytes_of(folder.path("sound.exr")), path = folder.path("long.exr");
    const auto with_comment = [&](std::uint32_t size) {
        const std::string attribute = std::string("comment\0string\0", 15) + little_endian(size);
        write_bytes(path, sound.substr(0, 8) + attribute + "abcd" + sound.substr(8));
        return path;
    };
    CHECK(ImageFile::open(with_comment(4), {}, "photo"));
    for (const std::uint32_t size : { std::uint32_t(sound.size()), 1700000000u, 0xffffffffu }) {
        const std::string told =
            "its attribute 'comment' says that it has " + std::to_string(size) + " bytes, of which the file holds ";
        CHECK(refusal(with_comment(size)).find(told) != std::string::npos);
        const auto reference = load_reference(path);
        REQUIRE(!reference);
        CHECK(reference.error().message.find(told) != std::string::npos);
    }
}

TEST_CASE("A DPX that says to have more of the user's data than the file has bytes is refused")
{
    const ScratchFolder folder;
    const std::string path = folder.path("a.dpx");
    write_made(path, OIIO::ImageSpec(16, 12, 3, OIIO::TypeUInt8));
    std::string dpx = bytes_of(path);
    REQUIRE(dpx.compare(0, 4, "XPDS") == 0); // the low byte first
    dpx.replace(32, 4, little_endian(0x70000000));
    write_bytes(path, dpx);
    CHECK(refusal(path).find("is to have 1879048192 bytes of user data") != std::string::npos);
    dpx.replace(32, 4, "\xff\xff\xff\xff"); // not known
    write_bytes(path, dpx);
    CHECK(ImageFile::open(path, {}, "photo"));
}

TEST_CASE("an EXR's windows at the ends of the numbers")
{
    const ScratchFolder folder;
    write_made(folder.path("sound.exr"), OIIO::ImageSpec(16, 12, 3, OIIO::TypeHalf));
    const std::string exr = bytes_of(folder.path("sound.exr")), path = folder.path("far.exr");
    constexpr int far = 0x7fffffff;
    for (const std::string name : { "dataWindow", "displayWindow" }) {
        write_bytes(path, with_window(exr, name, -far - 1, -far - 1, -far + 14, -far + 10));
        refusal(path);
        write_bytes(path, with_window(exr, name, far - 15, far - 11, far, far));
        refusal(path);
        write_bytes(path, with_window(exr, name, -far - 1, -far - 1, far, far));
        refusal(path);
        write_bytes(path, with_window(exr, name, 0, 0, far - 1, far - 1));
        refusal(path);
    }
}

TEST_CASE("tiny files that claim huge pictures")
{
    const ScratchFolder folder;
    const auto check = [&](const std::string& name, const std::string& bytes, const std::string& text) {
        CAPTURE(name);
        write_bytes(folder.path(name), bytes);
        const std::string message = refusal(folder.path(name));
        CAPTURE(message);
        CHECK(message.find(text) != std::string::npos);
    };
    const std::string claims = "is damaged or truncated: says that it has ";
    for (const int sof : { 0xc0, 0xc1, 0xc2, 0xca })
        check("huge.jpg", jpeg_start(sof, kSide, kSide) + kJpegScan,
              claims + "65500 x 65500 pixels, but has only 94 bytes");
    std::string strays = jpeg_start(0xc0, kSide, kSide) + kJpegScan;
    check("strays.jpg", strays.insert(strays.find("\xff\xc0"), "\x01\xff\xff"), claims);
    check("huge.png",
          "\x89PNG\r\n\x1a\n" +
              png_chunk("IHDR", big_endian(kSide) + big_endian(30000) + std::string("\x08\x02\0\0\0", 5)) +
              png_chunk("IDAT", std::string("\x78\x9c", 2)),
          claims + "65500 x 30000 pixels");
    check("huge.gif", "GIF89a" + little_endian(kSide, 2) + little_endian(kSide, 2) + std::string(300, '\0'), claims);
    check("huge.j2k",
          "\xff\x4f\xff\x51" + big_endian(41, 2) + big_endian(0, 2) + big_endian(kSide) + big_endian(kSide) +
              std::string(8, '\0') + std::string(100, '\0'),
          claims);
    check("huge.psd",
          "8BPS" + big_endian(1, 2) + std::string(6, '\0') + big_endian(3, 2) + big_endian(30000) + big_endian(30000) +
              big_endian(8, 2) + big_endian(3, 2) + std::string(12, '\0') + big_endian(1, 2) +
              std::string(3 * 30000 * 2, '\0'), // of rows of no bytes
          claims);
}

TEST_CASE("a JPEG of many scans, each of which costs a pass")
{
    const ScratchFolder folder;
    std::string jpeg = jpeg_start(0xc2, 8000, 8000);
    jpeg.append(200'000, '\0'); // enough bytes for so many pixels
    for (int i = 0; i < 5000; ++i)
        jpeg += kJpegScan;
    write_bytes(folder.path("scans.jpg"), jpeg + "\xff\xd9");
    CHECK(refusal(folder.path("scans.jpg")) ==
          "photo: has 5000 scans, each of all its 8000 x 8000 pixels; the limit is 64");
}

TEST_CASE("flat pictures of 24 megapixels, which compress best, are opened")
{
    const ScratchFolder folder;
    struct Flat {
        const char* name;
        int channels;
        const char* compression;
    };
    for (const Flat& flat :
         { Flat{ "flat.png", 1, "9" }, Flat{ "flat.jpg", 1, "jpeg:20" }, Flat{ "rgb.jpg", 3, "jpeg:20" },
           Flat{ "flat.tif", 1, "zip" }, Flat{ "flat.exr", 1, "dwab" } }) {
        CAPTURE(flat.name);
        OIIO::ImageBuf image(OIIO::ImageSpec(6000, 4000, flat.channels, OIIO::TypeUInt8));
        OIIO::ImageBufAlgo::zero(image);
        image.specmod()["compression"] = flat.compression;
        image.specmod()["png:compressionLevel"] = 9;
        REQUIRE(image.write(folder.path(flat.name)));
        const auto file = ImageFile::open(folder.path(flat.name), {}, "photo");
        REQUIRE_MESSAGE(file, (file ? "" : file.error().message));
        CHECK((*file)->spec().width == 6000);
    }
}
