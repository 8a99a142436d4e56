// SPDX-License-Identifier: Apache-2.0
#include "base/png_orientation.h"

#include <fstream>
#include <sstream>
#include <string>

#include <doctest/doctest.h>

#include "scratch_folder.h"

using namespace srisp;

namespace {

std::string chunk(const std::string& type, const std::string& data)
{
    const char length[] = { 0, 0, 0, char(data.size()) };
    return std::string(length, 4) + type + data + "sum.";
}

std::string text(const std::string& value)
{
    return chunk("tEXt", std::string(kPngOrientationKey) + '\0' + value);
}

std::string placed(const std::string& bytes)
{
    const ScratchFolder scratch;
    const std::string path = scratch.file("x", bytes);
    place_png_orientation(path.c_str());
    std::ostringstream result;
    result << std::ifstream(path, std::ios::binary).rdbuf();
    std::vector<unsigned char> in_memory(bytes.begin(), bytes.end());
    place_png_orientation(in_memory);
    CHECK(std::string(in_memory.begin(), in_memory.end()) == result.str());
    return result.str();
}

const std::string kHead = "\x89PNG\r\n\x1a\n" + chunk("IHDR", std::string(13, 'h')) + chunk("tEXt", "Title");
const std::string kTail = chunk("IDAT", "pixels") + chunk("IEND", "");

} // namespace

TEST_CASE("the text becomes an eXIf chunk of one entry, and nothing else changes")
{
    const std::string exif("\0\0\0\x1a"
                           "eXIfMM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0"
                           "\xd6gKi", // the checksum by zlib
                           38);
    CHECK(placed(kHead + text("6.......") + kTail) == kHead + exif + kTail);
}

TEST_CASE("what is no such text stays as it is")
{
    for (const std::string& bytes :
         { kHead + text("9.......") + kTail, kHead + text("6......") + kTail, kHead + kTail + text("6......."),
           kHead + chunk("zTXt", std::string(26, 'x')) + kTail, "GIF8" + text("6......."), kHead, std::string() })
        CHECK(placed(bytes) == bytes);
    place_png_orientation("no/such/file.png");
}
