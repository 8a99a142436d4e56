// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srisppack/pack_options.h"

#include <doctest/doctest.h>

using namespace srisp;
using namespace srisp::tool;

TEST_CASE("the help names every option of srisppack, and no other")
{
    CLI::App app;
    PackOptions options;
    describe_options(app, options);
    const std::string help = kHelp;
    std::size_t named = 0;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames()) {
            CHECK_MESSAGE(help.find("--" + name + " ") != std::string::npos, name);
            ++named;
        }
    std::size_t lines = 0; // of options: indented by two
    for (std::size_t at = help.find("\n  -"); at != std::string::npos; at = help.find("\n  -", at + 1))
        ++lines;
    CHECK(named == lines);
}
