// SPDX-License-Identifier: Apache-2.0
#include "dng/packed_rows.h"

#include <doctest/doctest.h>

using namespace srisp;

TEST_CASE("Samples of 10, 12 and 14 bits lie without gaps, the highest bit first, rows on whole bytes")
{
    const std::uint16_t samples[] = { 0x3ff, 0, 0x155 };
    std::string ten, twelve, fourteen;
    append_packed_row(samples, 3, 10, ten);
    CHECK(ten == std::string("\xff\xc0\x05\x54", 4));
    append_packed_row(samples, 3, 12, twelve);
    CHECK(twelve == std::string("\x3f\xf0\x00\x15\x50", 5));
    append_packed_row(samples, 1, 14, fourteen);
    CHECK(fourteen == std::string("\x0f\xfc", 2));
    CHECK(packed_row_bytes(3, 10) == 4);
    CHECK(packed_row_bytes(4, 10) == 5);
}

TEST_CASE("Samples of 16 bits lie as the file's byte order has it")
{
    const std::uint16_t samples[] = { 0x1234, 0xff00 };
    std::string row;
    append_packed_row(samples, 2, 16, row);
    CHECK(row == std::string("\x34\x12\x00\xff", 4));
}

TEST_CASE("The floating point predictor orders bytes by weight and takes differences a pixel apart")
{
    // Two pixels of three planes, 16 bits: high bytes first.
    unsigned char row[] = { 1, 10, 2, 20, 3, 30, 4, 11, 5, 22, 6, 33 };
    predict_float_row(row, 6, 2, 3);
    const unsigned char expected[] = { 10, 20, 30, 1, 2, 3, 1 - 11 + 256, 2 - 22 + 256, 3 - 33 + 256, 3, 3, 3 };
    CHECK(std::string(row, row + 12) == std::string(expected, expected + 12));
}
