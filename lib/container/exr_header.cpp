// SPDX-License-Identifier: Apache-2.0
#include "container/exr_header.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "base/file_part.h"
#include "base/shown_text.h"

namespace srisp {

namespace {

constexpr std::size_t kStart = 8; // magic number and version
constexpr std::size_t kLongestName = 255;
constexpr std::size_t kHead = 2 * (kLongestName + 1) + 4; // of an attribute: name, type, size

/// The text up to its zero, which is passed; false: there is none.
bool take_text(const char*& at, const char* end, std::string& text)
{
    const char* const zero = std::find(at, end, '\0');
    if (zero == end)
        return false;
    text.assign(at, zero);
    at = zero + 1;
    return true;
}

} // namespace

Status check_exr_header(const std::string& path)
{
    const auto file = open_for_parts(path);
    if (!file)
        return file.error();
    constexpr std::size_t kMostAttributes = 1 << 16;
    constexpr unsigned char kManyParts = 0x10; // in the second byte of the version
    unsigned char start[kStart] = {};
    if (file->size() < kStart || !read_bytes(*file, start, 0, kStart))
        return {};
    std::size_t at = kStart;
    for (std::size_t i = 0; i < kMostAttributes; ++i) {
        char bytes[kHead];
        const std::size_t known = at < file->size() ? std::min(kHead, file->size() - at) : 0;
        if (!read_bytes(*file, bytes, at, known))
            return {};
        const char* next = bytes;
        std::string name, type;
        if (!take_text(next, bytes + known, name))
            return {};
        if (name.empty()) { // the end of a part's header; of the last one's there are two
            if (!(start[5] & kManyParts) || known < 2 || bytes[1] == '\0')
                return {};
            ++at;
            continue;
        }
        if (!take_text(next, bytes + known, type) || bytes + known - next < 4)
            return {};
        std::uint32_t size = 0;
        std::memcpy(&size, next, sizeof size); // little-endian, as this machine is
        at += std::size_t(next - bytes) + sizeof size;
        if (size > file->size() - at)
            return Error{ "is damaged or truncated: its attribute '" + shown_text(name) + "' says that it has " +
                          std::to_string(size) + " bytes, of which the file holds " +
                          std::to_string(file->size() - at) };
        at += size;
    }
    return Error{ "is damaged: has more than " + std::to_string(kMostAttributes) + " attributes" };
}

} // namespace srisp
