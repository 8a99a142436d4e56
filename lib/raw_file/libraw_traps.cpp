// SPDX-License-Identifier: Apache-2.0
#include "raw_file/libraw_traps.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>

#include "raw_file/tiff_numbers.h"
#include "raw_file/tiff_tags.h"

namespace srisp {

namespace {

using namespace tiff_tag;
constexpr std::size_t kEntryBytes = 12; // of a tag: number, type, count, value or offset
constexpr std::uint32_t kXTransFilters = 36;
constexpr std::size_t kMostTags = 512; // in a folder; LibRaw's own limit for some of them

/// Tags by which LibRaw goes on to other folders: Exif, GPS, MakerNote, those of Kodak, Leaf, Sony, Fujifilm, Panasonic
/// and DNG's private data.
constexpr std::uint16_t kLinks[] = { 288, 330, 29264, 33424, 34310, 34665, 34853, 37500, 50740, 61440, 65024 };

/// The numbers of a tag's entry in one byte order.
class Entry {
public:
    Entry(const unsigned char* bytes, bool little) : m_bytes(bytes), m_little(little) {}
    std::uint32_t tag() const { return number(0, 2); }
    std::uint32_t type() const { return number(2, 2); }
    std::uint32_t count() const { return number(4, 4); }
    std::uint32_t short_value(std::size_t index) const { return number(8 + 2 * index, 2); }

private:
    std::uint32_t number(std::size_t at, std::size_t bytes) const
    {
        std::uint32_t result = 0;
        for (std::size_t i = 0; i < bytes; ++i)
            result = result << 8 | m_bytes[at + (m_little ? bytes - 1 - i : i)];
        return result;
    }

    const unsigned char* m_bytes;
    bool m_little;
};

/// Whether the entry says that the pattern, which comes next, is one of 6 × 6: then LibRaw reads it rightly.
bool announces_xtrans(const Entry& entry)
{
    constexpr std::uint32_t kShort = 3;
    return entry.tag() == kCfaRepeatPatternDim && entry.type() == kShort && entry.count() == 2 &&
           entry.short_value(0) == 6 && entry.short_value(1) == 6;
}

/// LibRaw finds tags in many places (makers' notes, TIFFs within JPEGs within other files), so all bytes are looked at.
/// That image data look like this happens in one of some million files.
bool holds_endless_pattern(const FileBytes& file, bool little)
{
    const std::array<unsigned char, 4> count = little ? std::array<unsigned char, 4>{ kXTransFilters, 0, 0, 0 }
                                                      : std::array<unsigned char, 4>{ 0, 0, 0, kXTransFilters };
    const unsigned char* const begin = file.data.get();
    const unsigned char* const end = begin + file.size;
    for (const unsigned char* at = begin;; ++at) {
        at = static_cast<const unsigned char*>(::memmem(at, std::size_t(end - at), count.data(), count.size()));
        if (!at)
            return false;
        if (at - begin < 4)
            continue;
        const unsigned char* const start = at - 4;
        const Entry entry(start, little);
        const bool announced =
            std::size_t(start - begin) >= kEntryBytes && announces_xtrans(Entry(start - kEntryBytes, little));
        if (entry.tag() == kKodakCfaPattern || (entry.tag() == kCfaPattern && !announced))
            return true;
    }
}

Status check_folder(const TiffFolder& folder)
{
    if (folder.tags.size() > kMostTags)
        return Error{ "a folder of its TIFF holds " + std::to_string(folder.tags.size()) + " tags, the limit is " +
                      std::to_string(kMostTags) };
    for (const std::uint16_t link : kLinks) {
        const auto named =
            std::count_if(folder.tags.begin(), folder.tags.end(), [&](const TiffTag& tag) { return tag.tag == link; });
        if (named > 1)
            return Error{ "a folder of its TIFF holds tag " + std::to_string(link) + " " + std::to_string(named) +
                          " times" };
    }
    return {};
}

} // namespace

Status check_libraw_traps(const FileBytes& file)
{
    for (const bool little : { true, false })
        if (holds_endless_pattern(file, little))
            return Error{ "is damaged, or made to do harm: it states a mosaic of 36 filters, but not of 6 x 6" };
    const TiffTags tags(file.data.get(), file.size);
    if (!tags.problem().empty())
        return Error{ "is damaged, or made to do harm: " + tags.problem() };
    for (const TiffFolder& folder : tags.folders())
        for (const TiffFolder& one :
             { folder, tags.linked_folder(folder, kExifFolder), tags.linked_folder(folder, kGpsFolder) })
            if (Status status = check_folder(one); !status)
                return status;
    return {};
}

} // namespace srisp
