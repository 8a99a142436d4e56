// SPDX-License-Identifier: Apache-2.0
#include "noise/noise_kernel.h"

#include <cmath>
#include <cstring>
#include <vector>

#include <doctest/doctest.h>

#include "each_target.h"

using namespace srisp;

namespace {

const std::vector<float> kNothing(kNoiseBuffer);

NoiseBlock block_at(int x, int y, std::uint64_t seed = 0x123456789abcdef0)
{
    return { seed, x, y, kNoiseBlock, kNothing.data(), kNothing.data() };
}

} // namespace

TEST_CASE("Philox4x32-10 gives the numbers that its authors publish")
{
    using Words = std::array<std::uint32_t, 4>;
    CHECK(philox({ 0, 0, 0, 0 }, 0) == Words{ 0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8 });
    CHECK(philox({ ~0u, ~0u, ~0u, ~0u }, ~0ull) == Words{ 0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd });
    CHECK(philox({ 0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344 }, 0x299f31d0a4093822) ==
          Words{ 0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1 });
}

TEST_CASE("random words are Philox's on every instruction set, each counter for four pixels")
{
    for (const int x : { 0, 4096, -8 })
        on_each_instruction_set([&] {
            std::vector<std::uint32_t> words(kNoiseBuffer);
            const NoiseBlock block = block_at(x, -3);
            random_words(block, NoiseStream::poisson, words.data());
            std::size_t wrong = 0;
            for (int i = 0; i < kNoiseBlock; ++i) {
                const auto expected = philox({ std::uint32_t((x + i) >> 2), std::uint32_t(-3), 1, 0 }, block.seed);
                wrong += words[std::size_t(i)] != expected[std::size_t(i % 4)];
            }
            CHECK(wrong == 0);
        });
}

TEST_CASE("normal numbers are Box and Muller's of the words, on every instruction set")
{
    on_each_instruction_set([&] {
        std::vector<float> normal(kNoiseBuffer);
        std::vector<std::uint32_t> words(kNoiseBuffer);
        double largest = 0;
        for (int y = 0; y < 20; ++y) {
            const NoiseBlock block = block_at(0, y);
            normal_numbers(block, normal.data());
            random_words(block, NoiseStream::normal, words.data());
            for (std::size_t i = 0; i < kNoiseBlock; i += 2) {
                const double radius = std::sqrt(-2 * std::log((words[i] | 1) * 0x1p-32));
                // The angle: 30 bits within a quadrant around 0°; bit 31 mirrors it to the left, bit 30 about 45°.
                const double angle = std::int32_t(words[i + 1] << 2) * 3.141592653589793 / 4 * 0x1p-31;
                double a = std::cos(angle) * (words[i + 1] >> 31 ? -1 : 1), b = std::sin(angle);
                if (words[i + 1] >> 30 & 1)
                    std::swap(a, b);
                // A float near 1 has 24 bits, so what is good to 1e-7 is the square of the radius.
                const double weight = std::min(radius, 1.0);
                largest = std::max(largest, weight * std::abs(radius * a - double(normal[i])));
                largest = std::max(largest, weight * std::abs(radius * b - double(normal[i + 1])));
            }
        }
        CHECK(largest < 2e-6);
    });
}

TEST_CASE("noise is the same to the bit on every instruction set, for few electrons and for many")
{
    const std::vector<float> shot(kNoiseBuffer, 0.002f), read(kNoiseBuffer, 1e-5f);
    std::vector<float> values(kNoiseBuffer), first;
    for (int i = 0; i < kNoiseBlock; ++i)
        values[std::size_t(i)] = 0.3f * float(i) / kNoiseBlock - 0.01f; // up to 150 electrons
    on_each_instruction_set([&] {
        std::vector<float> noisy = values;
        REQUIRE(add_block_noise({ 7, 0, 5, kNoiseBlock, shot.data(), read.data() }, noisy.data()));
        noisy.resize(kNoiseBlock);
        if (first.empty())
            first = noisy;
        CHECK(std::memcmp(first.data(), noisy.data(), first.size() * sizeof(float)) == 0);
    });
}
