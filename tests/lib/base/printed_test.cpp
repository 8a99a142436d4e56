// SPDX-License-Identifier: Apache-2.0
#include "base/printed.h"

#include <doctest/doctest.h>

using namespace srisp;

TEST_CASE("printed texts are what printf prints, of any length")
{
    CHECK(printed("%.3g, %+d %s", 0.123456, 7, "dB") == "0.123, +7 dB");
    CHECK(printed("%s", "").empty());
    CHECK(printed("%700s|", "x") == std::string(699, ' ') + "x|");
}
