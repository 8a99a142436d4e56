// SPDX-License-Identifier: Apache-2.0
#include "container/reader_name.h"

#include <algorithm>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include "container/file_type.h"

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

/// Of formats beside those of file_type: their first bytes could be samples of a sensor as well.
const std::vector<Magic>& magics()
{
    static const std::vector<Magic> kMagics = {
        { 0, "#?RGBE", "hdr" },     { 0, "\x80\x2a\x5f\xd7", "cineon" },
        { 0, "DDS ", "dds" },       { 0, "\x01\xda", "sgi" },
        { 0, "\xda\x01", "sgi" },   { 0, bytes("\0\0\1\0", 4), "ico" },
        { 0, "SIMPLE  =", "fits" }, { 0, "\x53\x80\xf6\x34", "softimage" },
        { 128, "DICM", "dicom" },   { 0, "FOR4", "iff" },
        { 0, "FORM", "iff" },
    };
    return kMagics;
}

/// P1 … P6 (netpbm), Pf and PF (floats), each followed by white space.
bool is_pnm(const std::string& head)
{
    return head.size() > 2 && head[0] == 'P' && std::string("123456fF").find(head[1]) != std::string::npos &&
           std::string(" \t\r\n#").find(head[2]) != std::string::npos;
}

/// Whether every file of this reader begins in a way that is known here.
bool has_magic(const std::string& reader)
{
    if (reader == kRawReader ||
        reader == "iff") // old cameras' files, and IFF's compressed relatives, begin with anything
        return false;
    return is_told_by_first_bytes(reader) ||
           std::any_of(magics().begin(), magics().end(), [&](const Magic& magic) { return reader == magic.reader; });
}

} // namespace

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

std::string reader_name(const std::string& head, const std::string& path)
{
    const std::string by_ending = reader_of_ending(path);
    if (const FileType type = file_type(head); type.kind != FileKind::headerless)
        return type.reader == kTiffReader && by_ending == kRawReader ? kRawReader
                                                                     : type.reader; // most RAW files are TIFFs, too
    for (const Magic& magic : magics())
        if (head.compare(std::min(magic.offset, head.size()), magic.bytes.size(), magic.bytes) == 0)
            return magic.reader;
    if (is_pnm(head))
        return "pnm";
    return has_magic(by_ending) ? "" : by_ending;
}

} // namespace srisp
