// SPDX-License-Identifier: Apache-2.0
#include "photo/code_values.h"

#include <vector>

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

using namespace srisp;

template<class Code> static void check_all(OIIO::TypeDesc type)
{
    std::vector<Code> codes(kCodeCount<Code>);
    for (std::size_t i = 0; i < codes.size(); ++i)
        codes[i] = static_cast<Code>(codes.size() - 1 - i);
    std::vector<float> expected(codes.size()), values(codes.size());
    OIIO::convert_pixel_values(type, codes.data(), OIIO::TypeFloat, expected.data(), int(codes.size()));
    codes_to_floats(codes.data(), codes.size(), values.data());
    CHECK(values == expected);
    CHECK(values.front() == 1);
    CHECK(values.back() == 0);
    CHECK(are_codes(type));
}

TEST_CASE("integers of 8 and 16 bits become OpenImageIO's floats, to the bit")
{
    check_all<std::uint8_t>(OIIO::TypeUInt8);
    check_all<std::uint16_t>(OIIO::TypeUInt16);
    for (const OIIO::TypeDesc& other : { OIIO::TypeFloat, OIIO::TypeHalf, OIIO::TypeInt16, OIIO::TypeUInt32 })
        CHECK(!are_codes(other));
}
