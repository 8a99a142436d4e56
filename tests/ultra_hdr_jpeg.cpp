// SPDX-License-Identifier: Apache-2.0
#include "ultra_hdr_jpeg.h"

#include <stdexcept>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace {

std::string number(std::uint64_t value, int bytes, bool big_endian = true)
{
    std::string text;
    for (int i = 0; i < bytes; ++i)
        text += char(value >> 8 * (big_endian ? bytes - 1 - i : i));
    return text;
}

std::string container_xmp(std::size_t map_size)
{
    const auto item = [](const std::string& attributes) {
        return "<rdf:li rdf:parseType=\"Resource\"><Container:Item Item:Mime=\"image/jpeg\" " + attributes +
               "/></rdf:li>";
    };
    return xmp_segment(R"(hdrgm:Version="1.0")",
                       "<Container:Directory><rdf:Seq>" + item(R"(Item:Semantic="Primary")") +
                           item("Item:Semantic=\"GainMap\" Item:Length=\"" + std::to_string(map_size) + "\"") +
                           "</rdf:Seq></Container:Directory>");
}

/// The multi-picture index of two images, of which the second begins `map_start` bytes behind the index's byte order.
std::string mpf(std::size_t photo_size, std::size_t map_start, std::size_t map_size, bool big)
{
    const auto n = [&](std::uint64_t value, int bytes) { return number(value, bytes, big); };
    const auto tag = [&](int id, int type, std::uint64_t count) { return n(id, 2) + n(type, 2) + n(count, 4); };
    const auto entry = [&](std::uint64_t kind, std::uint64_t size, std::uint64_t start) {
        return n(kind, 4) + n(size, 4) + n(start, 4) + n(0, 4);
    };
    const int directory = 8, entries = directory + 2 + 3 * 12 + 4;
    return std::string("MPF\0", 4) + (big ? "MM" : "II") + n(42, 2) + n(directory, 4) + n(3, 2) + tag(0xb000, 7, 4) +
           "0100" + tag(0xb001, 4, 1) + n(2, 4) + tag(0xb002, 7, 32) + n(entries, 4) + n(0, 4) +
           entry(0x030000, photo_size, 0) + entry(0, map_size, map_start);
}

} // namespace

std::string jpeg_of(int width, int height, int channels, const std::function<int(int, int, int)>& value)
{
    std::vector<unsigned char> pixels;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c)
                pixels.push_back(static_cast<unsigned char>(value(x, y, c)));
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    OIIO::ImageSpec spec(width, height, channels, OIIO::TypeUInt8);
    spec["Compression"] = "jpeg:100";
    spec["jpeg:subsampling"] = "4:4:4";
    const auto output = OIIO::ImageOutput::create("jpeg", &memory);
    if (!output || !output->open("memory.jpg", spec) || !output->write_image(OIIO::TypeUInt8, pixels.data()) ||
        !output->close())
        throw std::runtime_error("cannot make a JPEG: " + (output ? output->geterror() : OIIO::geterror()));
    return { bytes.begin(), bytes.end() };
}

std::string with_app_segment(const std::string& jpeg, int n, const std::string& content)
{
    return jpeg.substr(0, 2) + '\xff' + char(0xe0 + n) + number(content.size() + 2, 2) + content + jpeg.substr(2);
}

std::string xmp_segment(const std::string& attributes, const std::string& elements)
{
    return std::string("http://ns.adobe.com/xap/1.0/") + '\0' + R"(<?xpacket begin="" id="W5M0MpCehiHzreSzNTczkc9d"?>
<x:xmpmeta xmlns:x="adobe:ns:meta/"><rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#"><rdf:Description
 xmlns:hdrgm="http://ns.adobe.com/hdr-gain-map/1.0/" xmlns:Container="http://ns.google.com/photos/1.0/container/"
 xmlns:Item="http://ns.google.com/photos/1.0/container/item/" xmlns:HDRGainMap="http://ns.apple.com/HDRGainMap/1.0/"
 xmlns:apdi="http://ns.apple.com/pixeldatainfo/1.0/" rdf:about="" )" +
           attributes + ">" + elements + "</rdf:Description></rdf:RDF></x:xmpmeta>\n<?xpacket end=\"w\"?>";
}

std::string iso_segment(int flags, const std::vector<std::int64_t>& numbers)
{
    std::string content = std::string("urn:iso:std:iso:ts:21496:-1") + '\0' + number(0, 4) + char(flags);
    for (const std::int64_t value : numbers)
        content += number(std::uint64_t(value), 4);
    return content;
}

std::string UltraHdrJpeg::map() const
{
    std::string jpeg = jpeg_of(map_width, map_height, map_channels, [&](int x, int y, int c) {
        const int along = map_width > 1 ? 255 * x / (map_width - 1) : 128;
        return c == 0 ? along : c == 1 ? 255 - along : 20 * y % 256;
    });
    if (!map_iso.empty())
        jpeg = with_app_segment(jpeg, 2, map_iso);
    return map_has_xmp ? with_app_segment(jpeg, 1, xmp_segment(map_attributes, map_elements)) : jpeg;
}

std::string UltraHdrJpeg::bytes() const
{
    const std::string gain_map = map();
    std::string photo = jpeg_of(width, height, 3, [&](int x, int y, int c) {
        return (c == 2 ? 60 : 0) + 190 * (c == 0 ? x : y) / (c == 0 ? width : height);
    });
    if (has_container)
        photo = with_app_segment(photo, 1, container_xmp(gain_map.size()));
    if (has_index) { // its size depends on nothing; start of image, marker, length and signature are before its origin
        const std::size_t size = photo.size() + 4 + mpf(0, 0, 0, big_endian).size(), origin = 2 + 4 + 4;
        photo = with_app_segment(photo, 2, mpf(size, size - origin, gain_map.size(), big_endian));
    }
    return photo + gain_map + trailer;
}
