// SPDX-License-Identifier: Apache-2.0
#include "reference/file_type.h"

#include <algorithm>
#include <vector>

namespace srisp {

namespace {

struct Magic {
    std::size_t offset;
    std::string bytes;
    FileKind kind;
    const char* name;
};

std::string bytes(const char* text, std::size_t size)
{
    return { text, size };
}

const std::vector<Magic>& magics()
{
    using K = FileKind;
    static const std::vector<Magic> kMagics = {
        { 0, "\x76\x2f\x31\x01", K::exr, "OpenEXR" },       { 0, "FOVb", K::foveon, "X3F" },
        { 0, bytes("II*\0", 4), K::tiff, "TIFF" },          { 0, bytes("MM\0*", 4), K::tiff, "TIFF" },
        { 0, bytes("II+\0", 4), K::tiff, "BigTIFF" },       { 0, bytes("MM\0+", 4), K::tiff, "BigTIFF" },
        { 0, "\xff\xd8\xff", K::display_encoded, "JPEG" },  { 0, "\x89PNG", K::display_encoded, "PNG" },
        { 0, "GIF8", K::display_encoded, "GIF" },           { 0, "BM", K::display_encoded, "BMP" },
        { 8, "WEBP", K::display_encoded, "WebP" },          { 4, "ftyphei", K::display_encoded, "HEIC" },
        { 4, "ftyphev", K::display_encoded, "HEIC" },       { 4, "ftypmif1", K::display_encoded, "HEIF" },
        { 4, "ftypmsf1", K::display_encoded, "HEIF" },      { 4, "ftypavif", K::display_encoded, "AVIF" },
        { 4, "jP  \r\n", K::display_encoded, "JPEG 2000" }, { 0, "\xff\x4f\xff\x51", K::display_encoded, "JPEG 2000" },
        { 4, "JXL \r\n", K::display_encoded, "JPEG XL" },   { 0, "\xff\x0a", K::display_encoded, "JPEG XL" },
        { 0, "8BPS", K::display_encoded, "Photoshop" },     { 0, "#?RADIANCE", K::display_encoded, "Radiance HDR" },
        { 0, "SDPX", K::display_encoded, "DPX" },           { 0, "XPDS", K::display_encoded, "DPX" },
        { 0, "P5\n", K::display_encoded, "PGM" },           { 0, "P6\n", K::display_encoded, "PPM" },
    };
    return kMagics;
}

} // namespace

FileType file_type(const std::string& head)
{
    for (const Magic& magic : magics())
        if (head.compare(std::min(magic.offset, head.size()), magic.bytes.size(), magic.bytes) == 0)
            return { magic.kind, magic.name };
    return { FileKind::raw, "" };
}

} // namespace srisp
