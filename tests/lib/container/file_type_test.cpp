// SPDX-License-Identifier: Apache-2.0
#include "container/file_type.h"

#include <doctest/doctest.h>

using namespace srisp;

namespace {

std::string bytes(const char* text, std::size_t size)
{
    std::string head(text, size);
    head.resize(kHeadBytes, '\0');
    return head;
}

} // namespace

TEST_CASE("Headers by which LibRaw knows a camera's file are RAW, and nothing else is")
{
    for (const auto& head : { bytes("IIU\0", 4), bytes("IIRO", 4), bytes("IIRS", 4), bytes("MMOR", 4),
                              bytes("II\x1a\0\0\0HEAPCCDR", 14), bytes("MM\0\0\0\x1aHEAPCCDR", 14),
                              bytes("\0\0\0\x18"
                                    "ftypcrx ",
                                    12),
                              bytes("FUJIFILMCCD-RAW ", 16), bytes("\0MRM", 4), bytes("IIIITwaR", 8),
                              bytes("MMMMRawT", 8), bytes("ARRI", 4), bytes("CI,\0", 4), bytes("qktk\0", 5),
                              bytes("DSC-Image", 9), bytes("NOKIARAW", 8), bytes("PWAD", 4) }) {
        CAPTURE(head);
        CHECK(file_type(head).kind == FileKind::raw);
    }
    CHECK(file_type(bytes("II*\0", 4)).kind == FileKind::tiff);
    CHECK(file_type(bytes("FOVb", 4)).kind == FileKind::foveon);
    for (const auto& head : { bytes("xy", 2), bytes("IIxx", 4), bytes("MMMM", 4), bytes("IIII", 4), bytes("qktkx", 5),
                              bytes("CINEMA", 6), bytes("RIFF", 4), std::string(), std::string("I") }) {
        CAPTURE(head);
        CHECK(file_type(head).kind == FileKind::headerless);
    }
}

TEST_CASE("A camera of SMaL is known by its file's size in the header")
{
    const std::string head = bytes("ab\7\x10\x27\0\0", 7);
    CHECK(file_type(head, 10000).kind == FileKind::raw);
    CHECK(file_type(head, 10001).kind == FileKind::headerless);
    CHECK(file_type(head).kind == FileKind::headerless);
}
