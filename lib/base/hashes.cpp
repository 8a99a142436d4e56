// SPDX-License-Identifier: Apache-2.0
#include "base/hashes.h"

#include <cstdint>
#include <cstdio>
#include <cstring>

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

/// The part of the input that comes in stripes of 32 bytes, in four lanes.
std::uint64_t hash_of_stripes(const unsigned char*& p, const unsigned char* end)
{
    std::uint64_t lanes[4] = { kPrime1 + kPrime2, kPrime2, 0, 0 - kPrime1 };
    for (; end - p >= 32; p += 32)
        for (int i = 0; i < 4; ++i)
            lanes[i] = mixed(lanes[i], word_at<std::uint64_t>(p + 8 * i));
    std::uint64_t hash = rotated(lanes[0], 1) + rotated(lanes[1], 7) + rotated(lanes[2], 12) + rotated(lanes[3], 18);
    for (const std::uint64_t lane : lanes)
        hash = (hash ^ mixed(0, lane)) * kPrime1 + kPrime4;
    return hash;
}

std::uint64_t xxh64(const unsigned char* p, std::size_t size)
{
    const unsigned char* end = p + size;
    std::uint64_t hash = (size >= 32 ? hash_of_stripes(p, end) : kPrime5) + size;
    for (; end - p >= 8; p += 8)
        hash = rotated(hash ^ mixed(0, word_at<std::uint64_t>(p)), 27) * kPrime1 + kPrime4;
    for (; end - p >= 4; p += 4)
        hash = rotated(hash ^ word_at<std::uint32_t>(p) * kPrime1, 23) * kPrime2 + kPrime3;
    for (; p < end; ++p)
        hash = rotated(hash ^ *p * kPrime5, 11) * kPrime1;
    hash = (hash ^ (hash >> 33)) * kPrime2;
    hash = (hash ^ (hash >> 29)) * kPrime3;
    return hash ^ (hash >> 32);
}

} // namespace

std::string xxh64_of_bytes(const void* data, std::size_t size)
{
    char text[32];
    std::snprintf(text, sizeof text, "xxh64:%016llx",
                  static_cast<unsigned long long>(xxh64(static_cast<const unsigned char*>(data), size)));
    return text;
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
