// SPDX-License-Identifier: Apache-2.0
#include "base/sha256.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>

#if defined(__x86_64__)
#include <cpuid.h>
#include <immintrin.h>
#endif

namespace srisp {

namespace {

constexpr std::size_t kBlock = 64; // bytes
using State = std::array<std::uint32_t, 8>;
using AddBlocks = void (*)(State& state, const unsigned char* data, std::size_t blocks);

constexpr State kStart = { 0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                           0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19 };
alignas(16) constexpr std::uint32_t kRounds[64] = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2
};

std::uint32_t turned(std::uint32_t value, int bits)
{
    return value >> bits | value << (32 - bits);
}

std::uint32_t big_endian(const unsigned char* at)
{
    return std::uint32_t(at[0]) << 24 | std::uint32_t(at[1]) << 16 | std::uint32_t(at[2]) << 8 | at[3];
}

void add_blocks_plain(State& state, const unsigned char* data, std::size_t blocks)
{
    for (; blocks > 0; --blocks, data += kBlock) {
        std::uint32_t w[64];
        for (int i = 0; i < 16; ++i)
            w[i] = big_endian(data + 4 * i);
        for (int i = 16; i < 64; ++i)
            w[i] = w[i - 16] + w[i - 7] + (turned(w[i - 15], 7) ^ turned(w[i - 15], 18) ^ w[i - 15] >> 3) +
                   (turned(w[i - 2], 17) ^ turned(w[i - 2], 19) ^ w[i - 2] >> 10);
        auto [a, b, c, d, e, f, g, h] = state;
        for (int i = 0; i < 64; ++i) {
            const std::uint32_t first =
                h + (turned(e, 6) ^ turned(e, 11) ^ turned(e, 25)) + ((e & f) ^ (~e & g)) + kRounds[i] + w[i];
            const std::uint32_t second = (turned(a, 2) ^ turned(a, 13) ^ turned(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
            h = g, g = f, f = e, e = d + first;
            d = c, c = b, b = a, a = first + second;
        }
        const State change = { a, b, c, d, e, f, g, h };
        for (std::size_t i = 0; i < state.size(); ++i)
            state[i] += change[i];
    }
}

#if defined(__x86_64__)
bool has_instructions()
{
    unsigned a = 0, b = 0, c = 0, d = 0;
    return __get_cpuid_count(7, 0, &a, &b, &c, &d) && (b >> 29 & 1) && __builtin_cpu_supports("sse4.1");
}

__attribute__((target("sha,sse4.1"))) void add_blocks_fast(State& state, const unsigned char* data, std::size_t blocks)
{
    auto* const words = reinterpret_cast<__m128i*>(state.data());
    const __m128i swap = _mm_set_epi64x(0x0c0d0e0f08090a0b, 0x0405060700010203);
    const __m128i cdab = _mm_shuffle_epi32(_mm_loadu_si128(words), 0xb1);
    const __m128i efgh = _mm_shuffle_epi32(_mm_loadu_si128(words + 1), 0x1b);
    __m128i abef = _mm_alignr_epi8(cdab, efgh, 8), cdgh = _mm_blend_epi16(efgh, cdab, 0xf0);
    for (; blocks > 0; --blocks, data += kBlock) {
        const __m128i abef_before = abef, cdgh_before = cdgh;
        __m128i w[4];
        for (int i = 0; i < 4; ++i)
            w[i] = _mm_shuffle_epi8(_mm_loadu_si128(reinterpret_cast<const __m128i*>(data) + i), swap);
        for (int i = 0; i < 16; ++i) {
            __m128i& next = w[i & 3];
            const __m128i &second = w[(i + 1) & 3], &third = w[(i + 2) & 3], &last = w[(i + 3) & 3];
            if (i >= 4)
                next = _mm_sha256msg2_epu32(
                    _mm_add_epi32(_mm_sha256msg1_epu32(next, second), _mm_alignr_epi8(last, third, 4)), last);
            const __m128i sum = _mm_add_epi32(next, _mm_load_si128(reinterpret_cast<const __m128i*>(kRounds) + i));
            cdgh = _mm_sha256rnds2_epu32(cdgh, abef, sum);
            abef = _mm_sha256rnds2_epu32(abef, cdgh, _mm_shuffle_epi32(sum, 0x0e));
        }
        abef = _mm_add_epi32(abef, abef_before);
        cdgh = _mm_add_epi32(cdgh, cdgh_before);
    }
    const __m128i feba = _mm_shuffle_epi32(abef, 0x1b), dchg = _mm_shuffle_epi32(cdgh, 0xb1);
    _mm_storeu_si128(words, _mm_blend_epi16(feba, dchg, 0xf0));
    _mm_storeu_si128(words + 1, _mm_alignr_epi8(dchg, feba, 8));
}
#endif

std::string hash(const void* data, std::size_t size, AddBlocks add_blocks)
{
    const auto* const bytes = static_cast<const unsigned char*>(data);
    State state = kStart;
    add_blocks(state, bytes, size / kBlock);
    // The rest, a one, zeros, and the number of bits.
    const std::size_t rest = size % kBlock, length = rest < kBlock - 8 ? kBlock : 2 * kBlock;
    unsigned char end[2 * kBlock] = {};
    if (rest > 0)
        std::memcpy(end, bytes + (size - rest), rest);
    end[rest] = 0x80;
    for (std::size_t i = 0; i < 8; ++i)
        end[length - 1 - i] = static_cast<unsigned char>(std::uint64_t(size) * 8 >> 8 * i);
    add_blocks(state, end, length / kBlock);
    char text[65];
    for (std::size_t i = 0; i < state.size(); ++i)
        std::snprintf(text + 8 * i, 9, "%08x", static_cast<unsigned>(state[i]));
    return text;
}

} // namespace

std::string sha256_of_bytes(const void* data, std::size_t size)
{
#if defined(__x86_64__)
    static const bool fast = has_instructions();
    if (fast)
        return hash(data, size, add_blocks_fast);
#endif
    return hash(data, size, add_blocks_plain);
}

std::string sha256_of_bytes_plain(const void* data, std::size_t size)
{
    return hash(data, size, add_blocks_plain);
}

} // namespace srisp
