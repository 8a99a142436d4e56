// SPDX-License-Identifier: Apache-2.0
#include "container/file_type.h"

#include <algorithm>
#include <vector>

namespace srisp {

namespace {

struct Magic {
    std::size_t offset;
    std::string bytes;
    FileKind kind;
    const char* name;
    const char* reader;
};

std::string bytes(const char* text, std::size_t size)
{
    return { text, size };
}

const std::vector<Magic>& magics()
{
    using K = FileKind;
    static const std::vector<Magic> kMagics = {
        { 0, "\x76\x2f\x31\x01", K::exr, "OpenEXR", "openexr" },
        { 0, "FOVb", K::foveon, "X3F", "raw" },
        { 0, bytes("II*\0", 4), K::tiff, "TIFF", "tiff" },
        { 0, bytes("MM\0*", 4), K::tiff, "TIFF", "tiff" },
        { 0, bytes("II+\0", 4), K::tiff, "BigTIFF", "tiff" },
        { 0, bytes("MM\0+", 4), K::tiff, "BigTIFF", "tiff" },
        { 0, "\xff\xd8\xff", K::display_encoded, "JPEG", "jpeg" },
        { 0, "\x89PNG", K::display_encoded, "PNG", "png" },
        { 0, "GIF8", K::display_encoded, "GIF", "gif" },
        { 0, "BM", K::display_encoded, "BMP", "bmp" },
        { 8, "WEBP", K::display_encoded, "WebP", "webp" },
        { 4, "ftyphei", K::display_encoded, "HEIC", "heif" },
        { 4, "ftyphev", K::display_encoded, "HEIC", "heif" },
        { 4, "ftypmif1", K::display_encoded, "HEIF", "heif" },
        { 4, "ftypmsf1", K::display_encoded, "HEIF", "heif" },
        { 4, "ftypavif", K::display_encoded, "AVIF", "heif" },
        { 4, "ftypavis", K::display_encoded, "AVIF", "heif" },
        { 4, "jP  \r\n", K::display_encoded, "JPEG 2000", "jpeg2000" },
        { 0, "\xff\x4f\xff\x51", K::display_encoded, "JPEG 2000", "jpeg2000" },
        { 4, "JXL \r\n", K::display_encoded, "JPEG XL", "" },
        { 0, "\xff\x0a", K::display_encoded, "JPEG XL", "" },
        { 0, "8BPS", K::display_encoded, "Photoshop", "psd" },
        { 0, "#?RADIANCE", K::display_encoded, "Radiance HDR", "hdr" },
        { 0, "SDPX", K::display_encoded, "DPX", "dpx" },
        { 0, "XPDS", K::display_encoded, "DPX", "dpx" },
        { 0, "P5\n", K::display_encoded, "PGM", "pnm" },
        { 0, "P6\n", K::display_encoded, "PPM", "pnm" },
        { 0, "II\xbc\x01", K::display_encoded, "JPEG XR", "" },
        { 0, bytes("IIU\0", 4), K::raw, "Panasonic", "raw" },
        { 0, "IIRO", K::raw, "Olympus", "raw" },
        { 0, "IIRS", K::raw, "Olympus", "raw" },
        { 0, "MMOR", K::raw, "Olympus", "raw" },
        { 6, "HEAPCCDR", K::raw, "Canon CRW", "raw" },
        { 4, "ftypcrx ", K::raw, "Canon CR3", "raw" },
        { 0, "FUJIFILM", K::raw, "Fujifilm", "raw" },
        { 0, bytes("\0MRM", 4), K::raw, "Minolta", "raw" },
        { 5, "waR", K::raw, "Phase One", "raw" },
        { 4, "Raw", K::raw, "Phase One", "raw" },
        { 0, "ARRI", K::raw, "ARRI", "raw" },
        { 4, "RED1", K::raw, "RED", "raw" },
        { 0, bytes("CI,\0", 4), K::raw, "Cine", "raw" },
        { 0, "PWAD", K::raw, "Sinar", "raw" },
        { 0, "DSC-Image", K::raw, "Rollei", "raw" },
        { 0, "NOKIARAW", K::raw, "Nokia", "raw" },
        { 0, bytes("\0\1\0\1\0@", 6), K::raw, "Nokia", "raw" },
        { 25, "ARECOYK", K::raw, "Contax", "raw" },
        { 0, bytes("PXN\0", 4), K::raw, "Logitech", "raw" },
        { 0, bytes("qktk\0", 5), K::raw, "QuickTake", "raw" },
        { 0, bytes("qktn\0", 5), K::raw, "QuickTake", "raw" },
    };
    return kMagics;
}

/// Cameras of SMaL begin with a version and the file's size.
bool is_smal(const std::string& head, std::uint64_t file_size)
{
    if (head.size() < 9 || file_size == 0)
        return false;
    const std::size_t at = head[2] == 6 ? 5 : 3;
    std::uint64_t size = 0;
    for (std::size_t i = 4; i-- > 0;)
        size = size << 8 | static_cast<unsigned char>(head[at + i]);
    return size == file_size;
}

} // namespace

FileType file_type(const std::string& head, std::uint64_t file_size)
{
    for (const Magic& magic : magics())
        if (head.compare(std::min(magic.offset, head.size()), magic.bytes.size(), magic.bytes) == 0)
            return { magic.kind, magic.name, magic.reader };
    return { is_smal(head, file_size) ? FileKind::raw : FileKind::headerless, "", "" };
}

bool is_told_by_first_bytes(const std::string& reader)
{
    return std::any_of(magics().begin(), magics().end(), [&](const Magic& magic) { return reader == magic.reader; });
}

} // namespace srisp
