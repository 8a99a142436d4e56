// SPDX-License-Identifier: Apache-2.0
#include "recipe/white_balance.h"

#include <doctest/doctest.h>

using namespace srisp;

TEST_CASE("white balance is a word, a light, or three multipliers")
{
    using Kind = WhiteBalance::Kind;
    CHECK(parse_white_balance("scene")->kind == Kind::scene);
    CHECK(parse_white_balance("reference")->kind == Kind::reference);
    const auto light = parse_white_balance("5600,-12.5");
    REQUIRE(light);
    CHECK(light->kind == Kind::light);
    CHECK(light->temperature == 5600);
    CHECK(light->tint == -12.5f);
    CHECK(parse_white_balance("3200")->tint == 0);
    const auto multipliers = parse_white_balance("2.1,1,1.6");
    REQUIRE(multipliers);
    CHECK(multipliers->kind == Kind::multipliers);
    CHECK(multipliers->multipliers == std::array<float, 3>{ 2.1f, 1, 1.6f });
}

TEST_CASE("other white balances are refused with what they may be")
{
    for (const char* text : { "", "Scene", "warm", "999", "25001", "5600,", ",5600", "5600,201", "5600K", "1,2,3,4",
                              "0,1,1", "1,1,-1", "nan,1,1", "1e9,1,1", "5600 10", "5600;10" }) {
        const auto balance = parse_white_balance(text);
        REQUIRE_MESSAGE(!balance, text);
        CHECK(balance.error().message.find("is none of: scene; reference;") != std::string::npos);
    }
}

TEST_CASE("an exposure is a number of EV")
{
    CHECK(*parse_exposure("+0.5") == 0.5);
    CHECK(*parse_exposure("-20") == -20);
    for (const char* text : { "", "20.5", "one", "1EV", "inf", "nan", "+-1" })
        CHECK_FALSE(parse_exposure(text));
}
