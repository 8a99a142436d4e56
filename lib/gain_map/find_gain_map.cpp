// SPDX-License-Identifier: Apache-2.0
#include "gain_map/find_gain_map.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/file_bytes.h"
#include "base/parsed_number.h"
#include "gain_map/xmp_packet.h"
#include "jpeg/jpeg_segments.h"

namespace srisp {

namespace {

using Found = Expected<std::optional<GainMapInfo>>;

constexpr std::string_view kJpegStart = "\xff\xd8";
constexpr std::size_t kLargestFile = std::size_t(1) << 30;

std::optional<XmpPacket> xmp_of(std::string_view jpeg)
{
    const auto packet = find_xmp_packet(jpeg);
    return packet ? XmpPacket::parse(*packet) : std::nullopt;
}

std::optional<std::string_view> iso_segment_of(std::string_view jpeg)
{
    using namespace std::string_view_literals;
    return find_app_segment(jpeg, 2, "urn:iso:std:iso:ts:21496:-1\0"sv);
}

/// An item of the photo's list of what follows it in the file (Google's container).
struct ContainerItem {
    bool is_gain_map = false;
    std::uint64_t length = 0, padding = 0;
};

std::uint64_t parsed_length(const std::string& text)
{
    return parsed_number<std::uint64_t>(text).value_or(0);
}

std::vector<ContainerItem> container_items(const XmpPacket& xmp)
{
    constexpr const char* container = "http://ns.google.com/photos/1.0/container/";
    constexpr const char* item = "http://ns.google.com/photos/1.0/container/item/";
    std::vector<ContainerItem> items;
    for (const std::vector<std::string>& fields :
         xmp.structures({ container, "Item" }, { { item, "Semantic" }, { item, "Length" }, { item, "Padding" } }))
        items.push_back({ fields[0] == "GainMap", parsed_length(fields[1]), parsed_length(fields[2]) });
    return items;
}

/// Where the container's lengths say that the map is, and what just follows the photo: the places to look at where the
/// multi-picture index is missing or wrong, which programs that edit the photo leave behind.
std::vector<std::string_view> images_behind_photo(std::string_view file, const std::vector<ContainerItem>& items)
{
    const auto photo = jpeg_image_size(file);
    if (!photo)
        return {};
    std::vector<std::string_view> images;
    std::string_view rest = file.substr(*photo);
    for (std::size_t i = 0; i < items.size(); ++i) { // the first is the photo
        const std::uint64_t length = i == 0 ? items[i].padding : items[i].length;
        if (length > rest.size())
            break;
        if (i > 0 && items[i].is_gain_map) {
            images.push_back(rest.substr(0, length));
            break;
        }
        rest.remove_prefix(length);
    }
    images.push_back(file.substr(*photo));
    return images;
}

/// What an image beside the photo is: a map, none, or a map with bad metadata.
Found described_by(std::string_view image)
{
    const auto info = [&](GainMapInfo::Kind kind, const GainMapMetadata& metadata) {
        return std::optional(GainMapInfo{ kind, metadata, std::string(image) });
    };
    std::optional<Error> iso_error;
    if (const auto segment = iso_segment_of(image)) {
        if (const auto metadata = gain_map_metadata_from_iso(*segment))
            return info(GainMapInfo::Kind::iso, *metadata);
        else
            iso_error = metadata.error(); // a draft of the standard, maybe: XMP may stand beside it
    }
    const auto xmp = xmp_of(image);
    if (xmp && !xmp->values(kGainMapVersion).empty()) {
        const auto metadata = gain_map_metadata_from_xmp(*xmp);
        if (!metadata)
            return metadata.error();
        return info(GainMapInfo::Kind::ultra_hdr, *metadata);
    }
    if (iso_error)
        return *iso_error;
    return std::optional<GainMapInfo>();
}

bool is_apple_gain_map(std::string_view image)
{
    const auto xmp = xmp_of(image);
    if (!xmp)
        return false;
    const std::vector<std::string> type =
        xmp->values({ "http://ns.apple.com/pixeldatainfo/1.0/", "AuxiliaryImageType" });
    return !xmp->values({ "http://ns.apple.com/HDRGainMap/1.0/", "HDRGainMapVersion" }).empty() ||
           (!type.empty() && type[0] == "urn:com:apple:photo:2020:aux:hdrgainmap");
}

} // namespace

Found find_gain_map(std::string_view file)
{
    if (file.substr(0, kJpegStart.size()) != kJpegStart)
        return std::optional<GainMapInfo>();
    const auto xmp = xmp_of(file);
    std::vector<ContainerItem> items;
    if (xmp)
        items = container_items(*xmp);
    const auto says_gain_map = [](const ContainerItem& item) { return item.is_gain_map; };
    const bool is_promised = iso_segment_of(file) || (xmp && !xmp->values(kGainMapVersion).empty()) ||
                             std::any_of(items.begin(), items.end(), says_gain_map);

    std::vector<std::string_view> images = find_further_images(file);
    const std::vector<std::string_view> indexed = images;
    if (is_promised)
        for (const std::string_view image : images_behind_photo(file, items))
            images.push_back(image);
    for (const std::string_view image : images) {
        Found found = described_by(image);
        if (!found || *found)
            return found;
    }
    if (std::any_of(indexed.begin(), indexed.end(), is_apple_gain_map))
        return std::optional(GainMapInfo{ GainMapInfo::Kind::apple, {}, {} });
    if (is_promised)
        return Error{
            "its gain map is missing or cut off: the photo says that it has one, and no image in the file is it"
        };
    return std::optional<GainMapInfo>();
}

std::string GainMapInfo::name() const
{
    switch (kind) {
    case Kind::ultra_hdr:
        return "Ultra HDR";
    case Kind::iso:
        return "ISO 21496-1";
    case Kind::apple:
        break;
    }
    return "Apple HDR";
}

Found find_gain_map_of_file(const std::string& path)
{
    const auto start = read_head(path, kJpegStart.size());
    if (!start)
        return start.error();
    if (*start != kJpegStart)
        return std::optional<GainMapInfo>();
    const auto file = read_head(path, kLargestFile);
    if (!file)
        return file.error();
    return find_gain_map(*file);
}

} // namespace srisp
