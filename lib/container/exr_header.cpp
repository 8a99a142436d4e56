// SPDX-License-Identifier: Apache-2.0
#include "container/exr_header.h"

#include <cstdint>
#include <string_view>

#include "base/regular_file.h"
#include "base/shown_text.h"

namespace srisp {

namespace {

constexpr std::size_t kStart = 8, kSizeBytes = 4; // magic number and version; of an attribute's size
constexpr std::size_t kLongestHead = 2 * 256 + kSizeBytes;
constexpr int kMostAttributes = 65536, kMultiPart = 0x10; // in the second byte of the version

std::uint32_t little_endian(std::string_view bytes)
{
    std::uint32_t value = 0;
    for (std::size_t i = kSizeBytes; i-- > 0;)
        value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
}

} // namespace

Status check_exr_header(const std::string& path)
{
    const auto file = RegularFile::open(path);
    if (!file)
        return file.error();
    char buffer[kLongestHead];
    if (file->read(buffer, 0, kStart) != kStart)
        return {};
    const bool multi_part = buffer[5] & kMultiPart;
    std::size_t at = kStart;
    for (int i = 0; i < kMostAttributes; ++i) {
        const long long count = file->read(buffer, at, sizeof buffer);
        const std::string_view head(buffer, count < 0 ? 0 : std::size_t(count));
        if (head.empty())
            return {};
        if (head[0] == '\0') { // a header's end; after the last one of several there is another
            if (!multi_part || head.size() < 2 || head[1] == '\0')
                return {};
            ++at;
            continue;
        }
        const std::size_t name_end = head.find('\0'), type_end = head.find('\0', name_end + 1);
        if (name_end == head.npos || type_end == head.npos || type_end + 1 + kSizeBytes > head.size())
            return {};
        const std::uint32_t size = little_endian(head.substr(type_end + 1));
        at += type_end + 1 + kSizeBytes;
        if (at > file->size() || size > file->size() - at)
            return Error{ "is damaged or truncated: its attribute '" + shown_text(head.substr(0, name_end)) +
                          "' is to have " + std::to_string(size) + " bytes, the file has " +
                          std::to_string(file->size()) };
        at += size;
    }
    return {};
}

} // namespace srisp
