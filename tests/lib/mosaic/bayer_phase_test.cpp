// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>
#include <srisp/mosaic.h>

using namespace srisp;

namespace {

std::string refusal(const std::string& text)
{
    const auto phase = parse_bayer_phase(text);
    return phase ? "(it is " + bayer_phase_text(*phase) + ")" : phase.error().message;
}

} // namespace

TEST_CASE("the four Bayer phases are read in either case, and written as cameras do")
{
    for (const std::string text : { "RGGB", "GRBG", "GBRG", "BGGR" }) {
        const auto phase = parse_bayer_phase(text);
        REQUIRE(phase);
        CHECK(bayer_phase_text(*phase) == text);
        std::string letters;
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 2; ++x)
                letters += "RGB"[bayer_color(*phase, x, y)];
        CHECK(letters == text);
    }
    const auto lower = parse_bayer_phase("gbrg");
    REQUIRE(lower);
    CHECK(*lower == BayerPhase::gbrg);
}

TEST_CASE("other filters than Bayer's are refused with what can be made")
{
    const std::string known = "only Bayer phases can be made: RGGB, GRBG, GBRG, BGGR";
    CHECK(refusal("X-Trans") == "X-Trans filters (X-Trans): " + known);
    const std::string x_trans = "GBGGRGRGRBGBGBGGRGGRGGBGBGBRGRGRGGBG";
    CHECK(refusal(x_trans) == "X-Trans filters (" + x_trans + "): " + known);
    CHECK(refusal("") == "an image without filters names no phase; " + known);
    CHECK(refusal("RGBG") == "unknown phase 'RGBG'; did you mean 'GRBG' or 'RGGB'? (" + known + ")");
    CHECK(refusal("a\nb").find("'a\\x0ab'") != std::string::npos);
}

TEST_CASE("a crop's phase follows from its offset, below 0, too")
{
    for (const int phase : { 0, 1, 2, 3 })
        for (int y = -3; y < 3; ++y)
            for (int x = -3; x < 3; ++x) {
                const MosaicPlace place{ BayerPhase(phase), x, y };
                CHECK(bayer_color(place.phase_here(), 0, 0) == bayer_color(place.phase, x, y));
                CHECK(bayer_color(place.phase_here(), 1, 0) == bayer_color(place.phase, x + 1, y));
                CHECK(bayer_color(place.phase_here(), 0, 1) == bayer_color(place.phase, x, y + 1));
            }
}
