// SPDX-License-Identifier: Apache-2.0
#include "dng/lossless_jpeg.h"

#include <random>

#include <doctest/doctest.h>

#include "lib/dng/lossless_jpeg_decoder.h"

using namespace srisp;

namespace {

void check_round_trip(const std::vector<std::uint16_t>& values, int columns, int rows, int components, int bits)
{
    CAPTURE(columns);
    CAPTURE(rows);
    CAPTURE(components);
    CAPTURE(bits);
    const std::string jpeg = encode_lossless_jpeg({ values.data(), columns, rows, components, bits });
    const LosslessJpegDecoder decoded(jpeg);
    CHECK(decoded.columns == columns);
    CHECK(decoded.rows == rows);
    CHECK(decoded.components == components);
    CHECK(decoded.bits == bits);
    CHECK(decoded.samples == values);
}

} // namespace

TEST_CASE("Lossless JPEG keeps noise of all precisions, sizes and numbers of components")
{
    std::mt19937 random(1);
    for (int bits = 10; bits <= 16; ++bits)
        for (const int components : { 1, 2, 3 })
            for (const auto& [columns, rows] :
                 { std::pair(1, 1), std::pair(1, 7), std::pair(5, 1), std::pair(33, 20) }) {
                std::vector<std::uint16_t> values(std::size_t(columns * rows * components));
                for (std::uint16_t& value : values)
                    value = std::uint16_t(random() & ((1u << bits) - 1));
                check_round_trip(values, columns, rows, components, bits);
            }
}

TEST_CASE("Lossless JPEG keeps the largest differences, 32768 among them")
{
    check_round_trip({ 0, 65535, 0, 32768, 0, 32767, 65535, 32767, 1, 32769, 65535, 0 }, 6, 1, 2, 16);
    check_round_trip({ 0, 32768, 0, 32768, 0, 32768 }, 6, 1, 1, 16);
    check_round_trip({ 65535, 0, 65535, 0 }, 1, 4, 1, 16);
}

TEST_CASE("Lossless JPEG marks bytes of all ones")
{
    // Differences of 1023 are ten bits of ones.
    std::vector<std::uint16_t> values;
    for (int i = 0; i < 400; ++i)
        values.push_back(std::uint16_t(1023 * (i % 60)));
    const std::string jpeg = encode_lossless_jpeg({ values.data(), 400, 1, 1, 16 });
    CHECK(jpeg.find(std::string("\xff\0", 2)) != std::string::npos);
    check_round_trip(values, 400, 1, 1, 16);
}

TEST_CASE("Lossless JPEG of an even image takes a bit a sample, and is the same each time")
{
    const std::vector<std::uint16_t> values(16000, 1 << 11);
    const std::string jpeg = encode_lossless_jpeg({ values.data(), 80, 100, 2, 12 });
    CHECK(jpeg.size() < 2000 + 100);
    CHECK(jpeg == encode_lossless_jpeg({ values.data(), 80, 100, 2, 12 }));
    check_round_trip(values, 80, 100, 2, 12);
}
