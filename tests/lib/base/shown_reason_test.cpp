// SPDX-License-Identifier: Apache-2.0
#include "base/shown_reason.h"

#include <doctest/doctest.h>

using namespace srisp;

TEST_CASE(
    "what a library says is shown on one line, without its ends of lines and what is no UTF-8, and not without end")
{
    CHECK(shown_reason("no such file\n").compare("no such file") == 0);
    CHECK(shown_reason("first\nsecond \n\n").compare("first; second") == 0);
    CHECK(shown_reason("type of \"J!\x95\x1b[2J\" image").compare("type of \"J!\\x95\\x1b[2J\" image") == 0);
    CHECK(shown_reason(std::string(5000, 'a')).size() <= kLongestReason + 3);
    CHECK(shown_reason("\n").empty());
}
