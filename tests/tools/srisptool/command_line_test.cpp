// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srisptool/command_line.h"

#include <doctest/doctest.h>

#include "../failure_of.h"

using namespace srisp;
using namespace srisp::tool;
using Words = std::vector<std::string>;

TEST_CASE("arguments belong to their commands")
{
    const std::vector<Step> steps =
        parse_command_line({ "a.jpg", "--create", "1x1", "3", "-o", "-", "--over", "b.jpg" });
    REQUIRE(steps.size() == 5);
    CHECK(steps[1].words == Words{ "--create", "1x1", "3" });
    CHECK(steps[2].words == Words{ "-o", "-" });
    CHECK(steps[3].oiiotool->role == Role::acts);
    CHECK(steps[4].is_operand());
}

TEST_CASE("a command that oiiotool 2.4 does not have takes no arguments")
{
    const std::vector<Step> steps = parse_command_line({ "--newer", "a.jpg" });
    REQUIRE(steps.size() == 2);
    CHECK(!steps[0].oiiotool);
    CHECK(steps[1].is_operand());
}

TEST_CASE("an argument that looks like one of our commands is none")
{
    const std::vector<Step> steps = parse_command_line({ "--echo", "--srisp-process", "-o", "--srisp-help" });
    REQUIRE(steps.size() == 2);
    CHECK(!steps[0].srisp);
    CHECK(!contains(steps, "srisp-help"));
}

TEST_CASE("our commands are found by one dash or two, and take their arguments")
{
    const std::vector<Step> steps = parse_command_line({ "-srisp-unprocess:seed=1", "r.dng", "--srisp-process", "x" });
    REQUIRE(steps.size() == 3);
    CHECK(steps[0].srisp->argument == std::string("REF"));
    CHECK(steps[0].words == Words{ "-srisp-unprocess:seed=1", "r.dng" });
    CHECK(steps[2].is_operand());
}

TEST_CASE("unknown commands of ours and missing arguments are wrong usage")
{
    const auto failure = [](const Words& words) { return failure_of([&] { parse_command_line(words); }); };
    CHECK(failure({ "--srisp-unproces", "r.dng" }) == "2: unknown command '--srisp-unproces'; did you mean "
                                                      "'--srisp-unprocess' or '--srisp-process' or '--srisp-noise'?");
    CHECK(failure({ "a.jpg", "--srisp-unprocess" }) == "2: --srisp-unprocess needs an argument: REF");
    CHECK(failure({ "a.jpg", "--srisp-save-params" }) == "2: --srisp-save-params needs an argument: FILE");
    CHECK(failure({ "a.jpg", "-o" }) == ""); // oiiotool says it
}

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
