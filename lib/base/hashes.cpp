// SPDX-License-Identifier: Apache-2.0
#include "base/hashes.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "base/file_part.h"
#include "base/printed.h"

namespace srisp {

namespace {

constexpr std::uint64_t kPrime1 = 0x9E3779B185EBCA87u, kPrime2 = 0xC2B2AE3D27D4EB4Fu, kPrime3 = 0x165667B19E3779F9u,
                        kPrime4 = 0x85EBCA77C2B2AE63u, kPrime5 = 0x27D4EB2F165667C5u;

std::uint64_t rotated(std::uint64_t value, int bits)
{
    return (value << bits) | (value >> (64 - bits));
}

/// Little-endian, as every machine that this runs on.
template<class Word> std::uint64_t word_at(const unsigned char* bytes)
{
    Word word;
    std::memcpy(&word, bytes, sizeof word);
    return word;
}

std::uint64_t mixed(std::uint64_t lane, std::uint64_t word)
{
    return rotated(lane + word * kPrime2, 31) * kPrime1;
}

/// Takes its input in parts, each but the last of whole stripes of 32 bytes, in four lanes.
class Xxh64 {
public:
    static constexpr std::size_t kStripe = 32;

    void add_stripes(const unsigned char* p, std::size_t size)
    {
        for (const unsigned char* end = p + size; p < end; p += kStripe)
            for (int i = 0; i < 4; ++i)
                m_lanes[i] = mixed(m_lanes[i], word_at<std::uint64_t>(p + 8 * i));
        m_size += size;
    }

    /// `p`: the last part, of less than a stripe.
    std::string finish(const unsigned char* p, std::size_t size) const
    {
        std::uint64_t hash = (m_size > 0 ? hash_of_stripes() : kPrime5) + m_size + size;
        const unsigned char* end = p + size;
        for (; end - p >= 8; p += 8)
            hash = rotated(hash ^ mixed(0, word_at<std::uint64_t>(p)), 27) * kPrime1 + kPrime4;
        for (; end - p >= 4; p += 4)
            hash = rotated(hash ^ word_at<std::uint32_t>(p) * kPrime1, 23) * kPrime2 + kPrime3;
        for (; p < end; ++p)
            hash = rotated(hash ^ *p * kPrime5, 11) * kPrime1;
        hash = (hash ^ (hash >> 33)) * kPrime2;
        hash = (hash ^ (hash >> 29)) * kPrime3;
        return printed("xxh64:%016llx", static_cast<unsigned long long>(hash ^ (hash >> 32)));
    }

private:
    std::uint64_t hash_of_stripes() const
    {
        std::uint64_t hash =
            rotated(m_lanes[0], 1) + rotated(m_lanes[1], 7) + rotated(m_lanes[2], 12) + rotated(m_lanes[3], 18);
        for (const std::uint64_t lane : m_lanes)
            hash = (hash ^ mixed(0, lane)) * kPrime1 + kPrime4;
        return hash;
    }

    std::uint64_t m_lanes[4] = { kPrime1 + kPrime2, kPrime2, 0, 0 - kPrime1 };
    std::uint64_t m_size = 0;
};

} // namespace

std::string xxh64_of_bytes(const void* data, std::size_t size)
{
    const auto* bytes = static_cast<const unsigned char*>(data);
    const std::size_t stripes = size / Xxh64::kStripe * Xxh64::kStripe;
    Xxh64 hash;
    hash.add_stripes(bytes, stripes);
    return hash.finish(bytes + stripes, size - stripes);
}

Expected<std::string> xxh64_of_file(const RegularFile& file)
{
    constexpr std::size_t part = 1 << 20;
    std::vector<unsigned char> bytes(std::min(part, file.size()));
    Xxh64 hash;
    for (std::size_t at = 0;;) {
        const std::size_t size = std::min(part, file.size() - at), stripes = size / Xxh64::kStripe * Xxh64::kStripe;
        if (const Status status = read_bytes(file, bytes.data(), at, size); !status)
            return status.error();
        hash.add_stripes(bytes.data(), stripes);
        at += size;
        if (at == file.size())
            return hash.finish(bytes.data() + stripes, size - stripes);
    }
}

std::uint64_t seeded_hash(std::uint64_t seed, const std::string& text)
{
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char c : text)
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    std::uint64_t z = hash + (seed + 1) * 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

} // namespace srisp
