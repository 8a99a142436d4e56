// SPDX-License-Identifier: Apache-2.0
#include "container/reader_name.h"

#include <doctest/doctest.h>

using srisp::reader_name;

TEST_CASE("a file is for the reader that its first bytes name, whatever it is called")
{
    CHECK(reader_name("\xff\xd8\xff\xe0", "photo.png") == "jpeg");
    CHECK(reader_name("\x89PNG\r\n\x1a\n", "photo.jpg") == "png");
    CHECK(reader_name(std::string("II*\0", 4), "photo") == "tiff");
    CHECK(reader_name("RIFF....WEBPVP8 ", "photo.jpg") == "webp");
    CHECK(reader_name("....ftypheic", "IMG_1.HEIC") == "heif");
    CHECK(reader_name("....ftypavif", "a.jpg") == "heif");
    CHECK(reader_name("P6\n3 2\n255\n", "a.jpg") == "pnm");
    CHECK(reader_name("BM", "a") == "bmp");
}

TEST_CASE("most RAW files are TIFFs, and told by their names")
{
    CHECK(reader_name(std::string("II*\0", 4), "photo.NEF") == "raw");
    CHECK(reader_name(std::string("MM\0*", 4), "photo.dng") == "raw");
    CHECK(reader_name("....ftypcrx ", "photo") == "raw");
}

TEST_CASE("formats that begin with nothing particular go by their names")
{
    CHECK(reader_name(std::string("\0\0\2\0", 4), "render.tga") == "targa");
    CHECK(reader_name("anything", "old.kdc") == "raw");
    CHECK(reader_name("anything", "render.rla") == "rla");
}

TEST_CASE("no reader is asked for what its first bytes deny")
{
    CHECK(reader_name("not a JPEG", "photo.jpg") == "");
    CHECK(reader_name("not an EXR", "photo.exr") == "");
    CHECK(reader_name("some text", "notes.txt") == "");
    CHECK(reader_name("", "photo.png") == "");
}
