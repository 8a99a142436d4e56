// SPDX-License-Identifier: Apache-2.0
#include "raw_file/tiff_tags.h"

#include <algorithm>
#include <cstring>

#include "raw_file/tiff_numbers.h"

namespace srisp {

namespace {

constexpr std::size_t kMostFolders = 64;        // real files have under 20
constexpr int kMostDepth = 2;                   // DNG nests one level
constexpr std::uint32_t kMostValues = 1u << 20; // the longest that we read: strip offsets, one per row
using namespace tiff_tag;

/// Bytes per value of a TIFF type (1 … 13); 0 for types that do not exist.
int bytes_of_type(int type)
{
    static const int kBytes[] = { 0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4 };
    return type < 14 ? kBytes[type] : 0;
}

} // namespace

const TiffTag* TiffFolder::find(std::uint16_t tag) const
{
    const auto found = std::find_if(tags.begin(), tags.end(), [&](const TiffTag& t) { return t.tag == tag; });
    return found == tags.end() ? nullptr : &*found;
}

/// Whether a file is a TIFF, or one in all but its number: Olympus, Panasonic.
static bool is_tiff(const unsigned char* data, std::size_t size)
{
    static const char* const kNumbers[] = { "II*\0", "MM\0*", "IIRO", "IIRS", "MMOR", "IIU\0" };
    return size >= 8 && std::any_of(std::begin(kNumbers), std::end(kNumbers),
                                    [&](const char* number) { return std::memcmp(data, number, 4) == 0; });
}

std::uint64_t whole_number(double value)
{
    constexpr std::uint64_t kMost = std::uint64_t(1) << 53;
    return !(value > 0) ? 0 : value < double(kMost) ? std::uint64_t(value) : kMost;
}

TiffTags::TiffTags(const unsigned char* data, std::size_t size) : m_data(data), m_size(size)
{
    if (!is_tiff(data, size))
        return;
    m_little = data[0] == 'I';
    read_chain(std::uint32_t(integer(4, 4)), 0);
    for (const TiffFolder& folder : m_folders)
        if (m_exif.tags.empty())
            m_exif = linked_folder(folder, kExifFolder);
}

TiffFolder TiffTags::linked_folder(const TiffFolder& folder, std::uint16_t tag) const
{
    TiffFolder linked;
    if (folder.find(tag)) {
        const std::uint64_t offset = whole_number(value(folder, tag, 0));
        if (offset < m_size) {
            linked.offset = std::uint32_t(offset);
            read_folder(linked.offset, linked);
        }
    }
    return linked;
}

std::uint64_t TiffTags::integer(std::size_t offset, int bytes) const
{
    std::uint64_t result = 0;
    for (int i = 0; i < bytes; ++i)
        result = result << 8 | m_data[offset + std::size_t(m_little ? bytes - 1 - i : i)];
    return result;
}

/// Reads one folder and returns the offset of the next one (0: none, or damaged).
std::uint32_t TiffTags::read_folder(std::size_t offset, TiffFolder& folder) const
{
    if (offset < 8 || offset > m_size - 2)
        return 0;
    const std::size_t count = std::size_t(integer(offset, 2));
    if (count > (m_size - 2 - offset) / 12)
        return 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = offset + 2 + 12 * i;
        TiffTag tag{ std::uint16_t(integer(at, 2)), std::uint16_t(integer(at + 2, 2)),
                     std::uint32_t(integer(at + 4, 4)), at + 8 };
        const std::uint64_t bytes = std::uint64_t(bytes_of_type(tag.type)) * tag.count;
        if (bytes > 4)
            tag.offset = std::size_t(integer(at + 8, 4));
        if (bytes > 0 && bytes <= m_size && tag.offset <= m_size - bytes)
            folder.tags.push_back(tag);
    }
    const std::size_t end = offset + 2 + 12 * count;
    return end + 4 <= m_size ? std::uint32_t(integer(end, 4)) : 0;
}

void TiffTags::read_chain(std::uint32_t offset, int depth)
{
    const auto among = [&](const std::vector<std::uint32_t>& offsets) {
        return std::find(offsets.begin(), offsets.end(), offset) != offsets.end();
    };
    const std::size_t path = m_path.size();
    while (offset != 0 && !among(m_seen)) {
        if (m_folders.size() == kMostFolders) {
            m_problem = "its TIFF has more than " + std::to_string(kMostFolders) + " folders of tags";
            return;
        }
        m_seen.push_back(offset);
        m_path.push_back(offset);
        TiffFolder folder;
        folder.offset = offset;
        offset = read_folder(offset, folder);
        m_folders.push_back(folder);
        const std::vector<double> children = values(folder, kSubFolders);
        if (depth == kMostDepth && !children.empty())
            m_problem = "its TIFF has folders of tags nested more than " + std::to_string(kMostDepth) + " deep";
        for (std::size_t i = 0; i < children.size() && depth < kMostDepth; ++i)
            read_chain(std::uint32_t(children[i]), depth + 1);
    }
    if (offset != 0 && among(m_path))
        m_problem = "its TIFF's folders of tags form a loop";
    m_path.resize(path);
}

double TiffTags::number(const TiffTag& tag, std::uint32_t index) const
{
    const int bytes = bytes_of_type(tag.type);
    const std::size_t at = tag.offset + std::size_t(index) * std::size_t(bytes);
    if (tag.type == 5 || tag.type == 10) { // RATIONAL, SRATIONAL
        const auto part = [&](std::size_t where) {
            const std::uint32_t bits = std::uint32_t(integer(where, 4));
            return tag.type == 5 ? double(bits) : double(std::int32_t(bits));
        };
        const double denominator = part(at + 4);
        return denominator == 0 ? 0 : part(at) / denominator;
    }
    const std::uint64_t bits = integer(at, bytes);
    switch (tag.type) {
    case 6:
        return double(std::int8_t(bits));
    case 8:
        return double(std::int16_t(bits));
    case 9:
        return double(std::int32_t(bits));
    case 11: {
        const std::uint32_t word = std::uint32_t(bits);
        float result;
        std::memcpy(&result, &word, sizeof result);
        return double(result);
    }
    case 12: {
        double result;
        std::memcpy(&result, &bits, sizeof result);
        return result;
    }
    default:
        return double(bits);
    }
}

std::vector<double> TiffTags::values(const TiffFolder& folder, std::uint16_t tag) const
{
    std::vector<double> result;
    if (const TiffTag* found = folder.find(tag))
        for (std::uint32_t i = 0; i < std::min(found->count, kMostValues); ++i)
            result.push_back(number(*found, i));
    return result;
}

double TiffTags::value(const TiffFolder& folder, std::uint16_t tag, double otherwise) const
{
    const TiffTag* found = folder.find(tag);
    return found ? number(*found, 0) : otherwise;
}

std::string TiffTags::bytes(const TiffFolder& folder, std::uint16_t tag) const
{
    const TiffTag* found = folder.find(tag);
    if (!found || (found->type != 1 && found->type != 7))
        return {};
    return { reinterpret_cast<const char*>(m_data + found->offset), found->count };
}

std::string TiffTags::text(const TiffFolder& folder, std::uint16_t tag) const
{
    const TiffTag* found = folder.find(tag);
    if (!found || (found->type != 2 && found->type != 1))
        return {};
    std::string result(reinterpret_cast<const char*>(m_data + found->offset), found->count);
    result.resize(std::min(result.size(), result.find('\0')));
    result.erase(result.find_last_not_of(" \t\r\n") + 1);
    return result;
}

} // namespace srisp
