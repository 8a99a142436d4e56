// SPDX-License-Identifier: Apache-2.0
#include "base/near_names.h"

#include <doctest/doctest.h>

using namespace srisp;

TEST_CASE("near names come first, else the known ones")
{
    CHECK(near_names("gian", { "gain", "gamma", "color" }) == "; did you mean 'gain'?");
    CHECK(near_names("x", { "gain", "color" }) == "; known: gain, color");
    CHECK(near_names("x", {}) == "");
}

TEST_CASE("names of any length and number are told in a short message, at once")
{
    const std::string endless(10000000, 'f');
    CHECK(near_names(endless, { "gain", "gamma" }) == "; known: gain, gamma");
    CHECK(near_names("file", { endless, "fiel" }) == "; did you mean 'fiel'?");
    CHECK(near_names("file", { endless }).size() < 200);
    std::vector<std::string> many;
    for (int i = 0; i < 200000; ++i)
        many.push_back("column " + std::to_string(i) + " of a table that a stranger has sent");
    const std::string told = near_names("file", many);
    CHECK(told.size() < 10000);
    CHECK(told.find(", and 199936 more") != std::string::npos);
}
