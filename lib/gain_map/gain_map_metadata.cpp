// SPDX-License-Identifier: Apache-2.0
#include "gain_map/gain_map_metadata.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "base/parsed_number.h"
#include "base/shown_text.h"

namespace srisp {

namespace {

constexpr const char* kSpace = "http://ns.adobe.com/hdr-gain-map/1.0/";
// Beyond what any display or camera has, and far from where float overflows.
constexpr double kLargestLogBoost = 32, kLargestOffset = 16, kLargestGamma = 100;

Error damaged(const std::string& reason)
{
    return Error{ "its gain map " + reason };
}

Status check_range(const char* name, double value, double least, double most)
{
    if (value >= least && value <= most)
        return {};
    return damaged(std::string("has ") + name + " = " + std::to_string(value) + "; from " + std::to_string(least) +
                   " to " + std::to_string(most) + " is possible");
}

/// Also refuses what is not finite.
Status check(const GainMapMetadata& metadata)
{
    for (int c = 0; c < 3; ++c) {
        for (const Status& in_range :
             { check_range("GainMapMin", metadata.min[c], -kLargestLogBoost, kLargestLogBoost),
               check_range("GainMapMax", metadata.max[c], metadata.min[c], kLargestLogBoost),
               check_range("Gamma", metadata.gamma[c], 1 / kLargestGamma, kLargestGamma),
               check_range("OffsetSDR", metadata.offset_sdr[c], -kLargestOffset, kLargestOffset),
               check_range("OffsetHDR", metadata.offset_hdr[c], -kLargestOffset, kLargestOffset) })
            if (!in_range)
                return in_range;
    }
    return {};
}

/// One number for all channels, or three; absent: those that are there already, if `may_lack`.
Status read_numbers(const XmpPacket& xmp, const char* name, bool may_lack, std::array<double, 3>& numbers)
{
    const std::vector<std::string> texts = xmp.values({ kSpace, name });
    if (texts.empty())
        return may_lack ? Status() : damaged(std::string("lacks ") + name);
    if (texts.size() != 1 && texts.size() != 3)
        return damaged("has " + std::to_string(texts.size()) + " values of " + name + "; 1 or 3 are possible");
    for (std::size_t c = 0; c < 3; ++c) {
        const std::string& text = texts[texts.size() == 1 ? 0 : c];
        const auto number = lenient_number<double>(text);
        if (!number)
            return damaged(std::string("has ") + name + " = '" + shown_text(text) + "', which is no number");
        numbers[c] = *number;
    }
    return {};
}

Status read_one_number(const XmpPacket& xmp, const char* name, bool may_lack, double& number)
{
    std::array<double, 3> numbers{ number, number, number };
    const Status read = read_numbers(xmp, name, may_lack, numbers);
    number = numbers[0];
    return read;
}

/// Big-endian numbers, one after the other.
class IsoReader {
public:
    explicit IsoReader(std::string_view bytes) : m_bytes(bytes) {}

    /// 0 beyond the end; `is_cut` tells then.
    std::uint32_t number(std::size_t bytes)
    {
        if (m_bytes.size() < bytes) {
            m_is_cut = true;
            return 0;
        }
        std::uint32_t value = 0;
        for (const char byte : m_bytes.substr(0, bytes))
            value = value << 8 | static_cast<unsigned char>(byte);
        m_bytes.remove_prefix(bytes);
        return value;
    }
    bool is_cut() const { return m_is_cut; }

private:
    std::string_view m_bytes;
    bool m_is_cut = false;
};

} // namespace

const XmpName kGainMapVersion{ kSpace, "Version" };

Expected<GainMapMetadata> gain_map_metadata_from_xmp(const XmpPacket& xmp)
{
    const std::vector<std::string> version = xmp.values(kGainMapVersion);
    if (version.size() != 1 || version[0].compare(0, 2, "1.") != 0)
        return damaged(version.empty()
                           ? "lacks Version"
                           : "is of version '" + shown_text(version[0]) + "'; 1.0 is what this program knows");
    GainMapMetadata metadata;
    metadata.offset_sdr.fill(1.0 / 64);
    metadata.offset_hdr.fill(1.0 / 64);
    for (const Status& read :
         { read_numbers(xmp, "GainMapMin", true, metadata.min), read_numbers(xmp, "GainMapMax", false, metadata.max),
           read_numbers(xmp, "Gamma", true, metadata.gamma), read_numbers(xmp, "OffsetSDR", true, metadata.offset_sdr),
           read_numbers(xmp, "OffsetHDR", true, metadata.offset_hdr),
           read_one_number(xmp, "HDRCapacityMin", true, metadata.sdr_headroom),
           read_one_number(xmp, "HDRCapacityMax", false, metadata.hdr_headroom) })
        if (!read)
            return read.error();
    const std::vector<std::string> base = xmp.values({ kSpace, "BaseRenditionIsHDR" });
    metadata.base_is_hdr = !base.empty() && base[0] == "True";
    if (!base.empty() && !metadata.base_is_hdr && base[0] != "False")
        return damaged("has BaseRenditionIsHDR = '" + shown_text(base[0]) + "'; True or False is possible");
    if (const Status checked = check(metadata); !checked)
        return checked.error();
    return metadata;
}

Expected<GainMapMetadata> gain_map_metadata_from_iso(std::string_view segment)
{
    IsoReader reader(segment);
    const std::uint32_t minimum_version = reader.number(2);
    reader.number(2); // the writer's version says nothing that a reader needs
    const std::uint32_t flags = reader.number(1);
    if (!reader.is_cut() && minimum_version != 0)
        return damaged("needs version " + std::to_string(minimum_version) +
                       " of ISO 21496-1; 0 is what this program knows");
    // The last two are libultrahdr's.
    const bool three_channels = flags & 0x80, is_common = flags & 0x08, is_backward = flags & 0x04;
    const double common = is_common ? reader.number(4) : 0;
    const auto divided = [&](double numerator) {
        const double denominator = is_common ? common : reader.number(4);
        return denominator == 0 ? std::nan("") : numerator / denominator;
    };
    const auto number = [&] { return divided(reader.number(4)); };
    const auto signed_number = [&] { return divided(static_cast<std::int32_t>(reader.number(4))); };

    GainMapMetadata metadata;
    metadata.in_colors_of_base = flags & 0x40;
    metadata.sdr_headroom = number();
    metadata.hdr_headroom = number();
    metadata.base_is_hdr = is_backward || metadata.sdr_headroom > metadata.hdr_headroom;
    for (std::size_t c = 0; c < 3; ++c) {
        const bool is_stored = c == 0 || three_channels;
        metadata.min[c] = is_stored ? signed_number() : metadata.min[0];
        metadata.max[c] = is_stored ? signed_number() : metadata.max[0];
        metadata.gamma[c] = is_stored ? number() : metadata.gamma[0];
        metadata.offset_sdr[c] = is_stored ? signed_number() : metadata.offset_sdr[0];
        metadata.offset_hdr[c] = is_stored ? signed_number() : metadata.offset_hdr[0];
    }
    if (reader.is_cut())
        return damaged("has a segment of ISO 21496-1 of " + std::to_string(segment.size()) +
                       " bytes, which ends too early");
    if (!std::isfinite(metadata.sdr_headroom) || !std::isfinite(metadata.hdr_headroom))
        return damaged("has an HDR headroom that is divided by 0");
    if (const Status checked = check(metadata); !checked)
        return checked.error();
    return metadata;
}

} // namespace srisp
