// SPDX-License-Identifier: Apache-2.0
#include "container/image_memory.h"

#include <cstdlib>

#include <doctest/doctest.h>

#include "base/machine_memory.h"
#include "container/image_file.h"
#include "lib/container/made_files.h"
#include "scratch_folder.h"

using namespace srisp;

namespace {

/// SRISP_MAX_MEMORY while it lives.
struct Limit {
    explicit Limit(const char* text) { REQUIRE(::setenv("SRISP_MAX_MEMORY", text, 1) == 0); }
    ~Limit() { ::unsetenv("SRISP_MAX_MEMORY"); }
};

std::string fault(const Status& status)
{
    return status ? "" : status.error().message;
}

std::string opening(const std::string& path)
{
    const auto file = ImageFile::open(path, {}, "photo");
    return file ? "" : file.error().message;
}

} // namespace

TEST_CASE("the memory that an image may take is the machine's, or what SRISP_MAX_MEMORY says")
{
    CHECK(*most_image_memory() == machine_memory());
    for (const auto& [text, bytes] :
         { std::pair("1", 1ull << 20), { "500M", 500ull << 20 }, { "2G", 2ull << 30 }, { "", machine_memory() } }) {
        const Limit limit(text);
        CHECK(*most_image_memory() == bytes);
    }
    for (const std::string nonsense :
         { "0", "-1", "many", "2T", "2 G", "G", "1.5G", "99999999999999999999", "2000000000" }) {
        const Limit limit(nonsense.c_str());
        CHECK(most_image_memory().error().message ==
              "cannot be read: SRISP_MAX_MEMORY in the environment is '" + nonsense +
                  "'; a number of megabytes, or one with G behind it, is possible");
    }
}

TEST_CASE("an image that takes more memory than it may is refused by one message")
{
    const Limit limit("1G");
    CHECK(fault(check_memory(1 << 25, 3)) == "");
    CHECK(fault(check_memory(1 << 26, 3)) == "takes 1.61 GB of memory, for 67108864 pixels of 3 channels at a time, "
                                             "which is more than the limit of 1.07 GB; SRISP_MAX_MEMORY in the "
                                             "environment sets another");
    OIIO::ImageSpec spec(20000, 20000, 3, OIIO::TypeUInt8);
    CHECK(fault(check_reading_memory("tiff", spec)) == ""); // by rows
    CHECK(fault(check_reading_memory("webp", spec)).find("400000000 pixels") != std::string::npos);
    spec.tile_width = spec.tile_height = 5000;
    CHECK(fault(check_reading_memory("tiff", spec)).find("100000000 pixels") != std::string::npos);
}

TEST_CASE("files whose readers hold all pixels are refused before they are opened, and others are read")
{
    const ScratchFolder folder;
    OIIO::ImageSpec spec(16, 12, 3, OIIO::TypeUInt8);
    for (const char* const name : { "a.gif", "a.png", "a.jpg", "a.tif", "a.exr", "a.tga" })
        write_made(folder.path(name), spec);
    // The size that they say to have, in place.
    std::string progressive = bytes_of(folder.path("a.jpg"));
    const std::size_t frame = progressive.find("\xff\xc0");
    REQUIRE(frame != std::string::npos);
    progressive[frame + 1] = '\xc2';
    progressive.replace(frame + 5, 4, big_endian(4000, 2) + big_endian(4000, 2));
    write_bytes(folder.path("progressive.jpg"), progressive);
    std::string interlaced = "\x89PNG\r\n\x1a\n" +
                             png_chunk("IHDR", big_endian(4000) + big_endian(4000) + std::string("\x08\x02\0\0\1", 5)) +
                             png_chunk("IDAT", std::string("\x78\x9c", 2));
    write_bytes(folder.path("interlaced.png"), interlaced);
    std::string runs = "BM" + std::string(12, '\0') + little_endian(40) + little_endian(4000) + little_endian(4000) +
                       little_endian(1, 2) + little_endian(8, 2) + little_endian(1) + std::string(2000, '\0');
    write_bytes(folder.path("runs.bmp"), runs);
    const Limit limit("300"); // 16 million pixels of 3 channels take 384 MB
    for (const char* const name : { "progressive.jpg", "interlaced.png", "runs.bmp" }) {
        CAPTURE(name);
        CHECK(opening(folder.path(name)).find("photo: takes 0.384 GB of memory, for 16000000 pixels") == 0);
    }
    for (const char* const name : { "a.gif", "a.png", "a.jpg", "a.tif", "a.exr", "a.tga" }) {
        CAPTURE(name);
        CHECK(opening(folder.path(name)) == "");
    }
}

TEST_CASE("an EXR's attribute that says to be longer than the file is refused")
{
    const ScratchFolder folder;
    write_made(folder.path("a.exr"), OIIO::ImageSpec(16, 12, 3, OIIO::TypeHalf));
    std::string exr = bytes_of(folder.path("a.exr"));
    exr.insert(8, std::string("note\0string\0", 12) + little_endian(0x7fffffff));
    write_bytes(folder.path("long.exr"), exr);
    CHECK(opening(folder.path("long.exr"))
              .find("photo: is damaged or truncated: its attribute 'note' says that it has "
                    "2147483647 bytes, of which the file holds ") == 0);
    write_bytes(
        folder.path("many.exr"), exr.substr(0, 8) + [] {
            std::string all;
            for (int i = 0; i < 70000; ++i)
                all += std::string("a\0b\0\0\0\0\0", 8);
            return all;
        }());
    CHECK(opening(folder.path("many.exr")) == "photo: is damaged: has more than 65536 attributes");
}

TEST_CASE("an EXR of several parts is read, and its last part's attributes are looked at, too")
{
    const ScratchFolder folder;
    const std::string path = folder.path("parts.exr");
    OIIO::ImageSpec spec(16, 12, 3, OIIO::TypeHalf);
    spec.attribute("compression", "none");
    spec.attribute("note", "what only the last part says");
    OIIO::ImageSpec specs[] = { OIIO::ImageSpec(16, 12, 3, OIIO::TypeHalf), spec };
    auto output = OIIO::ImageOutput::create(path);
    REQUIRE((output && output->open(path, 2, specs)));
    REQUIRE(output->write_image(OIIO::TypeFloat, made_pixels(3).data()));
    REQUIRE(output->open(path, spec, OIIO::ImageOutput::AppendSubimage));
    REQUIRE(output->write_image(OIIO::TypeFloat, made_pixels(3).data()));
    REQUIRE(output->close());
    CHECK(opening(path) == "");
    std::string exr = bytes_of(path);
    const std::string mark("note\0string\0", 12);
    const std::size_t at = exr.find(mark);
    REQUIRE(at != std::string::npos);
    write_bytes(path, exr.replace(at + mark.size(), 4, little_endian(0x7fffffff)));
    CHECK(opening(path).find("its attribute 'note' says that it has 2147483647 bytes") != std::string::npos);
}
