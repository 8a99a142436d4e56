// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srisptool/help.h"

#include <sstream>

#include <doctest/doctest.h>

#include "recipe/option_table.h"

using namespace srisp;
using namespace srisp::tool;

TEST_CASE("help names every option that a command takes, its values and its default")
{
    const std::string help = help_text();
    const auto has = [&](const std::string& text) { return help.find(text) != std::string::npos; };
    for (const Option& option : option_table()) {
        INFO(option.key);
        const bool typed = option.doors & kCommands;
        CHECK(has("\n  " + std::string(option.key) + "=") == typed);
    }
    CHECK(has("  input=KIND     auto, srgb or linear (default auto): what the photo's values\n"
              "                 are; auto takes float as linear, integers as sRGB\n"));
    CHECK(has("  seed=N         for the choice among several references, and of a sampled\n"
              "                 brightness (default 0)\n"));
    CHECK(has("  --srisp-process           Turn a RAW-like image into a photo again, by the\n"
              "                            parameters recorded in it (options: model=, params=,\n"
              "                            precision=)\n"));
}

TEST_CASE("help fits into 80 columns")
{
    std::istringstream lines(help_text());
    for (std::string line; std::getline(lines, line);) {
        INFO(line);
        CHECK(line.size() <= 80);
    }
}
