// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

/// A JPEG of high quality, of 8-bit values by x, y and channel.
std::string jpeg_of(int width, int height, int channels, const std::function<int(int, int, int)>& value);

/// The same with a segment APPn behind the start of the image.
std::string with_app_segment(const std::string& jpeg, int n, const std::string& content);

/// What with_app_segment needs for XMP: a packet whose only description has these attributes and child elements. The
/// prefixes hdrgm, Container, Item, HDRGainMap and apdi are known in it.
std::string xmp_segment(const std::string& attributes, const std::string& elements = "");

/// The segment APP2 of ISO 21496-1 with big-endian numbers of four bytes behind its flags.
std::string iso_segment(int flags, const std::vector<std::int64_t>& numbers);

/// A small photo with a gain map, as phones write it: what a test wants otherwise, it sets.
struct UltraHdrJpeg {
    int width = 32, height = 24, map_width = 8, map_height = 6, map_channels = 1;
    std::string map_attributes = R"(hdrgm:Version="1.0" hdrgm:GainMapMax="2" hdrgm:HDRCapacityMax="2")";
    std::string map_elements;
    std::string map_iso; ///< content of the map's segment of ISO 21496-1; "": none
    bool map_has_xmp = true;
    bool has_container = true; ///< the photo's XMP lists the map
    bool has_index = true;     ///< the photo has a multi-picture index
    bool big_endian = true;    ///< the index
    std::string trailer;       ///< behind the map

    /// The map by itself, a JPEG with its metadata. Values rise from 0 to 255 along x, in other ways for G and B.
    std::string map() const;
    /// The whole file.
    std::string bytes() const;
};
