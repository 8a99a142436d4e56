// SPDX-License-Identifier: Apache-2.0
#include "base/parsed_number.h"

#include <cstdint>

#include <doctest/doctest.h>

using namespace srisp;

TEST_CASE("a text is a number as a whole or not at all")
{
    CHECK(parsed_number<double>("-1.5e2") == -150.0);
    CHECK(parsed_number<std::uint64_t>("18446744073709551615") == UINT64_MAX);
    for (const char* text : { "", " 1", "1 ", "+1", "1,5", "1.5x", "0x10", "nan", "inf", "1e999" })
        CHECK_MESSAGE(!parsed_number<double>(text), text);
    for (const char* text : { "18446744073709551616", "-1", "1.0" })
        CHECK_MESSAGE(!parsed_number<std::uint64_t>(text), text);
}

TEST_CASE("people may write blanks and a plus sign")
{
    CHECK(parsed_signed_number<double>("+2") == 2.0);
    CHECK(!parsed_signed_number<double>(" 2"));
    CHECK(lenient_number<double>(" +0.25\r\n") == 0.25);
    CHECK(lenient_number<float>("-3\t") == -3.0f);
    for (const char* text : { "", " ", "+", "+-1", "++1", "1 2" })
        CHECK_MESSAGE(!lenient_number<double>(text), text);
}
