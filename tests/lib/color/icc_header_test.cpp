// SPDX-License-Identifier: Apache-2.0
#include "color/icc_header.h"

#include <doctest/doctest.h>

#include "color/icc_transform.h"
#include "icc_profiles.h"

using namespace srisp;

namespace {

/// Four bytes of a sound profile replaced.
std::vector<unsigned char> changed(std::size_t at, std::uint32_t value)
{
    auto bytes = adobe_rgb();
    for (std::size_t i = 0; i < 4; ++i)
        bytes[at + i] = static_cast<unsigned char>(value >> (24 - 8 * i));
    return bytes;
}

std::string fault(const std::vector<unsigned char>& bytes)
{
    const auto header = read_icc_header(bytes.data(), bytes.size());
    if (header)
        return "";
    // None comes as far as Little CMS.
    const auto transform = color_transform_from_icc(bytes.data(), bytes.size(), 3);
    CHECK(!transform);
    const std::string start = "its ICC profile of " + std::to_string(bytes.size()) + " bytes is damaged: ";
    REQUIRE(header.error().message.rfind(start, 0) == 0);
    return header.error().message.substr(start.size());
}

} // namespace

TEST_CASE("sound profiles pass")
{
    CHECK(fault(adobe_rgb()).empty());
    CHECK(fault(grey_gamma(2.2)).empty());
    CHECK(fault(profile_bytes(cmsCreate_sRGBProfile())).empty());
    CHECK(fault(profile_bytes(cmsCreateLab4Profile(nullptr))).empty());
}

TEST_CASE("numbers that stand for nothing are named")
{
    CHECK(fault(changed(12, 0xffffffff)) == "no kind of profile is called '" + std::string(4, '?') + "'");
    CHECK(fault(changed(16, 0xf2474220)) == "no colour space is called '?GB'");
    CHECK(fault(changed(20, 0)) == "no colour space is called '" + std::string(4, '?') + "'");
    CHECK(fault(changed(36, 0)) == "it does not say that it is one");
    CHECK(fault(changed(64, 4)) == "its rendering intent is 4, 0 to 3 are possible");
    CHECK(fault(changed(64, 3)).empty());
}

TEST_CASE("a profile whose sizes do not fit is damaged")
{
    CHECK(fault(changed(0, 0x7fffffff)) == "it says that it has 2147483647");
    CHECK(fault(changed(128, 0xffffffff)) == "it says that it has 4294967295 tags");
    CHECK(fault(changed(136, 0xffffffff)).find("ends at byte") != std::string::npos);
    CHECK(fault(changed(140, 0xffffffff)).find("ends at byte") != std::string::npos);
    CHECK(fault({}) == "a header has 132 bytes");
    auto cut = adobe_rgb();
    cut.resize(131);
    CHECK(fault(cut) == "a header has 132 bytes");
}
