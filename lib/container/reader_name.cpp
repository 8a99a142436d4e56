// SPDX-License-Identifier: Apache-2.0
#include "container/reader_name.h"

#include <algorithm>
#include <array>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

namespace srisp {

namespace {

namespace Strutil = OIIO::Strutil;

struct Magic {
    std::size_t offset;
    std::string bytes;
    const char* reader;
};

std::string bytes(const char* text, std::size_t size)
{
    return { text, size };
}

const char kTiff[] = "tiff";
const char kRaw[] = "raw";

const std::vector<Magic>& magics()
{
    static const std::vector<Magic> kMagics = {
        { 0, "\xff\xd8\xff", "jpeg" },
        { 0, "\x89PNG\r\n\x1a\n", "png" },
        { 0, bytes("II*\0", 4), kTiff },
        { 0, bytes("MM\0*", 4), kTiff },
        { 0, bytes("II+\0", 4), kTiff },
        { 0, bytes("MM\0+", 4), kTiff },
        { 0, "\x76\x2f\x31\x01", "openexr" },
        { 8, "WEBP", "webp" },
        { 4, "ftyphei", "heif" },
        { 4, "ftyphev", "heif" },
        { 4, "ftypmif1", "heif" },
        { 4, "ftypmsf1", "heif" },
        { 4, "ftypavi", "heif" },
        { 4, "ftypcrx", kRaw },
        { 4, "jP  \r\n", "jpeg2000" },
        { 0, "\xff\x4f\xff\x51", "jpeg2000" },
        { 0, "BM", "bmp" },
        { 0, "GIF8", "gif" },
        { 0, "8BPS", "psd" },
        { 0, "#?RADIANCE", "hdr" },
        { 0, "#?RGBE", "hdr" },
        { 0, "SDPX", "dpx" },
        { 0, "XPDS", "dpx" },
        { 0, "\x80\x2a\x5f\xd7", "cineon" },
        { 0, "DDS ", "dds" },
        { 0, "\x01\xda", "sgi" },
        { 0, "\xda\x01", "sgi" },
        { 0, bytes("\0\0\1\0", 4), "ico" },
        { 0, "SIMPLE  =", "fits" },
        { 0, "\x53\x80\xf6\x34", "softimage" },
        { 128, "DICM", "dicom" },
        { 0, "FOR4", "iff" },
        { 0, "FORM", "iff" },
        { 0, "FOVb", kRaw },
        { 0, "FUJIFILM", kRaw },
        { 0, bytes("\0MRM", 4), kRaw },
        { 6, "HEAPCCDR", kRaw },
        { 0, "IIU", kRaw },
        { 0, "IIRO", kRaw },
        { 0, "IIRS", kRaw },
        { 0, "MMOR", kRaw },
    };
    return kMagics;
}

/// P1 … P6 (netpbm), Pf and PF (floats), each followed by white space.
bool is_pnm(const std::string& head)
{
    return head.size() > 2 && head[0] == 'P' && std::string("123456fF").find(head[1]) != std::string::npos &&
           std::string(" \t\r\n#").find(head[2]) != std::string::npos;
}

/// The reader that OpenImageIO's own list gives to the ending of a name.
std::string reader_of_ending(const std::string& path)
{
    std::string ending = Strutil::lower(OIIO::Filesystem::extension(path, false));
    if (ending.empty())
        return "";
    for (const auto& format : Strutil::splits(OIIO::get_string_attribute("extension_list"), ";")) {
        const auto colon = format.find(':');
        const std::vector<std::string> endings =
            Strutil::splits(format.substr(std::min(colon, format.size() - 1) + 1), ",");
        if (std::count(endings.begin(), endings.end(), ending))
            return format.substr(0, colon);
    }
    return "";
}

/// Whether every file of this reader begins with one of the magics.
bool has_magic(const std::string& reader)
{
    if (reader == kRaw || reader == "iff") // old cameras' files, and IFF's compressed relatives, begin with anything
        return false;
    return reader == "pnm" ||
           std::any_of(magics().begin(), magics().end(), [&](const Magic& magic) { return reader == magic.reader; });
}

} // namespace

std::string reader_name(const std::string& head, const std::string& path)
{
    const std::string by_ending = reader_of_ending(path);
    for (const Magic& magic : magics())
        if (head.compare(std::min(magic.offset, head.size()), magic.bytes.size(), magic.bytes) == 0)
            return magic.reader == kTiff && by_ending == kRaw ? kRaw : magic.reader; // most RAW files are TIFFs, too
    if (is_pnm(head))
        return "pnm";
    return has_magic(by_ending) ? "" : by_ending;
}

} // namespace srisp
