// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srisptool/modifiers.h"

#include <doctest/doctest.h>

#include "../failure_of.h"

using namespace srisp;
using namespace srisp::tool;

TEST_CASE("modifiers are read as oiiotool reads them")
{
    CHECK(parse_modifiers("--x").empty());
    CHECK(parse_modifiers("--x:a=1:b=two words") == Modifiers{ { "a", "1" }, { "b", "two words" } });
    CHECK(parse_modifiers("--x:a=b=c") == Modifiers{ { "a", "b=c" } });
    CHECK(parse_modifiers("--x:a=\"/p:q's.json\":b='\"'") == Modifiers{ { "a", "/p:q's.json" }, { "b", "\"" } });
    CHECK(parse_modifiers("--x:a=\"say \\\"hi\\\"\"") == Modifiers{ { "a", "say \"hi\"" } });
}

TEST_CASE("malformed modifiers are errors that show the place")
{
    const auto failure = [](const char* word) { return failure_of([=] { parse_modifiers(word); }); };
    CHECK(failure("--x:hold").rfind("2: '--x:hold': expected name=value at 'hold'", 0) == 0);
    CHECK(failure("--x:params=/a:b.json").find("expected name=value at 'b.json'") != std::string::npos);
    CHECK(failure("--x:a=") == "2: '--x:a=': a= has no value");
    CHECK(failure("--x:") != "");
    CHECK(failure("--x:=1") != "");
    CHECK(failure("--x:a=\"b") == "2: '--x:a=\"b': the quote \" is not closed");
    CHECK(failure("--x:a=\"b\"c") == "2: '--x:a=\"b\"c': expected ':' after the closing quote");
}
