// SPDX-License-Identifier: Apache-2.0
#include "reference/tiff_raw.h"

#include <algorithm>
#include <cstring>

#include <libraw/libraw_version.h>

#include "base/shown_text.h"
#include "raw_file/tiff_numbers.h"
#include "raw_file/tiff_tags.h"

namespace srisp {

namespace {

using namespace tiff_tag;
constexpr int kVc5 = 9, kNikon = 34713;
const char kHighEfficiency[] = "CONTACT_INTOPIX"; // near the start of Nikon's HE and HE* data

int integer(const TiffTags& tags, const TiffFolder& folder, std::uint16_t tag)
{
    return int(std::min<std::uint64_t>(whole_number(tags.value(folder, tag, 0)), 65535));
}

/// What kind of RAW image a folder holds; empty for other images. 9 is JBIG in other TIFFs.
std::string image_kind(const TiffTags& tags, const TiffFolder& folder)
{
    static const int kCameras[] = { 32767, 32769, 32770, 32772, kNikon, 34892, 65000, 65535 };
    switch (integer(tags, folder, kPhotometric)) {
    case kPhotometricCfa:
        return "a mosaic";
    case kPhotometricLinearRaw:
    case 32892: // Sony
        return "a LinearRaw image";
    }
    const int compression = integer(tags, folder, kCompression);
    return std::find(std::begin(kCameras), std::end(kCameras), compression) != std::end(kCameras)
               ? "an image of a camera"
               : "";
}

bool is_high_efficiency(const FileBytes& file, const TiffTags& tags, const TiffFolder& folder)
{
    constexpr std::size_t kLook = 256;
    const std::size_t offset = whole_number(tags.value(folder, kStripOffsets, double(file.size)));
    if (integer(tags, folder, kCompression) != kNikon || offset >= file.size)
        return false;
    const unsigned char* begin = file.data.get() + offset;
    const unsigned char* end = begin + std::min(kLook, file.size - offset);
    return std::search(begin, end, kHighEfficiency, kHighEfficiency + std::strlen(kHighEfficiency)) != end;
}

} // namespace

std::string tiff_raw_name(const FileBytes& file)
{
    const TiffTags tags(file.data.get(), file.size);
    if (tags.folders().empty())
        return "";
    const TiffFolder& first = tags.folders()[0];
    const std::string model = tags.text(first, kModel).empty() ? tags.text(first, kMake) : tags.text(first, kModel);
    const std::string what = "a RAW file" + (model.empty() ? "" : " of '" + shown_text(model) + "'") + " (TIFF with ";
    for (const TiffFolder& folder : tags.folders())
        if (const std::string kind = image_kind(tags, folder); !kind.empty())
            return what + kind + ", compression " + std::to_string(integer(tags, folder, kCompression)) + ")";
    return first.find(kDngVersion) ? what + "the tags of a DNG)" : "";
}

Status check_tiff_raw(const FileBytes& file)
{
    const TiffTags tags(file.data.get(), file.size);
    for (const TiffFolder& folder : tags.folders()) {
        if (is_high_efficiency(file, tags, folder))
            return Error{ "is a Nikon RAW file of high-efficiency compression, which LibRaw " LIBRAW_VERSION_STR
                          " does not decode: convert it to DNG" };
        if (!image_kind(tags, folder).empty() && integer(tags, folder, kCompression) == kVc5)
            return Error{ undecoded_vc5() };
    }
    return {};
}

std::string undecoded_vc5()
{
    return "is a GoPro RAW file (GPR), compressed by VC-5, which LibRaw " LIBRAW_VERSION_STR
           " does not decode: convert it to DNG, for example with Adobe's DNG Converter or GoPro's gpr_tools";
}

} // namespace srisp
