// SPDX-License-Identifier: Apache-2.0
#include "kept_rows.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

using namespace srisp::plugin;

namespace {

constexpr std::size_t kRowValues = 300;

/// Each value of one type as OpenImageIO makes it a float.
template<class Value> std::vector<float> floats_of(OIIO::TypeDesc type, const std::function<Value(std::size_t)>& value)
{
    std::vector<Value> values;
    for (std::size_t i = 0; i < kRowValues; ++i)
        values.push_back(value(i));
    std::vector<float> floats(kRowValues);
    OIIO::convert_pixel_values(type, values.data(), OIIO::TypeFloat, floats.data(), int(kRowValues));
    return floats;
}

std::size_t bytes_for(const std::vector<float>& row)
{
    KeptRows rows(1, kRowValues);
    rows.put(0, row.data());
    std::vector<float> back(kRowValues, -1);
    rows.get(0, back.data());
    CHECK(std::memcmp(back.data(), row.data(), kRowValues * sizeof(float)) == 0);
    return rows.bytes();
}

} // namespace

TEST_CASE("rows take the memory of the type that they had, and come back to the bit")
{
    const auto bits8 = floats_of<std::uint8_t>(OIIO::TypeUInt8, [](std::size_t i) { return std::uint8_t(i); });
    const auto bits16 =
        floats_of<std::uint16_t>(OIIO::TypeUInt16, [](std::size_t i) { return std::uint16_t(i * 211); });
    const auto half = floats_of<std::uint16_t>(OIIO::TypeHalf, [](std::size_t i) { return std::uint16_t(i * 103); });
    CHECK(bytes_for(bits8) == kRowValues);
    CHECK(bytes_for(bits16) == 2 * kRowValues);
    CHECK(bytes_for(half) == 2 * kRowValues);
    for (const float odd : { 0.1f, -0.0f, -1e-30f, 1e30f, std::nanf("7"), std::numeric_limits<float>::infinity() }) {
        auto row = bits8;
        row[7] = odd;
        CAPTURE(odd);
        CHECK(bytes_for(row) == 4 * kRowValues);
    }
}

TEST_CASE("rows of which nothing was put are black, and parts may come in any order")
{
    KeptRows rows(3, kRowValues);
    std::vector<float> row(kRowValues, -1);
    rows.get(1, row.data());
    CHECK(row == std::vector<float>(kRowValues));
    CHECK(rows.bytes() == 0);
    const std::vector<float> ones(100, 1);
    rows.put_part(1, 200, 100, ones.data());
    rows.put_part(2, 0, 100, ones.data());
    rows.pack();
    rows.put_part(1, 0, 100, ones.data());
    CHECK(rows.bytes() == 4 * kRowValues + kRowValues);
    rows.pack();
    CHECK(rows.bytes() == 2 * kRowValues);
    rows.get(1, row.data());
    for (std::size_t i = 0; i < kRowValues; ++i)
        CHECK(row[i] == (i < 100 || i >= 200 ? 1 : 0));
}
