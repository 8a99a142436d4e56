// SPDX-License-Identifier: Apache-2.0
#include "base/png_orientation.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>

namespace srisp {

namespace {

using Bytes8 = std::array<unsigned char, 8>;

constexpr std::size_t kFrame = 12; ///< length, type and checksum of a chunk
constexpr std::size_t kLength = 26;
constexpr Bytes8 kSignature = { 0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n' };

static_assert(sizeof kPngOrientationKey + 1 + sizeof kPngOrientationRest - 1 == kLength, "the chunks differ in length");

std::uint32_t big_endian(const unsigned char* bytes)
{
    return std::uint32_t(bytes[0]) << 24 | std::uint32_t(bytes[1]) << 16 | std::uint32_t(bytes[2]) << 8 | bytes[3];
}

void put_big_endian(unsigned char* bytes, std::uint32_t value)
{
    for (int i = 0; i < 4; ++i)
        bytes[i] = static_cast<unsigned char>(value >> (24 - 8 * i));
}

std::uint32_t checksum(const unsigned char* bytes, std::size_t count)
{
    std::uint32_t sum = 0xffffffff;
    for (std::size_t i = 0; i < count; ++i) {
        sum ^= bytes[i];
        for (int bit = 0; bit < 8; ++bit)
            sum = sum >> 1 ^ (sum & 1 ? 0xedb88320 : 0);
    }
    return ~sum;
}

using Chunk = std::array<unsigned char, kFrame + kLength>;

Chunk exif_chunk(unsigned char orientation)
{
    // Exif data are a TIFF file: here with one directory of one entry, tag 274, a number of 16 bits.
    const unsigned char exif[] = { 0, 0, 0,  kLength, 'e', 'X', 'I', 'f', 'M', 'M', 0,           42, 0, 0, 0, 8, 0,
                                   1, 1, 18, 0,       3,   0,   0,   0,   1,   0,   orientation, 0,  0, 0, 0, 0, 0 };
    static_assert(sizeof exif == kFrame + kLength - 4);
    Chunk chunk{};
    std::memcpy(chunk.data(), exif, sizeof exif);
    put_big_endian(chunk.data() + sizeof exif, checksum(exif + 4, sizeof exif - 4));
    return chunk;
}

/// Whether it is the text, with an orientation that there is.
bool is_orientation_text(const Chunk& chunk)
{
    const unsigned char* const data = chunk.data() + 8;
    const unsigned char digit = data[sizeof kPngOrientationKey];
    return std::memcmp(chunk.data() + 4, "tEXt", 4) == 0 &&
           std::memcmp(data, kPngOrientationKey, sizeof kPngOrientationKey) == 0 && digit >= '1' && digit <= '8';
}

/// `read`, `write`: (data, size, place), false where that is not possible.
template<class Read, class Write> void place_in(const Read& read, const Write& write)
{
    Bytes8 head{};
    if (!read(head.data(), head.size(), 0) || head != kSignature)
        return;
    for (std::size_t at = head.size(); read(head.data(), head.size(), at);) {
        if (std::memcmp(head.data() + 4, "IDAT", 4) == 0)
            return; // texts that OpenImageIO writes stand before the pixels
        const std::uint32_t length = big_endian(head.data());
        Chunk chunk{};
        if (length == kLength && read(chunk.data(), chunk.size(), at) && is_orientation_text(chunk)) {
            chunk = exif_chunk(static_cast<unsigned char>(chunk[8 + sizeof kPngOrientationKey] - '0'));
            write(chunk.data(), chunk.size(), at);
            return;
        }
        at += std::size_t(kFrame) + length;
    }
}

} // namespace

void place_png_orientation(const char* path)
{
    const int saved = errno;
    const int file = open(path, O_RDWR | O_CLOEXEC);
    if (file >= 0) {
        place_in([&](void* data, std::size_t size,
                     std::size_t at) { return pread(file, data, size, off_t(at)) == ssize_t(size); },
                 [&](const void* data, std::size_t size, std::size_t at) {
                     // In place, nothing but a broken disk can refuse it.
                     return pwrite(file, data, size, off_t(at)) == ssize_t(size);
                 });
        close(file);
    }
    errno = saved;
}

void place_png_orientation(std::vector<unsigned char>& bytes)
{
    const auto holds = [&](std::size_t size, std::size_t at) {
        return at <= bytes.size() && size <= bytes.size() - at;
    };
    place_in([&](void* data, std::size_t size,
                 std::size_t at) { return holds(size, at) && std::memcpy(data, bytes.data() + at, size); },
             [&](const void* data, std::size_t size, std::size_t at) { std::memcpy(bytes.data() + at, data, size); });
}

} // namespace srisp
