// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srisptool/output_depth.h"

#include <map>
#include <sstream>
#include <vector>

#include <doctest/doctest.h>

#include "scratch_folder.h"

using namespace srisp;
using namespace srisp::tool;

TEST_CASE("the depth of a format is known by its extension, in any case and behind any name")
{
    CHECK(deepest("a.png") == Depth::sixteen);
    CHECK(deepest("/x.d/A.B.PNG") == Depth::sixteen);
    CHECK(deepest("o.#.jpg") == Depth::eight);
    CHECK(deepest("jpeg") == Depth::eight);
    CHECK(deepest("a.exr") == Depth::any);
    CHECK(deepest("a") == Depth::any);
    CHECK(deepest("a.") == Depth::any);
    CHECK(deepest("dir.png/a") == Depth::any);
}

TEST_CASE("the installed oiiotool writes float pixels as deep as the table says")
{
    const ScratchFolder scratch;
    const std::vector<std::string> extensions = { "png",  "iff", "sgi", "rgb", "jpg", "bmp",  "gif", "tga",
                                                  "webp", "ppm", "exr", "tif", "dpx", "fits", "hdr", "rla" };
    std::string write = "oiiotool --pattern constant:color=.5,.5,.5 32x32 3", read = "iinfo";
    for (const std::string& extension : extensions) {
        write += " -o " + scratch.path("8." + extension) + " -o:datatype=uint16 " + scratch.path("16." + extension);
        read += " " + scratch.path("8." + extension) + " " + scratch.path("16." + extension);
    }
    REQUIRE(output_of(write).find("ERROR") == std::string::npos);
    std::map<std::string, std::string> lines; // file name → what iinfo says of it
    std::istringstream answer(output_of(read));
    for (std::string line; std::getline(answer, line);)
        lines[std::filesystem::path(line.substr(0, line.find(' '))).filename()] = line;
    const auto is = [&](const std::string& file, const char* type) {
        return lines[file].find(type) != std::string::npos;
    };
    for (const std::string& extension : extensions) {
        CAPTURE(extension);
        const Depth depth = deepest(extension);
        CHECK(is("8." + extension, " float ") == (depth == Depth::any));
        if (depth != Depth::any)
            CHECK(is("16." + extension, " uint16 ") == (depth == Depth::sixteen));
    }
}

TEST_CASE("an output's format is its extension, or what the command says")
{
    CHECK(output_format({ "-o", "a/b.c/x.#.PNG" }) == "png");
    CHECK(output_format({ "-o:datatype=half:fileformatname=OpenEXR", "x.png" }) == "openexr");
    CHECK(output_format({ "-o:broken", "x.tif" }) == "tif");
}

TEST_CASE("formats without orientation are known")
{
    for (const char* format : { "ppm", "bmp", "sgi", "webp", "jp2" })
        CHECK(!holds_orientation(format));
    for (const char* format : { "png", "tif", "exr", "openexr", "jpg", "jpeg", "dpx", "" })
        CHECK(holds_orientation(format));
}
