// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace srisp {

/// The numbers of Philox4x32-10: multipliers, what the keys grow by in each round, rounds. [Salmon et al., "Parallel
/// random numbers: as easy as 1, 2, 3", 2011]
constexpr std::uint32_t kPhiloxM0 = 0xd2511f53, kPhiloxM1 = 0xcd9e8d57;
constexpr std::uint32_t kPhiloxW0 = 0x9e3779b9, kPhiloxW1 = 0xbb67ae85;
constexpr int kPhiloxRounds = 10;

/// What random bits are for: the third word of their counter.
enum class NoiseStream : std::uint32_t { normal = 0, poisson = 1, model = 2, brightness = 3 };

/// Four random words that depend on the counter and the key alone.
inline std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::uint64_t key)
{
    std::uint32_t key0 = std::uint32_t(key), key1 = std::uint32_t(key >> 32);
    for (int round = 0; round < kPhiloxRounds; ++round) {
        const std::uint64_t a = std::uint64_t(kPhiloxM0) * counter[0], b = std::uint64_t(kPhiloxM1) * counter[2];
        counter = { std::uint32_t(b >> 32) ^ counter[1] ^ key0, std::uint32_t(b),
                    std::uint32_t(a >> 32) ^ counter[3] ^ key1, std::uint32_t(a) };
        key0 += kPhiloxW0;
        key1 += kPhiloxW1;
    }
    return counter;
}

} // namespace srisp
